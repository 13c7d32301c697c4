// SPDX-License-Identifier: BSD-3-Clause
#include "base/text.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace lvcalib {

std::string formatted(const char* format, double a, double b) {
  char text[256];
  std::snprintf(text, sizeof text, format, a, b);
  return text;
}

std::string with_sigma(double value, double sigma) {
  constexpr double kHuge = 1e6;
  constexpr int kMost = 9;  // decimals
  if (!(sigma > 0.0) || !(sigma < kHuge) || !(std::abs(value) < kHuge))
    return formatted("%.3g ± %.2g", value, sigma);
  const int decimals = std::clamp(1 - static_cast<int>(std::floor(std::log10(sigma))), 0, kMost);
  const std::string number = "%." + std::to_string(decimals) + "f";
  return formatted((number + " ± " + number).c_str(), value, sigma);
}

std::string joined(const std::vector<std::string>& words, const char* between) {
  std::string out;
  for (const std::string& w : words) out += (out.empty() ? "" : between) + w;
  return out;
}

std::string behind_number(const std::string& unit) {
  return unit == "1" ? "" : " " + unit;
}

}  // namespace lvcalib
