// SPDX-License-Identifier: BSD-3-Clause
#include "report/exports.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <functional>
#include <initializer_list>

#include "base/file_io.h"
#include "base/yaml_file.h"
#include "report/colored_cloud.h"
#include "report/result_file.h"

namespace lvcalib {
namespace {

std::string yaml_number(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.12g", value == 0.0 ? 0.0 : value);
  // YAML 1.1 readers take "1" for an integer where a float is asked for.
  std::string out = text;
  if (out.find_first_of(".e") == std::string::npos) out += ".0";
  return out;
}

template <class Values>
std::string list(const Values& values, const char* separator = ", ") {
  std::string out;
  for (const double v : values) out += (out.empty() ? "" : separator) + yaml_number(v);
  return out;
}

std::vector<double> row_major(const Eigen::Matrix3d& m) {
  std::vector<double> out;
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) out.push_back(m(r, c));
  }
  return out;
}

std::string matrix_rows(const Eigen::Matrix4d& m, const std::string& before,
                        const std::string& after) {
  std::string out;
  for (int r = 0; r < 4; ++r) {
    const std::vector<double> row = {m(r, 0), m(r, 1), m(r, 2), m(r, 3)};
    out += before + list(row) + after + "\n";
  }
  return out;
}

// R = Rz(yaw)·Ry(pitch)·Rx(roll), as ROS, URDF and PCL compose it.
struct RollPitchYaw {
  double roll, pitch, yaw;
};
RollPitchYaw angles_of(const Rigid3& transform) {
  const Eigen::Matrix3d R = transform.rotation.toRotationMatrix();
  const double across = std::hypot(R(0, 0), R(1, 0));
  // Looking straight up or down only the sum of roll and yaw is defined: all of it goes to yaw.
  if (across < 1e-9) return {0.0, std::atan2(-R(2, 0), across), std::atan2(-R(0, 1), R(1, 1))};
  return {std::atan2(R(2, 1), R(2, 2)), std::atan2(-R(2, 0), across), std::atan2(R(1, 0), R(0, 0))};
}

// x forward, y left, z up, from x right, y down, z forward.
Rigid3 body_from_optical() {
  Eigen::Matrix3d R;
  R << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  return Rigid3::from_matrix(R, Eigen::Vector3d::Zero());
}

struct WorkedPoint {
  Eigen::Vector3d lidar_m, camera_m;
  Eigen::Vector2d pixel;
};

// A point some metres ahead and off the axis, its LiDAR coordinates rounded to what is printed.
WorkedPoint worked_point(const ExportInput& input) {
  WorkedPoint p;
  for (const double aside : {0.2, 0.1, 0.0}) {
    p.lidar_m = input.camera_from_lidar.inverse() * Eigen::Vector3d(5.0 * aside, -2.0 * aside, 5.0);
    p.lidar_m = (1e3 * p.lidar_m).array().round() / 1e3;
    p.camera_m = input.camera_from_lidar * p.lidar_m;
    const auto pixel = input.camera.project(p.camera_m);
    p.pixel = pixel.value_or(Eigen::Vector2d(std::nan(""), std::nan("")));
    if (pixel && input.camera.in_image(*pixel)) break;
  }
  return p;
}

std::string intrinsics_line(const Camera& camera) {
  static const char* const kModels[] = {"plumb_bob", "rational_polynomial", "equidistant"};
  std::vector<double> distortion;
  for (int k = 0; k < camera.distortion_count(); ++k) distortion.push_back(camera.distortion(k));
  return std::string("intrinsics: ") + kModels[static_cast<int>(camera.model)] +
         " [fx, fy, cx, cy] = [" +
         list(std::vector<double>{camera.fx, camera.fy, camera.cx, camera.cy}) +
         "], distortion = [" + list(distortion) + "]";
}

