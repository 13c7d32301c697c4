// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <iterator>
#include <sstream>
#include <string>

#include "base/yaml_file.h"
#include "camera/camera.h"
#include "camera/camera_text.h"

namespace lvcalib {
namespace {

constexpr int kLargestSide_px = 200'000;
using Keys = std::vector<std::string>;

Keys words(const char* text) {
  std::istringstream stream(text);
  return {std::istream_iterator<std::string>(stream), {}};
}

// Where each fact may stand, ROS's name first. One file uses one name.
const char* const kWidth = "image_width width image_Width";
const char* const kHeight = "image_height height image_Height";
const char* const kSize = "ImageSize image_size resolution";
const char* const kMatrix = "camera_matrix Camera_Matrix cameraMatrix CameraMat K k";
const char* const kCoefficients =
    "distortion_coefficients Distortion_Coefficients distCoeffs DistCoeff dist_coeffs "
    "distortion_coeffs D d";
const char* const kRosOnly = "camera_name rectification_matrix projection_matrix";
// Keys that the formats' own tools write and that do not matter here.
const char* const kHarmless =
    "distortion_model fisheye_model header R P r p binning_x binning_y roi ImageSize image_size "
    "calibration_time calibration_Time nframes nr_of_frames nrOfFrames board_width board_Width "
    "board_height board_Height square_size square_Size aspectRatio fix_aspect_ratio flags "
    "flagValue fix_principal_point zero_tangent_dist avg_reprojection_error "
    "Avg_Reprojection_Error ReprojectionError per_view_reprojection_errors "
    "Per_View_Reprojection_Errors extrinsic_parameters Extrinsic_Parameters CameraExtrinsicMat "
    "image_points Image_points grid_points standard_deviations";

std::string first_present(const YamlFile& file, const char* candidates) {
  const Keys names = words(candidates);
  const auto found =
      std::find_if(names.begin(), names.end(), [&](const auto& key) { return file.has(key); });
  return found == names.end() ? std::string{} : *found;
}

// A list of numbers, or a map {rows, cols, data} whose counts agree.
Result<std::vector<double>> matrix_numbers(const YamlFile& file, const std::string& key) {
  if (file.root().find(key)->kind != YamlValue::Kind::kMap) return file.numbers(key);
  auto section = file.section(key);
  if (!section) return section.error();
  auto data = section->numbers("data");
  if (!data) {
    Error error = data.error();
    error.message = Message("in '%1': %2", key, error.message);
    return error;
  }
  if (section->has("rows") || section->has("cols")) {
    const auto rows = section->integer("rows", 0, 100);
    const auto cols = section->integer("cols", 0, 100);
    if (!rows) return rows.error();
    if (!cols) return cols.error();
    if (static_cast<std::size_t>(*rows) * static_cast<std::size_t>(*cols) != data->size()) {
      return file.error_at(*file.root().find(key), Message("'%1' says %2 × %3 but holds %4 numbers",
                                                           key, *rows, *cols, data->size()));
    }
  }
  return data;
}

Result<Done> read_size(const YamlFile& file, Camera& camera) {
  const std::string width = first_present(file, kWidth);
  const std::string height = first_present(file, kHeight);
  const std::string pair = first_present(file, kSize);
  if (width.empty() && height.empty() && !pair.empty()) {
    const auto size = file.numbers(pair, 2);
    if (!size) return size.error();
    for (const double side : *size) {
      if (side < 1 || side > kLargestSide_px || side != std::floor(side)) {
        return file.error_at(*file.root().find(pair),
                             Message("'%1' must hold width and height in whole pixels", pair));
      }
    }
    camera.width_px = static_cast<int>((*size)[0]);
    camera.height_px = static_cast<int>((*size)[1]);
    return Done{};
  }
  const auto w = file.integer(width.empty() ? words(kWidth)[0] : width, 1, kLargestSide_px);
  if (!w) return w.error();
  const auto h = file.integer(height.empty() ? words(kHeight)[0] : height, 1, kLargestSide_px);
  if (!h) return h.error();
  camera.width_px = *w;
  camera.height_px = *h;
  return Done{};
}

Result<Done> read_matrix(const YamlFile& file, Camera& camera) {
  const std::string key = first_present(file, kMatrix);
  if (key.empty()) {
    return file.missing("camera_matrix", Message("a 3 × 3 matrix"));
  }
  const auto m = matrix_numbers(file, key);
  if (!m) return m.error();
  const YamlValue& value = *file.root().find(key);
  if (m->size() != 9) {
    return file.error_at(value, Message("'%1' must hold 9 numbers, found %2", key, m->size()));
  }
  const auto& k = *m;
  if (k[1] != 0 || k[3] != 0 || k[6] != 0 || k[7] != 0 || k[8] != 1) {
    return file.error_at(value,
                         Message("'%1' must be [fx, 0, cx, 0, fy, cy, 0, 0, 1] row by row%2", key,
                                 k[1] != 0 ? Message("; skew is not supported") : Message()));
  }
  camera.fx = k[0];
  camera.fy = k[4];
  camera.cx = k[2];
  camera.cy = k[5];
  return Done{};
}

// Takes over coefficients; a model with n of them accepts trailing zeros beyond, and plumb_bob
// may leave out k3.
Result<Done> set_distortion(const YamlFile& file, const std::string& key,
                            const std::vector<double>& values, Camera& camera) {
  const auto count = static_cast<std::size_t>(camera.distortion_count());
  const bool short_form = camera.model == DistortionModel::kPlumbBob && values.size() == 4;
  const bool enough = values.size() >= count || short_form;
  if (!enough || values.size() > 14) {
    return file.error_at(
        *file.root().find(key),
        Message("'%1' must hold %2 numbers for this distortion model, found %3", key,
                camera.model == DistortionModel::kPlumbBob
                    ? Message("4 or 5")
                    : Message::verbatim(std::to_string(count)),
                values.size()));
  }
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (i < count) {
      camera.distortion[static_cast<Eigen::Index>(i)] = values[i];
    } else if (values[i] != 0.0) {
      return file.error_at(*file.root().find(key),
                           Message("'%1' holds %2 numbers, but this distortion model has %3; "
                                   "thin-prism and tilt terms are not supported",
                                   key, values.size(), count));
    }
  }
  return Done{};
}

Result<Done> read_model(const YamlFile& file, const std::string& key, Camera& camera) {
  const auto name = file.string(key);
  if (!name) return name.error();
  if (*name == "plumb_bob" || *name == "radtan") {
    camera.model = DistortionModel::kPlumbBob;
  } else if (*name == "rational_polynomial") {
    camera.model = DistortionModel::kRationalPolynomial;
  } else if (*name == "equidistant" || *name == "fisheye") {
    camera.model = DistortionModel::kEquidistant;
  } else {
    const std::string near = nearest_word(
        *name, {"plumb_bob", "radtan", "rational_polynomial", "equidistant", "fisheye"});
    return file.error_at(*file.root().find(key),
                         Message("distortion model '%1' is not known; expected plumb_bob, "
                                 "rational_polynomial or equidistant%2",
                                 name->substr(0, 60),
                                 near.empty() ? Message() : Message("; did you mean '%1'?", near)));
  }
  return Done{};
}

// The model by its name, or by the number of coefficients in OpenCV's way.
Status choose_model(const YamlFile& file, std::size_t coefficients, CameraFile& out) {
  Camera& camera = out.camera;
  if (file.has("distortion_model")) return read_model(file, "distortion_model", camera);
  if (!first_present(file, kRosOnly).empty()) {
    return file.missing("distortion_model",
                        Message("plumb_bob, rational_polynomial or equidistant"));
  }
  if (file.has("fisheye_model")) {
    const auto fisheye = file.integer("fisheye_model", 0, 1);
    if (!fisheye) return fisheye.error();
    if (*fisheye == 1) {
      camera.model = DistortionModel::kEquidistant;
      return Done{};
    }
  } else if (coefficients == 4) {
    out.warnings.push_back(
        Message("%1: 4 distortion coefficients and no distortion_model: taken as k1 k2 p1 p2; add "
                "'distortion_model: equidistant' if this is a fisheye lens",
                file.name()));
  }
  if (coefficients >= 8) camera.model = DistortionModel::kRationalPolynomial;
  return Done{};
}

// ROS camera_info and OpenCV FileStorage: both hold a camera matrix.
Result<CameraFile> read_matrix_style(const YamlFile& file) {
  Keys known;
  for (const char* group : {kWidth, kHeight, kMatrix, kCoefficients, kRosOnly, kHarmless}) {
    for (auto& key : words(group)) known.push_back(std::move(key));
  }
  CameraFile out;
  out.warnings = file.unknown_keys(known);
  if (Status s = read_size(file, out.camera); !s) return s.error();
  if (Status s = read_matrix(file, out.camera); !s) return s.error();
  const std::string key = first_present(file, kCoefficients);
  if (key.empty()) {
    return file.missing("distortion_coefficients", Message("a list of numbers"));
  }
  const auto values = matrix_numbers(file, key);
  if (!values) return values.error();
  if (Status s = choose_model(file, values->size(), out); !s) return s.error();
  if (Status s = set_distortion(file, key, *values, out.camera); !s) return s.error();
  if (file.has("camera_name")) {
    const auto name = file.string("camera_name");
    if (!name) return name.error();
    out.camera.name = *name;
  }
  return out;
}

Result<CameraFile> read_kalibr_camera(const YamlFile& file, std::string name) {
  const Keys known = words(
      "camera_model intrinsics distortion_model distortion_coeffs resolution rostopic "
      "cam_overlaps T_cn_cnm1 T_cam_imu T_imu_cam timeshift_cam_imu standard_deviations");
  CameraFile out;
  out.warnings = file.unknown_keys(known);
  Camera& camera = out.camera;
  camera.name = std::move(name);
  const auto model = file.string("camera_model");
  if (!model) return model.error();
  if (*model != "pinhole") {
    return file.error_at(
        *file.root().find("camera_model"),
        Message("camera_model '%1' is not supported; expected pinhole", model->substr(0, 60)));
  }
  const auto intrinsics = file.numbers("intrinsics", 4);
  if (!intrinsics) return intrinsics.error();
  camera.fx = (*intrinsics)[0];
  camera.fy = (*intrinsics)[1];
  camera.cx = (*intrinsics)[2];
  camera.cy = (*intrinsics)[3];
  if (!file.has("resolution")) {
    return file.missing("resolution", Message::verbatim("[width, height]"));
  }
  if (Status s = read_size(file, camera); !s) return s.error();
  const auto distortion = file.string("distortion_model");
  if (!distortion) return distortion.error();
  if (*distortion == "none") return out;
  if (Status s = read_model(file, "distortion_model", camera); !s) return s.error();
  const auto values = file.numbers("distortion_coeffs");
  if (!values) return values.error();
  if (Status s = set_distortion(file, "distortion_coeffs", *values, camera); !s) return s.error();
  return out;
}

bool is_kalibr_key(const std::string& key) {
  return key.starts_with("cam") && key.size() > 3 &&
         std::all_of(key.begin() + 3, key.end(), [](char c) { return c >= '0' && c <= '9'; });
}

Result<CameraFile> read_camchain(const YamlFile& file) {
  std::vector<std::string> cameras;
  for (const auto& [key, value] : file.root().map) {
    if (is_kalibr_key(key)) cameras.push_back(key);
  }
  const auto section = file.section(cameras.front());
  if (!section) return section.error();
  auto out = read_kalibr_camera(*section, cameras.front());
  if (out) {
    for (auto& warning : file.unknown_keys(cameras)) out->warnings.push_back(std::move(warning));
    if (cameras.size() > 1) {
      out->warnings.push_back(Message("%1: holds %2 cameras; '%3' is used", file.name(),
                                      cameras.size(), cameras.front()));
    }
  }
  return out;
}

Result<CameraFile> read_any(const YamlFile& file) {
  const auto& keys = file.root().map;
  if (std::any_of(keys.begin(), keys.end(), [](const auto& k) { return is_kalibr_key(k.first); })) {
    return read_camchain(file);
  }
  if (file.has("camera_model") || file.has("intrinsics")) return read_kalibr_camera(file, {});
  if (!first_present(file, kMatrix).empty() || !first_present(file, kCoefficients).empty() ||
      !first_present(file, kWidth).empty()) {
    return read_matrix_style(file);
  }
  return Error::input(
      Message("no camera intrinsics found; expected the keys of ROS camera_info (camera_matrix, "
              "distortion_model), a Kalibr camchain (cam0) or OpenCV (camera_matrix)"),
      file.name());
}

// A distortion fitted to the middle of the image may fold back before its corners.
void warn_of_fold(CameraFile& out, const std::string& where) {
  const Camera& c = out.camera;
  int blind = 0;
  for (const double x : {0.0, c.width_px - 1.0}) {
    for (const double y : {0.0, c.height_px - 1.0}) {
      blind += c.unproject({x, y}) ? 0 : 1;
    }
  }
  if (blind > 0) {
    out.warnings.push_back(
        Message("%1: the distortion folds back inside the image: %2 of its 4 corners have no ray; "
                "are the coefficients right?",
                where, blind));
  }
}

Result<CameraFile> camera_of(const Result<YamlFile>& file) {
  if (!file) return file.error();
  auto out = read_any(*file);
  if (!out) return out;
  if (Status status = check(out->camera); !status) {
    Error error = status.error();
    error.where = file->name();
    return error;
  }
  warn_of_fold(*out, file->name());
  return out;
}

std::string text(double value) {
  std::array<char, 32> buffer{};
  return {buffer.data(), std::to_chars(buffer.data(), buffer.data() + buffer.size(), value).ptr};
}

}  // namespace

