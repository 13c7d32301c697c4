// SPDX-License-Identifier: BSD-3-Clause
#include "extrinsic/extrinsic_solver.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/SVD>

#include "base/statistics.h"
#include "extrinsic/joint_problem.h"

namespace lvcalib {
namespace {

// Chance of widening (or leaving out) something although only noise is at work.
constexpr double kTail = 0.01;

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

int count_used(const ObservationMask& mask) {
  return static_cast<int>(std::count(mask.scene.begin(), mask.scene.end(), true));
}

class Solver {
 public:
  Solver(const std::vector<SceneObservations>& scenes, const Camera& camera, const Target& target,
         const ExtrinsicOptions& options)
      : scenes_(scenes),
        camera_(camera),
        target_(target),
        options_(options),
        mask_(full_mask(scenes)) {}

  Result<ExtrinsicSolution> run() {
    reasons_.resize(scenes_.size());
    for (std::size_t s = 0; s < scenes_.size(); ++s) {
      if (!scenes_[s].use) reasons_[s] = "not used";
    }
    if (Status status = enough_scenes(); !status) return status.error();
    if (Status status = corners_in_view(); !status) return status.error();
    JointState start;
    start.camera_from_lidar = closed_form_extrinsic(scenes_, target_);
    for (const SceneObservations& scene : scenes_)
      start.camera_from_board.push_back(scene.camera_from_board);
    NoiseScales scales;
    scales.sigma_px = initial_sigma_px();
    JointFit fit = settle(start, scales, mask_);
    explain_by_single_outliers(fit, scales);
    if (options_.reject_bad_scenes) reject_bad_scenes(fit, scales);
    if (reject_outliers(fit, scales)) fit = settle(fit.state, scales, mask_);
    if (!fit.state.camera_from_lidar.translation.allFinite() || fit.information.isZero(0.0)) {
      return Error::untrusted("the joint solve fails on these observations");
    }
    return report(fit, scales);
  }

 private:
  Status enough_scenes() const {
    const int used = count_used(mask_);
    if (used == 0) return Error::untrusted("no usable scene is left");
    if (!target_.has_circles() && used < 3) {
      return Error::untrusted(
          std::to_string(used) +
              " usable scenes; a target without circles needs three or more, differently turned",
          {}, "take scenes with the board tilted left, right, up and down");
    }
    return Done{};
  }

  // A start that puts corners where the camera cannot see them leaves nothing to descend from.
  Status corners_in_view() const {
    for (std::size_t s = 0; s < scenes_.size(); ++s) {
      if (!mask_.scene[s]) continue;
      for (const CornerObservation& c : scenes_[s].corners) {
        if (camera_.project(scenes_[s].camera_from_board *
                            Eigen::Vector3d(c.board_m.x(), c.board_m.y(), 0.0)))
          continue;
        return Error::untrusted(
            "the board's start pose puts some of its corners where the camera cannot see them",
            scenes_[s].name, "leave this scene out");
      }
    }
    return Done{};
  }

  double initial_sigma_px() const {
    std::vector<double> errors;
    for (std::size_t s = 0; s < scenes_.size(); ++s) {
      if (!mask_.scene[s]) continue;
      for (const CornerObservation& c : scenes_[s].corners) {
        const auto p = camera_.project(scenes_[s].camera_from_board *
                                       Eigen::Vector3d(c.board_m.x(), c.board_m.y(), 0.0));
        if (!p) continue;
        errors.push_back(p->x() - c.pixel.x());
        errors.push_back(p->y() - c.pixel.y());
      }
    }
    return errors.empty() ? options_.sigma_px_floor
                          : std::max(options_.sigma_px_floor, mad_sigma(std::move(errors)));
  }

  // Solves and re-estimates the noise scales until they stand still.
  JointFit settle(const JointState& start, NoiseScales& scales, const ObservationMask& mask) const {
    constexpr int kRounds = 5;
    JointFit fit = solve_joint(scenes_, camera_, target_, start, scales, mask, options_);
    for (int round = 0; round < kRounds; ++round) {
      const NoiseScales old = scales;
      update_scales(fit, scales);
      const double change = std::max({std::abs(std::log(scales.sigma_px / old.sigma_px)),
                                      std::abs(std::log(scales.node / old.node)),
                                      std::abs(std::log(scales.plane / old.plane))});
      if (change < 0.01) break;
      fit = solve_joint(scenes_, camera_, target_, fit.state, scales, mask, options_);
    }
    return fit;
  }

