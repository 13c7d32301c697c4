// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace lvcalib::simulation {

/// The largest whole number not above x. Much faster than std::floor where the processor's
/// rounding instruction may not be assumed; called for every sub-ray and sample.
inline int whole_below(double x) {
  const int truncated = static_cast<int>(x);
  return truncated - (static_cast<double>(truncated) > x ? 1 : 0);
}

}  // namespace lvcalib::simulation
