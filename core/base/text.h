// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace lvcalib {

/// Up to two numbers in a printf format ("%.1f mm and %.2f mrad"). At most 255 bytes.
std::string formatted(const char* format, double a, double b = 0.0);

}  // namespace lvcalib
