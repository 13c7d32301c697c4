// SPDX-License-Identifier: BSD-3-Clause
#include "report/evidence_json.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/statistics.h"
#include "report/json_values.h"
#include "response/response_curves.h"

namespace lvcalib {
namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;

ordered_json or_null(const std::optional<double>& value) {
  return value ? ordered_json(*value) : ordered_json(nullptr);
}

// Minimum, quartiles, maximum: what a box plot shows.
ordered_json box_of(const std::vector<double>& values) {
  ordered_json box = ordered_json::array();
  if (values.empty()) return box;
  for (const double q : {0.0, 0.25, 0.5, 0.75, 1.0}) box.push_back(quantile(values, q));
  return box;
}

ordered_json method_scene_json(const MethodScene& scene) {
  return {{"name", scene.name},
          {"rms_px", scene.rms_px},
          {"rms_mm", scene.rms_mm},
          {"heldout_px", or_null(scene.heldout_px)},
          {"heldout_mm", or_null(scene.heldout_mm)},
          {"box_px", box_of(scene.errors_px)},
          {"box_mm", box_of(scene.errors_mm)}};
}

ordered_json method_json(const MethodResult& m) {
  ordered_json j = {
      {"name", m.name},
      {"rms_px", m.rms_px},
      {"rms_mm", m.rms_mm},
      {"transfer_px", m.transfer_px},
      {"heldout_px", or_null(m.heldout_px)},
      {"heldout_mm", or_null(m.heldout_mm)},
      {"to_joint", {{"translation_mm", m.translation_mm}, {"rotation_mrad", m.rotation_mrad}}},
      {"T_camera_lidar", rows_of(m.camera_from_lidar.matrix())}};
  std::vector<double> px;
  std::vector<double> mm;
  j["scenes"] = ordered_json::array();
  for (const MethodScene& scene : m.scenes) {
    j["scenes"].push_back(method_scene_json(scene));
    px.insert(px.end(), scene.errors_px.begin(), scene.errors_px.end());
    mm.insert(mm.end(), scene.errors_mm.begin(), scene.errors_mm.end());
  }
  j["box_px"] = box_of(px);
  j["box_mm"] = box_of(mm);
  return j;
}

// Angles in degrees and ranges in millimetres, as the key names say.
void put_statistics(ordered_json& j, const ResponseStatistics& s) {
  const Eigen::Vector3d unit(kDegrees, kDegrees, 1e3);
  const Eigen::Vector3d mean = s.mean.cwiseProduct(unit);
  const Eigen::Vector3d std_dev = s.std_dev().cwiseProduct(unit);
  const Eigen::Vector3d mean_sigma = s.mean_sigma.cwiseProduct(unit);
  const Eigen::Vector3d std_sigma = s.std_sigma.cwiseProduct(unit);
  const char* const names[] = {"pitch_deg", "yaw_deg", "range_mm"};
  j["n"] = s.n;
  for (int k = 0; k < 3; ++k) j[std::string("mean_") + names[k]] = mean(k);
  for (int k = 0; k < 3; ++k) j[std::string("std_") + names[k]] = std_dev(k);
  for (int k = 0; k < 3; ++k) j[std::string("mean_sigma_") + names[k]] = mean_sigma(k);
  for (int k = 0; k < 3; ++k) j[std::string("std_sigma_") + names[k]] = std_sigma(k);
  j["covariance"] = rows_of(s.covariance);
  j["paired_covariance"] = rows_of(s.paired);
}

ordered_json transition_json(const TransitionFit& t) {
  return {{"mu_in", t.mu_in},
          {"mu_out", t.mu_out},
          {"delta_mm", 1e3 * t.delta_m},
          {"sigma_mm", 1e3 * t.sigma_m},
          {"mu_in_sigma", t.mu_in_sigma},
          {"mu_out_sigma", t.mu_out_sigma},
          {"delta_sigma_mm", 1e3 * t.delta_sigma_m},
          {"sigma_sigma_mm", 1e3 * t.sigma_sigma_m},
          {"noise", t.noise},
          {"samples", t.samples}};
}

// Mean intensity by distance, in classes of a millimetre.
ordered_json curve_json(const SceneResponse& scene) {
  ordered_json curve = ordered_json::array();
  for (const TransitionBin& bin : transition_curve(scene))
    curve.push_back({{"d_mm", 1e3 * bin.distance_m}, {"mean", bin.mean}, {"n", bin.n}});
  return curve;
}

// Range residuals of the overlap samples in classes of 2 mm.
ordered_json histogram_json(const SceneResponse& scene) {
  const SceneResponse* const one[] = {&scene};
  ordered_json out = ordered_json::array();
  for (const RangeBin& bin : range_histogram(one))
    out.push_back({{"low_mm", std::lround(1e3 * bin.low_m)}, {"n", bin.n}});
  return out;
}

ordered_json node_response_json(const NodeResponse& node) {
  return {{"id", node.id},
          {"state", describe(node.state)},
          {"reason", node.reason},
          {"samples", node.samples},
          {"overlap", node.overlap}};
}

ordered_json scene_response_json(const SceneResponse& scene) {
  ordered_json j = {{"name", scene.name}, {"n", 0}};
  if (scene.statistics) put_statistics(j, *scene.statistics);
  if (!scene.reason.empty()) j["reason"] = scene.reason;
  if (scene.transition) j["transition"] = transition_json(*scene.transition);
  j["nodes"] = ordered_json::array();
  for (const NodeResponse& node : scene.nodes) j["nodes"].push_back(node_response_json(node));
  j["curve"] = curve_json(scene);
  j["range_histogram"] = histogram_json(scene);
  return j;
}

ordered_json cells_json(const std::vector<ResponseCell>& cells) {
  ordered_json out = ordered_json::array();
  for (const ResponseCell& cell : cells) {
    ordered_json j = {{"range_m", {cell.range_low_m, cell.range_high_m}},
                      {"incidence_deg", {cell.incidence_low_deg, cell.incidence_high_deg}},
                      {"n", cell.n}};
    if (cell.statistics) {
      put_statistics(j, *cell.statistics);
    } else {
      j["reason"] = "not enough samples";
    }
    out.push_back(std::move(j));
  }
  return out;
}

ordered_json crossings_json(const IterationRecord& record) {
  ordered_json nodes = ordered_json::array();
  for (const NodeRecord& node : record.nodes) {
    ordered_json bins = ordered_json::array();
    for (const BinRecord& bin : node.bins) {
      if (bin.state == BinState::kUsed)
        bins.push_back({bin.angle_rad, 1e3 * bin.midpoint_m, 1e3 * bin.sigma_m});
    }
    nodes.push_back({{"id", node.id}, {"angle_midpoint_sigma", std::move(bins)}});
  }
  return nodes;
}

ordered_json split_json(const SplitHalf& split) {
  return {{"name", split.name},
          {"first", split.first},
          {"second", split.second},
          {"translation_mm", split.translation_mm},
          {"rotation_mrad", split.rotation_mrad},
          {"expected_translation_mm", split.expected_translation_mm},
          {"expected_rotation_mrad", split.expected_rotation_mrad},
          {"chi_square", split.chi_square},
          {"gate", split.gate},
          {"agrees", split.agrees()}};
}

}  // namespace

