// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <Eigen/Core>

#include "refinement/board_refinement.h"
#include "refinement/transition.h"

namespace lvcalib {

/// Intensity at a point of the fitted plane.
struct PlaneSample {
  Eigen::Vector2d uv_m = Eigen::Vector2d::Zero();
  double intensity = 0.0;
};

/// The ring about a circle in which samples belong to its edge alone.
struct NodeWindow {
  double radius_m = 0.0;
  double inside_m = 0.0;   ///< Depth of the ring inside the circle.
  double outside_m = 0.0;  ///< Width outside, up to the nearest tag corner.
};

/// Window of the target's circles.
NodeWindow node_window(const Target& target);

/// Result of one local fit: the record for the history and the covariance of the wave.
struct NodeFit {
  NodeRecord record;
  Eigen::Matrix3d covariance_m2 = Eigen::Matrix3d::Zero();  ///< Of (Δc_u, Δc_v, Δr).
  double chi_square = 0.0;                                  ///< Of the bins about the wave.
  int degrees_of_freedom = 0;
  double weight = 0.0;  ///< Of the centre in the projection to the layout.
};

/// Levels of a node by robust medians well inside and well outside its edge, and the samples of
/// its ring unwrapped about `center`. Empty if a level cannot be measured; the record says why.
std::vector<UnwrappedSample> unwrap_node(const std::vector<PlaneSample>& samples,
                                         const Eigen::Vector2d& center_uv_m,
                                         const NodeWindow& window, double transition_sigma_m,
                                         NodeRecord& record);

/// Bins the unwrapped samples, finds the crossings, refuses bad bins and fits the wave; by the
/// estimator that the options name.
NodeFit fit_node(const std::vector<UnwrappedSample>& samples, NodeRecord record,
                 const NodeWindow& window, const TransitionModel& model,
                 const RefinementOptions& options);

}  // namespace lvcalib
