// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "pipeline/crop_box.h"

namespace lvcalib::widgets {

/// Where the viewer of a cloud stands.
enum class CloudViewpoint {
  kWhole,   ///< Obliquely from behind the sensor, everything in sight.
  kMost,    ///< As kWhole, without the few points that lie far beyond the others.
  kTop,     ///< From above, x up.
  kBoard,   ///< From the LiDAR's side onto the board, which fills the view.
  kSensor,  ///< From the LiDAR's origin towards the middle of the points.
};

/// A viewer that looks at the focus.
struct ViewerPose {
  Eigen::Vector3d eye_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
  double angle_deg = 30.0;  ///< Vertical field of view.
  bool fits_bounds = true;  ///< Only the direction counts: move back until everything is in sight.
};
/// Where a viewer stands for good: eye, what is looked at, and which way is up.
struct Viewer {
  Eigen::Vector3d eye_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d focus_m = Eigen::Vector3d::UnitX();
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
  double angle_deg = 30.0;
};
/// On the way from one place to another, 0…1: turns about the focus as it moves, at an even pace
/// but for a soft start and end.
Viewer between(const Viewer& from, const Viewer& to, double share);

ViewerPose viewer_pose(CloudViewpoint viewpoint, const Eigen::Vector3d& focus_m);

/// The affine map that takes the cube ±1 to a box.
Eigen::Matrix4d cube_to_box(const CropBox& box);

/// The box that a map of the cube ±1 makes; the inverse of cube_to_box(). Sides are at least 2 mm.
CropBox box_of_cube(const Eigen::Matrix4d& matrix);

}  // namespace lvcalib::widgets
