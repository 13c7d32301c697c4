// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include "detection/board_view.h"
#include "model/linear_model.h"
#include "model/measurement_table.h"
#include "solve/forward_problem.h"

namespace lvcalib {

/// What a finished calibration keeps of one scene.
struct SceneMeasurements {
  std::string name;
  std::vector<CornerObservation> corners;
  const Cloud* board_points = nullptr;
  std::vector<BoardOutline> uncovered = {};  ///< See ReturnSelection.
};

/// What a table is made of: the scenes in use, and what the joint solve found.
struct TableInput {
  std::vector<SceneMeasurements> scenes;
  Camera camera;
  std::shared_ptr<const BlurredPrint> print;
  ForwardNoise noise;
  double sigma_px = 0.0;  ///< Of corners.
};

struct TableOptions {
  int max_rows_per_scene = 20000;  ///< Of each kind, spread evenly over board cells and print.
};

/// Appends a scene's corners, each as noisy as `sigma_px`, and lists the features that they belong
/// to.
void add_corners(const SceneMeasurements& input, int scene, const ModelState& state,
                 double sigma_px, MeasurementTable& table);

/// Every measurement of a joint solve with every covariate: corners, and of the returns that the
/// solve keeps (what it has refused stays out) the ranges, the intensities on plain print, and
/// those in the blur of an edge, which are told as the distance by which that edge lies off.
///
/// Noise is that of replicates (see Replicates), so that what is missing in the model does not
/// count as noise; in edges the beam's jitter joins it. Rows that the solve weighs down keep their
/// weight, the same whatever is added to the model. `state` needs a pose and levels per scene;
/// variances of structure are those of the input's noise. More than options.max_rows_per_scene of a
/// kind are thinned evenly over the board.
MeasurementTable print_table(const TableInput& input, const ModelState& state,
                             const TableOptions& options, const RunContext& context);

}  // namespace lvcalib
