// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "detection/board_view.h"
#include "model/measurement_table.h"
#include "model/scene_geometry.h"

namespace lvcalib {

/// What a finished calibration keeps of one scene.
struct SceneMeasurements {
  std::string name;
  std::vector<CornerObservation> corners;
  const BoardRefinement* refinement = nullptr;
  const Cloud* board_points = nullptr;
};

struct TableOptions {
  int max_rows_per_scene = 20000;  ///< Range rows, spread evenly over board cells and print.
  double gate = 6.0;               ///< Points farther off the board (in σ) are not on it.
  /// Footprint (rad, one σ) where no circles measure it; decides which points see one print only.
  double footprint_rad = 0.001;
  RefinementOptions refinement;  ///< How edges are measured again (see remeasure_edges()).
};

/// Appends a scene's corners, each as noisy as `sigma_px`, and lists the features that they belong
/// to.
void add_corners(const SceneMeasurements& input, int scene, const ModelState& state,
                 double sigma_px, MeasurementTable& table);

/// Builds the table at a state. The corners' noise is measured (see corner_noise);
/// `sigma_px` stands in where there are too few corners for that.
/// Every scene's board pose is in `state` in the same order.
MeasurementTable build_table(const std::vector<SceneMeasurements>& scenes, const Target& target,
                             const Camera& camera, const ModelState& state, double sigma_px,
                             const TableOptions& options);

/// What a table was made of. A copy: a calibration may be gone by the time it is made again.
struct TableSource {
  std::vector<std::vector<CornerObservation>> corners;  ///< Per scene.
  std::vector<Cloud> board_points;                      ///< Per scene.
  std::vector<BoardRefinement> refinements;             ///< Per scene, the last iteration alone.
  double sigma_px = 0.0;
  TableOptions options;
};

/// The same table with its points placed on the board by another state. The table needs its source.
MeasurementTable rebuild_table(const MeasurementTable& table, const ModelState& state);

/// Measures the edges of a table anew, from other clouds or refinements of the same scenes.
void build_edges(const std::vector<SceneMeasurements>& scenes, const ModelState& state,
                 const TableOptions& options, MeasurementTable& table);

/// Gradient of an edge's outward coordinate by the LiDAR's angles (see BoundaryRow).
Eigen::Vector2d edge_normal(const SceneGeometry& geometry, const BeamPoint& beam, double psi_rad);

}  // namespace lvcalib
