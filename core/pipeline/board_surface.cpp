// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/board_surface.h"

#include <cmath>

#include "model/scene_geometry.h"
#include "solve/board_returns.h"

namespace lvcalib {
namespace {

// Ten times what ranges scatter: what is farther off belongs to something else.
constexpr double kReach_m = 0.1;

std::optional<BoardSurface> by_step(const CalibrationResult& result, const std::string& scene,
                                    const ModelStep& step) {
  const FittedModel model = step.fitted();
  for (std::size_t s = 0; s < model.table.scenes.size(); ++s) {
    if (model.table.scenes[s].name != scene) continue;
    const auto samples = range_samples(model, static_cast<int>(s));
    if (samples.empty()) return std::nullopt;
    return BoardSurface{
        step.in_use().empty() ? BoardSurface::Against::kBase : BoardSurface::Against::kModel,
        step.state.camera_from_lidar.inverse() * step.state.camera_from_board[s],
        {result.target.outline(), samples}};
  }
  return std::nullopt;
}

std::optional<BoardSurface> by_solve(const CalibrationResult& result, const SceneResult& scene) {
  if (!result.forward || !result.print) return std::nullopt;
  const ForwardState& state = result.forward->state;
  std::size_t place = 0;
  for (const SceneSolution& solved : result.extrinsic.scenes) {
    if (!solved.used) continue;
    if (solved.name != scene.name) {
      ++place;
      continue;
    }
    if (place >= result.forward->noise.scenes.size() || place >= state.levels.size())
      return std::nullopt;
    const SceneNoise& noise = result.forward->noise.scenes[place];
    const Rigid3 pose = state.lidar_from_board(place);
    ReturnSelection selection = result.options.forward.selection;
    selection.uncovered = scene.edits.kept_patches;
    const BoardReturns returns =
        select_returns(scene.board_points, *result.print, pose, state.beam,
                       {noise.range_white_m, noise.range_black_m}, selection);
    const BoardPredictor predictor(*result.print, pose, state.levels[place], state.beam);
    const auto samples = range_samples(scene.board_points, returns.index, predictor);
    if (samples.empty()) return std::nullopt;
    return BoardSurface{BoardSurface::Against::kBase, pose, {result.target.outline(), samples}};
  }
  return std::nullopt;
}

std::optional<BoardSurface> by_plane(const CalibrationResult& result, const SceneResult& scene) {
  if (!scene.refinement) return std::nullopt;
  const Rigid3 board_from_lidar = scene.refinement->lidar_from_board.inverse();
  std::vector<SurfaceSample> samples;
  for (const Eigen::Vector3f& point : scene.board_points.points_m) {
    const Eigen::Vector3d p = point.cast<double>();
    const auto residual = scene.refinement->plane.range_residual_m(p);
    if (!residual || std::abs(*residual) > kReach_m) continue;
    const Eigen::Vector3d met = p - *residual * p.normalized();
    samples.push_back({(board_from_lidar * met).head<2>(), *residual});
  }
  if (samples.empty()) return std::nullopt;
  return BoardSurface{BoardSurface::Against::kPlane,
                      scene.refinement->lidar_from_board,
                      {result.target.outline(), samples}};
}

}  // namespace

std::optional<double> BoardSurface::mean_m(const Eigen::Vector3d& point_m) const {
  const SceneGeometry geometry(Rigid3(), lidar_from_board);
  const Eigen::Vector3d direction = point_m.normalized();
  const auto range = geometry.range_m(direction);
  if (!range || std::abs(point_m.norm() - *range) > kReach_m) return std::nullopt;
  return residuals.mean_m(geometry.board_m(*range * direction));
}

std::optional<BoardSurface> board_surface(const CalibrationResult& result, std::size_t scene,
                                          const ModelStep* step) {
  if (scene >= result.scenes.size()) return std::nullopt;
  const SceneResult& from = result.scenes[scene];
  std::optional<BoardSurface> out;
  if (step != nullptr) out = by_step(result, from.name, *step);
  if (!out) out = by_solve(result, from);
  if (!out) out = by_plane(result, from);
  return out;
}

}  // namespace lvcalib
