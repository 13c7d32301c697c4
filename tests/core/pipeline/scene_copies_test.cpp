// SPDX-License-Identifier: GPL-3.0-or-later
// Scenes that are there twice, and images that are turned, in a whole calibration.
#include "pipeline/scene_copies.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "pipeline/calibration.h"
#include "support/image_files.h"
#include "support/simulated_dataset.h"

namespace lvcalib {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;
namespace fs = std::filesystem;

TEST(Calibrate, ASceneWrittenAgainCountsOnce) {
  const test::SimulatedDataset data(test::dataset_options(1, 3));
  const auto once = calibrate(data.open(), {}, {});
  ASSERT_TRUE(once.ok()) << once.error().text();
  const fs::path scenes = data.path() / "scenes";
  fs::create_directories(scenes / "D");
  cv::Mat pixels = test::read_pixels(scenes / "A/image.png");
  pixels.data[pixels.total() / 3] ^= 1U;
  ASSERT_TRUE(test::write_png(scenes / "D/image.png", pixels));
  auto cloud = read_cloud(scenes / "A/cloud.pcd");
  ASSERT_TRUE(cloud.ok());
  for (Eigen::Vector3f& p : cloud->points_m) p = 1e-4F * (1e4F * p).array().round();
  ASSERT_TRUE(write_pcd(scenes / "D/cloud.pcd", *cloud).ok());
  const auto twice = calibrate(data.open(), {}, {});
  ASSERT_TRUE(twice.ok()) << twice.error().text();
  EXPECT_FALSE(twice->scenes[3].used);
  EXPECT_THAT(twice->scenes[3].reason.text(), HasSubstr("scene A, of which it is a copy"));
  EXPECT_EQ(twice->extrinsic.camera_from_lidar.covariance,
            once->extrinsic.camera_from_lidar.covariance);
}

void turn_image(const fs::path& path, cv::RotateFlags how) {
  cv::Mat turned;
  cv::rotate(test::read_pixels(path), turned, how);
  ASSERT_TRUE(test::write_png(path, turned));
}

TEST(Calibrate, TurnedImagesAreNamedAndNotTheCamera) {
  simulation::SimulationOptions options = test::dataset_options(5, 4);
  options.image.width_px = 700;
  options.image.height_px = 700;
  const test::SimulatedDataset data(options);
  Dataset dataset = data.open();
  const auto as_they_are = calibrate(dataset, {}, {});
  ASSERT_TRUE(as_they_are.ok()) << as_they_are.error().text();
  EXPECT_THAT(as_they_are->warnings, Not(Contains(HasSubstr("turned"))));

  turn_image(dataset.scenes[1].image, cv::ROTATE_90_CLOCKWISE);
  const auto one = calibrate(dataset, {}, {});
  ASSERT_TRUE(one.ok()) << one.error().text();
  EXPECT_EQ(one->quality, Quality::kDoubtful);
  EXPECT_FALSE(one->scenes[1].used);
  EXPECT_THAT(one->scenes[1].reason.text(), HasSubstr("turned counterclockwise by 90°"));
  EXPECT_THAT(one->warnings, Not(Contains(HasSubstr("contradict the intrinsics"))));

  for (const std::size_t s : {0U, 2U, 3U})
    turn_image(dataset.scenes[s].image, cv::ROTATE_90_CLOCKWISE);
  const auto all = calibrate(dataset, {}, {});
  ASSERT_TRUE(all.ok()) << all.error().text();
  EXPECT_EQ(all->quality, Quality::kDoubtful);
  ASSERT_TRUE(all->intrinsics.contradiction);
  EXPECT_EQ(all->intrinsics.contradiction->turned_deg, 90);
  EXPECT_THAT(all->warnings, Contains(HasSubstr("once they are turned counterclockwise by 90°")));
  EXPECT_THAT(all->warnings, Not(Contains(HasSubstr("calibrate the camera again"))));
}

// Of two halves the one that the intrinsics fit is right, whichever has the better clouds.
TEST(Calibrate, OfTwoHalvesTheIntrinsicsTellWhichIsTurned) {
  const test::SimulatedDataset data(test::dataset_options(6, 4));
  const Dataset dataset = data.open();
  const auto turn = [&](const std::vector<std::size_t>& scenes) {
    for (const std::size_t s : scenes) turn_image(dataset.scenes[s].image, cv::ROTATE_180);
  };
  for (const std::vector<std::size_t>& half :
       {std::vector<std::size_t>{0, 1}, {2, 3}, {0, 2}, {1, 3}}) {
    turn(half);
    const auto result = calibrate(dataset, {}, {});
    ASSERT_TRUE(result.ok()) << result.error().text();
    EXPECT_EQ(result->quality, Quality::kDoubtful);
    for (std::size_t s = 0; s < 4; ++s) {
      const bool turned = std::find(half.begin(), half.end(), s) != half.end();
      EXPECT_EQ(result->scenes[s].used, !turned) << s;
      if (turned) {
        EXPECT_THAT(result->scenes[s].reason.text(),
                    HasSubstr("its image is turned against those of the other scenes"));
      }
    }
    EXPECT_THAT(result->warnings, Not(Contains(HasSubstr("did a sensor move"))));
    EXPECT_LT(rotation_distance_rad(data.rig().camera_from_lidar,
                                    result->extrinsic.camera_from_lidar.transform),
              0.01);
    turn(half);
  }
}

// The image that another camera at the same place would have taken, and black where the one did not
// see; between pixels bilinear.
void see_with(const fs::path& path, const Camera& from, const Camera& to) {
  const cv::Mat before = test::read_pixels(path);
  cv::Mat after = cv::Mat::zeros(before.size(), before.type());
  const auto channels = static_cast<std::size_t>(before.channels());
  for (int y = 0; y < after.rows; ++y) {
    for (int x = 0; x < after.cols; ++x) {
      const auto p = from.project(*to.unproject(Eigen::Vector2d(x, y)));
      if (!p) continue;
      const int u = static_cast<int>(std::floor(p->x()));
      const int v = static_cast<int>(std::floor(p->y()));
      if (u < 0 || v < 0 || u + 1 >= before.cols || v + 1 >= before.rows) continue;
      const double a = p->x() - u;
      const double b = p->y() - v;
      for (std::size_t c = 0; c < channels; ++c) {
        const auto at = [&](int dx, int dy) {
          return before.ptr<std::uint8_t>(v + dy)[static_cast<std::size_t>(u + dx) * channels + c];
        };
        after.ptr<std::uint8_t>(y)[static_cast<std::size_t>(x) * channels + c] =
            static_cast<std::uint8_t>(std::lround((1 - b) * ((1 - a) * at(0, 0) + a * at(1, 0)) +
                                                  b * ((1 - a) * at(0, 1) + a * at(1, 1))));
      }
    }
  }
  ASSERT_TRUE(test::write_png(path, after));
}

// A camera without distortion and with its principal point in the middle is the same turned by half
// a turn: nothing is called wrong, unless a rough extrinsic tells.
TEST(Calibrate, HalvesThatNothingTellsApartAreBothNamed) {
  const test::SimulatedDataset data(test::dataset_options(6, 4));
  Dataset dataset = data.open();
  dataset.camera.cx = 0.5 * (dataset.camera.width_px - 1);
  dataset.camera.cy = 0.5 * (dataset.camera.height_px - 1);
  dataset.camera.fy = dataset.camera.fx;
  dataset.camera.distortion.setZero();
  dataset.camera.model = DistortionModel::kPlumbBob;
  for (const SceneFiles& scene : dataset.scenes)
    see_with(scene.image, data.rig().camera, dataset.camera);
  for (const std::size_t s : {1U, 2U}) turn_image(dataset.scenes[s].image, cv::ROTATE_180);
  const auto result = calibrate(dataset, {}, {});
  ASSERT_TRUE(result.ok()) << result.error().text();
  EXPECT_EQ(result->quality, Quality::kDoubtful);
  EXPECT_THAT(result->warnings, Contains(HasSubstr("nothing tells which are as the camera gives")));
  EXPECT_THAT(result->warnings, Not(Contains(HasSubstr("its image is turned"))));
  CalibrationRequest guessed;
  guessed.guess = data.rig().camera_from_lidar;
  const auto told = calibrate(dataset, guessed, {});
  ASSERT_TRUE(told.ok()) << told.error().text();
  for (std::size_t s = 0; s < 4; ++s) EXPECT_EQ(told->scenes[s].used, s == 0 || s == 3) << s;
  EXPECT_THAT(told->warnings, Not(Contains(HasSubstr("nothing tells which"))));
}

}  // namespace
}  // namespace lvcalib
