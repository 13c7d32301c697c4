// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <Eigen/Core>

#include "target/target.h"

namespace lvcalib {

/// All edges between black and white of a print, for what moves every one of them outwards alike:
/// ink that spreads, a receiver that sees black too large.
class PrintEdges {
 public:
  explicit PrintEdges(const Target& target);

  /// By how much the share of black in a Gaussian spot grows if all black grows by one metre, 1/m:
  /// the spot's density integrated along the edges. Of a straight segment exact (the density across
  /// times what the conditional Gaussian along has between its ends); of a circle that of a spot
  /// as wide as this one is across the edge, (R/σ²)·exp(−(ρ²+R²)/2σ²)·I₀(ρR/σ²).
  [[nodiscard]] double growth_per_m(const Eigen::Vector2d& board_m,
                                    const Eigen::Matrix2d& blur_m2) const;

 private:
  // Along x or y from `from` to `to`, at `at` of the other coordinate.
  struct Segment {
    int axis = 0;
    double at = 0.0, from = 0.0, to = 0.0;
  };
  template <class IsBlack>
  void add_grid(const Eigen::Vector2d& origin, const Eigen::Vector2d& cell, int columns, int rows,
                const IsBlack& is_black);
  void fill_cells(const BoardOutline& outline);
  [[nodiscard]] std::size_t cell_of(const Eigen::Vector2d& board_m) const;

  std::vector<Segment> segments_;
  std::vector<Eigen::Vector2d> circles_;
  double radius_m_ = 0.0;
  // Which segments and circles may matter in each cell of the board.
  Eigen::Vector2d origin_ = Eigen::Vector2d::Zero();
  int columns_ = 0, rows_ = 0;
  std::vector<std::vector<int>> near_segments_, near_circles_;
};

}  // namespace lvcalib
