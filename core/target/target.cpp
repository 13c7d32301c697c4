// SPDX-License-Identifier: BSD-3-Clause
#include "target/target.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace lvcalib {

double Target::tag_bit_m() const {
  const TagPattern* pattern = tag_pattern(tag_family, first_tag_id);
  const int data_bits = pattern != nullptr ? pattern->width : 6;
  return tag_size_m / (data_bits + 2 * tag_border_bits);
}

std::vector<TargetTag> Target::tags() const {
  std::vector<TargetTag> out;
  if (!has_tags()) return out;
  const double half = 0.5 * tag_size_m;
  for (int row = 0; row < tag_rows; ++row) {
    for (int column = 0; column < tag_columns; ++column) {
      out.push_back({first_tag_id + row * tag_columns + column,
                     column,
                     row,
                     {column * tag_pitch_m() + half, row * tag_pitch_m() + half}});
    }
  }
  return out;
}

std::optional<TargetTag> Target::tag(int id) const {
  const int index = id - first_tag_id;
  if (!has_tags() || index < 0 || index >= tag_columns * tag_rows) return std::nullopt;
  const int column = index % tag_columns;
  const int row = index / tag_columns;
  const double half = 0.5 * tag_size_m;
  return TargetTag{id, column, row, {column * tag_pitch_m() + half, row * tag_pitch_m() + half}};
}

std::vector<Eigen::Vector2d> Target::tag_corners_m(const TargetTag& tag) const {
  const double h = 0.5 * tag_size_m;
  const Eigen::Vector2d c = tag.center_m;
  return {c + Eigen::Vector2d(-h, -h), c + Eigen::Vector2d(h, -h), c + Eigen::Vector2d(h, h),
          c + Eigen::Vector2d(-h, h)};
}

std::vector<TargetNode> Target::nodes() const {
  std::vector<TargetNode> out;
  if (!has_circles()) return out;
  // The middle of the gap after tag 0: tag size plus half a gap.
  const double first = tag_size_m * (1.0 + 0.5 * tag_spacing);
  for (int j = 0; j + 1 < tag_rows; ++j) {
    for (int i = 0; i + 1 < tag_columns; ++i) {
      out.push_back(
          {j * (tag_columns - 1) + i, {first + i * tag_pitch_m(), first + j * tag_pitch_m()}});
    }
  }
  return out;
}

std::vector<Eigen::Vector2d> Target::checkerboard_corners_m() const {
  std::vector<Eigen::Vector2d> out;
  if (type != TargetType::kCheckerboard) return out;
  for (int row = 0; row < corner_rows; ++row) {
    for (int column = 0; column < corner_columns; ++column) {
      out.emplace_back(column * column_spacing_m, row * row_spacing_m);
    }
  }
  return out;
}

BoardOutline Target::outline() const {
  if (type == TargetType::kCheckerboard) {
    const Eigen::Vector2d pattern_center(0.5 * (corner_columns - 1) * column_spacing_m,
                                         0.5 * (corner_rows - 1) * row_spacing_m);
    const Eigen::Vector2d center = pattern_center - board_offset_m;
    const Eigen::Vector2d half(0.5 * board_width_m, 0.5 * board_height_m);
    return {center - half, center + half};
  }
  return {{-margin_m, -margin_m},
          {(tag_columns - 1) * tag_pitch_m() + tag_size_m + margin_m,
           (tag_rows - 1) * tag_pitch_m() + tag_size_m + margin_m}};
}

int Target::outline_symmetry() const {
  const Eigen::Vector2d size = outline().size_m();
  // A board is taken as square when its sides differ by less than a LiDAR can tell: 2 %.
  return std::abs(size.x() - size.y()) < 0.02 * size.maxCoeff() ? 4 : 2;
}

namespace {

double checkerboard_albedo(const Target& t, const Eigen::Vector2d& p) {
  const int column = static_cast<int>(std::floor(p.x() / t.column_spacing_m));
  const int row = static_cast<int>(std::floor(p.y() / t.row_spacing_m));
  const bool inside = column >= -1 && column < t.corner_columns && row >= -1 && row < t.corner_rows;
  return inside && ((column + row) & 1) == 0 ? 0.0 : 1.0;
}

// Albedo inside the black square of a tag; `p` from its lower-left corner.
double tag_albedo(const Target& t, int id, const Eigen::Vector2d& p) {
  const TagPattern* pattern = tag_pattern(t.tag_family, id);
  if (pattern == nullptr) return 0.0;
  const int side = pattern->width + 2 * t.tag_border_bits;
  const double bit = t.tag_size_m / side;
  const int column = static_cast<int>(std::floor(p.x() / bit)) - t.tag_border_bits;
  const int row = side - 1 - static_cast<int>(std::floor(p.y() / bit)) - t.tag_border_bits;
  const bool data = column >= 0 && column < pattern->width && row >= 0 && row < pattern->width;
  return data && pattern->at(row, column) ? 1.0 : 0.0;
}

}  // namespace

