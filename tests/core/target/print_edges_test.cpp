// SPDX-License-Identifier: GPL-3.0-or-later
// What growing black does to a spot, against prints that have grown.
#include "target/print_edges.h"

#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "base/random.h"
#include "support/ordinary_boards.h"
#include "target/blurred_print.h"

namespace lvcalib {
namespace {

// Share of white in a spot, black grown all around by `growth` (shrunk where that is negative): a
// point has the other colour if anything of that lies within the distance. One point at random in
// each cell of a grid over four and a half widths.
double white_share(const Target& target, const Eigen::Vector2d& at, const Eigen::Matrix2d& root,
                   double growth) {
  constexpr int kSide = 121;
  constexpr int kRim = 32;
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
      const bool white = target.albedo(p).value_or(1.0) > 0.5;
      bool changes = false;
      for (int k = 0; k < kRim && !changes && white == (growth > 0.0); ++k) {
        const double angle = 2.0 * std::numbers::pi * k / kRim;
        const Eigen::Vector2d rim = p + growth * Eigen::Vector2d(std::cos(angle), std::sin(angle));
        changes = (target.albedo(rim).value_or(1.0) > 0.5) != white;
      }
      all += weight;
      sum += white != changes ? weight : 0.0;
    }
  }
  return sum / all;
}

std::vector<Eigen::Vector2d> places_on(const Target& target, int count, std::uint64_t seed) {
  Random random(seed);
  const BoardOutline outline = target.outline();
  std::vector<Eigen::Vector2d> out;
  for (int k = 0; k < count; ++k) {
    // Away from the outline, beyond which the print is white whatever grows.
    Eigen::Vector2d at;
    for (const int axis : {0, 1})
      at(axis) = outline.lower_left_m(axis) + outline.size_m()(axis) * random.uniform(0.1, 0.9);
    out.push_back(at);
  }
  return out;
}

void expect_growth(const Target& target, const Eigen::Matrix2d& root, std::uint64_t seed) {
  const BlurredPrint print(target);
  const Eigen::Matrix2d blur = root * root.transpose();
  int seen = 0;
  for (const Eigen::Vector2d& at : places_on(target, 16, seed)) {
    const PrintSample drawn = print.at(at, blur);
    const double sampled = white_share(target, at, root, 0.0);
    for (const double growth : {-0.002, 0.001, 0.003}) {
      PrintSample grown = drawn;
      print.edges().grow(at, blur, growth, grown);
      // The change: what the points miss of the print as drawn they miss of the grown one as well.
      const double change = white_share(target, at, root, growth) - sampled;
      EXPECT_NEAR(grown.white - drawn.white, change, 0.01)
          << at.transpose() << " grown by " << growth;
      seen += std::abs(change) > 0.05 ? 1 : 0;
    }
  }
  EXPECT_GT(seen, 4);
}

struct Print {
  Target target;
  Eigen::Matrix2d root;
};

std::vector<Print> prints() {
  Target circles;
  circles.tag_spacing = 0.1 / 0.12;
  const Eigen::Matrix2d round = 0.006 * Eigen::Matrix2d::Identity();
  Eigen::Matrix2d long_spot;
  long_spot << 0.008, 0.0, 0.003, 0.005;
  Target squares;
  squares.type = TargetType::kCheckerboard;
  squares.corner_columns = 7;
  squares.corner_rows = 5;
  squares.column_spacing_m = squares.row_spacing_m = 0.095;
  squares.board_width_m = 0.85;
  squares.board_height_m = 0.65;
  return {{circles, round},
          {circles, long_spot},
          {test::charuco_target(), round},
          {squares, long_spot}};
}

TEST(PrintEdges, GrowAsAGrownPrintDoes) {
  std::uint64_t seed = 1;
  for (const Print& p : prints()) expect_growth(p.target, p.root, seed++);
}

TEST(PrintEdges, DerivativesOfAGrownPrintAreNumericOnes) {
  constexpr double kStep = 1e-5;
  std::uint64_t seed = 11;
  for (const Print& p : prints()) {
    const PrintEdges edges(p.target);
    const Eigen::Matrix2d blur = p.root * p.root.transpose();
    const double width = p.root.row(0).norm();
    for (const Eigen::Vector2d& at : places_on(p.target, 40, seed++)) {
      for (const double growth : {-0.001, 0.002}) {
        // Of what the edges sweep alone, far from both ends of what can be seen of it.
        const auto swept = [&](const Eigen::Vector2d& place, double by) {
          PrintSample sample{0.5, Eigen::Vector2d::Zero(), Eigen::Matrix2d::Zero()};
          edges.grow(place, blur, by, sample);
          return sample;
        };
        PrintSample sample{0.5, Eigen::Vector2d::Zero(), Eigen::Matrix2d::Zero()};
        const double per_m = edges.grow(at, blur, growth, sample);
        if (sample.white < 0.01 || sample.white > 0.99) continue;
        const double slope =
            (swept(at, growth + kStep).white - swept(at, growth - kStep).white) / (2.0 * kStep);
        EXPECT_NEAR(-per_m, slope, 0.02 / width) << at.transpose();
        for (const int axis : {0, 1}) {
          const Eigen::Vector2d step = kStep * Eigen::Vector2d::Unit(axis);
          const PrintSample above = swept(at + step, growth);
          const PrintSample below = swept(at - step, growth);
          // Of a circle's strip to some hundredths: its bend is told to first order in the width
          // over the radius.
          EXPECT_NEAR(sample.gradient_per_m(axis), (above.white - below.white) / (2.0 * kStep),
                      0.005 / width)
              << at.transpose();
          const Eigen::Vector2d bent =
              (above.gradient_per_m - below.gradient_per_m) / (2.0 * kStep);
          EXPECT_LT((sample.hessian_per_m2.row(axis).transpose() - bent).norm(),
                    0.04 / (width * width))
              << at.transpose();
        }
      }
    }
  }
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
    PrintSample as_drawn;
    EXPECT_NEAR(print.edges().grow(beside_circle, blur, 0.0, as_drawn) / slope, 1.0, 0.1) << off;
    const TargetTag tag = target.tags().front();
    const Eigen::Vector2d beside_tag =
        tag.center_m + Eigen::Vector2d(0.5 * target.tag_size_m + off, 0.0);
    EXPECT_NEAR(print.edges().grow(beside_tag, blur, 0.0, as_drawn) /
                    print.at(beside_tag, blur).gradient_per_m.norm(),
                1.0, 0.01)
        << off;
  }
}

}  // namespace
}  // namespace lvcalib
