// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "camera/camera.h"
#include "detection/board_view.h"

namespace lvcalib {

/// Estimates the board's pose anew from a view's own corners under another camera: pose, the other
/// pose of the planar ambiguity, noise. A view whose corners fit no pose is left as it is.
void refit_view(BoardView& view, const Camera& camera, const DetectionOptions& options);

}  // namespace lvcalib
