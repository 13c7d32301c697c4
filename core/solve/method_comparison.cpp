// SPDX-License-Identifier: BSD-3-Clause
#include "solve/method_comparison.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "base/parallel.h"
#include "base/statistics.h"
#include "solve/baselines.h"

namespace lvcalib {
namespace {

enum class Objective { kSvd, kWeightedSvd, kPnp, kJoint };

struct Method {
  const char* name;
  Objective objective;
  bool refined;
};

constexpr Method kMethods[] = {
    {"svd_raw", Objective::kSvd, false},          {"svd_refined", Objective::kSvd, true},
    {"wsvd_raw", Objective::kWeightedSvd, false}, {"wsvd_refined", Objective::kWeightedSvd, true},
    {"pnp_raw", Objective::kPnp, false},          {"pnp_refined", Objective::kPnp, true},
    {"joint_raw", Objective::kJoint, false},      {"joint_refined", Objective::kJoint, true}};

// The observations that the joint solve took.
MethodInput input_of(const FeatureInput& in, const ExtrinsicSolution& joint) {
  MethodInput input{in, mask_of(joint), scales_of(joint), {}};
  for (const SceneObservations& scene : in.scenes)
    input.camera_from_board.push_back(scene.camera_from_board);
  return input;
}

// Everything that the scenes of the joint solve have, bad tags and nodes too.
ObservationMask whole_mask(const std::vector<SceneObservations>& scenes,
                           const std::vector<bool>& in_use) {
  ObservationMask mask;
  mask.scene = in_use;
  for (const SceneObservations& scene : scenes) {
    mask.corner.emplace_back(scene.corners.size(), true);
    std::vector<bool> valid;
    for (const RefinedNode& node : scene.nodes) valid.push_back(node.valid);
    mask.node.push_back(std::move(valid));
  }
  return mask;
}

bool has_three_nodes(const ObservationMask& mask) {
  std::ptrdiff_t nodes = 0;
  for (std::size_t s = 0; s < mask.scene.size(); ++s) {
    if (mask.scene[s]) nodes += std::count(mask.node[s].begin(), mask.node[s].end(), true);
  }
  return nodes >= 3;
}

// What all methods are measured by: the refined observations, and their joint solve.
struct Yardstick {
  MethodInput refined;
  const ExtrinsicSolution& joint;
};

// Board poses that fit best beside an extrinsic.
std::vector<Rigid3> boards_beside(const Yardstick& by, const Rigid3& camera_from_lidar,
                                  const ObservationMask& mask) {
  JointState start{camera_from_lidar, {}};
  for (const SceneSolution& scene : by.joint.scenes)
    start.camera_from_board.push_back(scene.camera_from_board);
  return solve_boards(by.refined, start, by.refined.scales, mask);
}

std::vector<double> corner_errors(const MethodInput& input, std::size_t s, const Rigid3& board) {
  std::vector<double> errors;
  const SceneObservations& scene = input.scenes[s];
  for (std::size_t k = 0; k < scene.corners.size(); ++k) {
    if (!input.mask.corner[s][k]) continue;
    const CornerObservation& c = scene.corners[k];
    const auto p = input.camera.project(board * Eigen::Vector3d(c.board_m.x(), c.board_m.y(), 0.0));
    if (p) errors.push_back((c.pixel - *p).norm());
  }
  return errors;
}

MethodScene measure(const MethodInput& input, std::size_t s, const Rigid3& camera_from_lidar,
                    const Rigid3& camera_from_board) {
  const SceneObservations& scene = input.scenes[s];
  MethodScene out;
  out.name = scene.name;
  out.errors_px = corner_errors(input, s, camera_from_board);
  const Rigid3 board_from_lidar = camera_from_board.inverse() * camera_from_lidar;
  for (std::size_t k = 0; k < scene.nodes.size(); ++k) {
    if (!input.mask.node[s][k]) continue;
    const RefinedNode& node = scene.nodes[k];
    const Eigen::Vector3d model(node.board_m.x(), node.board_m.y(), 0.0);
    out.errors_mm.push_back(1e3 * (board_from_lidar * node.center_lidar_m - model).norm());
  }
  if (scene.nodes.empty()) {
    const Eigen::Matrix3d probes = plane_probe_points(input.target);
    const Rigid3 lidar_from_board = board_from_lidar.inverse();
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3d p = lidar_from_board * Eigen::Vector3d(probes.col(k));
      out.errors_mm.push_back(1e3 * std::abs(scene.plane.normal.dot(p - scene.plane.center_m)));
    }
  }
  out.rms_px = rms(out.errors_px);
  out.rms_mm = rms(out.errors_mm);
  return out;
}

// What an extrinsic leaves of the observations, and how far it is from that of the joint solve.
MethodResult measured(const Yardstick& by, const std::string& name,
                      const Rigid3& camera_from_lidar) {
  MethodResult result;
  result.name = name;
  result.camera_from_lidar = camera_from_lidar;
  const Rigid3& by_joint = by.joint.camera_from_lidar.transform;
  result.translation_mm = 1e3 * translation_distance_m(camera_from_lidar, by_joint);
  result.rotation_mrad = 1e3 * rotation_distance_rad(camera_from_lidar, by_joint);
  const std::vector<Rigid3> boards = boards_beside(by, camera_from_lidar, by.refined.mask);
  std::vector<double> px;
  std::vector<double> mm;
  std::vector<double> transfer;
  for (std::size_t s = 0; s < by.refined.scenes.size(); ++s) {
    if (!by.refined.mask.scene[s]) continue;
    MethodScene scene = measure(by.refined, s, camera_from_lidar, boards[s]);
    px.insert(px.end(), scene.errors_px.begin(), scene.errors_px.end());
    mm.insert(mm.end(), scene.errors_mm.begin(), scene.errors_mm.end());
    const auto by_lidar =
        corner_errors(by.refined, s, camera_from_lidar * by.refined.scenes[s].lidar_from_board);
    transfer.insert(transfer.end(), by_lidar.begin(), by_lidar.end());
    result.scenes.push_back(std::move(scene));
  }
  result.rms_px = rms(px);
  result.rms_mm = rms(mm);
  result.transfer_px = rms(transfer);
  return result;
}

// `without` solves without one scene; a scene without which nothing is solved is not counted.
void hold_out(const Yardstick& by, MethodResult& result,
              const std::function<std::optional<Rigid3>(std::size_t)>& without) {
  std::vector<double> px;
  std::vector<double> mm;
  std::size_t at = 0;
  for (std::size_t s = 0; s < by.refined.scenes.size(); ++s) {
    if (!by.refined.mask.scene[s]) continue;
    const std::size_t place = at++;
    const auto extrinsic = without(s);
    if (!extrinsic) continue;
    ObservationMask only = by.refined.mask;
    std::fill(only.scene.begin(), only.scene.end(), false);
    only.scene[s] = true;
    const auto boards = boards_beside(by, *extrinsic, only);
    const MethodScene scene = measure(by.refined, s, *extrinsic, boards[s]);
    result.scenes[place].heldout_px = scene.rms_px;
    result.scenes[place].heldout_mm = scene.rms_mm;
    px.insert(px.end(), scene.errors_px.begin(), scene.errors_px.end());
    mm.insert(mm.end(), scene.errors_mm.begin(), scene.errors_mm.end());
  }
  result.heldout_px = rms(px);
  result.heldout_mm = rms(mm);
}

Rigid3 solve(Objective objective, const MethodInput& input, const Rigid3& start) {
  switch (objective) {
    case Objective::kSvd:
      return solve_by_alignment(input, false);
    case Objective::kWeightedSvd:
      return solve_by_alignment(input, true);
    case Objective::kPnp:
      return solve_by_reprojection(input);
    case Objective::kJoint:
      break;
  }
  return solve_by_joint(input, start);
}

MethodResult evaluate(const Yardstick& by, const Method& method, const MethodInput& input,
                      bool held_out) {
  const bool is_joint = method.objective == Objective::kJoint && method.refined;
  const Rigid3& start = by.joint.camera_from_lidar.transform;
  MethodResult result =
      measured(by, method.name, is_joint ? start : solve(method.objective, input, start));
  if (!held_out) return result;
  hold_out(by, result, [&](std::size_t s) -> std::optional<Rigid3> {
    MethodInput without = input;
    without.mask.scene[s] = false;
    return solve(method.objective, without, start);
  });
  return result;
}

MethodResult evaluate(const Yardstick& by, const OtherMethod& other, bool held_out) {
  MethodResult result = measured(by, other.name, other.camera_from_lidar);
  if (!held_out || !other.subset) return result;
  hold_out(by, result, [&](std::size_t s) -> std::optional<Rigid3> {
    std::vector<std::size_t> rest;
    for (std::size_t i = 0; i < by.refined.scenes.size(); ++i) {
      if (i != s && by.refined.mask.scene[i]) rest.push_back(i);
    }
    const auto solved = other.subset(rest);
    return solved ? std::optional(solved->transform) : std::nullopt;
  });
  return result;
}

std::optional<MethodResult> evaluate(const Yardstick& by, const JointVariant& variant,
                                     bool held_out) {
  NoiseScales scales;
  scales.sigma_px = by.refined.scales.sigma_px;
  const MethodInput input{{variant.scenes, by.refined.camera, by.refined.target, variant.options},
                          whole_mask(variant.scenes, by.refined.mask.scene),
                          scales,
                          by.refined.camera_from_board};
  if (!has_three_nodes(input.mask)) return std::nullopt;
  const Rigid3& start = by.joint.camera_from_lidar.transform;
  MethodResult result = measured(by, variant.name, solve_as_stated(input, start));
  if (!held_out) return result;
  hold_out(by, result, [&](std::size_t s) -> std::optional<Rigid3> {
    MethodInput without = input;
    without.mask.scene[s] = false;
    if (!has_three_nodes(without.mask)) return std::nullopt;
    return solve_as_stated(without, start);
  });
  return result;
}

}  // namespace

