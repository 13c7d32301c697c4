// SPDX-License-Identifier: GPL-3.0-or-later
#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include "camera/camera.h"
#include "camera/camera_deviations.h"

namespace lvcalib {
namespace {
using ::testing::HasSubstr;

class CameraYaml : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::temp_directory_path() /
              ("lvcalib_camera_" + std::string(info->name()) + std::to_string(::getpid()));
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  [[nodiscard]] std::filesystem::path path(const std::string& name = "camera.yaml") const {
    return folder_ / name;
  }
  Result<CameraFile> read(const std::string& text, const std::string& name = "camera.yaml") const {
    std::ofstream(path(name)) << text;
    return read_camera(path(name));
  }
  // The error of a file that must be refused.
  [[nodiscard]] std::string error(const std::string& text) const {
    const auto file = read(text);
    EXPECT_FALSE(file.ok()) << text;
    if (file) return {};
    EXPECT_EQ(file.error().kind, ErrorKind::kInput);
    EXPECT_THAT(file.error().where, HasSubstr("camera.yaml"));
    return file.error().text();
  }
  std::filesystem::path folder_;
};

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

const char* const kRos = R"(image_width: 1440
image_height: 900
camera_name: front
camera_matrix:
  rows: 3
  cols: 3
  data: [1020, 0, 731.166, 0, 1018.755, 458.48, 0, 0, 1]
distortion_model: plumb_bob
distortion_coefficients:
  rows: 1
  cols: 5
  data: [-0.07796, 0.04317, -0.000285, -0.000278, 0.01]
rectification_matrix:
  rows: 3
  cols: 3
  data: [1, 0, 0, 0, 1, 0, 0, 0, 1]
)";

const char* const kKalibr = R"(cam0:
  cam_overlaps: [1]
  camera_model: pinhole
  distortion_coeffs: [-0.1, 0.02, 0.003, -0.004]
  distortion_model: radtan
  intrinsics: [461.6, 460.3, 362.7, 246.2]
  resolution: [752, 480]
  rostopic: /cam0/image_raw
)";

const char* const kOpenCv = R"(%YAML:1.0
---
calibration_time: "Mon 01 Jan 2024"
image_width: 640
image_height: 480
camera_matrix: !!opencv-matrix
   rows: 3
   cols: 3
   dt: d
   data: [ 5.3e+02, 0., 3.2e+02, 0., 5.31e+02, 2.4e+02, 0., 0., 1. ]
distortion_coefficients: !!opencv-matrix
   rows: 5
   cols: 1
   dt: d
   data: [ -2.6e-01, 1.0e-01, 1.e-03, -2.e-03, 5.e-02 ]
avg_reprojection_error: 2.2e-01
)";

TEST_F(CameraYaml, ReadsRosCameraInfo) {
  const auto file = read(kRos);
  ASSERT_TRUE(file.ok()) << file.error().text();
  EXPECT_TRUE(file->warnings.empty());
  const Camera& c = file->camera;
  EXPECT_EQ(c.width_px, 1440);
  EXPECT_EQ(c.height_px, 900);
  EXPECT_EQ(c.name, "front");
  EXPECT_EQ(c.fx, 1020);
  EXPECT_EQ(c.fy, 1018.755);
  EXPECT_EQ(c.cx, 731.166);
  EXPECT_EQ(c.cy, 458.48);
  EXPECT_EQ(c.model, DistortionModel::kPlumbBob);
  EXPECT_EQ(c.distortion[0], -0.07796);
  EXPECT_EQ(c.distortion[4], 0.01);
}

TEST_F(CameraYaml, ReadsTheRosMessageAsPrinted) {
  const auto file = read(
      "height: 480\nwidth: 640\ndistortion_model: rational_polynomial\n"
      "D: [1, 2, 3, 4, 5, 6, 7, 8]\nK: [500, 0, 320, 0, 501, 240, 0, 0, 1]\n"
      "R: [1, 0, 0, 0, 1, 0, 0, 0, 1]\nbinning_x: 0\nbinning_y: 0\n");
  ASSERT_TRUE(file.ok()) << file.error().text();
  EXPECT_EQ(file->camera.model, DistortionModel::kRationalPolynomial);
  EXPECT_EQ(file->camera.distortion[7], 8);
  EXPECT_EQ(file->camera.width_px, 640);
}

