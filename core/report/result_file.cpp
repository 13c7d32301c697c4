// SPDX-License-Identifier: BSD-3-Clause
#include "report/result_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include <nlohmann/json.hpp>

#include "base/file_io.h"
#include "base/text.h"
#include "pipeline/refusals.h"
#include "report/evidence_json.h"
#include "report/json_values.h"
#include "report/stored_model.h"

namespace lvcalib {
namespace {

using nlohmann::ordered_json;

bool is_number(const nlohmann::json& value) {
  return value.is_number();
}

ordered_json pose_json(const Rigid3& pose) {
  const Eigen::Vector4d q = pose.rotation.coeffs();
  return {{"matrix", rows_of(pose.matrix())},
          {"translation_m", list_of(pose.translation)},
          {"quaternion_xyzw", {q(0), q(1), q(2), q(3)}}};
}

ordered_json refinement_json(const BoardRefinement& refinement) {
  ordered_json updates = ordered_json::array();
  for (const IterationRecord& record : refinement.history)
    updates.push_back(1e3 * record.max_update_m);
  return {{"converged", refinement.converged},
          {"iterations", refinement.history.size()},
          {"max_update_mm", std::move(updates)},
          {"range_noise_mm", 1e3 * refinement.plane.sigma_range_m},
          {"transition_sigma_mm", 1e3 * std::sqrt(0.5 * refinement.footprint_m2.trace())},
          {"scale", refinement.scale},
          {"scale_sigma", refinement.scale_sigma},
          {"profile", profile_json(refinement)}};
}

ordered_json nodes_json(const BoardRefinement& refinement, const SceneSolution* solution) {
  ordered_json nodes = ordered_json::array();
  for (std::size_t k = 0; k < refinement.nodes.size(); ++k) {
    const RefinedNode& node = refinement.nodes[k];
    ordered_json j = {{"id", node.id},
                      {"valid", node.valid},
                      {"center_lidar_m", list_of(node.center_lidar_m)},
                      {"sigma_mm", 1e3 * node.sigma_m()},
                      {"valid_bins", node.valid_bins}};
    if (!node.valid) j["reason"] = node.reason;
    if (solution != nullptr && k < solution->nodes.size()) {
      const NodeResidual& found = solution->nodes[k];
      j["residual_mm"] = list_of(1e3 * found.residual_m);
      j["used"] = found.used;
      if (node.valid && !found.used) j["reason"] = misses_the_pose(found);
    }
    nodes.push_back(std::move(j));
  }
  return nodes;
}

// What planes alone leave is no distance of nodes.
ordered_json node_rms_mm(const SceneSolution* scene) {
  if (scene == nullptr) return 0.0;
  return scene->uses_nodes() ? ordered_json(scene->rms_mm) : ordered_json(nullptr);
}

ordered_json scene_json(const SceneResult& scene, const SceneSolution* solution,
                        const Rigid3& camera_from_lidar) {
  ordered_json j = {{"name", scene.name},
                    {"used", scene.used},
                    {"reason", scene.reason},
                    {"tags", scene.view ? scene.view->tag_count : 0},
                    {"board_points", scene.refinement ? scene.refinement->board_points : 0}};
  if (solution != nullptr) {
    j["T_camera_board"] = rows_of(solution->camera_from_board.matrix());
  } else if (scene.view) {
    j["T_camera_board"] = rows_of(scene.view->camera_from_board.transform.matrix());
  }
  // Both poses of one model, where there is one.
  if (solution != nullptr && solution->used) {
    j["T_lidar_board"] =
        rows_of((camera_from_lidar.inverse() * solution->camera_from_board).matrix());
  } else if (scene.refinement) {
    j["T_lidar_board"] = rows_of(scene.refinement->lidar_from_board.matrix());
  }
  j["rms_px"] = solution != nullptr ? solution->rms_px : 0.0;
  j["rms_mm"] = node_rms_mm(solution);
  const SceneEdits& edits = scene.edits;
  if (!edits.empty()) {
    j["by_hand"] = {{"left_out",
                     {{"points", scene.left_out_points.size()},
                      {"patches", edits.patches_m.size()},
                      {"tags", edits.tags},
                      {"circles", edits.circles}}},
                    {"used_all_the_same",
                     {{"tags", edits.kept_tags},
                      {"circles", edits.kept_circles},
                      {"patches", edits.kept_patches.size()}}}};
  }
  if (scene.refinement) {
    j["refinement"] = refinement_json(*scene.refinement);
    j["nodes"] = nodes_json(*scene.refinement, solution);
  }
  return j;
}

// How the print was found: by how much its place beats the best other one (log-likelihood), and its
// size over the target's.
ordered_json print_json(const ForwardSolution& forward) {
  ordered_json out = {{"used", forward.uses_intensity}, {"margin", forward.lattice_margin}};
  if (forward.print_size.measured) {
    out["scale"] = ordered_json{forward.print_size.scale.x(), forward.print_size.scale.y()};
    out["scale_sigma"] = ordered_json{forward.print_size.sigma.x(), forward.print_size.sigma.y()};
  }
  return out;
}

ordered_json footprint_json(const ForwardSolution& forward) {
  constexpr double kMrad2 = 1e6;
  const Eigen::Matrix2d blur = kMrad2 * forward.state.beam.blur_rad2;
  const Eigen::Matrix2d jitter = kMrad2 * forward.state.beam.jitter_rad2;
  const Eigen::Vector3d sigma =
      kMrad2 * forward.blur_covariance.diagonal().cwiseMax(0.0).cwiseSqrt();
  return {{"covariance_mrad2", {{blur(0, 0), blur(0, 1)}, {blur(1, 0), blur(1, 1)}}},
          {"jitter_mrad2", {{jitter(0, 0), jitter(0, 1)}, {jitter(1, 0), jitter(1, 1)}}},
          {"sigma_mrad2", {sigma(0), sigma(1), sigma(2)}}};
}

// What the solve left out of scenes that take part; the others say why in "scenes".
ordered_json refused_json(const CalibrationResult& result) {
  using What = Refusal::What;
  ordered_json list = ordered_json::array();
  for (const Refusal& refusal : refusals(result)) {
    if (refusal.what == What::kScene || refusal.what == What::kResponse) continue;
    std::string what = "tag";
    std::string where = "corners of " + std::to_string(refusal.id);
    if (refusal.what == What::kPoints) {
      what = "points";
      where = "on the board";
    } else if (refusal.what == What::kPatch) {
      const Eigen::AlignedBox2d& box = refusal.board_m;
      what = "patch";
      where = formatted("board x %.2f to %.2f m, ", box.min().x(), box.max().x()) +
              formatted("y %.2f to %.2f m", box.min().y(), box.max().y());
    } else if (refusal.what == What::kCircle) {
      what = "node";
      where = "circle " + std::to_string(refusal.id);
    }
    list.push_back({{"scene", refusal.scene},
                    {"what", what},
                    {"where", where},
                    {"points", refusal.points},
                    {"reason", refusal.reason}});
  }
  return list;
}

// Where the camera's intrinsics come from and how well they are known.
ordered_json intrinsics_json(const IntrinsicsReport& report) {
  constexpr std::array kModes = {"fixed", "prior", "free"};
  const auto deviations = [&](const IntrinsicsVector& sigma) -> ordered_json {
    ordered_json distortion = ordered_json::array();
    for (Eigen::Index k = 0; k < report.given.distortion_count(); ++k)
      distortion.push_back(sigma(4 + k));
    return {{"fx", sigma(0)},
            {"fy", sigma(1)},
            {"cx", sigma(2)},
            {"cy", sigma(3)},
            {"distortion", std::move(distortion)}};
  };
  ordered_json j = {{"mode", kModes[static_cast<std::size_t>(report.mode)]},
                    {"given", camera_json(report.given)}};
  if (report.mode == IntrinsicsMode::kPrior) j["prior_sigma"] = deviations(report.prior_sigma);
  if (report.mode != IntrinsicsMode::kFixed) j["sigma"] = deviations(report.sigma);
  if (!report.extra_images.empty()) {
    j["extra_images"] = ordered_json::array();
    for (const BoardImage& image : report.extra_images)
      j["extra_images"].push_back({{"name", image.path.filename().string()},
                                   {"used", image.used()},
                                   {"reason", image.reason}});
  }
  if (report.contradiction) {
    const IntrinsicsContradiction& found = *report.contradiction;
    ordered_json c = {{"what", found.what},
                      {"chi_square", found.contrast.chi_square},
                      {"dof", found.contrast.dof},
                      {"gate", found.contrast.gate},
                      {"matters", found.matters}};
    if (found.better_model) c["better_model"] = name_of(*found.better_model);
    if (found.camera_from_lidar) {
      c["T_camera_lidar_freed"] = rows_of(found.camera_from_lidar->transform.matrix());
      c["extrinsic_move_mm"] = found.move_mm;
      c["extrinsic_move_mrad"] = found.move_mrad;
    }
    j["contradiction"] = std::move(c);
  }
  return j;
}

ordered_json to_json(const CalibrationResult& result, const FrameNames& frames) {
  const ExtrinsicSolution& x = result.extrinsic;
  ordered_json j;
  j["version"] = version();
  j["dataset"] = result.dataset;
  j["T_camera_lidar"] = pose_json(x.camera_from_lidar.transform);
  j["frames"] = {{"lidar", frames.lidar}, {"camera", frames.camera}};
  j["covariance"] = rows_of(x.camera_from_lidar.covariance);
  j["covariance_total"] = rows_of(result.covariance_total);
  j["applies_to"] = pose_use(result).corrected ? "corrected" : "raw";
  if (result.forward) {
    j["dof"] = result.forward->dof;
    j["footprint"] = footprint_json(*result.forward);
    j["print"] = print_json(*result.forward);
  }
  j["refused"] = refused_json(result);
  j["quality"] = name_of(result.quality);
  j["verified"] = result.verified;
  j["quality_reasons"] = result.quality_reasons;
  j["warnings"] = result.warnings;
  j["camera"] = camera_json(result.camera);
  j["intrinsics"] = intrinsics_json(result.intrinsics);
  j["target_yaml"] = to_yaml(result.target);
  const BoardOutline outline = result.target.outline();
  j["board"] = {
      {"lower_left_m", {outline.lower_left_m.x(), outline.lower_left_m.y()}},
      {"upper_right_m", {outline.upper_right_m.x(), outline.upper_right_m.y()}},
      {"circle_radius_m", result.target.has_circles() ? result.target.circle_radius_m : 0.0}};
  j["inputs"] = inputs_json(result.inputs);
  j["rms_px"] = x.rms_px;
  j["rms_mm"] = x.uses_nodes() ? ordered_json(x.rms_mm) : ordered_json(nullptr);
  j["sigma_px"] = x.sigma_px;
  j["node_noise_scale"] = x.node_scale;
  j["plane_noise_scale"] = x.plane_scale;
  j["rank"] = x.rank;
  j["weak_directions"] = x.weak_directions;
  j["assignment_margin"] = {{"best", result.consensus.score},
                            {"runner_up", result.consensus.runner_up},
                            {"margin", result.consensus.margin()},
                            {"unit", "nat"}};
  j["scenes"] = ordered_json::array();
  for (const SceneResult& scene : result.scenes)
    j["scenes"].push_back(
        scene_json(scene, solution_of(result, scene.name), x.camera_from_lidar.transform));
  j["methods"] = methods_json(result.methods);
  if (!result.ablation.empty()) j["ablation"] = ablation_json(result.ablation);
  j["leave_one_out"] = ordered_json::array();
  for (const LeaveOneOut& l : x.leave_one_out) {
    j["leave_one_out"].push_back({{"without", l.without},
                                  {"translation_mm", l.translation_mm},
                                  {"rotation_mrad", l.rotation_mrad}});
  }
  j["uncertainty"] = uncertainty_json(result.uncertainty);
  j["boundary_response"] = response_json(result.response);
  j["model"] = model_json(result);
  if (!result.covariance_with_budget.isZero(0.0)) {
    j["sensitivity_budget"] = budget_json(result.budget);
    j["covariance_with_budget"] = rows_of(result.covariance_with_budget);
  }
  const StageTimes& t = result.times;
  j["timing_ms"] = {{"load", t.load_ms},         {"detect", t.detect_ms},
                    {"localize", t.localize_ms}, {"refine", t.refine_ms},
                    {"optimize", t.optimize_ms}, {"response", t.response_ms},
                    {"total", t.total_ms}};
  return j;
}

std::string yaml_number(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.10g", value);
  return text;
}

std::string yaml_list(const std::vector<double>& values) {
  std::string out = "[";
  for (std::size_t k = 0; k < values.size(); ++k)
    out += (k == 0 ? "" : ", ") + yaml_number(values[k]);
  return out + "]";
}

std::string yaml_quoted(const std::string& text) {
  // A JSON string is a legal YAML double-quoted scalar.
  return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

template <class Matrix>
std::string yaml_rows(const Matrix& m) {
  std::string out;
  for (Eigen::Index r = 0; r < m.rows(); ++r) {
    std::vector<double> row;
    for (Eigen::Index c = 0; c < m.cols(); ++c) row.push_back(m(r, c));
    out += "    - " + yaml_list(row) + "\n";
  }
  return out;
}

Result<nlohmann::json> json_object(const std::string& text, const std::filesystem::path& path) {
  auto j = parse_json(text);
  if (j.is_discarded() || !j.is_object())
    return Error::input(Message("not a JSON object"), path.string());
  return j;
}

Result<nlohmann::json> read_json(const std::filesystem::path& path) {
  const auto text = read_text_file(path, kMaxResultBytes);
  if (!text) return text.error();
  return json_object(*text, path);
}

// A pose that is none would give errors that mean nothing. Tolerant of few digits.
Result<Rigid3> rigid(const Eigen::MatrixXd& rows, const std::string& key,
                     const std::filesystem::path& path) {
  const Eigen::Matrix3d rotation = rows.topLeftCorner<3, 3>();
  const double error = (rotation.transpose() * rotation - Eigen::Matrix3d::Identity()).norm();
  if (error > 1e-3 || rotation.determinant() < 0) {
    return Error::input(Message("the left 3×3 part of %1 is not a rotation", key), path.string());
  }
  return Rigid3::from_matrix(rotation, Eigen::Vector3d(rows.col(3).head<3>()));
}

}  // namespace

std::string version() {
  return LVCALIB_VERSION;
}

std::string result_as_json(const CalibrationResult& result, const FrameNames& frames) {
  return to_json(result, frames).dump(1, ' ', false, nlohmann::json::error_handler_t::replace) +
         "\n";
}

std::string result_as_yaml(const CalibrationResult& result, const FrameNames& frames) {
  const ExtrinsicSolution& x = result.extrinsic;
  const Rigid3& pose = x.camera_from_lidar.transform;
  const Eigen::Vector4d q = pose.rotation.coeffs();
  const Vector6d sigma = x.camera_from_lidar.covariance.diagonal().cwiseSqrt();
  std::string out =
      "# Takes a point from the LiDAR frame (m) to the camera frame (x right, y down, z "
      "forward).\n";
  out += "version: " + yaml_quoted(version()) + "\ndataset: " + yaml_quoted(result.dataset) + "\n";
  out += "T_camera_lidar:\n  matrix:\n" + yaml_rows(pose.matrix());
  out += "  translation_m: " +
         yaml_list({pose.translation.x(), pose.translation.y(), pose.translation.z()}) + "\n";
  out += "  quaternion_xyzw: " + yaml_list({q(0), q(1), q(2), q(3)}) + "\n";
  out += "frames: {lidar: " + yaml_quoted(frames.lidar) +
         ", camera: " + yaml_quoted(frames.camera) + "}\n";
  out += "# Standard deviations of the left perturbation in the camera frame.\n";
  out +=
      "sigma_translation_mm: " + yaml_list({1e3 * sigma(0), 1e3 * sigma(1), 1e3 * sigma(2)}) + "\n";
  out +=
      "sigma_rotation_mrad: " + yaml_list({1e3 * sigma(3), 1e3 * sigma(4), 1e3 * sigma(5)}) + "\n";
  out += "covariance:\n" + yaml_rows(x.camera_from_lidar.covariance);
  out +=
      "# The same with what faults left out of the model could still do (see covariance_total).\n";
  const Vector6d total = result.covariance_total.diagonal().cwiseSqrt();
  out +=
      "total_sigma_translation_mm: " + yaml_list({1e3 * total(0), 1e3 * total(1), 1e3 * total(2)}) +
      "\n";
  out +=
      "total_sigma_rotation_mrad: " + yaml_list({1e3 * total(3), 1e3 * total(4), 1e3 * total(5)}) +
      "\n";
  out += "covariance_total:\n" + yaml_rows(result.covariance_total);
  const PoseUse use = pose_use(result);
  out += "# " + use.clouds.text() + "\n" + std::string("applies_to: ") +
         (use.corrected ? "corrected" : "raw") + "\nmodel: " + yaml_quoted(use.model.text()) +
         "\neffects:";
  out += use.effects.empty() ? " []\n" : "\n";
  for (const Message& effect : use.effects) out += "  - " + yaml_quoted(effect.text()) + "\n";
  out += std::string("verified: ") + (result.verified ? "true" : "false") + "\n";
  out += "quality: " + name_of(result.quality) + "\nwarnings:";
  out += result.warnings.empty() ? " []\n" : "\n";
  for (const Message& w : result.warnings) out += "  - " + yaml_quoted(w.text()) + "\n";
  out += "rms_px: " + yaml_number(x.rms_px) +
         "\nrms_mm: " + (x.uses_nodes() ? yaml_number(x.rms_mm) : "null") + "\nscenes:\n";
  for (const SceneResult& scene : result.scenes) {
    out += "  - {name: " + yaml_quoted(scene.name) + ", used: " + (scene.used ? "true" : "false") +
           ", reason: " + yaml_quoted(scene.reason.text());
    const SceneSolution* solution = solution_of(result, scene.name);
    if (solution != nullptr) {
      out += ", rms_px: " + yaml_number(solution->rms_px) +
             ", rms_mm: " + (solution->uses_nodes() ? yaml_number(solution->rms_mm) : "null");
    }
    out += "}\n";
  }
  return out;
}

Status write_results(const CalibrationResult& result, const std::filesystem::path& folder,
                     const FrameNames& frames) {
  if (Status s = create_folder(folder); !s) return s;
  return write_files_together(folder, {{"result.yaml", result_as_yaml(result, frames)},
                                       {"result.json", result_as_json(result, frames)}});
}

Result<StoredExtrinsic> read_result(const std::filesystem::path& path) {
  const auto text = read_text_file(path, kMaxResultBytes);
  if (!text) return text.error();
  return result_from_json(*text, path);
}

Result<StoredExtrinsic> result_from_json(const std::string& text,
                                         const std::filesystem::path& path) {
  const auto j = json_object(text, path);
  if (!j) return j.error();
  const auto pose = j->find("T_camera_lidar");
  Eigen::MatrixXd m;
  if (pose == j->end() || !pose->is_object() || !pose->contains("matrix") ||
      !read_rows((*pose)["matrix"], 4, 4, m)) {
    return Error::input(Message("T_camera_lidar.matrix is missing or not 4 rows of 4 numbers"),
                        path.string());
  }
  auto transform = rigid(m, "T_camera_lidar.matrix", path);
  if (!transform) return transform.error();
  // The same rotation as a quaternion comes back as it was, to the last digit.
  if (const auto q = pose->find("quaternion_xyzw"); q != pose->end() && q->is_array() &&
                                                    q->size() == 4 &&
                                                    std::all_of(q->begin(), q->end(), is_number)) {
    Rigid3 same = *transform;
    for (Eigen::Index k = 0; k < 4; ++k)
      same.rotation.coeffs()(k) = (*q)[static_cast<std::size_t>(k)].get<double>();
    constexpr double kRounding = 1e-12;  // Of a matrix from a quaternion of doubles, and some.
    if ((same.matrix() - m).cwiseAbs().maxCoeff() < kRounding) *transform = same;
  }
  StoredExtrinsic out;
  out.camera_from_lidar = *transform;
  if (j->contains("covariance") && read_rows((*j)["covariance"], 6, 6, m)) out.covariance = m;
  return out;
}

Result<std::vector<StoredStep>> read_ablation(const std::filesystem::path& path) {
  auto j = read_json(path);
  if (!j) return j.error();
  std::vector<StoredStep> steps;
  const auto list = j->find("ablation");
  if (list == j->end()) return steps;
  const auto bad = [&](std::size_t k) {
    return Error::input(
        Message(
            "ablation[%1] must hold name, rms_px, rms_mm and T_camera_lidar (4 rows of 4 numbers)",
            k),
        path.string());
  };
  if (!list->is_array()) return Error::input(Message("ablation is not a list"), path.string());
  for (std::size_t k = 0; k < list->size(); ++k) {
    const auto& entry = (*list)[k];
    Eigen::MatrixXd m;
    for (const char* key : {"name", "rms_px", "rms_mm", "T_camera_lidar"}) {
      if (!entry.is_object() || !entry.contains(key)) return bad(k);
    }
    if (!entry["name"].is_string() || !entry["rms_px"].is_number() ||
        !entry["rms_mm"].is_number() || !read_rows(entry["T_camera_lidar"], 4, 4, m))
      return bad(k);
    const auto transform = rigid(m, "ablation[" + std::to_string(k) + "].T_camera_lidar", path);
    if (!transform) return transform.error();
    steps.push_back({entry["name"].get<std::string>(), entry["rms_px"].get<double>(),
                     entry["rms_mm"].get<double>(), *transform});
  }
  return steps;
}

Result<Rigid3> read_truth(const std::filesystem::path& path) {
  auto j = read_json(path);
  if (!j) return j.error();
  Eigen::MatrixXd m;
  if (!j->contains("T_CL") || !read_rows((*j)["T_CL"], 3, 4, m)) {
    return Error::input(Message("T_CL is missing or not 3 rows of 4 numbers"), path.string());
  }
  return rigid(m, "T_CL", path);
}

ExtrinsicError compare_extrinsics(const StoredExtrinsic& estimate, const Rigid3& truth) {
  ExtrinsicError error;
  error.translation_mm = 1e3 * translation_distance_m(estimate.camera_from_lidar, truth);
  error.rotation_mrad = 1e3 * rotation_distance_rad(estimate.camera_from_lidar, truth);
  error.left_perturbation = se3_log(truth * estimate.camera_from_lidar.inverse());
  for (int k = 0; k < 6; ++k) {
    const double variance = estimate.covariance(k, k);
    error.normalized(k) =
        variance > 0 ? error.left_perturbation(k) / std::sqrt(variance) : std::nan("");
  }
  return error;
}

}  // namespace lvcalib
