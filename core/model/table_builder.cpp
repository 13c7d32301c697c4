// SPDX-License-Identifier: BSD-3-Clause
#include "model/table_builder.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

#include "base/statistics.h"
#include "model/scan_velocity.h"
#include "model/scene_geometry.h"

namespace lvcalib {
namespace {

constexpr int kCells = 16;  // board cells along a side, for even thinning
constexpr double kMedianOfSquare = 0.4549;

// Width of the transition along a direction of the board.
double transition_along(const BoardRefinement& refinement, const Rigid3& lidar_from_board,
                        double psi_rad) {
  const Eigen::Vector3d along =
      lidar_from_board.rotation * Eigen::Vector3d(std::cos(psi_rad), std::sin(psi_rad), 0.0);
  const Eigen::Vector2d uv(refinement.plane.axis_u.dot(along), refinement.plane.axis_v.dot(along));
  return std::sqrt(std::max(0.0, uv.dot(refinement.footprint_m2 * uv)));
}

// Mid-level shift at a circle's edge by the footprint that the transitions show: its variance along
// the edge, given none across, over twice the radius.
double curvature_along(const BoardRefinement& refinement, double transition_m, double radius_m) {
  const double across = transition_m * transition_m;
  if (!(across > 0.0)) return 0.0;
  return -std::max(0.0, refinement.footprint_m2.determinant()) / across / (2.0 * radius_m);
}

// One scene's points that hit the board, before thinning.
struct BoardHit {
  std::size_t point = 0;
  BeamPoint beam;
  Print print = Print::kWhite;
  bool pure = false;  // sees one print only
  double residual_m = 0.0;
};

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
        camera_from_board_(state.camera_from_board[static_cast<std::size_t>(scene)]),
        nodes_(table.target.nodes()) {}

  void add_corners(double sigma_px) {
    TableScene& scene = table_.scenes[static_cast<std::size_t>(scene_)];
    for (const CornerObservation& c : input_.corners) {
      CornerRow row;
      row.scene = scene_;
      row.feature = c.feature_id;
      row.corner = c.corner;
      row.board_m = c.board_m;
      row.pixel = c.pixel;
      row.sigma_px = sigma_px;
      if (const auto tag = table_.target.tag(c.feature_id); table_.target.has_tags() && tag) {
        row.from_tag_m = c.board_m - tag->center_m;
        const auto center = table_.camera.project(
            camera_from_board_ * Eigen::Vector3d(tag->center_m.x(), tag->center_m.y(), 0.0));
        if (center) row.from_tag_px = c.pixel - *center;
      }
      if (std::find(scene.features.begin(), scene.features.end(), c.feature_id) ==
          scene.features.end())
        scene.features.push_back(c.feature_id);
      table_.corner.push_back(row);
    }
  }