  // Variance components: each group's χ² over its redundancy. Corner noise is free; nodes and
  // planes come with their own σ, which is widened only when the data clearly say so.
  void update_scales(const JointFit& fit, NoiseScales& scales) const {
    const auto& corner = fit.groups[static_cast<std::size_t>(ResidualGroup::kCorner)];
    if (corner.redundancy > 1.0) {
      scales.sigma_px =
          std::max(options_.sigma_px_floor,
                   scales.sigma_px * std::sqrt(corner.chi_square / corner.redundancy));
    }
    scales.node = widened(fit.groups[static_cast<std::size_t>(ResidualGroup::kNode)], scales.node);
    scales.plane =
        widened(fit.groups[static_cast<std::size_t>(ResidualGroup::kPlane)], scales.plane);
  }

  static double widened(const GroupFit& group, double scale) {
    if (group.redundancy < 1.0) return scale;
    const double chi_square = group.chi_square * scale * scale;  // in units of the stated σ
    const int freedom = std::max(1, static_cast<int>(std::lround(group.redundancy)));
    if (chi_square < chi_square_gate(freedom, kTail)) return 1.0;
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

  // A scene contradicts the others if leaving it out (and no other) makes the rest fit at least
  // five times better. Repeated, while three scenes remain.
  void reject_bad_scenes(JointFit& fit, NoiseScales& scales) {
    constexpr double kImprovement = 5.0;
    const int fewest = target_.has_circles() ? 3 : 4;
    while (count_used(mask_) >= fewest && (scales.node > 1.0 || scales.plane > 1.0)) {
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
      if (worst == scenes_.size() || best * kImprovement > all || best * kImprovement > second)
        return;
      const Rigid3 own =
          scenes_[worst].camera_from_board * scenes_[worst].lidar_from_board.inverse();
      const Rigid3& rest = best_fit.state.camera_from_lidar;
      reasons_[worst] =
          "contradicts the other scenes by " +
          std::to_string(std::lround(1e3 * translation_distance_m(own.inverse(), rest.inverse()))) +
          " mm and " + std::to_string(std::lround(1e3 * rotation_distance_rad(own, rest))) +
          " mrad: did the board or the rig move between cloud and image?";
      mask_.scene[worst] = false;
      fit = best_fit;
      scales = best_scales;
    }
  }

  // Leaves out tags whose corners and nodes whose centres are far off. True if any was.
  bool reject_outliers(const JointFit& fit, const NoiseScales& scales) {
    bool any = false;
    for (std::size_t s = 0; s < scenes_.size(); ++s) {
      if (!mask_.scene[s]) continue;
      const auto corners = corner_residuals(s, fit.state);
      for (std::size_t k = 0; k < corners.size(); ++k) {
        if (!(corners[k].residual_px.norm() > options_.rejection_gate * scales.sigma_px)) continue;
        // The whole tag goes: its other corners share the cause.
        for (std::size_t j = 0; j < corners.size(); ++j) {
          if (corners[j].feature_id == corners[k].feature_id && mask_.corner[s][j]) {
            mask_.corner[s][j] = false;
            any = true;
          }
        }
      }
      const auto nodes = node_residuals(s, fit.state);
      for (std::size_t k = 0; k < nodes.size(); ++k) {
        if (!mask_.node[s][k]) continue;
        const Eigen::Matrix2d whitening =
            whitening_2(scales.node * scales.node *
                        (scenes_[s].nodes[k].covariance_m2 +
                         std::pow(options_.node_sigma_floor_m, 2) * Eigen::Matrix2d::Identity()));
        const Eigen::Vector3d in_lidar = scenes_[s].lidar_from_board.rotation * nodes[k].residual_m;
        const Eigen::Vector2d in_plane(scenes_[s].plane.axis_u.dot(in_lidar),
                                       scenes_[s].plane.axis_v.dot(in_lidar));
        if ((whitening * in_plane).norm() > options_.rejection_gate) {
          mask_.node[s][k] = false;
          any = true;
        }
      }
    }
    return any;
  }

  std::vector<CornerResidual> corner_residuals(std::size_t s, const JointState& state) const {
    std::vector<CornerResidual> out;
    for (std::size_t k = 0; k < scenes_[s].corners.size(); ++k) {
      const CornerObservation& c = scenes_[s].corners[k];
      CornerResidual r{c.feature_id, c.corner, Eigen::Vector2d::Zero(), mask_.corner[s][k]};
      const auto p = camera_.project(state.camera_from_board[s] *
                                     Eigen::Vector3d(c.board_m.x(), c.board_m.y(), 0.0));
      if (p) {
        r.residual_px = c.pixel - *p;
      } else {
        r.used = false;
      }
      out.push_back(r);
    }
    return out;
  }

  std::vector<NodeResidual> node_residuals(std::size_t s, const JointState& state) const {
    std::vector<NodeResidual> out;
    const Rigid3 board_from_lidar = state.camera_from_board[s].inverse() * state.camera_from_lidar;
    for (std::size_t k = 0; k < scenes_[s].nodes.size(); ++k) {
      const RefinedNode& node = scenes_[s].nodes[k];
      const Eigen::Vector3d residual = board_from_lidar * node.center_lidar_m -
                                       Eigen::Vector3d(node.board_m.x(), node.board_m.y(), 0.0);
      out.push_back({node.id, residual, mask_.node[s][k]});
    }
    return out;
  }

  ExtrinsicSolution report(const JointFit& fit, const NoiseScales& scales) const {
    ExtrinsicSolution solution;
    solution.camera_from_lidar.transform = fit.state.camera_from_lidar;
    solution.sigma_px = scales.sigma_px;
    solution.node_scale = scales.node;
    solution.plane_scale = scales.plane;
    solution.iterations = fit.iterations;
    solution.used_scenes = count_used(mask_);
    describe_uncertainty(fit, solution);
    std::vector<double> all_px;
    std::vector<double> all_mm;
    for (std::size_t s = 0; s < scenes_.size(); ++s) {
      solution.scenes.push_back(report_scene(s, fit.state, all_px, all_mm));
    }
    solution.rms_px = std::sqrt(2.0) * rms(all_px);
    solution.rms_mm = rms(all_mm);
    leave_one_out(fit, scales, solution);
    return solution;
  }

  SceneSolution report_scene(std::size_t s, const JointState& state, std::vector<double>& all_px,
                             std::vector<double>& all_mm) const {
    SceneSolution scene;
    scene.name = scenes_[s].name;
    scene.used = mask_.scene[s];
    scene.reason = reasons_[s];
    scene.camera_from_board = state.camera_from_board[s];
    scene.corners = corner_residuals(s, state);
    scene.nodes = node_residuals(s, state);
    std::vector<double> px;
    for (const CornerResidual& c : scene.corners) {
      if (!c.used) continue;
      px.push_back(c.residual_px.x());
      px.push_back(c.residual_px.y());
    }
    std::vector<double> mm;
    for (const NodeResidual& n : scene.nodes) {
      if (n.used) mm.push_back(1e3 * n.residual_m.norm());
    }
    if (scenes_[s].nodes.empty()) {
      const Rigid3 lidar_from_board =
          state.camera_from_lidar.inverse() * state.camera_from_board[s];
      const Eigen::Matrix3d probes = plane_probe_points(target_);
      for (int k = 0; k < 3; ++k) {
        const Eigen::Vector3d p = lidar_from_board * Eigen::Vector3d(probes.col(k));
        mm.push_back(1e3 * scenes_[s].plane.normal.dot(p - scenes_[s].plane.center_m));
      }
    }
    // Distance per corner: two coordinates.
    scene.rms_px = std::sqrt(2.0) * rms(px);
    scene.rms_mm = rms(mm);
    if (scene.used) {
      all_px.insert(all_px.end(), px.begin(), px.end());
      all_mm.insert(all_mm.end(), mm.begin(), mm.end());
    }
    return scene;
  }

  void describe_uncertainty(const JointFit& fit, ExtrinsicSolution& solution) const {
    // Rotations act over the distance to the boards: scaled so, all six directions are lengths.
    std::vector<double> distances;
    for (std::size_t s = 0; s < scenes_.size(); ++s) {
      if (mask_.scene[s]) distances.push_back(fit.state.camera_from_board[s].translation.norm());
    }
    const double lever = std::max(0.1, median(std::move(distances)));
    Vector6d unit;
    unit << 1, 1, 1, 1 / lever, 1 / lever, 1 / lever;
    const Matrix6d scaled = unit.asDiagonal() * fit.information * unit.asDiagonal();
    const Eigen::SelfAdjointEigenSolver<Matrix6d> axes(scaled);
    const double largest = std::max(axes.eigenvalues()(5), 1e-300);
    Matrix6d covariance = Matrix6d::Zero();
    solution.rank = 0;
    for (int k = 0; k < 6; ++k) {
      const double eigenvalue = axes.eigenvalues()(k);
      const Vector6d direction = axes.eigenvectors().col(k);
      const bool determined = eigenvalue > 1e-10 * largest;
      if (determined) ++solution.rank;
      // An undetermined direction gets a visible, absurd standard deviation: a kilometre.
      const double variance = determined ? 1.0 / eigenvalue : 1e6;
      covariance += variance * direction * direction.transpose();
      const double middle = 0.5 * (axes.eigenvalues()(2) + axes.eigenvalues()(3));
      if (!determined || eigenvalue < 0.01 * middle) {
        solution.weak_directions.push_back(describe_direction(
            direction, std::sqrt(middle / std::max(eigenvalue, 1e-300)), determined));
      }
    }
    solution.camera_from_lidar.covariance = unit.asDiagonal() * covariance * unit.asDiagonal();
  }

  static std::string describe_direction(const Vector6d& direction, double ratio, bool determined) {
    static const char* const kNames[] = {
        "translation along the camera's x axis", "translation along the camera's y axis",
        "translation along the camera's z axis", "rotation about the camera's x axis",
        "rotation about the camera's y axis",    "rotation about the camera's z axis"};
    // Sideways moves and turns hide in each other at one distance; depth shows in tilted boards;
    // a turn about the view shows far from its middle.
    static const char* const kAdvice[] = {
        "add a scene much nearer or farther, to part it from the turn about y",
        "add a scene much nearer or farther, to part it from the turn about x",
        "add a scene with the board nearer and tilted",
        "add a scene much nearer or farther, or high or low in the image",
        "add a scene much nearer or farther, or far left or right in the image",
        "add a scene with the board near the image's edge"};
    Eigen::Index main = 0;
    direction.cwiseAbs().maxCoeff(&main);
    const std::string text = kNames[main];
    if (!determined)
      return text + " is not determined: add scenes with the board turned differently";
    return text + " is known " + std::to_string(std::lround(ratio)) +
           " times worse than the typical direction: " + kAdvice[main];
  }

  void leave_one_out(const JointFit& fit, const NoiseScales& scales,
                     ExtrinsicSolution& solution) const {
    const int fewest = target_.has_circles() ? 3 : 4;
    if (count_used(mask_) < fewest) return;
    for (std::size_t s = 0; s < scenes_.size(); ++s) {
      if (!mask_.scene[s]) continue;
      ObservationMask without = mask_;
      without.scene[s] = false;
      const JointFit other =
          solve_joint(scenes_, camera_, target_, fit.state, scales, without, options_);
      const Rigid3& a = fit.state.camera_from_lidar;
      const Rigid3& b = other.state.camera_from_lidar;
      solution.leave_one_out.push_back({scenes_[s].name,
                                        1e3 * translation_distance_m(a.inverse(), b.inverse()),
                                        1e3 * rotation_distance_rad(a, b)});
    }
  }

  const std::vector<SceneObservations>& scenes_;
  const Camera& camera_;
  const Target& target_;
  const ExtrinsicOptions& options_;
  ObservationMask mask_;
  std::vector<std::string> reasons_;
};

}  // namespace

Rigid3 closed_form_extrinsic(const std::vector<SceneObservations>& scenes, const Target& target) {
  // Corresponding points: the outline's corners and a point above the middle, by each sensor's own
  // board pose.
  const BoardOutline outline = target.outline();
  const Eigen::Vector2d a = outline.lower_left_m;
  const Eigen::Vector2d b = outline.upper_right_m;
  const Eigen::Vector2d c = outline.center_m();
  const std::vector<Eigen::Vector3d> points{{a.x(), a.y(), 0},
                                            {b.x(), a.y(), 0},
                                            {b.x(), b.y(), 0},
                                            {a.x(), b.y(), 0},
                                            {c.x(), c.y(), outline.size_m().maxCoeff()}};
  std::vector<Eigen::Vector3d> camera;
  std::vector<Eigen::Vector3d> lidar;
  for (const SceneObservations& scene : scenes) {
    if (!scene.use) continue;
    for (const Eigen::Vector3d& p : points) {
      camera.push_back(scene.camera_from_board * p);
      lidar.push_back(scene.lidar_from_board * p);
    }
  }
  if (camera.empty()) return {};
  Eigen::Vector3d camera_mean = Eigen::Vector3d::Zero();
  Eigen::Vector3d lidar_mean = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < camera.size(); ++i) {
    camera_mean += camera[i] / static_cast<double>(camera.size());
    lidar_mean += lidar[i] / static_cast<double>(camera.size());
  }
  Eigen::Matrix3d cross = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < camera.size(); ++i) {
    cross += (camera[i] - camera_mean) * (lidar[i] - lidar_mean).transpose();
  }
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(cross, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Matrix3d sign = Eigen::Matrix3d::Identity();
  if ((svd.matrixU() * svd.matrixV().transpose()).determinant() < 0) sign(2, 2) = -1.0;
  const Eigen::Matrix3d R = svd.matrixU() * sign * svd.matrixV().transpose();
  return Rigid3::from_matrix(R, camera_mean - R * lidar_mean);
}

Result<ExtrinsicSolution> solve_extrinsic(const std::vector<SceneObservations>& scenes,
                                          const Camera& camera, const Target& target,
                                          const ExtrinsicOptions& options) {
  return Solver(scenes, camera, target, options).run();
}

}  // namespace lvcalib
