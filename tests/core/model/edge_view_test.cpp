// SPDX-License-Identifier: GPL-3.0-or-later
#include "model/edge_view.h"

#include <cmath>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace lvcalib {
namespace {

constexpr double kEdgeRadius = 0.045;
constexpr double kEdgeTransition = 0.006;

// A point that lies so far outside the edge of the circle in the board's origin.
BoardHit hit(double distance_m, double psi_rad, int line, double time_s = 0.0,
             const Eigen::Vector2d& scan_rad_s = {1.0, 0.0}) {
  BoardHit out;
  out.beam.board_m =
      (kEdgeRadius + distance_m) * Eigen::Vector2d(std::cos(psi_rad), std::sin(psi_rad));
  out.beam.edge = NearEdge{distance_m, psi_rad, kEdgeTransition};
  out.beam.line = line;
  out.beam.time_s = time_s;
  out.beam.scan_rad_s = scan_rad_s;
  return out;
}

// The row of an edge found where it is printed, as the hits within 0.1 rad about ψ = 0 saw it.
BoundaryRow seen(const std::vector<BoardHit>& hits, double crossing_m = 0.0) {
  TargetNode node;
  node.center_m = Eigen::Vector2d::Zero();
  BoundaryRow row;
  row.radius_m = kEdgeRadius;
  row.beam.board_m = {kEdgeRadius + crossing_m, 0.0};
  row.beam.line = -1;
  EdgeView(hits, {node}, kEdgeRadius, {}).describe(0, {0.0, 0.1}, row);
  return row;
}

double share_of(const BoundaryRow& row, int line) {
  for (const LineShare& s : row.lines)
    if (s.line == line) return s.share;
  return 0.0;
}

// φ²(1) / φ²(0) = 1/e.
TEST(EdgeView, PointsCountByWhatTheySayAboutTheEdge) {
  const auto row = seen({hit(0.0, 0.0, 3, 1.0, {4.0, 0.0}), hit(kEdgeTransition, 0.05, 5, 2.0)});
  const double near = 1.0 / (1.0 + 1.0 / std::numbers::e);
  EXPECT_NEAR(share_of(row, 3), near, 1e-9);
  EXPECT_NEAR(share_of(row, 5), 1.0 - near, 1e-9);
  EXPECT_EQ(row.beam.line, 3);
  EXPECT_NEAR(row.beam.time_s, near + 2.0 * (1.0 - near), 1e-9);
  EXPECT_NEAR(row.beam.scan_rad_s.x(), 4.0 * near + (1.0 - near), 1e-9);
}

TEST(EdgeView, NearIsMeantFromTheEdgeThatWasFound) {
  const std::vector<BoardHit> hits{hit(0.0, 0.0, 3), hit(kEdgeTransition, 0.05, 5)};
  EXPECT_EQ(seen(hits, kEdgeTransition).beam.line, 5);
}

TEST(EdgeView, PointsOutsideTheBinAndOffTheEdgesSayNothing) {
  BoardHit plain = hit(0.0, 0.0, 9);
  plain.beam.edge.reset();
  const auto row = seen({hit(0.0, 0.09, 3), hit(0.0, 0.11, 5), hit(0.0, 3.1, 6), plain});
  ASSERT_EQ(row.lines.size(), 1U);
  EXPECT_EQ(row.lines[0].line, 3);
}

TEST(EdgeView, TheBinAcrossThePolarAnglesEndIsOne) {
  TargetNode node;
  BoundaryRow row;
  row.radius_m = kEdgeRadius;
  row.beam.board_m = {-kEdgeRadius, 0.0};
  EdgeView({hit(0.0, 3.1, 1), hit(0.0, -3.1, 2)}, {node}, kEdgeRadius, {})
      .describe(0, {std::numbers::pi, 0.1}, row);
  EXPECT_EQ(row.lines.size(), 2U);
}

TEST(EdgeView, AVelocityThatIsNotKnownIsLeftOutOfTheMean) {
  const auto row =
      seen({hit(0.0, 0.0, 1, 0.0, {4.0, 2.0}), hit(0.0, 0.01, 1, 0.0, Eigen::Vector2d::Zero())});
  EXPECT_NEAR((row.beam.scan_rad_s - Eigen::Vector2d(4.0, 2.0)).norm(), 0.0, 1e-12);
}

TEST(EdgeView, WhereNobodyLookedTheRowStaysAsItIs) {
  const auto row = seen({});
  EXPECT_TRUE(row.lines.empty());
  EXPECT_EQ(row.beam.line, -1);
}

}  // namespace
}  // namespace lvcalib
