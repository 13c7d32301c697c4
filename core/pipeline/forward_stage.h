// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "pipeline/calibration.h"
#include "solve/feature_solver.h"
#include "solve/uncertainty_report.h"

namespace lvcalib {

/// What the solves need of every scene that got so far as a refined board; `use` says which scenes
/// are wanted, `index` then which scene of the result an observation is.
std::vector<SceneObservations> observations_of(const CalibrationResult& result,
                                               const std::vector<bool>& use,
                                               std::vector<std::size_t>& index);

/// The target as the solve sees it: where no cloud's intensity shows the circles, a board without.
Target target_in_use(const CalibrationResult& result,
                     const std::vector<SceneObservations>& observations);

/// What the joint solve takes of the scenes that `start` uses; points into `result`.
std::vector<ForwardScene> forward_scenes(const CalibrationResult& result,
                                         const std::vector<SceneObservations>& observations,
                                         const std::vector<std::size_t>& index,
                                         const ExtrinsicSolution& start);

/// The joint solve over every corner and return of the scenes that `start` uses; `index` tells
/// which scene of the result an observation is. Clouds whose intensity is missing or the same
/// everywhere take part with their ranges.
Result<ForwardSolution> solve_every_return(const CalibrationResult& result,
                                           const std::vector<SceneObservations>& observations,
                                           const std::vector<std::size_t>& index,
                                           const ExtrinsicSolution& start,
                                           const ForwardOptions& options,
                                           const RunContext& context);

/// The same observations at the forward solution, or at that of a model with effects: pose,
/// covariance, poses of the boards in use, residuals, the influence of single scenes by `subset`.
/// What was left out stays as in `start`. `uses_intensity`: two scenes are enough to leave one out.
struct ReportedPose {
  UncertainRigid3 camera_from_lidar;
  std::vector<Rigid3> camera_from_board;
  bool uses_intensity = true;
};
ExtrinsicSolution report_forward(const ReportedPose& pose, const SubsetSolver& subset,
                                 const ExtrinsicSolution& start, const FeatureInput& in);
ReportedPose pose_of(const ForwardSolution& forward);

/// A covariance of the result's extrinsic with what goes with it of estimated intrinsics. Under a
/// model with effects these are held where the calibration had put them. What `extrinsic` has
/// beyond the calibration's own (the total one) counts as independent of the intrinsics.
ProjectionCovariance projection_covariance(const CalibrationResult& result,
                                           const Matrix6d& extrinsic);

/// Solves the forward model for some of the observations of `start`.
SubsetSolver forward_subsets(const ForwardSolution& forward, const ExtrinsicSolution& start);

/// The same for a model with effects, to first order about its pose; nothing without a fit.
SubsetSolver model_subsets(const std::shared_ptr<const ModelFit>& fit,
                           const Rigid3& camera_from_lidar, const ExtrinsicSolution& start);

}  // namespace lvcalib
