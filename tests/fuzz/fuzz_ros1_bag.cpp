// SPDX-License-Identifier: GPL-3.0-or-later
// Any bytes behind the magic give what a ROS 1 bag still holds, or an input error; never a crash.
#include <cstddef>
#include <cstdint>

#include "fuzz/fuzz_recording.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view content(reinterpret_cast<const char*>(data), size);
  lvcalib::test::read_fuzzed(
      lvcalib::open_ros1_bag(lvcalib::RandomFile::from_memory(content, "fuzz"), {}));
  return 0;
}