nlohmann::ordered_json camera_json(const Camera& camera) {
  static const char* const kModels[] = {"plumb_bob", "rational_polynomial", "equidistant"};
  ordered_json distortion = ordered_json::array();
  for (int k = 0; k < camera.distortion_count(); ++k) distortion.push_back(camera.distortion(k));
  return {{"width", camera.width_px},
          {"height", camera.height_px},
          {"fx", camera.fx},
          {"fy", camera.fy},
          {"cx", camera.cx},
          {"cy", camera.cy},
          {"distortion_model", kModels[static_cast<int>(camera.model)]},
          {"distortion", std::move(distortion)}};
}

nlohmann::ordered_json inputs_json(const std::vector<InputFile>& inputs) {
  ordered_json out = ordered_json::array();
  for (const InputFile& file : inputs)
    out.push_back({{"path", file.path}, {"bytes", file.bytes}, {"sha256", file.sha256}});
  return out;
}

nlohmann::ordered_json methods_json(const std::vector<MethodResult>& methods) {
  ordered_json out = ordered_json::array();
  for (const MethodResult& m : methods) out.push_back(method_json(m));
  return out;
}

nlohmann::ordered_json ablation_json(const std::vector<AblationStep>& steps) {
  ordered_json out = ordered_json::array();
  for (const AblationStep& step : steps) {
    const MethodResult& m = step.method;
    out.push_back({{"name", m.name},
                   {"change", step.change},
                   {"rms_px", m.rms_px},
                   {"rms_mm", m.rms_mm},
                   {"heldout_px", or_null(m.heldout_px)},
                   {"heldout_mm", or_null(m.heldout_mm)},
                   {"translation_mm", m.translation_mm},
                   {"rotation_mrad", m.rotation_mrad},
                   {"T_camera_lidar", rows_of(m.camera_from_lidar.matrix())}});
  }
  return out;
}

