// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The kinds of corruption, a file for each thing that is corrupted.

#include <cstdio>
#include <string>
#include <vector>

#include "support/corruption_tools.h"

namespace lvcalib::test {

using Words = std::vector<std::string>;
using Kinds = std::vector<Corruption>;
using Family = CorruptionFamily;

// What is to be said, of whatever makes a camera's file wrong.
inline const Words kFocal{"focal length"};
inline const Words kPrincipal{"principal point"};

template <typename... T>
std::string named(const char* format, T... values) {
  char text[120];
  std::snprintf(text, sizeof text, format, values...);
  return text;
}

void add_camera_kinds(Kinds& all);
void add_cloud_kinds(Kinds& all);
void add_image_kinds(Kinds& all);
void add_board_kinds(Kinds& all);

}  // namespace lvcalib::test
