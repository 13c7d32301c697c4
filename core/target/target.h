// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "base/error.h"

namespace lvcalib {

enum class TargetType {
  kAprilGridCircles,  ///< AprilGrid with black circles in the gap crossings.
  kAprilGrid,         ///< AprilGrid as Kalibr prints it.
  kCheckerboard,
  kCharuco,   ///< OpenCV's ChArUco board: a checkerboard with a marker in every white square.
  kAprilTag,  ///< One big AprilTag.
};

/// One circular node: its id and its centre on the board.
struct TargetNode {
  int id = 0;
  Eigen::Vector2d center_m = Eigen::Vector2d::Zero();
};

/// One fiducial tag: its id in the family and the centre of its black square.
struct TargetTag {
  int id = 0;
  int column = 0;
  int row = 0;
  Eigen::Vector2d center_m = Eigen::Vector2d::Zero();
};

/// A rectangle on the board plane.
struct BoardOutline {
  Eigen::Vector2d lower_left_m = Eigen::Vector2d::Zero();
  Eigen::Vector2d upper_right_m = Eigen::Vector2d::Zero();
  [[nodiscard]] Eigen::Vector2d size_m() const { return upper_right_m - lower_left_m; }
  [[nodiscard]] Eigen::Vector2d center_m() const { return 0.5 * (lower_left_m + upper_right_m); }
  [[nodiscard]] bool contains(const Eigen::Vector2d& p) const {
    return (p.array() >= lower_left_m.array()).all() && (p.array() <= upper_right_m.array()).all();
  }
  /// From the lower left one, counterclockwise.
  [[nodiscard]] std::vector<Eigen::Vector2d> corners_m() const {
    return {lower_left_m,
            {upper_right_m.x(), lower_left_m.y()},
            upper_right_m,
            {lower_left_m.x(), upper_right_m.y()}};
  }
  bool operator==(const BoardOutline&) const = default;
};

/// The printed board. Board frame: x right, y up, z out of the board towards the viewer.
/// AprilGrid: origin at the outer lower-left corner of the lowest tag; tags upright, ids grow
/// along x, then y; tag pitch = tag_size·(1 + tag_spacing); node (i, j) sits in the gap crossing
/// between columns i, i+1 and rows j, j+1 and has id j·(columns−1)+i.
/// Single AprilTag: origin at the outer lower-left corner of the tag.
/// Checkerboard: origin at the first inner corner, x along the columns, y along the rows.
/// ChArUco: as the checkerboard, seen upright; the first inner corner is the lower left one. Marker
/// ids grow from the top row on, from left to right, as OpenCV counts them.
struct Target {
  TargetType type = TargetType::kAprilGridCircles;

  // AprilGrid; a single AprilTag is a grid of one. Of a ChArUco board: dictionary, markers.
  std::string tag_family = "tag36h11";
  int tag_columns = 4;
  int tag_rows = 4;
  double tag_size_m = 0.12;     ///< Outer edge of the black border.
  double tag_spacing = 0.8333;  ///< Gap / tag size.
  int tag_border_bits = 1;      ///< Width of the black border in bits.
  int first_tag_id = 0;
  double circle_radius_m = 0.045;
  double margin_m = 0.06;  ///< White border beyond the outer tags.

  // Checkerboard and ChArUco: inner corners and square sizes; with the single AprilTag: outline,
  // and pattern centre − board centre.
  int corner_columns = 0;
  int corner_rows = 0;
  double column_spacing_m = 0.0;
  double row_spacing_m = 0.0;
  double board_width_m = 0.0;
  double board_height_m = 0.0;
  Eigen::Vector2d board_offset_m = Eigen::Vector2d::Zero();

  /// Colour of a checkerboard's lower left square. No file says it; the images do.
  bool white_first = false;
  /// ChArUco boards of OpenCV before 4.6 with an even number of square rows begin with a white
  /// square at the top left; all others with a black one.
  bool legacy_pattern = false;

