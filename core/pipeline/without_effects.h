// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "pipeline/modelled_movements.h"
#include "response/boundary_response.h"
#include "solve/feature_solver.h"

namespace lvcalib {

/// A board's corners in a result's camera with what effects do to their images taken out, as the
/// model predicts it. Where the camera does not see one of them, none is touched.
std::vector<CornerObservation> corners_without(const std::vector<EffectInUse>& effects,
                                               const ModelScales& scales,
                                               const CalibrationResult& result,
                                               std::vector<CornerObservation> corners,
                                               const Rigid3& camera_from_board);

/// What images, circles, edges and clouds would say without the effects of a model: what is
/// measured minus what the model says of these. Refers to the discovery and the result.
class WithoutEffects {
 public:
  /// `observations` are the result's scenes with a board as observations_of() makes them, `index`
  /// their places among its scenes; `target` is that of the solve.
  WithoutEffects(const Discovery& discovery, const CalibrationResult& result, const Target& target,
                 const std::vector<SceneObservations>& observations,
                 const std::vector<std::size_t>& index);

  /// The same scenes' planes, circles and corners. The planes are fitted again.
  [[nodiscard]] std::vector<SceneObservations> observations(
      std::vector<SceneObservations> measured) const;
  /// The board's returns of the k-th of the scenes, a bent board's height taken out, too.
  [[nodiscard]] Cloud returns(std::size_t k) const;
  /// The boundary response of the scenes in the model; `observations` without the effects. Nothing
  /// where it cannot be had.
  [[nodiscard]] std::optional<BoundaryResponse> boundary_response(
      const std::vector<SceneObservations>& observations) const;

 private:
  [[nodiscard]] std::optional<FittedPlane> plane(std::size_t k,
                                                 const Rigid3& lidar_from_board) const;
  [[nodiscard]] Eigen::Vector3d movement_about(std::size_t k, const Eigen::Vector3d& center_m,
                                               const BeamPoint& beam) const;
  [[nodiscard]] Eigen::Vector3d circle(std::size_t k, const SceneObservations& scene,
                                       const RefinedNode& node,
                                       const Eigen::Vector3d& place_m) const;

  const Discovery& discovery_;
  const CalibrationResult& result_;
  ModelledMovements movements_;
  Target target_;
  double darkness_;  // Of the board on average.
  std::vector<std::size_t> index_;
  std::vector<BoardBeams> beams_;
  std::vector<std::optional<FittedPlane>> planes_;
};

}  // namespace lvcalib