// Text from a file that must not end a comment, in whatever format it stands.
std::string on_one_line(std::string text) {
  for (char& c : text) {
    if (static_cast<unsigned char>(c) < 0x20 || c == '"' || c == '\\') c = ' ';
  }
  // An XML comment may not hold two hyphens.
  for (auto at = text.find("--"); at != std::string::npos; at = text.find("--")) text[at] = ' ';
  return text;
}

bool has_own_names(const ExportInput& input) {
  const ExportInput usual;
  return input.lidar_frame != usual.lidar_frame || input.camera_frame != usual.camera_frame;
}

// The comment common to all formats; `lines` say what is particular.
std::string comment(const ExportInput& input, std::initializer_list<std::string> lines,
                    const std::string& prefix = "# ") {
  std::vector<std::string> all = export_notes(input);
  // Behind what it was made of.
  const auto at = std::find_if(all.begin(), all.end(), [](const std::string& line) {
    return line.rfind("names of the frames", 0) == 0 || line.rfind("camera: x right", 0) == 0;
  });
  all.insert(at, lines.begin(), lines.end());
  std::string out;
  for (const std::string& line : all) out += prefix + line + "\n";
  return out;
}

Result<std::string> write_matrix(const ExportInput& input) {
  return comment(input, {"T_camera_lidar: takes a point from the LiDAR frame to the camera frame, "
                         "p_camera = T * p_lidar; 4x4, row by row"}) +
         matrix_rows(input.camera_from_lidar.matrix(), "", "");
}

Result<std::string> write_opencv(const ExportInput& input) {
  const Eigen::Vector3d rvec = so3_log(input.camera_from_lidar.rotation);
  const auto matrix = [](const std::string& name, int rows, int columns, const auto& values) {
    return name + ": !!opencv-matrix\n   rows: " + std::to_string(rows) +
           "\n   cols: " + std::to_string(columns) + "\n   dt: d\n   data: [ " + list(values) +
           " ]\n";
  };
  const Camera& c = input.camera;
  std::vector<double> distortion;
  for (int k = 0; k < c.distortion_count(); ++k) distortion.push_back(c.distortion(k));
  const std::vector<double> K = {c.fx, 0.0, c.cx, 0.0, c.fy, c.cy, 0.0, 0.0, 1.0};
  return "%YAML:1.0\n---\n" +
         comment(input,
                 {"rvec (Rodrigues, rad), tvec (m): take a point from the LiDAR frame to the "
                  "camera frame,",
                  "as cv::projectPoints (cv::fisheye::projectPoints for equidistant) takes "
                  "them with LiDAR points"}) +
         matrix("rvec", 3, 1, rvec) + matrix("tvec", 3, 1, input.camera_from_lidar.translation) +
         matrix("camera_matrix", 3, 3, K) +
         matrix("distortion_coefficients", c.distortion_count(), 1, distortion);
}

Result<std::string> write_ros1(const ExportInput& input) {
  const Rigid3 T = input.camera_from_lidar.inverse();
  const RollPitchYaw a = angles_of(T);
  const Eigen::Vector3d& t = T.translation;
  return "#!/bin/sh\n" +
         comment(input, {"T_lidar_camera: pose of the camera (child) in the LiDAR frame (parent), "
                         "p_lidar = T * p_camera",
                         "positional order of ROS 1: x y z yaw pitch roll parent child; R = "
                         "Rz(yaw)*Ry(pitch)*Rx(roll)"}) +
         "rosrun tf2_ros static_transform_publisher " +
         list(std::vector<double>{t.x(), t.y(), t.z(), a.yaw, a.pitch, a.roll}, " ") + " " +
         input.lidar_frame + " " + input.camera_frame + "\n";
}

