// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Measurement tables drawn straight from poses and noise, with disturbances planted by functions of
// the test: nothing of the estimator's effects, nor of its prediction, is used to make them.

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "base/random.h"
#include "model/linear_model.h"
#include "model/scene_geometry.h"
#include "support/synthetic_observations.h"

namespace lvcalib::test {

/// What goes wrong, in SI units; each adds to what is measured.
struct Disturbance {
  std::function<double(const BeamPoint&)> range_m;
  std::function<double(const BoundaryRow&)> edge_m;
  std::function<Eigen::Vector2d(const CornerRow&)> corner_px;
  std::function<double(const IntensityRow&)> log_intensity;
};

struct TableRecipe {
  int scenes = 6;
  int range_rows = 1500;  ///< Per scene.
  double range_sigma_m = 0.008;
  double edge_sigma_m = 0.0005;
  double corner_sigma_px = 0.05;
  double intensity_sigma = 0.2;
  bool time = true;
  bool lines = true;
  bool alike = false;  ///< Every board hangs where the first does.
  std::uint64_t seed = 1;
};

struct SyntheticTable {
  MeasurementTable table;
  ModelState truth;
};

/// Boards at 1.7 to 4.5 m in changing directions and tilts.
inline Rigid3 table_board(const Target& target, int scene) {
  const double a = 2.399963 * scene;  // golden angle: never the same twice
  const Eigen::Vector3d center(0.35 * std::cos(a), 0.2 * std::sin(a),
                               1.7 + 2.8 * std::fmod(0.618034 * scene, 1.0));
  const Eigen::Vector3d tilt(0.6 * std::sin(1.7 * scene + 0.3), 0.7 * std::cos(2.3 * scene),
                             0.3 * std::sin(3.1 * scene));
  return facing_board(target, center, tilt);
}

/// One σ of the beam.
constexpr double kTableBeam_rad = 5e-4;

/// The default board's print, made once.
inline const std::shared_ptr<const BlurredPrint>& table_print() {
  static const auto print = std::make_shared<const BlurredPrint>(Target{});
  return print;
}

/// What a round beam sees of a black disc on white: a normal spot, drawn out by 1/cos θ in the
/// direction in which the board recedes, integrated over the disc strip by strip.
class DiscSpot {
 public:
  DiscSpot(const BeamPoint& beam, const Eigen::Vector2d& center_m)
      : across_m_(beam.range_m * kTableBeam_rad),
        along_m_(across_m_ / std::cos(beam.incidence_rad)) {
    const Eigen::Vector2d from = beam.board_m - center_m;
    const Eigen::Vector2d axis(std::cos(beam.slope_rad), std::sin(beam.slope_rad));
    along_ = from.dot(axis);
    across_ = -from.x() * axis.y() + from.y() * axis.x();
  }
  [[nodiscard]] double white_share(double radius_m) const {
    // Strips along the spot's short axis, between the ends of the disc.
    const double low = std::max(-6.0, (-radius_m - along_) / along_m_);
    const double high = std::min(6.0, (radius_m - along_) / along_m_);
    if (!(high > low)) return 1.0;
    constexpr int kStrips = 160;
    const double step = (high - low) / kStrips;
    double black = 0.0;
    for (int k = 0; k < kStrips; ++k) {
      const double z = low + (k + 0.5) * step;
      const double u = along_ + z * along_m_;
      const double half = std::sqrt(std::max(0.0, radius_m * radius_m - u * u));
      const auto below = [&](double v) {
        return 0.5 * std::erfc((across_ - v) / (across_m_ * std::sqrt(2.0)));
      };
      black += std::exp(-0.5 * z * z) * (below(half) - below(-half));
    }
    return 1.0 - black * step / std::sqrt(2.0 * M_PI);
  }
  /// σ of the spot in a direction of the board.
  [[nodiscard]] double width_m(double psi_rad, double slope_rad) const {
    return std::hypot(along_m_ * std::cos(psi_rad - slope_rad),
                      across_m_ * std::sin(psi_rad - slope_rad));
  }

