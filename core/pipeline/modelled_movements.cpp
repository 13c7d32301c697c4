// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/modelled_movements.h"

#include <algorithm>
#include <span>

#include "model/correction.h"
#include "model/scan_velocity.h"

namespace lvcalib {
namespace {

// What the effects of a model do together; `add` writes what one unit of each parameter does.
template <class Add>
Eigen::Vector3d sum_over(const std::vector<EffectInUse>& model, const Add& add) {
  Eigen::Vector3d out = Eigen::Vector3d::Zero();
  for (const EffectInUse& use : model) {
    std::vector<Eigen::Vector3d> moves(static_cast<std::size_t>(use.values.size()),
                                       Eigen::Vector3d::Zero());
    add(use, std::span<Eigen::Vector3d>(moves));
    for (std::size_t k = 0; k < moves.size(); ++k)
      out += use.values(static_cast<Eigen::Index>(k)) * moves[k];
  }
  return out;
}

// By which share the print is larger along its axes than the target says, over the whole board.
Eigen::Vector2d print_scale(const ModelledMovements& movements, const Target& target) {
  const BoardOutline outline = target.outline();
  const Eigen::Vector2d half = 0.5 * outline.size_m();
  const auto at = [&](double x, double y) {
    return Eigen::Vector2d(
        movements.print(outline.center_m() + Eigen::Vector2d(x, y), target).head<2>());
  };
  return {(at(half.x(), 0).x() - at(-half.x(), 0).x()) / (2.0 * half.x()),
          (at(0, half.y()).y() - at(0, -half.y()).y()) / (2.0 * half.y())};
}

// By which share a board looks larger along its axes than it is: one that reads farther does, one
// whose angles are stretched, and a tilted one whose far side reads farther still. The slope of
// what moves its own returns over their place on it: what the model does may depend on their time,
// line and print.
Eigen::Vector2d seen_scale(const ModelledMovements& movements, const BoardOutline& outline,
                           const BoardBeams& beams, const Rigid3& lidar_from_board) {
  constexpr std::size_t kMost = 2000;  // A mean of smooth functions.
  const Rigid3 board_from_lidar = lidar_from_board.inverse();
  const std::size_t stride = 1 + beams.cloud().size() / kMost;
  double count = 0.0;
  Eigen::Array2d place = Eigen::Array2d::Zero(), squares = place, aside = place, products = place;
  for (std::size_t i = 0; i < beams.cloud().size(); i += stride) {
    const std::optional<BeamPoint> beam = beams.of(i);
    if (!beam) continue;
    const Eigen::Array2d at =
        (board_from_lidar * Eigen::Vector3d(beam->range_m * beam->direction)).head<2>().array();
    if ((at < outline.lower_left_m.array()).any() || (at > outline.upper_right_m.array()).any())
      continue;
    const Eigen::Array2d across =
        (board_from_lidar.rotation * movements.point(*beam)).head<2>().array();
    count += 1.0;
    place += at;
    squares += at * at;
    aside += across;
    products += at * across;
  }
  const Eigen::Array2d spread = squares - place * place / std::max(1.0, count);
  if (count < 3.0 || !(spread > 0.0).all()) return Eigen::Vector2d::Zero();
  return (products - place * aside / count) / spread;
}

}  // namespace

bool takes_part(const SceneResult& scene) {
  return scene.used && scene.view && scene.refinement;
}

std::vector<std::optional<Rigid3>> modelled_boards(const Discovery& discovery,
                                                   const CalibrationResult& result) {
  std::vector<std::optional<Rigid3>> out(result.scenes.size());
  std::size_t next = 0;
  for (std::size_t s = 0; s < out.size(); ++s) {
    if (takes_part(result.scenes[s]) && next < discovery.state.camera_from_board.size())
      out[s] = discovery.state.camera_from_board[next++];
  }
  return out;
}

ModelledMovements::ModelledMovements(const Discovery& discovery, const CalibrationResult& result)
    : model_(discovery.model), table_(empty_table(discovery.scales)) {
  if (result.scenes.empty()) return;
  const std::size_t boards = std::max<std::size_t>(1, discovery.state.camera_from_board.size());
  table_.scenes.assign(result.scenes.size(), {});
  std::size_t next = 0;
  for (std::size_t s = 0; s < result.scenes.size(); ++s) {
    const std::size_t board = std::min(next, boards - 1);
    if (takes_part(result.scenes[s])) ++next;
    table_.scenes[s].clock = scene_clock(board, boards);
    if (board >= discovery.state.camera_from_board.size()) continue;
    SceneGeometry(discovery.state.camera_from_lidar, discovery.state.camera_from_board[board])
        .tell_middle(result.target.outline().center_m(), table_.scenes[s]);
  }
}

Eigen::Vector3d ModelledMovements::point(const BeamPoint& beam) const {
  Eigen::Vector3d out = Eigen::Vector3d::Zero();
  std::vector<Eigen::Vector3d> scratch;
  for (const EffectInUse& use : model_) out += point_movement(use, beam, table_, scratch);
  return out;
}

Eigen::Vector3d ModelledMovements::spot(const BeamPoint& beam) const {
  return sum_over(model_, [&](const EffectInUse& use, auto moves) {
    use.effect->spot(beam, table_, use.shape, moves);
  });
}

Eigen::Vector3d ModelledMovements::print(const Eigen::Vector2d& board_m,
                                         const Target& target) const {
  PrintPoint at;
  at.board_m = board_m;
  return sum_over(model_, [&](const EffectInUse& use, auto moves) {
    use.effect->board(at, target, use.shape, moves);
  });
}

BoardBeams::BoardBeams(const CalibrationResult& result, std::size_t scene,
                       const Rigid3& lidar_from_board, const ModelScales& scales, double darkness)
    : cloud_(result.scenes[scene].board_points),
      scene_(static_cast<int>(scene)),
      geometry_(Rigid3(), lidar_from_board),
      scales_(scales),
      target_(result.target),
      dark_(scales_.log_contrast > 0.0 && cloud_.has_intensity()),
      darkness_(darkness),
      velocities_(scan_velocities(cloud_)) {}

std::optional<BeamPoint> BoardBeams::of(std::size_t i) const {
  BeamPoint beam;
  if (!geometry_.describe(cloud_.points_m[i].cast<double>().normalized(), beam))
    return std::nullopt;
  beam.scene = scene_;
  beam.darkness = dark_ ? scales_.darkness_of(cloud_.intensity[i]) : darkness_;
  // Light follows the print, not what was read: a clipped reading looks dark.
  const auto printed = dark_ ? target_.albedo(beam.board_m) : std::nullopt;
  beam.white = printed.value_or(std::clamp(1.0 - beam.darkness, 0.0, 1.0));
  beam.line = cloud_.has_line() ? cloud_.line[i] : -1;
  if (cloud_.has_time()) beam.time_s = cloud_.time_s[i];
  if (!velocities_.empty()) beam.scan_rad_s = velocities_[i];
  return beam;
}

BeamPoint beam_towards(const Eigen::Vector3d& point_m, std::size_t scene,
                       const Rigid3& lidar_from_board, double darkness) {
  BeamPoint beam;
  beam.scene = static_cast<int>(scene);
  static_cast<void>(SceneGeometry(Rigid3(), lidar_from_board).describe(point_m.normalized(), beam));
  beam.darkness = darkness;
  beam.white = 1.0 - darkness;
  beam.line = -1;
  return beam;
}

double black_share(const Target& target) {
  constexpr int kSide = 60;  // Finer than the bits of any tag.
  const BoardOutline outline = target.outline();
  double black = 0.0;
  for (int i = 0; i < kSide; ++i) {
    for (int j = 0; j < kSide; ++j) {
      const Eigen::Vector2d at =
          outline.lower_left_m +
          outline.size_m().cwiseProduct(Eigen::Vector2d(i + 0.5, j + 0.5)) / kSide;
      black += 1.0 - target.albedo(at).value_or(1.0);
    }
  }
  return black / (kSide * kSide);
}

double dark_offset_m(const ModelledMovements& movements) {
  BeamPoint beam;
  beam.range_m = 3.0;
  beam.darkness = 1.0;
  beam.white = 0.0;
  const double black = beam.direction.dot(movements.point(beam));
  beam.darkness = 0.0;
  beam.white = 1.0;
  return black - beam.direction.dot(movements.point(beam));
}

ModelledScales modelled_scales(const Discovery& discovery, const ModelledMovements& movements,
                               const CalibrationResult& result) {
  ModelledScales out;
  out.print = print_scale(movements, result.target);
  out.scenes.assign(result.scenes.size(), 0.0);
  const BoardOutline outline = result.target.outline();
  const double darkness = black_share(result.target);
  const auto boards = modelled_boards(discovery, result);
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  int count = 0;
  for (std::size_t s = 0; s < boards.size(); ++s) {
    if (!boards[s]) continue;
    const Rigid3 lidar_from_board = discovery.state.camera_from_lidar.inverse() * *boards[s];
    const BoardBeams beams(result, s, lidar_from_board, discovery.scales, darkness);
    const Eigen::Vector2d seen = seen_scale(movements, outline, beams, lidar_from_board);
    sum += seen;
    ++count;
    out.scenes[s] = (seen + out.print).mean();
  }
  if (count > 0) out.print += sum / static_cast<double>(count);
  return out;
}

}  // namespace lvcalib
