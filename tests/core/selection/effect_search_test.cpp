// SPDX-License-Identifier: GPL-3.0-or-later
#include "selection/effect_search.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <gtest/gtest.h>

#include "support/pose_matchers.h"
#include "support/synthetic_table.h"

namespace lvcalib {
namespace {

class SearchState : public ::testing::Test {
 protected:
  static test::SyntheticTable with_walk(double size_m) {
    test::Disturbance wrong;
    wrong.range_m = [size_m](const BeamPoint& beam) { return size_m * beam.darkness; };
    return test::synthetic_table({}, wrong);
  }
  [[nodiscard]] static std::string id_of(const EffectSearch& search, const Candidate& c) {
    return search.linear().columns.list()[c.columns].effect->info().id;
  }
  DiscoveryOptions options_;
  RunContext context_;
};

TEST_F(SearchState, RefitFindsTheTruthFromAWrongStart) {
  const auto made = test::synthetic_table({});
  ModelState start = made.truth;
  Random random(8);
  start.camera_from_lidar = test::disturbed(start.camera_from_lidar, random, 0.001, 0.0005);
  for (Rigid3& board : start.camera_from_board)
    board = test::disturbed(board, random, 0.0005, 0.0005);
  const EffectSearch search(made.table, start, options_, context_);
  EXPECT_LT(test::chi_square_of({search.state().camera_from_lidar,
                                 search.reference().fit.covariance.topLeftCorner<6, 6>().eval()},
                                made.truth.camera_from_lidar),
            22.5);
}

// Boards that moved between camera and LiDAR, one of which reads ranges with three times the noise
// that it states: what is stated stands where its own weights have it.
TEST_F(SearchState, WhatIsStatedStandsAtItsOwnEstimate) {
  constexpr double kMoved_m = 0.01;
  test::TableRecipe recipe;
  recipe.scenes = 8;
  recipe.range_rows = 400;
  auto made = test::synthetic_table(recipe);
  Random random(31);
  std::vector<double> moved(8);
  for (double& u : moved) u = kMoved_m * random.normal();
  for (RangeRow& row : made.table.range) {
    const auto s = static_cast<std::size_t>(row.beam.scene);
    row.measured_m += moved[s] / std::cos(row.beam.incidence_rad);
    if (s == 2) row.sigma_m /= 3.0;
  }
  made.table.structure_variances.assign(kAbsentVariance.begin(), kAbsentVariance.end());
  made.table.structure_variances[static_cast<std::size_t>(VarianceGroup::kBoardNormal)] =
      kMoved_m * kMoved_m;
  const EffectSearch search(made.table, made.truth, options_, context_);
  const auto stated = search.as_stated();
  ASSERT_TRUE(stated.has_value());
  const Vector6d apart =
      se3_log(stated->state().camera_from_lidar * search.state().camera_from_lidar.inverse());
  const Eigen::VectorXd sigma = stated->reference().fit.covariance.diagonal().cwiseSqrt();
  EXPECT_GT((apart.array().abs() / sigma.head<6>().array()).maxCoeff(), 0.3);
  EffectColumnsList columns;
  ColumnSubset subset;
  for (const EffectInUse& use : stated->model()) {
    columns.add(use.effect, use.shape, made.table);
    append_columns(columns.list().back(), &use.values, subset);
  }
  const Linearization linear =
      linearize(made.table, stated->state(), stated->model(), columns, context_);
  const ModelFit left = fit_model(linear, subset, stated->reference().fit.variances, {.rounds = 0});
  // Steps below half a standard deviation are not forced where they lower nothing.
  EXPECT_LT((left.solution.cwiseAbs().array() / sigma.array()).maxCoeff(), 0.5);
}

TEST_F(SearchState, AddedEffectsTakeTheirValueAndLeaveTheCandidates) {
  const auto made = with_walk(0.008);
  EffectSearch search(made.table, made.truth, options_, context_);
  search.rank();
  ASSERT_FALSE(search.candidates().empty());
  EXPECT_EQ(id_of(search, search.candidates().front()), "range_walk");
  ASSERT_TRUE(search.best().has_value());
  search.add(find_effect("range_walk"), 0.0);
  ASSERT_EQ(search.in_use().size(), 1U);
  EXPECT_NEAR(search.in_use()[0].values(0), 0.008, 0.0008);
  search.rank();
  for (const Candidate& c : search.candidates()) EXPECT_NE(id_of(search, c), "range_walk");
  EXPECT_FALSE(search.best().has_value());
}

// To first order, without a refit: what acts alike gains nothing, what explains nothing loses.
TEST_F(SearchState, SwapsAreForeseen) {
  const auto made = with_walk(0.008);
  EffectSearch search(made.table, made.truth, options_, context_);
  search.add(find_effect("range_walk"), 0.0);
  const auto swaps = search.swaps(0, {find_effect("range_walk"), find_effect("range_near")});
  ASSERT_EQ(swaps.size(), 2U);
  EXPECT_EQ(swaps[0].effect, find_effect("range_walk"));
  const auto total = [](const EffectSearch::Swap& swap) {
    return std::accumulate(swap.gain.begin(), swap.gain.end(), 0.0);
  };
  EXPECT_GT(total(swaps[0]), -1.0);
  EXPECT_LT(total(swaps[0]), 5.0);
  EXPECT_LT(total(swaps[1]), -30.0);
  // And it comes true.
  const auto density = [](const EffectSearch& of) {
    const auto& d = of.reference().density;
    return std::accumulate(d.begin(), d.end(), 0.0);
  };
  const double before = density(search);
  search.replace(0, swaps[1]);
  EXPECT_NEAR(density(search) - before, total(swaps[1]), 0.1 * std::abs(total(swaps[1])));
}

TEST_F(SearchState, RemovedEffectsLeaveNoTrace) {
  const auto made = with_walk(0.0);
  EffectSearch search(made.table, made.truth, options_, context_);
  const Rigid3 before = search.state().camera_from_lidar;
  search.add(find_effect("range_offset"), 0.0);
  search.remove(0);
  EXPECT_TRUE(search.in_use().empty());
  // To a twentieth of what the scenes determine.
  const Vector6d sigma = search.reference().fit.covariance.diagonal().head<6>().cwiseSqrt();
  const Vector6d moved = se3_log(search.state().camera_from_lidar * before.inverse());
  EXPECT_LT(moved.cwiseQuotient(sigma).norm(), 0.05);
}

TEST_F(SearchState, WhatIsNotThereIsSuperfluousAndWhatIsThereIsNot) {
  const auto made = with_walk(0.008);
  EffectSearch search(made.table, made.truth, options_, context_);
  search.add(find_effect("range_walk"), 0.0);
  EXPECT_FALSE(search.superfluous().has_value());
  search.add(find_effect("board_bow"), 0.0);
  const auto k = search.superfluous();
  ASSERT_TRUE(k.has_value());
  EXPECT_EQ(search.in_use()[*k].effect->info().id, "board_bow");
}

// Scenes held out are predicted better, but chance does as much among so many candidates: it would
// not be let in.
TEST_F(SearchState, WhatChanceReachesIsSuperfluous) {
  const auto made = with_walk(0.00015);
  EffectSearch search(made.table, made.truth, options_, context_);
  search.rank();
  const auto& tried = search.candidates();
  const auto walk = std::find_if(tried.begin(), tried.end(), [&](const Candidate& c) {
    return id_of(search, c) == "range_walk";
  });
  ASSERT_NE(walk, tried.end());
  ASSERT_TRUE(is_gain(walk->scene_gain));
  ASSERT_GT(walk->p_value * static_cast<double>(tried.size()), 1.5 * options_.false_alarm);
  const EffectColumns columns = columns_of(search, *walk);
  search.add(columns.effect, columns.shape);
  EXPECT_EQ(search.superfluous(), 0U);
}

TEST_F(SearchState, CandidatesComeBestFirst) {
  const auto made = with_walk(0.008);
  EffectSearch search(made.table, made.truth, options_, context_);
  search.rank();
  for (const Candidate& c : search.candidates()) {
    EXPECT_EQ(c.scene_gain.size(), made.table.scenes.size());
    EXPECT_GE(c.p_value, 0.0);
    EXPECT_LE(c.p_value, 1.0);
  }
  EXPECT_GT(search.candidates().front().total_gain(), search.candidates().back().total_gain());
  EXPECT_GT(search.candidates().front().best_heldout_gain(), 0.05);
}

TEST_F(SearchState, StopsWhenAsked) {
  const auto made = with_walk(0.008);
  std::stop_source source;
  source.request_stop();
  context_.stop = source.get_token();
  EffectSearch search(made.table, made.truth, options_, context_);
  search.rank();
  EXPECT_TRUE(search.candidates().empty());
  EXPECT_FALSE(search.best().has_value());
  EXPECT_FALSE(search.superfluous().has_value());
}

test::SyntheticTable with_ink(double ink_m) {
  test::Disturbance wrong;
  wrong.edge_m = [ink_m](const BoundaryRow&) { return ink_m; };
  return test::synthetic_table({}, wrong);
}

double blur_sigma(const EffectSearch& search) {
  const auto at = static_cast<Eigen::Index>(6);
  return std::sqrt(search.reference().fit.covariance(at, at));
}

TEST_F(SearchState, TheBlurIsMeasuredWithTheModelAndIsNoInk) {
  const auto made = with_ink(0.0);
  ModelState start = made.truth;
  start.beam.blur_rad2 *= 0.7;
  EffectSearch search(made.table, start, options_, context_);
  ASSERT_EQ(search.model().size(), 1U);
  const double sigma = blur_sigma(search);
  const double truth = test::kTableBeam_rad * test::kTableBeam_rad;
  EXPECT_NEAR(search.state().beam.blur_rad2(0, 0), truth, 4.0 * sigma);
  EXPECT_LT(sigma, 0.1 * truth);
  EXPECT_TRUE(search.in_use().empty());
  search.rank();
  EXPECT_FALSE(search.best().has_value());
}

TEST_F(SearchState, InkBesideTheBlurHasItsOwnSize) {
  const auto made = with_ink(0.0008);
  EffectSearch search(made.table, made.truth, options_, context_);
  search.add(find_effect("ink_gain"), 0.0);
  const double sigma = std::sqrt(search.reference().fit.covariance(6, 6));
  EXPECT_NEAR(search.in_use()[0].values(0), 0.0008, 3.0 * sigma);
  EXPECT_LT(sigma, 0.0002);
}

TEST_F(SearchState, InkIsFoundAsWhatMovesEdges) {
  const auto made = with_ink(-0.0004);
  EffectSearch search(made.table, made.truth, options_, context_);
  search.rank();
  const auto best = search.best();
  ASSERT_TRUE(best.has_value());
  const std::string id = id_of(search, search.candidates()[*best]);
  EXPECT_TRUE(id == "ink_gain" || id == "boundary_bias" || id == "blooming") << id;
}

// Near boards read wrong on one print only, as where a receiver saturates, or on both.
test::SyntheticTable near_boards_off(double white_m, double black_m) {
  test::Disturbance wrong;
  wrong.range_m = [=](const BeamPoint& beam) {
    const double near = std::exp(-(beam.range_m - 1.5) / 0.8);
    return near * (beam.darkness < 0.5 ? white_m : black_m);
  };
  return test::synthetic_table({}, wrong);
}

TEST_F(SearchState, WhatOnlyWhitePrintShowsIsNoEffectThatKnowsNoPrint) {
  const auto made = near_boards_off(-0.02, 0.0);
  EffectSearch search(made.table, made.truth, options_, context_);
  search.rank();
  const auto best = search.best();
  ASSERT_TRUE(best.has_value());
  const EffectColumns& found = search.linear().columns.list()[search.candidates()[*best].columns];
  EXPECT_EQ(found.effect->info().id, "receiver_saturation");
  search.add(found.effect, found.shape);
  search.rank();
  bool seen = false;
  for (const Candidate& c : search.candidates()) {
    if (id_of(search, c) != "range_near") continue;
    seen = true;
    EXPECT_FALSE(is_accepted(c, search.candidates().size(), made.table.scenes.size(), options_));
  }
  EXPECT_TRUE(seen);
}

// Ranges with a ripple over a covariate of the beam.
test::SyntheticTable with_ripple(std::uint64_t seed, double BeamPoint::*over) {
  test::Disturbance wrong;
  wrong.range_m = [over](const BeamPoint& beam) { return 0.003 * std::sin(20.0 * beam.*over); };
  test::TableRecipe recipe;
  recipe.range_rows = 4000;
  recipe.seed = seed;
  return test::synthetic_table(recipe, wrong);
}

// No effect of the catalogue follows the azimuth so; a ripple over the range happens to vary with
// it on these boards.
TEST_F(SearchState, WhatACurveTellsBetterIsNoEffect) {
  for (const std::uint64_t seed : {3, 4}) {
    const auto made = with_ripple(seed, &BeamPoint::azimuth_rad);
    EffectSearch search(made.table, made.truth, options_, context_);
    search.rank();
    EXPECT_FALSE(search.best().has_value());
    EXPECT_TRUE(std::any_of(
        search.candidates().begin(), search.candidates().end(), [&](const Candidate& c) {
          return id_of(search, c) == "range_cyclic" && c.contradiction == Contradiction::kCurve;
        }));
  }
}

// A curve over the range tells it as well, and no better.
TEST_F(SearchState, WhatACurveTellsAsWellStays) {
  for (const std::uint64_t seed : {3, 4}) {
    const auto made = with_ripple(seed, &BeamPoint::range_m);
    EffectSearch search(made.table, made.truth, options_, context_);
    search.rank();
    const auto best = search.best();
    ASSERT_TRUE(best.has_value());
    EXPECT_EQ(id_of(search, search.candidates()[*best]), "range_cyclic");
  }
}

// The corners show boards that are bent, the ranges a bump at one place and no bend.
TEST_F(SearchState, WhatLeavesABumpWhereItIsIsNoEffect) {
  test::Disturbance wrong;
  wrong.range_m = [](const BeamPoint& beam) {
    const Eigen::Vector2d from = beam.board_m - Eigen::Vector2d(0.2, 0.1);
    return -0.012 * std::exp(-0.5 * from.squaredNorm() / (0.06 * 0.06));
  };
  test::TableRecipe recipe;
  recipe.range_rows = 4000;
  recipe.corner_sigma_px = 0.02;
  auto made = test::synthetic_table(recipe, wrong);
  const BoardOutline outline = made.table.target.outline();
  for (CornerRow& row : made.table.corner) {
    const Rigid3& pose = made.truth.camera_from_board[static_cast<std::size_t>(row.scene)];
    const double across = (row.board_m - outline.center_m()).x() / (0.5 * outline.size_m().x());
    const Eigen::Vector3d flat(row.board_m.x(), row.board_m.y(), 0.0);
    const Eigen::Vector3d bent = flat + Eigen::Vector3d(0.0, 0.0, 0.003 * across * across);
    row.pixel += *made.table.camera.project(pose * bent) - *made.table.camera.project(pose * flat);
  }
  EffectSearch search(made.table, made.truth, options_, context_);
  search.rank();
  bool seen = false;
  for (const Candidate& c : search.candidates()) {
    if (id_of(search, c) != "board_bow") continue;
    seen = true;
    EXPECT_EQ(c.main_channel(), Channel::kCorner);
    EXPECT_EQ(c.contradiction, Contradiction::kPlace);
  }
  EXPECT_TRUE(seen);
  const auto best = search.best();
  EXPECT_FALSE(best && id_of(search, search.candidates()[*best]) == "board_bow");
}

// A ripple over the azimuth, at six boards, passes for some of one over range.
TEST_F(SearchState, WhatLeavesARippleOverAzimuthIsNoEffect) {
  test::Disturbance wrong;
  wrong.range_m = [](const BeamPoint& beam) { return 0.010 * std::sin(25.0 * beam.azimuth_rad); };
  const auto made = test::synthetic_table({}, wrong);
  EffectSearch search(made.table, made.truth, options_, context_);
  search.rank();
  bool seen = false;
  for (const Candidate& c : search.candidates()) {
    if (id_of(search, c) != "range_cyclic") continue;
    seen = true;
    EXPECT_EQ(c.contradiction, Contradiction::kPlace);
  }
  EXPECT_TRUE(seen);
  EXPECT_FALSE(search.best().has_value());
}

TEST_F(SearchState, WhatBothPrintsShowIsNotContradicted) {
  const auto made = near_boards_off(-0.02, -0.02);
  EffectSearch search(made.table, made.truth, options_, context_);
  search.rank();
  const auto best = search.best();
  ASSERT_TRUE(best.has_value());
  EXPECT_EQ(id_of(search, search.candidates()[*best]), "range_near");
  for (const Candidate& c : search.candidates())
    EXPECT_EQ(c.contradiction, Contradiction::kNone) << id_of(search, c);
}

// Within a scan of 0.1 s, with a decay of 0.03 s, 4 mm at the most: not an offset, nor a motion.
TEST_F(SearchState, ADriftWithinEveryScanIsNoMotion) {
  test::Disturbance wrong;
  wrong.range_m = [](const BeamPoint& beam) {
    return 0.004 * (1.0 - std::exp(-beam.time_s / 0.03));
  };
  const auto made = test::synthetic_table({}, wrong);
  EffectSearch search(made.table, made.truth, options_, context_);
  search.rank();
  const auto best = search.best();
  ASSERT_TRUE(best.has_value());
  const EffectColumns& found = search.linear().columns.list()[search.candidates()[*best].columns];
  ASSERT_EQ(found.effect->info().id, "range_drift");
  search.add(found.effect, found.shape);
  search.refine_shape(0);
  search.refine_shapes();
  const EffectInUse& use = search.in_use()[0];
  EXPECT_NEAR(use.shape, 0.03, 4.0 * search.shape_sigma(0));
  EXPECT_LT(search.shape_sigma(0), 0.01);
  EXPECT_NEAR(use.values(0), 0.004 / 0.03, 4.0 * std::sqrt(search.joint_covariance()(6, 6)));
  search.rank();
  EXPECT_FALSE(search.best().has_value());
}

// The grid follows the table: once that is made again, a shape that was on it lies beside it, and
// the truth may lie beyond the place of the grid that it was on.
TEST_F(SearchState, AShapeJustBesideTheGridIsRefinedToBothSides) {
  const EffectPtr effect = find_effect("range_near");
  const auto plain = test::synthetic_table({}, {});
  std::vector<double> grid = effect->shapes(plain.table);
  std::sort(grid.begin(), grid.end());
  ASSERT_GE(grid.size(), 4U);
  const double on_grid = grid[grid.size() / 2];
  const double truth = 0.6 * on_grid + 0.4 * grid[grid.size() / 2 - 1];
  test::Disturbance wrong;
  wrong.range_m = [truth](const BeamPoint& beam) { return 0.1 * std::exp(-beam.range_m / truth); };
  const auto made = test::synthetic_table({}, wrong);
  EffectSearch search(made.table, made.truth, options_, context_);
  search.add(effect, 1.001 * on_grid);
  search.refine_shapes();
  EXPECT_NEAR(search.in_use()[0].shape, truth, 4.0 * search.shape_sigma(0));
  EXPECT_LT(5.0 * search.shape_sigma(0), on_grid - truth);
}

// A near effect beside a walk between the prints: their sum contradicts neither.
TEST_F(SearchState, AConstantDifferenceBetweenPrintsIsNoContradiction) {
  test::Disturbance wrong;
  wrong.range_m = [](const BeamPoint& beam) {
    return -0.02 * std::exp(-(beam.range_m - 1.5) / 0.8) + 0.01 * beam.darkness;
  };
  const auto made = test::synthetic_table({}, wrong);
  EffectSearch search(made.table, made.truth, options_, context_);
  search.rank();
  for (const Candidate& c : search.candidates())
    EXPECT_EQ(c.contradiction, Contradiction::kNone) << id_of(search, c);
}

TEST_F(SearchState, WhatIsSureButFaintExplainsStructure) {
  test::Disturbance wrong;
  wrong.log_intensity = [](const IntensityRow& row) {
    return 0.22 * std::log(std::cos(row.beam.incidence_rad));
  };
  test::TableRecipe recipe;
  recipe.intensity_sigma = 0.02;
  recipe.range_rows = 4000;
  const auto made = test::synthetic_table(recipe, wrong);
  EffectSearch search(made.table, made.truth, options_, context_);
  search.rank();
  EXPECT_FALSE(search.best().has_value());
  const EffectSearch explained = search.with_faint();
  ASSERT_FALSE(explained.in_use().empty());
  EXPECT_EQ(explained.in_use()[0].effect->info().id, "intensity_geometry");
  EXPECT_TRUE(search.in_use().empty());
}

// Two lines clip white, as where a receiver saturates: the intensities of the two prints tell
// different stories, and edges, which are seen in them, move.
TEST_F(SearchState, EdgesFoundInDoubtfulIntensitiesTellNothing) {
  const auto clipped = [](const BeamPoint& beam) { return beam.line > 3 ? 1.0 : 0.0; };
  test::Disturbance wrong;
  wrong.log_intensity = [=](const IntensityRow& row) {
    return row.print == Print::kWhite ? -0.3 * clipped(row.beam) : 0.0;
  };
  wrong.edge_m = [=](const BoundaryRow& row) { return -0.001 * (0.5 + clipped(row.beam)); };
  const auto made = test::synthetic_table({}, wrong);
  EffectSearch search(made.table, made.truth, options_, context_);
  search.rank();
  bool seen = false;
  for (const Candidate& c : search.candidates()) {
    if (id_of(search, c) == "intensity_geometry") {
      EXPECT_EQ(c.contradiction, Contradiction::kPrints);
    }
    if (id_of(search, c) != "ink_gain") continue;
    seen = true;
    EXPECT_EQ(c.contradiction, Contradiction::kLevels);
  }
  EXPECT_TRUE(seen);
  // What clips white moves its edges with it.
  const auto best = search.best();
  ASSERT_TRUE(best.has_value());
  EXPECT_EQ(id_of(search, search.candidates()[*best]), "receiver_saturation");
}

TEST_F(SearchState, WhatBothPrintsLoseIsNoContradiction) {
  test::Disturbance wrong;
  wrong.log_intensity = [](const IntensityRow& row) { return -0.8 * std::log(row.beam.range_m); };
  wrong.edge_m = [](const BoundaryRow&) { return 0.0015; };
  const auto made = test::synthetic_table({}, wrong);
  EffectSearch search(made.table, made.truth, options_, context_);
  search.rank();
  for (const Candidate& c : search.candidates())
    EXPECT_EQ(c.contradiction, Contradiction::kNone) << id_of(search, c);
  EXPECT_TRUE(search.best().has_value());
}

// Where a channel misses by many times its noise, what explains a little of it is no explanation.
TEST_F(SearchState, ALensFlawIsNoDistortion) {
  test::Disturbance wrong;
  wrong.corner_px = [](const CornerRow& row) -> Eigen::Vector2d {
    const double from = (row.pixel - Eigen::Vector2d(640.0, 400.0)).squaredNorm();
    return std::exp(-0.5 * from / (90.0 * 90.0)) * Eigen::Vector2d(2.0, 1.0);
  };
  const auto made = test::synthetic_table({}, wrong);
  EffectSearch search(made.table, made.truth, options_, context_);
  search.rank();
  const auto& all = search.candidates();
  const auto distortion = std::find_if(all.begin(), all.end(), [&](const Candidate& c) {
    return id_of(search, c) == "distortion_residual";
  });
  ASSERT_NE(distortion, all.end());
  EXPECT_GT(distortion->total_gain(), 0.0);
  EXPECT_LT(distortion->explained_share, options_.min_explained);
  const auto best = search.best();
  EXPECT_TRUE(!best || all[*best].main_channel() != Channel::kCorner) << id_of(search, all[*best]);
}

}  // namespace
}  // namespace lvcalib
