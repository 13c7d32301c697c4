// SPDX-License-Identifier: BSD-3-Clause
#include "solve/uncertainty_report.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include <Eigen/Cholesky>

#include "base/statistics.h"
#include "solve/feature_problem.h"

namespace lvcalib {
namespace {

// A split is called a contradiction if noise alone makes such a one in a thousand.
constexpr double kSplitTail = 1e-3;

// Covariance of the LiDAR's origin seen from the camera: ξ acts on it as ρ + ω × t.
Eigen::Matrix3d origin_covariance(const Matrix6d& covariance, const Eigen::Vector3d& t) {
  Eigen::Matrix<double, 3, 6> j;
  j << Eigen::Matrix3d::Identity(), -skew(t);
  return j * covariance * j.transpose();
}

class Splitter {
 public:
  Splitter(const std::vector<SceneObservations>& scenes, const Camera& camera, const Target& target,
           const ExtrinsicSolution& joint, const ExtrinsicOptions& options,
           const SubsetSolver& subset)
      : subset_(subset),
        scenes_(scenes),
        camera_(camera),
        target_(target),
        joint_(joint),
        options_(options) {
    start_.camera_from_lidar = joint.camera_from_lidar.transform;
    for (const SceneSolution& s : joint.scenes)
      start_.camera_from_board.push_back(s.camera_from_board);
  }

  // Halves by the order of `key`: small values first.
  std::optional<SplitHalf> split(const Message& name,
                                 const std::function<double(std::size_t)>& key) const {
    std::vector<std::size_t> order;
    for (std::size_t s = 0; s < scenes_.size(); ++s) {
      if (joint_.scenes[s].used) order.push_back(s);
    }
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return key(a) < key(b); });
    const auto middle = order.begin() + static_cast<std::ptrdiff_t>(order.size() / 2);
    const std::vector<std::size_t> first(order.begin(), middle);
    const std::vector<std::size_t> second(middle, order.end());
    const auto a = solve(first);
    const auto b = solve(second);
    if (!a || !b) return std::nullopt;
    SplitHalf out = compare(*a, *b);
    out.name = name;
    for (const std::size_t s : first) out.first.push_back(scenes_[s].name);
    for (const std::size_t s : second) out.second.push_back(scenes_[s].name);
    return out;
  }

  [[nodiscard]] Eigen::Vector3d board_center(std::size_t s) const {
    const Eigen::Vector2d c = target_.outline().center_m();
    return joint_.scenes[s].camera_from_board * Eigen::Vector3d(c.x(), c.y(), 0.0);
  }

  // Angle between the board's normal and the line of sight.
  [[nodiscard]] double tilt_rad(std::size_t s) const {
    const Eigen::Vector3d normal =
        joint_.scenes[s].camera_from_board.rotation * Eigen::Vector3d::UnitZ();
    const double cosine = std::abs(normal.dot(board_center(s).normalized()));
    return std::acos(std::min(1.0, cosine));
  }

 private:
  [[nodiscard]] std::optional<UncertainRigid3> solve(const std::vector<std::size_t>& half) const {
    if (subset_) return subset_(half);
    ObservationMask mask = mask_of(joint_);
    for (std::size_t s = 0; s < scenes_.size(); ++s) {
      mask.scene[s] = std::find(half.begin(), half.end(), s) != half.end();
    }
    const JointFit fit =
        solve_joint(scenes_, camera_, target_, start_, scales_of(joint_), mask, options_);
    const Eigen::LDLT<Matrix6d> factor(fit.information);
    if (!fit.converged || factor.info() != Eigen::Success || !factor.isPositive() ||
        factor.rcond() < 1e-12)
      return std::nullopt;
    return UncertainRigid3{fit.state.camera_from_lidar, factor.solve(Matrix6d::Identity())};
  }

  static SplitHalf compare(const UncertainRigid3& a, const UncertainRigid3& b) {
    SplitHalf out;
    const Matrix6d covariance = a.covariance + b.covariance;
    const Vector6d xi = se3_log(a.transform * b.transform.inverse());
    out.chi_square = xi.dot(covariance.ldlt().solve(xi));
    out.gate = chi_square_gate(6, kSplitTail);
    out.translation_mm = 1e3 * translation_distance_m(a.transform, b.transform);
    out.rotation_mrad = 1e3 * rotation_distance_rad(a.transform, b.transform);
    out.expected_translation_mm =
        1e3 * std::sqrt(origin_covariance(covariance, a.transform.translation).trace());
    out.expected_rotation_mrad = 1e3 * std::sqrt(covariance.bottomRightCorner<3, 3>().trace());
    return out;
  }

