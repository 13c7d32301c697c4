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

class RobustFitter {
 public:
  RobustFitter(const std::vector<SceneObservations>& scenes, const Camera& camera,
               const Target& target, const ExtrinsicOptions& options)
      : scenes_(scenes),
        camera_(camera),
        target_(target),
        options_(options),
        mask_(full_mask(scenes)),
        reasons_(scenes.size()) {}

  Result<RobustFit> run() {
    for (std::size_t s = 0; s < scenes_.size(); ++s) {
      if (!scenes_[s].use) reasons_[s] = Message("not used");
    }
    CornerFit corners = fit_corners(scenes_, camera_, mask_, options_);
    JointState start;
    start.camera_from_lidar = closed_form_extrinsic(scenes_, target_);
    start.camera_from_board = std::move(corners.camera_from_board);
    NoiseScales scales;
    scales.sigma_px = corners.sigma_px;
    JointFit fit = settle(start, scales, mask_);
    explain_by_single_outliers(fit, scales);
    if (options_.reject_bad_scenes) reject_bad_scenes(fit, scales);
    if (reject_outliers(fit, scales)) fit = settle(fit.state, scales, mask_);
    if (!fit.state.camera_from_lidar.translation.allFinite() || fit.information.isZero(0.0))
      return Error::untrusted(Message("the joint solve fails on these observations"));
    return RobustFit{std::move(fit), scales, std::move(mask_), std::move(reasons_)};
  }

 private:
  // Solves and re-estimates the noise scales until they stand still.
  JointFit settle(const JointState& start, NoiseScales& scales, const ObservationMask& mask) const {
    constexpr int kRounds = 5;
    JointFit fit = solve_joint(scenes_, camera_, target_, start, scales, mask, options_);
    for (int round = 0; round < kRounds; ++round) {
      const NoiseScales old = scales;
      update_scales(fit, scales);
      const double change = std::max(std::abs(std::log(scales.node / old.node)),
                                     std::abs(std::log(scales.plane / old.plane)));
      if (change < 0.01) break;
      fit = solve_joint(scenes_, camera_, target_, fit.state, scales, mask, options_);
    }
    return fit;
  }

  // Variance components: each group's χ² over its redundancy. Nodes and planes come with their own
  // σ, which is widened only when the data clearly say so.
  void update_scales(const JointFit& fit, NoiseScales& scales) const {
    scales.node = widened(fit.groups[static_cast<std::size_t>(ResidualGroup::kNode)], scales.node);
    scales.plane =
        widened(fit.groups[static_cast<std::size_t>(ResidualGroup::kPlane)], scales.plane);
  }

  double widened(const GroupFit& group, double scale) const {
    if (group.redundancy < 1.0) return scale;
    const double chi_square = group.chi_square * scale * scale;  // in units of the stated σ
    const int freedom = std::max(1, static_cast<int>(std::lround(group.redundancy)));
    if (chi_square < chi_square_gate(freedom, options_.false_alarm)) return 1.0;
    return std::max(1.0, std::sqrt(chi_square / group.redundancy));
  }

  // A few bad nodes explain a misfit more cheaply than a bad scene does: if the rest fits its
  // stated σ without them, and every scene keeps three quarters of its nodes, they are left out.
  void explain_by_single_outliers(JointFit& fit, NoiseScales& scales) {
    if (scales.node <= 1.0 && scales.plane <= 1.0) return;
    const ObservationMask before = mask_;
    NoiseScales trial = scales;
    trial.node = trial.plane = 1.0;
    if (reject_outliers(fit, trial)) {
      const JointFit cleaned = settle(fit.state, trial, mask_);
      if (trial.node <= 1.0 && trial.plane <= 1.0 && most_nodes_kept(before)) {
        fit = cleaned;
        scales = trial;
        return;
      }
    }
    mask_ = before;
  }

  [[nodiscard]] bool most_nodes_kept(const ObservationMask& before) const {
    for (std::size_t s = 0; s < mask_.node.size(); ++s) {
      const auto had = std::count(before.node[s].begin(), before.node[s].end(), true);
      const auto has = std::count(mask_.node[s].begin(), mask_.node[s].end(), true);
      if (4 * has < 3 * had) return false;
    }
    return true;
  }

  // LiDAR misfit of a solution in units of the stated σ.
  static double lidar_misfit(const JointFit& fit, const NoiseScales& scales) {
    const auto& node = fit.groups[static_cast<std::size_t>(ResidualGroup::kNode)];
    const auto& plane = fit.groups[static_cast<std::size_t>(ResidualGroup::kPlane)];
    const double chi_square = node.chi_square * scales.node * scales.node +
                              plane.chi_square * scales.plane * scales.plane;
    return chi_square / std::max(1.0, node.redundancy + plane.redundancy);
  }

