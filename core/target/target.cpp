// SPDX-License-Identifier: BSD-3-Clause
#include "target/target.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "base/yaml_file.h"

namespace lvcalib {

double Target::tag_bit_m() const {
  const TagPattern* pattern = tag_pattern(tag_family, first_tag_id);
  const int data_bits = pattern != nullptr ? pattern->width : 6;
  return tag_size_m / (data_bits + 2 * tag_border_bits);
}

double Target::tag_pitch_m() const {
  switch (type) {
    case TargetType::kCharuco:
      return column_spacing_m;
    case TargetType::kAprilTag:
      return tag_size_m;
    default:
      return tag_size_m * (1.0 + tag_spacing);
  }
}

double Target::tag_gap_m() const {
  switch (type) {
    case TargetType::kCharuco:
      return 0.5 * (column_spacing_m - tag_size_m);
    case TargetType::kAprilTag:
      return std::max(0.0, 0.5 * std::min(board_width_m, board_height_m) - 0.5 * tag_size_m -
                               board_offset_m.cwiseAbs().maxCoeff());
    default:
      return tag_size_m * tag_spacing;
  }
}

int Target::tag_count() const {
  switch (type) {
    case TargetType::kCheckerboard:
      return 0;
    case TargetType::kAprilTag:
      return 1;
    case TargetType::kCharuco: {
      const int squares = (corner_columns + 1) * (corner_rows + 1);
      // Half of them, and of an odd number one more if the corners are white.
      return (squares + (square_is_black(-1, -1) ? 0 : 1)) / 2;
    }
    default:
      return tag_columns * tag_rows;
  }
}

bool Target::square_is_black(int column, int row) const {
  // From the top left of a ChArUco board, whose colour is given, to the lower left.
  const bool lower_left_black =
      type == TargetType::kCharuco ? legacy_pattern || corner_rows % 2 == 0 : !white_first;
  return (((column + row) & 1) == 0) == lower_left_black;
}

namespace {

std::vector<TargetTag> charuco_markers(const Target& t) {
  std::vector<TargetTag> out;
  int id = t.first_tag_id;
  for (int row = t.corner_rows - 1; row >= -1; --row) {
    for (int column = -1; column < t.corner_columns; ++column) {
      if (t.square_is_black(column, row)) continue;
      out.push_back({id++,
                     column,
                     row,
                     {(column + 0.5) * t.column_spacing_m, (row + 0.5) * t.row_spacing_m}});
    }
  }
  return out;
}

}  // namespace

std::vector<TargetTag> Target::tags() const {
  std::vector<TargetTag> out;
  if (!has_tags()) return out;
  if (type == TargetType::kCharuco) return charuco_markers(*this);
  for (int id = first_tag_id; id < first_tag_id + tag_count(); ++id) out.push_back(*tag(id));
  return out;
}

std::optional<TargetTag> Target::tag(int id) const {
  const int index = id - first_tag_id;
  if (index < 0 || index >= tag_count()) return std::nullopt;
  if (type == TargetType::kCharuco) return charuco_markers(*this)[static_cast<std::size_t>(index)];
  const int columns = type == TargetType::kAprilTag ? 1 : tag_columns;
  const int column = index % columns;
  const int row = index / columns;
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
  if (!has_squares()) return out;
  for (int row = 0; row < corner_rows; ++row) {
    for (int column = 0; column < corner_columns; ++column) {
      out.emplace_back(column * column_spacing_m, row * row_spacing_m);
    }
  }
  return out;
}

BoardOutline Target::outline() const {
  if (has_squares() || type == TargetType::kAprilTag) {
    const Eigen::Vector2d pattern_center =
        has_squares() ? Eigen::Vector2d(0.5 * (corner_columns - 1) * column_spacing_m,
                                        0.5 * (corner_rows - 1) * row_spacing_m)
                      : Eigen::Vector2d::Constant(0.5 * tag_size_m);
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

double square_albedo(const Target& t, const Eigen::Vector2d& p) {
  const int column = static_cast<int>(std::floor(p.x() / t.column_spacing_m));
  const int row = static_cast<int>(std::floor(p.y() / t.row_spacing_m));
  const bool inside = column >= -1 && column < t.corner_columns && row >= -1 && row < t.corner_rows;
  if (!inside) return 1.0;
  if (t.square_is_black(column, row)) return 0.0;
  if (t.type != TargetType::kCharuco) return 1.0;
  const Eigen::Vector2d square(t.column_spacing_m, t.row_spacing_m);
  const Eigen::Vector2d local = p - square.cwiseProduct(Eigen::Vector2d(column, row)) -
                                0.5 * (square - Eigen::Vector2d(t.tag_size_m, t.tag_size_m));
  if (local.minCoeff() < 0.0 || local.maxCoeff() > t.tag_size_m) return 1.0;
  // The markers of the rows above come first; then those to the left.
  int id = t.first_tag_id;
  for (int r = t.corner_rows - 1; r >= row; --r) {
    const int squares = r > row ? t.corner_columns + 1 : column + 1;
    id += (squares + (t.square_is_black(-1, r) ? 0 : 1)) / 2;
  }
  return tag_albedo(t, id, local);
}

}  // namespace

std::optional<double> Target::albedo(const Eigen::Vector2d& p) const {
  const BoardOutline edge = outline();
  if ((p.array() < edge.lower_left_m.array()).any() ||
      (p.array() > edge.upper_right_m.array()).any()) {
    return std::nullopt;
  }
  if (has_squares()) return square_albedo(*this, p);

  const bool single = type == TargetType::kAprilTag;
  const int columns = single ? 1 : tag_columns;
  const int rows = single ? 1 : tag_rows;
  const double pitch = tag_pitch_m();
  const int column = static_cast<int>(std::floor(p.x() / pitch));
  const int row = static_cast<int>(std::floor(p.y() / pitch));
  if (column >= 0 && column < columns && row >= 0 && row < rows) {
    const Eigen::Vector2d local(p.x() - column * pitch, p.y() - row * pitch);
    if (local.x() <= tag_size_m && local.y() <= tag_size_m) {
      return tag_albedo(*this, first_tag_id + row * columns + column, local);
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

namespace {

Status bad(Message message, Message hint = {}) {
  return Error::input(std::move(message), {}, std::move(hint));
}

Status check_squares(const Target& t) {
  if (t.corner_columns < 3 || t.corner_rows < 3)
    return bad(Message("a checkerboard needs at least 3 × 3 inner corners"));
  if (!(t.column_spacing_m > 0) || !(t.row_spacing_m > 0))
    return bad(Message("square sizes must be positive"));
  if (t.board_width_m < (t.corner_columns - 1) * t.column_spacing_m ||
      t.board_height_m < (t.corner_rows - 1) * t.row_spacing_m) {
    return bad(Message("the board outline is smaller than its pattern"),
               Message("measure boardWidth and boardHeight"));
  }
  return Done{};
}

// Ids first … first + count − 1 must be in the family.
Status check_ids(const Target& t) {
  const int family = tag_family_size(t.tag_family);
  const int last = t.first_tag_id + t.tag_count() - 1;
  if (t.first_tag_id >= 0 && last < family) return Done{};
  if (t.type == TargetType::kCharuco) {
    return bad(Message("marker ids %1 to %2 do not exist in %3, which has %4", t.first_tag_id, last,
                       t.tag_family, family));
  }
  return bad(Message("tag ids %1 to %2 do not exist in %3, which has %4", t.first_tag_id, last,
                     t.tag_family, family));
}

Status check_outline_size(const Target& t) {
  constexpr double kLargestBoard_m = 100.0;
  if (t.board_width_m > kLargestBoard_m || t.board_height_m > kLargestBoard_m) {
    return bad(Message("the board is larger than 100 m"),
               Message("spacings and outline are in metres"));
  }
  return Done{};
}

// The rounding of lengths that were measured or written to a micrometre.
constexpr double kSameLength_m = 1e-6;

// The pattern, of a size, must lie on the board.
Status check_on_board(const Target& t, const Eigen::Vector2d& pattern_m) {
  const Eigen::Vector2d board(t.board_width_m, t.board_height_m);
  const Eigen::Vector2d room = 0.5 * (board - pattern_m) - t.board_offset_m.cwiseAbs();
  if (room.minCoeff() >= -kSameLength_m) return Done{};
  return bad(Message("the pattern reaches beyond the board's outline"),
             Message("measure boardWidth, boardHeight and boardOffset"));
}

Status check_charuco(const Target& t) {
  if (!is_marker_dictionary(t.tag_family)) {
    const std::string near = nearest_word(t.tag_family, marker_dictionaries());
    return bad(Message("dictionary '%1' is not known; expected one of OpenCV's, DICT_4X4_50 to "
                       "DICT_APRILTAG_36h11",
                       t.tag_family),
               near.empty() ? Message() : Message("did you mean %1?", near));
  }
  if (t.corner_columns < 2 || t.corner_rows < 2)
    return bad(Message("a ChArUco board needs at least 3 × 3 squares"));
  if (!(t.column_spacing_m > 0) || !(t.tag_size_m > 0) || !(t.tag_size_m < t.column_spacing_m))
    return bad(Message("squareSize must be positive and markerSize smaller than it"));
  if (Status s = check_ids(t); !s) return s;
  if (Status s = check_outline_size(t); !s) return s;
  const Eigen::Vector2d squares(t.corner_columns + 1, t.corner_rows + 1);
  Status on_board = check_on_board(t, t.column_spacing_m * squares);
  if (on_board) return on_board;
  // Columns and rows are easily exchanged.
  if (check_on_board(t, t.column_spacing_m * squares.reverse())) {
    return bad(on_board.error().message,
               Message("with targetCols: %1 and targetRows: %2 it would not", t.corner_rows + 1,
                       t.corner_columns + 1));
  }
  return on_board;
}

Status check_family(const Target& t) {
  if (tag_family_size(t.tag_family) > 0 && !is_marker_dictionary(t.tag_family)) return Done{};
  return bad(
      Message("tag family '%1' is not known; expected tag36h11, tag36h10, tag25h9 or tag16h5",
              t.tag_family));
}

Status check_single_tag(const Target& t) {
  if (Status s = check_family(t); !s) return s;
  if (Status s = check_ids(t); !s) return s;
  if (!(t.tag_size_m > 0)) return bad(Message("tagSize must be positive"));
  if (t.tag_border_bits < 1 || t.tag_border_bits > 2)
    return bad(Message("tagBorder must be 1 or 2"));
  if (Status s = check_outline_size(t); !s) return s;
  return check_on_board(t, {t.tag_size_m, t.tag_size_m});
}

Status check_grid(const Target& t) {
  if (Status s = check_family(t); !s) return s;
  if (t.tag_columns < 1 || t.tag_rows < 1)
    return bad(Message("tagCols and tagRows must be at least 1"));
  if (Status s = check_ids(t); !s) return s;
  if (!(t.tag_size_m > 0) || !(t.tag_spacing > 0) || t.margin_m < 0)
    return bad(Message("tagSize and tagSpacing must be positive, margin not negative"));
  if (t.tag_border_bits < 1 || t.tag_border_bits > 2)
    return bad(Message("tagBorder must be 1 or 2"));
  if (!t.has_circles()) return Done{};
  if (t.tag_columns < 2 || t.tag_rows < 2) return bad(Message("circles need at least 2 × 2 tags"));
  // From a gap crossing's centre to the nearest tag corner: gap/2·√2.
  const double room = 0.5 * t.tag_spacing * t.tag_size_m * std::sqrt(2.0);
  if (!(t.circle_radius_m > 0) || t.circle_radius_m >= room) {
    return bad(Message("circleRadius must be positive and below %1 m, or circles run into the tags",
                       std::to_string(room)));
  }
  return Done{};
}

}  // namespace

Status check(const Target& t) {
  switch (t.type) {
    case TargetType::kCheckerboard:
      if (Status s = check_squares(t); !s) return s;
      return check_outline_size(t);
    case TargetType::kCharuco:
      return check_charuco(t);
    case TargetType::kAprilTag:
      return check_single_tag(t);
    default:
      return check_grid(t);
  }
}

}  // namespace lvcalib
