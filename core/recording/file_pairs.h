// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/error.h"
#include "camera/camera.h"

namespace lvcalib {

/// One image and the cloud that belongs to it.
struct FilePair {
  std::string name;  ///< Of the scene that becomes of it.
  std::filesystem::path image;
  /// A pcd or ply file, KITTI's bin, or a recording all of whose clouds are taken together.
  std::filesystem::path cloud;
  std::filesystem::path board_points;  ///< The board cut out by hand; empty if there is none.
  std::optional<double> apart_s;       ///< Time of the cloud minus that of the image, if known.
};

enum class PairRule {
  kAuto,  ///< By name; by time if no names agree and all are times.
  kName,
  kTime,
};

struct PairOptions {
  std::filesystem::path images;  ///< A folder; of a known layout the one that holds all.
  std::filesystem::path clouds;  ///< Another folder; empty: the same one, or one beside the images.
  PairRule rule = PairRule::kAuto;
  /// By time: pairs further apart are none. 0: half of the usual time between two files of the
  /// sensor that has fewer, beyond which another pair would be nearer.
  double most_apart_s = 0.0;
  double image_time_offset_s = 0.0;  ///< Added to the times of images.
};

/// A file without a partner.
struct UnmatchedFile {
  std::string name;  ///< Empty: several that are not named.
  Message reason;
  /// Both in one sentence.
  [[nodiscard]] Message sentence() const;
};

/// Whose tool's files they are, or what tells those of any others that belong together.
enum class FileLayout {
  kKittiRaw,
  kCamLidarCalibration,
  kDirectVisual,
  kFastCalib,
  kSameName,
  kSameNumber,
  kNearestTime,
};
/// As import.json has it: "KITTI raw", "files of the same name"…
std::string name_of(FileLayout layout);

struct PairedFiles {
  FileLayout layout = FileLayout::kSameName;
  std::vector<FilePair> pairs;
  std::vector<UnmatchedFile> unmatched;  ///< At most some dozens are named.
  std::optional<Camera> camera;          ///< Intrinsics that lie there.
  std::string camera_from;               ///< Their file.
  std::vector<Message> warnings;
};

/// Finds images and clouds that belong together in folders of others. Known layouts:
/// - KITTI raw: image_0N/data and velodyne_points/data, calib_cam_to_cam.txt with them or above;
/// - cam_lidar_calibration of ACFR: images/NAME.png, pcd/NAME_full.pcd and NAME_target.pcd;
/// - direct_visual_lidar_calibration: NAME.png, NAME.ply, calib.json;
/// - FAST-Calib: NAME.png or jpg and NAME.bag, qr_params.yaml with them or in ../config;
/// - everything else: images and clouds in one folder or two, of the same name, of the same number
///   in their names, or by the times that are their names (s, ms, µs or ns).
/// Errors (kInput): no folder; no images; no clouds; nothing that belongs together (saying which
/// names were found).
Result<PairedFiles> find_pairs(const PairOptions& options);

/// Whether a folder looks like one of those, rather than like a recording or a dataset.
bool looks_like_file_pairs(const std::filesystem::path& folder);

/// The time that a file's name is, in seconds: "1650000000.25", "1650000000250" (ms),
/// "1650000000_250000000"; nothing for other names.
std::optional<double> time_of_name(const std::string& stem);

}  // namespace lvcalib
