// SPDX-License-Identifier: GPL-3.0-or-later
// The rows of the search, predicted from the print: derivatives against differences, and the fit
// without effects against the joint solve that it starts from.
#include "solve/print_table.h"

#include <cmath>
#include <memory>
#include <numbers>

#include <Eigen/Cholesky>
#include <gtest/gtest.h>

#include "forward_rig.h"
#include "model/beam_blur.h"
#include "model/mixed_model.h"
#include "model/residuals.h"

namespace lvcalib {
namespace {

using test::forward_rig;
using test::ForwardRig;

class PrintTable : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    auto options = test::cloud_only_options(72, simulation::LidarKind::kAvia);
    options.scenes = 3;
    options.target.tag_spacing = 0.1 / 0.12;
    jitter_rad_ = options.lidar.angle_sigma_deg * std::numbers::pi / 180.0;
    rig_ = forward_rig(options);
    const auto solved = test::solve(rig_, Vector6d::Zero());
    ASSERT_TRUE(solved) << solved.error().text();
    solution_ = *solved;
    TableInput input = input_of_rig();
    for (const ForwardScene& scene : rig_.scenes)
      input.scenes.push_back({{}, scene.corners, scene.board_points});
    state_ = {solution_.state.camera_from_lidar, solution_.state.camera_from_board,
              solution_.state.levels, solution_.state.beam};
    TableOptions how;
    how.max_rows_per_scene = 3000;
    table_ = print_table(input, state_, how, {});
  }

  // The scenes still to come.
  static TableInput input_of_rig() {
    return {.scenes = {},
            .camera = rig_.camera,
            .print = std::make_shared<const BlurredPrint>(rig_.target),
            .noise = solution_.noise,
            .sigma_px = test::kRigCornerSigma_px};
  }

  // Half the sum of squared residuals in σ, over all channels.
  static double half_squares(const ModelState& state, const std::vector<EffectInUse>& in_use) {
    double sum = 0.0;
    for (const Channel channel : kAllChannels) {
      const ChannelResiduals r = residuals_of(table_, state, in_use, channel);
      for (std::size_t k = 0; k < r.values.size(); ++k)
        sum += 0.5 * r.values[k] * r.values[k] / (r.sigma[k] * r.sigma[k]);
    }
    return sum;
  }

  // Of the linearisation: −∂(half the squares)/∂(column).
  static double gradient(const Linearization& linear, std::size_t scene, int column) {
    double sum = 0.0;
    for (const Eigen::MatrixXd& m : linear.scenes[scene].products) sum += m(column, m.cols() - 1);
    return sum;
  }

  static inline double jitter_rad_ = 0.0;
  static inline ForwardRig rig_;
  static inline ForwardSolution solution_;
  static inline ModelState state_;
  static inline MeasurementTable table_;
};

TEST_F(PrintTable, HasEveryKindOfRow) {
  EXPECT_EQ(table_.scenes.size(), 3U);
  EXPECT_GT(table_.range.size(), 5000U);
  EXPECT_GT(table_.intensity.size(), 5000U);
  EXPECT_GT(table_.boundary.size(), 2000U);
  EXPECT_GT(table_.corner.size(), 50U);
  EXPECT_TRUE(table_.has_intensity);
  for (const BoundaryRow& row : table_.boundary) {
    ASSERT_TRUE(row.beam.edge.has_value());
    EXPECT_GT(row.sigma_m, 0.0);
    // Outward is where white is.
    if (row.beam.edge->distance_m > row.transition_m) {
      EXPECT_LT(row.beam.darkness, 0.3);
    } else if (row.beam.edge->distance_m < -row.transition_m) {
      EXPECT_GT(row.beam.darkness, 0.3);
    }
  }
}

// What effects refer to stays, whatever the model is by then.
TEST_F(PrintTable, MadeAgainItRefersToTheSameLevels) {
  ModelState elsewhere = state_;
  elsewhere.camera_from_lidar.translation.x() += 0.001;
  const MeasurementTable again = table_.again(elsewhere, {}, {});
  EXPECT_EQ(again.log_contrast, table_.log_contrast);
  EXPECT_EQ(again.level, table_.level);
  EXPECT_EQ(again.lines, table_.lines);
  EXPECT_EQ(again.has_intensity, table_.has_intensity);
  EXPECT_EQ(again.has_time, table_.has_time);
  EXPECT_EQ(again.scenes.size(), table_.scenes.size());
  EXPECT_NEAR(static_cast<double>(again.range.size()), static_cast<double>(table_.range.size()),
              0.01 * static_cast<double>(table_.range.size()));
}

