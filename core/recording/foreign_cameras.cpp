// SPDX-License-Identifier: BSD-3-Clause
#include "recording/foreign_cameras.h"

#include <cmath>
#include <map>
#include <sstream>
#include <vector>

#include <nlohmann/json.hpp>

#include "base/yaml_file.h"

namespace lvcalib {
namespace {

Result<Camera> checked(Camera camera, const std::string& where) {
  if (Status s = check(camera); !s) {
    Error error = s.error();
    error.where = where;
    return error;
  }
  return camera;
}

}  // namespace

Result<Camera> camera_of_kitti(std::string_view text, const std::string& number, bool rectified,
                               const std::string& where) {
  std::map<std::string, std::vector<double>> lines;
  std::istringstream stream{std::string(text)};
  for (std::string line; std::getline(stream, line);) {
    const std::size_t colon = line.find(':');
    if (colon == std::string::npos) continue;
    std::istringstream words(line.substr(colon + 1));
    std::vector<double>& values = lines[line.substr(0, colon)];
    double value = 0.0;
    for (std::string word; words >> word && parse_number(word, value);) values.push_back(value);
  }
  const auto numbers = [&](const std::string& key,
                           std::size_t count) -> Result<std::vector<double>> {
    const auto found = lines.find(key);
    if (found != lines.end() && found->second.size() == count) return found->second;
    return Error::input(Message("expected %1 numbers after '%2:'", count, key), where);
  };
  const auto size = numbers((rectified ? "S_rect_" : "S_") + number, 2);
  if (!size) return size.error();
  const auto matrix = rectified ? numbers("P_rect_" + number, 12) : numbers("K_" + number, 9);
  if (!matrix) return matrix.error();
  Camera out;
  out.name = "image_" + number;
  out.width_px = static_cast<int>(std::lround((*size)[0]));
  out.height_px = static_cast<int>(std::lround((*size)[1]));
  const std::size_t row = rectified ? 4 : 3;
  out.fx = (*matrix)[0];
  out.cx = (*matrix)[2];
  out.fy = (*matrix)[row + 1];
  out.cy = (*matrix)[row + 2];
  if (!rectified) {
    const auto distortion = numbers("D_" + number, 5);
    if (!distortion) return distortion.error();
    for (std::size_t k = 0; k < 5; ++k)
      out.distortion[static_cast<Eigen::Index>(k)] = (*distortion)[k];
  }
  return checked(out, where);
}

Result<Camera> camera_of_calib_json(std::string_view text, int width_px, int height_px,
                                    const std::string& where) {
  const auto json = nlohmann::json::parse(text, nullptr, false);
  const auto bad = [&](const Message& what) { return Error::input(what, where); };
  if (!json.is_object() || !json.contains("camera") || !json["camera"].is_object())
    return bad(Message("expected JSON with an object \"camera\""));
  const auto& camera = json["camera"];
  const auto numbers = [&](const char* key) {
    std::vector<double> out;
    if (!camera.contains(key) || !camera[key].is_array()) return out;
    for (const auto& value : camera[key]) {
      if (value.is_number()) out.push_back(value.get<double>());
    }
    return out;
  };
  const std::string model = camera.contains("camera_model") && camera["camera_model"].is_string()
                                ? camera["camera_model"].get<std::string>()
                                : std::string();
  Camera out;
  if (model == "fisheye") {
    out.model = DistortionModel::kEquidistant;
  } else if (model != "plumb_bob") {
    return bad(
        Message("its camera model '%1' has no counterpart here; expected plumb_bob or fisheye",
                model.substr(0, 40)));
  }
  const auto intrinsics = numbers("intrinsics");
  const auto distortion = numbers("distortion_coeffs");
  if (intrinsics.size() != 4) return bad(Message("\"intrinsics\" must hold fx, fy, cx, cy"));
  if (distortion.size() > static_cast<std::size_t>(out.distortion_count()))
    return bad(Message("\"distortion_coeffs\" holds more numbers than its model has"));
  out.width_px = width_px;
  out.height_px = height_px;
  out.fx = intrinsics[0];
  out.fy = intrinsics[1];
  out.cx = intrinsics[2];
  out.cy = intrinsics[3];
  for (std::size_t k = 0; k < distortion.size(); ++k)
    out.distortion[static_cast<Eigen::Index>(k)] = distortion[k];
  return checked(out, where);
}

Result<Camera> camera_of_qr_params(const std::filesystem::path& path, int width_px, int height_px) {
  const auto file = YamlFile::load(path);
  if (!file) return file.error();
  Camera out;
  out.width_px = width_px;
  out.height_px = height_px;
  const bool fisheye = file->has("cam_model") && file->string("cam_model").ok() &&
                       *file->string("cam_model") == "fisheye";
  if (fisheye) out.model = DistortionModel::kEquidistant;
  for (const auto& [key, value] :
       {std::pair("fx", &out.fx), {"fy", &out.fy}, {"cx", &out.cx}, {"cy", &out.cy}}) {
    const auto number = file->number(key);
    if (!number) return number.error();
    *value = *number;
  }
  const std::vector<const char*> names = fisheye ? std::vector<const char*>{"k1", "k2", "k3", "k4"}
                                                 : std::vector<const char*>{"k1", "k2", "p1", "p2"};
  for (std::size_t k = 0; k < names.size(); ++k) {
    const auto number = file->number(names[k]);
    if (!number) return number.error();
    out.distortion[static_cast<Eigen::Index>(k)] = *number;
  }
  return checked(out, path.string());
}

}  // namespace lvcalib