  // A scene contradicts the others if leaving it out (and no other) makes the rest fit far better
  // (options.scene_rejection_gain). Repeated, while three scenes remain.
  void reject_bad_scenes(JointFit& fit, NoiseScales& scales) {
    while (count_used(mask_) >= fewest_to_leave_one_out(target_) &&
           (scales.node > 1.0 || scales.plane > 1.0)) {
      const double all = lidar_misfit(fit, scales);
      double best = all;
      double second = all;
      std::size_t worst = scenes_.size();
      JointFit best_fit;
      NoiseScales best_scales;
      for (std::size_t s = 0; s < scenes_.size(); ++s) {
        if (!mask_.scene[s]) continue;
        ObservationMask without = mask_;
        without.scene[s] = false;
        NoiseScales trial = scales;
        const JointFit candidate = settle(fit.state, trial, without);
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
      if (worst == scenes_.size() || best * options_.scene_rejection_gain > all ||
          best * options_.scene_rejection_gain > second)
        return;
      const Rigid3 own =
          scenes_[worst].camera_from_board * scenes_[worst].lidar_from_board.inverse();
      const Rigid3& rest = best_fit.state.camera_from_lidar;
      reasons_[worst] = Message(
          "contradicts the other scenes by %1 mm and %2 mrad: did the board or the rig move "
          "between cloud and image?",
          std::lround(1e3 * translation_distance_m(own.inverse(), rest.inverse())),
          std::lround(1e3 * rotation_distance_rad(own, rest)));
      mask_.scene[worst] = false;
      fit = best_fit;
      scales = best_scales;
    }
  }

  // Leaves out tags whose corners and nodes whose centres are far off. True if any was.
  bool reject_outliers(const JointFit& fit, NoiseScales& scales) {
    bool tags = false;
    bool nodes = false;
    for (std::size_t s = 0; s < scenes_.size(); ++s) {
      if (!mask_.scene[s]) continue;
      tags = reject_tags(s, fit.state, scales) || tags;
      nodes = reject_nodes(s, fit.state, scales) || nodes;
    }
    if (tags) scales.sigma_px = fit_corners(scenes_, camera_, mask_, options_).sigma_px;
    return tags || nodes;
  }

  bool reject_tags(std::size_t s, const JointState& state, const NoiseScales& scales) {
    bool any = false;
    const auto corners =
        corner_residuals(scenes_[s], camera_, state.camera_from_board[s], mask_.corner[s]);
    for (const CornerResidual& corner : corners) {
      if (!(corner.residual_px.norm() > options_.rejection_gate * scales.sigma_px)) continue;
      // The whole tag goes: its other corners share the cause.
      for (std::size_t j = 0; j < corners.size(); ++j) {
        if (corners[j].feature_id != corner.feature_id || !mask_.corner[s][j]) continue;
        mask_.corner[s][j] = false;
        any = true;
      }
    }
    return any;
  }

  bool reject_nodes(std::size_t s, const JointState& state, const NoiseScales& scales) {
    bool any = false;
    const SceneObservations& scene = scenes_[s];
    const auto nodes =
        node_residuals(scene, state.camera_from_lidar, state.camera_from_board[s], mask_.node[s]);
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      if (!mask_.node[s][k]) continue;
      const Eigen::Matrix2d whitening =
          whitening_2(scales.node * scales.node *
                      (scene.nodes[k].covariance_m2 +
                       std::pow(options_.node_sigma_floor_m, 2) * Eigen::Matrix2d::Identity()));
      const Eigen::Vector3d in_lidar = scene.lidar_from_board.rotation * nodes[k].residual_m;
      const Eigen::Vector2d in_plane(scene.plane.axis_u.dot(in_lidar),
                                     scene.plane.axis_v.dot(in_lidar));
      if ((whitening * in_plane).norm() > options_.rejection_gate) {
        mask_.node[s][k] = false;
        any = true;
      }
    }
    return any;
  }

  const std::vector<SceneObservations>& scenes_;
  const Camera& camera_;
  const Target& target_;
  const ExtrinsicOptions& options_;
  ObservationMask mask_;
  std::vector<Message> reasons_;
};

}  // namespace

int count_used(const ObservationMask& mask) {
  return static_cast<int>(std::count(mask.scene.begin(), mask.scene.end(), true));
}

int fewest_to_leave_one_out(const Target& target) {
  return target.has_circles() ? 3 : 4;
}

Result<RobustFit> fit_robustly(const std::vector<SceneObservations>& scenes, const Camera& camera,
                               const Target& target, const ExtrinsicOptions& options) {
  return RobustFitter(scenes, camera, target, options).run();
}

}  // namespace lvcalib
