// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "detection/board_view.h"
#include "pipeline/calibration.h"

namespace lvcalib::test {

/// Lets a scene's image show the board displaced (camera frame), as though it had been moved
/// between cloud and image.
inline void move_board_in_image(const Rigid3& moved, const Camera& camera, SceneResult& scene) {
  for (CornerObservation& corner : scene.view->corners) {
    const Eigen::Vector3d place =
        moved * (scene.view->camera_from_board.transform *
                 Eigen::Vector3d(corner.board_m.x(), corner.board_m.y(), 0.0));
    corner.pixel = *camera.project(place);
  }
  refit_view(*scene.view, camera, {});
}

}  // namespace lvcalib::test
