// SPDX-License-Identifier: GPL-3.0-or-later
#include "information_bound.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

#include "base/statistics.h"

namespace lvcalib::study {
namespace {

// Reflectivities of the simulator's print and its reference for the range noise.
constexpr double kWhite = 0.85;
constexpr double kBlack = 0.07;

using Row6 = Eigen::Matrix<double, 1, 6>;
using Block36 = Eigen::Matrix<double, 3, 6>;

Block36 point_by_pose(const Eigen::Vector3d& p) {
  Block36 j;
  j.leftCols<3>().setIdentity();
  j.rightCols<3>() = -skew(p);
  return j;
}

Matrix6d camera_information(const simulation::SimulatedRig& rig, const Rigid3& camera_from_board,
                            double sigma_px) {
  Matrix6d information = Matrix6d::Zero();
  for (const TargetTag& tag : rig.target.tags()) {
    for (const Eigen::Vector2d& corner : rig.target.tag_corners_m(tag)) {
      const Eigen::Vector3d p = camera_from_board * Eigen::Vector3d(corner.x(), corner.y(), 0.0);
      Eigen::Matrix<double, 2, 3> by_point;
      const auto pixel = rig.camera.project(p, &by_point);
      if (!pixel || !rig.camera.in_image(*pixel)) continue;
      const Eigen::Matrix<double, 2, 6> j = by_point * point_by_pose(p) / sigma_px;
      information += j.transpose() * j;
    }
  }
  return information;
}

// Variance of the level that jitter causes at a distance from an edge blurred by the beam alone.
double jitter_variance(double d, double beam_sigma, double jitter_sigma) {
  constexpr int kSteps = 21;
  double sum = 0.0;
  double first = 0.0;
  double second = 0.0;
  for (int k = 0; k < kSteps; ++k) {
    const double z = -3.5 + 7.0 * k / (kSteps - 1);
    const double w = normal_pdf(z);
    const double level = normal_cdf((d + z * jitter_sigma) / beam_sigma);
    sum += w;
    first += w * level;
    second += w * level * level;
  }
  first /= sum;
  return std::max(0.0, second / sum - first * first);
}

class LidarInformation {
 public:
  LidarInformation(const simulation::SimulatedRig& rig, const simulation::SimulatedScene& scene)
      : rig_(rig),
        lidar_from_board_(scene.lidar_from_board),
        board_from_lidar_(scene.lidar_from_board.inverse()),
        normal_(lidar_from_board_.rotation * Eigen::Vector3d::UnitZ()) {}

  void add(const Eigen::Vector3d& measured) {
    const Eigen::Vector3d ray = measured.normalized();
    const double along = normal_.dot(ray);
    if (along > -0.05) return;
    const Eigen::Vector3d hit = ray * (normal_.dot(lidar_from_board_.translation) / along);
    if (std::abs(hit.norm() - measured.norm()) > 0.1) return;
    const Eigen::Vector3d on_board = board_from_lidar_ * hit;
    const auto albedo = rig_.target.albedo(on_board.head<2>());
    if (!albedo) return;
    const double reflectivity = *albedo > 0.5 ? kWhite : kBlack;
    const double sigma = rig_.options.lidar.range_sigma_m *
                         std::pow(kWhite / reflectivity, rig_.options.lidar.range_dark_exponent);
    const Row6 j = normal_.transpose() * point_by_pose(hit) / along / sigma;
    information += j.transpose() * j;
    add_boundary(ray, hit, on_board.head<2>());
  }

  Matrix6d information = Matrix6d::Zero();

 private:
  void add_boundary(const Eigen::Vector3d& ray, const Eigen::Vector3d& hit,
                    const Eigen::Vector2d& b) {
    const double room =
        0.5 * rig_.target.tag_spacing * rig_.target.tag_size_m * std::numbers::sqrt2 -
        rig_.target.circle_radius_m;
    for (const TargetNode& node : rig_.target.nodes()) {
      const Eigen::Vector2d offset = b - node.center_m;
      const double d = offset.norm() - rig_.target.circle_radius_m;
      if (d > room || d < -0.9 * rig_.target.circle_radius_m) continue;
      add_sample(ray, hit, offset.normalized(), d);
    }
  }

  void add_sample(const Eigen::Vector3d& ray, const Eigen::Vector3d& hit,
                  const Eigen::Vector2d& outward, double d) {
    const simulation::LidarOptions& lidar = rig_.options.lidar;
    // Directions of the scanner's axes at this beam, and how they move the hit on the board.
    const Eigen::Vector3d across = Eigen::Vector3d::UnitZ().cross(ray).normalized();
    const Eigen::Vector3d up = ray.cross(across);
    const auto moved = [&](const Eigen::Vector3d& direction) {
      const Eigen::Vector3d step =
          hit.norm() * (direction - ray * normal_.dot(direction) / normal_.dot(ray));
      return outward.dot((board_from_lidar_.rotation * step).head<2>());
    };
    const double h = moved(across);
    const double v = moved(up);
    const double beam =
        std::hypot(h * 1e-3 * lidar.beam_horizontal_mrad, v * 1e-3 * lidar.beam_vertical_mrad);
    const double jitter = std::hypot(h, v) * lidar.angle_sigma_deg * std::numbers::pi / 180.0;
    const double total = std::hypot(beam, jitter);
    const double contrast = (kWhite - kBlack) * lidar.intensity_scale;
    const double slope = normal_pdf(d / total) / total;
    const double variance =
        std::pow(lidar.intensity_sigma / contrast, 2) + jitter_variance(d, beam, jitter);
    // Moving the board by δ: the hit moves along the ray, the pattern with the board.
    const Eigen::Matrix3d relative =
        ray * normal_.transpose() / normal_.dot(ray) - Eigen::Matrix3d::Identity();
    const Eigen::Vector3d e =
        board_from_lidar_.rotation.conjugate() * Eigen::Vector3d(outward.x(), outward.y(), 0.0);
    const Row6 j = slope * e.transpose() * relative * point_by_pose(hit);
    information += j.transpose() * j / variance;
  }

  const simulation::SimulatedRig& rig_;
  Rigid3 lidar_from_board_;
  Rigid3 board_from_lidar_;
  Eigen::Vector3d normal_;
};

}  // namespace

Matrix6d scene_information(const simulation::SimulatedRig& rig,
                           const simulation::SimulatedScene& scene, double corner_sigma_px) {
  LidarInformation lidar(rig, scene);
  const float reach = static_cast<float>(rig.target.outline().size_m().norm());
  const Eigen::Vector3f near = scene.lidar_from_board.translation.cast<float>();
  for (const Eigen::Vector3f& p : scene.cloud.points_m) {
    if ((p - near).squaredNorm() < reach * reach) lidar.add(p.cast<double>());
  }
  // A rotation about the normal is not determined by the plane, but by the circles; all six
  // directions are.
  const Matrix6d board_in_lidar = lidar.information.ldlt().solve(Matrix6d::Identity());
  const Matrix6d ad = rig.camera_from_lidar.adjoint();
  const Matrix6d board_in_camera = camera_information(rig, scene.camera_from_board, corner_sigma_px)
                                       .ldlt()
                                       .solve(Matrix6d::Identity());
  const Matrix6d covariance = board_in_camera + ad * board_in_lidar * ad.transpose();
  return covariance.ldlt().solve(Matrix6d::Identity());
}

}  // namespace lvcalib::study
