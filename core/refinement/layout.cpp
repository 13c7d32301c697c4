// SPDX-License-Identifier: BSD-3-Clause
#include "refinement/layout.h"

#include <cmath>
#include <numeric>

namespace lvcalib {
namespace {

Eigen::Vector2d rotate(double angle, const Eigen::Vector2d& p) {
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  return {c * p.x() - s * p.y(), s * p.x() + c * p.y()};
}

Eigen::Vector2d weighted_mean(const std::vector<Eigen::Vector2d>& points,
                              const std::vector<double>& weights) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (std::size_t i = 0; i < points.size(); ++i) sum += weights[i] * points[i];
  return sum / std::accumulate(weights.begin(), weights.end(), 0.0);
}

}  // namespace

Eigen::Vector2d LayoutPose::operator*(const Eigen::Vector2d& model_m) const {
  return rotate(angle_rad, model_m) + translation_m;
}

LayoutPose fit_layout(const std::vector<Eigen::Vector2d>& centers_m,
                      const std::vector<Eigen::Vector2d>& model_m,
                      const std::vector<double>& weights) {
  const Eigen::Vector2d center = weighted_mean(centers_m, weights);
  const Eigen::Vector2d model = weighted_mean(model_m, weights);
  double dot = 0.0;
  double cross = 0.0;
  for (std::size_t i = 0; i < centers_m.size(); ++i) {
    const Eigen::Vector2d a = model_m[i] - model;
    const Eigen::Vector2d b = centers_m[i] - center;
    dot += weights[i] * a.dot(b);
    cross += weights[i] * (a.x() * b.y() - a.y() * b.x());
  }
  LayoutPose pose;
  pose.angle_rad = std::atan2(cross, dot);
  pose.translation_m = center - rotate(pose.angle_rad, model);
  return pose;
}

LayoutScale measure_scale(const std::vector<Eigen::Vector2d>& centers_m,
                          const std::vector<Eigen::Vector2d>& model_m,
                          const std::vector<double>& variances_m2) {
  if (centers_m.size() < 2) return {};
  std::vector<double> weights;
  for (const double v : variances_m2) weights.push_back(1.0 / v);
  const LayoutPose pose = fit_layout(centers_m, model_m, weights);
  const Eigen::Vector2d center = weighted_mean(centers_m, weights);
  const Eigen::Vector2d model = weighted_mean(model_m, weights);
  double numerator = 0.0;
  double denominator = 0.0;
  for (std::size_t i = 0; i < centers_m.size(); ++i) {
    const Eigen::Vector2d a = rotate(pose.angle_rad, model_m[i] - model);
    numerator += weights[i] * a.dot(centers_m[i] - center);
    denominator += weights[i] * a.squaredNorm();
  }
  if (denominator <= 0) return {};
  return {numerator / denominator, 1.0 / std::sqrt(denominator)};
}

}  // namespace lvcalib