TEST_F(CameraYaml, ReadsKalibrCamchains) {
  const auto one = read(kKalibr);
  ASSERT_TRUE(one.ok()) << one.error().text();
  EXPECT_TRUE(one->warnings.empty());
  EXPECT_EQ(one->camera.width_px, 752);
  EXPECT_EQ(one->camera.fy, 460.3);
  EXPECT_EQ(one->camera.cx, 362.7);
  EXPECT_EQ(one->camera.distortion[3], -0.004);
  EXPECT_EQ(one->camera.model, DistortionModel::kPlumbBob);

  const auto fisheye = read(replaced(kKalibr, "radtan", "equidistant"));
  ASSERT_TRUE(fisheye.ok());
  EXPECT_EQ(fisheye->camera.model, DistortionModel::kEquidistant);

  const auto two = read(std::string(kKalibr) + replaced(kKalibr, "cam0", "cam1"));
  ASSERT_TRUE(two.ok());
  EXPECT_EQ(two->camera.name, "cam0");
  ASSERT_EQ(two->warnings.size(), 1U);
  EXPECT_THAT(two->warnings[0], HasSubstr("2 cameras"));
}

TEST_F(CameraYaml, ReadsOpenCvUnderItsManyNames) {
  for (const auto& [matrix, coefficients] : {std::pair{"camera_matrix", "distortion_coefficients"},
                                             std::pair{"Camera_Matrix", "Distortion_Coefficients"},
                                             std::pair{"cameraMatrix", "distCoeffs"}}) {
    const auto file = read(replaced(replaced(kOpenCv, "camera_matrix", matrix),
                                    "distortion_coefficients", coefficients));
    ASSERT_TRUE(file.ok()) << file.error().text();
    EXPECT_TRUE(file->warnings.empty());
    EXPECT_EQ(file->camera.fx, 530);
    EXPECT_EQ(file->camera.cy, 240);
    EXPECT_EQ(file->camera.distortion[4], 0.05);
    EXPECT_EQ(file->camera.model, DistortionModel::kPlumbBob);
  }
}

TEST_F(CameraYaml, ReadsWhatOpenCvItselfWrites) {
  const cv::Mat k = (cv::Mat_<double>(3, 3) << 700.25, 0, 400.5, 0, 701, 300, 0, 0, 1);
  for (const int count : {4, 5, 8}) {
    cv::Mat d(1, count, CV_64F);
    for (int i = 0; i < count; ++i) d.at<double>(i) = 0.01 * (i + 1);
    {
      cv::FileStorage out(path().string(), cv::FileStorage::WRITE);
      out << "image_width" << 800 << "image_height" << 600 << "cameraMatrix" << k << "distCoeffs"
          << d;
    }
    const auto file = read_camera(path());
    ASSERT_TRUE(file.ok()) << file.error().text();
    EXPECT_EQ(file->camera.fx, 700.25);
    EXPECT_EQ(file->camera.model,
              count == 8 ? DistortionModel::kRationalPolynomial : DistortionModel::kPlumbBob);
    for (int i = 0; i < count; ++i) EXPECT_NEAR(file->camera.distortion[i], 0.01 * (i + 1), 1e-15);
    // Four coefficients without a model may be a fisheye's: said aloud.
    EXPECT_EQ(file->warnings.size(), count == 4 ? 1U : 0U);
  }
}

TEST_F(CameraYaml, WritesWhatItReads) {
  for (const auto model : {DistortionModel::kPlumbBob, DistortionModel::kRationalPolynomial,
                           DistortionModel::kEquidistant}) {
    Camera camera{1440, 900, 1020.1, 1018.755, 731.166, 458.48, model, {}, "left \"eye\" \\ 1"};
    camera.distortion.setZero();
    for (int i = 0; i < camera.distortion_count(); ++i) camera.distortion[i] = 1e-3 / (i + 3);
    const auto file = read(to_yaml(camera));
    ASSERT_TRUE(file.ok()) << file.error().text();
    EXPECT_TRUE(file->warnings.empty());
    EXPECT_EQ(file->camera.name, camera.name);
    EXPECT_EQ(file->camera.model, model);
    EXPECT_EQ(file->camera.distortion, camera.distortion);
    EXPECT_EQ(file->camera.fx, camera.fx);
    EXPECT_EQ(file->camera.cy, camera.cy);
    EXPECT_EQ(file->camera.width_px, camera.width_px);
  }
}