  void add_points() {
    const Cloud& cloud = *input_.board_points;
    velocities_ = scan_velocities(cloud);
    collect(cloud);
    measure_levels(cloud);
    add_range_rows(cloud);
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
      for (const BinRecord& bin : node.bins) {
        if (bin.state == BinState::kUsed) any = add_bin(*at, node, bin) || any;
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

  [[nodiscard]] Print print_at(const Eigen::Vector2d& board_m) const {
    if (table_.target.albedo(board_m).value_or(1.0) >= 0.5) return Print::kWhite;
    for (const TargetNode& node : nodes_) {
      if ((board_m - node.center_m).norm() <= table_.target.circle_radius_m) return Print::kCircle;
    }
    return Print::kBlack;
  }

  void collect(const Cloud& cloud) {
    const BoardOutline outline = table_.target.outline();
    const double shrink = 0.02 * outline.size_m().minCoeff();
    const Eigen::Vector2d low = outline.lower_left_m.array() + shrink;
    const Eigen::Vector2d high = outline.upper_right_m.array() - shrink;
    const auto& sigmas = input_.refinement->plane.group_sigma_m;
    const double gate =
        options_.gate * std::max({sigmas[0], sigmas[1], input_.refinement->plane.sigma_range_m});
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      const Eigen::Vector3d p = cloud.points_m[i].cast<double>();
      const double measured = p.norm();
      BoardHit hit;
      hit.point = i;
      hit.beam.scene = scene_;
      if (!geometry_.describe(p / measured, hit.beam)) continue;
      const Eigen::Vector2d& xy = hit.beam.board_m;
      if ((xy.array() < low.array()).any() || (xy.array() > high.array()).any()) continue;
      hit.residual_m = measured - hit.beam.range_m;
      if (std::abs(hit.residual_m) > gate) continue;
      hit.print = print_at(xy);
      hit.pure = is_pure(hit.beam, hit.print);
      if (cloud.has_time()) hit.beam.time_s = cloud.time_s[i];
      if (cloud.has_line()) hit.beam.line = cloud.line[i];
      hit.beam.scan_rad_s = velocities_.empty() ? Eigen::Vector2d::Zero() : velocities_[i];
      near_edge(hit.beam);
      hits_.push_back(hit);
    }
  }

  // All prints within two σ of the footprint are alike.
  [[nodiscard]] bool is_pure(const BeamPoint& beam, Print print) const {
    const double across = options_.footprint_rad * beam.range_m;
    for (int k = 0; k < 4; ++k) {
      const double psi = 0.5 * k * 3.14159265358979;
      double sigma = transition_along(*input_.refinement, geometry_.lidar_from_board(), psi);
      if (sigma <= 0.0) sigma = across;
      const Eigen::Vector2d q =
          beam.board_m + 2.0 * sigma * Eigen::Vector2d(std::cos(psi), std::sin(psi));
      if (print_at(q) != print) return false;
    }
    return true;
  }

  void near_edge(BeamPoint& beam) const {
    const double radius = table_.target.circle_radius_m;
    for (const TargetNode& node : nodes_) {
      const Eigen::Vector2d from = beam.board_m - node.center_m;
      const double distance = from.norm() - radius;
      if (std::abs(distance) > radius) continue;
      const double psi = std::atan2(from.y(), from.x());
      const double sigma = transition_along(*input_.refinement, geometry_.lidar_from_board(), psi);
      if (sigma > 0.0 && std::abs(distance) < 4.0 * sigma)
        beam.edge = NearEdge{distance, psi, sigma};
      return;
    }
  }

  void measure_levels(const Cloud& cloud) {
    if (!cloud.has_intensity()) return;
    std::array<std::vector<double>, kPrints> values;
    for (const BoardHit& hit : hits_) {
      if (hit.pure)
        values[static_cast<std::size_t>(hit.print)].push_back(cloud.intensity[hit.point]);
    }
    const double white = values[0].empty() ? 0.0 : median(values[0]);
    for (std::size_t k = 0; k < kPrints; ++k) {
      // Black that returns next to nothing has no logarithm: a hundredth of white stands for it.
      if (values[k].size() >= 10) levels_[k] = std::max(median(std::move(values[k])), 0.01 * white);
    }
  }

  void add_range_rows(const Cloud& cloud) {
    const std::array<double, kPrints> sigma = noise();
    const double quota_all = options_.max_rows_per_scene;
    std::map<int, std::vector<std::size_t>> cells;
    for (std::size_t h = 0; h < hits_.size(); ++h) {
      const Eigen::Vector2d unit = unit_square(hits_[h].beam.board_m);
      const int x = std::clamp(static_cast<int>(unit.x() * kCells), 0, kCells - 1);
      const int y = std::clamp(static_cast<int>(unit.y() * kCells), 0, kCells - 1);
      // Mixed prints matter at circles only, where the model knows the mixture.
      if (!hits_[h].pure && !hits_[h].beam.edge) continue;
      cells[3 * (y * kCells + x) + static_cast<int>(hits_[h].print)].push_back(h);
    }
    const auto quota = static_cast<std::size_t>(
        std::max(1.0, quota_all / std::max<double>(1.0, static_cast<double>(cells.size()))));
    for (const auto& [cell, members] : cells) {
      const std::size_t take = std::min(members.size(), quota);
      for (std::size_t k = 0; k < take; ++k)
        add_row(cloud, hits_[members[k * members.size() / take]], sigma);
    }
  }

  void add_row(const Cloud& cloud, const BoardHit& hit, const std::array<double, kPrints>& sigma) {
    RangeRow row;
    row.beam = hit.beam;
    row.measured_m = cloud.points_m[hit.point].cast<double>().norm();
    const auto print = static_cast<std::size_t>(hit.print);
    row.print = hit.print;
    row.sigma_m = sigma[print];
    if (cloud.has_intensity()) row.intensity = cloud.intensity[hit.point];
    table_.range.push_back(row);
    if (!hit.pure || !(row.intensity > 0.0) || !(levels_[print] > 0.0)) return;
    table_.intensity.push_back(
        {hit.beam, hit.print, std::log(row.intensity), intensity_sigma_[print]});
  }

  // Range noise of white and black from near-replicates; where there are too few, from the plane.
  std::array<double, kPrints> noise() {
    constexpr int kPairs = 60;
    std::array<double, kPrints> out{};
    for (std::size_t k = 0; k < kPrints; ++k) {
      std::vector<Eigen::Vector2d> at;
      std::vector<double> range;
      std::vector<double> log_intensity;
      std::vector<int> strata;
      for (const BoardHit& hit : hits_) {
        if (hit.print != static_cast<Print>(k) || !hit.pure) continue;
        at.push_back(hit.beam.board_m);
        range.push_back(hit.residual_m);
        strata.push_back(hit.beam.line);
        const double raw =
            input_.board_points->has_intensity() ? input_.board_points->intensity[hit.point] : 0.0;
        log_intensity.push_back(std::log(std::max(raw, 1e-3)));
      }
      for (double distance = 0.003; distance < 0.05 && out[k] == 0.0; distance *= 2.0)
        out[k] = replicate_sigma(at, range, strata, distance, kPairs);
      for (double distance = 0.003; distance < 0.05 && intensity_sigma_[k] == 0.0; distance *= 2.0)
        intensity_sigma_[k] = replicate_sigma(at, log_intensity, strata, distance, kPairs);
      if (intensity_sigma_[k] <= 0.0) intensity_sigma_[k] = 0.1;
      const FittedPlane& plane = input_.refinement->plane;
      if (out[k] == 0.0)
        out[k] = plane.group_sigma_m[std::min<std::size_t>(k, 1)] > 0.0
                     ? plane.group_sigma_m[std::min<std::size_t>(k, 1)]
                     : plane.sigma_range_m;
      out[k] = std::max(out[k], 1e-5);
    }
    return out;
  }

  bool add_bin(const TargetNode& node, const NodeRecord& record, const BinRecord& bin) {
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
    set_edge_normal(row);
    set_local_scan(row.beam);
    table_.boundary.push_back(row);
    return true;
  }

  void set_edge_normal(BoundaryRow& row) const {
    const Eigen::Vector3d outward =
        geometry_.lidar_from_board().rotation *
        Eigen::Vector3d(std::cos(row.psi_rad), std::sin(row.psi_rad), 0);
    const Eigen::Vector3d a = geometry_.edge_row(row.beam.direction, outward);
    const double ca = std::cos(row.beam.azimuth_rad);
    const double sa = std::sin(row.beam.azimuth_rad);
    const double ce = std::cos(row.beam.elevation_rad);
    const double se = std::sin(row.beam.elevation_rad);
    row.edge_normal_rad =
        row.beam.range_m * Eigen::Vector2d(a.dot(Eigen::Vector3d(-sa, ca, 0.0)),
                                           a.dot(Eigen::Vector3d(-se * ca, -se * sa, ce)));
  }

  // Mean scan velocity and time of the points about an edge point.
  void set_local_scan(BeamPoint& beam) {
    constexpr double kReach = 0.02;
    if (hash_.empty()) {
      for (std::size_t h = 0; h < hits_.size(); ++h)
        hash_[cell_of(hits_[h].beam.board_m, kReach)].push_back(h);
    }
    double count = 0.0;
    const auto [cx, cy] = cell_of(beam.board_m, kReach);
    for (int dx = -1; dx <= 1; ++dx) {
      for (int dy = -1; dy <= 1; ++dy) {
        const auto at = hash_.find({cx + dx, cy + dy});
        if (at == hash_.end()) continue;
        for (const std::size_t h : at->second) {
          if ((hits_[h].beam.board_m - beam.board_m).norm() > kReach) continue;
          beam.scan_rad_s += hits_[h].beam.scan_rad_s;
          beam.time_s += hits_[h].beam.time_s;
          count += 1.0;
        }
      }
    }
    if (count > 0.0) {
      beam.scan_rad_s /= count;
      beam.time_s /= count;
    }
  }

  static std::pair<int, int> cell_of(const Eigen::Vector2d& p, double size) {
    return {static_cast<int>(std::floor(p.x() / size)), static_cast<int>(std::floor(p.y() / size))};
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
  Rigid3 camera_from_board_;
  std::vector<TargetNode> nodes_;
  std::vector<Eigen::Vector2d> velocities_;
  std::vector<BoardHit> hits_;
  std::map<std::pair<int, int>, std::vector<std::size_t>> hash_;
  std::array<double, kPrints> levels_{};
  std::array<double, kPrints> intensity_sigma_{};
};

// Corner noise from what no smooth error can do: the alternating sum over the four corners of a tag
// (or of a checkerboard's square), which has four times the variance of a single corner.
// Insensitive to shifts, stretching and perspective of the tag, and to a bias away from its centre.
double corner_noise(const MeasurementTable& table, const ModelState& state, double fallback_px) {
  constexpr std::size_t kFewest = 12;
  std::map<std::tuple<int, int, int>, Eigen::Vector2d> residual;  // scene, feature, corner
  for (const CornerRow& row : table.corner) {
    const auto p =
        table.camera.project(state.camera_from_board[static_cast<std::size_t>(row.scene)] *
                             Eigen::Vector3d(row.board_m.x(), row.board_m.y(), 0.0));
    if (p) residual[{row.scene, row.feature, row.corner}] = row.pixel - *p;
  }
  const int columns = table.target.corner_columns;
  std::vector<double> sums;
  for (const auto& [key, first] : residual) {
    const auto [scene, feature, corner] = key;
    if (corner != 0) continue;
    std::array<std::tuple<int, int, int>, 3> others;
    if (table.target.has_tags()) {
      others = {std::tuple{scene, feature, 1}, {scene, feature, 2}, {scene, feature, 3}};
    } else {
      if (feature % columns + 1 == columns) continue;
      others = {std::tuple{scene, feature + 1, 0},
                {scene, feature + columns + 1, 0},
                {scene, feature + columns, 0}};
    }
    Eigen::Vector2d sum = first;
    double sign = -1.0;
    bool all = true;
    for (const auto& other : others) {
      const auto at = residual.find(other);
      all = all && at != residual.end();
      if (!all) break;
      sum += sign * at->second;
      sign = -sign;
    }
    if (all) sums.insert(sums.end(), {sum.x(), sum.y()});
  }
  if (sums.size() < kFewest) return fallback_px;
  const double sigma = 0.5 * mad_sigma(std::move(sums));
  return sigma > 0.0 ? sigma : fallback_px;
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

}  // namespace

double replicate_sigma(const std::vector<Eigen::Vector2d>& board_m,
                       const std::vector<double>& values, const std::vector<int>& strata,
                       double distance_m, int min_pairs) {
  // The last point of every cell and stratum pairs with the next one there.
  std::map<std::tuple<int, int, int>, std::size_t> last;
  std::vector<double> squares;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::tuple key{strata[i], static_cast<int>(std::floor(board_m[i].x() / distance_m)),
                         static_cast<int>(std::floor(board_m[i].y() / distance_m))};
    const auto [entry, fresh] = last.try_emplace(key, i);
    if (fresh) continue;
    const double d = values[i] - values[entry->second];
    squares.push_back(d * d);
    last.erase(entry);
  }
  if (static_cast<int>(squares.size()) < min_pairs) return 0.0;
  return std::sqrt(median(std::move(squares)) / (2.0 * kMedianOfSquare));
}

MeasurementTable build_table(const std::vector<SceneMeasurements>& scenes, const Target& target,
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
  std::vector<SceneBuilder> builders;
  builders.reserve(scenes.size());
  std::array<std::vector<double>, kPrints> levels;
  for (std::size_t s = 0; s < scenes.size(); ++s) {
    builders.emplace_back(scenes[s], static_cast<int>(s), state, options, table);
    builders.back().add_corners(sigma_px);
    builders.back().add_points();
    builders.back().add_boundary();
    for (std::size_t k = 0; k < kPrints; ++k) {
      if (builders.back().levels()[k] > 0.0) levels[k].push_back(builders.back().levels()[k]);
    }
  }
  for (std::size_t k = 0; k < kPrints; ++k) {
    if (!levels[k].empty()) table.level[k] = median(levels[k]);
  }
  const std::size_t black = levels[1].empty() ? 2 : 1;
  if (!levels[0].empty() && !levels[black].empty())
    table.log_contrast = std::log(table.level[0] / table.level[black]);
  if (!table.has_intensity) forget_intensity(table);
  for (SceneBuilder& builder : builders) builder.set_darkness();
  const double noise_px = corner_noise(table, state, sigma_px);
  for (CornerRow& row : table.corner) row.sigma_px = noise_px;
  if (has_line) list_lines(table);
  return table;
}

}  // namespace lvcalib
