// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "model/scene_geometry.h"
#include "pipeline/calibration.h"
#include "selection/discovery.h"

namespace lvcalib {

/// The scenes whose boards a model has a pose of.
bool takes_part(const SceneResult& scene);

/// T_camera_board of every scene by the model; nothing of a scene that has no part in it.
std::vector<std::optional<Rigid3>> modelled_boards(const Discovery& discovery,
                                                   const CalibrationResult& result);

/// What the effects of a model do to a LiDAR point (the measured from the true one), to the place
/// whose light is measured, and to the print. Refers to the discovery.
class ModelledMovements {
 public:
  /// Beams are of the result's scenes, by their place among them; a scene that has no part in the
  /// model is told by those around it.
  ModelledMovements(const Discovery& discovery, const CalibrationResult& result);

  /// LiDAR frame, m.
  [[nodiscard]] Eigen::Vector3d point(const BeamPoint& beam) const;
  /// By how much the print is seen beside its place (LiDAR frame, m).
  [[nodiscard]] Eigen::Vector3d spot(const BeamPoint& beam) const;
  /// Board frame, m.
  [[nodiscard]] Eigen::Vector3d print(const Eigen::Vector2d& board_m, const Target& target) const;

 private:
  const std::vector<EffectInUse>& model_;
  MeasurementTable table_;
};

/// A scene's returns on the board as effects see them. Refers to the cloud and the scales.
class BoardBeams {
 public:
  /// `darkness`: of a return without an intensity.
  BoardBeams(const CalibrationResult& result, std::size_t scene, const Rigid3& lidar_from_board,
             const ModelScales& scales, double darkness);

  [[nodiscard]] const Cloud& cloud() const { return cloud_; }
  [[nodiscard]] const SceneGeometry& geometry() const { return geometry_; }
  /// Nothing where the ray misses the board's plane.
  [[nodiscard]] std::optional<BeamPoint> of(std::size_t i) const;

 private:
  const Cloud& cloud_;
  int scene_;
  SceneGeometry geometry_;
  const ModelScales& scales_;
  const Target& target_;
  bool dark_;
  double darkness_;
  std::vector<Eigen::Vector2d> velocities_;
};

/// The beam towards a point near a board, of no line in particular: what is told of a circle is a
/// mean over many returns.
BeamPoint beam_towards(const Eigen::Vector3d& point_m, std::size_t scene,
                       const Rigid3& lidar_from_board, double darkness);

/// Share of the board that is black: how dark the board is on average.
double black_share(const Target& target);

/// By how much farther black print reads than white with the effects of a model, square to the beam
/// at a usual range.
double dark_offset_m(const ModelledMovements& movements);

/// By which share print and boards look larger than the target says, by the model.
struct ModelledScales {
  Eigen::Vector2d print = Eigen::Vector2d::Zero();  ///< Along the board's axes, over all scenes.
  std::vector<double> scenes;                       ///< Mean of both axes; 0 outside the model.
};
ModelledScales modelled_scales(const Discovery& discovery, const ModelledMovements& movements,
                               const CalibrationResult& result);

}  // namespace lvcalib