TEST_F(CameraYaml, WritesStandardDeviationsThatItReads) {
  Camera camera;
  camera.width_px = 640;
  camera.height_px = 480;
  camera.fx = camera.fy = 500.25;
  camera.cx = 319.5;
  camera.cy = 239.5;
  camera.model = DistortionModel::kEquidistant;
  CameraDeviations sigma = CameraDeviations::Zero();
  sigma.head<8>() << 0.125, 0.25, 0.5, 1.0, 1e-3, 2e-3, 4e-3, 1.5e-4;
  const auto back = read(to_yaml(camera, sigma));
  ASSERT_TRUE(back.ok()) << back.error().text();
  EXPECT_TRUE(back->warnings.empty());
  EXPECT_EQ(back->camera.fx, camera.fx);
  const auto read_sigma = read_camera_deviations(path(), back->camera);
  ASSERT_TRUE(read_sigma.ok() && read_sigma->has_value());
  EXPECT_TRUE((**read_sigma).head<8>().isApprox(sigma.head<8>()));
  // What is not stated is not written.
  sigma.setConstant(-1.0);
  sigma(2) = 0.75;
  ASSERT_TRUE(read(to_yaml(camera, sigma)).ok());
  const auto one = read_camera_deviations(path(), camera);
  ASSERT_TRUE(one.ok() && one->has_value());
  EXPECT_EQ((**one)(2), 0.75);
  EXPECT_EQ((**one)(0), -1.0);
  EXPECT_EQ((**one)(4), -1.0);
}

TEST_F(CameraYaml, WarnsOfUnknownKeysWithTheNearestKnownOne) {
  const auto ros = read(std::string(kRos) + "distorsion_model: plumb_bob\n");
  ASSERT_TRUE(ros.ok());
  ASSERT_EQ(ros->warnings.size(), 1U);
  EXPECT_THAT(ros->warnings[0], HasSubstr("camera.yaml:17"));
  EXPECT_THAT(ros->warnings[0], HasSubstr("did you mean 'distortion_model'?"));
  const auto kalibr = read(std::string(kKalibr) + "  intrinsic: 1\n");
  ASSERT_TRUE(kalibr.ok());
  ASSERT_EQ(kalibr->warnings.size(), 1U);
  EXPECT_THAT(kalibr->warnings[0], HasSubstr("did you mean 'intrinsics'?"));
}

TEST_F(CameraYaml, WarnsWhenTheDistortionFoldsInsideTheImage) {
  const auto file = read(replaced(kRos, "-0.07796", "-1.5"));
  ASSERT_TRUE(file.ok());
  ASSERT_EQ(file->warnings.size(), 1U);
  EXPECT_THAT(file->warnings[0], HasSubstr("folds back"));
}

TEST_F(CameraYaml, RefusesBadRosFiles) {
  EXPECT_THAT(error(replaced(kRos, "image_width: 1440\n", "")), HasSubstr("image_width"));
  EXPECT_THAT(error(replaced(kRos, "1440", "0")), HasSubstr("between 1 and"));
  EXPECT_THAT(error(replaced(kRos, "1440", "wide")), HasSubstr("must be a number, found 'wide'"));
  EXPECT_THAT(error(replaced(kRos, "900", "900.5")), HasSubstr("whole number"));
  EXPECT_THAT(error(replaced(kRos, "900", "[900]")), HasSubstr("must be a number"));
  EXPECT_THAT(error(replaced(kRos, "camera_matrix", "cam_matrix")), HasSubstr("camera_matrix"));
  EXPECT_THAT(error(replaced(kRos, "0, 0, 1]\ndist", "0, 0]\ndist")), HasSubstr("3 × 3"));
  EXPECT_THAT(error(replaced(kRos, "[1020, 0,", "[1020, 0.5,")), HasSubstr("skew"));
  EXPECT_THAT(error(replaced(kRos, "[1020,", "[nan,")), HasSubstr("found 'nan'"));
  EXPECT_THAT(error(replaced(kRos, "[1020,", "[-1020,")), HasSubstr("focal length"));
  EXPECT_THAT(error(replaced(kRos, "731.166", "1e9")), HasSubstr("principal point"));
  EXPECT_THAT(error(replaced(kRos, "data: [1020", "date: [1020")), HasSubstr("'data' is missing"));
  EXPECT_THAT(error(replaced(kRos, "distortion_model: plumb_bob\n", "")),
              HasSubstr("'distortion_model' is missing"));
  EXPECT_THAT(error(replaced(kRos, "plumb_bob", "plum_bob")),
              HasSubstr("did you mean 'plumb_bob'?"));
  EXPECT_THAT(error(replaced(kRos, "plumb_bob", "[1, 2]")), HasSubstr("must be a word"));
  EXPECT_THAT(error(replaced(kRos, "distortion_coefficients", "coefficients_of")),
              HasSubstr("'distortion_coefficients' is missing"));
  EXPECT_THAT(error(replaced(kRos, "-0.000278, 0.01]", "-0.000278]")), HasSubstr("1 × 5"));
  EXPECT_THAT(error(replaced(kRos, "cols: 5\n  data: [-0.07796, 0.04317, ", "cols: 3\n  data: [")),
              HasSubstr("4 or 5 numbers"));
  EXPECT_THAT(error(replaced(kRos, "plumb_bob", "rational_polynomial")),
              HasSubstr("8 numbers for this distortion model, found 5"));
  EXPECT_THAT(error(replaced(kRos, "plumb_bob", "equidistant")), HasSubstr("has 4"));
  EXPECT_THAT(error(replaced(kRos, "camera_name: front", "camera_name: {a: 1}")),
              HasSubstr("camera_name"));
}

