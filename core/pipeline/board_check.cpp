// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/board_check.h"

#include "detection/board_view.h"

namespace lvcalib {

namespace {

Message complaint_of(const Result<GrayImage>& pixels, const Target& target, const Camera& camera,
                     const RunContext& context) {
  if (!pixels) return pixels.error().message;
  const RunContext silent = context.silent();
  const auto view = find_board_in_image(*pixels, target, camera, {}, silent);
  return view ? Message() : view.error().message;
}

}  // namespace

std::function<Message(const std::filesystem::path& image, const Camera& camera)> make_board_check(
    const Target& target, const RunContext& context) {
  return [target, context](const std::filesystem::path& image, const Camera& camera) {
    return complaint_of(read_image(image), target, camera, context);
  };
}

Message board_complaint(std::string_view image_file, const Target& target, const Camera& camera,
                        const RunContext& context) {
  return complaint_of(read_image(image_file, "image"), target, camera, context);
}

}  // namespace lvcalib