// The solve and the table of measurements leave out the same parts of a board.
TEST_F(PrintTable, APartOfTheBoardIsUsedAllTheSame) {
  Cloud stained = *rig_.scenes[0].board_points;
  const Eigen::Vector2d stain = rig_.target.outline().upper_right_m - Eigen::Vector2d(0.06, 0.09);
  for (std::size_t i = 0; i < stained.size(); ++i) {
    const Eigen::Vector3d p =
        rig_.lidar_from_board[0].inverse() * stained.points_m[i].cast<double>().eval();
    if ((p.head<2>() - stain).cwiseAbs().maxCoeff() < 0.04) stained.intensity[i] = 15.0F;
  }
  const auto ranges = [&](const Cloud& cloud, const std::vector<BoardOutline>& uncovered) {
    TableInput input = input_of_rig();
    for (const ForwardScene& scene : rig_.scenes)
      input.scenes.push_back({{}, scene.corners, scene.board_points});
    input.scenes[0].board_points = &cloud;
    input.scenes[0].uncovered = uncovered;
    TableOptions how;
    how.max_rows_per_scene = 1'000'000;
    return print_table(input, state_, how, {}).range.size();
  };
  const std::size_t clean = ranges(*rig_.scenes[0].board_points, {});
  EXPECT_LT(ranges(stained, {}) + 50, clean);
  EXPECT_EQ(ranges(stained, {rig_.target.outline()}), clean);
}

// Farther from the base model than any noise: what belongs to the board follows the model in force.
TEST_F(PrintTable, MadeAgainItHasTheReturnsThatTheModelPredicts) {
  constexpr double kOffset_m = 0.12;
  std::vector<Cloud> far;
  for (const ForwardScene& scene : rig_.scenes) {
    far.push_back(*scene.board_points);
    for (Eigen::Vector3f& p : far.back().points_m)
      p *= 1.0F + static_cast<float>(kOffset_m) / p.norm();
  }
  TableInput input = input_of_rig();
  for (std::size_t s = 0; s < far.size(); ++s)
    input.scenes.push_back({{}, rig_.scenes[s].corners, &far[s]});
  TableOptions how;
  how.max_rows_per_scene = 3000;
  const auto table = print_table(input, state_, how, {});
  EXPECT_LT(table.range.size(), table_.range.size() / 10);
  const std::vector<EffectInUse> in_use{
      {find_effect("range_offset"), 0.0, Eigen::VectorXd::Constant(1, kOffset_m)}};
  const MeasurementTable again = table.again(state_, in_use, {});
  EXPECT_NEAR(static_cast<double>(again.range.size()), static_cast<double>(table_.range.size()),
              0.01 * static_cast<double>(table_.range.size()));
  EXPECT_NEAR(static_cast<double>(again.boundary.size()),
              static_cast<double>(table_.boundary.size()),
              0.01 * static_cast<double>(table_.boundary.size()));
}

// A model that the solve's jitter had to stand in for explains what it stood in for.
TEST_F(PrintTable, MadeAgainItMeasuresTheJitterAgain) {
  ModelState wide = state_;
  wide.beam.jitter_rad2 = 0.5 * state_.beam.blur_rad2;
  const MeasurementTable again = table_.again(wide, {}, {});
  const Eigen::Matrix2d& jitter = again.placed_by.beam.jitter_rad2;
  const double truth = std::pow(jitter_rad_, 2);
  EXPECT_NEAR(jitter(0, 0), truth, 0.2 * truth);
  EXPECT_NEAR(jitter(1, 1), truth, 0.2 * truth);
}

TEST_F(PrintTable, RowsAreAsNoisyAsStated) {
  for (const Channel channel : {Channel::kRange, Channel::kIntensity, Channel::kBoundary}) {
    const ChannelResiduals r = residuals_of(table_, state_, {}, channel);
    double sum = 0.0;
    for (std::size_t k = 0; k < r.values.size(); ++k)
      sum += r.values[k] * r.values[k] / (r.sigma[k] * r.sigma[k]);
    EXPECT_NEAR(sum / static_cast<double>(r.values.size()), 1.0, 0.2) << name_of(channel);
  }
}

