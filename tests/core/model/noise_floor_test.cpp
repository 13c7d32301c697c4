// SPDX-License-Identifier: GPL-3.0-or-later
#include "model/noise_floor.h"

#include <cmath>

#include <gtest/gtest.h>

#include "support/ordinary_boards.h"
#include "support/synthetic_table.h"

namespace lvcalib {
namespace {

TEST(ReplicateSigma, IsTheNoiseOfNeighboursWhateverSmoothLiesBelow) {
  Random random(5);
  std::vector<Eigen::Vector2d> at;
  std::vector<double> values;
  std::vector<int> strata;
  for (int k = 0; k < 20'000; ++k) {
    at.push_back({random.uniform(0.0, 0.7), random.uniform(0.0, 0.7)});
    strata.push_back(k % 2);
    // A wave of 20 mm, and a step between the strata.
    values.push_back(0.02 * std::sin(10.0 * at.back().x()) + 0.05 * (k % 2) +
                     0.006 * random.normal());
  }
  EXPECT_NEAR(replicate_sigma(at, values, strata, 0.003, 60), 0.006, 0.0004);
}

TEST(ReplicateSigma, IsZeroWithoutEnoughPairs) {
  const std::vector<Eigen::Vector2d> at = {{0.0, 0.0}, {0.001, 0.0}, {0.5, 0.5}};
  EXPECT_EQ(replicate_sigma(at, {1.0, 2.0, 3.0}, {0, 0, 0}, 0.003, 60), 0.0);
  EXPECT_EQ(replicate_sigma({}, {}, {}, 0.003, 1), 0.0);
}

TEST(CornerNoise, IsThatOfSingleCornersWhateverMovesTagsAsAWhole) {
  test::TableRecipe recipe;
  recipe.corner_sigma_px = 0.08;
  recipe.seed = 2;
  test::Disturbance wrong;
  wrong.corner_px = [](const CornerRow& row) -> Eigen::Vector2d {
    // Every tag its own shift, and corners pushed away from their tag's centre.
    const Eigen::Vector2d shift(std::sin(3.0 * row.feature), std::cos(5.0 * row.feature));
    return 0.5 * shift + 0.3 * row.from_tag_px.normalized();
  };
  const auto made = test::synthetic_table(recipe, wrong);
  EXPECT_NEAR(corner_noise(made.table, made.truth, 1.0), 0.08, 0.01);
}

// What moves them changes little from one square to the next: tilted and bent by some pixels.
TEST(CornerNoise, OfACheckerboardIsThatOfNeighboursWhateverBendsThem) {
  auto made = test::synthetic_table({}, {});
  made.table.target = test::checkerboard_target();
  made.table.corner.clear();
  const int columns = made.table.target.corner_columns;
  const int rows = made.table.target.corner_rows;
  Random random(3);
  for (int scene = 0; scene < static_cast<int>(made.truth.camera_from_board.size()); ++scene) {
    for (int feature = 0; feature < rows * columns; ++feature) {
      CornerRow row;
      row.scene = scene;
      row.feature = feature;
      const int x = feature % columns;
      const int y = feature / columns;
      row.board_m = 0.05 * Eigen::Vector2d(x, y);
      const auto p =
          made.table.camera.project(made.truth.camera_from_board[static_cast<std::size_t>(scene)] *
                                    Eigen::Vector3d(row.board_m.x(), row.board_m.y(), 0.0));
      ASSERT_TRUE(p);
      row.pixel = *p + Eigen::Vector2d(0.5 * y * y, 3.0 * x + 0.2 * x * x) +
                  0.08 * Eigen::Vector2d(random.normal(), random.normal());
      made.table.corner.push_back(row);
    }
  }
  EXPECT_NEAR(corner_noise(made.table, made.truth, 1.0), 0.08, 0.012);
}

TEST(CornerNoise, IsTheOneGivenWhereTooFewCornersTell) {
  auto made = test::synthetic_table({}, {});
  made.table.corner.resize(8);
  EXPECT_EQ(corner_noise(made.table, made.truth, 0.07), 0.07);
}

// A few close pairs tell a standard deviation badly: farther ones are asked until it is known to
// some per cent, but not beyond centimetres as long as there are close ones.
TEST(Replicates, AskForAsManyPairsAsTellTheNoise) {
  double squares = 0.0;
  constexpr int kTrials = 20;
  for (std::uint64_t seed = 1; seed <= kTrials; ++seed) {
    Random random(seed);
    Replicates replicates;
    // 3000 points on half a square metre: some hundred neighbours within 3 mm, thousands within 24.
    for (int i = 0; i < 3000; ++i) {
      BeamPoint beam;
      beam.line = 0;
      beam.board_m = {random.uniform(0.0, 0.7), random.uniform(0.0, 0.7)};
      replicates.add(beam, 0.01 * random.normal());
    }
    squares += std::pow(replicates.sigma() / 0.01 - 1.0, 2);
  }
  EXPECT_LT(std::sqrt(squares / kTrials), 0.045) << "sixty pairs tell nine per cent";
}

TEST(Replicates, TooFewPairsTellNothing) {
  Replicates replicates;
  for (int i = 0; i < 50; ++i) {
    BeamPoint beam;
    beam.line = 0;
    beam.board_m = {0.001 * i, 0.0};
    replicates.add(beam, i);
  }
  EXPECT_EQ(replicates.sigma(), 0.0);
}

}  // namespace
}  // namespace lvcalib
