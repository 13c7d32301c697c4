// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "camera/camera.h"
#include "camera/camera_deviations.h"

namespace lvcalib {

/// As read_camera(), of a text that is no file yet; `name` stands for the file in messages.
Result<CameraFile> camera_from_text(std::string text, const std::string& name);

/// As read_camera_deviations(), of a text that is no file yet.
Result<std::optional<CameraDeviations>> camera_deviations_from_text(std::string text,
                                                                    const std::string& name,
                                                                    const Camera& camera);

}  // namespace lvcalib
