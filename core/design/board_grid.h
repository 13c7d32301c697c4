// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "base/error.h"
#include "base/rigid3.h"
#include "camera/camera.h"
#include "target/target.h"

namespace lvcalib {

/// Board poses that are tried when the next scene is looked for.
struct BoardGridOptions {
  std::vector<double> distances_m{1.0, 1.5, 2.0, 3.0, 4.0, 6.0};  ///< Camera to board centre.
  std::vector<double> tilts_deg{-55.0, -30.0, 0.0, 30.0, 55.0};   ///< About the x or the y axis.
  std::vector<double> rolls_deg{0.0, 45.0, 90.0};                 ///< In the board's plane.
  int cells = 3;           ///< Cells of the image along each side; the centre is put into each.
  double min_tag_px = 12;  ///< A tag's (or square's) side in the image must be longer.
  [[nodiscard]] Status check() const;
};

/// One pose of the grid, with what it was made from.
struct GridPose {
  Rigid3 camera_from_board;
  double distance_m = 0.0;
  double tilt_x_deg = 0.0;  ///< Top towards the camera positive.
  double tilt_y_deg = 0.0;  ///< Right side away from the camera positive.
  double roll_deg = 0.0;    ///< Counter-clockwise as the camera sees it.
  double right_deg = 0.0;   ///< Direction of the centre from the optical axis.
  double down_deg = 0.0;

  /// "at 2.0 m, 12° right and 5° above of the optical axis, the right side turned away by 30°".
  [[nodiscard]] Message description() const;
  [[nodiscard]] std::string text() const { return description().text(); }
};

/// All poses of the grid at which the camera sees every corner of the pattern.
std::vector<GridPose> board_grid(const Target& target, const Camera& camera,
                                 const BoardGridOptions& options);

}  // namespace lvcalib
