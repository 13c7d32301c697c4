// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "base/error.h"
#include "camera/camera.h"

namespace lvcalib {

/// Intrinsics of one camera of KITTI's calib_cam_to_cam.txt ("02"). `rectified`: those of the
/// images of "sync" drives (P_rect), else of the raw ones (K and D).
Result<Camera> camera_of_kitti(std::string_view text, const std::string& number, bool rectified,
                               const std::string& where);

/// Intrinsics of the calib.json of direct_visual_lidar_calibration, which does not state the
/// images' size. Errors: a camera model that has no counterpart here, named.
Result<Camera> camera_of_calib_json(std::string_view text, int width_px, int height_px,
                                    const std::string& where);

/// Intrinsics of FAST-Calib's qr_params.yaml, which does not state the images' size.
Result<Camera> camera_of_qr_params(const std::filesystem::path& path, int width_px, int height_px);

}  // namespace lvcalib
