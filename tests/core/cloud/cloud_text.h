// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstring>
#include <string>

namespace lvcalib::test {

/// The bytes of a value, in this machine's order or reversed.
template <class T>
std::string bytes(T value, bool reversed = false) {
  std::string text(sizeof(T), '\0');
  std::memcpy(text.data(), &value, sizeof(T));
  if (reversed) std::reverse(text.begin(), text.end());
  return text;
}

/// A PCD header.
inline std::string pcd_header(const std::string& fields, const std::string& sizes,
                              const std::string& types, const std::string& counts,
                              std::size_t points, const std::string& data) {
  const std::string n = std::to_string(points);
  return "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\nFIELDS " + fields + "\nSIZE " +
         sizes + "\nTYPE " + types + "\nCOUNT " + counts + "\nWIDTH " + n +
         "\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " + n + "\nDATA " + data + "\n";
}

/// Header of an ascii cloud with x y z intensity as floats.
inline std::string ascii_header(std::size_t points) {
  return pcd_header("x y z intensity", "4 4 4 4", "F F F F", "1 1 1 1", points, "ascii");
}

}  // namespace lvcalib::test
