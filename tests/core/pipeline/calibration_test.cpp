// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/calibration.h"

#include <algorithm>
#include <cmath>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/moved_board.h"
#include "support/pose_matchers.h"
#include "support/simulated_dataset.h"
#include "support/synthetic_observations.h"

namespace lvcalib {
namespace {

using ::testing::HasSubstr;
namespace fs = std::filesystem;

// Within four standard deviations along every direction of the perturbation.
void expect_within_four_sigma(const CalibrationResult& result, const Rigid3& truth) {
  const UncertainRigid3& estimate = result.extrinsic.camera_from_lidar;
  const Vector6d d = se3_log(truth * estimate.transform.inverse());
  for (int k = 0; k < 6; ++k) {
    EXPECT_LT(std::abs(d(k)), 4.0 * std::sqrt(estimate.covariance(k, k)))
        << "component " << k << "; " << test::pose_difference(estimate.transform, truth);
  }
}

TEST(Calibrate, FindsTheTruthOnASimulatedDatasetWithoutAnyGuess) {
  const test::SimulatedDataset data(test::dataset_options(1, 4));
  std::vector<Progress> reports;
  RunContext context;
  context.progress = [&](const Progress& p) { reports.push_back(p); };
  const auto result = calibrate(data.open(), {}, context);
  ASSERT_TRUE(result.ok()) << result.error().text();
  EXPECT_EQ(name_of(result->quality), "good")
      << (result->warnings.empty() ? "" : result->warnings.front().text());
  expect_within_four_sigma(*result, data.rig().camera_from_lidar);
  EXPECT_THAT(result->extrinsic.camera_from_lidar.transform,
              test::IsNearPose(data.rig().camera_from_lidar, 5.0, 2.0));
  ASSERT_EQ(result->scenes.size(), 4U);
  for (std::size_t s = 0; s < 4; ++s) {
    const SceneResult& scene = result->scenes[s];
    EXPECT_TRUE(scene.used) << scene.reason.text();
    EXPECT_TRUE(scene.reason.empty());
    ASSERT_TRUE(scene.view && scene.refinement);
    EXPECT_GT(scene.board_points.size(), 500U);
    EXPECT_THAT(scene.refinement->lidar_from_board,
                test::IsNearPose(data.rig().scenes[s].lidar_from_board, 3.0, 4.0));
  }
  EXPECT_EQ(result->extrinsic.leave_one_out.size(), 4U);
  EXPECT_GT(result->times.total_ms, 0.0);
  EXPECT_GT(result->times.detect_ms, 0.0);
  // Progress never goes back and ends at one.
  ASSERT_GT(reports.size(), 8U);
  for (std::size_t k = 1; k < reports.size(); ++k) {
    EXPECT_GE(reports[k].fraction, reports[k - 1].fraction - 1e-9) << reports[k].stage;
  }
  EXPECT_EQ(reports.back().fraction, 1.0);
}

// Three planes turned so that they leave the LiDAR's position open by decimetres, and no circles:
// the board is where it was localized, not where planes and corners alone would have it.
TEST(Calibrate, PlanesThatLeaveThePositionOpenDoNotLoseThePrint) {
  simulation::SimulationOptions options;
  options.seed = 4400051;
  options.scenes = 3;
  options.lidar.kind = simulation::LidarKind::kRosette;
  options.target.type = TargetType::kAprilGrid;
  options.target.tag_spacing = 0.1 / 0.12;
  const test::SimulatedDataset data(options);
  const auto result = calibrate(data.open(), {}, {});
  ASSERT_TRUE(result.ok()) << result.error().text();
  const auto planes = std::find_if(result->methods.begin(), result->methods.end(),
                                   [](const auto& m) { return m.name == "joint_refined"; });
  ASSERT_NE(planes, result->methods.end());
  EXPECT_GT(translation_distance_m(planes->camera_from_lidar, data.rig().camera_from_lidar), 0.1)
      << "this rig no longer shows what it is here for";
  expect_within_four_sigma(*result, data.rig().camera_from_lidar);
  EXPECT_THAT(result->extrinsic.camera_from_lidar.transform,
              test::IsNearPose(data.rig().camera_from_lidar, 2.0, 1.0));
}

TEST(Calibrate, RejectedScenesTakeNoPartAndLeavingThemOutLaterIsTheSame) {
  const test::SimulatedDataset data(test::dataset_options(3, 3));
  CalibrationRequest request;
  const auto all = calibrate(data.open(), request, {});
  request.rejected = {"B"};
  const auto rejected = calibrate(data.open(), request, {});
  ASSERT_TRUE(all.ok() && rejected.ok());
  EXPECT_FALSE(rejected->scenes[1].used);
  EXPECT_EQ(rejected->scenes[1].reason.text(), "rejected by the user");
  EXPECT_TRUE(rejected->scenes[1].rejected);
  EXPECT_EQ(rejected->extrinsic.used_scenes, 2);
  expect_within_four_sigma(*rejected, data.rig().camera_from_lidar);
  const auto resolved = resolve_calibration(*all, {true, false, true}, request.options);
  ASSERT_TRUE(resolved.ok());
  EXPECT_EQ(resolved->extrinsic.used_scenes, 2);
  EXPECT_FALSE(resolved->scenes[1].used);
  EXPECT_THAT(resolved->extrinsic.camera_from_lidar.transform,
              test::IsNearPose(rejected->extrinsic.camera_from_lidar.transform, 0.01, 0.01));
  // How the scene fits what the others give is told alike, whenever it was rejected.
  ASSERT_EQ(rejected->extrinsic.scenes.size(), 3U);
  const SceneSolution& aside = rejected->extrinsic.scenes[1];
  const SceneSolution& later = resolved->extrinsic.scenes[1];
  EXPECT_EQ(aside.name, "B");
  EXPECT_FALSE(aside.used);
  EXPECT_GT(aside.rms_px, 0.0);
  EXPECT_GT(aside.rms_mm, 0.0);
  EXPECT_NEAR(aside.rms_px, later.rms_px, 0.02 * later.rms_px);
  EXPECT_NEAR(aside.rms_mm, later.rms_mm, 0.02 * later.rms_mm);
  EXPECT_EQ(rejected->scenes[1].view->tag_count, all->scenes[1].view->tag_count);
  // Taking it back in gives the first result again.
  const auto again = resolve_calibration(*resolved, {true, true, true}, request.options);
  ASSERT_TRUE(again.ok());
  EXPECT_EQ(again->extrinsic.camera_from_lidar.transform.matrix(),
            all->extrinsic.camera_from_lidar.transform.matrix());
  EXPECT_EQ(again->warnings, all->warnings);
  EXPECT_TRUE(again->scenes[1].used);
  EXPECT_TRUE(again->scenes[1].reason.empty());
  // And without any there is no result.
  const auto none = resolve_calibration(*all, {false, false, false}, request.options);
  ASSERT_FALSE(none.ok());
  EXPECT_EQ(none.error().kind, ErrorKind::kUntrusted);
}

// What is wrong with a rejected scene, or not to be seen in it, concerns nobody else.
TEST(Calibrate, ARejectedSceneMayBeBeyondReading) {
  const test::SimulatedDataset data(test::dataset_options(3, 3));
  CalibrationRequest request;
  request.rejected = {"B"};
  const auto whole = calibrate(data.open(), request, {});
  ASSERT_TRUE(whole.ok());
  {
    std::ofstream broken(data.path() / "scenes" / "B" / "cloud.pcd", std::ios::trunc);
    broken << "no cloud";
  }
  const auto result = calibrate(data.open(), request, {});
  ASSERT_TRUE(result.ok()) << result.error().text();
  const SceneResult& scene = result->scenes[1];
  EXPECT_TRUE(scene.rejected);
  EXPECT_FALSE(scene.unreadable);
  EXPECT_EQ(scene.reason.text(), "rejected by the user");
  EXPECT_FALSE(scene.refinement.has_value());
  EXPECT_EQ(result->extrinsic.scenes.size(), 2U);
  // Nothing depends on what a rejected scene shows.
  EXPECT_EQ(result->extrinsic.camera_from_lidar.transform.matrix(),
            whole->extrinsic.camera_from_lidar.transform.matrix());
  EXPECT_EQ(result->extrinsic.camera_from_lidar.covariance,
            whole->extrinsic.camera_from_lidar.covariance);
  EXPECT_EQ(result->warnings, whole->warnings);
  EXPECT_EQ(result->quality, whole->quality);
}

TEST(Calibrate, AnUnknownSceneToRejectIsWrongUsage) {
  const test::SimulatedDataset data(test::dataset_options(4, 1));
  CalibrationRequest request;
  request.rejected = {"Z"};
  const auto result = calibrate(data.open(), request, {});
  ASSERT_FALSE(result.ok());
  EXPECT_EQ(result.error().kind, ErrorKind::kUsage);
  EXPECT_THAT(result.error().message, HasSubstr("'Z'"));
  request.rejected = {"A"};
  const auto none = calibrate(data.open(), request, {});
  ASSERT_FALSE(none.ok());
  EXPECT_THAT(none.error().message, HasSubstr("every scene is rejected"));
}

TEST(Calibrate, ThreadsChangeNothingAndARoughGuessNextToNothing) {
  const test::SimulatedDataset data(test::dataset_options(5, 2));
  CalibrationRequest request;
  RunContext one;
  one.threads = 1;
  RunContext three;
  three.threads = 3;
  const auto free = calibrate(data.open(), request, one);
  const auto threads = calibrate(data.open(), request, three);
  Random random(1);
  request.guess = test::disturbed(data.rig().camera_from_lidar, random, 0.05, 0.05);
  const auto guided = calibrate(data.open(), request, {});
  ASSERT_TRUE(free.ok() && threads.ok() && guided.ok());
  EXPECT_EQ(free->extrinsic.camera_from_lidar.transform.matrix(),
            threads->extrinsic.camera_from_lidar.transform.matrix());
  EXPECT_THAT(guided->extrinsic.camera_from_lidar.transform,
              test::IsNearPose(free->extrinsic.camera_from_lidar.transform, 1.0, 0.5));
}

TEST(Calibrate, AStopCancelsAtAnyTime) {
  const test::SimulatedDataset data(test::dataset_options(6, 2));
  const Dataset dataset = data.open();
  for (const char* stage : {"", "detect", "localize", "refine", "optimize"}) {
    std::stop_source stop;
    RunContext context;
    context.stop = stop.get_token();
    context.progress = [&](const Progress& p) {
      if (p.stage == stage && p.fraction < 1.0) stop.request_stop();
    };
    if (*stage == '\0') stop.request_stop();
    const auto result = calibrate(dataset, {}, context);
    if (std::string(stage) == "optimize") continue;  // Milliseconds: either way is right.
    ASSERT_FALSE(result.ok()) << stage;
    EXPECT_EQ(result.error().kind, ErrorKind::kCancelled) << stage << result.error().text();
  }
}

TEST(Calibrate, UnusableFilesAreNamed) {
  const test::SimulatedDataset data(test::dataset_options(7, 2));
  const fs::path cloud = data.path() / "scenes/B/cloud.pcd";
  const auto size = fs::file_size(cloud);
  fs::resize_file(cloud, size / 2);
  auto result = calibrate(data.open(), {}, {});
  ASSERT_FALSE(result.ok());
  EXPECT_EQ(result.error().kind, ErrorKind::kInput);
  EXPECT_THAT(result.error().text(), HasSubstr("B"));
  std::ofstream(data.path() / "scenes/A/image.png", std::ios::trunc) << "no image";
  result = calibrate(data.open(), {}, {});
  ASSERT_FALSE(result.ok());
  EXPECT_EQ(result.error().kind, ErrorKind::kInput);
  EXPECT_THAT(result.error().text(), HasSubstr("image.png"));
}

TEST(Calibrate, ARoomWithoutTheBoardHasNoResult) {
  auto options = test::dataset_options(8, 1);
  options.placement.board = false;
  const test::SimulatedDataset data(options);
  const auto result = calibrate(data.open(), {}, {});
  ASSERT_FALSE(result.ok());
  EXPECT_THAT(result.error().message, HasSubstr("not found in any image"));
}

TEST(Quality, HasNames) {
  EXPECT_EQ(name_of(Quality::kGood), "good");
  EXPECT_EQ(name_of(Quality::kDoubtful), "doubtful");
  EXPECT_EQ(name_of(Quality::kFailed), "failed");
}

// One image belongs to another scene: named, doubtful, and the rest calibrated as if it were not
// there.
TEST(Calibrate, AnImageOfAnotherSceneIsFoundOutAndNamed) {
  const test::SimulatedDataset data(test::dataset_options(4, 5));
  const fs::path scenes = data.path() / "scenes";
  ASSERT_TRUE(fs::copy_file(scenes / "D/image.png", scenes / "C/image.png",
                            fs::copy_options::overwrite_existing));
  const auto result = calibrate(data.open(), {}, {});
  ASSERT_TRUE(result.ok()) << result.error().text();
  EXPECT_EQ(name_of(result->quality), "doubtful");
  EXPECT_FALSE(result->scenes[2].used);
  EXPECT_TRUE(result->scenes[2].contradicts) << result->scenes[2].reason.text();
  ASSERT_FALSE(result->quality_reasons.empty());
  EXPECT_THAT(result->quality_reasons.front(), HasSubstr("scene C"));
  EXPECT_EQ(result->extrinsic.used_scenes, 4);
  expect_within_four_sigma(*result, data.rig().camera_from_lidar);
}

// Intensities left out are intensities that were never there: the same numbers, and the same words
// but for who left them out.
TEST(Calibrate, WithoutIntensityIsAsIfTheCloudsHadNone) {
  const test::SimulatedDataset data(test::dataset_options(1, 4));
  CalibrationRequest request;
  request.options.clouds.use_intensity = false;
  const auto left_out = calibrate(data.open(), request, {});
  ASSERT_TRUE(left_out.ok()) << left_out.error().text();
  for (std::size_t s = 0; s < 4; ++s) {
    const fs::path file =
        data.path() / "scenes" / std::string(1, static_cast<char>('A' + s)) / "cloud.pcd";
    auto cloud = read_cloud(file);
    ASSERT_TRUE(cloud.ok());
    cloud->intensity.clear();
    ASSERT_TRUE(write_pcd(file, *cloud).ok());
  }
  const auto absent = calibrate(data.open(), {}, {});
  ASSERT_TRUE(absent.ok()) << absent.error().text();
  EXPECT_EQ(left_out->extrinsic.camera_from_lidar.transform.matrix(),
            absent->extrinsic.camera_from_lidar.transform.matrix());
  EXPECT_EQ(left_out->extrinsic.camera_from_lidar.covariance,
            absent->extrinsic.camera_from_lidar.covariance);
  std::vector<std::string> as_if_absent;
  for (const Message& warning : left_out->warnings) {
    as_if_absent.push_back(warning.text());
    std::string& text = as_if_absent.back();
    const std::string decided = "intensity is left out, as you decided";
    if (const auto at = text.find(decided); at != std::string::npos)
      text.replace(at, decided.size(), "intensity is missing or the same everywhere");
  }
  std::vector<std::string> said;
  for (const Message& warning : absent->warnings) said.push_back(warning.text());
  EXPECT_EQ(as_if_absent, said);
  EXPECT_THAT(left_out->warnings, testing::Contains(HasSubstr("as you decided")));
  EXPECT_THAT(absent->warnings, testing::Contains(HasSubstr("intensity is missing")));
  ASSERT_TRUE(left_out->forward);
  EXPECT_FALSE(left_out->forward->uses_intensity);
  EXPECT_FALSE(left_out->options.clouds.use_intensity);
  expect_within_four_sigma(*left_out, data.rig().camera_from_lidar);
}

// Of four scenes one has its circles measured beside their places, or its board was moved between
// cloud and image: nodes and planes refuse it either way, every return tells which it is.
TEST(Calibrate, ReturnsDecideWhetherAScenesCirclesOrItsBoardIsWrong) {
  const test::SimulatedDataset data(test::dataset_options(1, 4));
  const auto all = calibrate(data.open(), {}, {});
  ASSERT_TRUE(all.ok()) << all.error().text();
  const Vector6d moved = (Vector6d() << 0.02, 0.01, 0.015, 0.0, 0.0, 0.01).finished();
  const std::vector<bool> use(4, true);

  CalibrationResult circles = *all;
  for (RefinedNode& node : circles.scenes[2].refinement->nodes)
    node.center_lidar_m = se3_exp(moved) * node.center_lidar_m;
  const auto kept = resolve_calibration(std::move(circles), use, {});
  ASSERT_TRUE(kept.ok()) << kept.error().text();
  EXPECT_TRUE(kept->scenes[2].used) << kept->scenes[2].reason.text();
  EXPECT_EQ(kept->extrinsic.used_scenes, 4);
  expect_within_four_sigma(*kept, data.rig().camera_from_lidar);

  CalibrationResult board = *all;
  test::move_board_in_image(se3_exp(moved), data.rig().camera, board.scenes[2]);
  const auto refused = resolve_calibration(std::move(board), use, {});
  ASSERT_TRUE(refused.ok()) << refused.error().text();
  EXPECT_FALSE(refused->scenes[2].used);
  EXPECT_TRUE(refused->scenes[2].contradicts);
  EXPECT_THAT(refused->scenes[2].reason.text(), HasSubstr("contradicts the other scenes by"));
  expect_within_four_sigma(*refused, data.rig().camera_from_lidar);
}

TEST(Calibrate, ASceneWithoutReturnsOnTheBoardIsLeftOut) {
  const test::SimulatedDataset data(test::dataset_options(1, 4));
  auto all = calibrate(data.open(), {}, {});
  ASSERT_TRUE(all.ok()) << all.error().text();
  for (Eigen::Vector3f& p : all->scenes[1].board_points.points_m) p.x() += 3.0F;
  const auto less = resolve_calibration(*all, std::vector<bool>(4, true), {});
  ASSERT_TRUE(less.ok()) << less.error().text();
  EXPECT_FALSE(less->scenes[1].used);
  EXPECT_THAT(less->scenes[1].reason.text(), HasSubstr("no return lies on it"));
  EXPECT_EQ(less->extrinsic.used_scenes, 3);
  EXPECT_EQ(less->quality, Quality::kGood);
  const auto without = resolve_calibration(*all, {true, false, true, true}, {});
  ASSERT_TRUE(without.ok());
  EXPECT_EQ(less->extrinsic.camera_from_lidar.transform.translation,
            without->extrinsic.camera_from_lidar.transform.translation);
}

// Everything that a result says of itself is there after a calibration and after leaving a scene
// out.
TEST(Calibrate, EvidenceFollowsTheScenesInUse) {
  const test::SimulatedDataset data(test::dataset_options(1, 4));
  const auto all = calibrate(data.open(), {}, {});
  ASSERT_TRUE(all.ok()) << all.error().text();
  ASSERT_EQ(all->methods.size(), 10U);
  EXPECT_EQ(all->methods.back().name, "forward_model");
  EXPECT_EQ(all->methods.back().camera_from_lidar.translation,
            all->extrinsic.camera_from_lidar.transform.translation);
  ASSERT_TRUE(all->forward);
  EXPECT_TRUE(all->forward->uses_intensity);
  EXPECT_EQ(all->extrinsic.leave_one_out.size(), 4U);
  EXPECT_EQ(all->uncertainty.splits.size(), 3U);
  ASSERT_TRUE(all->response.all.has_value()) << all->response.reason.text();
  EXPECT_EQ(all->response.scenes.size(), 4U);
  EXPECT_EQ(all->inputs.size(), 10U);
  const auto less = resolve_calibration(*all, {true, false, true, true}, {});
  ASSERT_TRUE(less.ok());
  EXPECT_EQ(less->methods.back().scenes.size(), 3U);
  EXPECT_TRUE(less->uncertainty.splits.empty());
  EXPECT_EQ(less->response.scenes.size(), 3U);
  EXPECT_LT(less->response.all->n, all->response.all->n);
}

}  // namespace
}  // namespace lvcalib
