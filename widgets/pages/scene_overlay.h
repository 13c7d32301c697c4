// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "cloud/field_of_view.h"
#include "pipeline/calibration.h"
#include "pipeline/crop_box.h"
#include "views/cloud_pipeline.h"
#include "views/cloud_scene.h"
#include "views/image_overlay.h"

namespace lvcalib::widgets {

/// True if the result carries an extrinsic that can be projected with.
bool has_extrinsic(const CalibrationResult& result);

/// A part of a scene's board that something seems to cover, or that is left out by hand.
struct BoardPart {
  enum class Use { kRefused, kKept, kByHand };
  std::vector<Eigen::Vector2d> edge_m;
  Use use = Use::kRefused;  ///< Kept: used all the same.
  std::size_t points = 0;   ///< Refused ones.
  Message reason = {};      ///< Why it is refused.
};
std::vector<BoardPart> board_parts(const CalibrationResult& result, const SceneResult& scene);

/// What the image view shows of a scene, without LiDAR points.
ImageOverlay image_overlay(const CalibrationResult& result, const SceneResult& scene);

/// Adds the drawn points of a cloud that the camera sees, in their colours; of very many a
/// thinning.
void add_points(ImageOverlay& overlay, const CloudScene& cloud);

/// Asks every return of the scene again: not for the interface's thread.
UnusedPoints unused_points(const CalibrationResult& result, const SceneResult& scene);

/// Puts them on the image, and small crosses across their rays into the cloud.
void add_unused(ImageOverlay& overlay, const CalibrationResult& result, const UnusedPoints& points);
std::vector<CloudLine> unused_marks(const UnusedPoints& points);

/// Lines of the cloud view: the board as the LiDAR sees it (orange), and as camera and extrinsic
/// predict it (blue). Both lie in the same place: the former is broad, under the latter.
std::vector<CloudLine> cloud_lines(const CalibrationResult& result, const SceneResult& scene);

/// The points about the boards of all scenes as one cloud in the LiDAR's frame; in place of a line
/// number each has that of its scene, counted from 1.
Cloud all_boards(const CalibrationResult& result);

/// Every board as the LiDAR (orange) and as the camera with the extrinsic (blue) sees it, the
/// LiDAR's axes, and both sensors as the pyramids of their views: that of the LiDAR as far as its
/// returns tell (nothing: not drawn).
std::vector<CloudLine> world_lines(const CalibrationResult& result, const FieldOfView& lidar = {});

/// The pyramid of the LiDAR's view: what is drawn of it.
std::vector<CloudLine> lidar_pyramid(const FieldOfView& view);

/// The pyramid of the camera's view in the LiDAR's frame: its tip, then the image's corners.
std::vector<Eigen::Vector3d> camera_pyramid(const CalibrationResult& result);

/// The LiDAR's axes, a metre each (x red, y green, z blue), and a grid of round spacing under a
/// box.
std::vector<CloudLine> axes_and_grid(const Eigen::Vector3d& low_m, const Eigen::Vector3d& high_m);

/// A box about the board of a scene, along its axes; a metre and a half about `fallback_m` if there
/// is no board yet.
CropBox box_about_board(const CalibrationResult* result, const SceneResult* scene,
                        const Eigen::Vector3d& fallback_m);

}  // namespace lvcalib::widgets
