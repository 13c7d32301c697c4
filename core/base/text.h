// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace lvcalib {

/// Up to two numbers in a printf format ("%.1f mm and %.2f mrad"). At most 255 bytes.
std::string formatted(const char* format, double a, double b = 0.0);

/// A value with its standard deviation, both to the decimal where the latter has two digits:
/// "4885 ± 1297", "15.80 ± 0.41". Three digits of the value where there is no standard deviation.
std::string with_sigma(double value, double sigma);

/// Words with something between each two.
std::string joined(const std::vector<std::string>& words, const char* between);

/// " mm" behind a number; nothing for the unit "1".
std::string behind_number(const std::string& unit);

}  // namespace lvcalib
