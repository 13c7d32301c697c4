// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/rigid3.h"
#include "design/predicted_scene.h"

namespace lvcalib {

/// A LiDAR as its data sheet describes it, for planning scenes.
struct LidarDescription {
  std::string name;
  SensorModel sensors;  ///< Field of view, density, noise, lines; the camera's part is the default.
  std::vector<int> lines;
  bool has_time = false;
  bool has_intensity = true;
  /// Rough T_camera_lidar; if absent, x forward, y left, z up at the camera's place.
  std::optional<Rigid3> camera_from_lidar;
};

struct LidarFile {
  LidarDescription lidar;
  std::vector<Message> warnings;  ///< Unknown keys.
};

/// Reads a LiDAR's description (YAML). Keys:
///   pattern: rosette | spinning      a round field with interleaved lines, or a rectangle with
///                                    lines one above the other
///   azimuth_fov_deg: [low, high]     elevation_fov_deg: [low, high]
///   points_per_scene: N              in the whole field of view, as many as one scene keeps
///   range_noise_mm: one σ            beam_mrad: one σ of the footprint, half angle
/// and optional
///   name: text                       lines: N (1)                time: true | false (false)
///   intensity: true | false (true)   scan_speed_rad_s: v (0)     scan_period_s: T (0.1)
///   edge_noise: σ of the intensity in an edge, over the contrast of the print (0.1)
///   T_camera_lidar: 3 or 4 rows of 4 numbers
/// Errors: kInput with file, line, key and what was expected.
Result<LidarFile> read_lidar(const std::filesystem::path& path);
/// The same of a text; `name` stands for the file in messages.
Result<LidarFile> parse_lidar(std::string text, std::string name);

/// The LiDAR that took a table's scenes, by its measurements (see sensors_of()), mounted as given.
LidarDescription lidar_of(const MeasurementTable& table, const Rigid3& camera_from_lidar);

/// T_camera_lidar of a LiDAR with x forward, y left, z up at the camera's place.
Rigid3 forward_looking_mount();

}  // namespace lvcalib
