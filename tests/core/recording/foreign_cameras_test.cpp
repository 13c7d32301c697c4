// SPDX-License-Identifier: GPL-3.0-or-later
#include "recording/foreign_cameras.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/temporary_folder.h"

namespace lvcalib {
namespace {
using ::testing::HasSubstr;

constexpr const char* kKitti =
    "calib_time: 09-Jan-2012 13:57:47\ncorner_dist: 9.950000e-02\n"
    "S_02: 1.392000e+03 5.120000e+02\n"
    "K_02: 9.597910e+02 0.0 6.960217e+02 0.0 9.569251e+02 2.241806e+02 0.0 0.0 1.0\n"
    "D_02: -3.691481e-01 1.968681e-01 1.353473e-03 5.677587e-04 -6.770705e-02\n"
    "S_rect_02: 1.242000e+03 3.750000e+02\n"
    "P_rect_02: 7.215377e+02 0.0 6.095593e+02 4.485728e+01 0.0 7.215377e+02 1.728540e+02 "
    "2.163791e-01 0.0 0.0 1.0 2.745884e-03\n";

TEST(ForeignCameras, KittiHasRawAndRectifiedImages) {
  const auto raw = camera_of_kitti(kKitti, "02", false, "calib");
  ASSERT_TRUE(raw.ok()) << raw.error().text();
  EXPECT_EQ(raw->width_px, 1392);
  EXPECT_EQ(raw->height_px, 512);
  EXPECT_DOUBLE_EQ(raw->fy, 956.9251);
  EXPECT_DOUBLE_EQ(raw->cy, 224.1806);
  EXPECT_DOUBLE_EQ(raw->distortion[4], -0.06770705);
  const auto rectified = camera_of_kitti(kKitti, "02", true, "calib");
  ASSERT_TRUE(rectified.ok());
  EXPECT_EQ(rectified->width_px, 1242);
  EXPECT_DOUBLE_EQ(rectified->fx, 721.5377);
  EXPECT_DOUBLE_EQ(rectified->cx, 609.5593);
  EXPECT_DOUBLE_EQ(rectified->fy, 721.5377);
  EXPECT_DOUBLE_EQ(rectified->cy, 172.854);
  EXPECT_TRUE(rectified->distortion.isZero());
  const auto other = camera_of_kitti(kKitti, "03", true, "calib_cam_to_cam.txt");
  ASSERT_FALSE(other.ok());
  EXPECT_THAT(other.error().text(), HasSubstr("S_rect_03"));
  EXPECT_THAT(other.error().text(), HasSubstr("calib_cam_to_cam.txt"));
}

TEST(ForeignCameras, CalibJsonOfDirectVisualLidarCalibration) {
  const char* const text =
      R"({"camera": {"camera_model": "plumb_bob", "distortion_coeffs": [-0.1, 0.2, 0.001, 0.002, 0],
          "intrinsics": [1400.5, 1401.5, 960.25, 540.75]}, "meta": {"bag_names": ["a"]}})";
  const auto camera = camera_of_calib_json(text, 1920, 1080, "calib.json");
  ASSERT_TRUE(camera.ok()) << camera.error().text();
  EXPECT_EQ(camera->height_px, 1080);
  EXPECT_DOUBLE_EQ(camera->fy, 1401.5);
  EXPECT_DOUBLE_EQ(camera->distortion[2], 0.001);
  for (const auto& [json, why] :
       {std::pair(R"({"camera": {"camera_model": "omnidir", "intrinsics": [1, 2, 3, 4, 5]}})",
                  "omnidir"),
        {R"({"camera": {"camera_model": "fisheye", "intrinsics": [1, 2]}})", "intrinsics"},
        {R"({"camera": {"camera_model": "fisheye", "intrinsics": [900, 900, 960, 540],
             "distortion_coeffs": [1, 2, 3, 4, 5]}})",
         "more numbers"},
        {"[1, 2", "camera"}}) {
    const auto bad = camera_of_calib_json(json, 1920, 1080, "calib.json");
    ASSERT_FALSE(bad.ok()) << json;
    EXPECT_THAT(bad.error().text(), HasSubstr(why));
  }
}

TEST(ForeignCameras, QrParamsOfFastCalib) {
  const test::TemporaryFolder folder;
  const std::string lens =
      "fx: 1215.3\nfy: 1214.7\ncx: 1047.8\ncy: 745.0\nk1: -0.33\nk2: 0.11\n"
      "p1: 0.0002\np2: 0.0005\nk3: 0.01\nk4: 0.02\n";
  const auto pinhole = folder.write("pinhole.yaml", "cam_model: \"pinhole\"\n" + lens);
  const auto camera = camera_of_qr_params(pinhole, 2048, 1536);
  ASSERT_TRUE(camera.ok()) << camera.error().text();
  EXPECT_EQ(camera->model, DistortionModel::kPlumbBob);
  EXPECT_DOUBLE_EQ(camera->distortion[3], 0.0005);
  EXPECT_DOUBLE_EQ(camera->distortion[4], 0.0);
  const auto wide =
      camera_of_qr_params(folder.write("f.yaml", "cam_model: fisheye\n" + lens), 2048, 1536);
  ASSERT_TRUE(wide.ok());
  EXPECT_EQ(wide->model, DistortionModel::kEquidistant);
  EXPECT_DOUBLE_EQ(wide->distortion[3], 0.02);
  EXPECT_FALSE(camera_of_qr_params(folder.write("bad.yaml", "fx: 1\n"), 2048, 1536).ok());
}

}  // namespace
}  // namespace lvcalib
