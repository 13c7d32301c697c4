// SPDX-License-Identifier: GPL-3.0-or-later
// Any bytes give what a rosbag2 database still holds, or an input error; never a crash.
#include <cstddef>
#include <cstdint>

#include "fuzz/fuzz_recording.h"
#include "fuzz/memory_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const lvcalib::test::MemoryFile file(data, size);
  lvcalib::test::read_fuzzed(lvcalib::open_rosbag2_sqlite(file.path(), {}));
  return 0;
}
