// SPDX-License-Identifier: GPL-3.0-or-later
#include "model/table_builder.h"

#include <cmath>

#include <gtest/gtest.h>

#include "support/synthetic_table.h"

namespace lvcalib {
namespace {

// Scenes whose points lie on the board with noise, refined without error.
class Board : public ::testing::Test {
 protected:
  static constexpr double kSigma = 0.006;

  void make(int scenes, int points, bool intensity = true) {
    state_.camera_from_lidar = test::test_extrinsic();
    Random random(11);
    clouds_.resize(static_cast<std::size_t>(scenes));
    refinements_.resize(static_cast<std::size_t>(scenes));
    for (int s = 0; s < scenes; ++s) {
      state_.camera_from_board.push_back(test::table_board(target_, s));
      const SceneGeometry g(state_.camera_from_lidar, state_.camera_from_board.back());
      Cloud& cloud = clouds_[static_cast<std::size_t>(s)];
      const BoardOutline o = target_.outline();
      for (int k = 0; k < points; ++k) {
        const Eigen::Vector2d xy(random.uniform(o.lower_left_m.x(), o.upper_right_m.x()),
                                 random.uniform(o.lower_left_m.y(), o.upper_right_m.y()));
        const Eigen::Vector3d p = g.lidar_from_board() * Eigen::Vector3d(xy.x(), xy.y(), 0.0);
        const double r = p.norm() + kSigma * random.normal();
        cloud.points_m.push_back((r * p.normalized()).cast<float>());
        const double level = target_.albedo(xy).value_or(1.0) < 0.5 ? 12.0 : 120.0;
        if (intensity)
          cloud.intensity.push_back(static_cast<float>(level * std::exp(0.05 * random.normal())));
      }
      BoardRefinement& refined = refinements_[static_cast<std::size_t>(s)];
      refined.lidar_from_board = g.lidar_from_board();
      const Eigen::Matrix3d R = g.lidar_from_board().rotation.toRotationMatrix();
      refined.plane.axis_u = R.col(0);
      refined.plane.axis_v = R.col(1);
      refined.plane.normal = R.col(2);
      refined.plane.center_m = g.lidar_from_board().translation;
      refined.plane.group_sigma_m = {kSigma, kSigma, 0.0, 0.0};
      refined.plane.sigma_range_m = kSigma;
      refined.footprint_m2 = 4e-6 * Eigen::Matrix2d::Identity();
    }
  }

  [[nodiscard]] MeasurementTable build(const TableOptions& options = {}) const {
    std::vector<SceneMeasurements> scenes;
    for (std::size_t s = 0; s < clouds_.size(); ++s) {
      Random random(100 + s);
      scenes.push_back({std::string(1, static_cast<char>('A' + s)),
                        test::observed_corners(target_, test::test_camera(),
                                               state_.camera_from_board[s], 0.05, random),
                        &refinements_[s], &clouds_[s]});
    }
    return build_table(scenes, target_, test::test_camera(), state_, 0.05, options);
  }

  Target target_;
  ModelState state_;
  std::vector<Cloud> clouds_;
  std::vector<BoardRefinement> refinements_;
};

TEST_F(Board, PrintIsDecidedByGeometryAndLevelsAreThoseOfTheScenes) {
  make(2, 30'000);
  const MeasurementTable table = build();
  EXPECT_NEAR(table.level_of(Print::kWhite), 120.0, 1.0);
  EXPECT_NEAR(table.level_of(Print::kBlack), 12.0, 0.1);
  EXPECT_NEAR(table.level_of(Print::kCircle), 12.0, 0.3);
  EXPECT_NEAR(table.log_contrast, std::log(10.0), 0.02);
  ASSERT_GT(table.range.size(), 1000U);
  for (const RangeRow& row : table.range) {
    const bool black = target_.albedo(row.beam.board_m).value_or(1.0) < 0.5;
    EXPECT_EQ(row.print != Print::kWhite, black);
    if (!row.beam.edge) {
      EXPECT_NEAR(row.beam.darkness, black ? 1.0 : 0.0, 0.05);
    }
  }
}

TEST_F(Board, NoiseComesFromReplicates) {
  make(1, 60'000);
  for (const RangeRow& row : build().range) EXPECT_NEAR(row.sigma_m, kSigma, 0.1 * kSigma);
}

TEST_F(Board, RowsAreThinnedEvenlyOverTheBoard) {
  make(1, 60'000);
  TableOptions options;
  options.max_rows_per_scene = 2000;
  const MeasurementTable table = build(options);
  EXPECT_LE(table.range.size(), 2000U);
  EXPECT_GT(table.range.size(), 1000U);
  std::array<int, 4> quarters{};
  const Eigen::Vector2d c = target_.outline().center_m();
  for (const RangeRow& row : table.range)
    ++quarters[(row.beam.board_m.x() > c.x() ? 1U : 0U) + (row.beam.board_m.y() > c.y() ? 2U : 0U)];
  for (const int n : quarters) EXPECT_NEAR(n, table.range.size() / 4.0, 0.1 * table.range.size());
}

TEST_F(Board, PointsFarOffTheBoardAreNotOnIt) {
  make(1, 20'000);
  const std::size_t before = build().range.size();
  for (std::size_t i = 0; i < 500; ++i) clouds_[0].points_m[i] *= 1.05F;
  const MeasurementTable table = build();
  EXPECT_LT(table.range.size(), before);
  for (const RangeRow& row : table.range)
    EXPECT_LT(std::abs(row.measured_m - row.beam.range_m), 6.01 * kSigma);
}

TEST_F(Board, FieldsThatCloudsLackAreNotThere) {
  make(2, 8'000, false);
  const MeasurementTable table = build();
  EXPECT_FALSE(table.has_intensity);
  EXPECT_FALSE(table.has_time);
  EXPECT_TRUE(table.lines.empty());
  EXPECT_TRUE(table.intensity.empty());
  EXPECT_TRUE(table.boundary.empty());
  EXPECT_FALSE(table.range.empty());
}

TEST_F(Board, CornersKnowTheirTag) {
  make(2, 4'000);
  const MeasurementTable table = build();
  ASSERT_EQ(table.corner.size(), 2U * 64U);
  EXPECT_EQ(table.scenes[1].features.size(), 16U);
  EXPECT_EQ(table.scenes[0].clock, 0.0);
  EXPECT_EQ(table.scenes[1].clock, 1.0);
  for (const CornerRow& row : table.corner) {
    EXPECT_NEAR(row.from_tag_m.norm(), target_.tag_size_m / std::sqrt(2.0), 1e-9);
    EXPECT_GT(row.from_tag_px.norm(), 5.0);
    EXPECT_NEAR(row.sigma_px, 0.05, 0.02);
  }
}

}  // namespace
}  // namespace lvcalib
