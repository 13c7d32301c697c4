// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

namespace lvcalib {

/// Standard deviation of one measurement where a spot sees a share `white` of white print, from
/// those on plain white and plain black: geometrically between the two, as noise follows a power of
/// the light that comes back.
inline double noise_between(double on_white, double on_black, double white) {
  return std::exp(white * std::log(on_white) + (1.0 - white) * std::log(on_black));
}

}  // namespace lvcalib
