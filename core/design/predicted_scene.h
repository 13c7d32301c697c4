// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "cloud/cloud.h"
#include "design/board_grid.h"
#include "model/mixed_model.h"

namespace lvcalib {

/// Time, scan velocity and line of a laser shot, as they occur together.
struct BeamTrait {
  double time_s = 0.0;
  Eigen::Vector2d scan_rad_s = Eigen::Vector2d::Zero();
  int line = 0;
};

/// What LiDAR and camera would measure of a board: enough to predict the rows of a scene that
/// nobody has taken. Angles in the LiDAR frame.
struct SensorModel {
  Eigen::Vector2d azimuth_rad{-0.6, 0.6};  ///< Field of view; all around if wider than 2π.
  Eigen::Vector2d elevation_rad{-0.6, 0.6};
  double points_per_sr = 1e5;  ///< Kept points per steradian of one scene.
  double range_sigma_m = 0.01;
  double intensity_sigma = 0.2;  ///< Of the logarithm.
  double footprint_rad = 0.001;  ///< One σ of the beam.
  double edge_noise = 0.1;       ///< σ of an intensity in an edge over the print's contrast.
  double corner_sigma_px = 0.05;
  std::vector<BeamTrait> traits{BeamTrait{}};
  bool round = false;          ///< The field of view is an ellipse instead of a rectangle.
  int lines_by_elevation = 0;  ///< Lines spread evenly over the elevations; 0: as in `traits`.
};

/// The model of the sensors that took a table's scenes. The field of view is what the boards have
/// covered, a quarter wider on every side.
SensorModel sensors_of(const MeasurementTable& table);

/// Sets the field of view to what a whole cloud of the LiDAR covers, without the outermost returns:
/// all around if no gap in azimuth is wider than a tenth of a turn, an ellipse if hardly a return
/// lies in the corners of the rectangle. Clouds of fewer than a hundred points change nothing.
void take_field_of_view(const Cloud& cloud, SensorModel& sensors);

/// True if the whole board is in the LiDAR's field of view and its front is turned to it.
bool lidar_sees(const SensorModel& sensors, const Target& target, const Rigid3& lidar_from_board);

/// Appends the rows that the sensors would measure at a pose, without noise: ranges and intensities
/// at places spread evenly over the board, weighted as the many points that there would be, and all
/// corners. The table must have camera, target, print, levels and lines; `state` gets the pose and
/// the table's levels, and the beam of the sensors.
void append_predicted_scene(const GridPose& pose, const SensorModel& sensors,
                            MeasurementTable& table, ModelState& state);

/// What a pose's worth is told by. Refers to all of it.
struct PredictionModel {
  const SensorModel& sensors;
  const MeasurementTable& like;  ///< Gives target, camera, levels and lines.
  const Rigid3& camera_from_lidar;
  const EffectColumnsList& columns;
  const ColumnSubset& subset;
  const ModelVariances& variances;
};

/// What each pose would say about the extrinsic and all columns, in the order of `poses`; nothing
/// when stopped.
std::vector<Eigen::MatrixXd> predicted_information(const std::vector<GridPose>& poses,
                                                   const PredictionModel& model,
                                                   const RunContext& context);

}  // namespace lvcalib