nlohmann::ordered_json uncertainty_json(const UncertaintyReport& report) {
  ordered_json j;
  j["split_half"] = ordered_json::array();
  for (const SplitHalf& split : report.splits) j["split_half"].push_back(split_json(split));
  if (!report.splits_reason.empty()) j["split_half_reason"] = report.splits_reason;
  j["maps"] = ordered_json::array();
  for (const ProjectedUncertainty& map : report.maps) {
    // JSON has no NaN: pixels without a ray are null.
    j["maps"].push_back({{"range_m", map.range_m},
                         {"columns", map.columns},
                         {"rows", map.rows},
                         {"sigma_px", map.sigma_px}});
  }
  j["by_range"] = ordered_json::array();
  for (const RangeUncertainty& r : report.by_range) {
    j["by_range"].push_back(
        {{"range_m", r.range_m}, {"across_mm", r.across_mm}, {"along_mm", r.along_mm}});
  }
  return j;
}

nlohmann::ordered_json response_json(const BoundaryResponse& response) {
  ordered_json j;
  j["scenes"] = ordered_json::array();
  for (const SceneResponse& scene : response.scenes)
    j["scenes"].push_back(scene_response_json(scene));
  // The same keys, without values, where there is none.
  j["all"] = ordered_json::object();
  put_statistics(j["all"], response.all.value_or(ResponseStatistics()));
  if (!response.all) {
    for (auto& [key, value] : j["all"].items()) value = nullptr;
    j["all"]["n"] = 0;
  }
  if (!response.reason.empty()) j["reason"] = response.reason;
  j["transition"] =
      response.transition ? transition_json(*response.transition) : ordered_json(nullptr);
  j["jitter_share"] = response.jitter_share;
  j["jitter_share_sigma"] = response.jitter_share_sigma;
  j["covariance_units"] = "pitch rad, yaw rad, range m";
  j["by_range"] = cells_json(response.by_range);
  j["by_incidence"] = cells_json(response.by_incidence);
  j["by_range_and_incidence"] = cells_json(response.by_both);
  return j;
}

nlohmann::ordered_json profile_json(const BoardRefinement& refinement) {
  ordered_json j = ordered_json::object();
  if (refinement.history.empty()) return j;
  j["before"] = crossings_json(refinement.history.front());
  j["after"] = crossings_json(refinement.history.back());
  return j;
}

ordered_json budget_json(const std::vector<BudgetItem>& budget) {
  ordered_json out = ordered_json::array();
  for (const BudgetItem& item : budget) {
    out.push_back({{"id", item.id},
                   {"parameter", item.parameter},
                   {"size", item.size},
                   {"unit", item.unit},
                   {"translation_mm", item.translation_mm},
                   {"rotation_mrad", item.rotation_mrad}});
  }
  return out;
}

}  // namespace lvcalib