TEST_F(PrintTable, DerivativesByPoseAndLevelsAreThoseOfTheResiduals) {
  const Linearization linear = linearize(table_, state_, {}, {}, {});
  for (std::size_t s = 0; s < state_.levels.size(); ++s) {
    for (int k = 0; k < LocalLayout::kFixed; ++k) {
      const auto at = [&](double step) {
        ModelState moved_state = state_;
        if (k < 6) {
          Vector6d xi = Vector6d::Zero();
          xi(k) = step;
          moved_state.camera_from_board[s] = se3_exp(xi) * moved_state.camera_from_board[s];
        } else {
          BoardLevels& l = moved_state.levels[s];
          (k == 6 ? l.white : k == 7 ? l.black : l.slope(k - 8)) += step;
        }
        return half_squares(moved_state, {});
      };
      const double h = k < 6 ? 1e-6 : 1e-3;
      const double numeric = -(at(h) - at(-h)) / (2.0 * h);
      double scale = 0.0;
      for (const Eigen::MatrixXd& m : linear.scenes[s].products) scale += m(k, k);
      // In units of the column's own length: a unit is what noise of one row does.
      EXPECT_NEAR(gradient(linear, s, k) / std::sqrt(scale), numeric / std::sqrt(scale), 0.05)
          << "scene " << s << " column " << k;
    }
  }
}

TEST_F(PrintTable, DerivativesByEffectsAreThoseOfTheResiduals) {
  for (const EffectPtr& effect : effect_catalogue()) {
    if (!why_not_testable(*effect, table_).empty()) continue;
    EffectColumnsList columns;
    columns.add(effect, effect->shapes(table_).front(), table_);
    const Linearization linear = linearize(table_, state_, {}, columns, {});
    const EffectColumns& c = columns.list().front();
    for (int k = 0; k < std::min(2, c.count()); ++k) {
      double analytic = 0.0;
      double scale = 0.0;
      for (std::size_t s = 0; s < linear.scenes.size(); ++s) {
        const int column = linear.scenes[s].layout.size() + 6 + k;
        analytic += gradient(linear, s, column);
        for (const Eigen::MatrixXd& m : linear.scenes[s].products) scale += m(column, column);
      }
      if (!(scale > 0.0)) continue;
      const double h = 1e-2 / std::sqrt(scale);
      const auto at = [&](double step) {
        EffectInUse use{effect, c.shape, Eigen::VectorXd::Zero(c.count())};
        use.values(k) = step;
        return half_squares(state_, {use});
      };
      const double numeric = -(at(h) - at(-h)) / (2.0 * h);
      EXPECT_NEAR(analytic / std::sqrt(scale), numeric / std::sqrt(scale), 0.05)
          << effect->info().id << ' ' << c.parameters[static_cast<std::size_t>(k)].name;
    }
  }
}

TEST_F(PrintTable, TheFitWithoutEffectsStaysWhereTheJointSolveEnded) {
  // Errors of the sensor that the joint solve takes in are effects of the search.
  for (std::size_t k = kSceneErrors; k < kSharedErrors; ++k)
    ASSERT_FALSE(solution_.noise.admitted[k]) << k;
  EffectColumnsList columns;
  columns.add(beam_blur(), 0.0, table_);
  const Linearization linear = linearize(table_, state_, {}, columns, {});
  ColumnSubset subset;
  for (int k = 0; k < 3; ++k) {
    subset.columns.push_back(k);
    subset.prior_sigma.push_back(1e-4);
    subset.prior_mean.push_back(0.0);
  }
  ModelVariances start;
  std::copy_n(table_.structure_variances.begin(), kVarianceGroups, start.group.begin());
  const ModelFit fit = fit_model(linear, subset, start, {});
  // The table has a part of the rows: by chance their answer is off by less than its own σ.
  for (Eigen::Index k = 0; k < 6; ++k)
    EXPECT_LT(std::abs(fit.solution(k)), 1.5 * std::sqrt(fit.covariance(k, k))) << k;
}

}  // namespace
}  // namespace lvcalib
