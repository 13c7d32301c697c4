// SPDX-License-Identifier: GPL-3.0-or-later
// Scenes that are there twice, and images that are turned, in a whole calibration.
#include "pipeline/scene_copies.h"

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

}  // namespace
}  // namespace lvcalib
