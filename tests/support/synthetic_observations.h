// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Observations of a board as both sensors would report them, drawn straight from their stated
// noise: what the joint solve is given, without images and clouds.

#include <string>
#include <vector>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

#include "base/random.h"
#include "solve/feature_solver.h"

namespace lvcalib::test {

struct ObservationNoise {
  double corner_px = 0.08;
  double node_m = 4e-4;          ///< Per in-plane axis.
  double plane_height_m = 1e-4;  ///< At the plane's centre.
  double plane_slope = 3e-4;     ///< Along either axis, rad.
};

inline Camera test_camera() {
  Camera camera;
  camera.width_px = 1440;
  camera.height_px = 900;
  camera.fx = 1040;
  camera.fy = 1038;
  camera.cx = 715;
  camera.cy = 455;
  camera.distortion << -0.08, 0.03, 2e-4, -3e-4, 0, 0, 0, 0;
  return camera;
}

/// A usual mount: LiDAR x forward, z up; camera z forward, y down; a few degrees off.
inline Rigid3 test_extrinsic() {
  Eigen::Matrix3d swap;
  swap << 0, -1, 0, 0, 0, -1, 1, 0, 0;
  return {so3_exp({0.05, -0.07, 0.03}) * Eigen::Quaterniond(swap), {0.08, -0.11, 0.05}};
}

/// The board's centre at `center_m` in the camera frame, facing the camera, then turned by
/// `tilt` (rotation vector in the camera frame).
inline Rigid3 facing_board(const Target& target, const Eigen::Vector3d& center_m,
                           const Eigen::Vector3d& tilt) {
  const Eigen::Matrix3d facing = Eigen::Vector3d(1, -1, -1).asDiagonal();
  const Eigen::Quaterniond rotation = so3_exp(tilt) * Eigen::Quaterniond(facing);
  const Eigen::Vector2d c = target.outline().center_m();
  return {rotation, center_m - rotation * Eigen::Vector3d(c.x(), c.y(), 0.0)};
}

/// Well-spread boards: the first facing, then tilted in changing directions.
inline Rigid3 spread_board(const Target& target, int scene) {
  static const Eigen::Vector3d centers[] = {
      {0.0, 0.1, 2.6}, {-0.5, 0.0, 3.1}, {0.5, -0.1, 2.9}, {0.2, 0.2, 3.5}, {-0.3, -0.1, 2.4}};
  static const Eigen::Vector3d tilts[] = {
      {0.1, 0.05, 0.0}, {0.1, 0.5, 0.2}, {-0.45, -0.2, -0.1}, {0.4, -0.3, 0.15}, {0.0, -0.5, 0.3}};
  return facing_board(target, centers[scene % 5], tilts[scene % 5]);
}

inline Eigen::Vector2d random_2d(Random& random, double sigma) {
  const double x = random.normal();
  const double y = random.normal();
  return sigma * Eigen::Vector2d(x, y);
}

inline Rigid3 disturbed(const Rigid3& pose, Random& random, double translation_m,
                        double rotation_rad) {
  Vector6d xi;
  for (int k = 0; k < 6; ++k) xi(k) = (k < 3 ? translation_m : rotation_rad) * random.normal();
  return {so3_exp(xi.tail<3>()) * pose.rotation, pose.translation + xi.head<3>()};
}

inline std::vector<CornerObservation> observed_corners(const Target& target, const Camera& camera,
                                                       const Rigid3& camera_from_board,
                                                       double sigma_px, Random& random) {
  std::vector<CornerObservation> corners;
  for (const TargetTag& tag : target.tags()) {
    const auto board = target.tag_corners_m(tag);
    for (int k = 0; k < 4; ++k) {
      const Eigen::Vector2d& p = board[static_cast<std::size_t>(k)];
      const auto pixel = camera.project(camera_from_board * Eigen::Vector3d(p.x(), p.y(), 0.0));
      if (!pixel) continue;
      corners.push_back({tag.id, k, p, *pixel + random_2d(random, sigma_px), sigma_px});
    }
  }
  return corners;
}

/// The pose that fits the corners best: what detection hands on.
inline Rigid3 pose_from_corners(const std::vector<CornerObservation>& corners, const Camera& camera,
                                Rigid3 camera_from_board) {
  for (int i = 0; i < 8; ++i) {
    Matrix6d normal = Matrix6d::Zero();
    Vector6d rhs = Vector6d::Zero();
    for (const CornerObservation& c : corners) {
      const Eigen::Vector3d p =
          camera_from_board * Eigen::Vector3d(c.board_m.x(), c.board_m.y(), 0);
      Eigen::Matrix<double, 2, 3> by_point;
      const auto pixel = camera.project(p, &by_point);
      if (!pixel) continue;
      Eigen::Matrix<double, 3, 6> by_pose;
      by_pose << Eigen::Matrix3d::Identity(), -skew(p);
      const Eigen::Matrix<double, 2, 6> j = by_point * by_pose;
      normal += j.transpose() * j;
      rhs += j.transpose() * (c.pixel - *pixel);
    }
    camera_from_board = se3_exp(normal.ldlt().solve(rhs)) * camera_from_board;
  }
  return camera_from_board;
}

/// The board's plane with an error drawn from its own covariance.
inline FittedPlane observed_plane(const Target& target, const Rigid3& lidar_from_board,
                                  const ObservationNoise& noise, Random& random) {
  const Eigen::Matrix3d R = lidar_from_board.rotation.toRotationMatrix();
  const Eigen::Vector2d c = target.outline().center_m();
  const double height = noise.plane_height_m * random.normal();
  const Eigen::Vector2d slope = random_2d(random, noise.plane_slope);
  FittedPlane plane;
  plane.normal = (R.col(2) - slope.x() * R.col(0) - slope.y() * R.col(1)).normalized();
  plane.center_m = lidar_from_board * Eigen::Vector3d(c.x(), c.y(), 0.0) + height * R.col(2);
  plane.axis_u = (R.col(0) - plane.normal * plane.normal.dot(R.col(0))).normalized();
  plane.axis_v = plane.normal.cross(plane.axis_u);
  plane.covariance.diagonal() << noise.plane_height_m * noise.plane_height_m,
      noise.plane_slope * noise.plane_slope, noise.plane_slope * noise.plane_slope;
  plane.sigma_range_m = 0.008;
  plane.inliers = 5000;
  return plane;
}

inline SceneObservations observed_scene(const std::string& name, const Target& target,
                                        const Camera& camera, const Rigid3& camera_from_lidar,
                                        const Rigid3& camera_from_board,
                                        const ObservationNoise& noise, Random& random) {
  SceneObservations scene;
  scene.name = name;
  const Rigid3 lidar_from_board = camera_from_lidar.inverse() * camera_from_board;
  scene.corners = observed_corners(target, camera, camera_from_board, noise.corner_px, random);
  scene.plane = observed_plane(target, lidar_from_board, noise, random);
  scene.camera_from_board = pose_from_corners(scene.corners, camera, camera_from_board);
  // As rough as coarse localization leaves it.
  scene.lidar_from_board = disturbed(lidar_from_board, random, 0.002, 0.002);
  for (const TargetNode& node : target.nodes()) {
    RefinedNode refined;
    refined.id = node.id;
    refined.valid = true;
    refined.board_m = node.center_m;
    const Eigen::Vector3d truth =
        lidar_from_board * Eigen::Vector3d(node.center_m.x(), node.center_m.y(), 0.0);
    refined.center_uv_m = scene.plane.to_plane(truth) + random_2d(random, noise.node_m);
    refined.covariance_m2 = noise.node_m * noise.node_m * Eigen::Matrix2d::Identity();
    refined.center_lidar_m = scene.plane.to_lidar(refined.center_uv_m);
    refined.valid_bins = 24;
    scene.nodes.push_back(refined);
  }
  return scene;
}

/// `count` well-spread scenes named A, B, ….
inline std::vector<SceneObservations> observed_scenes(int count, const Target& target,
                                                      const Camera& camera,
                                                      const Rigid3& camera_from_lidar,
                                                      const ObservationNoise& noise,
                                                      std::uint64_t seed) {
  Random random(seed);
  std::vector<SceneObservations> scenes;
  for (int s = 0; s < count; ++s) {
    scenes.push_back(observed_scene(std::string(1, static_cast<char>('A' + s)), target, camera,
                                    camera_from_lidar, spread_board(target, s), noise, random));
  }
  return scenes;
}

}  // namespace lvcalib::test
