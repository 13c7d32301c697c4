// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "cloud/cloud.h"
#include "target/target.h"

namespace lvcalib {

/// Standard deviations of single ranges on plain white and plain black print.
struct RangeNoise {
  double white_m = 0.01;
  double black_m = 0.01;
};

/// A return whose ray meets the board.
struct PlacedReturn {
  std::uint32_t point = 0;  ///< In the cloud.
  Eigen::Vector2d board_m = Eigen::Vector2d::Zero();
  double off_m = 0.0;    ///< Measured range − that of the board's plane.
  double sigma_m = 0.0;  ///< Of one range on the print there.
  double white = 1.0;    ///< Share of white that its spot sees.
  double reach_m = 0.0;  ///< Farther from something that covers the board it sees nothing of it.
};

/// Where something stands before a board or lies on it, as square cells.
class CoveredCells {
 public:
  explicit CoveredCells(const BoardOutline& outline);
  void cover(const Eigen::Vector2d& board_m, double radius_m);
  [[nodiscard]] bool covers(const Eigen::Vector2d& board_m) const;
  /// The parts that hang together, as boxes about them.
  [[nodiscard]] std::vector<Eigen::AlignedBox2d> patches() const;

 private:
  [[nodiscard]] int column(double x) const;
  [[nodiscard]] int row(double y) const;
  [[nodiscard]] std::size_t place(int c, int r) const;
  Eigen::Vector2d low_;
  int columns_, rows_;
  std::vector<std::uint8_t> covered_;
  bool any_ = false;
};

/// Covers what lies beside returns that are too near and stand together: a post before the board of
/// which the cloud about the board has only the spots that are half on it. `near`: returns that are
/// nearer than nearly any on the board (kTooNear); `kept`: those that may stay.
void cover_crowds(const std::vector<PlacedReturn>& near, const std::vector<PlacedReturn>& kept,
                  const BoardOutline& outline, CoveredCells& covered);

/// A return nearer by so many standard deviations is one of 30 000 of Gaussian noise: rare enough
/// that a few side by side are no chance, frequent among those that are half on something.
inline constexpr double kTooNear = 4.0;

/// Covers small parts of plain print that contradict the rest of the board: those that stand out of
/// it by a centimetre (a hand, a strap), once what lines, prints and a bent board do to ranges is
/// taken out; and white that is darker than the middle between white and black, or black that is
/// lighter (dirt, tape, a torn tag). Where more than a quarter of the board contradicts, the board
/// is not where it is taken to be, and nothing is covered.
void cover_patches(const std::vector<PlacedReturn>& kept, const Cloud& cloud,
                   const BoardOutline& outline, CoveredCells& covered);

}  // namespace lvcalib
