// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/model_discovery.h"

#include <cmath>
#include <functional>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/hidden_rig.h"
#include "support/moved_board.h"
#include "support/pose_matchers.h"
#include "support/synthetic_observations.h"

namespace lvcalib {
namespace {

// Four scenes of which the third is not used, solved from synthetic observations.
CalibrationResult four_scenes() {
  CalibrationResult result;
  result.camera = test::test_camera();
  const auto observations =
      test::observed_scenes(4, result.target, result.camera, test::test_extrinsic(), {}, 1);
  std::vector<SceneObservations> used = observations;
  used.erase(used.begin() + 2);
  auto solution = solve_extrinsic({used, result.camera, result.target, {}});
  if (!solution) {
    ADD_FAILURE() << solution.error().text();
    return result;
  }
  result.extrinsic = *solution;
  for (std::size_t s = 0; s < observations.size(); ++s) {
    SceneResult scene;
    scene.name = observations[s].name;
    scene.used = s != 2;
    scene.view.emplace();
    scene.view->corners = observations[s].corners;
    scene.view->camera_from_board.transform = observations[s].camera_from_board;
    scene.refinement.emplace();
    scene.refinement->nodes = observations[s].nodes;
    scene.refinement->plane = observations[s].plane;
    scene.refinement->lidar_from_board = observations[s].lidar_from_board;
    scene.board_points.points_m.push_back({1.0F, 0.0F, 0.0F});
    result.scenes.push_back(std::move(scene));
  }
  return result;
}

TEST(DiscoveryInput, HoldsTheScenesInUseWithTheirPoses) {
  const CalibrationResult result = four_scenes();
  const DiscoveryInput input = discovery_input(result);
  ASSERT_EQ(input.scenes.size(), 3U);
  ASSERT_EQ(input.state.camera_from_board.size(), 3U);
  EXPECT_EQ(input.scenes[2].name, result.scenes[3].name);
  EXPECT_EQ(input.scenes[2].board_points, &result.scenes[3].board_points);
  EXPECT_THAT(input.state.camera_from_lidar,
              test::IsNearPose(result.extrinsic.camera_from_lidar.transform, 1e-9, 1e-9));
  EXPECT_EQ(input.sigma_px, result.extrinsic.sigma_px);
}

TEST(DiscoveryInput, OutlyingCornersStayOut) {
  CalibrationResult result = four_scenes();
  const std::size_t before = discovery_input(result).scenes[0].corners.size();
  ASSERT_GT(before, 2U);
  result.extrinsic.scenes[0].corners[1].used = false;
  EXPECT_EQ(discovery_input(result).scenes[0].corners.size(), before - 1);
}

TEST(Discover, TooFewScenesAreRefused) {
  CalibrationResult result = four_scenes();
  result.scenes[0].used = false;
  const auto discovery = discover(result, {}, {});
  ASSERT_FALSE(discovery.ok());
  EXPECT_EQ(discovery.error().kind, ErrorKind::kUntrusted);
}

TEST(WithModel, PutsPoseBoardsEffectsAndScalesIntoTheResult) {
  const CalibrationResult before = four_scenes();
  Discovery discovery;
  discovery.state.camera_from_lidar = test::test_extrinsic();
  discovery.state.camera_from_lidar.translation.x() += 0.5;
  discovery.covariance = 1e-6 * Matrix6d::Identity();
  for (int k = 0; k < 3; ++k) {
    discovery.state.camera_from_board.push_back(Rigid3{});
    discovery.state.camera_from_board.back().translation.z() = 10.0 + k;
  }
  discovery.model.push_back({find_effect("range_near"), 1.2, Eigen::VectorXd::Constant(1, 0.02)});
  discovery.scales.log_contrast = 2.5;
  EffectFinding found;
  found.id = "range_near";
  found.parameters.push_back({"a", "mm", 1e-3, 0.02, 0.001});
  EffectFinding not_found;
  not_found.id = "range_offset";
  discovery.effects = {found, not_found};
  const CalibrationResult after = with_model(before, discovery);
  EXPECT_THAT(after.extrinsic.camera_from_lidar.transform,
              test::IsNearPose(discovery.state.camera_from_lidar, 1e-9, 1e-9));
  EXPECT_EQ(after.extrinsic.camera_from_lidar.covariance, discovery.covariance);
  ASSERT_EQ(after.model.size(), 1U);
  EXPECT_EQ(after.model[0].id, "range_near");
  EXPECT_EQ(after.model[0].shape, 1.2);
  EXPECT_EQ(after.model[0].parameters[0].value, 0.02);
  EXPECT_EQ(after.model_scales.log_contrast, 2.5);
  // The board poses go to the scenes in use, in their order.
  const std::string names[] = {before.scenes[0].name, before.scenes[1].name, before.scenes[3].name};
  for (int k = 0; k < 3; ++k) {
    for (const SceneSolution& s : after.extrinsic.scenes) {
      if (s.name == names[k]) {
        EXPECT_EQ(s.camera_from_board.translation.z(), 10.0 + k);
      }
    }
  }
}

// Between a step and its ranking nothing may look surer than it is.
TEST(WithModel, TotalUncertaintyHoldsWhatIsLeftOutBeforeAndAfterTheTotalIsKnown) {
  CalibrationResult before = four_scenes();
  const Matrix6d left_out = 4e-6 * Matrix6d::Identity();
  before.covariance_total = before.extrinsic.camera_from_lidar.covariance + left_out;
  Discovery discovery;
  discovery.state.camera_from_lidar = test::test_extrinsic();
  discovery.covariance = 1e-6 * Matrix6d::Identity();
  discovery.model.push_back({find_effect("range_near"), 1.2, Eigen::VectorXd::Constant(1, 0.02)});
  const CalibrationResult at_once = with_model(before, discovery);
  EXPECT_NEAR((at_once.covariance_total - discovery.covariance - left_out).norm(), 0.0, 1e-12);
  discovery.covariance_total = 2e-6 * Matrix6d::Identity();
  const CalibrationResult later = with_model(before, discovery);
  EXPECT_EQ(later.covariance_total, discovery.covariance_total);
}

double deviation(const Matrix6d& covariance, int first) {
  return std::sqrt(covariance.diagonal().segment<3>(first).sum());
}

// One total uncertainty: a model without effects states what its calibration does.
TEST(DiscoveredTotal, WithoutEffectsIsTheCalibrations) {
  const test::HiddenRig rig(test::hidden_options(61, {}));
  ASSERT_TRUE(rig.ok());
  DiscoveryOptions options = discovery_options(rig.result());
  options.max_effects = 0;
  options.advise_scenes = false;
  const auto discovery = discover_effects(discovery_input(rig.result()), options, {});
  ASSERT_TRUE(discovery.ok()) << discovery.error().text();
  const auto stated = discover(rig.result(), options, {});
  ASSERT_TRUE(stated.ok()) << stated.error().text();
  EXPECT_EQ(stated->covariance, rig.result().extrinsic.camera_from_lidar.covariance);
  EXPECT_EQ(stated->covariance_total, rig.result().covariance_total);
  for (const int first : {0, 3}) {
    const double base = deviation(rig.result().covariance_total, first);
    EXPECT_GT(base, 1.1 * deviation(discovery->covariance, first));
    EXPECT_NEAR(deviation(discovery->covariance_total, first), base, 0.25 * base) << first;
  }
}

// What an effect of the model explains is no longer left out.
TEST(DiscoveredTotal, FallsAsTheMissingEffectComesIn) {
  const test::HiddenRig rig(test::hidden_options(62, {{"beam_origin_offset", 8.0}}));
  ASSERT_TRUE(rig.ok());
  DiscoveryOptions options = discovery_options(rig.result());
  options.with = {"beam_origin_offset"};
  options.max_effects = 0;
  options.advise_scenes = false;
  const auto discovery = discover(rig.result(), options, {});
  ASSERT_TRUE(discovery.ok()) << discovery.error().text();
  ASSERT_EQ(discovery->model.size(), 1U);
  EXPECT_LT(deviation(discovery->covariance_total, 0),
            0.7 * deviation(rig.result().covariance_total, 0));
  EXPECT_LT(deviation(discovery->covariance_total, 3),
            1.1 * deviation(rig.result().covariance_total, 3));
  const Vector6d error =
      se3_log(rig.rig().camera_from_lidar * discovery->state.camera_from_lidar.inverse());
  EXPECT_LT(error.dot(discovery->covariance_total.ldlt().solve(error)), 16.8);  // χ², 99 %.
}

// A model whose effect moves nothing: what is told of the scenes stays what it is.
Discovery model_that_moves_nothing() {
  Discovery discovery;
  discovery.state.camera_from_lidar = test::test_extrinsic();
  discovery.covariance = 1e-6 * Matrix6d::Identity();
  discovery.model.push_back({find_effect("range_near"), 1.2, Eigen::VectorXd::Constant(1, 1e-9)});
  return discovery;
}

// Boards with returns all over them, of one time.
CalibrationResult with_returns(CalibrationResult result, float time_s) {
  constexpr int kSide = 20;
  const BoardOutline outline = result.target.outline();
  for (SceneResult& scene : result.scenes) {
    scene.board_points = {};
    for (int k = 0; k < kSide * kSide; ++k) {
      const Eigen::Vector2d share(0.5 + k % kSide, 0.5 + k / kSide);
      const Eigen::Vector2d at =
          outline.lower_left_m + outline.size_m().cwiseProduct(share) / kSide;
      const Eigen::Vector3d point =
          scene.refinement->lidar_from_board * Eigen::Vector3d(at.x(), at.y(), 0.0);
      scene.board_points.points_m.push_back(point.cast<float>());
      scene.board_points.time_s.push_back(time_s);
    }
  }
  return result;
}

// How large boards look by a model whose only effect makes every range longer, scene by scene: a
// point p of a board moves by δ p/r, of whose slope along an axis a of the board δ (1 − (a·p/r)²)/r
// is left, since the board is met at a slant.
void expect_scales(const char* effect, double shape, double size, float time_s,
                   const std::function<double(int scene)>& farther_m) {
  const CalibrationResult before = with_returns(four_scenes(), time_s);
  Discovery discovery = model_that_moves_nothing();
  discovery.model = {{find_effect(effect), shape, Eigen::VectorXd::Constant(1, size)}};
  for (const SceneSolution& s : before.extrinsic.scenes)
    discovery.state.camera_from_board.push_back(s.camera_from_board);
  const CalibrationResult after = with_model(before, discovery);
  const Eigen::Vector2d middle = before.target.outline().center_m();
  Eigen::Array2d mean = Eigen::Array2d::Zero();
  int next = 0;
  for (const SceneResult& scene : after.scenes) {
    if (!scene.used) {
      EXPECT_EQ(scene.modelled_scale, 0.0);
      continue;
    }
    const Rigid3& board = scene.refinement->lidar_from_board;
    const Eigen::Vector3d place = board * Eigen::Vector3d(middle.x(), middle.y(), 0.0);
    const Eigen::Vector3d slant = board.rotation.inverse() * place.normalized();
    const Eigen::Array2d expected =
        farther_m(next) / place.norm() * (1.0 - slant.head<2>().array().square());
    EXPECT_NEAR(scene.modelled_scale, expected.mean(), 0.03 * expected.mean()) << scene.name;
    mean += expected / 3.0;
    ++next;
  }
  EXPECT_NEAR(after.modelled_print_scale.x(), mean.x(), 0.03 * mean.x());
  EXPECT_NEAR(after.modelled_print_scale.y(), mean.y(), 0.03 * mean.y());
}

// A board that reads farther looks larger, in each scene by what the device's warming up did then.
TEST(WithModel, HowLargeABoardLooksIsToldSceneByScene) {
  expect_scales("range_warmup", 0.4, 0.02, 0.0F,
                [](int scene) { return 0.02 * std::exp(-0.5 * scene / 0.4); });
}

// Within a scan by the time at which it reached the board.
TEST(WithModel, HowLargeABoardLooksIsToldByTheTimeOfItsReturns) {
  expect_scales("range_drift", 0.3, 0.05, 0.6F,
                [](int) { return 0.05 * 0.3 * (1.0 - std::exp(-2.0)); });
}

// What only images and ranges together said against the intrinsics was an effect on the ranges if
// the search, with that in the model, sees nothing wrong with them any more.
TEST(WithModel, IntrinsicsThatOnlyRangesContradictAreAskedAboutAgain) {
  for (const bool by_ranges : {true, false}) {
    for (const double p_value : {0.3, 1e-12, 1.0}) {
      CalibrationResult before = four_scenes();
      before.intrinsics.contradiction.emplace();
      before.intrinsics.contradiction->by_ranges = by_ranges;
      Discovery discovery = model_that_moves_nothing();
      for (const SceneSolution& s : before.extrinsic.scenes)
        discovery.state.camera_from_board.push_back(s.camera_from_board);
      EffectFinding finding;
      finding.id = "intrinsics_error";
      finding.p_value = p_value;
      discovery.effects = {finding};
      const bool left = with_model(before, discovery).intrinsics.contradiction.has_value();
      EXPECT_EQ(left, !by_ranges || p_value != 0.3) << by_ranges << ' ' << p_value;
    }
  }
}

struct Mended {
  const char* effect;
  double size;
  const char* doubt;  // Of the base model; its verdict says so.
  const char* left;   // What is left of it under the model; empty: nothing, it is good.
};

class VerdictOfTheModel : public testing::TestWithParam<Mended> {};

TEST_P(VerdictOfTheModel, IsAskedAgainWithoutWhatItsEffectDoes) {
  const test::HiddenRig rig(test::hidden_options(63, {{GetParam().effect, GetParam().size}}));
  ASSERT_TRUE(rig.ok());
  EXPECT_EQ(rig.result().quality, Quality::kDoubtful);
  EXPECT_THAT(rig.result().quality_reason.text(), testing::HasSubstr(GetParam().doubt));
  DiscoveryOptions options = discovery_options(rig.result());
  options.with = {GetParam().effect};
  options.max_effects = 0;
  options.advise_scenes = false;
  const auto discovery = discover(rig.result(), options, {});
  ASSERT_TRUE(discovery.ok()) << discovery.error().text();
  const CalibrationResult after = with_model(rig.result(), *discovery);
  const std::string left = GetParam().left;
  EXPECT_EQ(after.quality, left.empty() ? Quality::kGood : Quality::kDoubtful)
      << after.quality_reason.text();
  EXPECT_THAT(after.quality_reason.text(), testing::HasSubstr(left));
}

INSTANTIATE_TEST_SUITE_P(
    Effects, VerdictOfTheModel,
    testing::Values(Mended{"corner_bias", 0.2, "tagSpacing", ""},
                    Mended{"range_offset", 20.0, "disagree on the board's size", ""},
                    Mended{"receiver_saturation", 10.0, "nearer than brighter ones", ""},
                    // The extrinsic is right, but for a camera that camera.yaml does not describe.
                    Mended{"intrinsics_error", 1000.0, "contradict the intrinsics",
                           "the model takes that out of the images"}),
    [](const auto& info) { return std::string(info.param.effect); });

INSTANTIATE_TEST_SUITE_P(MoreEffects, VerdictOfTheModel,
                         testing::Values(Mended{"board_bow", 5.0, "contradict the intrinsics", ""},
                                         Mended{"rolling_shutter", 2.0, "contradict the intrinsics",
                                                ""}),
                         [](const auto& info) { return std::string(info.param.effect); });

// Another effect than what is wrong mends nothing.
TEST(WithModel, AnEffectThatExplainsNothingLeavesTheVerdictAsItIs) {
  const test::HiddenRig rig(test::hidden_options(63, {{"corner_bias", 0.2}}));
  ASSERT_TRUE(rig.ok());
  DiscoveryOptions options = discovery_options(rig.result());
  options.with = {"rolling_shutter"};
  options.max_effects = 0;
  options.advise_scenes = false;
  const auto discovery = discover(rig.result(), options, {});
  ASSERT_TRUE(discovery.ok()) << discovery.error().text();
  const CalibrationResult after = with_model(rig.result(), *discovery);
  EXPECT_EQ(after.quality, Quality::kDoubtful);
  EXPECT_EQ(after.intrinsics.spacing.text(), rig.result().intrinsics.spacing.text());
}

constexpr char kContradicts[] = "contradicts the other scenes";

TEST(WithModel, ASceneThatAgreesUnderTheModelIsNoReasonToDoubt) {
  CalibrationResult before = four_scenes();
  before.scenes[2].contradicts = true;
  before.scenes[2].reason = Message(kContradicts);
  const CalibrationResult after = with_model(before, model_that_moves_nothing());
  EXPECT_FALSE(after.scenes[2].contradicts);
  EXPECT_FALSE(after.scenes[2].used);  // The model was fitted without it.
  EXPECT_THAT(after.scenes[2].reason.text(), testing::HasSubstr("only without the effects"));
}

TEST(WithModel, ASceneThatStillContradictsStaysRefused) {
  CalibrationResult before = four_scenes();
  before.scenes[2].contradicts = true;
  before.scenes[2].reason = Message(kContradicts);
  for (CornerObservation& corner : before.scenes[2].view->corners) corner.pixel.x() += 20.0;
  const CalibrationResult after = with_model(before, model_that_moves_nothing());
  EXPECT_TRUE(after.scenes[2].contradicts);
  EXPECT_EQ(after.scenes[2].reason.text(), kContradicts);
}

TEST(WithModel, NothingIsObjectedToAnInsistedSceneThatAgreesUnderTheModel) {
  CalibrationResult before = four_scenes();
  for (const bool agrees : {true, false}) {
    before.scenes[3].insisted = true;
    before.scenes[3].objection = Message(kContradicts);
    if (!agrees) {
      before.scenes[2].used = true;  // Three others, so that one of four can be told to be bad.
      for (CornerObservation& corner : before.scenes[3].view->corners) corner.pixel.x() += 20.0;
    }
    const CalibrationResult after = with_model(before, model_that_moves_nothing());
    EXPECT_EQ(after.scenes[3].objection.empty(), agrees);
  }
}

// A board that was moved between cloud and image: no effect makes it agree, neither one that is
// found nor one that is asked for.
TEST(ExplainRefusedScenes, AMovedBoardStaysRefused) {
  const test::SimulatedDataset data(test::dataset_options(1, 4));
  auto all = calibrate(data.open(), {}, {});
  ASSERT_TRUE(all.ok()) << all.error().text();
  const Vector6d moved = (Vector6d() << 0.02, 0.01, 0.015, 0.0, 0.0, 0.01).finished();
  test::move_board_in_image(se3_exp(moved), data.rig().camera, all->scenes[2]);
  const auto refused = resolve_calibration(std::move(*all), std::vector<bool>(4, true), {});
  ASSERT_TRUE(refused.ok()) << refused.error().text();
  ASSERT_TRUE(refused->scenes[2].contradicts);
  DiscoveryOptions options = discovery_options(*refused);
  options.advise_scenes = false;
  for (const bool asked : {false, true}) {
    if (asked) options.with = {"range_walk"};
    const auto explained = explain_refused_scenes(*refused, options, {});
    ASSERT_TRUE(explained.ok()) << explained.error().text();
    EXPECT_FALSE(explained->has_value());
  }
}

TEST(ExplainRefusedScenes, WhereNoneContradictsNothingIsSearched) {
  CalibrationResult result = four_scenes();
  const auto explained = explain_refused_scenes(result, {}, {});
  ASSERT_TRUE(explained.ok());
  EXPECT_FALSE(explained->has_value());
  // Nor where it is known that the image is another scene's.
  result.scenes[2].contradicts = true;
  result.scenes[2].reason = Message(kContradicts);
  result.scenes[2].shared_file = Message("image.png is that of scene A");
  RunContext watched;
  bool searched = false;
  watched.progress = [&](const auto&) { searched = true; };
  const auto known = explain_refused_scenes(result, {}, watched);
  ASSERT_TRUE(known.ok());
  EXPECT_FALSE(known->has_value());
  EXPECT_FALSE(searched);
}

}  // namespace
}  // namespace lvcalib