std::string name_of(DistortionModel model) {
  switch (model) {
    case DistortionModel::kPlumbBob:
      return "plumb_bob";
    case DistortionModel::kRationalPolynomial:
      return "rational_polynomial";
    case DistortionModel::kEquidistant:
      break;
  }
  return "equidistant";
}

Result<CameraFile> read_camera(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (extension == ".xml") {
    return Error::input(
        Message("XML intrinsics are not read"), path.string(),
        Message("save them as YAML: OpenCV's FileStorage does for a name ending in .yaml"));
  }
  return camera_of(YamlFile::load(path));
}

Result<CameraFile> camera_from_text(std::string text, const std::string& name) {
  return camera_of(YamlFile::parse(std::move(text), name));
}

std::string to_yaml(const Camera& c) {
  std::string out = "image_width: " + std::to_string(c.width_px) + "\n";
  out += "image_height: " + std::to_string(c.height_px) + "\n";
  // JSON's quoting rules are YAML's for double-quoted scalars.
  std::string name;
  for (const char ch : c.name) {
    if (ch == '"' || ch == '\\') name += '\\';
    if (static_cast<unsigned char>(ch) >= 0x20) name += ch;
  }
  out += "camera_name: \"" + name + "\"\n";
  out += "camera_matrix:\n  rows: 3\n  cols: 3\n  data: [" + text(c.fx) + ", 0, " + text(c.cx) +
         ", 0, " + text(c.fy) + ", " + text(c.cy) + ", 0, 0, 1]\n";
  out += "distortion_model: " + name_of(c.model) + "\n";
  const int count = c.distortion_count();
  out += "distortion_coefficients:\n  rows: 1\n  cols: " + std::to_string(count) + "\n  data: [";
  for (int i = 0; i < count; ++i) out += (i == 0 ? "" : ", ") + text(c.distortion[i]);
  return out + "]\n";
}

}  // namespace lvcalib
