// SPDX-License-Identifier: BSD-3-Clause
#include "solve/cost_functions.h"

namespace lvcalib {
namespace {

template <int Rows>
using BlockJacobian = Eigen::Matrix<double, Rows, 7, Eigen::RowMajor>;

// A board point in camera and LiDAR frame, and its LiDAR coordinates' Jacobian by the pose of the
// board in the camera; by the extrinsic it is the negative.
struct LidarPoint {
  Eigen::Vector3d in_lidar;
  Eigen::Matrix<double, 3, 6> by_board_pose;
};

LidarPoint board_point_in_lidar(double const* const* parameters, const Eigen::Vector3d& board) {
  const Rigid3 camera_from_lidar = rigid_from_block(parameters[0]);
  const Rigid3 camera_from_board = rigid_from_block(parameters[1]);
  const Eigen::Vector3d in_camera = camera_from_board * board;
  const Rigid3 lidar_from_camera = camera_from_lidar.inverse();
  return {lidar_from_camera * in_camera,
          lidar_from_camera.rotation.toRotationMatrix() * point_by_pose(in_camera)};
}

template <int Rows>
void store(double** jacobians, const Eigen::Matrix<double, Rows, 6>& by_board_pose) {
  if (jacobians == nullptr) return;
  for (int block = 0; block < 2; ++block) {
    if (jacobians[block] == nullptr) continue;
    Eigen::Map<BlockJacobian<Rows>> j(jacobians[block]);
    j.setZero();
    j.template leftCols<6>() = block == 0 ? -by_board_pose : by_board_pose;
  }
}

}  // namespace

Eigen::Matrix<double, 3, 6> point_by_pose(const Eigen::Vector3d& point) {
  Eigen::Matrix<double, 3, 6> j;
  j.leftCols<3>().setIdentity();
  j.rightCols<3>() = -skew(point);
  return j;
}

Rigid3 rigid_from_block(const double* block) {
  return {Eigen::Quaterniond(block[3], block[0], block[1], block[2]),
          Eigen::Vector3d(block[4], block[5], block[6])};
}

void rigid_to_block(const Rigid3& transform, double* block) {
  Eigen::Map<Eigen::Vector4d> rotation(block);
  Eigen::Map<Eigen::Vector3d> translation(block + 4);
  rotation = transform.rotation.coeffs();
  translation = transform.translation;
}

bool RigidManifold::Plus(const double* x, const double* delta, double* x_plus_delta) const {
  rigid_to_block(se3_exp(Eigen::Map<const Vector6d>(delta)) * rigid_from_block(x), x_plus_delta);
  return true;
}

bool RigidManifold::PlusJacobian(const double* /*x*/, double* jacobian) const {
  Eigen::Map<Eigen::Matrix<double, 7, 6, Eigen::RowMajor>> j(jacobian);
  j.setIdentity();
  return true;
}

bool RigidManifold::Minus(const double* y, const double* x, double* y_minus_x) const {
  Eigen::Map<Vector6d> difference(y_minus_x);
  difference = se3_log(rigid_from_block(y) * rigid_from_block(x).inverse());
  return true;
}

bool RigidManifold::MinusJacobian(const double* /*x*/, double* jacobian) const {
  Eigen::Map<Eigen::Matrix<double, 6, 7, Eigen::RowMajor>> j(jacobian);
  j.setIdentity();
  return true;
}

CornerCost::CornerCost(const Camera& camera, const Eigen::Vector2d& board_m,
                       const Eigen::Vector2d& pixel, double sigma_px)
    : camera_(&camera),
      point_(board_m.x(), board_m.y(), 0.0),
      pixel_(pixel),
      inverse_sigma_(1.0 / sigma_px) {}

CornerCost::CornerCost(const Camera& camera, const Eigen::Vector3d& point_m,
                       const Eigen::Vector2d& pixel, double sigma_px)
    : camera_(&camera), point_(point_m), pixel_(pixel), inverse_sigma_(1.0 / sigma_px) {}

bool CornerCost::Evaluate(double const* const* parameters, double* residuals,
                          double** jacobians) const {
  const Eigen::Vector3d in_camera = rigid_from_block(parameters[0]) * point_;
  Eigen::Matrix<double, 2, 3> by_point;
  const auto projected = camera_->project(in_camera, &by_point);
  if (!projected) return false;
  Eigen::Map<Eigen::Vector2d> r(residuals);
  r = inverse_sigma_ * (*projected - pixel_);
  if (jacobians != nullptr && jacobians[0] != nullptr) {
    Eigen::Map<BlockJacobian<2>> j(jacobians[0]);
    j.setZero();
    j.leftCols<6>() = inverse_sigma_ * by_point * point_by_pose(in_camera);
  }
  return true;
}

NodeCost::NodeCost(const Eigen::Vector2d& board_m, const Eigen::Vector3d& center_lidar_m,
                   const PlaneAxes& axes, const Eigen::Matrix2d& whitening)
    : point_(board_m.x(), board_m.y(), 0.0),
      center_(center_lidar_m),
      axes_(axes),
      whitening_(whitening) {}

bool NodeCost::Evaluate(double const* const* parameters, double* residuals,
                        double** jacobians) const {
  const LidarPoint p = board_point_in_lidar(parameters, point_);
  const Eigen::Matrix<double, 2, 3> map = whitening_ * axes_.topRows<2>();
  Eigen::Map<Eigen::Vector2d> r(residuals);
  r = map * (p.in_lidar - center_);
  store<2>(jacobians, map * p.by_board_pose);
  return true;
}

NodePointCost::NodePointCost(const Eigen::Vector2d& board_m, const Eigen::Vector3d& center_lidar_m,
                             const PlaneAxes& axes, const Eigen::Matrix3d& whitening)
    : point_(board_m.x(), board_m.y(), 0.0), center_(center_lidar_m), map_(whitening * axes) {}

bool NodePointCost::Evaluate(double const* const* parameters, double* residuals,
                             double** jacobians) const {
  const LidarPoint p = board_point_in_lidar(parameters, point_);
  Eigen::Map<Eigen::Vector3d> r(residuals);
  r = map_ * (p.in_lidar - center_);
  store<3>(jacobians, Eigen::Matrix<double, 3, 6>(map_ * p.by_board_pose));
  return true;
}

PlaneCost::PlaneCost(const Eigen::Matrix3d& board_points_m, const Eigen::Vector3d& plane_center_m,
                     const Eigen::Vector3d& normal, const Eigen::Matrix3d& whitening)
    : points_(board_points_m), center_(plane_center_m), normal_(normal), whitening_(whitening) {}

bool PlaneCost::Evaluate(double const* const* parameters, double* residuals,
                         double** jacobians) const {
  Eigen::Vector3d heights;
  Eigen::Matrix<double, 3, 6> by_pose;
  for (int k = 0; k < 3; ++k) {
    const LidarPoint p = board_point_in_lidar(parameters, points_.col(k));
    heights(k) = normal_.dot(p.in_lidar - center_);
    by_pose.row(k) = normal_.transpose() * p.by_board_pose;
  }
  Eigen::Map<Eigen::Vector3d> r(residuals);
  r = whitening_ * heights;
  store<3>(jacobians, Eigen::Matrix<double, 3, 6>(whitening_ * by_pose));
  return true;
}

}  // namespace lvcalib
