// SPDX-License-Identifier: BSD-3-Clause
#include "base/text.h"

#include <cstdio>

namespace lvcalib {

std::string formatted(const char* format, double a, double b) {
  char text[256];
  std::snprintf(text, sizeof text, format, a, b);
  return text;
}

}  // namespace lvcalib
