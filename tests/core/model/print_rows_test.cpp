// SPDX-License-Identifier: GPL-3.0-or-later
#include "model/print_rows.h"

#include <cmath>

#include <gtest/gtest.h>

#include "model/catalogue_effect.h"
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

// The same beside a receiver that clips all white print, whose prediction follows the white under
// the beam: by the pose, by print that is displaced and by the effect's own values.
TEST_F(PrintRowsTest, DerivativesBesideASaturatedReceiverAreThoseOfThePrediction) {
  constexpr double kStep = 1e-6;
  for (const double jitter_share : {0.0, 0.5}) {
    for (const double widths : {-1.0, -0.5, 0.0, 0.5, 1.0}) {
      RangeRow row = beside_edge(widths);
      row.beam.edge->plain = false;
      row.beam.jitter_share = jitter_share;
      row.beam.white = 0.5;  // As though chosen before the print moved.
      IntensityRow reading{row.beam, Print::kWhite, 0.0, 0.1, {50.0, 100.0, {}}};
      const double limit = log_power(row.beam.range_m, row.beam.incidence_rad) + std::log(0.6);
      const auto saturated = [&](double a, double c) {
        return std::vector<EffectInUse>{
            {find_effect("receiver_saturation"), limit, Eigen::Vector2d(a, c)}};
      };
      const auto in_use = saturated(0.02, 0.8);
      PrintRows here(made_.table, made_.truth, 0, in_use);
      const PrintRow range = here.range(row).value();
      const auto range_by = here.by_parameters();
      const PrintRow intensity = here.intensity(reading).value();
      const auto intensity_by = here.by_parameters();
      const auto expect = [&](double stated, double above, double below) {
        const double numeric = (below - above) / (2.0 * kStep);
        EXPECT_NEAR(stated, numeric, 0.01 * (1.0 + std::abs(numeric)))
            << widths << " widths from the edge, jitter " << jitter_share;
      };
      for (Eigen::Index k = 0; k < 6; ++k) {
        const auto moved_by = [&](double step) {
          return moved(made_.truth, Vector6d::Zero(), {step * Vector6d::Unit(k)});
        };
        const ModelState up = moved_by(kStep);
        const ModelState down = moved_by(-kStep);
        PrintRows above(made_.table, up, 0, in_use);
        PrintRows below(made_.table, down, 0, in_use);
        expect(range.by_board_pose(k), above.range(row)->residual, below.range(row)->residual);
        expect(intensity.by_board_pose(k), above.intensity(reading)->residual,
               below.intensity(reading)->residual);
      }
      for (std::size_t k = 0; k < 2; ++k) {
        const Eigen::Vector2d step = kStep * Eigen::Vector2d::Unit(static_cast<Eigen::Index>(k));
        const auto more = saturated(0.02 + step(0), 0.8 + step(1));
        const auto less = saturated(0.02 - step(0), 0.8 - step(1));
        PrintRows above(made_.table, made_.truth, 0, more);
        PrintRows below(made_.table, made_.truth, 0, less);
        expect(range_by[k].range_m, above.range(row)->residual, below.range(row)->residual);
        expect(intensity.print.of(intensity_by[k]), above.intensity(reading)->residual,
               below.intensity(reading)->residual);
      }
    }
  }
}

// Not with the white that the row had when it was chosen.
TEST_F(PrintRowsTest, WhatASaturatedReceiverShowsFollowsThePredictedWhite) {
  RangeRow row = beside_edge(0.5);
  row.beam.edge->plain = false;
  const double limit = log_power(row.beam.range_m, row.beam.incidence_rad) + std::log(0.6);
  const std::vector<EffectInUse> in_use{
      {find_effect("receiver_saturation"), limit, Eigen::Vector2d(0.02, 0.8)}};
  const auto intensity = [&](double white) {
    IntensityRow reading{row.beam, Print::kWhite, 0.0, 0.1, {50.0, 100.0, {}}};
    reading.beam.white = white;
    PrintRows rows(made_.table, made_.truth, 0, in_use);
    return rows.intensity(reading)->residual;
  };
  EXPECT_NEAR(intensity(0.3), intensity(0.9), 1e-12);
  RangeRow other = row;
  other.beam.white = 0.3;
  EXPECT_NEAR(residual(row, in_use), residual(other, in_use), 1e-12);
  EXPECT_GT(std::abs(residual(row, in_use) - residual(row, {})), 1e-3);
}

}  // namespace
}  // namespace lvcalib
