// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/without_effects.h"

#include <cmath>
#include <utility>

#include "model/residuals.h"
#include "pipeline/refusals.h"

namespace lvcalib {

std::vector<CornerObservation> corners_without(const std::vector<EffectInUse>& effects,
                                               const ModelScales& scales,
                                               const CalibrationResult& result,
                                               std::vector<CornerObservation> corners,
                                               const Rigid3& camera_from_board) {
  MeasurementTable table = empty_table(scales);
  table.target = result.target;
  table.camera = result.camera;
  ModelState state;
  state.camera_from_board = {camera_from_board};
  SceneMeasurements scene;
  scene.corners = corners;
  add_corners(scene, 0, state, 1.0, table);
  const auto without = residuals_of(table, state, {}, Channel::kCorner);
  const auto with = residuals_of(table, state, effects, Channel::kCorner);
  if (with.values.size() != without.values.size() || with.values.size() != 2 * corners.size())
    return corners;  // A corner that no camera sees has no rows; then none is touched.
  std::size_t next = 0;
  for (CornerObservation& c : corners) {
    for (Eigen::Index axis = 0; axis < 2; ++axis, ++next)
      c.pixel(axis) += with.values[next] - without.values[next];
  }
  return corners;
}

WithoutEffects::WithoutEffects(const Discovery& discovery, const CalibrationResult& result,
                               const Target& target,
                               const std::vector<SceneObservations>& observations,
                               const std::vector<std::size_t>& index)
    : discovery_(discovery),
      result_(result),
      movements_(discovery, result),
      target_(target),
      darkness_(black_share(target)),
      index_(index) {
  for (std::size_t k = 0; k < observations.size(); ++k) {
    const Rigid3& lidar_from_board = observations[k].lidar_from_board;
    beams_.emplace_back(result, index[k], lidar_from_board, discovery.scales, darkness_);
    planes_.push_back(plane(k, lidar_from_board));
  }
}

// Fitted to the returns, each with what the effects do to its range taken out. A robust plane does
// not follow its returns' mean: black print that reads far off hardly pulls it. Nothing where no
// plane fits.
std::optional<FittedPlane> WithoutEffects::plane(std::size_t k,
                                                 const Rigid3& lidar_from_board) const {
  const BoardBeams& beams = beams_[k];
  Cloud corrected = beams.cloud();
  for (std::size_t i = 0; i < corrected.size(); ++i) {
    const auto beam = beams.of(i);
    if (!beam) continue;
    const Eigen::Vector3d bend(0.0, 0.0, movements_.print(beam->board_m, target_).z());
    const double farther_m = beams.geometry()
                                 .range_row(beam->direction)
                                 .dot(movements_.point(*beam) + lidar_from_board.rotation * bend);
    corrected.points_m[i] -= (farther_m * beam->direction).cast<float>();
  }
  const auto plane = fit_board_plane(corrected, target_, lidar_from_board);
  if (!plane) return std::nullopt;
  return plane->plane;
}

// What the effects do to points, as a mean over the returns at a circle's edge: when they were
// taken and how the beam moved then. Where there are none, what they do to `beam` itself.
Eigen::Vector3d WithoutEffects::movement_about(std::size_t k, const Eigen::Vector3d& center_m,
                                               const BeamPoint& beam) const {
  constexpr double kWidth = 0.3;  // Of the radius, on either side of the edge.
  const double radius_m = target_.circle_radius_m;
  const BoardBeams& beams = beams_[k];
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double count = 0.0;
  for (std::size_t i = 0; i < beams.cloud().size(); ++i) {
    const Eigen::Vector3d from_middle = beams.cloud().points_m[i].cast<double>() - center_m;
    if (!(std::abs(from_middle.norm() - radius_m) < kWidth * radius_m)) continue;
    const auto one = beams.of(i);
    if (!one) continue;
    sum += movements_.point(*one);
    count += 1.0;
  }
  return count > 0.0 ? Eigen::Vector3d(sum / count) : movements_.point(beam);
}

// The place of a circle's centre. Its height is the plane's, its place on it its own. A board that
// is bent is met elsewhere along the ray.
Eigen::Vector3d WithoutEffects::circle(std::size_t k, const SceneObservations& scene,
                                       const RefinedNode& node,
                                       const Eigen::Vector3d& place_m) const {
  const Eigen::Vector3d bent = movements_.print(node.board_m, target_);
  const BeamPoint beam = beam_towards(place_m, index_[k], scene.lidar_from_board, darkness_);
  const Eigen::Vector3d moved = movements_.spot(beam) + movement_about(k, place_m, beam);
  const Eigen::Vector3d place = place_m - moved;
  const auto on_plane = scene.plane.ray_hit(place);
  Eigen::Vector3d out = on_plane ? scene.plane.to_lidar(*on_plane) : place;
  const Eigen::Vector3d normal = scene.lidar_from_board.rotation * Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d ray = place.normalized();
  out += bent.z() * (ray / normal.dot(ray) - normal);
  out -= scene.lidar_from_board.rotation * Eigen::Vector3d(bent.x(), bent.y(), 0.0);
  return out;
}

std::vector<SceneObservations> WithoutEffects::observations(
    std::vector<SceneObservations> measured) const {
  for (std::size_t k = 0; k < measured.size(); ++k) {
    SceneObservations& o = measured[k];
    if (planes_[k]) o.plane = *planes_[k];
    for (RefinedNode& node : o.nodes) {
      if (!node.valid) continue;
      node.center_lidar_m = circle(k, o, node, node.center_lidar_m);
      node.raw_lidar_m = circle(k, o, node, node.raw_lidar_m);
    }
    o.corners = corners_without(discovery_.model, discovery_.scales, result_, std::move(o.corners),
                                o.camera_from_board);
  }
  return measured;
}

Cloud WithoutEffects::returns(std::size_t k) const {
  const BoardBeams& beams = beams_[k];
  Cloud out = beams.cloud();
  const Eigen::Vector3d normal = beams.geometry().normal();
  for (std::size_t i = 0; i < out.size(); ++i) {
    const auto beam = beams.of(i);
    if (!beam) continue;
    const double bent_m =
        movements_.print(beam->board_m, target_).z() / normal.dot(beam->direction);
    out.points_m[i] -= (movements_.point(*beam) + bent_m * beam->direction).cast<float>();
  }
  return out;
}

std::optional<BoundaryResponse> WithoutEffects::boundary_response(
    const std::vector<SceneObservations>& observations) const {
  std::vector<Cloud> clouds(observations.size());
  std::vector<BoardRefinement> refined(observations.size());
  std::vector<ResponseInput> inputs;
  const auto boards = modelled_boards(discovery_, result_);
  for (std::size_t k = 0; k < observations.size(); ++k) {
    const SceneResult& scene = result_.scenes[index_[k]];
    const std::optional<Rigid3>& camera_from_board = boards[index_[k]];
    if (!camera_from_board || scene.refinement->nodes.empty()) continue;
    clouds[k] = returns(k);
    refined[k] = *scene.refinement;
    refined[k].nodes = observations[k].nodes;
    refined[k].plane = observations[k].plane;
    refined[k].lidar_from_board = discovery_.state.camera_from_lidar.inverse() * *camera_from_board;
    inputs.push_back({scene.name, &clouds[k], &refined[k], covered_parts(result_, scene.name)});
  }
  auto response =
      calibrate_boundary_response(inputs, target_, result_.options.response, RunContext{});
  if (!response) return std::nullopt;
  return std::move(*response);
}

}  // namespace lvcalib
