// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "simulation/disturbances/board.h"
#include "target/target.h"

namespace lvcalib::simulation {

/// A target prepared for millions of look-ups: its print as flat tables, and a map of how far the
/// nearest edge is, so that footprints and pixels on a plain part need one look-up only.
class PrintedBoard {
 public:
  explicit PrintedBoard(const Target& target, const BoardDisturbance& disturbance = {});

  /// Reflectivities of the print in LiDAR and camera light.
  static constexpr double kBlack = 0.07;
  static constexpr double kWhite = 0.85;

  /// Reflectivity at a point of the board plane that lies within the outline; with black edges
  /// further out by `edge_shift_m` than they are printed.
  [[nodiscard]] double reflectivity(double x_m, double y_m, double edge_shift_m = 0.0) const {
    const bool white =
        edge_shift_m == 0.0 ? is_white(x_m, y_m) : is_white_beyond(edge_shift_m, {x_m, y_m});
    return white ? kWhite : kBlack;
  }
  /// Whether the print, as it came out, is white there.
  [[nodiscard]] bool is_white(double x_m, double y_m) const;

  [[nodiscard]] bool inside(double x_m, double y_m) const {
    return x_m >= outline_.lower_left_m.x() && x_m <= outline_.upper_right_m.x() &&
           y_m >= outline_.lower_left_m.y() && y_m <= outline_.upper_right_m.y();
  }

  /// A lower bound of the distance to the nearest edge of the print or of the board; 0 outside.
  [[nodiscard]] double clearance_m(double x_m, double y_m) const;

  [[nodiscard]] const Target& target() const { return target_; }
  [[nodiscard]] const BoardOutline& outline() const { return outline_; }
  /// The shape of the board's face.
  [[nodiscard]] const BoardDisturbance& shape() const { return disturbance_; }

 private:
  [[nodiscard]] bool drawn_white(double x_m, double y_m) const;
  [[nodiscard]] bool is_white_beyond(double edge_shift_m, Eigen::Vector2d point_m) const;
  // The corners of squares and of bits that are nearest to a point; twice the same where there is
  // one kind only. What is drawn there is asked of drawn_white().
  [[nodiscard]] std::array<Eigen::Vector2d, 2> nearest_corners(const Eigen::Vector2d& p) const;
  // Distance from the edge of the nearest circle as drawn, outside positive.
  [[nodiscard]] std::optional<double> from_circle_m(double x_m, double y_m) const;
  void lay_squares();
  [[nodiscard]] bool squares_are_white(double x_m, double y_m) const;
  [[nodiscard]] bool bit_is_white(int tag, double x_m, double y_m) const;
  void map_edges();

  Target target_;
  BoardDisturbance disturbance_;
  BoardOutline outline_;
  double pitch_m_ = 0.0;
  double bit_m_ = 0.0;
  int bits_ = 0;     // Along a side of a tag, border included.
  int columns_ = 0;  // Of tags or squares.
  int rows_ = 0;
  static constexpr int kBlackSquare = -1, kWhiteSquare = -2;
  std::vector<int> squares_;            // From the lower left; of a white one the marker's place.
  std::vector<std::uint8_t> tag_bits_;  // Tag by tag, from the lower left bit, row by row.
  double cell_m_ = 0.001;
  int cells_x_ = 0;
  int cells_y_ = 0;
  std::vector<float> clearance_cells_;
};

}  // namespace lvcalib::simulation
