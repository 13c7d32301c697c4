// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>

namespace lvcalib {

using Clock = std::chrono::steady_clock;

inline double ms_since(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

}  // namespace lvcalib
