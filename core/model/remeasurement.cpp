// SPDX-License-Identifier: BSD-3-Clause
#include "model/remeasurement.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "model/board_hits.h"
#include "model/effect_rows.h"

namespace lvcalib {
namespace {

// Effects that know the line or the time of a point can move the points of one edge apart.
std::vector<EffectInUse> parting(const std::vector<EffectInUse>& in_use) {
  std::vector<EffectInUse> out;
  for (const EffectInUse& use : in_use) {
    const EffectInfo& info = use.effect->info();
    if ((info.needs.line || info.needs.time) && info.spec.empty()) out.push_back(use);
  }
  return out;
}

// Outward shift (m) of an edge, or of a point about it, by effects at their values.
class Shift {
 public:
  Shift(const MeasurementTable& table, const std::vector<EffectInUse>& effects,
        const SceneGeometry& geometry)
      : effects_(effects),
        columns_(columns_in_use(effects, table)),
        rows_(table, columns_.list()),
        geometry_(geometry),
        rotation_(geometry.lidar_from_board().rotation.toRotationMatrix()) {}

  [[nodiscard]] Eigen::Vector3d outward(const BoundaryRow& row) const {
    return outward_of(row, row.beam.board_m, rotation_);
  }

  double of(const BoundaryRow& row) {
    double sum = 0.0;
    std::size_t k = 0;
    const Eigen::Vector3d by_move = geometry_.edge_row(row.beam.direction, outward(row));
    rows_.edge(row, by_move, rotation_, [&](const EffectColumns&, std::span<const double> by) {
      const Eigen::VectorXd& values = effects_[k++].values;
      for (std::size_t p = 0; p < by.size(); ++p)
        sum += values(static_cast<Eigen::Index>(p)) * by[p];
    });
    return sum;
  }

 private:
  const std::vector<EffectInUse>& effects_;
  EffectColumnsList columns_;
  EffectRows rows_;
  const SceneGeometry& geometry_;
  Eigen::Matrix3d rotation_;
};

// A point about a circle as if it were an edge by itself.
std::optional<BoundaryRow> row_of(const BoardHit& hit, const std::vector<TargetNode>& nodes,
                                  double radius_m, const SceneGeometry& geometry) {
  for (const TargetNode& node : nodes) {
    const Eigen::Vector2d from = hit.beam.board_m - node.center_m;
    if (from.norm() > 2.0 * radius_m || from.norm() < 1e-6) continue;
    BoundaryRow row;
    row.beam = hit.beam;
    row.node = node.id;
    row.center_m = node.center_m;
    row.radius_m = radius_m;
    row.psi_rad = std::atan2(from.y(), from.x());
    row.edge_normal_rad = edge_normal(geometry, row.beam, row.psi_rad);
    return row;
  }
  return std::nullopt;
}

class Remeasurement {
 public:
  Remeasurement(const MeasurementTable& table, const ModelState& state,
                const std::vector<EffectInUse>& effects, const RunContext& context)
      : source_(*table.source),
        state_(state),
        effects_(effects),
        context_(context),
        table_(table),
        clouds_(source_.board_points),
        refined_(source_.refinements.size()),
        parted_m_(source_.refinements.size(), 0.0) {}

  std::optional<MeasurementTable> run(double least_m) {
    parallel_for(clouds_.size(), context_.thread_count(), [&](std::size_t s) { take_out(s); });
    if (*std::max_element(parted_m_.begin(), parted_m_.end()) < least_m) return std::nullopt;
    parallel_for(clouds_.size(), context_.thread_count(), [&](std::size_t s) { refine(s); });
    const bool all = std::all_of(refined_.begin(), refined_.end(),
                                 [](const auto& refined) { return refined.has_value(); });
    if (!all || context_.stopped()) return std::nullopt;
    std::vector<SceneMeasurements> scenes;
    for (std::size_t s = 0; s < clouds_.size(); ++s)
      scenes.push_back({table_.scenes[s].name, {}, &*refined_[s], &clouds_[s]});
    MeasurementTable out = table_;
    build_edges(scenes, state_, source_.options, out);
    give_back(out);
    return out;
  }

 private:
  [[nodiscard]] SceneGeometry geometry_of(std::size_t scene) const {
    return {state_.camera_from_lidar, state_.camera_from_board[scene]};
  }

