// SPDX-License-Identifier: GPL-3.0-or-later
#include "model/catalogue_effect.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "support/synthetic_table.h"

namespace lvcalib {
namespace {

TEST(AngleAxes, AreTheDerivativesOfThePoint) {
  const auto point = [](double az, double el) {
    return Eigen::Vector3d(3.0 * Eigen::Vector3d(std::cos(el) * std::cos(az),
                                                 std::cos(el) * std::sin(az), std::sin(el)));
  };
  BeamPoint beam;
  beam.range_m = 3.0;
  beam.azimuth_rad = 0.7;
  beam.elevation_rad = -0.4;
  const AngleAxes axes = angle_axes(beam);
  constexpr double kStep = 1e-6;
  const Eigen::Vector3d by_az =
      (point(0.7 + kStep, -0.4) - point(0.7 - kStep, -0.4)) / (2.0 * kStep) / std::cos(-0.4);
  const Eigen::Vector3d by_el =
      (point(0.7, -0.4 + kStep) - point(0.7, -0.4 - kStep)) / (2.0 * kStep);
  EXPECT_LT((axes.azimuth_m - by_az).norm(), 1e-8);
  EXPECT_LT((axes.elevation_m - by_el).norm(), 1e-8);
}

TEST(LidarAngle, IsAUnitVectorOrZero) {
  BoundaryRow row;
  row.edge_normal_rad = {-3.0, 4.0};
  EXPECT_EQ(lidar_angle_of(row), Eigen::Vector2d(-0.6, 0.8));
  row.edge_normal_rad.setZero();
  EXPECT_TRUE(lidar_angle_of(row).isZero());
}

TEST(OnePerLine, NamesEveryLineAndFindsItsPlace) {
  MeasurementTable table;
  table.lines = {1, 4, 9};
  const auto parameters = one_per_line(table, {"a", "mm", 1e-3, 2e-3, 0.03});
  ASSERT_EQ(parameters.size(), 3U);
  EXPECT_EQ(parameters[2].name, "a9");
  EXPECT_EQ(line_index(table, 4), 1U);
  EXPECT_EQ(line_index(table, 5), std::numeric_limits<std::size_t>::max());
  EXPECT_EQ(line_index(table, 12), std::numeric_limits<std::size_t>::max());
}

TEST(UnitSquare, HasTheOutlineAtOne) {
  const Target target;
  const BoardOutline outline = target.outline();
  EXPECT_LT((on_unit_square(outline.upper_right_m, target) - Eigen::Vector2d(1, 1)).norm(), 1e-12);
  EXPECT_LT((on_unit_square(outline.lower_left_m, target) + Eigen::Vector2d(1, 1)).norm(), 1e-12);
  EXPECT_LT(on_unit_square(outline.center_m(), target).norm(), 1e-12);
}

TEST(PeriodGrid, NeighboursDifferByAQuarterTurnAtMost) {
  const auto made = test::synthetic_table({});
  double low = 1e9;
  double high = 0.0;
  for (const RangeRow& row : made.table.range) {
    low = std::min(low, row.beam.range_m);
    high = std::max(high, row.beam.range_m);
  }
  const auto periods = period_grid(made.table);
  ASSERT_GT(periods.size(), 10U);
  EXPECT_DOUBLE_EQ(periods.front(), 0.05);
  EXPECT_LE(periods.back(), 1.0);
  EXPECT_GT(periods.back(), 0.5);
  for (std::size_t k = 1; k < periods.size(); ++k) {
    const double turns = (high - low) * (1.0 / periods[k - 1] - 1.0 / periods[k]);
    EXPECT_GT(turns, 0.0);
    EXPECT_LE(turns, 0.2501);
  }
}

TEST(EdgePull, ActsNearEdgesOnlyAndTurnsItsSignAcrossTheTilt) {
  MeasurementTable table;
  table.level = {100.0, 20.0};
  BeamPoint beam;
  beam.incidence_rad = 0.7;
  EXPECT_EQ(edge_pull(beam, table), 0.0);
  beam.edge = NearEdge{0.003, 0.0, 0.01};
  const double outwards = edge_pull(beam, table);
  EXPECT_GT(outwards, 0.0);
  // Where the brighter outside lies nearer, ranges are too short.
  beam.edge->psi_rad = M_PI;
  EXPECT_NEAR(edge_pull(beam, table), -outwards, 1e-15);
  beam.edge->distance_m = 0.05;
  EXPECT_EQ(edge_pull(beam, table), 0.0);
  beam.edge = NearEdge{0.003, 0.0, 0.01};
  beam.incidence_rad = 0.0;
  EXPECT_EQ(edge_pull(beam, table), 0.0);
}

}  // namespace
}  // namespace lvcalib
