// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/rigid3.h"
#include "camera/camera.h"
#include "camera/camera_deviations.h"
#include "target/target.h"

namespace lvcalib {

/// Files of one scene.
struct SceneFiles {
  std::string name;
  std::filesystem::path image;
  std::filesystem::path cloud;
  std::filesystem::path crop;  ///< board.pcd; empty if there is none.
  /// What is missing in the scene's folder (`where`); its paths are then empty. See
  /// UnusableScenes.
  std::optional<Error> problem = {};
};

/// What becomes of a scene whose files are missing or cannot be read.
enum class UnusableScenes {
  kRefuse,    ///< The whole dataset is refused: nothing is left out unasked.
  kLeaveOut,  ///< The scene is left out with its reason, and the others go on.
};

/// A dataset folder: target.yaml, camera.yaml, optional rig.yaml, scenes/NAME/…, optional
/// intrinsics/….
struct Dataset {
  std::filesystem::path path;
  Target target;
  Camera camera;
  std::optional<CameraDeviations> camera_deviations;  ///< If camera.yaml states them.
  std::optional<Rigid3> rough_camera_from_lidar;
  std::vector<SceneFiles> scenes;  ///< Sorted by name.
  /// Images of the board without a cloud, in intrinsics/: for the camera alone. Sorted.
  std::vector<std::filesystem::path> camera_images;
  std::vector<Message> warnings;
};

/// One scene folder: its image and its cloud (and board.pcd), which are not opened.
/// Errors say which is missing.
Result<SceneFiles> open_scene(const std::filesystem::path& folder);

/// Where the dataset lies, whatever folder the program was started in.
std::string place_of(const Dataset& dataset);

/// Reads the descriptions and lists the scenes; images and clouds are not opened.
/// Errors name what is missing and what was expected; of a scene only with kRefuse.
Result<Dataset> open_dataset(const std::filesystem::path& path,
                             UnusableScenes unusable = UnusableScenes::kRefuse);

/// The png, jpg, bmp and tiff files of a folder, by their names; sorted. Errors (kInput): no such
/// folder, or it cannot be listed.
Result<std::vector<std::filesystem::path>> list_images(const std::filesystem::path& folder);

/// Copies images of the board into the dataset's intrinsics/, all or none of them, and lists them
/// with those that are there. What is there already, the same to the byte, is no error.
/// Errors (kInput): not the name of an image; cannot be read; another image of this name is there,
/// or among those given. kOutput if they cannot be written.
Status add_camera_images(Dataset& dataset, const std::vector<std::filesystem::path>& images);

/// What a camera alone is calibrated from.
struct CameraImages {
  std::filesystem::path target;  ///< target.yaml of the folder; need not exist.
  std::vector<std::filesystem::path> images;
};

/// A dataset's images (of its scenes, and of intrinsics/; nothing else of it need be there), or, in
/// a folder without scenes/, the images that lie in it. Errors (kInput): no folder; no images.
Result<CameraImages> find_camera_images(const std::filesystem::path& path);

/// A rigid transform from a YAML file: rows of a 3×4 or 4×4 matrix, or translation_m and
/// quaternion_xyzw, under `key`.
Result<Rigid3> read_transform(const std::filesystem::path& path, const std::string& key);

/// A rough T_camera_lidar from rig.yaml.
Result<Rigid3> read_rough_extrinsic(const std::filesystem::path& path);

}  // namespace lvcalib
