// SPDX-License-Identifier: BSD-3-Clause
#include "report/result_comparison.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <Eigen/Cholesky>
#include <nlohmann/json.hpp>

#include "base/file_io.h"
#include "base/yaml_file.h"
#include "report/json_values.h"
#include "report/result_file.h"

namespace lvcalib {
namespace {

using Json = nlohmann::json;

// Six rows of six numbers under a key; zero if there is no such thing.
Matrix6d covariance_in(const Json& j, const char* key) {
  const auto at = j.find(key);
  if (at == j.end() || !at->is_array() || at->size() != 6) return Matrix6d::Zero();
  Matrix6d out;
  for (std::size_t r = 0; r < 6; ++r) {
    const Json& row = (*at)[r];
    if (!row.is_array() || row.size() != 6) return Matrix6d::Zero();
    for (std::size_t c = 0; c < 6; ++c) {
      if (!row[c].is_number()) return Matrix6d::Zero();
      out(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(c)) = row[c].get<double>();
    }
  }
  return out;
}

// P(χ² ≥ x) with six degrees of freedom: a polynomial times an exponential.
double chance_of(double chi2) {
  const double h = 0.5 * chi2;
  return std::exp(-h) * (1.0 + h + 0.5 * h * h);
}

// Points of a board's grid along each side: a rotation and a change of distance move them smoothly,
// so that few tell the mean, and arrows at them do not hide each other.
constexpr int kGrid = 7;

std::optional<double> number_in(const Json& j, const char* key) {
  const auto at = j.find(key);
  if (at == j.end() || !at->is_number()) return std::nullopt;
  return at->get<double>();
}

std::string text_in(const Json& j, const char* key) {
  const auto at = j.find(key);
  return at != j.end() && at->is_string() ? at->get<std::string>() : std::string();
}

std::vector<StatedScene> scenes_in(const Json& j) {
  std::vector<StatedScene> out;
  const auto list = j.find("scenes");
  if (list == j.end() || !list->is_array()) return out;
  for (const Json& entry : *list) {
    if (!entry.is_object() || text_in(entry, "name").empty()) continue;
    StatedScene scene;
    scene.name = text_in(entry, "name");
    const auto used = entry.find("used");
    scene.used = used == entry.end() || !used->is_boolean() || used->get<bool>();
    scene.rms_px = number_in(entry, "rms_px");
    scene.rms_mm = number_in(entry, "rms_mm");
    // A result.json has zeros for a scene that was never compared with the others.
    if (!scene.used && scene.rms_px == 0.0 && scene.rms_mm == 0.0) scene.rms_px = scene.rms_mm = {};
    out.push_back(std::move(scene));
  }
  return out;
}

// A value of YAML as JSON, so that both kinds of result are read in one way. Quotes are gone in
// what was parsed: a name that looks like a number is taken for a text where a text is expected.
Json as_json(const YamlValue& value, bool text) {
  Json out;
  switch (value.kind) {
    case YamlValue::Kind::kNull:
      break;
    case YamlValue::Kind::kScalar: {
      double number = 0.0;
      if (!text && (value.scalar == "true" || value.scalar == "false"))
        return value.scalar == "true";
      if (!text && parse_number(value.scalar, number)) return number;
      return value.scalar;
    }
    case YamlValue::Kind::kList:
      out = Json::array();
      for (const YamlValue& entry : value.list) out.push_back(as_json(entry, text));
      break;
    case YamlValue::Kind::kMap:
      out = Json::object();
      for (const auto& [key, entry] : value.map)
        out[key] = as_json(entry, key == "name" || key == "reason" || key == "dataset");
      break;
  }
  return out;
}

bool is_yaml(const std::filesystem::path& path) {
  return path.extension() == ".yaml" || path.extension() == ".yml";
}

Result<Json> read_values(const std::filesystem::path& path) {
  if (is_yaml(path)) {
    const auto file = YamlFile::load(path);
    if (!file) return file.error();
    return as_json(file->root(), false);
  }
  const auto text = read_text_file(path, kMaxResultBytes);
  if (!text) return text.error();
  return parse_json(*text);
}

StatedScene stated_scene(const CalibrationResult& result, const SceneResult& scene) {
  StatedScene out{scene.name, scene.used, {}, {}};
  for (const SceneSolution& solution : result.extrinsic.scenes) {
    if (solution.name != scene.name) continue;
    out.rms_px = solution.rms_px;
    out.rms_mm = solution.rms_mm;
  }
  return out;
}

const StatedScene* find_scene(const StatedResult& result, const std::string& name) {
  const auto at = std::find_if(result.scenes.begin(), result.scenes.end(),
                               [&](const StatedScene& scene) { return scene.name == name; });
  return at == result.scenes.end() ? nullptr : &*at;
}

}  // namespace

StatedResult stated_result(const CalibrationResult& result) {
  StatedResult out;
  StatedExtrinsic& x = out.extrinsic;
  x.camera_from_lidar = result.extrinsic.camera_from_lidar.transform;
  x.covariance = result.extrinsic.camera_from_lidar.covariance;
  x.covariance_total = result.covariance_total.isZero() ? x.covariance : result.covariance_total;
  for (const SceneResult& scene : result.scenes) out.scenes.push_back(stated_scene(result, scene));
  out.dataset = result.dataset;
  return out;
}

Result<StatedResult> read_stated_result(const std::filesystem::path& path) {
  const auto values = read_values(path);
  if (!values) return values.error();
  const Json& j = *values;
  StatedResult out;
  StatedExtrinsic& x = out.extrinsic;
  if (j.is_object() && j.contains("T_CL") && !is_yaml(path)) {
    const auto truth = read_truth(path);
    if (!truth) return truth.error();
    x.camera_from_lidar = *truth;
    x.is_truth = true;
    return out;
  }
  if (!j.is_object() || !j.contains("T_camera_lidar")) {
    return Error::input(
        Message("holds no extrinsic; expected T_camera_lidar (a result) or T_CL (a truth)"),
        path.string(), Message("give the result.json or result.yaml of a calibration"));
  }
  const auto result =
      result_from_json(j.dump(-1, ' ', false, Json::error_handler_t::replace), path);
  if (!result) return result.error();
  x.camera_from_lidar = result->camera_from_lidar;
  x.covariance = result->covariance;
  x.covariance_total = covariance_in(j, "covariance_total");
  if (x.covariance_total.isZero()) x.covariance_total = x.covariance;
  out.scenes = scenes_in(j);
  out.dataset = text_in(j, "dataset");
  return out;
}

bool share_scenes(const StatedResult& first, const StatedResult& second) {
  return !first.dataset.empty() && first.dataset == second.dataset;
}

std::vector<SceneComparison> compare_scenes(const StatedResult& first, const StatedResult& second) {
  std::vector<SceneComparison> out;
  for (const StatedScene& scene : first.scenes) {
    const StatedScene* other = find_scene(second, scene.name);
    out.push_back({scene.name, scene, other != nullptr ? std::optional(*other) : std::nullopt});
  }
  for (const StatedScene& scene : second.scenes) {
    if (find_scene(first, scene.name) == nullptr) out.push_back({scene.name, {}, scene});
  }
  return out;
}

ProjectionShift projection_shift(std::span<const Eigen::Vector3d> points_in_lidar_m,
                                 const Camera& camera, const Rigid3& first_camera_from_lidar,
                                 const Rigid3& second_camera_from_lidar) {
  ProjectionShift out;
  double sum = 0.0;
  for (const Eigen::Vector3d& p : points_in_lidar_m) {
    const auto first = camera.project(first_camera_from_lidar * p);
    const auto second = camera.project(second_camera_from_lidar * p);
    if (!first || !second) continue;
    out.first_px.push_back(*first);
    out.second_px.push_back(*second);
    const double shift2 = (*second - *first).squaredNorm();
    sum += shift2;
    out.largest_px = std::max(out.largest_px, std::sqrt(shift2));
  }
  if (!out.first_px.empty()) out.rms_px = std::sqrt(sum / static_cast<double>(out.first_px.size()));
  return out;
}

std::optional<ProjectionShift> board_shift(const CalibrationResult& result,
                                           const SceneResult& scene,
                                           const Rigid3& first_camera_from_lidar,
                                           const Rigid3& second_camera_from_lidar) {
  if (!scene.refinement) return std::nullopt;
  const BoardOutline outline = result.target.outline();
  std::vector<Eigen::Vector3d> grid;
  for (int row = 0; row < kGrid; ++row) {
    for (int column = 0; column < kGrid; ++column) {
      const Eigen::Vector2d share(column / (kGrid - 1.0), row / (kGrid - 1.0));
      const Eigen::Vector2d p = outline.lower_left_m + share.cwiseProduct(outline.size_m());
      grid.emplace_back(scene.refinement->lidar_from_board * Eigen::Vector3d(p.x(), p.y(), 0.0));
    }
  }
  ProjectionShift shift =
      projection_shift(grid, result.camera, first_camera_from_lidar, second_camera_from_lidar);
  if (shift.first_px.empty()) return std::nullopt;
  return shift;
}

ExtrinsicDifference difference_of(const StatedExtrinsic& first, const StatedExtrinsic& second) {
  ExtrinsicDifference out;
  const Rigid3& a = first.camera_from_lidar;
  const Rigid3& b = second.camera_from_lidar;
  out.translation_mm = 1e3 * translation_distance_m(a, b);
  out.rotation_mrad = 1e3 * rotation_distance_rad(a, b);
  out.by_axis = se3_log(b * a.inverse());
  // Both perturb the same pose from the left: b·a⁻¹ = Exp(−x_b)·Exp(x_a), to first order x_a − x_b.
  const Matrix6d sum = first.covariance_total + second.covariance_total;
  out.sigma_first = first.covariance_total.diagonal().cwiseMax(0.0).cwiseSqrt();
  out.sigma_second = second.covariance_total.diagonal().cwiseMax(0.0).cwiseSqrt();
  if (!first.states_errors() || !second.states_errors()) return out;
  out.sigma = sum.diagonal().cwiseMax(0.0).cwiseSqrt();
  const Eigen::LDLT<Matrix6d> factor(sum);
  if (factor.info() != Eigen::Success || !factor.isPositive() || sum.isZero()) return out;
  const double chi2 = out.by_axis.dot(factor.solve(out.by_axis));
  if (!std::isfinite(chi2)) return out;
  out.chi2 = chi2;
  out.probability = chance_of(chi2);
  return out;
}

}  // namespace lvcalib
