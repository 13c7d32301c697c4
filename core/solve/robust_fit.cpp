// SPDX-License-Identifier: BSD-3-Clause
#include "solve/robust_fit.h"

#include <algorithm>
#include <cmath>

#include "base/statistics.h"
#include "solve/corner_fit.h"
#include "solve/scene_residuals.h"

namespace lvcalib {
namespace {

ObservationMask full_mask(const std::vector<SceneObservations>& scenes) {
  ObservationMask mask;
  for (const SceneObservations& scene : scenes) {
    mask.scene.push_back(scene.use);
    mask.corner.emplace_back(scene.corners.size(), true);
    std::vector<bool> nodes;
    for (const RefinedNode& node : scene.nodes) nodes.push_back(node.valid);
    mask.node.push_back(std::move(nodes));
  }
  return mask;
}

double widened(const GroupFit& group, double scale, double false_alarm) {
  if (group.redundancy < 1.0) return scale;
  const double chi_square = group.chi_square * scale * scale;  // in units of the stated σ
  const int freedom = std::max(1, static_cast<int>(std::lround(group.redundancy)));
  if (chi_square < chi_square_gate(freedom, false_alarm)) return 1.0;
  return std::max(1.0, std::sqrt(chi_square / group.redundancy));
}

// Variance components: each group's χ² over its redundancy. Nodes and planes come with their own
// σ, which is widened only when the data clearly say so.
void update_scales(const JointFit& fit, double false_alarm, NoiseScales& scales) {
  scales.node =
      widened(fit.groups[static_cast<std::size_t>(ResidualGroup::kNode)], scales.node, false_alarm);
  scales.plane = widened(fit.groups[static_cast<std::size_t>(ResidualGroup::kPlane)], scales.plane,
                         false_alarm);
}

// Solves and re-estimates the noise scales until they stand still.
JointFit settle(const FeatureInput& in, const JointState& start, const ObservationMask& mask,
                NoiseScales& scales) {
  constexpr int kRounds = 5;
  JointFit fit = solve_joint(in, start, scales, mask);
  for (int round = 0; round < kRounds; ++round) {
    const NoiseScales old = scales;
    update_scales(fit, in.options.false_alarm, scales);
    const double change = std::max(std::abs(std::log(scales.node / old.node)),
                                   std::abs(std::log(scales.plane / old.plane)));
    if (change < 0.01) break;
    fit = solve_joint(in, fit.state, scales, mask);
  }
  return fit;
}

bool reject_tags(const FeatureInput& in, std::size_t s, const JointState& state,
                 const NoiseScales& scales, ObservationMask& mask) {
  bool any = false;
  const auto corners =
      corner_residuals(in.scenes[s], in.camera, state.camera_from_board[s], mask.corner[s]);
  for (const CornerResidual& corner : corners) {
    if (!(corner.residual_px.norm() > in.options.rejection_gate * scales.sigma_px)) continue;
    // The whole tag goes: its other corners share the cause.
    for (std::size_t j = 0; j < corners.size(); ++j) {
      if (corners[j].feature_id != corner.feature_id || !mask.corner[s][j]) continue;
      mask.corner[s][j] = false;
      any = true;
    }
  }
  return any;
}

bool reject_nodes(const FeatureInput& in, std::size_t s, const JointState& state,
                  const NoiseScales& scales, ObservationMask& mask) {
  bool any = false;
  const SceneObservations& scene = in.scenes[s];
  const auto nodes =
      node_residuals(scene, state.camera_from_lidar, state.camera_from_board[s], mask.node[s]);
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    if (!mask.node[s][k]) continue;
    const Eigen::Matrix2d whitening =
        whitening_2(scales.node * scales.node *
                    (scene.nodes[k].covariance_m2 +
                     std::pow(in.options.node_sigma_floor_m, 2) * Eigen::Matrix2d::Identity()));
    const Eigen::Vector3d in_lidar = scene.lidar_from_board.rotation * nodes[k].residual_m;
    const Eigen::Vector2d in_plane(scene.plane.axis_u.dot(in_lidar),
                                   scene.plane.axis_v.dot(in_lidar));
    if ((whitening * in_plane).norm() > in.options.rejection_gate) {
      mask.node[s][k] = false;
      any = true;
    }
  }
  return any;
}

// Leaves out tags whose corners and nodes whose centres are far off. True if any was.
bool reject_outliers(const FeatureInput& in, const JointState& state, ObservationMask& mask,
                     NoiseScales& scales) {
  bool tags = false;
  bool nodes = false;
  for (std::size_t s = 0; s < in.scenes.size(); ++s) {
    if (!mask.scene[s]) continue;
    tags = reject_tags(in, s, state, scales, mask) || tags;
    nodes = reject_nodes(in, s, state, scales, mask) || nodes;
  }
  if (tags) scales.sigma_px = fit_corners(in, mask).sigma_px;
  return tags || nodes;
}

bool most_nodes_kept(const ObservationMask& before, const ObservationMask& after) {
  for (std::size_t s = 0; s < after.node.size(); ++s) {
    const auto had = std::count(before.node[s].begin(), before.node[s].end(), true);
    const auto has = std::count(after.node[s].begin(), after.node[s].end(), true);
    if (4 * has < 3 * had) return false;
  }
  return true;
}

// A few bad nodes explain a misfit more cheaply than a bad scene does: if the rest fits its
// stated σ without them, and every scene keeps three quarters of its nodes, they are left out.
void explain_by_single_outliers(const FeatureInput& in, RobustFit& robust) {
  if (robust.scales.node <= 1.0 && robust.scales.plane <= 1.0) return;
  ObservationMask mask = robust.mask;
  NoiseScales scales = robust.scales;
  scales.node = scales.plane = 1.0;
  if (!reject_outliers(in, robust.fit.state, mask, scales)) return;
  JointFit cleaned = settle(in, robust.fit.state, mask, scales);
  if (scales.node > 1.0 || scales.plane > 1.0 || !most_nodes_kept(robust.mask, mask)) return;
  robust.fit = std::move(cleaned);
  robust.scales = scales;
  robust.mask = std::move(mask);
}

// LiDAR misfit of a solution in units of the stated σ.
double lidar_misfit(const JointFit& fit, const NoiseScales& scales) {
  const auto& node = fit.groups[static_cast<std::size_t>(ResidualGroup::kNode)];
  const auto& plane = fit.groups[static_cast<std::size_t>(ResidualGroup::kPlane)];
  const double chi_square =
      node.chi_square * scales.node * scales.node + plane.chi_square * scales.plane * scales.plane;
  return chi_square / std::max(1.0, node.redundancy + plane.redundancy);
}

// A scene contradicts the others if leaving it out (and no other) makes the rest fit far better
// (options.scene_rejection_gain). Repeated, while three scenes remain.
void reject_bad_scenes(const FeatureInput& in, RobustFit& robust) {
  auto& [fit, scales, mask, reasons] = robust;
  while (count_used(mask) >= fewest_to_leave_one_out(in.target) &&
         (scales.node > 1.0 || scales.plane > 1.0)) {
    const double all = lidar_misfit(fit, scales);
    double best = all;
    double second = all;
    std::size_t worst = in.scenes.size();
    JointFit best_fit;
    NoiseScales best_scales;
    for (std::size_t s = 0; s < in.scenes.size(); ++s) {
      if (!mask.scene[s]) continue;
      ObservationMask without = mask;
      without.scene[s] = false;
      NoiseScales trial = scales;
      const JointFit candidate = settle(in, fit.state, without, trial);
      const double misfit = lidar_misfit(candidate, trial);
      if (misfit < best) {
        second = best;
        best = misfit;
        worst = s;
        best_fit = candidate;
        best_scales = trial;
      } else {
        second = std::min(second, misfit);
      }
    }
    // With the same cure from two scenes one cannot tell which is bad.
    if (worst == in.scenes.size() || best * in.options.scene_rejection_gain > all ||
        best * in.options.scene_rejection_gain > second)
      return;
    const Rigid3 own =
        in.scenes[worst].camera_from_board * in.scenes[worst].lidar_from_board.inverse();
    const Rigid3& rest = best_fit.state.camera_from_lidar;
    reasons[worst] = Message(
        "contradicts the other scenes by %1 mm and %2 mrad: did the board or the rig move "
        "between cloud and image?",
        std::lround(1e3 * translation_distance_m(own.inverse(), rest.inverse())),
        std::lround(1e3 * rotation_distance_rad(own, rest)));
    mask.scene[worst] = false;
    fit = best_fit;
    scales = best_scales;
  }
}

}  // namespace

