// SPDX-License-Identifier: GPL-3.0-or-later
// Effects hidden in simulated rigs by the simulator's own physics, found through images and clouds.
// Small versions of the study of hidden effects.
#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "pipeline/model_discovery.h"
#include "report/discovery_file.h"
#include "support/hidden_rig.h"
#include "support/pose_matchers.h"

namespace lvcalib {
namespace {

using ::testing::Contains;
using ::testing::IsEmpty;

const EffectFinding& finding(const Discovery& discovery, const std::string& id) {
  const auto at = std::find_if(discovery.effects.begin(), discovery.effects.end(),
                               [&](const EffectFinding& f) { return f.id == id; });
  EXPECT_NE(at, discovery.effects.end()) << id;
  return *at;
}

std::vector<std::string> with_aliases(const Discovery& discovery) {
  std::vector<std::string> out = discovery.selected;
  for (const std::string& id : discovery.selected) {
    const auto& aliases = finding(discovery, id).aliases;
    out.insert(out.end(), aliases.begin(), aliases.end());
  }
  return out;
}

// The footprint of every simulated scan has a size and is not round.
std::vector<std::string> beyond_the_footprint(std::vector<std::string> selected) {
  std::erase_if(selected, [](const std::string& id) {
    return id == "beam_divergence" || id == "footprint_anisotropy";
  });
  return selected;
}

const ChannelSummary& channel(const std::vector<ChannelSummary>& all, Channel which) {
  const auto at = std::find_if(all.begin(), all.end(),
                               [&](const ChannelSummary& c) { return c.channel == which; });
  EXPECT_NE(at, all.end());
  return *at;
}

struct HiddenCase {
  std::string id;
  double planted = 0.0;  // simulator's unit
  Channel channel = Channel::kRange;
  std::optional<double> parameter;  // the first one, SI, where both sides mean the same number
};
std::ostream& operator<<(std::ostream& out, const HiddenCase& c) {
  return out << c.id;
}

class Hidden : public ::testing::TestWithParam<HiddenCase> {};

TEST_P(Hidden, IsFoundMeasuredAndTakenOut) {
  const HiddenCase& c = GetParam();
  const test::HiddenRig rig(41, {{c.id, c.planted}});
  ASSERT_TRUE(rig.ok());
  const auto discovery = discover(rig.result(), {}, {});
  ASSERT_TRUE(discovery.ok()) << discovery.error().text();
  SCOPED_TRACE(discovery_summary(*discovery));
  EXPECT_THAT(with_aliases(*discovery), Contains(c.id));
  EXPECT_LE(beyond_the_footprint(discovery->selected).size(), 1U)
      << ::testing::PrintToString(discovery->selected);
  const EffectFinding& f = finding(*discovery, c.id);
  EXPECT_THAT(f.verdict, ::testing::AnyOf(EffectVerdict::kPresent, EffectVerdict::kAliased));
  if (c.parameter && f.verdict == EffectVerdict::kPresent) {
    ASSERT_FALSE(f.parameters.empty());
    EXPECT_NEAR(f.parameters[0].value, *c.parameter, 3.0 * f.parameters[0].sigma);
  }
  const ChannelSummary& before = channel(discovery->channels, c.channel);
  const ChannelSummary& after = channel(discovery->history.back().channels, c.channel);
  // Floors are estimates themselves: medians of replicates, good to a few per cent.
  EXPECT_LT(after.unexplained, std::max(0.1 * before.unexplained, 0.4 * after.noise_floor));
  EXPECT_LT(after.heldout_rms, 1.08 * after.noise_floor);
  EXPECT_LT(after.heldout_rms, before.heldout_rms);
  EXPECT_LT(rig.error_m(discovery->state.camera_from_lidar),
            rig.error_m(rig.result().extrinsic.camera_from_lidar.transform) + 5e-4);
}

INSTANTIATE_TEST_SUITE_P(
    Single, Hidden,
    ::testing::Values(HiddenCase{"range_offset", 20.0, Channel::kRange, 0.02},
                      HiddenCase{"range_walk", 10.0, Channel::kRange, std::nullopt},
                      HiddenCase{"range_incidence", 8.0, Channel::kRange, 0.008},
                      HiddenCase{"channel_range_offset", 10.0, Channel::kRange, std::nullopt},
                      HiddenCase{"corner_bias", 0.3, Channel::kCorner, 0.3},
                      HiddenCase{"print_scale", 3000.0, Channel::kCorner, 0.003}),
    [](const auto& info) { return info.param.id; });

TEST(HiddenPair, BothAreFound) {
  const test::HiddenRig rig(42, {{"range_walk", 10.0}, {"rolling_shutter", 2.0}});
  ASSERT_TRUE(rig.ok());
  const auto discovery = discover(rig.result(), {}, {});
  ASSERT_TRUE(discovery.ok()) << discovery.error().text();
  SCOPED_TRACE(discovery_summary(*discovery));
  const auto found = with_aliases(*discovery);
  EXPECT_THAT(found, Contains("range_walk"));
  EXPECT_THAT(found, Contains("rolling_shutter"));
  EXPECT_LE(beyond_the_footprint(discovery->selected).size(), 2U);
  // Six degrees of freedom: beyond 22.5 once in a thousand.
  EXPECT_LT(test::chi_square_of({discovery->state.camera_from_lidar, discovery->covariance},
                                rig.rig().camera_from_lidar),
            22.5);
}

TEST(HiddenOutsider, IsNamedByChannelAndCovariateNotByAnEffect) {
  const test::HiddenRig rig(43, {{"x_lens_flaw", 3.0}});
  ASSERT_TRUE(rig.ok());
  const auto discovery = discover(rig.result(), {}, {});
  ASSERT_TRUE(discovery.ok()) << discovery.error().text();
  SCOPED_TRACE(discovery_summary(*discovery));
  const bool named = std::any_of(
      discovery->unknown.begin(), discovery->unknown.end(), [](const StructureScore& s) {
        return s.channel == Channel::kCorner && s.covariate.starts_with("image");
      });
  EXPECT_TRUE(named);
}

TEST(HiddenNothing, SelectsNothingAndNeverCallsAGaugeAbsent) {
  const test::HiddenRig rig(44, {});
  ASSERT_TRUE(rig.ok());
  const auto discovery = discover(rig.result(), {}, {});
  ASSERT_TRUE(discovery.ok()) << discovery.error().text();
  SCOPED_TRACE(discovery_summary(*discovery));
  EXPECT_THAT(beyond_the_footprint(discovery->selected), IsEmpty());
  EXPECT_EQ(finding(*discovery, "range_walk").verdict, EffectVerdict::kAbsent);
  EXPECT_EQ(finding(*discovery, "corner_bias").verdict, EffectVerdict::kAbsent);
  EXPECT_EQ(finding(*discovery, "angle_zero").verdict, EffectVerdict::kNotTestable);
  EXPECT_LT(rig.error_m(discovery->state.camera_from_lidar), 2e-3);
}

// One rig for all that must not change the answer.
class Invariance : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    rig_ =
        std::make_unique<test::HiddenRig>(45, std::map<std::string, double>{{"range_walk", 10.0}});
    auto found = discover(rig_->result(), {}, {});
    ASSERT_TRUE(found.ok()) << found.error().text();
    base_ = std::make_unique<Discovery>(std::move(*found));
    ASSERT_THAT(base_->selected, Contains("range_walk"));
  }
  static void TearDownTestSuite() {
    base_.reset();
    rig_.reset();
  }

