// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdlib>
#include <new>

namespace lvcalib {

/// Throws std::bad_alloc unless so many bytes can be had at this moment: to be asked before a
/// library is called that does not ask itself whether its allocations have succeeded. Nothing is
/// touched, so that it costs neither time nor memory.
inline void require_memory(std::size_t bytes) {
  void* const block = std::malloc(bytes);
  if (block == nullptr) throw std::bad_alloc();
  // The compiler may leave out a pair of malloc and free whose block nobody looks at.
  asm volatile("" : : "r"(block) : "memory");
  std::free(block);
}

}  // namespace lvcalib