  const SubsetSolver& subset_;
  const std::vector<SceneObservations>& scenes_;
  const Camera& camera_;
  const Target& target_;
  const ExtrinsicSolution& joint_;
  const ExtrinsicOptions& options_;
  JointState start_;
};

void compare_halves(const std::vector<SceneObservations>& scenes, const Camera& camera,
                    const Target& target, const ExtrinsicSolution& joint,
                    const ExtrinsicOptions& options, const SubsetSolver& subset,
                    UncertaintyReport& report) {
  const int needed = target.has_circles() ? 4 : 6;
  if (joint.used_scenes < needed) {
    report.splits_reason =
        Message("not enough scenes for a comparison of halves: %1 in use, %2 needed",
                joint.used_scenes, needed);
    return;
  }
  const Splitter splitter(scenes, camera, target, joint, options, subset);
  const auto add = [&](const Message& name, const std::function<double(std::size_t)>& key) {
    if (auto split = splitter.split(name, key)) report.splits.push_back(std::move(*split));
  };
  add(Message("near/far"), [&](std::size_t s) { return splitter.board_center(s).norm(); });
  add(Message("left/right"), [&](std::size_t s) {
    const Eigen::Vector3d c = splitter.board_center(s);
    return c.x() / c.z();
  });
  add(Message("flat/tilted"), [&](std::size_t s) { return splitter.tilt_rad(s); });
  if (report.splits.empty())
    report.splits_reason = Message(
        "not enough scenes for a comparison of halves: neither half alone determines the "
        "extrinsic");
}

ProjectedUncertainty map_over_image(const Camera& camera, const Matrix6d& covariance,
                                    double range_m, int columns) {
  ProjectedUncertainty map;
  map.range_m = range_m;
  map.columns = std::max(2, columns);
  map.rows = std::max(2, static_cast<int>(std::lround(static_cast<double>(map.columns) *
                                                      camera.height_px / camera.width_px)));
  for (int row = 0; row < map.rows; ++row) {
    for (int column = 0; column < map.columns; ++column) {
      const Eigen::Vector2d pixel((camera.width_px - 1.0) * column / (map.columns - 1.0),
                                  (camera.height_px - 1.0) * row / (map.rows - 1.0));
      map.pixel.push_back(pixel);
      const auto ray = camera.unproject(pixel);
      const auto spread = ray ? pixel_covariance(camera, range_m * *ray, covariance) : std::nullopt;
      map.sigma_px.push_back(spread ? std::sqrt(spread->trace())
                                    : std::numeric_limits<double>::quiet_NaN());
    }
  }
  return map;
}

}  // namespace

std::optional<Eigen::Matrix2d> pixel_covariance(const Camera& camera,
                                                const Eigen::Vector3d& point_in_camera_m,
                                                const Matrix6d& covariance) {
  Eigen::Matrix<double, 2, 3> by_point;
  if (!camera.project(point_in_camera_m, &by_point)) return std::nullopt;
  Eigen::Matrix<double, 3, 6> by_pose;
  by_pose << Eigen::Matrix3d::Identity(), -skew(point_in_camera_m);
  const Eigen::Matrix<double, 2, 6> j = by_point * by_pose;
  return j * covariance * j.transpose();
}

UncertaintyReport assess_uncertainty(const std::vector<SceneObservations>& scenes,
                                     const Camera& camera, const Target& target,
                                     const ExtrinsicSolution& joint,
                                     const ExtrinsicOptions& options, const UncertaintyOptions& how,
                                     const SubsetSolver& subset) {
  UncertaintyReport report;
  compare_halves(scenes, camera, target, joint, options, subset, report);
  const Matrix6d& covariance = joint.camera_from_lidar.covariance;
  report.maps.push_back(map_over_image(camera, covariance, how.map_range_m, how.map_columns));
  for (const double range : how.ranges_m) {
    const Eigen::Matrix3d at = origin_covariance(covariance, {0.0, 0.0, range});
    report.by_range.push_back(
        {range, 1e3 * std::sqrt(at(0, 0) + at(1, 1)), 1e3 * std::sqrt(at(2, 2))});
  }
  return report;
}

}  // namespace lvcalib