Result<std::string> write_ros2(const ExportInput& input) {
  const Rigid3 T = input.camera_from_lidar.inverse();
  const Eigen::Vector3d& t = T.translation;
  const Eigen::Vector4d q = T.rotation.coeffs();
  return "#!/bin/sh\n" +
         comment(input, {"T_lidar_camera: pose of the camera (child) in the LiDAR frame (parent), "
                         "p_lidar = T * p_camera"}) +
         "ros2 run tf2_ros static_transform_publisher --x " + yaml_number(t.x()) + " --y " +
         yaml_number(t.y()) + " --z " + yaml_number(t.z()) + " --qx " + yaml_number(q(0)) +
         " --qy " + yaml_number(q(1)) + " --qz " + yaml_number(q(2)) + " --qw " +
         yaml_number(q(3)) + " --frame-id " + input.lidar_frame + " --child-frame-id " +
         input.camera_frame + "\n";
}

Result<std::string> write_urdf(const ExportInput& input) {
  const Rigid3 T = input.camera_from_lidar.inverse();
  const RollPitchYaw a = angles_of(T);
  return "<!--\n" +
         comment(input,
                 {"origin: pose of the camera (child) in the LiDAR frame (parent), p_lidar "
                  "= T * p_camera",
                  "R = Rz(yaw)*Ry(pitch)*Rx(roll), rpy = roll pitch yaw"},
                 "  ") +
         "-->\n<joint name=\"" + input.lidar_frame + "_to_" + input.camera_frame +
         "\" type=\"fixed\">\n  <parent link=\"" + input.lidar_frame + "\"/>\n  <child link=\"" +
         input.camera_frame + "\"/>\n  <origin xyz=\"" + list(T.translation, " ") + "\" rpy=\"" +
         list(std::vector<double>{a.roll, a.pitch, a.yaw}, " ") + "\"/>\n</joint>\n";
}

Result<std::string> write_kalibr(const ExportInput& input) {
  const Camera& c = input.camera;
  std::string out = comment(input, {"T_cam_lidar: takes a point from the LiDAR frame to the camera "
                                    "frame, p_camera = T * p_lidar"});
  out += "cam0:\n  T_cam_lidar:\n" + matrix_rows(input.camera_from_lidar.matrix(), "    - [", "]");
  const bool fisheye = c.model == DistortionModel::kEquidistant;
  out += "  camera_model: pinhole\n  intrinsics: [" +
         list(std::vector<double>{c.fx, c.fy, c.cx, c.cy}) + "]\n";
  const bool radtan = c.model == DistortionModel::kPlumbBob && c.distortion(4) == 0.0;
  if (fisheye || radtan) {
    out += std::string("  distortion_model: ") + (fisheye ? "equidistant" : "radtan") +
           "\n  distortion_coeffs: [" +
           list(std::vector<double>{c.distortion(0), c.distortion(1), c.distortion(2),
                                    c.distortion(3)}) +
           "]\n";
  } else {
    out +=
        "  # Kalibr has no distortion model with these coefficients; see the intrinsics above.\n";
  }
  out +=
      "  resolution: [" + std::to_string(c.width_px) + ", " + std::to_string(c.height_px) + "]\n";
  return out;
}

Result<std::string> write_autoware(const ExportInput& input) {
  const Rigid3 T = input.camera_from_lidar.inverse() * body_from_optical().inverse();
  const RollPitchYaw a = angles_of(T);
  const auto line = [](const char* key, double value) {
    return std::string("    ") + key + ": " + yaml_number(value) + "\n";
  };
  // Autoware's own names where the user has not given others.
  const ExportInput usual;
  const std::string parent =
      input.lidar_frame == usual.lidar_frame ? "sensor_kit_base_link" : input.lidar_frame;
  const std::string child =
      input.camera_frame == usual.camera_frame ? "camera0/camera_link" : input.camera_frame;
  return comment(input, {"pose of camera_link (child) in sensor_kit_base_link (parent), here the "
                         "LiDAR frame itself:",
                         "where the LiDAR is elsewhere, put T_base_lidar before it. camera_link: x "
                         "forward, y left, z up;",
                         "p_lidar = T * p_camera_link, R = Rz(yaw)*Ry(pitch)*Rx(roll); p_camera = "
                         "(-y, -z, x) of p_camera_link"}) +
         parent + ":\n  " + child + ":\n" + line("x", T.translation.x()) +
         line("y", T.translation.y()) + line("z", T.translation.z()) + line("roll", a.roll) +
         line("pitch", a.pitch) + line("yaw", a.yaw);
}

