// SPDX-License-Identifier: BSD-3-Clause
#include <array>
#include <cmath>

#include <nlohmann/json.hpp>

#include "base/file_io.h"
#include "report/exports.h"
#include "report/json_values.h"
#include "report/result_file.h"

namespace lvcalib {
namespace {

using nlohmann::json;

Result<double> number_at(const json& j, const char* key, const std::string& where) {
  const auto found = j.find(key);
  if (found == j.end() || !found->is_number())
    return Error::input(Message("camera.%1 is missing or not a number", key), where);
  return found->get<double>();
}

Result<Camera> camera_of(const json& j, const std::string& where) {
  const auto found = j.find("camera");
  if (found == j.end() || !found->is_object()) {
    return Error::input(Message("there is no camera in this result"), where,
                        Message("calibrate again with this version, which stores the intrinsics"));
  }
  Camera camera;
  const std::array<std::pair<const char*, double*>, 4> fields = {
      {{"fx", &camera.fx}, {"fy", &camera.fy}, {"cx", &camera.cx}, {"cy", &camera.cy}}};
  for (const auto& [key, value] : fields) {
    auto number = number_at(*found, key, where);
    if (!number) return number.error();
    *value = *number;
  }
  auto width = number_at(*found, "width", where);
  if (!width) return width.error();
  auto height = number_at(*found, "height", where);
  if (!height) return height.error();
  const auto whole = [](double v) { return v >= 1.0 && v <= 1e6; };
  if (!whole(*width) || !whole(*height))
    return Error::input(Message("camera.width and camera.height are no image size"), where);
  camera.width_px = static_cast<int>(*width);
  camera.height_px = static_cast<int>(*height);
  const auto model = found->find("distortion_model");
  const std::string name =
      model != found->end() && model->is_string() ? model->get<std::string>() : "";
  if (name == "plumb_bob") {
    camera.model = DistortionModel::kPlumbBob;
  } else if (name == "rational_polynomial") {
    camera.model = DistortionModel::kRationalPolynomial;
  } else if (name == "equidistant") {
    camera.model = DistortionModel::kEquidistant;
  } else {
    return Error::input(
        Message("camera.distortion_model is none of plumb_bob, rational_polynomial, equidistant"),
        where);
  }
  const auto distortion = found->find("distortion");
  if (distortion == found->end() || !distortion->is_array() ||
      distortion->size() != static_cast<std::size_t>(camera.distortion_count()))
    return Error::input(
        Message("camera.distortion is missing or of another length than its model's"), where);
  for (std::size_t k = 0; k < distortion->size(); ++k) {
    if (!(*distortion)[k].is_number())
      return Error::input(Message("camera.distortion holds something that is no number"), where);
    camera.distortion(static_cast<Eigen::Index>(k)) = (*distortion)[k].get<double>();
  }
  if (Status status = check(camera); !status) {
    Error error = status.error();
    error.where = where;
    return error;
  }
  return camera;
}

// Scenes whose entries lack something are left out: formats that need them say so.
std::vector<ExportScene> scenes_of(const json& j) {
  std::vector<ExportScene> out;
  const auto scenes = j.find("scenes");
  if (scenes == j.end() || !scenes->is_array()) return out;
  for (const json& entry : *scenes) {
    if (!entry.is_object() || !entry.contains("name") || !entry["name"].is_string() ||
        !entry.contains("T_camera_board"))
      continue;
    Eigen::MatrixXd m;
    if (!read_rows(entry["T_camera_board"], 4, 4, m)) continue;
    ExportScene scene;
    scene.name = entry["name"].get<std::string>();
    scene.used = entry.value("used", json(true)) == json(true);
    scene.camera_from_board = Rigid3::from_matrix(Eigen::Matrix4d(m));
    const std::string folder = "scenes/" + scene.name + "/";
    for (const json& input : j.value("inputs", json::array())) {
      const std::string path =
          input.is_object() && input.contains("path") && input["path"].is_string()
              ? input["path"].get<std::string>()
              : std::string();
      if (path.rfind(folder + "image.", 0) == 0) scene.image = path;
      if (path.rfind(folder + "cloud.", 0) == 0) scene.cloud = path;
    }
    out.push_back(std::move(scene));
  }
  return out;
}

}  // namespace

Result<Camera> camera_from_json_text(const std::string& result_json, const std::string& where) {
  const json j = parse_json(result_json);
  if (j.is_discarded() || !j.is_object()) return Error::input(Message("not a JSON object"), where);
  return camera_of(j, where);
}

ExportInput export_input_of(const CalibrationResult& result) {
  ExportInput input;
  input.camera_from_lidar = result.extrinsic.camera_from_lidar.transform;
  input.camera = result.camera;
  input.dataset = result.dataset;
  input.quality = name_of(result.quality);
  input.use = pose_use(result);
  input.result_json = result_as_json(result);
  input.scenes = scenes_of(parse_json(input.result_json));
  return input;
}

Result<ExportInput> read_export_input(const std::filesystem::path& result_json) {
  auto stored = read_result(result_json);
  if (!stored) return stored.error();
  auto text = read_text_file(result_json, kMaxResultBytes);
  if (!text) return text.error();
  auto camera = camera_from_json_text(*text, result_json.string());
  if (!camera) return camera.error();
  const json j = parse_json(*text);
  ExportInput input;
  input.camera_from_lidar = stored->camera_from_lidar;
  input.camera = *camera;
  const auto dataset = j.find("dataset");
  if (dataset != j.end() && dataset->is_string()) input.dataset = dataset->get<std::string>();
  const auto quality = j.find("quality");
  if (quality != j.end() && quality->is_string()) input.quality = quality->get<std::string>();
  if (const auto model = model_in(*text, result_json.string())) input.use = pose_use(*model);
  if (const auto frames = j.find("frames"); frames != j.end() && frames->is_object()) {
    // Names that no format takes are as good as none.
    for (const auto& [key, name] :
         {std::pair("lidar", &input.lidar_frame), std::pair("camera", &input.camera_frame)}) {
      const auto found = frames->find(key);
      if (found == frames->end() || !found->is_string()) continue;
      const auto text_of = found->get<std::string>();
      if (check_frame_name(text_of)) *name = text_of;
    }
  }
  input.scenes = scenes_of(j);
  input.result_json = std::move(*text);
  return input;
}

}  // namespace lvcalib
