// SPDX-License-Identifier: GPL-3.0-or-later
// Any bytes give a target that passes its own check and survives being written and read again,
// or an input error with a message; never a crash.
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "fuzz/memory_file.h"
#include "target/target.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto file = lvcalib::read_target(lvcalib::test::MemoryFile(data, size).path());
  if (!file) {
    if (file.error().kind != lvcalib::ErrorKind::kInput || file.error().message.empty()) abort();
    return 0;
  }
  if (!lvcalib::check(file->target)) abort();
  const std::string text = lvcalib::to_yaml(file->target);
  const lvcalib::test::MemoryFile again(reinterpret_cast<const std::uint8_t*>(text.data()),
                                        text.size());
  if (!lvcalib::read_target(again.path())) abort();
  return 0;
}
