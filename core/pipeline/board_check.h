// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <functional>
#include <string_view>

#include "base/message.h"
#include "base/progress.h"
#include "camera/camera.h"
#include "target/target.h"

namespace lvcalib {

/// What ImportOptions::board_check asks: why an image file does not show this board, in words;
/// empty if it does. Holds copies of both arguments.
std::function<Message(const std::filesystem::path& image, const Camera& camera)> make_board_check(
    const Target& target, const RunContext& context);

/// The same of an image file's content.
Message board_complaint(std::string_view image_file, const Target& target, const Camera& camera,
                        const RunContext& context);

}  // namespace lvcalib
