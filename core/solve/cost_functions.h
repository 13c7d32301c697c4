// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Cost functions of the joint objective. They hold no state but their measurement, do no I/O, and
// have closed-form Jacobians (tested against numeric ones).
//
// Parameter blocks are rigid transforms as seven numbers (x y z w, tx ty tz) with the left
// perturbation T ← Exp(ξ)·T, ξ = (translation, rotation). Jacobians are by ξ: RigidManifold's
// plus-Jacobian is [I₆; 0], so that the six columns pass through unchanged.

#include <Eigen/Core>
#include <ceres/manifold.h>
#include <ceres/sized_cost_function.h>

#include "base/rigid3.h"
#include "camera/camera.h"

namespace lvcalib {

/// ∂(Exp(ξ)X)/∂ξ at ξ = 0: [I, −[X]ₓ], m and rad.
Eigen::Matrix<double, 3, 6> point_by_pose(const Eigen::Vector3d& point);

/// Reads and writes a transform as a parameter block.
Rigid3 rigid_from_block(const double* block);
void rigid_to_block(const Rigid3& transform, double* block);

/// SE(3) with the left perturbation.
class RigidManifold final : public ceres::Manifold {
 public:
  [[nodiscard]] int AmbientSize() const override { return 7; }
  [[nodiscard]] int TangentSize() const override { return 6; }
  bool Plus(const double* x, const double* delta, double* x_plus_delta) const override;
  bool PlusJacobian(const double* x, double* jacobian) const override;
  bool Minus(const double* y, const double* x, double* y_minus_x) const override;
  bool MinusJacobian(const double* x, double* jacobian) const override;
};

/// (π(T_camera_board P) − z)/σ for one corner. A point the camera cannot image fails the
/// evaluation instead of giving a zero residual.
class CornerCost final : public ceres::SizedCostFunction<2, 7> {
 public:
  CornerCost(const Camera& camera, const Eigen::Vector2d& board_m, const Eigen::Vector2d& pixel,
             double sigma_px);
  /// The same for a point anywhere: block T_camera_x, the point in frame x.
  CornerCost(const Camera& camera, const Eigen::Vector3d& point_m, const Eigen::Vector2d& pixel,
             double sigma_px);
  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override;

 private:
  const Camera* camera_;
  Eigen::Vector3d point_;
  Eigen::Vector2d pixel_;
  double inverse_sigma_;
};

/// Frame of a plane in the LiDAR frame: two in-plane axes and the normal.
using PlaneAxes = Eigen::Matrix<double, 3, 3>;  // rows: axis_u, axis_v, normal

/// In-plane difference between the predicted node T_lidar_camera·T_camera_board·P and the measured
/// centre, whitened by its 2×2 covariance. Blocks: T_camera_lidar, T_camera_board.
class NodeCost final : public ceres::SizedCostFunction<2, 7, 7> {
 public:
  NodeCost(const Eigen::Vector2d& board_m, const Eigen::Vector3d& center_lidar_m,
           const PlaneAxes& axes, const Eigen::Matrix2d& whitening);
  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override;

 private:
  Eigen::Vector3d point_;
  Eigen::Vector3d center_;
  PlaneAxes axes_;
  Eigen::Matrix2d whitening_;
};

/// The same difference along all three axes, whitened by a 3×3 covariance in their order. With a
/// multiple of the identity it is the distance in any frame, the board's too. Blocks as above.
class NodePointCost final : public ceres::SizedCostFunction<3, 7, 7> {
 public:
  NodePointCost(const Eigen::Vector2d& board_m, const Eigen::Vector3d& center_lidar_m,
                const PlaneAxes& axes, const Eigen::Matrix3d& whitening);
  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override;

 private:
  Eigen::Vector3d point_;
  Eigen::Vector3d center_;
  Eigen::Matrix3d map_;  // whitening · axes
};

/// Heights of three board points over the measured plane, whitened by the plane's covariance: all
/// that the LiDAR points on the board say about its plane. Blocks: T_camera_lidar, T_camera_board.
class PlaneCost final : public ceres::SizedCostFunction<3, 7, 7> {
 public:
  PlaneCost(const Eigen::Matrix3d& board_points_m, const Eigen::Vector3d& plane_center_m,
            const Eigen::Vector3d& normal, const Eigen::Matrix3d& whitening);
  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override;

 private:
  Eigen::Matrix3d points_;  // columns
  Eigen::Vector3d center_;
  Eigen::Vector3d normal_;
  Eigen::Matrix3d whitening_;
};

}  // namespace lvcalib