Result<std::string> write_fast_livo2(const ExportInput& input) {
  const Rigid3& T = input.camera_from_lidar;
  return comment(input,
                 {"Rcl (row-major), Pcl (m): take a point from the LiDAR frame to the camera "
                  "frame, p_camera = Rcl * p_lidar + Pcl"}) +
         "extrin_calib:\n  Rcl: [" + list(row_major(T.rotation.toRotationMatrix())) +
         "]\n  Pcl: [" + list(T.translation) + "]\n";
}

Result<std::string> write_r3live(const ExportInput& input) {
  const Rigid3 T = *input.imu_from_lidar * input.camera_from_lidar.inverse();
  const Rigid3& L = *input.imu_from_lidar;
  return comment(input, {"camera_ext_R (row-major), camera_ext_t (m): take a point from the camera "
                         "frame to the IMU frame,",
                         "p_imu = R * p_camera + t; made with p_imu = R_il * p_lidar + t_il,",
                         "R_il = [" + list(row_major(L.rotation.toRotationMatrix())) +
                             "], t_il = [" + list(L.translation) + "]"}) +
         "r3live_vio:\n  camera_ext_R: [" + list(row_major(T.rotation.toRotationMatrix())) +
         "]\n  camera_ext_t: [" + list(T.translation) + "]\n";
}

Result<std::string> write_lvi_sam(const ExportInput& input) {
  const Rigid3 T = body_from_optical() * input.camera_from_lidar;
  const RollPitchYaw a = angles_of(T);
  const auto line = [](const char* key, double value) {
    return std::string("lidar_to_cam_") + key + ": " + yaml_number(value) + "\n";
  };
  return comment(input,
                 {"takes a point from the LiDAR frame to the camera frame turned to x "
                  "forward, y left, z up,",
                  "p_forward = T * p_lidar, R = Rz(rz)*Ry(ry)*Rx(rx); p_camera = (-y, -z, x) "
                  "of p_forward"}) +
         line("tx", T.translation.x()) + line("ty", T.translation.y()) +
         line("tz", T.translation.z()) + line("rx", a.roll) + line("ry", a.pitch) +
         line("rz", a.yaw);
}

// JSON has no comments: they are the strings of a key that its readers pass over.
Result<std::string> write_koide(const ExportInput& input) {
  const Rigid3 T = input.camera_from_lidar.inverse();
  const Eigen::Vector4d q = T.rotation.coeffs();
  std::string lines =
      comment(input,
              {"T_lidar_camera: x y z (m) qx qy qz qw; takes a point from the camera "
               "frame to the LiDAR frame, p_lidar = T * p_camera"},
              "");
  std::string notes;
  for (std::size_t at = 0; at < lines.size();) {
    const std::size_t end = lines.find('\n', at);
    notes += (notes.empty() ? "" : ",\n") + ("    \"" + lines.substr(at, end - at)) + "\"";
    at = end + 1;
  }
  const Camera& c = input.camera;
  std::vector<double> distortion;
  for (int k = 0; k < c.distortion_count(); ++k) distortion.push_back(c.distortion(k));
  static const char* const kModels[] = {"plumb_bob", "rational_polynomial", "fisheye"};
  return "{\n  \"_comment\": [\n" + notes + "\n  ],\n  \"camera\": {\n    \"camera_model\": \"" +
         kModels[static_cast<int>(c.model)] + "\",\n    \"intrinsics\": [" +
         list(std::vector<double>{c.fx, c.fy, c.cx, c.cy}) + "],\n    \"distortion_coeffs\": [" +
         list(distortion) + "]\n  },\n  \"results\": {\n    \"T_lidar_camera\": [" +
         list(std::vector<double>{T.translation.x(), T.translation.y(), T.translation.z(), q(0),
                                  q(1), q(2), q(3)}) +
         "]\n  }\n}\n";
}