int count_used(const ObservationMask& mask) {
  return static_cast<int>(std::count(mask.scene.begin(), mask.scene.end(), true));
}

int fewest_to_leave_one_out(const Target& target) {
  return target.has_circles() ? 3 : 4;
}

Result<RobustFit> fit_robustly(const FeatureInput& in) {
  RobustFit out;
  out.mask = full_mask(in.scenes);
  out.reasons.resize(in.scenes.size());
  for (std::size_t s = 0; s < in.scenes.size(); ++s) {
    if (!in.scenes[s].use) out.reasons[s] = Message("not used");
  }
  CornerFit corners = fit_corners(in, out.mask);
  out.scales.sigma_px = corners.sigma_px;
  const JointState start{closed_form_extrinsic(in.scenes, in.target),
                         std::move(corners.camera_from_board)};
  out.fit = settle(in, start, out.mask, out.scales);
  explain_by_single_outliers(in, out);
  if (in.options.reject_bad_scenes) reject_bad_scenes(in, out);
  if (reject_outliers(in, out.fit.state, out.mask, out.scales))
    out.fit = settle(in, out.fit.state, out.mask, out.scales);
  if (!out.fit.state.camera_from_lidar.translation.allFinite() || out.fit.information.isZero(0.0))
    return Error::untrusted(Message("the joint solve fails on these observations"));
  return out;
}

}  // namespace lvcalib
