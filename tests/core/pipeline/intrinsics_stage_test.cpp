// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/intrinsics_stage.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/random.h"
#include "pipeline/calibration.h"
#include "pipeline/camera_calibration.h"
#include "support/ordinary_boards.h"
#include "support/simulated_dataset.h"

namespace lvcalib {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
namespace fs = std::filesystem;

// Images without a cloud narrow what a few scenes leave open, and the result stays honest.
TEST(Calibrate, ImagesForTheCameraAloneNarrowItsIntrinsics) {
  constexpr int kScenes = 3;
  simulation::SimulationOptions options = test::dataset_options(21, kScenes);
  const test::SimulatedDataset data(options);
  CalibrationRequest request;
  request.options.intrinsics.mode = static_cast<int>(IntrinsicsMode::kFree);
  const auto without = calibrate(data.open(), request, {});
  ASSERT_TRUE(without.ok()) << without.error().text();
  EXPECT_TRUE(without->intrinsics.extra_images.empty());

  // The same rig goes on: scenes of which only the images are kept.
  options.scenes = kScenes + 6;
  options.placement.max_tilt_deg = 45.0;
  options.lidar.points = 500;
  const auto simulator = simulation::Simulator::create(options);
  ASSERT_TRUE(simulator.ok());
  ASSERT_EQ(simulator->rig().camera.fx, data.rig().camera.fx);
  fs::create_directories(data.path() / "intrinsics");
  const auto write = [&](const std::string& name, const std::string& bytes) {
    std::ofstream(data.path() / "intrinsics" / name, std::ios::binary) << bytes;
  };
  for (int s = kScenes; s < options.scenes; ++s) {
    const auto scene = simulator->simulate_scene(s, {});
    ASSERT_TRUE(scene.ok());
    write(scene->name + ".png", *simulation::encode_png(scene->image));
  }
  write("broken.png", "this is no image");
  fs::copy_file(data.path() / "scenes/A/image.png", data.path() / "intrinsics/copy.png");
  // The same board before another camera: what all images would agree on is neither.
  const auto another = simulation::Simulator::create(test::dataset_options(22, 1));
  ASSERT_TRUE(another.ok());
  write("another.png", *simulation::encode_png(another->simulate_scene(0, {})->image));
  const auto with = calibrate(data.open(), request, {});
  ASSERT_TRUE(with.ok()) << with.error().text();
  EXPECT_EQ(with->intrinsics.extra_images.size(), 9U);
  EXPECT_EQ(
      std::count_if(with->intrinsics.extra_images.begin(), with->intrinsics.extra_images.end(),
                    [](const BoardImage& image) { return image.used(); }),
      6);
  EXPECT_THAT(with->warnings, Contains(HasSubstr("another.png: its corners miss the camera")));
  EXPECT_THAT(without->warnings, Contains(HasSubstr("no board reached these parts")));
  EXPECT_THAT(with->warnings, Contains(HasSubstr("intrinsics/broken.png")));
  EXPECT_THAT(with->warnings, Contains(HasSubstr("intrinsics/copy.png")));
  for (Eigen::Index k = 0; k < 4; ++k) {
    EXPECT_LT(with->intrinsics.sigma(k), 0.8 * without->intrinsics.sigma(k)) << k;
    EXPECT_LT(std::abs(intrinsics_of(with->camera)(k) - intrinsics_of(data.rig().camera)(k)),
              4.0 * with->intrinsics.sigma(k))
        << k;
  }
  const Matrix6d& before = without->extrinsic.camera_from_lidar.covariance;
  const Matrix6d& after = with->extrinsic.camera_from_lidar.covariance;
  EXPECT_LT(after.trace(), before.trace());
  const Vector6d off =
      se3_log(data.rig().camera_from_lidar * with->extrinsic.camera_from_lidar.transform.inverse());
  for (int k = 0; k < 6; ++k) EXPECT_LT(std::abs(off(k)), 4.0 * std::sqrt(after(k, k))) << k;

  // The map over the image is of extrinsic and intrinsics together, which err together: against
  // draws from their covariance.
  Eigen::MatrixXd both(18, 18);
  std::array<Eigen::Index, 18> at;
  for (Eigen::Index k = 0; k < 18; ++k)
    at[static_cast<std::size_t>(k)] = k < 6 ? k : kFirstIntrinsic + k - 6;
  for (Eigen::Index i = 0; i < 18; ++i) {
    for (Eigen::Index j = 0; j < 18; ++j)
      both(i, j) = without->forward->globals_covariance(at[static_cast<std::size_t>(i)],
                                                        at[static_cast<std::size_t>(j)]);
  }
  const Eigen::VectorXd unit = both.diagonal().cwiseMax(1e-30).cwiseSqrt();
  const Eigen::MatrixXd correlations =
      unit.cwiseInverse().asDiagonal() * both * unit.cwiseInverse().asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> axes(correlations);
  const Eigen::MatrixXd root = unit.asDiagonal() * axes.eigenvectors() *
                               axes.eigenvalues().cwiseMax(0.0).cwiseSqrt().asDiagonal();
  ASSERT_FALSE(without->uncertainty.maps.empty());
  const ProjectedUncertainty& map = without->uncertainty.maps.front();
  Random random(5);
  constexpr int kDraws = 3000;
  const std::size_t middle = map.pixel.size() / 2 + static_cast<std::size_t>(map.columns) / 2;
  for (const std::size_t k : {middle, middle - 6}) {
    const Eigen::Vector3d point = map.range_m * *without->camera.unproject(map.pixel[k]);
    double squares = 0.0;
    for (int draw = 0; draw < kDraws; ++draw) {
      Eigen::VectorXd z(18);
      for (double& v : z) v = random.normal();
      const Eigen::VectorXd off = root * z;
      const Camera other =
          with_intrinsics(without->camera, intrinsics_of(without->camera) + off.tail<12>());
      const auto pixel = other.project(se3_exp(Vector6d(off.head<6>())) * point);
      ASSERT_TRUE(pixel);
      squares += (*pixel - map.pixel[k]).squaredNorm();
    }
    EXPECT_NEAR(std::sqrt(squares / kDraws) / map.sigma_px[k], 1.0, 0.07) << map.pixel[k];
  }

  // Held intrinsics that are wrong: the images tell.
  Dataset wrong = data.open();
  wrong.camera.fx *= 1.01;
  wrong.camera.fy *= 1.01;
  request.options.intrinsics.mode = static_cast<int>(IntrinsicsMode::kFixed);
  const auto fixed = calibrate(wrong, request, {});
  ASSERT_TRUE(fixed.ok()) << fixed.error().text();
  EXPECT_TRUE(fixed->intrinsics.contradiction.has_value());
}

// A camera calibrated as a fisheye that is none: it fits its own images about as well as can be,
// and turns the extrinsic by more than a milliradian.
TEST(Calibrate, NamesADistortionModelThatPredictsBetter) {
  const test::SimulatedDataset data(test::dataset_options(9109, 7));
  Dataset dataset = data.open();
  std::vector<fs::path> images;
  for (const SceneFiles& scene : dataset.scenes) images.push_back(scene.image);
  CameraCalibrationOptions as_fisheye;
  as_fisheye.model = DistortionModel::kEquidistant;
  const auto camera = calibrate_camera(images, dataset.target, as_fisheye, {});
  ASSERT_TRUE(camera.ok()) << camera.error().text();
  dataset.camera = camera->camera;
  const auto result = calibrate(dataset, {}, {});
  ASSERT_TRUE(result.ok()) << result.error().text();
  ASSERT_TRUE(result->intrinsics.contradiction);
  const IntrinsicsContradiction& found = *result->intrinsics.contradiction;
  EXPECT_EQ(found.better_model, DistortionModel::kPlumbBob);
  EXPECT_TRUE(found.matters);
  EXPECT_EQ(result->quality, Quality::kDoubtful);
  EXPECT_THAT(result->warnings,
              Contains(HasSubstr("the distortion model plumb_bob predicts images held out to")));
  // With it the extrinsic is nearer to the truth than what the given camera leads to.
  const Rigid3& truth = data.rig().camera_from_lidar;
  ASSERT_TRUE(found.camera_from_lidar);
  EXPECT_LT(rotation_distance_rad(truth, found.camera_from_lidar->transform),
            0.5 * rotation_distance_rad(truth, result->extrinsic.camera_from_lidar.transform));
}

// A principal point is nearly a turn of the camera, and the corners' noise held nearly all that it
// is not.
TEST(Calibrate, NamesAWrongPrincipalPointOfASingleTag) {
  simulation::SimulationOptions options = test::dataset_options(31, 3);
  options.target = test::single_tag_target();
  const test::SimulatedDataset data(options);
  Dataset dataset = data.open();
  dataset.camera.cx += 25.0;
  dataset.camera.cy += 25.0;
  const auto result = calibrate(dataset, {}, {});
  ASSERT_TRUE(result.ok()) << result.error().text();
  EXPECT_EQ(result->quality, Quality::kDoubtful);
  ASSERT_TRUE(result->intrinsics.contradiction);
  EXPECT_THAT(result->intrinsics.contradiction->what.text(), HasSubstr("the principal point is"));
  const Vector6d off = se3_log(data.rig().camera_from_lidar *
                               result->extrinsic.camera_from_lidar.transform.inverse());
  EXPECT_LT(off.dot(result->covariance_total.ldlt().solve(off)), 22.5);  // χ² of 6, 0.1 %.
}

// Poses follow the four corners of a tag, and its noise, whatever the camera is: what the ranges
// say tells.
TEST(Calibrate, NamesAWrongFocalLengthOfASingleTag) {
  for (const int scenes : {3, 5}) {
    simulation::SimulationOptions options = test::dataset_options(31, scenes);
    options.target = test::single_tag_target();
    const test::SimulatedDataset data(options);
    const Rigid3& truth = data.rig().camera_from_lidar;
    for (const double factor : {1.0, 1.01, 1.1}) {
      Dataset dataset = data.open();
      dataset.camera.fx *= factor;
      dataset.camera.fy *= factor;
      const auto result = calibrate(dataset, {}, {});
      ASSERT_TRUE(result.ok()) << result.error().text();
      const auto& found = result->intrinsics.contradiction;
      if (factor == 1.0) {
        EXPECT_EQ(result->quality, Quality::kGood) << scenes;
        EXPECT_FALSE(found) << found->what.text();
        continue;
      }
      EXPECT_EQ(result->quality, Quality::kDoubtful) << scenes << ", " << factor;
      ASSERT_TRUE(found) << scenes << ", " << factor;
      EXPECT_THAT(found->what.text(), HasSubstr("the focal length is"));
      const double error_m = translation_distance_m(
          truth.inverse(), result->extrinsic.camera_from_lidar.transform.inverse());
      EXPECT_GT(error_m, 0.01) << "too small a fault to be noticed";
      EXPECT_LT(error_m, 2.0 * std::sqrt(result->covariance_total.topLeftCorner<3, 3>().trace()));
    }
  }
}

// Three scenes that cannot tell such a camera from noise: what they leave open is in the total.
TEST(Calibrate, WhatFewCornersCannotTellOfTheCameraIsInTheTotalUncertainty) {
  simulation::SimulationOptions options = test::dataset_options(999'012, 3);
  options.image.width_px = 800;
  options.image.height_px = 500;
  options.lidar.points = 60'000;
  options.target = test::single_tag_target();
  const test::SimulatedDataset data(options);
  for (const double factor : {0.99, 1.005}) {
    Dataset dataset = data.open();
    dataset.camera.fx *= factor;
    dataset.camera.fy *= factor;
    const auto result = calibrate(dataset, {}, {});
    ASSERT_TRUE(result.ok()) << result.error().text();
    const Vector6d off = se3_log(data.rig().camera_from_lidar *
                                 result->extrinsic.camera_from_lidar.transform.inverse());
    EXPECT_GT(off.head<3>().norm(), 0.005) << "too small a fault to be noticed";
    EXPECT_LT(off.dot(result->covariance_total.ldlt().solve(off)), 22.5) << factor;  // 0.1 %.
  }
}

// Without circles scenes that contradict each other leave too few; what the images say is said.
TEST(Calibrate, NamesAWrongFocalLengthWhereItLeavesTooFewScenes) {
  simulation::SimulationOptions options = test::dataset_options(998'004, 3);
  options.lidar.kind = simulation::LidarKind::kRosette;
  options.lidar.points = 60'000;
  options.target = test::charuco_target();
  const test::SimulatedDataset data(options);
  Dataset dataset = data.open();
  dataset.camera.fx *= 1.1;
  dataset.camera.fy *= 1.1;
  const auto result = calibrate(dataset, {}, {});
  ASSERT_FALSE(result.ok());
  EXPECT_EQ(result.error().kind, ErrorKind::kUntrusted);
  EXPECT_THAT(result.error().text(), HasSubstr("the focal length is"));
}

// What the joint solve leaves of a few corners, against what poses of their own leave.
TEST(CornerMisfit, OfFewCornersIsThatOfTheJointSolve) {
  CalibrationResult result;
  result.options.intrinsics.false_alarm = 0.001;
  result.extrinsic.sigma_px = 0.02;
  result.forward.emplace();
  BoardView view;
  view.corners.resize(4);
  for (int s = 0; s < 3; ++s) {
    result.scenes.emplace_back();
    result.scenes.back().used = true;
    result.scenes.back().view = view;
  }
  // 24 coordinates, six of them left by the poses: F(24, 6) exceeds 16.9 once in a thousand times.
  const double gate = std::sqrt(16.9);
  result.forward->noise.corner_px = 0.97 * gate * 0.02;
  EXPECT_FALSE(corner_misfit(result));
  result.forward->noise.corner_px = 1.03 * gate * 0.02;
  const auto misfit = corner_misfit(result);
  ASSERT_TRUE(misfit);
  EXPECT_EQ(misfit->px, result.forward->noise.corner_px);
  EXPECT_EQ(misfit->noise_px, 0.02);
  // Replicates say what the noise is.
  result.intrinsics.replicate_px = 0.019;
  EXPECT_FALSE(corner_misfit(result));
  result.intrinsics.replicate_px = 0.009;
  EXPECT_EQ(corner_misfit(result)->px, 0.02);
}

// Boards that face the camera leave its focal length open: that is said, with the scene that would
// tell; tilted and spread ones do not.
TEST(Calibrate, SaysWhetherItsScenesVerifyTheCamera) {
  const auto judged = [](int scenes, double tilt_deg) {
    simulation::SimulationOptions options = test::dataset_options(31, scenes);
    options.placement.max_tilt_deg = tilt_deg;
    auto result = calibrate(test::SimulatedDataset(options).open(), {}, {});
    EXPECT_TRUE(result.ok()) << result.error().text();
    return std::move(*result);
  };
  const CalibrationResult open = judged(3, 12.0);
  EXPECT_FALSE(open.verified);
  EXPECT_THAT(open.warnings, Contains(HasSubstr("cannot verify the camera's intrinsics")));
  EXPECT_THAT(open.warnings, Contains(HasSubstr("would tell")));
  const CalibrationResult told = judged(8, 45.0);
  EXPECT_TRUE(told.verified);
  EXPECT_TRUE(told.unverified.empty());
}

}  // namespace
}  // namespace lvcalib