// As the object and odometry benchmarks have it (Geiger et al. 2012). Some readers go by the number
// of the line, so that notes come last; others split each line at its first colon.
Result<std::string> write_kitti(const ExportInput& input) {
  const auto row = [](const char* key, const Eigen::Matrix<double, 3, 4>& m) {
    std::string out = std::string(key) + ":";
    for (int k = 0; k < 12; ++k) {
      char text[32];
      std::snprintf(text, sizeof text, " %.12e", m(k / 4, k % 4));
      out += text;
    }
    return out + "\n";
  };
  const Camera& c = input.camera;
  Eigen::Matrix<double, 3, 4> P = Eigen::Matrix<double, 3, 4>::Zero();
  P.leftCols<3>() << c.fx, 0.0, c.cx, 0.0, c.fy, c.cy, 0.0, 0.0, 1.0;
  const Rigid3 lidar_from_imu = input.imu_from_lidar ? input.imu_from_lidar->inverse() : Rigid3{};
  std::string out;
  for (const char* key : {"P0", "P1", "P2", "P3"}) out += row(key, P);
  out += "R0_rect: 1 0 0 0 1 0 0 0 1\n";
  out += row("Tr_velo_to_cam", input.camera_from_lidar.matrix().topRows<3>());
  out += row("Tr_imu_to_velo", lidar_from_imu.matrix().topRows<3>());
  std::vector<std::string> notes = export_notes(input);
  notes.push_back("Tr_velo_to_cam takes a point from the LiDAR frame to the camera frame");
  notes.push_back(std::string("Tr_imu_to_velo ") +
                  (input.imu_from_lidar ? "is the inverse of the given T_imu_lidar"
                                        : "is not known and stands as the identity"));
  notes.push_back(
      "images must be undistorted with the intrinsics above, to the same camera matrix, "
      "which all of P0 to P3 hold");
  int number = 0;
  for (const std::string& note : notes) out += "#" + std::to_string(++number) + ": " + note + "\n";
  return out;
}

std::string colmap_camera(const Camera& c) {
  // Where the centre of the top-left pixel is (0.5, 0.5).
  std::vector<double> parameters = {c.fx, c.fy, c.cx + 0.5, c.cy + 0.5};
  std::string model = "FULL_OPENCV";
  int count = 8;
  if (c.model == DistortionModel::kEquidistant) {
    model = "OPENCV_FISHEYE";
    count = 4;
  } else if (c.model == DistortionModel::kPlumbBob && c.distortion(4) == 0.0) {
    model = "OPENCV";
    count = 4;
  }
  for (int k = 0; k < count; ++k) parameters.push_back(c.distortion(k));
  return "1 " + model + " " + std::to_string(c.width_px) + " " + std::to_string(c.height_px) + " " +
         list(parameters, " ") + "\n";
}

std::string colmap_pose(const Rigid3& T) {
  const Eigen::Quaterniond& q = T.rotation;
  return list(std::vector<double>{q.w(), q.x(), q.y(), q.z(), T.translation.x(), T.translation.y(),
                                  T.translation.z()},
              " ");
}

