// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>

#include "target/target.h"

namespace lvcalib {

/// The share of white A in what a Gaussian spot sees of the print: A = print ⊗ N(0, S), 1 on white
/// and 0 on black, with its gradient and Hessian on the board.
struct PrintSample {
  double white = 1.0;
  Eigen::Vector2d gradient_per_m = Eigen::Vector2d::Zero();
  Eigen::Matrix2d hessian_per_m2 = Eigen::Matrix2d::Zero();
};

/// All edges between black and white of a print, for what moves every one of them outwards alike:
/// ink that spreads, a receiver that sees black too large.
class PrintEdges {
 public:
  explicit PrintEdges(const Target& target);

  /// Makes what a Gaussian spot of covariance S sees of the print what it sees once all black has
  /// grown by a length all around (shrunk where that is negative): takes the share of the strips
  /// away that the edges sweep. A straight edge sweeps (Φ(u₁) − Φ(u₀))·(Φ(b) − Φ(a)), u across it
  /// from the old to the new place and a, b along it between its ends, by the conditional Gaussian
  /// at the middle of the strip. Corners turn round as they grow and stay sharp as they shrink,
  /// which lengthens or shortens the strips. A circle's strip is a straight one's, longer by
  /// √(R/ρ). Good to a hundredth of the contrast for growths up to half the spot's width and a
  /// quarter of the narrowest print. Returns −∂A/∂growth there (1/m), at least 0.
  double grow(const Eigen::Vector2d& board_m, const Eigen::Matrix2d& blur_m2, double growth_m,
              PrintSample& sample) const;

 private:
  // Along x or y from `from` to `to`, at `at` of the other coordinate.
  struct Segment {
    int axis = 0;
    double at = 0.0, from = 0.0, to = 0.0;
    double outward = 1.0;  // −1 if black lies at the larger side.
    // Whose corners stand at both ends: black's (1), white's (−1), both's (0).
    double turn_from = 0.0, turn_to = 0.0;
  };
  // A Gaussian spot as edges along an axis see it: its width across them, and what it is along
  // them, given the place across: that moves on by `slope`, its width is `along`.
  struct Spot {
    Spot(const Eigen::Matrix2d& blur_m2, int axis);
    double across, slope, along;
    double reach_across;  // Beyond which no edge is asked, rounding included.
  };
  static double sweep(const Segment& segment, const Eigen::Vector2d& board_m, const Spot& spot,
                      double growth_m, PrintSample& sample);
  double sweep_circle(const Eigen::Vector2d& from_center_m, const Eigen::Matrix2d& blur_m2,
                      double growth_m, PrintSample& sample) const;
  template <class IsBlack>
  void add_grid(const Eigen::Vector2d& origin, const Eigen::Vector2d& cell, int columns, int rows,
                const IsBlack& is_black);
  // The segments and circles that may matter in one cell of the board, in their order.
  struct Nearby {
    std::array<std::vector<int>, 2> segments;  // Along x, and along y.
    std::vector<int> circles;
  };
  [[nodiscard]] std::vector<Nearby> within(double reach_m) const;
  [[nodiscard]] std::size_t cell_of(const Eigen::Vector2d& board_m) const;

  std::vector<Segment> segments_;
  std::vector<double> at_;  // Of the segments, side by side: most are farther than a spot reaches.
  std::vector<Eigen::Vector2d> circles_;
  double radius_m_ = 0.0;
  Eigen::Vector2d origin_ = Eigen::Vector2d::Zero();
  int columns_ = 0, rows_ = 0;      // Of the board's cells.
  std::vector<Nearby> near_, far_;  // To small spots, and to all.
};

}  // namespace lvcalib
