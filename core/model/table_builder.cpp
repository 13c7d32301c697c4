// SPDX-License-Identifier: BSD-3-Clause
#include "model/table_builder.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>

#include "base/parallel.h"
#include "base/progress.h"
#include "base/statistics.h"
#include "model/board_hits.h"
#include "model/edge_view.h"
#include "model/noise_floor.h"
#include "model/scene_geometry.h"
#include "model/transition_width.h"

namespace lvcalib {
namespace {

constexpr int kCells = 16;  // board cells along a side, for even thinning

class SceneBuilder {
 public:
  SceneBuilder(const SceneMeasurements& input, int scene, const ModelState& state,
               const TableOptions& options, MeasurementTable& table)
      : input_(input),
        scene_(scene),
        options_(options),
        table_(table),
        geometry_(state.camera_from_lidar,
                  state.camera_from_board[static_cast<std::size_t>(scene)]),
        nodes_(table.target.nodes()),
        hits_(input, scene, geometry_, table.target, options),
        view_(hits_.list(), nodes_, table.target.circle_radius_m,
              input.refinement->transition_noise),
        levels_(hits_.levels()) {}

  void add_points() {
    const PrintNoise noise = hits_.noise();
    const std::vector<BoardHit>& hits = hits_.list();
    const double quota_all = options_.max_rows_per_scene;
    std::map<int, std::vector<std::size_t>> cells;
    for (std::size_t h = 0; h < hits.size(); ++h) {
      const Eigen::Vector2d unit = unit_square(hits[h].beam.board_m);
      const int x = std::clamp(static_cast<int>(unit.x() * kCells), 0, kCells - 1);
      const int y = std::clamp(static_cast<int>(unit.y() * kCells), 0, kCells - 1);
      // Mixed prints matter at circles only, where the model knows the mixture.
      if (!hits[h].pure && !hits[h].beam.edge) continue;
      cells[3 * (y * kCells + x) + static_cast<int>(hits[h].print)].push_back(h);
    }
    const auto quota = static_cast<std::size_t>(
        std::max(1.0, quota_all / std::max<double>(1.0, static_cast<double>(cells.size()))));
    for (const auto& [cell, members] : cells) {
      const std::size_t take = std::min(members.size(), quota);
      for (std::size_t k = 0; k < take; ++k)
        add_row(hits[members[k * members.size() / take]], noise);
    }
  }

  // Once the levels of all scenes are known.
  void set_darkness() {
    const double white = table_.level_of(Print::kWhite);
    if (!(table_.log_contrast > 0.0)) return;
    for (RangeRow& row : table_.range) {
      if (row.beam.scene != scene_) continue;
      const double level = level_at(row.print, row.beam.edge);
      if (level > 0.0) row.beam.darkness = std::log(white / level) / table_.log_contrast;
    }
  }

  void add_boundary() {
    const BoardRefinement& refinement = *input_.refinement;
    if (refinement.history.empty()) return;
    TableScene& scene = table_.scenes[static_cast<std::size_t>(scene_)];
    for (const NodeRecord& node : refinement.history.back().nodes) {
      if (!node.valid) continue;
      const auto at = std::find_if(nodes_.begin(), nodes_.end(),
                                   [&](const TargetNode& n) { return n.id == node.id; });
      if (at == nodes_.end()) continue;
      bool any = false;
      for (std::size_t k = 0; k < node.bins.size(); ++k) {
        if (node.bins[k].state == BinState::kUsed)
          any = add_bin(*at, node, node.bins[k], sector_of(k, node.bins.size())) || any;
      }
      if (any) scene.nodes.push_back(node.id);
    }
  }

  [[nodiscard]] const std::array<double, kPrints>& levels() const { return levels_; }

 private:
  // Intensity by the scene's levels, mixed within a circle's transition.
  [[nodiscard]] double level_at(Print print, const std::optional<NearEdge>& edge) const {
    const double circle = levels_[static_cast<std::size_t>(Print::kCircle)];
    const double white = levels_[static_cast<std::size_t>(Print::kWhite)];
    if (edge && edge->transition_m > 0.0 && circle > 0.0 && white > 0.0)
      return circle + (white - circle) * normal_cdf(edge->distance_m / edge->transition_m);
    return levels_[static_cast<std::size_t>(print)];
  }

  void add_row(const BoardHit& hit, const PrintNoise& noise) {
    const Cloud& cloud = *input_.board_points;
    RangeRow row;
    row.beam = hit.beam;
    row.measured_m = cloud.points_m[hit.point].cast<double>().norm();
    const auto print = static_cast<std::size_t>(hit.print);
    row.print = hit.print;
    row.sigma_m = noise.range_m[print];
    if (cloud.has_intensity()) row.intensity = cloud.intensity[hit.point];
    table_.range.push_back(row);
    // The logarithm of what is mostly noise says nothing; of less its mean lies half the variance
    // below that of the level.
    constexpr double kMostlyNoise = 0.5;
    const double sigma = noise.log_intensity[print];
    const bool told = sigma > 0.0 && sigma <= kMostlyNoise && levels_[print] > 0.0;
    if (!hit.plain || !(row.intensity > 0.0) || !told) return;
    table_.intensity.push_back(
        {hit.beam, hit.print, std::log(row.intensity) + 0.5 * sigma * sigma, sigma});
  }

