// SPDX-License-Identifier: GPL-3.0-or-later
// Any bytes give a camera that passes its own check and survives being written and read again,
// or an input error with a message; never a crash.
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "camera/camera.h"
#include "fuzz/memory_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto file = lvcalib::read_camera(lvcalib::test::MemoryFile(data, size).path());
  if (!file) {
    if (file.error().kind != lvcalib::ErrorKind::kInput || file.error().message.empty()) abort();
    return 0;
  }
  const lvcalib::Camera& camera = file->camera;
  if (!lvcalib::check(camera)) abort();
  // Extreme coefficients may image nothing, but what they image is finite.
  if (const auto pixel = camera.project({0.1, 0.2, 1.0}); pixel && !pixel->allFinite()) abort();
  if (const auto ray = camera.unproject({1.0, 2.0}); ray && !ray->allFinite()) abort();
  const std::string text = lvcalib::to_yaml(camera);
  const lvcalib::test::MemoryFile again(reinterpret_cast<const std::uint8_t*>(text.data()),
                                        text.size());
  if (!lvcalib::read_camera(again.path())) abort();
  return 0;
}
