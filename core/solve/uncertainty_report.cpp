// SPDX-License-Identifier: BSD-3-Clause
#include "solve/uncertainty_report.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include <Eigen/Cholesky>

#include "base/statistics.h"
#include "base/symmetric.h"
#include "solve/feature_problem.h"

namespace lvcalib {
namespace {

// A split is called a contradiction if noise alone makes such a one in a thousand.
constexpr double kSplitTail = 1e-3;

// Where the covariance is projected to: a map over the image at one range, and distances along the
// camera's axis.
constexpr double kMapRange_m = 5.0;
constexpr double kRanges_m[] = {2.0, 5.0, 10.0, 20.0, 50.0};

// Covariance of the LiDAR's origin seen from the camera: ξ acts on it as ρ + ω × t.
Eigen::Matrix3d origin_covariance(const Matrix6d& covariance, const Eigen::Vector3d& t) {
  Eigen::Matrix<double, 3, 6> j;
  j << Eigen::Matrix3d::Identity(), -skew(t);
  return j * covariance * j.transpose();
}

Eigen::Vector3d board_center(const Target& target, const SceneSolution& scene) {
  const Eigen::Vector2d c = target.outline().center_m();
  return scene.camera_from_board * Eigen::Vector3d(c.x(), c.y(), 0.0);
}

// Angle between the board's normal and the line of sight.
double tilt_rad(const Target& target, const SceneSolution& scene) {
  const Eigen::Vector3d normal = scene.camera_from_board.rotation * Eigen::Vector3d::UnitZ();
  const double cosine = std::abs(normal.dot(board_center(target, scene).normalized()));
  return std::acos(std::min(1.0, cosine));
}

std::optional<UncertainRigid3> solve_half(const FeatureInput& in, const ExtrinsicSolution& joint,
                                          const std::vector<std::size_t>& half) {
  ObservationMask mask = mask_of(joint);
  for (std::size_t s = 0; s < in.scenes.size(); ++s) {
    mask.scene[s] = std::find(half.begin(), half.end(), s) != half.end();
  }
  JointState start{joint.camera_from_lidar.transform, {}};
  for (const SceneSolution& s : joint.scenes)
    start.camera_from_board.push_back(s.camera_from_board);
  const JointFit fit = solve_joint(in, start, scales_of(joint), mask);
  const Eigen::LDLT<Matrix6d> factor(fit.information);
  if (!fit.converged || factor.info() != Eigen::Success || !factor.isPositive() ||
      factor.rcond() < 1e-12)
    return std::nullopt;
  return UncertainRigid3{fit.state.camera_from_lidar, factor.solve(Matrix6d::Identity())};
}

SplitHalf compare_extrinsics(const UncertainRigid3& a, const UncertainRigid3& b) {
  SplitHalf out;
  const Matrix6d covariance = a.covariance + b.covariance;
  const Vector6d xi = se3_log(a.transform * b.transform.inverse());
  out.chi_square = squared_mahalanobis(xi, covariance);
  out.gate = chi_square_gate(6, kSplitTail);
  out.translation_mm = 1e3 * translation_distance_m(a.transform, b.transform);
  out.rotation_mrad = 1e3 * rotation_distance_rad(a.transform, b.transform);
  out.expected_translation_mm =
      1e3 * std::sqrt(origin_covariance(covariance, a.transform.translation).trace());
  out.expected_rotation_mrad = 1e3 * std::sqrt(covariance.bottomRightCorner<3, 3>().trace());
  return out;
}

// Halves by the order of `key`: small values first.
std::optional<SplitHalf> split(const ExtrinsicSolution& joint, const SubsetSolver& subset,
                               const std::function<double(const SceneSolution&)>& key) {
  std::vector<std::size_t> order;
  for (std::size_t s = 0; s < joint.scenes.size(); ++s) {
    if (joint.scenes[s].used) order.push_back(s);
  }
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return key(joint.scenes[a]) < key(joint.scenes[b]);
  });
  const auto middle = order.begin() + static_cast<std::ptrdiff_t>(order.size() / 2);
  const std::vector<std::size_t> first(order.begin(), middle);
  const std::vector<std::size_t> second(middle, order.end());
  const auto a = subset(first);
  const auto b = subset(second);
  if (!a || !b) return std::nullopt;
  SplitHalf out = compare_extrinsics(*a, *b);
  for (const std::size_t s : first) out.first.push_back(joint.scenes[s].name);
  for (const std::size_t s : second) out.second.push_back(joint.scenes[s].name);
  return out;
}

