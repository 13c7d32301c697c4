// SPDX-License-Identifier: GPL-3.0-or-later
#include "runner/memory.h"

#include <cstdlib>

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace lvcalib::widgets {

void give_memory_back() {
#ifdef __GLIBC__
  // Fixed: left alone, it grows with what is freed, until whole clouds stay in the heap.
  constexpr int kLarge = 256 * 1024;
  constexpr int kHeaps = 2;
  mallopt(M_MMAP_THRESHOLD, kLarge);
  mallopt(M_TRIM_THRESHOLD, kLarge);
  mallopt(M_ARENA_MAX, kHeaps);
#endif
}

}  // namespace lvcalib::widgets
