// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/progress.h"
#include "extrinsic/methods.h"
#include "extrinsic/uncertainty.h"
#include "pipeline/dataset.h"
#include "pipeline/input_hashes.h"
#include "pipeline/options.h"
#include "response/boundary_response.h"

namespace lvcalib {

/// Wall time of each stage in milliseconds. Stages of different scenes run at the same time: load,
/// detect, localize and refine are sums over scenes; total is the clock on the wall.
struct StageTimes {
  double load_ms = 0, detect_ms = 0, localize_ms = 0, refine_ms = 0, optimize_ms = 0,
         response_ms = 0, total_ms = 0;
};

/// Everything found in one scene; what a stage did not reach is empty.
struct SceneResult {
  std::string name;
  bool used = false;
  std::string reason;          ///< Why it is not used, in words.
  bool looks_through = false;  ///< The LiDAR sees past the place where the others put its board.
  bool contradicts = false;    ///< Left out because it disagrees with the other scenes.
  std::optional<BoardView> view;
  std::optional<BoardSearchResult> search;
  std::optional<std::size_t> chosen;  ///< Candidate that all scenes agree on.
  Cloud board_points;                 ///< Full-density points about the board.
  std::optional<BoardRefinement> refinement;
};

enum class Quality { kGood, kDoubtful, kFailed };
std::string name_of(Quality quality);

/// A finished calibration.
struct CalibrationResult {
  std::string dataset;
  Target target;
  Camera camera;
  std::vector<SceneResult> scenes;
  SceneConsensus consensus;
  ExtrinsicSolution extrinsic;
  std::vector<MethodResult> methods;  ///< The paper's objectives on the scenes in use.
  UncertaintyReport uncertainty;
  BoundaryResponse response;  ///< Of the scenes in use.
  Quality quality = Quality::kFailed;
  std::string quality_reason;                ///< Why the quality is not good, in words.
  std::vector<std::string> quality_reasons;  ///< Everything that speaks against "good".
  std::vector<std::string> warnings;
  std::vector<InputFile> inputs;  ///< The files read, with their SHA-256.
  StageTimes times;
};

/// What to run besides the dataset.
struct CalibrationRequest {
  CalibrationOptions options;
  std::optional<Rigid3> guess;  ///< Rough T_camera_lidar; narrows the search.
  bool use_crops = false;       ///< Take scenes/NAME/board.pcd instead of cloud.pcd where present.
  std::vector<std::string> rejected;  ///< Scenes to leave out.
};

/// The whole calibration: load, detect, localize, refine, optimise.
/// Errors: kInput for unusable files or images (named), kUntrusted if the board is not found or
/// the scenes do not determine an extrinsic, kCancelled.
Result<CalibrationResult> calibrate(const Dataset& dataset, const CalibrationRequest& request,
                                    const RunContext& context);

/// Solves again from kept features with other scenes in use (`use` per scene): extrinsic, methods,
/// uncertainty, boundary response, quality. A fraction of a second.
Result<CalibrationResult> resolve_calibration(CalibrationResult result,
                                              const std::vector<bool>& use,
                                              const CalibrationOptions& options,
                                              const RunContext& context = {});

}  // namespace lvcalib
