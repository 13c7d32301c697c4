// SPDX-License-Identifier: BSD-3-Clause
#include "detection/refit_view.h"

#include "detection/board_pose.h"

namespace lvcalib {

void refit_view(BoardView& view, const Camera& camera, const DetectionOptions& options) {
  const auto pose = estimate_board_pose(view.corners, camera, options);
  if (!pose) return;
  view.camera_from_board = pose->camera_from_board;
  view.alternative_pose = pose->alternative_pose;
  view.sigma_px = pose->sigma_px;
  view.rms_px = pose->rms_px;
}

}  // namespace lvcalib
