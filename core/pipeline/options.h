// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "base/error.h"
#include "cloud/cloud.h"
#include "detection/board_view.h"
#include "localization/board_search.h"
#include "localization/scene_consensus.h"
#include "refinement/board_refinement.h"
#include "response/boundary_response.h"
#include "selection/discovery_options.h"
#include "solve/feature_solver.h"
#include "solve/forward_solver.h"

namespace lvcalib {

/// What is taken from the clouds.
struct CloudOptions {
  /// Without, every cloud is taken for one that has no intensity: planes and corners have to do.
  bool use_intensity = true;
  /// A compressed cloud that unpacks to more is refused; as many are read at once as there are
  /// threads. The format itself ends at 4096.
  double max_unpacked_mib = static_cast<double>(kMaxUnpackedBytes >> 20U);
  [[nodiscard]] std::uint64_t max_unpacked_bytes() const {
    return static_cast<std::uint64_t>(max_unpacked_mib * 1024.0 * 1024.0);
  }
};

/// When a result counts as trustworthy.
struct QualityOptions {
  double scale_warning = 0.003;  ///< Size difference between LiDAR and model worth a warning.
  double scale_failure = 0.01;   ///< And one that makes the result untrustworthy.
  double max_sigma_px = 1.5;     ///< Doubtful above this, where no replicates tell the noise.
  double max_noise_scale = 2.0;  ///< LiDAR residuals this many times their σ make it doubtful:
                                 ///< three quarters of their variance are then not noise.
  double max_dark_offset_m =
      0.001;  ///< Range difference of dark and white print that is worth doubt.
  double max_sigma_translation_m = 0.1;  ///< A position known worse than this is no result.
  double max_sigma_rotation_rad = 0.05;  ///< A rotation known worse than this is no result.
  /// A fault matters if it moves the LiDAR's position or the rotation by more than this and by more
  /// than so many standard deviations.
  double tolerance_m = 0.0005;
  double tolerance_rad = 0.0002;
  double tolerance_sigmas = 0.5;
  double min_margin = 10.0;  ///< Evidence (nats) by which the assignment must win.
};

/// What is done about the camera's intrinsics.
enum class IntrinsicsMode {
  kFixed,  ///< Taken as given, and doubted where the data contradict them.
  kPrior,  ///< Estimated with the extrinsic, drawn to the given ones by their standard deviations.
  kFree,   ///< Estimated with the extrinsic from the data alone, where they tell.
};

struct IntrinsicsOptions {
  int mode = 0;  ///< An IntrinsicsMode.
  /// Chance of finding intrinsics contradicted that are right.
  double false_alarm = 0.001;
  [[nodiscard]] IntrinsicsMode kind() const { return static_cast<IntrinsicsMode>(mode); }
};

/// Every option of a calibration.
struct CalibrationOptions {
  DetectionOptions detection;
  CloudOptions clouds;
  BoardSearchOptions localization;
  ConsensusOptions consensus;
  RefinementOptions refinement;
  IntrinsicsOptions intrinsics;
  ExtrinsicOptions extrinsic;
  ForwardOptions forward;
  ResponseOptions response;
  QualityOptions quality;
  DiscoveryOptions discovery;
  /// Also what each departure from the paper's method is worth, CalibrationResult::ablation. Asked
  /// for with a run and not declared below: it changes no result.
  bool ablation = false;
};

/// One option as forms, command line and files see it. All options are numbers; switches are
/// whole numbers 0 and 1.
struct OptionDeclaration {
  std::string key;          ///< "refinement.max_bins"
  std::string unit;         ///< "m", "px", "1", …
  std::string description;  ///< One sentence.
  double low = 0.0;
  double high = 0.0;
  bool whole = false;
  std::string stage;  ///< First stage to run again when it changes.
  std::function<double(const CalibrationOptions&)> get;
  std::function<void(CalibrationOptions&, double)> set;
  [[nodiscard]] double default_value() const { return get(CalibrationOptions{}); }
};

/// The one declaration of all options; order is the order of forms.
const std::vector<OptionDeclaration>& option_declarations();

/// Sets one option by key; errors name the range or the nearest known key.
Status set_option(CalibrationOptions& options, const std::string& key, double value);

struct OptionsFile {
  CalibrationOptions options;
  std::vector<Message> warnings;
};

/// Reads a YAML file of "section: {name: value}" or "section.name: value". Unknown keys are
/// warned about with the nearest known one.
Result<OptionsFile> read_options(const std::filesystem::path& path);

}  // namespace lvcalib
