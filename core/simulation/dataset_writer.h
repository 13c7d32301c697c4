// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "base/error.h"
#include "simulation/simulator.h"

namespace lvcalib::simulation {

/// Writes a simulated dataset scene by scene: DATASET/target.yaml, camera.yaml,
/// scenes/NAME/{image.png, cloud.pcd} and, beside the folder, DATASET-truth.json with T_CL, the
/// planted effects (id → value as asked for; effect_details: what else they do) and, per scene,
/// T_CB and T_LB (3×4 rows).
///
/// Everything goes to a hidden folder beside DATASET, which takes the name only in finish(); a
/// writer that is destroyed before leaves nothing behind.
class DatasetWriter {
 public:
  /// An existing DATASET that is not an empty folder is refused (kOutput), except with `force` if
  /// it is itself a simulated dataset: a folder of target.yaml, camera.yaml and scenes only, with
  /// a truth file beside it.
  static Result<DatasetWriter> create(const SimulatedRig& rig, const std::filesystem::path& dataset,
                                      bool force);

  DatasetWriter(DatasetWriter&& other) noexcept;
  DatasetWriter& operator=(DatasetWriter&&) = delete;
  DatasetWriter(const DatasetWriter&) = delete;
  DatasetWriter& operator=(const DatasetWriter&) = delete;
  ~DatasetWriter();

  /// Not safe to call from several threads at once.
  Status add(const SimulatedScene& scene);

  /// Puts dataset and truth in place.
  Status finish();

  [[nodiscard]] const std::filesystem::path& truth_path() const { return truth_; }

 private:
  DatasetWriter(const SimulatedRig& rig, std::filesystem::path dataset, std::filesystem::path truth,
                std::filesystem::path temporary);
  [[nodiscard]] std::string truth_text() const;

  struct SceneTruth {
    bool has_board = false;
    Rigid3 camera_from_board;
    Rigid3 lidar_from_board;
    std::size_t points = 0;
  };
  SimulationOptions options_;
  Rigid3 camera_from_lidar_;
  EffectDetails effect_details_;
  std::filesystem::path dataset_;
  std::filesystem::path truth_;
  std::filesystem::path temporary_;  // Empty once moved into place or moved from.
  std::map<std::string, SceneTruth> scenes_;
};

/// Writes a whole rig with DatasetWriter.
Status write_dataset(const SimulatedRig& rig, const std::filesystem::path& dataset,
                     bool force = false);

/// The image as the bytes of a PNG file.
Result<std::string> encode_png(const SimulatedImage& image);

}  // namespace lvcalib::simulation