ExtrinsicOptions paper_objective(ExtrinsicOptions options) {
  options.node_term = NodeTerm::kIsotropic;
  options.robust_threshold = std::numeric_limits<double>::infinity();
  return options;
}

std::vector<MethodResult> compare_methods(const FeatureInput& in, const ExtrinsicSolution& joint,
                                          const MethodOptions& options) {
  const std::vector<SceneObservations> raw_scenes = with_raw_nodes(in.scenes);
  const MethodInput raw = input_of({raw_scenes, in.camera, in.target, in.options}, joint);
  const Yardstick by{input_of(in, joint), joint};
  const auto held_out = [&](int fewest) { return options.held_out && joint.used_scenes >= fewest; };
  // Each solves as many times as there are scenes, and none asks for another.
  std::vector<std::function<std::optional<MethodResult>()>> tasks;
  for (const Method& method : kMethods) {
    const bool is_joint = method.objective == Objective::kJoint && method.refined;
    if (!in.target.has_circles() && !is_joint) continue;
    // Without circles a scene less may leave too few to solve.
    const int fewest = in.target.has_circles() ? 2 : 4;
    const MethodInput& input = method.refined ? by.refined : raw;
    tasks.emplace_back([&, fewest] { return evaluate(by, method, input, held_out(fewest)); });
  }
  if (options.paper && in.target.has_circles())
    tasks.emplace_back([&] { return evaluate(by, *options.paper, held_out(2)); });
  if (options.other) tasks.emplace_back([&] { return evaluate(by, *options.other, held_out(2)); });
  std::vector<std::optional<MethodResult>> done(tasks.size());
  // The last ones take longest.
  parallel_for(tasks.size(), options.threads, [&](std::size_t k) {
    const std::size_t at = tasks.size() - 1 - k;
    done[at] = tasks[at]();
  });
  std::vector<MethodResult> results;
  for (std::optional<MethodResult>& result : done) {
    if (result) results.push_back(std::move(*result));
  }
  return results;
}

std::vector<MethodResult> compare_variants(const FeatureInput& in, const ExtrinsicSolution& joint,
                                           const std::vector<JointVariant>& variants) {
  const Yardstick by{input_of(in, joint), joint};
  std::vector<MethodResult> results;
  for (const JointVariant& variant : variants) {
    auto result = evaluate(by, variant, joint.used_scenes >= 2);
    if (result) results.push_back(std::move(*result));
  }
  return results;
}

}  // namespace lvcalib
