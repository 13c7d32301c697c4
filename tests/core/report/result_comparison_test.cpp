// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/result_comparison.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/file_io.h"
#include "report/result_file.h"
#include "support/pose_matchers.h"
#include "support/synthetic_observations.h"
#include "support/temporary_folder.h"

namespace lvcalib {
namespace {

StatedExtrinsic stated(const Vector6d& xi, double sigma_m, double sigma_rad) {
  StatedExtrinsic out;
  out.camera_from_lidar = se3_exp(xi);
  Vector6d variance;
  variance << Eigen::Vector3d::Constant(sigma_m * sigma_m),
      Eigen::Vector3d::Constant(sigma_rad * sigma_rad);
  out.covariance = out.covariance_total = variance.asDiagonal();
  return out;
}

TEST(ResultComparison, IsZeroBetweenEqualsAndAddsVariances) {
  Vector6d pose;
  pose << 0.1, -0.2, 0.3, 0.5, -1.0, 0.7;
  const StatedExtrinsic a = stated(pose, 3e-3, 4e-3);
  const StatedExtrinsic b = stated(pose, 4e-3, 3e-3);
  const ExtrinsicDifference d = difference_of(a, b);
  EXPECT_NEAR(d.translation_mm, 0.0, 1e-9);
  EXPECT_NEAR(d.rotation_mrad, 0.0, 1e-9);
  EXPECT_NEAR(d.sigma_first(0), 3e-3, 1e-12);
  EXPECT_NEAR(d.sigma_second(0), 4e-3, 1e-12);
  EXPECT_NEAR(d.sigma(0), 5e-3, 1e-12);
  EXPECT_NEAR(d.sigma(5), 5e-3, 1e-12);
  ASSERT_TRUE(d.probability.has_value());
  EXPECT_NEAR(*d.probability, 1.0, 1e-9);
}

TEST(ResultComparison, ProbabilityIsThatOfChiSquaredWithSixDegrees) {
  // Quantiles from tables: P(χ²₆ > 12.592) = 0.05, P(χ²₆ > 22.458) = 0.001.
  for (const auto& [chi2, probability] :
       std::vector<std::pair<double, double>>{{12.5916, 0.05}, {22.4577, 0.001}, {5.3481, 0.5}}) {
    Vector6d off = Vector6d::Zero();
    off(0) = 1e-3 * std::sqrt(chi2);
    StatedExtrinsic truth;
    truth.is_truth = true;
    truth.camera_from_lidar = se3_exp(off);
    const ExtrinsicDifference d = difference_of(stated(Vector6d::Zero(), 1e-3, 1e-3), truth);
    ASSERT_TRUE(d.chi2.has_value());
    EXPECT_NEAR(*d.chi2, chi2, 1e-6);
    EXPECT_NEAR(*d.probability, probability, 1e-4);
  }
}

TEST(ResultComparison, WithoutStatedErrorsThereIsNoProbability) {
  const ExtrinsicDifference d =
      difference_of(stated(Vector6d::Zero(), 1e-3, 1e-3), stated(Vector6d::Zero(), 0.0, 0.0));
  EXPECT_FALSE(d.chi2.has_value());
  EXPECT_FALSE(d.probability.has_value());
}

TEST(ResultComparison, ReadsResultsAndTruthsAndNothingElse) {
  const test::TemporaryFolder folder;
  const auto write = [&](const char* name, const std::string& text) {
    EXPECT_TRUE(write_file_atomically(folder.path() / name, text).ok());
    return folder.path() / name;
  };
  const std::string rows = "[[1,0,0,0.1],[0,1,0,0.2],[0,0,1,0.3]";
  const auto truth = read_stated_result(write("truth.json", "{\"T_CL\": " + rows + "]}"));
  ASSERT_TRUE(truth.ok()) << truth.error().text();
  EXPECT_TRUE(truth->extrinsic.is_truth);
  EXPECT_EQ(truth->extrinsic.camera_from_lidar.translation.z(), 0.3);
  std::string covariance = "[";
  for (int r = 0; r < 6; ++r) {
    covariance += r == 0 ? "[" : ",[";
    for (int c = 0; c < 6; ++c) covariance += (c == 0 ? "" : ",") + std::string(r == c ? "4" : "0");
    covariance += "]";
  }
  covariance += "]";
  const std::string result = "{\"T_camera_lidar\": {\"matrix\": " + rows +
                             ",[0,0,0,1]]}, \"covariance_total\": " + covariance + "}";
  const auto read = read_stated_result(write("result.json", result));
  ASSERT_TRUE(read.ok()) << read.error().text();
  EXPECT_FALSE(read->extrinsic.is_truth);
  EXPECT_EQ(read->extrinsic.covariance_total(2, 2), 4.0);
  for (const char* bad : {"", "[]", "{}", "{\"T_CL\": 3}", "{\"T_camera_lidar\": 3}"}) {
    const auto refused = read_stated_result(write("bad.json", bad));
    ASSERT_FALSE(refused.ok()) << bad;
    EXPECT_THAT(refused.error().text(), ::testing::HasSubstr("bad.json"));
  }
}

// A result with three scenes, of which the last was never solved.
CalibrationResult three_scenes() {
  CalibrationResult result;
  result.dataset = "/rigs/42";
  result.camera = test::test_camera();
  auto& pose = result.extrinsic.camera_from_lidar;
  pose.transform = test::test_extrinsic();
  pose.covariance = 1e-6 * Matrix6d::Identity();
  result.covariance_total = 4e-6 * Matrix6d::Identity();
  for (const char* name : {"A", "007", "C"}) {
    SceneResult scene;
    scene.name = name;
    scene.used = name[0] != 'C';
    if (scene.used) {
      SceneSolution solution;
      solution.name = name;
      solution.rms_px = name[0] == 'A' ? 0.25 : 0.5;
      solution.rms_mm = name[0] == 'A' ? 1.5 : 2.5;
      solution.nodes.push_back({0, Eigen::Vector3d::Zero(), true});
      result.extrinsic.scenes.push_back(solution);
    } else {
      scene.reason = Message("no board in the image");
    }
    result.scenes.push_back(scene);
  }
  return result;
}

TEST(ResultComparison, BothFilesOfAResultStateWhatItStates) {
  const test::TemporaryFolder folder;
  const CalibrationResult result = three_scenes();
  const StatedResult stated = stated_result(result);
  ASSERT_TRUE(write_results(result, folder.path()).ok());
  for (const char* name : {"result.json", "result.yaml"}) {
    const auto read = read_stated_result(folder.path() / name);
    ASSERT_TRUE(read.ok()) << name << ": " << read.error().text();
    EXPECT_THAT(read->extrinsic.camera_from_lidar,
                test::IsNearPose(stated.extrinsic.camera_from_lidar, 1e-6, 1e-6));
    EXPECT_TRUE(read->extrinsic.covariance.isApprox(stated.extrinsic.covariance, 1e-8)) << name;
    EXPECT_TRUE(read->extrinsic.covariance_total.isApprox(result.covariance_total, 1e-8)) << name;
    EXPECT_EQ(read->dataset, "/rigs/42");
    EXPECT_TRUE(share_scenes(*read, stated));
    ASSERT_EQ(read->scenes.size(), 3U) << name;
    EXPECT_EQ(read->scenes[1].name, "007");
    EXPECT_EQ(read->scenes[1].rms_px, 0.5);
    EXPECT_EQ(read->scenes[1].rms_mm, 2.5);
    EXPECT_FALSE(read->scenes[2].used);
    EXPECT_FALSE(read->scenes[2].rms_px.has_value()) << name;
  }
}

TEST(ResultComparison, YamlWithoutAPoseIsRefused) {
  const test::TemporaryFolder folder;
  for (const char* bad :
       {"", "[]", "a: [", "T_CL: [[1]]", "T_camera_lidar: 3", "T_camera_lidar: {matrix: [[x]]}"}) {
    const auto path = folder.path() / "bad.yaml";
    ASSERT_TRUE(write_file_atomically(path, bad).ok());
    const auto refused = read_stated_result(path);
    ASSERT_FALSE(refused.ok()) << bad;
    EXPECT_THAT(refused.error().text(), ::testing::HasSubstr("bad.yaml"));
  }
}

TEST(ResultComparison, ScenesStandSideBySideByName) {
  const StatedResult first = stated_result(three_scenes());
  StatedResult second = first;
  second.scenes = {{"new", true, 0.1, 0.2}, {"007", true, 0.6, 2.0}};
  second.dataset = "/rigs/43";
  EXPECT_FALSE(share_scenes(first, second));
  EXPECT_FALSE(share_scenes({}, {}));
  const auto scenes = compare_scenes(first, second);
  ASSERT_EQ(scenes.size(), 4U);
  EXPECT_EQ(scenes[0].name, "A");
  EXPECT_FALSE(scenes[0].second.has_value());
  EXPECT_EQ(scenes[1].first->rms_px, 0.5);
  EXPECT_EQ(scenes[1].second->rms_px, 0.6);
  EXPECT_EQ(scenes[3].name, "new");
  EXPECT_FALSE(scenes[3].first.has_value());
}

// A shift along the camera's x axis moves a pixel by f·Δx/z without distortion.
TEST(ResultComparison, ThePictureMovesByFocalLengthTimesShiftOverDistance) {
  Camera camera = test::test_camera();
  std::fill(camera.distortion.begin(), camera.distortion.end(), 0.0);
  const Rigid3 first;
  Rigid3 second;
  second.translation.x() = 0.004;
  const std::vector<Eigen::Vector3d> points = {
      {0.0, 0.0, 2.0}, {0.1, -0.1, 4.0}, {0.0, 0.0, -1.0}};  // The last lies behind the camera.
  const ProjectionShift shift = projection_shift(points, camera, first, second);
  ASSERT_EQ(shift.first_px.size(), 2U);
  EXPECT_NEAR(shift.second_px[0].x() - shift.first_px[0].x(), camera.fx * 0.002, 1e-9);
  EXPECT_NEAR(shift.largest_px, camera.fx * 0.002, 1e-9);
  EXPECT_NEAR(shift.rms_px, camera.fx * std::sqrt((4.0 + 1.0) / 2.0) * 1e-3, 1e-9);
}

TEST(ResultComparison, ABoardThatTheLidarDoesNotHaveHasNoShift) {
  CalibrationResult result = three_scenes();
  SceneResult& scene = result.scenes[0];
  const Rigid3 pose = result.extrinsic.camera_from_lidar.transform;
  EXPECT_FALSE(board_shift(result, scene, pose, pose).has_value());
  scene.refinement.emplace();
  Rigid3 camera_from_board;
  camera_from_board.translation = {0.0, 0.0, 2.0};
  scene.refinement->lidar_from_board = pose.inverse() * camera_from_board;
  Rigid3 moved = pose;
  moved.translation.y() += 0.002;
  const auto shift = board_shift(result, scene, pose, moved);
  ASSERT_TRUE(shift.has_value());
  EXPECT_EQ(shift->first_px.size(), 49U);
  EXPECT_NEAR(shift->rms_px, 1e-3 * result.camera.fy, 0.1);
}

}  // namespace
}  // namespace lvcalib
