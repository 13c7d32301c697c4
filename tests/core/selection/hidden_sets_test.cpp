// SPDX-License-Identifier: GPL-3.0-or-later
// Pairs of hidden effects, effects outside the catalogue, nothing hidden, and what must not change
// the answer: through images and clouds.
#include <algorithm>
#include <map>
#include <memory>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "pipeline/model_discovery.h"
#include "report/discovery_file.h"
#include "simulation/disturbances/registry.h"
#include "support/effect_rigs.h"
#include "support/hidden_answer.h"
#include "support/hidden_rig.h"
#include "support/pose_matchers.h"

namespace lvcalib {
namespace {

using test::beyond_the_footprint;
using test::finding;
using test::with_aliases;
using ::testing::Contains;
using ::testing::IsEmpty;

using Planted = std::map<std::string, double>;

class HiddenPair : public ::testing::TestWithParam<Planted> {};

TEST_P(HiddenPair, BothAreFound) {
  const test::HiddenRig rig(42, GetParam());
  ASSERT_TRUE(rig.ok());
  const auto discovery = discover(rig.result(), {}, {});
  ASSERT_TRUE(discovery.ok()) << discovery.error().text();
  SCOPED_TRACE(discovery_summary(*discovery));
  const auto found = with_aliases(*discovery);
  for (const auto& [id, value] : GetParam()) EXPECT_THAT(found, Contains(id));
  EXPECT_LE(beyond_the_footprint(discovery->selected).size(), 2U);
  // Six degrees of freedom: beyond 22.5 once in a thousand.
  EXPECT_LT(test::chi_square_of({discovery->state.camera_from_lidar, discovery->covariance},
                                rig.rig().camera_from_lidar),
            22.5);
}

INSTANTIATE_TEST_SUITE_P(Sets, HiddenPair,
                         ::testing::Values(Planted{{"range_walk", 10.0}, {"rolling_shutter", 2.0}},
                                           Planted{{"range_offset", 20.0}, {"board_bow", 2.0}},
                                           Planted{{"angle_scale", 2000.0}, {"corner_bias", 0.2}},
                                           Planted{{"boundary_bias", 2.0}, {"scan_motion", 20.0}}));

class HiddenOutsider : public ::testing::TestWithParam<std::string> {};

TEST_P(HiddenOutsider, IsNamedByChannelAndCovariateNotByAnEffect) {
  const std::string& id = GetParam();
  test::EffectTask task{test::EffectSet::kOutside, {}, 43};
  task.planted[id] = simulation::find_disturbance(id)->typical;
  const test::HiddenRig rig(test::effect_rig_options(task));
  ASSERT_TRUE(rig.ok());
  const auto discovery = discover(rig.result(), {}, {});
  ASSERT_TRUE(discovery.ok()) << discovery.error().text();
  SCOPED_TRACE(discovery_summary(*discovery));
  const auto signature = test::signature_of(id);
  ASSERT_TRUE(signature);
  const auto told = [&](const std::string& covariate) {
    return std::find(signature->covariates.begin(), signature->covariates.end(), covariate) !=
           signature->covariates.end();
  };
  const bool named = std::any_of(
      discovery->unknown.begin(), discovery->unknown.end(), [&](const StructureScore& s) {
        return s.channel == signature->channel &&
               (told(s.covariate) || (!s.second_covariate.empty() && told(s.second_covariate)));
      });
  EXPECT_TRUE(named);
  EXPECT_THAT(beyond_the_footprint(discovery->selected), IsEmpty());
}

INSTANTIATE_TEST_SUITE_P(Sets, HiddenOutsider,
                         ::testing::Values("x_board_bump", "x_azimuth_ripple", "x_lens_flaw",
                                           "x_window_smudge"),
                         [](const auto& info) { return info.param; });

class HiddenNothing : public ::testing::TestWithParam<int> {};

TEST_P(HiddenNothing, SelectsNothingAndNeverCallsAGaugeAbsent) {
  const test::HiddenRig rig(static_cast<std::uint64_t>(GetParam()), {});
  ASSERT_TRUE(rig.ok());
  const auto discovery = discover(rig.result(), {}, {});
  ASSERT_TRUE(discovery.ok()) << discovery.error().text();
  SCOPED_TRACE(discovery_summary(*discovery));
  EXPECT_THAT(beyond_the_footprint(discovery->selected), IsEmpty());
  EXPECT_EQ(finding(*discovery, "range_walk").verdict, EffectVerdict::kAbsent);
  EXPECT_EQ(finding(*discovery, "corner_bias").verdict, EffectVerdict::kAbsent);
  EXPECT_EQ(finding(*discovery, "angle_zero").verdict, EffectVerdict::kNotTestable);
  EXPECT_LT(rig.error_m(discovery->state.camera_from_lidar), 2e-3);
  for (const ChannelSummary& c : discovery->channels)
    EXPECT_LT(c.heldout_rms, 1.15 * c.noise_floor) << name_of(c.channel);
}

INSTANTIATE_TEST_SUITE_P(Sets, HiddenNothing, ::testing::Values(44, 46, 47));

// One scene that faces the beam chooses the width of the gloss; the others, told what it says, are
// predicted worse. A better fit is not enough to believe it.
TEST(HiddenGloss, SeenInOneSceneIsTakenBackWithTheReason) {
  const test::HiddenRig rig(
      73, {{"specular_lobe", simulation::find_disturbance("specular_lobe")->typical}});
  ASSERT_TRUE(rig.ok());
  const auto discovery = discover(rig.result(), {}, {});
  ASSERT_TRUE(discovery.ok()) << discovery.error().text();
  SCOPED_TRACE(discovery_summary(*discovery));
  EXPECT_THAT(beyond_the_footprint(discovery->selected), IsEmpty());
  const EffectFinding& gloss = finding(*discovery, "specular_lobe");
  EXPECT_EQ(gloss.verdict, EffectVerdict::kNotTestable);
  EXPECT_THAT(gloss.explanation, ::testing::HasSubstr("predicts scenes held out worse"));
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

  // The same effects; values to a share of σ and the extrinsic to a distance: other rows of a cloud
  // may be kept where its frame has turned.
  static void expect_same(const CalibrationResult& changed, const Rigid3& lidar_from_before,
                          double sigmas, double distance_m) {
    const auto again = discover(changed, {}, {});
    ASSERT_TRUE(again.ok()) << again.error().text();
    EXPECT_EQ(again->selected, base_->selected);
    const ParameterEstimate& a = finding(*base_, "range_walk").parameters[0];
    const ParameterEstimate& b = finding(*again, "range_walk").parameters[0];
    EXPECT_NEAR(a.value, b.value, sigmas * a.sigma);
    EXPECT_NEAR(a.sigma, b.sigma, sigmas * a.sigma);
    EXPECT_LT(translation_distance_m(again->state.camera_from_lidar * lidar_from_before,
                                     base_->state.camera_from_lidar),
              distance_m);
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
  expect_same(changed, Rigid3{}, 1e-3, 1e-6);
}

TEST_F(Invariance, ToTheNamesOfScenes) {
  CalibrationResult changed = rig_->result();
  const auto renamed = [](const std::string& name) { return "z" + name + " renamed"; };
  for (SceneResult& scene : changed.scenes) scene.name = renamed(scene.name);
  for (SceneSolution& scene : changed.extrinsic.scenes) scene.name = renamed(scene.name);
  expect_same(changed, Rigid3{}, 1e-3, 1e-6);
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
  expect_same(changed, Rigid3{}, 1e-3, 1e-6);
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
  expect_same(changed, new_from_old, 0.3, 3e-4);
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