 private:
  double across_m_;
  double along_m_;
  double along_ = 0.0;
  double across_ = 0.0;
};

/// Whether a spot about a place of the board sees one print only.
inline bool is_plain_place(const Target& target, const Eigen::Vector2d& board_m, double reach_m) {
  const auto black = [&](const Eigen::Vector2d& p) { return target.albedo(p).value_or(1.0) < 0.5; };
  const bool here = black(board_m);
  for (const double share : {0.35, 0.7, 1.0}) {
    for (int k = 0; k < 12; ++k) {
      const double a = 2.0 * M_PI * k / 12.0;
      if (black(board_m + share * reach_m * Eigen::Vector2d(std::cos(a), std::sin(a))) != here)
        return false;
    }
  }
  return true;
}

inline BeamPoint table_beam(const SceneGeometry& geometry, int scene,
                            const Eigen::Vector2d& board_m, const TableRecipe& recipe,
                            Random& random) {
  BeamPoint beam;
  beam.scene = scene;
  const Eigen::Vector3d p =
      geometry.lidar_from_board() * Eigen::Vector3d(board_m.x(), board_m.y(), 0.0);
  (void)geometry.describe(p.normalized(), beam);
  if (recipe.time) {
    beam.time_s = random.uniform(0.0, 0.1);
    const double direction = random.uniform(-M_PI, M_PI);
    beam.scan_rad_s = 60.0 * Eigen::Vector2d(std::cos(direction), std::sin(direction));
  }
  if (recipe.lines) beam.line = static_cast<int>(random.below(6));
  return beam;
}

/// A range and an intensity at a random place of plain print.
inline void add_table_return(SyntheticTable& out, int scene, const SceneGeometry& geometry,
                             bool black, const TableRecipe& recipe, const Disturbance& wrong,
                             Random& random) {
  MeasurementTable& table = out.table;
  const BoardOutline outline = table.target.outline();
  RangeRow row;
  double reach = 0.0;
  do {
    const double up = random.uniform(outline.lower_left_m.y(), outline.upper_right_m.y());
    const double across = random.uniform(outline.lower_left_m.x(), outline.upper_right_m.x());
    const Eigen::Vector2d at(across, up);
    row.beam = table_beam(geometry, scene, at, recipe, random);
    reach = 3.5 * row.beam.range_m * kTableBeam_rad / std::cos(row.beam.incidence_rad);
  } while ((table.target.albedo(row.beam.board_m).value_or(1.0) < 0.5) != black ||
           !is_plain_place(table.target, row.beam.board_m, reach));
  row.print = black ? Print::kBlack : Print::kWhite;
  row.beam.darkness = black ? 1.0 : 0.0;
  row.beam.white = black ? 0.0 : 1.0;
  row.sigma_m = recipe.range_sigma_m;
  row.measured_m = row.beam.range_m + row.sigma_m * random.normal();
  if (wrong.range_m) row.measured_m += wrong.range_m(row.beam);
  const double level = table.level_of(row.print);
  IntensityRow intensity{row.beam, row.print, 0.0, recipe.intensity_sigma, {0.0, level, {}}};
  double measured = level * (1.0 + intensity.sigma * random.normal());
  if (wrong.log_intensity) measured *= std::exp(wrong.log_intensity(intensity));
  intensity.reading.measured = measured;
  intensity.log_intensity = std::log(std::max(measured, 1e-3 * level));
  row.intensity = measured;
  table.range.push_back(row);
  table.intensity.push_back(intensity);
}

/// A return in the blur of a circle's edge.
inline void add_table_edge(SyntheticTable& out, int scene, const SceneGeometry& geometry,
                           const TargetNode& node, double psi_rad, const TableRecipe& recipe,
                           const Disturbance& wrong, Random& random) {
  MeasurementTable& table = out.table;
  const double radius = table.target.circle_radius_m;
  BoundaryRow row;
  row.node = node.id;
  row.sigma_m = recipe.edge_sigma_m;
  row.log_contrast = table.log_contrast;
  row.psi_rad = psi_rad;
  const Eigen::Vector2d outward(std::cos(psi_rad), std::sin(psi_rad));
  row.beam = table_beam(geometry, scene, node.center_m + radius * outward, recipe, random);
  row.transition_m = DiscSpot(row.beam, node.center_m).width_m(psi_rad, row.beam.slope_rad);
  // Somewhere in the transition.
  const double distance = row.transition_m * random.uniform(-0.8, 0.8);
  const Eigen::Vector2d at = node.center_m + (radius + distance) * outward;
  const Eigen::Vector3d p = geometry.lidar_from_board() * Eigen::Vector3d(at.x(), at.y(), 0.0);
  (void)geometry.describe(p.normalized(), row.beam);
  row.beam.edge = NearEdge{distance, psi_rad, row.transition_m};
  // The LiDAR's angles across the edge, by finite differences of the ray's board point.
  const double step = 1e-6;
  const auto board_at = [&](double daz, double del) {
    const double az = row.beam.azimuth_rad + daz / std::cos(row.beam.elevation_rad);
    const double el = row.beam.elevation_rad + del;
    BeamPoint moved;
    (void)geometry.describe(
        {std::cos(el) * std::cos(az), std::cos(el) * std::sin(az), std::sin(el)}, moved);
    return moved.board_m.dot(outward);
  };
  row.edge_normal_rad << (board_at(step, 0) - board_at(-step, 0)) / (2 * step),
      (board_at(0, step) - board_at(0, -step)) / (2 * step);
  const DiscSpot spot(row.beam, node.center_m);
  const double white = table.level_of(Print::kWhite);
  const double black = table.level_of(Print::kBlack);
  const auto seen = [&](double r) { return black + (white - black) * spot.white_share(r); };
  const double nudge = 0.02 * row.transition_m;
  const double slope = (seen(radius - nudge) - seen(radius + nudge)) / (2.0 * nudge);
  row.beam.darkness = std::log(white / seen(radius)) / table.log_contrast;
  row.beam.white = spot.white_share(radius);
  // An edge that lies farther outward makes the return darker.
  const double outward_m = wrong.edge_m ? wrong.edge_m(row) : 0.0;
  double measured = seen(radius + outward_m) + row.sigma_m * slope * random.normal();
  if (wrong.log_intensity) {
    const Print side = row.beam.darkness < 0.5 ? Print::kWhite : Print::kBlack;
    measured *= std::exp(wrong.log_intensity({row.beam, side, 0.0, row.sigma_m, {}}));
  }
  row.reading = {measured, -slope, {}};
  table.boundary.push_back(row);
}

inline void add_table_scene(SyntheticTable& out, int scene, const TableRecipe& recipe,
                            const Disturbance& wrong, Random& random) {
  MeasurementTable& table = out.table;
  const Target& target = table.target;
  const Rigid3 camera_from_board = table_board(target, recipe.alike ? 0 : scene);
  out.truth.camera_from_board.push_back(camera_from_board);
  out.truth.levels.push_back(
      {table.level_of(Print::kWhite), table.level_of(Print::kBlack), Eigen::Vector2d::Zero()});
  const SceneGeometry geometry(out.truth.camera_from_lidar, camera_from_board);
  TableScene info;
  info.name = std::string(1, static_cast<char>('A' + scene));
  geometry.tell_middle(target.outline().center_m(), info);
  info.clock = recipe.scenes > 1 ? scene / (recipe.scenes - 1.0) : 0.0;
  for (int k = 0; k < recipe.range_rows; ++k)
    add_table_return(out, scene, geometry, 2 * k < recipe.range_rows, recipe, wrong, random);
  for (const TargetNode& node : target.nodes()) {
    for (int bin = 0; bin < 24; ++bin)
      add_table_edge(out, scene, geometry, node, 2.0 * M_PI * bin / 24.0, recipe, wrong, random);
  }
  for (const TargetTag& tag : target.tags()) {
    const auto corners = target.tag_corners_m(tag);
    const auto center = table.camera.project(
        camera_from_board * Eigen::Vector3d(tag.center_m.x(), tag.center_m.y(), 0.0));
    info.features.push_back(tag.id);
    for (int k = 0; k < 4; ++k) {
      CornerRow row;
      row.scene = scene;
      row.feature = tag.id;
      row.corner = k;
      row.board_m = corners[static_cast<std::size_t>(k)];
      row.from_tag_m = row.board_m - tag.center_m;
      row.sigma_px = recipe.corner_sigma_px;
      const auto pixel = table.camera.project(
          camera_from_board * Eigen::Vector3d(row.board_m.x(), row.board_m.y(), 0.0));
      if (!pixel || !center) continue;
      row.pixel = *pixel;
      row.from_tag_px = *pixel - *center;
      if (wrong.corner_px) row.pixel += wrong.corner_px(row);
      row.pixel += random_2d(random, row.sigma_px);
      table.corner.push_back(row);
    }
  }
  table.scenes.push_back(std::move(info));
}

inline SyntheticTable synthetic_table(const TableRecipe& recipe, const Disturbance& wrong = {}) {
  SyntheticTable out;
  out.table.camera = test_camera();
  out.table.has_time = recipe.time;
  out.table.has_intensity = true;
  out.table.print = table_print();
  out.table.level = {100.0, 10.0};
  out.table.log_contrast = std::log(10.0);
  if (recipe.lines) out.table.lines = {0, 1, 2, 3, 4, 5};
  out.truth.camera_from_lidar = test_extrinsic();
  out.truth.beam.blur_rad2 = kTableBeam_rad * kTableBeam_rad * Eigen::Matrix2d::Identity();
  Random random(recipe.seed);
  for (int s = 0; s < recipe.scenes; ++s) add_table_scene(out, s, recipe, wrong, random);
  return out;
}

}  // namespace lvcalib::test