  /// Relative standard deviation of the lengths above, where one of them was measured on the print;
  /// 0: nobody did.
  double size_sigma = 0.0;

  /// Fiducial tags or markers, whose ids and bits say which way up the board is.
  [[nodiscard]] bool has_tags() const { return type != TargetType::kCheckerboard; }
  [[nodiscard]] bool has_squares() const {
    return type == TargetType::kCheckerboard || type == TargetType::kCharuco;
  }
  [[nodiscard]] bool has_circles() const { return type == TargetType::kAprilGridCircles; }
  /// From one tag of a grid to the next; of a ChArUco board from one square to the next.
  [[nodiscard]] double tag_pitch_m() const;
  /// White between a tag and whatever black is next to it.
  [[nodiscard]] double tag_gap_m() const;
  /// Number of tags: tags().size().
  [[nodiscard]] int tag_count() const;
  /// Colour of a square; square (0, 0) has the first inner corner as its lower left.
  [[nodiscard]] bool square_is_black(int column, int row) const;
  /// Width of one bit of a tag.
  [[nodiscard]] double tag_bit_m() const;

  [[nodiscard]] std::vector<TargetTag> tags() const;
  [[nodiscard]] std::optional<TargetTag> tag(int id) const;
  /// The tag's outer corners: lower left, lower right, upper right, upper left (as seen upright).
  [[nodiscard]] std::vector<Eigen::Vector2d> tag_corners_m(const TargetTag& tag) const;
  [[nodiscard]] std::vector<TargetNode> nodes() const;
  /// Inner corners of the squares, row by row; none without squares.
  [[nodiscard]] std::vector<Eigen::Vector2d> checkerboard_corners_m() const;
  /// The edge of the physical board.
  [[nodiscard]] BoardOutline outline() const;

  /// Albedo of the print at a board point: 0 black, 1 white, nothing outside the outline.
  /// A point on an edge belongs to the black side.
  [[nodiscard]] std::optional<double> albedo(const Eigen::Vector2d& point_m) const;

  /// Rotations of the board by multiples of 90° about its centre that map the outline onto
  /// itself: 4 for a square board, 2 for a rectangular one.
  [[nodiscard]] int outline_symmetry() const;
};

/// The bits of a tag's data area; true is white.
/// Row 0 is the top row of the upright tag, column 0 its left column.
struct TagPattern {
  int width = 0;  ///< Data bits along a side (6 for tag36h11).
  std::vector<bool> white;
  [[nodiscard]] bool at(int row, int column) const {
    return white[static_cast<std::size_t>(row * width + column)];
  }
};

/// Pattern of one tag of tag36h11, tag36h10, tag25h9 or tag16h5, or of one marker of OpenCV's
/// predefined dictionaries (DICT_4X4_50 … DICT_APRILTAG_36h11; those of the AprilTag families are
/// turned by 180° against the families themselves); null for unknown family or id.
/// The pattern lives as long as the program.
const TagPattern* tag_pattern(const std::string& family, int id);

/// Number of tags in a family or dictionary; 0 for an unknown one.
int tag_family_size(const std::string& family);

/// Whether a name is that of one of OpenCV's predefined dictionaries.
bool is_marker_dictionary(const std::string& family);

/// Names of OpenCV's predefined dictionaries, in OpenCV's order.
const std::vector<std::string>& marker_dictionaries();

/// A target read from a file, with warnings about unknown keys.
struct TargetFile {
  Target target;
  std::vector<Message> warnings;
};

/// Reads target.yaml (Kalibr's AprilGrid and checkerboard keys, and ours).
Result<TargetFile> read_target(const std::filesystem::path& path);

/// The target as the text of a target.yaml that reads back as the same target.
std::string to_yaml(const Target& target);

/// Checks that sizes are positive, circles fit their gaps, ids exist in the family.
Status check(const Target& target);

}  // namespace lvcalib