  bool add_bin(const TargetNode& node, const NodeRecord& record, const BinRecord& bin,
               const EdgeSector& sector) {
    const BoardRefinement& refinement = *input_.refinement;
    const double radius = table_.target.circle_radius_m;
    const Eigen::Vector2d uv =
        record.center_uv_m + (radius + bin.midpoint_m) *
                                 Eigen::Vector2d(std::cos(bin.angle_rad), std::sin(bin.angle_rad));
    BoundaryRow row;
    row.beam.scene = scene_;
    if (!geometry_.describe(refinement.plane.to_lidar(uv).normalized(), row.beam)) return false;
    const Eigen::Vector2d from = row.beam.board_m - node.center_m;
    row.node = node.id;
    row.center_m = node.center_m;
    row.radius_m = radius;
    row.psi_rad = std::atan2(from.y(), from.x());
    row.transition_m = transition_along(refinement, geometry_.lidar_from_board(), row.psi_rad);
    row.curvature_m = curvature_along(refinement, row.transition_m, radius);
    row.sigma_m = std::max(bin.sigma_m, 1e-5);
    if (record.inner_level > 0.0 && record.outer_level > 0.0)
      row.log_contrast = std::log(record.outer_level / record.inner_level);
    row.edge_normal_rad = edge_normal(geometry_, row.beam, row.psi_rad);
    view_.describe(static_cast<std::size_t>(&node - nodes_.data()), sector, row);
    table_.boundary.push_back(row);
    return true;
  }

  // An angular bin of the refinement, whose angles count in the fitted plane's axes.
  [[nodiscard]] EdgeSector sector_of(std::size_t bin, std::size_t bins) const {
    const double half = std::numbers::pi / static_cast<double>(bins);
    const double middle = -std::numbers::pi + (2.0 * static_cast<double>(bin) + 1.0) * half;
    const FittedPlane& plane = input_.refinement->plane;
    const Eigen::Vector3d in_board =
        geometry_.lidar_from_board().rotation.inverse() *
        (std::cos(middle) * plane.axis_u + std::sin(middle) * plane.axis_v).eval();
    return {std::atan2(in_board.y(), in_board.x()), half};
  }

  [[nodiscard]] Eigen::Vector2d unit_square(const Eigen::Vector2d& board_m) const {
    const BoardOutline outline = table_.target.outline();
    return (board_m - outline.lower_left_m).cwiseQuotient(outline.size_m());
  }

