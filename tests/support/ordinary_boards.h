// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Boards of the kinds that are not grids of tags.

#include "target/target.h"

namespace lvcalib::test {

inline Target checkerboard_target() {
  Target t;
  t.type = TargetType::kCheckerboard;
  t.corner_columns = 7;
  t.corner_rows = 5;
  t.column_spacing_m = t.row_spacing_m = 0.1;
  t.board_width_m = 0.9;
  t.board_height_m = 0.7;
  return t;
}

/// 8 × 7 squares; the number of rows is odd, so both layouts are the same.
inline Target charuco_target() {
  Target t;
  t.type = TargetType::kCharuco;
  t.tag_family = "DICT_5X5_100";
  t.corner_columns = 7;
  t.corner_rows = 6;
  t.column_spacing_m = t.row_spacing_m = 0.11;
  t.tag_size_m = 0.08;
  t.board_width_m = 0.92;
  t.board_height_m = 0.80;
  t.board_offset_m = {0.01, -0.005};
  return t;
}

/// 6 × 8 squares, whose even number of rows begins with white in the legacy layout.
inline Target legacy_charuco_target() {
  Target t = charuco_target();
  t.tag_family = "DICT_4X4_50";
  t.first_tag_id = 3;
  t.legacy_pattern = true;
  t.corner_columns = 5;
  t.corner_rows = 7;
  t.board_width_m = 0.70;
  t.board_height_m = 0.92;
  return t;
}

inline Target single_tag_target() {
  Target t;
  t.type = TargetType::kAprilTag;
  t.first_tag_id = 7;
  t.tag_size_m = 0.6;
  t.board_width_m = 0.8;
  t.board_height_m = 0.85;
  t.board_offset_m = {0.005, 0.01};
  return t;
}

}  // namespace lvcalib::test
