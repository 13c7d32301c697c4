// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <Eigen/Core>

#include "cloud/cloud.h"

namespace lvcalib {

/// A place of a cloud where a camera may see an edge.
struct LidarEdge {
  enum class Kind {
    kRange,      ///< A surface ends before another one.
    kIntensity,  ///< A surface changes its brightness.
  };
  Kind kind = Kind::kRange;
  Eigen::Vector3d point_m = Eigen::Vector3d::Zero();  ///< LiDAR frame, on the nearer surface.
  /// Unit, LiDAR frame: how the scan crosses the edge, towards the farther (darker) side. What the
  /// edge does along itself one crossing does not tell.
  Eigen::Vector3d across = Eigen::Vector3d::Zero();
  double spacing_rad = 0.0;  ///< Angle between the points on either side.
};

/// Edges of a cloud, one for each time that the scan crosses one.
///
/// Points are followed along their lines in the order of the file, as the scanner took them. Where
/// that order says nothing (a cloud that was sorted or thinned), they are followed along rows and
/// columns of an angular grid about `axis` instead, of which only the half ahead is looked at. A
/// range edge is a jump by more than 0.1 m and 2 % of the range and four times what the range
/// changes between neighbours on either side, so that a slanted surface is none; up to one point
/// may lie between (a beam that met both sides). It stands halfway between the directions, at the
/// nearer range. An intensity edge is a step between the means of three points on either side, of
/// more than six of its standard deviations and a tenth of the cloud's contrast, on one flat
/// surface of six points on either side.
std::vector<LidarEdge> lidar_edges(const Cloud& cloud, const Eigen::Vector3d& axis);

}  // namespace lvcalib