TEST_F(CameraYaml, RefusesBadKalibrFiles) {
  EXPECT_THAT(error(replaced(kKalibr, "pinhole", "omni")), HasSubstr("expected pinhole"));
  EXPECT_THAT(error(replaced(kKalibr, "  camera_model: pinhole\n", "")),
              HasSubstr("'camera_model' is missing"));
  EXPECT_THAT(error(replaced(kKalibr, "246.2", "246.2, 1")), HasSubstr("4 numbers, found 5"));
  EXPECT_THAT(error(replaced(kKalibr, "[752, 480]", "[752]")), HasSubstr("2 numbers, found 1"));
  EXPECT_THAT(error(replaced(kKalibr, "[752, 480]", "[0, 480]")), HasSubstr("whole pixels"));
  EXPECT_THAT(error(replaced(kKalibr, "  resolution: [752, 480]\n", "")),
              HasSubstr("'resolution' is missing"));
  EXPECT_THAT(error(replaced(kKalibr, "radtan", "fov")), HasSubstr("'fov' is not known"));
  EXPECT_THAT(error(replaced(kKalibr, "0.003, -0.004", "0.003")), HasSubstr("found 3"));
  EXPECT_THAT(error(replaced(kKalibr, "0.003", ".inf")), HasSubstr("must hold numbers"));
  EXPECT_THAT(error("cam0: 5\n"), HasSubstr("must be a map"));
}

TEST_F(CameraYaml, RefusesBadOpenCvFilesAndStrangers) {
  EXPECT_THAT(error(replaced(kOpenCv, "5.3e+02", ".Nan")), HasSubstr("found '.Nan'"));
  EXPECT_THAT(error(replaced(kOpenCv, "image_height: 480\n", "")), HasSubstr("image_height"));
  EXPECT_THAT(error(replaced(kOpenCv, "rows: 5", "rows: 6")), HasSubstr("6 × 1"));
  EXPECT_THAT(error(replaced(replaced(kOpenCv, "rows: 5", "rows: 3"), ", -2.e-03, 5.e-02", "")),
              HasSubstr("found 3"));
  EXPECT_THAT(error("tagCols: 4\n"), HasSubstr("no camera intrinsics found"));
  EXPECT_THAT(error("[1, 2"), HasSubstr("not valid YAML"));
  EXPECT_THAT(error(""), HasSubstr("expected a YAML map"));
  EXPECT_FALSE(read_camera(path("absent.yaml")).ok());
  EXPECT_FALSE(read_camera(folder_).ok());
  const auto xml = read("<?xml version=\"1.0\"?>", "camera.xml");
  ASSERT_FALSE(xml.ok());
  EXPECT_THAT(xml.error().text(), HasSubstr("XML"));
  // A list where the format has 12 coefficients: fine while the thin-prism terms are zero.
  const std::string twelve = replaced(replaced(kOpenCv, "rows: 5", "rows: 12"), "5.e-02 ]",
                                      "5.e-02, 1., 2., 3., 0., 0., 0., 0. ]");
  const auto ok = read(twelve);
  ASSERT_TRUE(ok.ok()) << ok.error().text();
  EXPECT_EQ(ok->camera.model, DistortionModel::kRationalPolynomial);
  EXPECT_THAT(error(replaced(twelve, "3., 0.", "3., 0.1")), HasSubstr("thin-prism"));
}

}  // namespace
}  // namespace lvcalib
