// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/colored_cloud.h"

#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/calib3d.hpp>

#include "support/image_files.h"
#include "support/synthetic_observations.h"
#include "support/temporary_folder.h"

namespace lvcalib {
namespace {
using ::testing::HasSubstr;

// Colours that say where they are: red grows to the right, green downwards.
ColorImage ramp(const Camera& camera) {
  ColorImage image{camera.width_px, camera.height_px, {}};
  for (int y = 0; y < camera.height_px; ++y) {
    for (int x = 0; x < camera.width_px; ++x) {
      image.rgb.push_back(static_cast<std::uint8_t>(200.0 * x / camera.width_px));
      image.rgb.push_back(static_cast<std::uint8_t>(200.0 * y / camera.height_px));
      image.rgb.push_back(7);
    }
  }
  return image;
}

// A wall some metres ahead of the camera, with intensities; some points are behind it.
Cloud wall(const Rigid3& camera_from_lidar) {
  Cloud cloud;
  for (int y = -10; y <= 10; ++y) {
    for (int x = -10; x <= 10; ++x) {
      const Eigen::Vector3d p(0.1 * x, 0.05 * y, 4.0);
      cloud.points_m.push_back((camera_from_lidar.inverse() * p).cast<float>());
      cloud.intensity.push_back(static_cast<float>(x));
    }
  }
  return cloud;
}

// Where OpenCV projects a point.
Eigen::Vector2d opencv_pixel(const Camera& c, const Eigen::Vector3d& p) {
  const cv::Matx33d K(c.fx, 0, c.cx, 0, c.fy, c.cy, 0, 0, 1);
  std::vector<double> distortion(c.distortion.data(), c.distortion.data() + 5);
  std::vector<cv::Point2d> out;
  cv::projectPoints(std::vector<cv::Point3d>{{p.x(), p.y(), p.z()}}, cv::Vec3d(0, 0, 0),
                    cv::Vec3d(0, 0, 0), K, distortion, out);
  return {out[0].x, out[0].y};
}

TEST(ColoredCloud, PointsHaveTheColoursThatTheCameraSeesThere) {
  const Camera camera = test::test_camera();
  const Rigid3 pose = test::test_extrinsic();
  const Cloud cloud = wall(pose);
  const ColoredCloud out = color_cloud(cloud, ramp(camera), camera, pose);
  ASSERT_EQ(out.cloud.size() + out.outside, cloud.size());
  ASSERT_GT(out.cloud.size(), 100U);
  ASSERT_EQ(out.rgb.size(), 3 * out.cloud.size());
  for (std::size_t i = 0; i < out.cloud.size(); ++i) {
    const Eigen::Vector2d pixel = opencv_pixel(camera, pose * out.cloud.points_m[i].cast<double>());
    EXPECT_NEAR(out.rgb[3 * i], 200.0 * pixel.x() / camera.width_px, 1.5);
    EXPECT_NEAR(out.rgb[3 * i + 1], 200.0 * pixel.y() / camera.height_px, 1.5);
    EXPECT_EQ(out.rgb[3 * i + 2], 7);
  }
}

TEST(ColoredCloud, WhatIsBehindSomethingOrOutsideHasNone) {
  const Camera camera = test::test_camera();
  const Rigid3 pose = test::test_extrinsic();
  Cloud cloud;
  const auto add = [&](const Eigen::Vector3d& in_camera) {
    cloud.points_m.push_back((pose.inverse() * in_camera).cast<float>());
  };
  add({0.0, 0.0, 2.0});
  add({0.0, 0.0, 4.0});    // Behind the first.
  add({0.004, 0.0, 2.1});  // Beside it, as a slanted surface would be.
  add({0.0, 0.0, -3.0});
  add({50.0, 0.0, 3.0});
  const ColoredCloud out = color_cloud(cloud, ramp(camera), camera, pose);
  EXPECT_EQ(out.cloud.size(), 2U);
  EXPECT_EQ(out.hidden, 1U);
  EXPECT_EQ(out.outside, 2U);
}

class ColoredPly : public ::testing::Test {
 protected:
  void SetUp() override {
    input_.camera_from_lidar = test::test_extrinsic();
    input_.camera = test::test_camera();
    input_.dataset = folder_.path().string();
    input_.scenes = {{"A", true, "scenes/A/image.png", "scenes/A/cloud.pcd", {}},
                     {"B", true, "", "", {}}};
    std::filesystem::create_directories(folder_.path() / "scenes" / "A");
    const ColorImage image = ramp(input_.camera);
    cv::Mat bgr(image.height_px, image.width_px, CV_8UC3);
    for (std::size_t i = 0; i < image.rgb.size() / 3; ++i) {
      for (std::size_t c = 0; c < 3; ++c) bgr.data[3 * i + c] = image.rgb[3 * i + 2 - c];
    }
    test::write_png(folder_.path() / "scenes/A/image.png", bgr);
    ASSERT_TRUE(
        write_pcd(folder_.path() / "scenes/A/cloud.pcd", wall(input_.camera_from_lidar)).ok());
  }
  [[nodiscard]] std::filesystem::path ply() const { return folder_.path() / "a.ply"; }
  const test::TemporaryFolder folder_;
  ExportInput input_;
};

TEST_F(ColoredPly, IsReadBackByItsHeader) {
  const auto written = write_colored_ply(input_, "", ply(), {});
  ASSERT_TRUE(written.ok()) << written.error().text();
  std::ostringstream all;
  all << std::ifstream(ply(), std::ios::binary).rdbuf();
  const std::string content = all.str();
  const auto end = content.find("end_header\n");
  ASSERT_NE(end, std::string::npos);
  const std::string header = content.substr(0, end);
  EXPECT_THAT(header, HasSubstr("comment worked point: lidar_m ="));
  EXPECT_THAT(header, HasSubstr("element vertex " + std::to_string(written->cloud.size()) + "\n"));
  EXPECT_THAT(header, HasSubstr("property float intensity"));
  const std::string body = content.substr(end + 11);
  // x y z, three bytes, intensity.
  ASSERT_EQ(body.size(), 19 * written->cloud.size());
  for (std::size_t i = 0; i < written->cloud.size(); ++i) {
    float xyz[3];
    float intensity = 0.0F;
    std::memcpy(xyz, &body[19 * i], 12);
    std::memcpy(&intensity, &body[19 * i + 15], 4);
    EXPECT_EQ(xyz[0], written->cloud.points_m[i].x());
    EXPECT_EQ(static_cast<std::uint8_t>(body[19 * i + 12]), written->rgb[3 * i]);
    EXPECT_EQ(static_cast<std::uint8_t>(body[19 * i + 14]), 7);
    EXPECT_EQ(intensity, written->cloud.intensity[i]);
  }
  // The library's own reader takes it, too.
  const auto cloud = read_cloud(ply());
  ASSERT_TRUE(cloud.ok()) << cloud.error().text();
  EXPECT_EQ(cloud->size(), written->cloud.size());
}

TEST_F(ColoredPly, SaysWhatIsMissing) {
  const auto unknown = write_colored_ply(input_, "C", ply(), {});
  ASSERT_FALSE(unknown.ok());
  EXPECT_EQ(unknown.error().kind, ErrorKind::kUsage);
  EXPECT_THAT(unknown.error().text(), HasSubstr("there is no scene 'C'"));
  EXPECT_EQ(write_colored_ply(input_, "B", ply(), {}).error().kind, ErrorKind::kUsage);
  std::filesystem::remove(folder_.path() / "scenes/A/image.png");
  const auto gone = write_colored_ply(input_, "A", ply(), {});
  ASSERT_FALSE(gone.ok());
  EXPECT_EQ(gone.error().kind, ErrorKind::kInput);
  EXPECT_FALSE(std::filesystem::exists(ply()));
  std::stop_source stop;
  stop.request_stop();
  RunContext context;
  context.stop = stop.get_token();
  EXPECT_FALSE(write_colored_ply(input_, "A", ply(), context).ok());
}

}  // namespace
}  // namespace lvcalib
