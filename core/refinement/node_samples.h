// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "cloud/cloud.h"
#include "cloud/plane.h"
#include "refinement/board_refinement.h"
#include "target/target.h"

namespace lvcalib {

/// One LiDAR point beside a circle's edge, as the angle–distance plot shows it.
struct NodeSample {
  double angle_rad = 0.0;   ///< Polar angle ψ about the centre in the plane's (u, v) axes.
  double distance_m = 0.0;  ///< From the circle, outside positive.
  double intensity = 0.0;
  std::uint32_t point = 0;  ///< Index into the cloud.
};

/// The points of a board's cloud on its plane (ray ∩ plane), ready to be unwrapped about any
/// centre.
class NodeSampler {
 public:
  NodeSampler() = default;
  /// A cloud without intensity gives samples of intensity 0.
  NodeSampler(const Cloud& board_points, const FittedPlane& plane, const Target& target);

  /// Samples of the ring about a centre that belong to its edge alone (see node_window()); empty
  /// for targets without circles.
  [[nodiscard]] std::vector<NodeSample> around(const Eigen::Vector2d& center_uv_m) const;

 private:
  struct Point {
    Eigen::Vector2f uv_m;
    float intensity;
    std::uint32_t index;
  };
  std::vector<Point> points_;
  double radius_m_ = 0.0;
  double inside_m_ = 0.0;
  double outside_m_ = 0.0;
};

/// Indices (ascending) of the points that lie in the ring of any node, at its refined centre.
std::vector<std::uint32_t> boundary_points(const Cloud& board_points, const Target& target,
                                           const BoardRefinement& refinement);

/// The way of one node's centre through the iterations, in the board frame of the result and
/// relative to the place where the model has the node.
struct CenterPath {
  int id = 0;
  bool valid = false;
  Eigen::Vector2d board_m = Eigen::Vector2d::Zero();  ///< The model's place.
  std::vector<Eigen::Vector2d> predicted_m;  ///< Layout centre at the start of every iteration.
  std::vector<Eigen::Vector2d> measured_m;   ///< The same plus the local correction.
  Eigen::Vector2d final_m = Eigen::Vector2d::Zero();        ///< Refined centre.
  Eigen::Matrix2d covariance_m2 = Eigen::Matrix2d::Zero();  ///< Of it, along the board's axes.
};
std::vector<CenterPath> center_paths(const BoardRefinement& refinement);

}  // namespace lvcalib