// A text model (https://colmap.github.io/format.html) whose world is the board.
Result<std::vector<ExportFile>> write_colmap(const ExportInput& input) {
  const std::string notes = comment(
      input,
      {"the world is the board: x right, y up, z out of it; the room about it moved between "
       "the scenes",
       "poses take a point from the world to the sensor: p = R(QW, QX, QY, QZ) * p_world + T",
       "in this model the centre of the top-left pixel is (0.5, 0.5), below it is (0, 0)"});
  std::string images = notes +
                       "# IMAGE_ID, QW, QX, QY, QZ, TX, TY, TZ, CAMERA_ID, NAME (of the dataset)\n"
                       "# POINTS2D[] as (X, Y, POINT3D_ID): none\n";
  std::string lidars =
      notes +
      "# The LiDAR's pose at each image: IMAGE_ID, QW, QX, QY, QZ, TX, TY, TZ, CLOUD (of the "
      "dataset)\n";
  int number = 0;
  for (const ExportScene& scene : input.scenes) {
    if (!scene.used || scene.image.empty()) continue;
    ++number;
    images += std::to_string(number) + " " + colmap_pose(scene.camera_from_board) + " 1 " +
              scene.image + "\n\n";
    lidars += std::to_string(number) + " " +
              colmap_pose(input.camera_from_lidar.inverse() * scene.camera_from_board) + " " +
              scene.cloud + "\n";
  }
  if (number == 0)
    return Error::untrusted(Message("the result names no image of a scene in use"),
                            "--format colmap", Message("calibrate again with this version"));
  return std::vector<ExportFile>{
      {"cameras.txt",
       notes + "# CAMERA_ID, MODEL, WIDTH, HEIGHT, PARAMS[]\n" + colmap_camera(input.camera)},
      {"images.txt", images},
      {"points3D.txt", notes + "# POINT3D_ID, X, Y, Z, R, G, B, ERROR, TRACK[]: none\n"},
      {"lidars.txt", lidars}};
}

}  // namespace

std::vector<std::string> origin_notes(const ExportInput& input) {
  std::vector<std::string> out = {"LV-Calib " + version()};
  if (!input.dataset.empty()) out.push_back("dataset: " + on_one_line(input.dataset));
  if (!input.quality.empty() && input.quality != "good")
    out.push_back("quality: " + on_one_line(input.quality) + ": see the result's warnings");
  if (input.use) {
    out.push_back("model: " + on_one_line(input.use->model.text()));
    for (const Message& effect : input.use->effects)
      out.push_back("effect: " + on_one_line(effect.text()));
    out.push_back(on_one_line(input.use->clouds.text()));
  }
  if (has_own_names(input)) {
    out.push_back("names of the frames: LiDAR " + input.lidar_frame + ", camera " +
                  input.camera_frame);
  }
  return out;
}

std::vector<std::string> export_notes(const ExportInput& input) {
  const WorkedPoint p = worked_point(input);
  std::vector<std::string> out = origin_notes(input);
  out.emplace_back(
      "camera: x right, y down, z forward; pixel (0, 0) is the centre of the top-left pixel; "
      "metres, radians");
  out.push_back("worked point: lidar_m = [" + list(p.lidar_m) + "]");
  out.push_back("              camera_m = [" + list(p.camera_m) + "]");
  out.push_back("              pixel = [" + list(p.pixel) + "]");
  out.push_back(intrinsics_line(input.camera));
  return out;
}

const std::vector<ExportFormat>& export_formats() {
  static const std::vector<ExportFormat> formats = {
      {"matrix", "T_camera_lidar, 4x4 numbers", false, &write_matrix},
      {"opencv", "rvec and tvec as cv::projectPoints takes them (FileStorage YAML)", false,
       &write_opencv, "yaml"},
      {"ros1-tf", "static_transform_publisher of ROS 1, camera in LiDAR", false, &write_ros1},
      {"ros2-tf", "static_transform_publisher of ROS 2, camera in LiDAR", false, &write_ros2},
      {"urdf", "fixed joint, camera in LiDAR", false, &write_urdf, "urdf"},
      {"kalibr", "camchain with T_cam_lidar", false, &write_kalibr, "yaml"},
      {"autoware", "sensor_kit_calibration.yaml with camera_link (x forward)", false,
       &write_autoware, "yaml"},
      {"fast-livo2", "Rcl and Pcl of FAST-LIVO2, LiDAR to camera", false, &write_fast_livo2,
       "yaml"},
      {"r3live", "camera_ext_R and camera_ext_t of R3LIVE, camera to IMU", true, &write_r3live,
       "yaml"},
      {"lvi-sam", "lidar_to_cam_* of LVI-SAM, LiDAR to x-forward camera", false, &write_lvi_sam,
       "yaml"},
      {"koide", "calib.json of direct_visual_lidar_calibration, T_lidar_camera", false,
       &write_koide, "json"},
      {"boundary-response", "noise of points at reflectivity edges, for SLAM front ends (YAML)",
       false, &export_boundary_response, "yaml"},
      {"kitti", "calib.txt of KITTI's benchmarks, for undistorted images", false, &write_kitti},
      {"colmap", "text model of COLMAP: the scenes' images with their poses, the LiDAR's beside",
       false, nullptr, "", &write_colmap},
      {"colored-ply", "the cloud of a scene with the image's colours (binary PLY)", false, nullptr,
       "ply", nullptr, true}};
  return formats;
}

