// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <Eigen/Core>

namespace lvcalib {

/// A planar rigid motion: plane = R(angle)·model + translation.
struct LayoutPose {
  double angle_rad = 0.0;
  Eigen::Vector2d translation_m = Eigen::Vector2d::Zero();
  [[nodiscard]] Eigen::Vector2d operator*(const Eigen::Vector2d& model_m) const;
};

/// Weighted projection of centres to the scale-fixed layout: argmin Σ αᵢ‖cᵢ − (R qᵢ + t)‖² over
/// SO(2) × ℝ². Needs two or more points with positive weight.
LayoutPose fit_layout(const std::vector<Eigen::Vector2d>& centers_m,
                      const std::vector<Eigen::Vector2d>& model_m,
                      const std::vector<double>& weights);

/// Scale of the centres over the model and its standard deviation when the centres have the given
/// variances (per axis). {1, 0} with fewer than two points.
struct LayoutScale {
  double scale = 1.0;
  double sigma = 0.0;
};
LayoutScale measure_scale(const std::vector<Eigen::Vector2d>& centers_m,
                          const std::vector<Eigen::Vector2d>& model_m,
                          const std::vector<double>& variances_m2);

}  // namespace lvcalib
