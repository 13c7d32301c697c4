// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/rigid3.h"
#include "camera/camera.h"
#include "detection/board_view.h"
#include "target/target.h"

namespace lvcalib {

/// Radius of the board's circles as one image shows them: the target's, and by how much farther out
/// their edges are seen than the tags' are (the medians of where grey levels cross the middle, over
/// 24 places about each). Blur, the camera's tone curve and ink that spreads move both alike; and
/// the camera does not see what displaces edges for the LiDAR. Not measured on boards without
/// circles, where fewer than half of the places show an edge, or where blur is as wide as the tags'
/// borders.
MeasuredRadius measure_circle_radius(const GrayImage& image, const Target& target,
                                     const Camera& camera, const Rigid3& camera_from_board);

}  // namespace lvcalib