Status check_frame_name(const std::string& name) {
  const auto allowed = [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '_' || c == '-' || c == '.' || c == '/';
  };
  if (!name.empty() && name.front() != '-' && name.size() <= 100 &&
      std::all_of(name.begin(), name.end(), allowed) && name.find("--") == std::string::npos)
    return Done{};
  return Error::usage(Message("'%1' is no name of a frame; expected letters, digits and _ - . /, "
                              "not beginning with - and without --",
                              name.substr(0, 100)),
                      {}, Message("as the robot's description calls it: velodyne, camera_left"));
}

Result<std::string> export_result(const ExportInput& input, const std::string& format) {
  for (const std::string& name : {input.lidar_frame, input.camera_frame}) {
    if (Status s = check_frame_name(name); !s) return s.error();
  }
  if (input.lidar_frame == input.camera_frame) {
    return Error::usage(
        Message(
            "LiDAR and camera cannot both be called '%1': no reader could tell the frames apart",
            input.lidar_frame),
        {}, Message("give each frame a name of its own"));
  }
  std::vector<std::string> names;
  for (const ExportFormat& f : export_formats()) {
    names.push_back(f.name);
    if (f.name != format) continue;
    if (f.needs_imu && !input.imu_from_lidar) {
      return Error::usage(
          Message("the format %1 holds the camera's pose in the IMU frame and needs T_imu_lidar",
                  format),
          "--format",
          Message(
              "give a YAML file with T_imu_lidar (takes a LiDAR point to the IMU frame) by --imu"));
    }
    if (f.is_cloud) return colored_ply_header(input, Cloud{});
    if (f.write_files == nullptr) return f.write(input);
    const auto files = f.write_files(input);
    if (!files) return files.error();
    std::string out;
    for (const ExportFile& file : *files) out += "=== " + file.name + "\n" + file.text + "\n";
    return out;
  }
  std::string known;
  for (const std::string& name : names) known += (known.empty() ? "" : ", ") + name;
  const std::string near = nearest_word(format, names);
  return Error::usage(Message("there is no format '%1', known are %2", format, known), "--format",
                      near.empty() ? Message() : Message("did you mean %1?", near));
}

Status write_export(const ExportInput& input, const std::string& format,
                    const std::filesystem::path& path) {
  // Says what is wrong with the format or the names.
  const auto text = export_result(input, format);
  if (!text) return text.error();
  for (const ExportFormat& f : export_formats()) {
    if (f.name != format) continue;
    if (f.is_cloud)
      return Error::usage(Message("a cloud is written of one scene"), "--format " + format);
    if (f.write_files == nullptr) continue;
    const auto files = f.write_files(input);
    if (!files) return files.error();
    if (Status s = create_folder(path); !s) return s;
    for (const ExportFile& file : *files) {
      if (Status s = write_file_atomically(path / file.name, file.text); !s) return s;
    }
    return Done{};
  }
  return write_file_atomically(path, *text);
}

}  // namespace lvcalib
