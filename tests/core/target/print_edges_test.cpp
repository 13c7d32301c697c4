// SPDX-License-Identifier: GPL-3.0-or-later
// What growing black does to a spot, against prints that have grown.
#include "target/print_edges.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "base/random.h"
#include "support/ordinary_boards.h"
#include "target/blurred_print.h"

namespace lvcalib {
namespace {

// Share of black in a spot, black grown all around by `growth`: a point is black if anything black
// lies within that distance. One point at random in each cell of a grid over four and a half
// widths.
double black_share(const Target& target, const Eigen::Vector2d& at, const Eigen::Matrix2d& root,
                   double growth) {
  constexpr int kSide = 201;
  constexpr int kRim = 16;
  Random random(7);
  double sum = 0.0;
  double all = 0.0;
  for (int i = 0; i < kSide; ++i) {
    for (int j = 0; j < kSide; ++j) {
      // One after the other: compilers differ in the order of arguments.
      const double column = i + random.uniform(0.0, 1.0);
      const double row = j + random.uniform(0.0, 1.0);
      const Eigen::Vector2d x(9.0 * column / kSide - 4.5, 9.0 * row / kSide - 4.5);
      const double weight = std::exp(-0.5 * x.squaredNorm());
      const Eigen::Vector2d p = at + root * x;
      bool black = target.albedo(p).value_or(1.0) < 0.5;
      for (int k = 0; k < kRim && !black; ++k) {
        const double angle = 2.0 * std::numbers::pi * k / kRim;
        const Eigen::Vector2d rim = p + growth * Eigen::Vector2d(std::cos(angle), std::sin(angle));
        black = target.albedo(rim).value_or(1.0) < 0.5;
      }
      all += weight;
      sum += black ? weight : 0.0;
    }
  }
  return sum / all;
}

void expect_growth(const Target& target, const Eigen::Matrix2d& root, std::uint64_t seed) {
  constexpr double kGrowth = 5e-4;
  const PrintEdges edges(target);
  Random random(seed);
  const BoardOutline outline = target.outline();
  int seen = 0;
  for (int k = 0; k < 60; ++k) {
    // Away from the outline, beyond which the print is white whatever grows.
    Eigen::Vector2d at;
    for (const int axis : {0, 1})
      at(axis) = outline.lower_left_m(axis) + outline.size_m()(axis) * random.uniform(0.1, 0.9);
    const double difference =
        (black_share(target, at, root, kGrowth) - black_share(target, at, root, 0.0)) / kGrowth;
    const double growth = edges.growth_per_m(at, root * root.transpose());
    // Chance, sixteen points for a rim (of eight it is up to 8 % too small), and the second order
    // in the growth (a sixth of a width).
    const double most = 0.4 / root.col(0).norm();
    EXPECT_NEAR(growth, difference, 0.1 * (most + growth)) << at.transpose();
    seen += growth > 0.3 * most ? 1 : 0;
  }
  EXPECT_GT(seen, 10);
}

TEST(PrintEdges, GrowAsAGrownPrintDoes) {
  Target circles;
  circles.tag_spacing = 0.1 / 0.12;
  const Eigen::Matrix2d round = 0.006 * Eigen::Matrix2d::Identity();
  Eigen::Matrix2d long_spot;
  long_spot << 0.008, 0.0, 0.003, 0.005;
  expect_growth(circles, round, 1);
  expect_growth(circles, long_spot, 2);
  expect_growth(test::charuco_target(), round, 3);
  Target squares;
  squares.type = TargetType::kCheckerboard;
  squares.corner_columns = 7;
  squares.corner_rows = 5;
  squares.column_spacing_m = squares.row_spacing_m = 0.095;
  squares.board_width_m = 0.85;
  squares.board_height_m = 0.65;
  expect_growth(squares, long_spot, 4);
}

// Beside one straight edge, or one circle, the growth is the slope of what is seen.
TEST(PrintEdges, OfOneEdgeIsTheSlopeOfThePrint) {
  Target target;
  target.tag_spacing = 0.1 / 0.12;
  const BlurredPrint print(target);
  const Eigen::Matrix2d blur = std::pow(0.004, 2) * Eigen::Matrix2d::Identity();
  const TargetNode node = target.nodes().front();
  for (const double off : {-0.004, -0.001, 0.0, 0.002, 0.005}) {
    const Eigen::Vector2d beside_circle =
        node.center_m + Eigen::Vector2d(target.circle_radius_m + off, 0.0);
    // The circle's own growth is steeper than its slope by half a width over its radius or less.
    const double slope = print.at(beside_circle, blur).gradient_per_m.norm();
    EXPECT_NEAR(print.edges().growth_per_m(beside_circle, blur) / slope, 1.0, 0.1) << off;
    const TargetTag tag = target.tags().front();
    const Eigen::Vector2d beside_tag =
        tag.center_m + Eigen::Vector2d(0.5 * target.tag_size_m + off, 0.0);
    EXPECT_NEAR(print.edges().growth_per_m(beside_tag, blur) /
                    print.at(beside_tag, blur).gradient_per_m.norm(),
                1.0, 0.01)
        << off;
  }
}

}  // namespace
}  // namespace lvcalib