void compare_halves(const Target& target, const ExtrinsicSolution& joint,
                    const SubsetSolver& subset, UncertaintyReport& report) {
  const int needed = target.has_circles() ? 4 : 6;
  if (joint.used_scenes < needed) {
    report.splits_reason =
        Message("not enough scenes for a comparison of halves: %1 in use, %2 needed",
                joint.used_scenes, needed);
    return;
  }
  const auto add = [&](const Message& name, const auto& key) {
    auto halves = split(joint, subset, key);
    if (!halves) return;
    halves->name = name;
    report.splits.push_back(std::move(*halves));
  };
  add(Message("near/far"), [&](const SceneSolution& s) { return board_center(target, s).norm(); });
  add(Message("left/right"), [&](const SceneSolution& s) {
    const Eigen::Vector3d c = board_center(target, s);
    return c.x() / c.z();
  });
  add(Message("flat/tilted"), [&](const SceneSolution& s) { return tilt_rad(target, s); });
  if (report.splits.empty())
    report.splits_reason = Message(
        "not enough scenes for a comparison of halves: neither half alone determines the "
        "extrinsic");
}

// `spread_of`: the covariance of the pixel that a ray falls into.
template <typename SpreadOf>
ProjectedUncertainty map_over_image(const Camera& camera, int columns, const SpreadOf& spread_of) {
  ProjectedUncertainty map;
  map.columns = std::max(2, columns);
  map.rows = std::max(2, static_cast<int>(std::lround(static_cast<double>(map.columns) *
                                                      camera.height_px / camera.width_px)));
  for (int row = 0; row < map.rows; ++row) {
    for (int column = 0; column < map.columns; ++column) {
      const Eigen::Vector2d pixel((camera.width_px - 1.0) * column / (map.columns - 1.0),
                                  (camera.height_px - 1.0) * row / (map.rows - 1.0));
      map.pixel.push_back(pixel);
      const auto ray = camera.unproject(pixel);
      const std::optional<Eigen::Matrix2d> spread = ray ? spread_of(*ray) : std::nullopt;
      map.sigma_px.push_back(spread ? std::sqrt(spread->trace())
                                    : std::numeric_limits<double>::quiet_NaN());
    }
  }
  return map;
}

}  // namespace

std::optional<std::pair<double, double>> ProjectedUncertainty::reach_px() const {
  std::optional<std::pair<double, double>> out;
  for (const double sigma : sigma_px) {
    if (!std::isfinite(sigma)) continue;
    if (!out) out.emplace(sigma, sigma);
    out->first = std::min(out->first, sigma);
    out->second = std::max(out->second, sigma);
  }
  return out;
}

ProjectedUncertainty project_intrinsics(const Camera& camera,
                                        const Eigen::Matrix<double, 12, 12>& covariance,
                                        int columns) {
  return map_over_image(camera, columns,
                        [&](const Eigen::Vector3d& ray) -> std::optional<Eigen::Matrix2d> {
                          Eigen::Matrix<double, 2, 12> by_intrinsics;
                          if (!camera.project(ray, nullptr, &by_intrinsics)) return std::nullopt;
                          return by_intrinsics * covariance * by_intrinsics.transpose();
                        });
}

std::optional<Eigen::Matrix2d> pixel_covariance(const Camera& camera,
                                                const Eigen::Vector3d& point_in_camera_m,
                                                const ProjectionCovariance& covariance) {
  Eigen::Matrix<double, 2, 3> by_point;
  Eigen::Matrix<double, 2, 12> by_intrinsics;
  if (!camera.project(point_in_camera_m, &by_point, &by_intrinsics)) return std::nullopt;
  Eigen::Matrix<double, 3, 6> by_pose;
  by_pose << Eigen::Matrix3d::Identity(), -skew(point_in_camera_m);
  const Eigen::Matrix<double, 2, 6> j = by_point * by_pose;
  const Eigen::Matrix2d both = by_intrinsics * covariance.cross * j.transpose();
  return j * covariance.extrinsic * j.transpose() + both + both.transpose() +
         by_intrinsics * covariance.intrinsics * by_intrinsics.transpose();
}

UncertaintyReport project_uncertainty(const Camera& camera,
                                      const ProjectionCovariance& covariance) {
  UncertaintyReport report;
  report.maps.push_back(map_over_image(camera, kMapColumns, [&](const Eigen::Vector3d& ray) {
    return pixel_covariance(camera, kMapRange_m * ray, covariance);
  }));
  report.maps.back().range_m = kMapRange_m;
  for (const double range : kRanges_m) {
    const Eigen::Matrix3d at = origin_covariance(covariance.extrinsic, {0.0, 0.0, range});
    report.by_range.push_back(
        {range, 1e3 * std::sqrt(at(0, 0) + at(1, 1)), 1e3 * std::sqrt(at(2, 2))});
  }
  return report;
}

UncertaintyReport assess_uncertainty(const FeatureInput& in, const ExtrinsicSolution& joint,
                                     const ProjectionCovariance& covariance,
                                     const SubsetSolver& subset) {
  UncertaintyReport report = project_uncertainty(in.camera, covariance);
  const SubsetSolver by_features = [&](const std::vector<std::size_t>& half) {
    return solve_half(in, joint, half);
  };
  compare_halves(in.target, joint, subset ? subset : by_features, report);
  return report;
}

}  // namespace lvcalib