  const SceneMeasurements& input_;
  int scene_;
  const TableOptions& options_;
  MeasurementTable& table_;
  SceneGeometry geometry_;
  std::vector<TargetNode> nodes_;
  BoardHits hits_;
  EdgeView view_;
  std::array<double, kPrints> levels_;
};

std::shared_ptr<const TableSource> source_of(const std::vector<SceneMeasurements>& scenes,
                                             double sigma_px, const TableOptions& options) {
  auto out = std::make_shared<TableSource>();
  out->sigma_px = sigma_px;
  out->options = options;
  for (const SceneMeasurements& scene : scenes) {
    out->corners.push_back(scene.corners);
    out->board_points.push_back(*scene.board_points);
    out->refinements.push_back(*scene.refinement);
    auto& history = out->refinements.back().history;
    if (history.size() > 1) history.erase(history.begin(), history.end() - 1);
  }
  return out;
}

// Some drivers fill the field with one number.
bool tells_intensity(const Cloud& cloud) {
  if (!cloud.has_intensity() || cloud.intensity.empty()) return false;
  const auto [low, high] = std::minmax_element(cloud.intensity.begin(), cloud.intensity.end());
  return *high > *low;
}

void forget_intensity(MeasurementTable& table) {
  table.intensity.clear();
  table.level = {1.0, 1.0, 1.0};
  table.log_contrast = 0.0;
}

void list_lines(MeasurementTable& table) {
  for (const RangeRow& row : table.range) table.lines.push_back(row.beam.line);
  std::sort(table.lines.begin(), table.lines.end());
  table.lines.erase(std::unique(table.lines.begin(), table.lines.end()), table.lines.end());
}

MeasurementTable collect(const std::vector<SceneMeasurements>& scenes, const Target& target,
                         const Camera& camera, const ModelState& state, double sigma_px,
                         const TableOptions& options) {
  MeasurementTable table;
  table.target = target;
  table.camera = camera;
  table.has_time = !scenes.empty();
  table.has_intensity = !scenes.empty();
  bool has_line = !scenes.empty();
  for (std::size_t s = 0; s < scenes.size(); ++s) {
    const double last = std::max<double>(1.0, static_cast<double>(scenes.size()) - 1.0);
    table.scenes.push_back({scenes[s].name, {}, {}, static_cast<double>(s) / last});
    table.has_time = table.has_time && scenes[s].board_points->has_time();
    table.has_intensity = table.has_intensity && tells_intensity(*scenes[s].board_points);
    has_line = has_line && scenes[s].board_points->has_line();
  }
  // Placing the points takes most of the time; rows are then added scene by scene.
  std::vector<std::optional<SceneBuilder>> builders(scenes.size());
  parallel_for(scenes.size(), RunContext().thread_count(), [&](std::size_t s) {
    builders[s].emplace(scenes[s], static_cast<int>(s), state, options, table);
  });
  std::array<std::vector<double>, kPrints> levels;
  for (std::size_t s = 0; s < builders.size(); ++s) {
    auto& builder = builders[s];
    add_corners(scenes[s], static_cast<int>(s), state, sigma_px, table);
    builder->add_points();
    builder->add_boundary();
    for (std::size_t k = 0; k < kPrints; ++k) {
      if (builder->levels()[k] > 0.0) levels[k].push_back(builder->levels()[k]);
    }
  }
  for (std::size_t k = 0; k < kPrints; ++k) {
    if (!levels[k].empty()) table.level[k] = median(levels[k]);
  }
  const std::size_t black = levels[1].empty() ? 2 : 1;
  if (!levels[0].empty() && !levels[black].empty())
    table.log_contrast = std::log(table.level[0] / table.level[black]);
  if (!table.has_intensity) forget_intensity(table);
  for (auto& builder : builders) builder->set_darkness();
  const double noise_px = corner_noise(table, state, sigma_px);
  for (CornerRow& row : table.corner) row.sigma_px = noise_px;
  if (has_line) list_lines(table);
  table.placed_by = state;
  return table;
}

}  // namespace

void add_corners(const SceneMeasurements& input, int scene, const ModelState& state,
                 double sigma_px, MeasurementTable& table) {
  TableScene& out = table.scenes[static_cast<std::size_t>(scene)];
  const Rigid3& camera_from_board = state.camera_from_board[static_cast<std::size_t>(scene)];
  for (const CornerObservation& c : input.corners) {
    CornerRow row;
    row.scene = scene;
    row.feature = c.feature_id;
    row.corner = c.corner;
    row.board_m = c.board_m;
    row.pixel = c.pixel;
    row.sigma_px = sigma_px;
    if (const auto tag = table.target.tag(c.feature_id); table.target.has_tags() && tag) {
      row.from_tag_m = c.board_m - tag->center_m;
      const auto center = table.camera.project(
          camera_from_board * Eigen::Vector3d(tag->center_m.x(), tag->center_m.y(), 0.0));
      if (center) row.from_tag_px = c.pixel - *center;
    }
    if (std::find(out.features.begin(), out.features.end(), c.feature_id) == out.features.end())
      out.features.push_back(c.feature_id);
    table.corner.push_back(row);
  }
}

MeasurementTable build_table(const std::vector<SceneMeasurements>& scenes, const Target& target,
                             const Camera& camera, const ModelState& state, double sigma_px,
                             const TableOptions& options) {
  MeasurementTable table = collect(scenes, target, camera, state, sigma_px, options);
  table.source = source_of(scenes, sigma_px, options);
  return table;
}

MeasurementTable rebuild_table(const MeasurementTable& table, const ModelState& state) {
  const TableSource& source = *table.source;
  std::vector<SceneMeasurements> scenes;
  for (std::size_t s = 0; s < table.scenes.size(); ++s) {
    scenes.push_back(
        {table.scenes[s].name, source.corners[s], &source.refinements[s], &source.board_points[s]});
  }
  MeasurementTable out =
      collect(scenes, table.target, table.camera, state, source.sigma_px, source.options);
  out.source = table.source;
  return out;
}

void build_edges(const std::vector<SceneMeasurements>& scenes, const ModelState& state,
                 const TableOptions& options, MeasurementTable& table) {
  table.boundary.clear();
  for (std::size_t s = 0; s < scenes.size(); ++s) {
    table.scenes[s].nodes.clear();
    SceneBuilder(scenes[s], static_cast<int>(s), state, options, table).add_boundary();
  }
}

Eigen::Vector2d edge_normal(const SceneGeometry& geometry, const BeamPoint& beam, double psi_rad) {
  const Eigen::Vector3d outward = geometry.lidar_from_board().rotation *
                                  Eigen::Vector3d(std::cos(psi_rad), std::sin(psi_rad), 0);
  const Eigen::Vector3d a = geometry.edge_row(beam.direction, outward);
  const double ca = std::cos(beam.azimuth_rad);
  const double sa = std::sin(beam.azimuth_rad);
  const double ce = std::cos(beam.elevation_rad);
  const double se = std::sin(beam.elevation_rad);
  return beam.range_m * Eigen::Vector2d(a.dot(Eigen::Vector3d(-sa, ca, 0.0)),
                                        a.dot(Eigen::Vector3d(-se * ca, -se * sa, ce)));
}

}  // namespace lvcalib
