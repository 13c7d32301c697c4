// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/camera_calibration.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "pipeline/camera_figures.h"
#include "support/camera_views.h"
#include "support/simulated_dataset.h"

namespace lvcalib {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;
namespace fs = std::filesystem;

using test::camera_of;
using test::images_of;
using test::Views;

CameraCalibration calibrated(std::vector<BoardImage> images,
                             const CameraCalibrationOptions& options = {}) {
  auto out = calibrate_camera(std::move(images), options, {});
  if (!out) {
    ADD_FAILURE() << out.error().text();
    return {};
  }
  return std::move(*out);
}

void expect_within_four_sigma(const CameraCalibration& result, const Camera& truth) {
  const IntrinsicsVector off = intrinsics_of(result.camera) - intrinsics_of(truth);
  for (Eigen::Index k = 0; k < 4 + truth.distortion_count(); ++k)
    EXPECT_LE(std::abs(off(k)), 4.0 * result.sigma(k)) << k;
  EXPECT_EQ(result.sigma.tail(8 - truth.distortion_count()).norm(), 0.0);
}

// From files, with nothing known of the camera.
TEST(CalibrateCamera, FindsTheTruthFromSimulatedImages) {
  simulation::SimulationOptions options = test::dataset_options(5, 8);
  options.lidar.points = 500;  // Nobody looks at the clouds.
  options.placement.min_distance_m = 1.2;
  options.placement.max_distance_m = 2.5;
  options.placement.max_tilt_deg = 45.0;
  const test::SimulatedDataset data(options);
  fs::remove(data.path() / "camera.yaml");
  const auto files = find_camera_images(data.path());
  ASSERT_TRUE(files.ok()) << files.error().text();
  ASSERT_EQ(files->images.size(), 8U);
  const auto result = calibrate_camera(files->images, data.rig().target, {}, {});
  ASSERT_TRUE(result.ok()) << result.error().text();
  EXPECT_EQ(result->used_images(), 8U);
  EXPECT_EQ(result->camera.model, DistortionModel::kPlumbBob);
  expect_within_four_sigma(*result, data.rig().camera);
  EXPECT_LT(result->sigma(0), 0.005 * result->camera.fx);
  EXPECT_LT(result->rms_px, 0.2);
  EXPECT_EQ(result->predictions.size(), 3U);
}

// χ² of what matters has its mean, the noise estimated from the residuals.
TEST(CalibrateCamera, StatesItsErrorAboutRight) {
  const Camera truth = camera_of(DistortionModel::kPlumbBob);
  CameraCalibrationOptions options;
  options.model = truth.model;
  options.start = truth;
  options.start->fx *= 1.1;
  options.start->fy *= 1.1;
  options.start->distortion.setZero();
  constexpr int kTrials = 120;
  constexpr int kDof = 6;  // fx fy cx cy k1 k2; the data alone determine them.
  double sum = 0.0;
  double largest = 0.0;
  for (int trial = 0; trial < kTrials; ++trial) {
    const auto result =
        calibrated(images_of(truth, {}, 1000 + static_cast<std::uint64_t>(trial)), options);
    const Eigen::VectorXd d = (intrinsics_of(result.camera) - intrinsics_of(truth)).head<kDof>();
    const Eigen::MatrixXd c = result.covariance.topLeftCorner<kDof, kDof>();
    const double chi = d.dot(c.ldlt().solve(d));
    sum += chi;
    largest = std::max(largest, chi);
  }
  // √(2/(6·120)) is 0.053: four of them.
  EXPECT_NEAR(sum / (kTrials * kDof), 1.0, 0.21);
  // One in a million.
  EXPECT_LT(largest, 38.0);
}

TEST(CalibrateCamera, StartsFromNothingForAnyFocalLength) {
  for (const double widths : {0.6, 1.0, 2.6}) {
    Camera truth = camera_of(DistortionModel::kPlumbBob);
    truth.fx = truth.fy = widths * truth.width_px;
    const auto result = calibrated(images_of(truth, {}, 3));
    EXPECT_EQ(result.camera.model, truth.model) << widths;
    EXPECT_NEAR(result.camera.fx, truth.fx, 4.0 * result.sigma(0)) << widths;
    EXPECT_LT(result.sigma(0), 0.01 * truth.fx) << widths;
  }
}

TEST(CalibrateCamera, ChoosesTheModelThatPredicts) {
  Camera truth = camera_of(DistortionModel::kEquidistant);
  truth.fx = truth.fy = 900.0;
  const auto result = calibrated(images_of(truth, {}, 4));
  EXPECT_EQ(result.camera.model, DistortionModel::kEquidistant);
  expect_within_four_sigma(result, truth);
  ASSERT_EQ(result.predictions.size(), 3U);
  EXPECT_EQ(result.predictions[0].model, DistortionModel::kPlumbBob);
  EXPECT_EQ(result.predictions[1].model, DistortionModel::kEquidistant);
  EXPECT_GT(result.predictions[0].held_out_px, 1.05 * result.predictions[1].held_out_px);
}

// So wide that plumb_bob folds back before the corners and cannot be fitted to all of them.
TEST(CalibrateCamera, FindsAFisheyeFromNothing) {
  const Camera truth = camera_of(DistortionModel::kEquidistant);
  const auto result = calibrated(images_of(truth, {}, 4));
  EXPECT_EQ(result.camera.model, DistortionModel::kEquidistant);
  expect_within_four_sigma(result, truth);
}

// A model that contains the truth predicts no better than the truth's own: the simpler one stays.
TEST(CalibrateCamera, KeepsTheSimplerModel) {
  const Camera truth = camera_of(DistortionModel::kPlumbBob);
  int kept = 0;
  for (std::uint64_t seed = 20; seed < 26; ++seed)
    kept += calibrated(images_of(truth, {}, seed)).camera.model == truth.model ? 1 : 0;
  EXPECT_EQ(kept, 6);
}

TEST(CalibrateCamera, TakesTheModelThatIsAskedFor) {
  CameraCalibrationOptions options;
  options.model = DistortionModel::kRationalPolynomial;
  const auto result = calibrated(images_of(camera_of(DistortionModel::kPlumbBob), {}, 6), options);
  EXPECT_EQ(result.camera.model, DistortionModel::kRationalPolynomial);
  EXPECT_TRUE(result.predictions.empty());
}

TEST(CalibrateCamera, BoardsThatFaceTheCameraAreNotEnough) {
  Views views;
  views.tilt_rad = 0.0;
  views.noise_px = 0.2;
  const auto result =
      calibrate_camera(images_of(camera_of(DistortionModel::kPlumbBob), views, 7), {}, {});
  ASSERT_FALSE(result.ok()) << result->sigma(0);
  EXPECT_EQ(result.error().kind, ErrorKind::kUntrusted);
  EXPECT_THAT(result.error().text(), HasSubstr("do not determine the focal length"));
}

TEST(CalibrateCamera, SaysWhatSpeaksAgainstIt) {
  Views views;
  views.count = 2;
  const Camera camera = camera_of(DistortionModel::kPlumbBob);
  auto images = images_of(camera, views, 8);
  // All that lies in the right third is gone.
  for (BoardImage& image : images)
    std::erase_if(image.view->corners, [&](const auto& c) { return c.pixel.x() > 900.0; });
  const auto result = calibrated(images);
  EXPECT_THAT(result.warnings, Contains(HasSubstr("only 2 images")));
  EXPECT_THAT(result.warnings,
              Contains(AllOf(HasSubstr("no board reached"), HasSubstr("right, "))));
  images = images_of(camera, {}, 9);
  EXPECT_THAT(calibrated(images).warnings, Not(Contains(HasSubstr("images: take"))));
}

TEST(CalibrateCamera, LeavesOutStraysAndRepeats) {
  const Camera truth = camera_of(DistortionModel::kPlumbBob);
  auto images = images_of(truth, {}, 10);
  images.push_back(images[0]);
  images.back().path = "again.png";
  // Another board: its columns of tags lie otherwise.
  for (CornerObservation& c : images[2].view->corners)
    c.pixel.x() += c.feature_id % 2 == 0 ? 2.0 : -2.0;
  const auto result = calibrated(images);
  EXPECT_EQ(result.used_images(), 7U);
  EXPECT_THAT(result.images[2].reason, HasSubstr("miss the camera of the other images"));
  EXPECT_THAT(result.images.back().reason, HasSubstr("the same image as image0.png"));
  EXPECT_THAT(result.warnings, Contains(HasSubstr("again.png")));
  expect_within_four_sigma(result, truth);
}

TEST(CalibrateCamera, RefusesImagesOfTwoSizesAndNone) {
  auto images = images_of(camera_of(DistortionModel::kPlumbBob), {}, 11);
  images[3].width_px = 1280;
  const auto result = calibrate_camera(images, {}, {});
  ASSERT_FALSE(result.ok());
  EXPECT_EQ(result.error().kind, ErrorKind::kInput);
  EXPECT_EQ(result.error().where, "image3.png");
  EXPECT_EQ(calibrate_camera(std::vector<BoardImage>{}, {}, {}).error().kind, ErrorKind::kInput);
}

// The field of residuals and the map of directions, over many sets of images: the map must say how
// far directions scatter from set to set.
TEST(CameraFigures, DirectionsFallAsFarAsideAsTheMapSays) {
  const Camera truth = camera_of(DistortionModel::kPlumbBob);
  CameraCalibrationOptions options;
  options.model = DistortionModel::kPlumbBob;
  std::vector<double> whitened;
  for (std::uint64_t seed = 1; seed <= 25; ++seed) {
    const CameraCalibration made = calibrated(images_of(truth, {}, seed), options);
    const CameraFigures figures = camera_figures(made);
    ASSERT_EQ(figures.images.size(), made.images.size());
    std::size_t corners = 0;
    for (const CameraFigures::Image& image : figures.images) corners += image.corners;
    EXPECT_EQ(figures.corners.size(), 2 * corners);
    for (std::size_t k = 0; k < figures.projection.pixel.size(); k += 31) {
      const auto there = made.camera.unproject(figures.projection.pixel[k]);
      ASSERT_TRUE(there.has_value());
      const double miss = (*truth.project(*there) - figures.projection.pixel[k]).norm();
      whitened.push_back(std::pow(miss / figures.projection.sigma_px[k], 2));
    }
  }
  // One on average; 25 sets of about four free numbers each: known to 14 %.
  double mean = 0.0;
  for (const double w : whitened) mean += w / static_cast<double>(whitened.size());
  EXPECT_GT(mean, 0.6);
  EXPECT_LT(mean, 1.5);
}

TEST(CameraFigures, ResidualsAreThoseOfTheImages) {
  const Camera truth = camera_of(DistortionModel::kPlumbBob);
  auto images = images_of(truth, {}, 5);
  images.push_back(images.front());
  images.back().path = "again.png";
  const CameraCalibration made = calibrated(std::move(images));
  const CameraFigures figures = camera_figures(made);
  const CameraFigures::Image& again = figures.images.back();
  EXPECT_EQ(again.corners, 0U);
  EXPECT_THAT(again.reason.text(), HasSubstr("counts once"));
  double squares = 0.0;
  std::size_t corners = 0;
  for (const CameraFigures::Image& image : figures.images) {
    squares += static_cast<double>(image.corners) * image.rms_px * image.rms_px;
    corners += image.corners;
  }
  EXPECT_NEAR(std::sqrt(squares / static_cast<double>(corners)), made.rms_px, 1e-6);
  double sum = 0.0;
  for (const float v : figures.corners.value)
    sum += static_cast<double>(v) * static_cast<double>(v);
  EXPECT_NEAR(std::sqrt(sum / static_cast<double>(corners)), made.rms_px, 1e-4);
  EXPECT_TRUE(figures.corners.find("image x") != nullptr);
}

TEST(CameraFigures, PartsOfTheImageThatNoCornerReached) {
  Camera camera = camera_of(DistortionModel::kPlumbBob);
  camera.width_px = 300;
  camera.height_px = 90;
  const auto parts = unreached_parts({{10, 10}, {150, 10}, {290, 10}, {10, 45}, {150, 45}}, camera);
  std::vector<std::string> names;
  for (const Message& part : parts) names.push_back(part.text());
  EXPECT_THAT(names, ElementsAre("right", "bottom left", "bottom", "bottom right"));
}

}  // namespace
}  // namespace lvcalib