  // The same effects, values within a tenth of σ, the same extrinsic to 20 µm.
  static void expect_same(const CalibrationResult& changed, const Rigid3& lidar_from_before) {
    const auto again = discover(changed, {}, {});
    ASSERT_TRUE(again.ok()) << again.error().text();
    EXPECT_EQ(again->selected, base_->selected);
    const ParameterEstimate& a = finding(*base_, "range_walk").parameters[0];
    const ParameterEstimate& b = finding(*again, "range_walk").parameters[0];
    EXPECT_NEAR(a.value, b.value, 0.3 * a.sigma);
    EXPECT_NEAR(a.sigma, b.sigma, 0.1 * a.sigma);
    EXPECT_LT(translation_distance_m(again->state.camera_from_lidar * lidar_from_before,
                                     base_->state.camera_from_lidar),
              3e-4);
  }

  static inline std::unique_ptr<test::HiddenRig> rig_;
  static inline std::unique_ptr<Discovery> base_;
};

TEST_F(Invariance, ToTheOrderOfPoints) {
  CalibrationResult changed = rig_->result();
  for (SceneResult& scene : changed.scenes) {
    Cloud shuffled;
    Random random(9);
    std::vector<std::size_t> order(scene.board_points.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    for (std::size_t i = order.size(); i > 1; --i)
      std::swap(order[i - 1], order[random.below(static_cast<std::uint32_t>(i))]);
    for (const std::size_t i : order) append_point(shuffled, scene.board_points, i);
    scene.board_points = std::move(shuffled);
  }
  expect_same(changed, Rigid3{});
}

TEST_F(Invariance, ToTheNamesOfScenes) {
  CalibrationResult changed = rig_->result();
  const auto renamed = [](const std::string& name) { return "z" + name + " renamed"; };
  for (SceneResult& scene : changed.scenes) scene.name = renamed(scene.name);
  for (SceneSolution& scene : changed.extrinsic.scenes) scene.name = renamed(scene.name);
  expect_same(changed, Rigid3{});
}

TEST_F(Invariance, ToTheScaleOfIntensities) {
  CalibrationResult changed = rig_->result();
  for (SceneResult& scene : changed.scenes) {
    for (float& intensity : scene.board_points.intensity) intensity *= 37.5F;
    for (IterationRecord& record : scene.refinement->history) {
      for (NodeRecord& node : record.nodes) {
        node.inner_level *= 37.5;
        node.outer_level *= 37.5;
      }
    }
  }
  expect_same(changed, Rigid3{});
}

TEST_F(Invariance, ToTheLidarFrame) {
  // Range effects do not know where the LiDAR's axes point.
  const Rigid3 new_from_old{so3_exp({0.4, -0.3, 1.1}), Eigen::Vector3d::Zero()};
  CalibrationResult changed = rig_->result();
  for (SceneResult& scene : changed.scenes) {
    for (Eigen::Vector3f& p : scene.board_points.points_m)
      p = (new_from_old * p.cast<double>().eval()).cast<float>();
    FittedPlane& plane = scene.refinement->plane;
    for (Eigen::Vector3d* v : {&plane.normal, &plane.axis_u, &plane.axis_v, &plane.center_m})
      *v = new_from_old.rotation * *v;
    scene.refinement->lidar_from_board = new_from_old * scene.refinement->lidar_from_board;
  }
  changed.extrinsic.camera_from_lidar.transform =
      changed.extrinsic.camera_from_lidar.transform * new_from_old.inverse();
  expect_same(changed, new_from_old);
}

TEST_F(Invariance, AndMissingFieldsAreNotTestable) {
  CalibrationResult changed = rig_->result();
  for (SceneResult& scene : changed.scenes) {
    scene.board_points.time_s.clear();
    scene.board_points.line.clear();
  }
  const auto again = discover(changed, {}, {});
  ASSERT_TRUE(again.ok()) << again.error().text();
  for (const char* id : {"scan_motion", "encoder_lag", "detector_lag", "channel_range_offset",
                         "channel_angle_offset"})
    EXPECT_EQ(finding(*again, id).verdict, EffectVerdict::kNotTestable) << id;
  EXPECT_THAT(again->selected, Contains("range_walk"));
}

}  // namespace
}  // namespace lvcalib
