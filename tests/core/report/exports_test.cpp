// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/exports.h"

#include <cmath>
#include <filesystem>
#include <regex>
#include <tuple>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <opencv2/calib3d.hpp>
#include <yaml-cpp/yaml.h>

#include "support/synthetic_observations.h"
#include "support/temporary_folder.h"

namespace lvcalib {
namespace {

using Eigen::AngleAxisd;
using Eigen::Matrix3d;
using Eigen::Vector3d;
using ::testing::HasSubstr;

ExportInput input_of(DistortionModel model) {
  ExportInput input;
  input.camera_from_lidar = test::test_extrinsic();
  input.camera = test::test_camera();
  input.camera.model = model;
  input.dataset = "/data/a \"quoted\" -- folder\nwith a line";
  input.quality = "doubtful";
  if (model == DistortionModel::kEquidistant)
    input.camera.distortion << 0.02, -0.01, 0.004, -0.001, 0, 0, 0, 0;
  if (model == DistortionModel::kRationalPolynomial)
    input.camera.distortion << 0.1, -0.05, 1e-4, -2e-4, 0.01, 0.15, -0.02, 0.005;
  input.imu_from_lidar = Rigid3{so3_exp({0.1, -0.2, 1.4}), {0.05, -0.02, 0.11}};
  input.scenes = {{"A", true, "scenes/A/image.png", "scenes/A/cloud.pcd",
                   Rigid3{so3_exp({2.9, 0.3, -0.2}), {0.1, 0.2, 2.5}}},
                  {"B", false, "scenes/B/image.png", "scenes/B/cloud.pcd", {}}};
  return input;
}

// Everything below reads the exported text alone; none of the library's transforms is used.

std::vector<double> numbers_in(const std::string& text) {
  static const std::regex kNumber(R"([-+]?\d+\.?\d*(?:[eE][-+]?\d+)?)");
  std::vector<double> out;
  for (std::sregex_iterator it(text.begin(), text.end(), kNumber), end; it != end; ++it)
    out.push_back(std::stod(it->str()));
  return out;
}

// The numbers between the brackets that follow `key`.
std::vector<double> bracket(const std::string& text, const std::string& key) {
  const auto at = text.find(key);
  EXPECT_NE(at, std::string::npos) << key;
  if (at == std::string::npos) return {};
  const auto open = text.find('[', at + key.size());
  return numbers_in(text.substr(open, text.find(']', open) - open));
}

Vector3d vec(const std::vector<double>& v, std::size_t from = 0) {
  return {v.at(from), v.at(from + 1), v.at(from + 2)};
}

Matrix3d rows(const std::vector<double>& v) {
  Matrix3d m;
  for (int k = 0; k < 9; ++k) m(k / 3, k % 3) = v.at(static_cast<std::size_t>(k));
  return m;
}

Matrix3d zyx(double roll, double pitch, double yaw) {
  return (AngleAxisd(yaw, Vector3d::UnitZ()) * AngleAxisd(pitch, Vector3d::UnitY()) *
          AngleAxisd(roll, Vector3d::UnitX()))
      .toRotationMatrix();
}

// p_parent = R p_child + t, so the child's coordinates are Rᵀ (p − t).
Vector3d child_of(const Matrix3d& R, const Vector3d& t, const Vector3d& parent) {
  return R.transpose() * (parent - t);
}

Vector3d optical_of(const Vector3d& forward) {
  return {-forward.y(), -forward.z(), forward.x()};
}

// The camera coordinates of a LiDAR point, read out of each format by its own rules.
Vector3d camera_point(const std::string& format, const std::string& text, const Vector3d& lidar) {
  std::string data;  // the text without comments
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (line.empty() || line.front() != '#') data += line + "\n";
  }
  if (format == "matrix") {
    const auto v = numbers_in(data);
    EXPECT_EQ(v.size(), 16U);
    Eigen::Matrix4d m;
    for (int k = 0; k < 16; ++k) m(k / 4, k % 4) = v.at(static_cast<std::size_t>(k));
    return (m * lidar.homogeneous()).head<3>();
  }
  if (format == "opencv") {
    cv::FileStorage file(text, cv::FileStorage::READ | cv::FileStorage::MEMORY);
    cv::Mat rvec, tvec, R;
    file["rvec"] >> rvec;
    file["tvec"] >> tvec;
    cv::Rodrigues(rvec, R);
    Matrix3d rotation;
    for (int k = 0; k < 9; ++k) rotation(k / 3, k % 3) = R.at<double>(k / 3, k % 3);
    return rotation * lidar + Vector3d(tvec.at<double>(0), tvec.at<double>(1), tvec.at<double>(2));
  }
  if (format == "ros1-tf") {
    const auto v = numbers_in(data.substr(data.find("static_transform_publisher") + 26));
    return child_of(zyx(v.at(5), v.at(4), v.at(3)), vec(v), lidar);
  }
  if (format == "ros2-tf") {
    const auto after = [&](const std::string& flag) {
      const auto at = data.find(flag + " ");
      EXPECT_NE(at, std::string::npos) << flag;
      return std::stod(data.substr(at + flag.size() + 1));
    };
    const Eigen::Quaterniond q(after("--qw"), after("--qx"), after("--qy"), after("--qz"));
    return child_of(q.toRotationMatrix(), {after("--x"), after("--y"), after("--z")}, lidar);
  }
  if (format == "urdf") {
    const auto attribute = [&](const std::string& key) {
      const auto at = text.find(key + "=\"") + key.size() + 2;
      return numbers_in(text.substr(at, text.find('"', at) - at));
    };
    const auto rpy = attribute("rpy");
    return child_of(zyx(rpy.at(0), rpy.at(1), rpy.at(2)), vec(attribute("xyz")), lidar);
  }
  if (format == "koide") {
    const auto j = nlohmann::json::parse(text);
    const auto v = j.at("results").at("T_lidar_camera").get<std::vector<double>>();
    const Eigen::Quaterniond q(v.at(6), v.at(3), v.at(4), v.at(5));
    return child_of(q.toRotationMatrix(), vec(v), lidar);
  }
  if (format == "kitti") {
    // As readers by line number have it: the sixth line, twelve numbers behind the key.
    std::istringstream all(text);
    std::string line;
    for (int k = 0; k < 6; ++k) std::getline(all, line);
    EXPECT_EQ(line.rfind("Tr_velo_to_cam: ", 0), 0U);
    const auto v = numbers_in(line.substr(line.find(':') + 1));
    EXPECT_EQ(v.size(), 12U);
    const Matrix3d R = rows({v[0], v[1], v[2], v[4], v[5], v[6], v[8], v[9], v[10]});
    return R * lidar + Vector3d(v[3], v[7], v[11]);
  }
  if (format == "colmap") {
    // The world is in between: the LiDAR's pose taken back, the camera's applied.
    const auto pose = [&](const std::string& file) {
      std::istringstream in(text.substr(text.find("=== " + file)));
      std::string line;
      std::getline(in, line);
      while (std::getline(in, line) && (line.empty() || line.front() == '#')) {
      }
      const auto v = numbers_in(line);
      EXPECT_EQ(v.at(0), 1.0);
      return std::pair(Eigen::Quaterniond(v.at(1), v.at(2), v.at(3), v.at(4)), vec(v, 5));
    };
    const auto [q, t] = pose("images.txt");
    const auto [ql, tl] = pose("lidars.txt");
    const Vector3d world = child_of(ql.toRotationMatrix(), tl, lidar);
    return q * world + t;
  }
  const YAML::Node yaml = YAML::Load(text);
  if (format == "kalibr") {
    Eigen::Matrix4d m;
    for (int r = 0; r < 4; ++r) {
      for (int c = 0; c < 4; ++c) m(r, c) = yaml["cam0"]["T_cam_lidar"][r][c].as<double>();
    }
    return (m * lidar.homogeneous()).head<3>();
  }
  if (format == "autoware") {
    const YAML::Node n = yaml["sensor_kit_base_link"]["camera0/camera_link"];
    const auto at = [&](const char* key) { return n[key].as<double>(); };
    return optical_of(
        child_of(zyx(at("roll"), at("pitch"), at("yaw")), {at("x"), at("y"), at("z")}, lidar));
  }
  if (format == "fast-livo2") {
    const auto R = yaml["extrin_calib"]["Rcl"].as<std::vector<double>>();
    return rows(R) * lidar + vec(yaml["extrin_calib"]["Pcl"].as<std::vector<double>>());
  }
  if (format == "r3live") {
    const Vector3d imu = rows(bracket(text, "R_il =")) * lidar + vec(bracket(text, "t_il ="));
    const auto R = yaml["r3live_vio"]["camera_ext_R"].as<std::vector<double>>();
    return child_of(rows(R), vec(yaml["r3live_vio"]["camera_ext_t"].as<std::vector<double>>()),
                    imu);
  }
  if (format == "lvi-sam") {
    const auto at = [&](const char* key) {
      return yaml[std::string("lidar_to_cam_") + key].as<double>();
    };
    return optical_of(zyx(at("rx"), at("ry"), at("rz")) * lidar +
                      Vector3d(at("tx"), at("ty"), at("tz")));
  }
  ADD_FAILURE() << "no reader for " << format;
  return {};
}

// OpenCV's projection with the intrinsics of the comment.
Eigen::Vector2d project(const std::string& text, const Vector3d& camera) {
  const auto k = bracket(text, "[fx, fy, cx, cy] =");
  const auto distortion = bracket(text, "distortion =");
  const cv::Matx33d K(k.at(0), 0, k.at(2), 0, k.at(1), k.at(3), 0, 0, 1);
  const std::vector<cv::Point3d> points = {{camera.x(), camera.y(), camera.z()}};
  std::vector<cv::Point2d> pixels;
  const cv::Vec3d zero(0, 0, 0);
  if (text.find("intrinsics: equidistant") != std::string::npos) {
    cv::fisheye::projectPoints(points, pixels, zero, zero, K, distortion);
  } else {
    cv::projectPoints(points, zero, zero, K, distortion, pixels);
  }
  return {pixels.at(0).x, pixels.at(0).y};
}

class Exports : public ::testing::TestWithParam<DistortionModel> {};

TEST_P(Exports, WorkedPointFollowsFromTheTextAlone) {
  const ExportInput input = input_of(GetParam());
  for (const ExportFormat& format : export_formats()) {
    // The one has no pose, the other only points; both have tests of their own.
    if (format.name == "boundary-response" || format.is_cloud) continue;
    SCOPED_TRACE(format.name);
    const auto text = export_result(input, format.name);
    ASSERT_TRUE(text.ok()) << text.error().text();
    const Vector3d lidar = vec(bracket(*text, "lidar_m ="));
    const Vector3d stated = vec(bracket(*text, "camera_m ="));
    const auto pixel = bracket(*text, "pixel =");
    const Vector3d camera = camera_point(format.name, *text, lidar);
    EXPECT_LT((camera - stated).norm(), 1e-9);
    ASSERT_EQ(pixel.size(), 2U);
    EXPECT_LT((project(*text, camera) - Eigen::Vector2d(pixel[0], pixel[1])).norm(), 1e-5);
    // A point on the axis or at the origin would hide a wrong rotation.
    EXPECT_GT(camera.head<2>().norm(), 0.3);
    EXPECT_GT(stated.z(), 1.0);
    EXPECT_THAT(*text, HasSubstr("metres"));
    EXPECT_THAT(*text, HasSubstr("quality: doubtful"));
  }
}

INSTANTIATE_TEST_SUITE_P(Models, Exports,
                         ::testing::Values(DistortionModel::kPlumbBob,
                                           DistortionModel::kRationalPolynomial,
                                           DistortionModel::kEquidistant));

TEST(ExportResult, LookingStraightDownIsNoSpecialCase) {
  ExportInput input = input_of(DistortionModel::kPlumbBob);
  // The camera's body x axis along the LiDAR's −z: pitch of 90°.
  Matrix3d R;
  R << 0, -1, 0, -1, 0, 0, 0, 0, -1;
  input.camera_from_lidar = Rigid3::from_matrix(R, {0.1, 0.2, 0.3});
  for (const char* format : {"ros1-tf", "urdf", "autoware", "lvi-sam"}) {
    SCOPED_TRACE(format);
    const auto text = export_result(input, format);
    ASSERT_TRUE(text.ok());
    const Vector3d lidar = vec(bracket(*text, "lidar_m ="));
    EXPECT_LT((camera_point(format, *text, lidar) - vec(bracket(*text, "camera_m ="))).norm(),
              1e-9);
  }
}

TEST(ExportResult, NamesOfFramesAreTheUsersInEveryFormat) {
  ExportInput input = input_of(DistortionModel::kPlumbBob);
  input.lidar_frame = "velodyne";
  input.camera_frame = "rig/camera_left";
  for (const ExportFormat& format : export_formats()) {
    if (format.name == "boundary-response") continue;  // It names no camera.
    const auto text = export_result(input, format.name);
    ASSERT_TRUE(text.ok()) << format.name;
    EXPECT_THAT(*text, HasSubstr("velodyne")) << format.name;
    EXPECT_THAT(*text, HasSubstr("rig/camera_left")) << format.name;
  }
  EXPECT_THAT(*export_result(input, "ros2-tf"),
              HasSubstr("--frame-id velodyne --child-frame-id rig/camera_left"));
  EXPECT_THAT(*export_result(input, "urdf"), HasSubstr("<parent link=\"velodyne\"/>"));
  for (const char* bad : {"", "two words", "-x", "a--b", "$(id)", "a\"b"}) {
    input.lidar_frame = bad;
    EXPECT_EQ(export_result(input, "ros2-tf").error().kind, ErrorKind::kUsage) << bad;
  }
}

TEST(ExportResult, FramesOfOneNameAreRefused) {
  ExportInput input = input_of(DistortionModel::kPlumbBob);
  input.lidar_frame = input.camera_frame = "sensor";
  const auto text = export_result(input, "urdf");
  ASSERT_FALSE(text.ok());
  EXPECT_EQ(text.error().kind, ErrorKind::kUsage);
  EXPECT_THAT(text.error().text(), HasSubstr("cannot both be called 'sensor'"));
}

TEST(ExportResult, KittisLinesAreWhereItsReadersLookForThem) {
  const ExportInput input = input_of(DistortionModel::kPlumbBob);
  std::istringstream text(*export_result(input, "kitti"));
  std::vector<std::string> lines;
  for (std::string line; std::getline(text, line);) {
    lines.push_back(line);
    // Readers split at the first colon.
    EXPECT_NE(line.find(':'), std::string::npos) << line;
  }
  ASSERT_GT(lines.size(), 7U);
  const auto P2 = numbers_in(lines[2].substr(3));
  EXPECT_NEAR(P2.at(0), input.camera.fx, 1e-9 * input.camera.fx);
  EXPECT_NEAR(P2.at(6), input.camera.cy, 1e-9 * input.camera.cy);
  EXPECT_EQ(lines[4].rfind("R0_rect: 1 0 0", 0), 0U);
  // p_velo = T p_imu is the inverse of the given p_imu = T p_lidar.
  const auto v = numbers_in(lines[6].substr(lines[6].find(':') + 1));
  const Vector3d imu =
      input.imu_from_lidar->rotation * Vector3d(1, 2, 3) + input.imu_from_lidar->translation;
  const Matrix3d R = rows({v[0], v[1], v[2], v[4], v[5], v[6], v[8], v[9], v[10]});
  EXPECT_LT((R * imu + Vector3d(v[3], v[7], v[11]) - Vector3d(1, 2, 3)).norm(), 1e-9);
}

TEST(ExportResult, ColmapsCameraHasItsOwnPixelOrigin) {
  for (const auto& [model, name, count] :
       {std::tuple{DistortionModel::kPlumbBob, "FULL_OPENCV", 12U},
        {DistortionModel::kRationalPolynomial, "FULL_OPENCV", 12U},
        {DistortionModel::kEquidistant, "OPENCV_FISHEYE", 8U}}) {
    ExportInput input = input_of(model);
    if (model == DistortionModel::kPlumbBob) input.camera.distortion(4) = 0.01;
    const std::string text = *export_result(input, "colmap");
    const auto at = text.find(std::string("\n1 ") + name);
    ASSERT_NE(at, std::string::npos) << name;
    const auto v =
        numbers_in(text.substr(at + 3 + std::string(name).size(),
                               text.find('\n', at + 1) - at - 3 - std::string(name).size()));
    ASSERT_EQ(v.size(), 2U + count) << name;
    EXPECT_EQ(v[0], input.camera.width_px);
    EXPECT_NEAR(v[4], input.camera.cx + 0.5, 1e-6);
    EXPECT_NEAR(v[5], input.camera.cy + 0.5, 1e-6);
    for (unsigned k = 0; k < count - 4; ++k)
      EXPECT_NEAR(v[6 + k], input.camera.distortion(k), 1e-9) << k;
    // Scenes that are not in use have no image.
    EXPECT_EQ(text.find("scenes/B"), std::string::npos);
  }
  ExportInput none = input_of(DistortionModel::kPlumbBob);
  none.scenes.clear();
  EXPECT_EQ(export_result(none, "colmap").error().kind, ErrorKind::kUntrusted);
}

TEST(ExportResult, FoldersAndFilesAreWritten) {
  const test::TemporaryFolder folder;
  const ExportInput input = input_of(DistortionModel::kPlumbBob);
  ASSERT_TRUE(write_export(input, "colmap", folder.path() / "model").ok());
  for (const char* name : {"cameras.txt", "images.txt", "points3D.txt", "lidars.txt"})
    EXPECT_TRUE(std::filesystem::exists(folder.path() / "model" / name)) << name;
  ASSERT_TRUE(write_export(input, "kitti", folder.path() / "calib.txt").ok());
  EXPECT_TRUE(std::filesystem::is_regular_file(folder.path() / "calib.txt"));
  EXPECT_EQ(write_export(input, "colored-ply", folder.path() / "a.ply").error().kind,
            ErrorKind::kUsage);
  EXPECT_EQ(write_export(input, "matrix", folder.path() / "no" / "a.txt").error().kind,
            ErrorKind::kOutput);
}

TEST(ExportResult, UnknownFormatsAndAMissingImuAreRefused) {
  ExportInput input = input_of(DistortionModel::kPlumbBob);
  const auto unknown = export_result(input, "fast-livo");
  ASSERT_FALSE(unknown.ok());
  EXPECT_EQ(unknown.error().kind, ErrorKind::kUsage);
  EXPECT_THAT(unknown.error().text(), HasSubstr("did you mean fast-livo2"));
  input.imu_from_lidar.reset();
  const auto no_imu = export_result(input, "r3live");
  ASSERT_FALSE(no_imu.ok());
  EXPECT_EQ(no_imu.error().kind, ErrorKind::kUsage);
  EXPECT_THAT(no_imu.error().text(), HasSubstr("T_imu_lidar"));
}

TEST(ExportBoundaryResponse, ReadsBackAsYamlWithTheResultsNumbers) {
  ExportInput input = input_of(DistortionModel::kPlumbBob);
  nlohmann::json all = {{"n", 5000},
                        {"mean_pitch_deg", 0.001},
                        {"mean_yaw_deg", -0.002},
                        {"mean_range_mm", 0.5},
                        {"std_pitch_deg", 0.05},
                        {"std_yaw_deg", 0.08},
                        {"covariance", {{1e-6, 0, 0}, {0, 2e-6, 0}, {0, 0, 1e-4}}}};
  nlohmann::json cell = all;
  cell["range_m"] = {2.0, 3.0};
  cell["incidence_deg"] = {0.0, 15.0};
  const nlohmann::json thin = {{"range_m", {3.0, 4.0}}, {"incidence_deg", {15.0, 30.0}}, {"n", 12}};
  const nlohmann::json result = {
      {"boundary_response", {{"all", all}, {"by_range_and_incidence", {cell, thin}}}}};
  input.result_json = result.dump();
  const auto text = export_result(input, "boundary-response");
  ASSERT_TRUE(text.ok()) << text.error().text();
  const YAML::Node yaml = YAML::Load(*text)["boundary_response"];
  EXPECT_EQ(yaml["all"]["n"].as<int>(), 5000);
  EXPECT_NEAR(yaml["all"]["covariance"][1][1].as<double>(), 2e-6, 1e-12);
  EXPECT_NEAR(yaml["all"]["mean"][2].as<double>(), 0.0005, 1e-9);
  ASSERT_EQ(yaml["cells"].size(), 2U);
  EXPECT_NEAR(yaml["cells"][0]["range_m"][1].as<double>(), 3.0, 1e-9);
  EXPECT_FALSE(yaml["cells"][1]["covariance"]);
  EXPECT_THAT(*text, HasSubstr("double weight = 1.0 / variance;"));
}

TEST(ExportBoundaryResponse, WithoutOneItSaysWhy) {
  ExportInput input = input_of(DistortionModel::kPlumbBob);
  input.result_json = R"({"boundary_response": {"all": {"n": 3}, "reason": "no circles here"}})";
  const auto none = export_result(input, "boundary-response");
  ASSERT_FALSE(none.ok());
  EXPECT_EQ(none.error().kind, ErrorKind::kUntrusted);
  EXPECT_THAT(none.error().text(), HasSubstr("no circles here"));
  for (const char* bad : {"", "{}", "[]", R"({"boundary_response": 3})",
                          R"({"boundary_response": {"all": {"n": "x", "covariance": 1}}})"}) {
    input.result_json = bad;
    EXPECT_FALSE(export_result(input, "boundary-response").ok()) << bad;
  }
}

}  // namespace
}  // namespace lvcalib