  void take_out(std::size_t s) {
    if (context_.stopped()) return;
    const SceneGeometry geometry = geometry_of(s);
    const SceneMeasurements measured{
        table_.scenes[s].name, {}, &source_.refinements[s], &source_.board_points[s]};
    const BoardHits hits(measured, static_cast<int>(s), geometry, table_.target, source_.options);
    const std::vector<TargetNode> nodes = table_.target.nodes();
    Shift shift(table_, effects_, geometry);
    double squares = 0.0;
    double count = 0.0;
    for (const BoardHit& hit : hits.list()) {
      const auto row = row_of(hit, nodes, table_.target.circle_radius_m, geometry);
      if (!row) continue;
      const double moved = shift.of(*row);
      clouds_[s].points_m[hit.point] -= (moved * shift.outward(*row)).cast<float>();
      squares += moved * moved;
      count += 1.0;
    }
    if (count > 0.0) parted_m_[s] = std::sqrt(squares / count);
  }

  void refine(std::size_t s) {
    RunContext quiet;
    quiet.stop = context_.stop;
    quiet.threads = 1;
    auto refined = refine_board(clouds_[s], table_.target, geometry_of(s).lidar_from_board(),
                                source_.options.refinement, quiet);
    if (refined) refined_[s] = std::move(*refined);
  }

  void give_back(MeasurementTable& out) const {
    for (std::size_t s = 0; s < clouds_.size(); ++s) {
      const SceneGeometry geometry = geometry_of(s);
      Shift shift(out, effects_, geometry);
      for (BoundaryRow& row : out.boundary) {
        if (row.beam.scene != static_cast<int>(s)) continue;
        const Eigen::Vector3d point =
            row.beam.range_m * row.beam.direction + shift.of(row) * shift.outward(row);
        (void)geometry.describe(point.normalized(), row.beam);
      }
    }
  }

  const TableSource& source_;
  const ModelState& state_;
  const std::vector<EffectInUse>& effects_;
  const RunContext& context_;
  const MeasurementTable& table_;
  std::vector<Cloud> clouds_;
  std::vector<std::optional<BoardRefinement>> refined_;
  std::vector<double> parted_m_;  // RMS shift of the points about circles
};

// Whether a board's corner has moved, in the board's plane, by a quarter of a footprint against the
// rays that met it: points then lie on other print than they were taken to.
bool is_displaced(const MeasurementTable& table, const ModelState& state) {
  constexpr double kShare = 0.25;
  const BoardOutline outline = table.target.outline();
  for (std::size_t s = 0; s < table.scenes.size(); ++s) {
    const SceneGeometry before(table.placed_by.camera_from_lidar,
                               table.placed_by.camera_from_board[s]);
    const SceneGeometry now(state.camera_from_lidar, state.camera_from_board[s]);
    for (const Eigen::Vector2d& corner : {outline.lower_left_m, outline.upper_right_m}) {
      const Eigen::Vector3d at(corner.x(), corner.y(), 0.0);
      const Eigen::Vector3d p = before.lidar_from_board() * at;
      const Eigen::Vector3d moved = now.lidar_from_board() * at - p;
      const Eigen::Vector3d within = moved - now.normal() * now.normal().dot(moved);
      if (within.norm() > kShare * table.source->options.footprint_rad * p.norm()) return true;
    }
  }
  return false;
}

}  // namespace

std::shared_ptr<const MeasurementTable> remeasured(const MeasurementTable& table,
                                                   const ModelState& state,
                                                   const std::vector<EffectInUse>& in_use,
                                                   const RunContext& context) {
  if (!table.source) return nullptr;
  std::shared_ptr<const MeasurementTable> out;
  if (is_displaced(table, state))
    out = std::make_shared<const MeasurementTable>(rebuild_table(table, state));
  if (auto edges = remeasure_edges(out ? *out : table, state, in_use, context))
    out = std::make_shared<const MeasurementTable>(std::move(*edges));
  return context.stopped() ? nullptr : out;
}

bool is_outdated(const MeasurementTable& table, const ModelState& state,
                 const std::vector<EffectInUse>& in_use) {
  return table.source && (is_displaced(table, state) || !parting(in_use).empty());
}

std::optional<MeasurementTable> remeasure_edges(const MeasurementTable& table,
                                                const ModelState& state,
                                                const std::vector<EffectInUse>& in_use,
                                                const RunContext& context, double least_m) {
  const std::vector<EffectInUse> effects = parting(in_use);
  if (effects.empty() || !table.source || table.boundary.empty()) return std::nullopt;
  return Remeasurement(table, state, effects, context).run(least_m);
}

}  // namespace lvcalib
