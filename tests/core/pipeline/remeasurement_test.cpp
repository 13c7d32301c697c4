// SPDX-License-Identifier: GPL-3.0-or-later
// Tables made again for a model, on simulated scans: points come from the whole pipeline.
#include "model/remeasurement.h"

#include <cmath>

#include <gtest/gtest.h>

#include "discovery/model_session.h"
#include "model/residuals.h"
#include "pipeline/model_discovery.h"
#include "support/effect_rigs.h"
#include "support/hidden_answer.h"
#include "support/hidden_rig.h"

namespace lvcalib {
namespace {

// A rig whose lines look a milliradian past where they say, with the model that says so.
class Remeasurement : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    const test::HiddenRig rig(61, {{"channel_angle_offset", 1.0}});
    ASSERT_TRUE(rig.ok());
    // The table of circles' edges, as made where the returns could not be solved.
    DiscoveryInput input = discovery_input(rig.result());
    input.print = nullptr;
    table_ = table_of(input, {});
    truth_.camera_from_lidar = rig.rig().camera_from_lidar;
    for (const auto& scene : rig.rig().scenes)
      truth_.camera_from_board.push_back(scene.camera_from_board);
    const EffectPtr effect = find_effect("channel_angle_offset");
    const auto parameters = effect->parameters(table_);
    const auto values = test::true_parameters("channel_angle_offset", rig.rig());
    lines_ = {effect, 0.0, Eigen::VectorXd(static_cast<Eigen::Index>(parameters.size()))};
    for (std::size_t k = 0; k < parameters.size(); ++k)
      lines_.values(static_cast<Eigen::Index>(k)) = values.at(parameters[k].name);
  }

  // RMS distance (m) of the edges from what the model predicts at the truth.
  static double edge_rms(const MeasurementTable& table) {
    const auto r = residuals_of(table, truth_, {lines_}, Channel::kBoundary);
    double sum = 0.0;
    for (const double value : r.values) sum += value * value;
    return std::sqrt(sum / static_cast<double>(r.values.size()));
  }

  static double edge_floor(const ModelStep& step) {
    return test::summary_of(step.channels, Channel::kBoundary).noise_floor;
  }

  static inline MeasurementTable table_;
  static inline ModelState truth_;
  static inline EffectInUse lines_;
  RunContext context_;
};

TEST_F(Remeasurement, AreSharperAndWhereTheModelHasThem) {
  const auto again = remeasure_edges(table_, truth_, {lines_}, context_);
  ASSERT_TRUE(again.has_value());
  EXPECT_GT(again->boundary.size(), table_.boundary.size() * 8 / 10);
  EXPECT_LT(edge_rms(*again), 0.75 * edge_rms(table_));
  double before = 0.0;
  double after = 0.0;
  for (const BoundaryRow& row : table_.boundary) before += row.sigma_m;
  for (const BoundaryRow& row : again->boundary) after += row.sigma_m;
  EXPECT_LT(after / static_cast<double>(again->boundary.size()),
            0.75 * before / static_cast<double>(table_.boundary.size()));
}

TEST_F(Remeasurement, LeaveAllElseAsItWas) {
  const auto again = remeasure_edges(table_, truth_, {lines_}, context_);
  ASSERT_TRUE(again.has_value());
  ASSERT_EQ(again->range.size(), table_.range.size());
  for (std::size_t k = 0; k < table_.range.size(); ++k)
    ASSERT_EQ(again->range[k].measured_m, table_.range[k].measured_m);
  EXPECT_EQ(again->corner.size(), table_.corner.size());
  EXPECT_EQ(again->source, table_.source);
}

// With values of no size the edges are the same edges, but for bins that other points fall into.
TEST_F(Remeasurement, NothingTakenOutChangesNothing) {
  EffectInUse none = lines_;
  none.values.setZero();
  EXPECT_FALSE(remeasure_edges(table_, truth_, {none}, context_).has_value());
  const auto again = remeasure_edges(table_, truth_, {none}, context_, 0.0);
  ASSERT_TRUE(again.has_value());
  EXPECT_NEAR(edge_rms(*again) / edge_rms(table_), 1.0, 0.1);
}

TEST_F(Remeasurement, NeedEffectsThatPartPoints) {
  const EffectInUse scale{find_effect("angle_scale"), 0.0, Eigen::VectorXd::Constant(2, 0.01)};
  EXPECT_FALSE(remeasure_edges(table_, truth_, {scale}, context_).has_value());
  EXPECT_FALSE(remeasure_edges(table_, truth_, {}, context_).has_value());
}

TEST_F(Remeasurement, NeedWhatTheyWereMeasuredWith) {
  MeasurementTable bare = table_;
  bare.source = nullptr;
  EXPECT_FALSE(remeasure_edges(bare, truth_, {lines_}, context_).has_value());
  std::stop_source stop;
  stop.request_stop();
  context_.stop = stop.get_token();
  EXPECT_FALSE(remeasure_edges(table_, truth_, {lines_}, context_).has_value());
}

// The share of points whose intensity is that of the other print.
double misplaced(const MeasurementTable& table) {
  const double middle =
      0.5 * (std::log(table.level_of(Print::kWhite)) + std::log(table.level_of(Print::kBlack)));
  double wrong = 0.0;
  for (const IntensityRow& row : table.intensity)
    wrong += (row.print == Print::kWhite) == (row.log_intensity < middle) ? 1.0 : 0.0;
  return wrong / static_cast<double>(table.intensity.size());
}

TEST_F(Remeasurement, PointsArePlacedByTheStateOfTheModel) {
  ModelState off = truth_;
  off.camera_from_lidar.translation += Eigen::Vector3d(0.015, 0.015, 0.0);
  const MeasurementTable wrong = rebuild_table(table_, off);
  EXPECT_GT(misplaced(wrong), 0.02);
  const auto again = remeasured(wrong, truth_, {}, context_);
  ASSERT_NE(again, nullptr);
  EXPECT_LT(misplaced(*again), 0.005);
  EXPECT_EQ(again->source, table_.source);
  EXPECT_EQ(remeasured(*again, truth_, {}, context_), nullptr);
  EXPECT_TRUE(is_outdated(wrong, truth_, {}));
  EXPECT_FALSE(is_outdated(*again, truth_, {}));
  EXPECT_TRUE(is_outdated(*again, truth_, {lines_}));  // Its values may still move.
}

TEST_F(Remeasurement, ComeAndGoWithTheEffectInAModelMadeByHand) {
  const auto start = start_model(table_, truth_, {}, context_);
  ASSERT_TRUE(start.ok()) << start.error().text();
  EXPECT_EQ((*start)->remeasured, nullptr);
  const auto with = add_effect(*start, "channel_angle_offset", std::nullopt, context_);
  ASSERT_TRUE(with.ok()) << with.error().text();
  ASSERT_NE((*with)->remeasured, nullptr);
  EXPECT_EQ(&(*with)->table(), (*with)->remeasured.get());
  EXPECT_LT(edge_floor(**with), 0.75 * edge_floor(**start));
  const auto without = remove_effect(*with, 0, context_);
  ASSERT_TRUE(without.ok()) << without.error().text();
  EXPECT_EQ((*without)->remeasured, nullptr);
  EXPECT_NEAR(edge_floor(**without), edge_floor(**start), 1e-9);
}

}  // namespace
}  // namespace lvcalib
