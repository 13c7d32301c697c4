// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/rigid3.h"
#include "camera/camera.h"
#include "report/stored_model.h"

namespace lvcalib {

struct CalibrationResult;

/// A scene of a result, for formats that hold its picture's pose or its points.
struct ExportScene {
  std::string name;
  bool used = true;
  std::string image, cloud;  ///< Relative to the dataset; empty where the result does not say.
  Rigid3 camera_from_board;
};

/// What an export is made of.
struct ExportInput {
  Rigid3 camera_from_lidar;
  Camera camera;
  std::string dataset;                   ///< Named in the comment.
  std::string quality;                   ///< Said in the comment when it is not "good".
  std::optional<PoseUse> use;            ///< Said in the comment; none in an older result.
  std::optional<Rigid3> imu_from_lidar;  ///< Needed by formats that speak of the IMU.
  std::string result_json;               ///< The whole result, for the boundary response.
  std::vector<ExportScene> scenes;
  /// What the user calls the frames: letters, digits and _ - . / (see check_frame_name()).
  std::string lidar_frame = "lidar";
  std::string camera_frame = "camera";
};

/// Frame names go into shell commands, XML and YAML: errors (kUsage) for an empty one, or one with
/// other characters.
Status check_frame_name(const std::string& name);

/// One file of a format that is a folder.
struct ExportFile {
  std::string name;
  std::string text;
};

/// A format other tools read. Every text says, in the format's own comments, which frames it
/// connects, in which direction and in what units, and works one point through: a LiDAR point, its
/// camera coordinates, its pixel.
struct ExportFormat {
  std::string name;
  std::string description;  ///< One line: for whom, and what it holds.
  bool needs_imu = false;
  Result<std::string> (*write)(const ExportInput&) = nullptr;
  std::string suffix = "txt";  ///< Of its files' names; empty: a folder of several files.
  /// Instead of `write`, of a folder.
  Result<std::vector<ExportFile>> (*write_files)(const ExportInput&) = nullptr;
  /// Neither: a binary cloud of one scene, see colored_cloud.h; the text is its header.
  bool is_cloud = false;
};

/// All formats, in the order of lists.
const std::vector<ExportFormat>& export_formats();

/// The text of a result in a format; of a folder that of its files, one after the other, each with
/// its name before it. Errors: kUsage for an unknown format (naming the nearest) or
/// a missing T_imu_lidar; kUntrusted for a boundary response that the result does not have.
Result<std::string> export_result(const ExportInput& input, const std::string& format);

/// Writes a result in a format: a file, whole or not at all, or a folder (created if needed) with
/// its files. Not for clouds. Errors as of export_result(), and kOutput.
Status write_export(const ExportInput& input, const std::string& format,
                    const std::filesystem::path& path);

/// The lines that every format's comments hold: dataset, quality, frames, the worked point.
std::vector<std::string> export_notes(const ExportInput& input);

/// Of those the ones that say where numbers come from: program, dataset, verdict, model, frames.
std::vector<std::string> origin_notes(const ExportInput& input);

/// What exports need of a calibration just made.
ExportInput export_input_of(const CalibrationResult& result);

/// Reads what exports need from result.json.
Result<ExportInput> read_export_input(const std::filesystem::path& result_json);

/// The camera stored in the text of a result.json.
Result<Camera> camera_from_json_text(const std::string& result_json, const std::string& where = {});

/// The boundary response for a SLAM front end: YAML with documented keys, and how to use it in
/// C++ in its comments.
Result<std::string> export_boundary_response(const ExportInput& input);

}  // namespace lvcalib
