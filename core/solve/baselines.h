// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "solve/feature_problem.h"

namespace lvcalib {

/// What every method is given.
struct MethodInput : FeatureInput {
  ObservationMask mask;
  NoiseScales scales;
  std::vector<Rigid3> camera_from_board;  ///< From the corners alone.
};

/// Closed-form alignment of the nodes seen by both sensors (3D-SVD; with `weighted` W-SVD).
Rigid3 solve_by_alignment(const MethodInput& input, bool weighted);

/// Reprojection of the LiDAR nodes onto the pixels where the camera's board pose has them.
Rigid3 solve_by_reprojection(const MethodInput& input);

/// The joint objective, its node scale widened to what the residuals say.
Rigid3 solve_by_joint(const MethodInput& input, const Rigid3& start);

/// The joint objective once, with σ as stated: nothing widened, nothing left out.
Rigid3 solve_as_stated(const MethodInput& input, const Rigid3& start);

/// The scenes with their nodes as initialised, before the angle–distance refinement.
std::vector<SceneObservations> with_raw_nodes(std::vector<SceneObservations> scenes);

}  // namespace lvcalib