std::optional<double> Target::albedo(const Eigen::Vector2d& p) const {
  const BoardOutline edge = outline();
  if ((p.array() < edge.lower_left_m.array()).any() ||
      (p.array() > edge.upper_right_m.array()).any()) {
    return std::nullopt;
  }
  if (type == TargetType::kCheckerboard) return checkerboard_albedo(*this, p);

  const double pitch = tag_pitch_m();
  const int column = static_cast<int>(std::floor(p.x() / pitch));
  const int row = static_cast<int>(std::floor(p.y() / pitch));
  if (column >= 0 && column < tag_columns && row >= 0 && row < tag_rows) {
    const Eigen::Vector2d local(p.x() - column * pitch, p.y() - row * pitch);
    if (local.x() <= tag_size_m && local.y() <= tag_size_m) {
      return tag_albedo(*this, first_tag_id + row * tag_columns + column, local);
    }
  }
  if (has_circles()) {
    const double first = tag_size_m * (1.0 + 0.5 * tag_spacing);
    const int i = static_cast<int>(std::lround((p.x() - first) / pitch));
    const int j = static_cast<int>(std::lround((p.y() - first) / pitch));
    if (i >= 0 && j >= 0 && i + 1 < tag_columns && j + 1 < tag_rows) {
      const Eigen::Vector2d center(first + i * pitch, first + j * pitch);
      if ((p - center).norm() <= circle_radius_m) return 0.0;
    }
  }
  return 1.0;
}

Status check(const Target& t) {
  const auto bad = [](std::string message, std::string hint = {}) -> Status {
    return Error::input(std::move(message), {}, std::move(hint));
  };
  if (t.type == TargetType::kCheckerboard) {
    if (t.corner_columns < 3 || t.corner_rows < 3)
      return bad("a checkerboard needs at least 3 × 3 inner corners");
    if (!(t.column_spacing_m > 0) || !(t.row_spacing_m > 0))
      return bad("square sizes must be positive");
    if (t.board_width_m < (t.corner_columns - 1) * t.column_spacing_m ||
        t.board_height_m < (t.corner_rows - 1) * t.row_spacing_m) {
      return bad("the board outline is smaller than its pattern",
                 "measure boardWidth and boardHeight");
    }
    constexpr double kLargestBoard_m = 100.0;
    if (t.board_width_m > kLargestBoard_m || t.board_height_m > kLargestBoard_m) {
      return bad("the board is larger than 100 m", "spacings and outline are in metres");
    }
    return Done{};
  }
  const int family = tag_family_size(t.tag_family);
  if (family == 0)
    return bad("tag family '" + t.tag_family +
               "' is not known; expected tag36h11, tag36h10, tag25h9 or tag16h5");
  if (t.tag_columns < 1 || t.tag_rows < 1) return bad("tagCols and tagRows must be at least 1");
  if (t.first_tag_id < 0 || t.first_tag_id + t.tag_columns * t.tag_rows > family) {
    return bad("tag ids " + std::to_string(t.first_tag_id) + " to " +
               std::to_string(t.first_tag_id + t.tag_columns * t.tag_rows - 1) +
               " do not exist in " + t.tag_family + ", which has " + std::to_string(family));
  }
  if (!(t.tag_size_m > 0) || !(t.tag_spacing > 0) || t.margin_m < 0)
    return bad("tagSize and tagSpacing must be positive, margin not negative");
  if (t.tag_border_bits < 1 || t.tag_border_bits > 2) return bad("tagBorder must be 1 or 2");
  if (t.has_circles()) {
    if (t.tag_columns < 2 || t.tag_rows < 2) return bad("circles need at least 2 × 2 tags");
    // From a gap crossing's centre to the nearest tag corner: gap/2·√2.
    const double room = 0.5 * t.tag_spacing * t.tag_size_m * std::sqrt(2.0);
    if (!(t.circle_radius_m > 0) || t.circle_radius_m >= room) {
      return bad("circleRadius must be positive and below " + std::to_string(room) +
                 " m, or circles run into the tags");
    }
  }
  return Done{};
}

}  // namespace lvcalib
