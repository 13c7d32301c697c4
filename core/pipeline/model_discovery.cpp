// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/model_discovery.h"

#include <cmath>

#include "base/statistics.h"
#include "model/residuals.h"
#include "pipeline/quality.h"

namespace lvcalib {
namespace {

bool takes_part(const SceneResult& scene) {
  return scene.used && scene.view && scene.refinement;
}

const SceneSolution* solution_of(const CalibrationResult& result, const std::string& name) {
  for (const SceneSolution& s : result.extrinsic.scenes) {
    if (s.name == name) return &s;
  }
  return nullptr;
}

// By how much farther black print reads than white with the effects of a model, square to the beam
// at a usual range.
double dark_offset_m(const Discovery& discovery) {
  constexpr double kRange_m = 3.0;
  const MeasurementTable table = empty_table(discovery.scales);
  BeamPoint beam;
  beam.range_m = kRange_m;
  double sum = 0.0;
  for (const EffectInUse& use : discovery.model) {
    for (const double darkness : {1.0, 0.0}) {
      beam.darkness = darkness;
      std::vector<Eigen::Vector3d> moves(static_cast<std::size_t>(use.values.size()),
                                         Eigen::Vector3d::Zero());
      use.effect->lidar(beam, table, use.shape, moves);
      for (std::size_t k = 0; k < moves.size(); ++k) {
        sum += (darkness > 0.5 ? 1.0 : -1.0) * use.values(static_cast<Eigen::Index>(k)) *
               beam.direction.dot(moves[k]);
      }
    }
  }
  return sum;
}

}  // namespace

DiscoveryInput discovery_input(const CalibrationResult& result) {
  DiscoveryInput input;
  input.target = result.target;
  input.camera = result.camera;
  input.sigma_px = result.extrinsic.sigma_px;
  input.refinement = result.options.refinement;
  input.state.camera_from_lidar = result.extrinsic.camera_from_lidar.transform;
  for (const SceneResult& scene : result.scenes) {
    const SceneSolution* solution = solution_of(result, scene.name);
    if (!takes_part(scene) || solution == nullptr) continue;
    SceneMeasurements m;
    m.name = scene.name;
    for (std::size_t k = 0; k < scene.view->corners.size(); ++k) {
      // Corners that the joint solve left out as outliers stay out.
      if (k < solution->corners.size() && solution->corners[k].used)
        m.corners.push_back(scene.view->corners[k]);
    }
    m.refinement = &*scene.refinement;
    m.board_points = &scene.board_points;
    input.scenes.push_back(std::move(m));
    input.state.camera_from_board.push_back(solution->camera_from_board);
  }
  if (result.forward && result.forward->state.levels.size() == input.scenes.size()) {
    const ForwardSolution& forward = *result.forward;
    input.print = result.print;
    input.noise = forward.noise;
    input.state = {forward.state.camera_from_lidar, forward.state.camera_from_board,
                   forward.state.levels, forward.state.beam};
  }
  return input;
}

Result<Discovery> discover(const CalibrationResult& result, const DiscoveryOptions& options,
                           const RunContext& context) {
  return discover_effects(discovery_input(result), options, context);
}

CalibrationResult with_model(CalibrationResult result, const Discovery& discovery) {
  // With nothing selected the calibration's own extrinsic stands: it rests on every return.
  const bool changed = !discovery.model.empty();
  if (changed) {
    result.extrinsic.camera_from_lidar = {discovery.state.camera_from_lidar, discovery.covariance};
  }
  std::size_t next = 0;
  for (const SceneResult& scene : result.scenes) {
    if (!changed || !takes_part(scene)) continue;
    for (SceneSolution& s : result.extrinsic.scenes) {
      if (s.name == scene.name && next < discovery.state.camera_from_board.size())
        s.camera_from_board = discovery.state.camera_from_board[next];
    }
    ++next;
  }
  result.budget = discovery.budget;
  result.covariance_with_budget = discovery.covariance_with_budget;
  // What an effect of the model explains is no longer left out.
  if (changed) result.covariance_total = discovery.covariance_with_budget;
  result.model_scales = discovery.scales;
  result.model.clear();
  for (const EffectFinding& f : discovery.effects) {
    for (const EffectInUse& use : discovery.model) {
      if (use.effect->info().id != f.id) continue;
      result.model.push_back({f.id, f.parameters, use.shape, f.shape_sigma, f.spec});
    }
  }
  result.modelled_dark_offset_m = dark_offset_m(discovery);
  // What the model explains is no fault of the result any more.
  if (changed) judge_quality(result, result.options.quality);
  return result;
}

}  // namespace lvcalib
