// SPDX-License-Identifier: GPL-3.0-or-later
#include "model/print_rows.h"

#include <cmath>

#include <gtest/gtest.h>

#include "support/synthetic_table.h"

namespace lvcalib {
namespace {

// A table without noise, seen by the first scene's tilted board.
class PrintRowsTest : public ::testing::Test {
 protected:
  PrintRowsTest() : made_(test::synthetic_table(recipe())) {}

  static test::TableRecipe recipe() {
    test::TableRecipe out;
    out.scenes = 1;
    out.range_rows = 40;
    out.range_sigma_m = out.edge_sigma_m = out.intensity_sigma = 1e-12;
    return out;
  }
  // A range measured so many widths of the spot outside the first circle's edge (inside: less than
  // zero), where the spot sees a trace of the other print.
  [[nodiscard]] RangeRow beside_edge(double widths) const {
    const BoundaryRow& edge = made_.table.boundary.front();
    const double distance = widths * edge.transition_m;
    const Eigen::Vector2d outward(std::cos(edge.psi_rad), std::sin(edge.psi_rad));
    const Eigen::Vector2d at = made_.table.target.nodes().front().center_m +
                               (made_.table.target.circle_radius_m + distance) * outward;
    const SceneGeometry g(made_.truth.camera_from_lidar, made_.truth.camera_from_board[0]);
    const Eigen::Vector3d p = g.lidar_from_board() * Eigen::Vector3d(at.x(), at.y(), 0.0);
    RangeRow row;
    EXPECT_TRUE(g.describe(p.normalized(), row.beam));
    row.beam.edge = NearEdge{distance, edge.psi_rad, edge.transition_m, true};
    row.beam.white = widths > 0.0 ? 1.0 : 0.0;
    row.beam.darkness = 1.0 - row.beam.white;
    row.measured_m = p.norm();
    row.sigma_m = 0.008;
    return row;
  }
  [[nodiscard]] double residual(const RangeRow& row, const std::vector<EffectInUse>& in_use) const {
    PrintRows rows(made_.table, made_.truth, 0, in_use);
    return rows.range(row).value().residual;
  }

  test::SyntheticTable made_;
};

// The light of a white edge outshines what black print sends back: it pulls the range there. A
// trace of black in a white spot takes next to nothing away.
TEST_F(PrintRowsTest, InkThatSpreadsMovesRangesOfBlackPrintBesideAnEdgeAlone) {
  const std::vector<EffectInUse> ink{
      {find_effect("ink_gain"), 0.0, Eigen::VectorXd::Constant(1, 3e-4)}};
  const RangeRow black = beside_edge(-2.0);
  EXPECT_GT(std::abs(residual(black, ink) - residual(black, {})), 1e-6);
  const RangeRow white = beside_edge(2.0);
  EXPECT_EQ(residual(white, ink), residual(white, {}));
  // In the middle of the edge it is no trace.
  RangeRow middle = beside_edge(0.3);
  middle.beam.edge->plain = false;
  EXPECT_GT(std::abs(residual(middle, ink) - residual(middle, {})), 1e-6);
}

// A return's range and its intensity are predicted once where they ask for the same: not where
// light comes from beside the place that is ranged.
TEST_F(PrintRowsTest, RowsOfOneReturnAreAsThoughAskedAlone) {
  const std::vector<EffectInUse> in_use{
      {find_effect("footprint_offset"), 0.0, Eigen::Vector2d(5e-4, -3e-4)},
      {find_effect("angle_scale"), 0.0, Eigen::Vector2d(1e-3, -2e-3)}};
  PrintRows together(made_.table, made_.truth, 0, in_use);
  for (const double widths : {-1.0, -0.5, 0.0, 0.5, 1.0}) {
    RangeRow range = beside_edge(widths);
    range.beam.edge->plain = false;
    const IntensityRow intensity{range.beam, Print::kWhite, 0.0, 0.1, {50.0, 100.0, {}}};
    const auto a = together.range(range);
    const auto b = together.intensity(intensity);
    PrintRows alone(made_.table, made_.truth, 0, in_use);
    ASSERT_TRUE(a && b);
    EXPECT_EQ(a->residual, residual(range, in_use));
    EXPECT_EQ(b->residual, alone.intensity(intensity).value().residual);
    EXPECT_EQ(together.by_parameters().size(), 4U);
  }
}

// Derivatives by the board's pose, against poses moved: 10⁻⁶ of a metre and of a radian.
TEST_F(PrintRowsTest, DerivativesByTheBoardsPoseAreThoseOfThePrediction) {
  constexpr double kStep = 1e-6;
  for (const double widths : {-0.5, 0.0, 0.5}) {
    RangeRow row = beside_edge(widths);
    row.beam.edge->plain = false;
    IntensityRow reading{row.beam, Print::kWhite, 0.0, 0.1, {50.0, 100.0, {}}};
    PrintRows here(made_.table, made_.truth, 0, {});
    const PrintRow range = here.range(row).value();
    const PrintRow intensity = here.intensity(reading).value();
    for (Eigen::Index k = 0; k < 6; ++k) {
      const auto moved_by = [&](double step) {
        return moved(made_.truth, Vector6d::Zero(), {step * Vector6d::Unit(k)});
      };
      const ModelState up = moved_by(kStep);
      const ModelState down = moved_by(-kStep);
      PrintRows above(made_.table, up, 0, {});
      PrintRows below(made_.table, down, 0, {});
      const double by_range =
          (below.range(row)->residual - above.range(row)->residual) / (2.0 * kStep);
      const double by_intensity =
          (below.intensity(reading)->residual - above.intensity(reading)->residual) / (2.0 * kStep);
      // The print's table is good to some thousandths of an edge's slope.
      EXPECT_NEAR(range.by_board_pose(k), by_range, 0.01 * (1.0 + std::abs(by_range)));
      EXPECT_NEAR(intensity.by_board_pose(k), by_intensity, 0.01 * (1.0 + std::abs(by_intensity)));
    }
  }
}

}  // namespace
}  // namespace lvcalib
