// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "solve/feature_problem.h"

namespace lvcalib {

/// Residuals of every corner of a scene (measured − predicted, px); a corner that the camera could
/// not image at this pose is marked unused. `mask` is that of the scene's corners.
std::vector<CornerResidual> corner_residuals(const SceneObservations& scene, const Camera& camera,
                                             const Rigid3& camera_from_board,
                                             const std::vector<bool>& mask);

/// Residuals of every node of a scene (measured − CAD node, m, board frame).
std::vector<NodeResidual> node_residuals(const SceneObservations& scene,
                                         const Rigid3& camera_from_lidar,
                                         const Rigid3& camera_from_board,
                                         const std::vector<bool>& mask);

/// Heights of the plane's probe points over the measured plane, mm; for targets without nodes.
std::vector<double> plane_heights_mm(const SceneObservations& scene, const Target& target,
                                     const Rigid3& camera_from_lidar,
                                     const Rigid3& camera_from_board);

}  // namespace lvcalib
