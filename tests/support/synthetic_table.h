// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Measurement tables drawn straight from poses and noise, with disturbances planted by functions of
// the test: nothing of the estimator's effects is used to make them.

#include <cmath>
#include <functional>
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

inline BeamPoint table_beam(const SceneGeometry& geometry, const Target& target, int scene,
                            const Eigen::Vector2d& board_m, const TableRecipe& recipe,
                            Random& random) {
  BeamPoint beam;
  beam.scene = scene;
  const Eigen::Vector3d p =
      geometry.lidar_from_board() * Eigen::Vector3d(board_m.x(), board_m.y(), 0.0);
  (void)geometry.describe(p.normalized(), beam);
  const bool black = target.albedo(board_m).value_or(1.0) < 0.5;
  beam.darkness = black ? 1.0 : 0.0;
  if (recipe.time) {
    beam.time_s = random.uniform(0.0, 0.1);
    const double direction = random.uniform(-M_PI, M_PI);
    beam.scan_rad_s = 60.0 * Eigen::Vector2d(std::cos(direction), std::sin(direction));
  }
  if (recipe.lines) beam.line = static_cast<int>(random.below(6));
  return beam;
}

inline void add_table_scene(SyntheticTable& out, int scene, const TableRecipe& recipe,
                            const Disturbance& wrong, Random& random) {
  MeasurementTable& table = out.table;
  const Target& target = table.target;
  const Rigid3 camera_from_board = table_board(target, recipe.alike ? 0 : scene);
  out.truth.camera_from_board.push_back(camera_from_board);
  const SceneGeometry geometry(out.truth.camera_from_lidar, camera_from_board);
  TableScene info{std::string(1, static_cast<char>('A' + scene)), {}, {}, 0.0};
  info.clock = recipe.scenes > 1 ? scene / (recipe.scenes - 1.0) : 0.0;
  const BoardOutline outline = target.outline();
  for (int k = 0; k < recipe.range_rows; ++k) {
    const Eigen::Vector2d at(random.uniform(outline.lower_left_m.x(), outline.upper_right_m.x()),
                             random.uniform(outline.lower_left_m.y(), outline.upper_right_m.y()));
    RangeRow row;
    row.beam = table_beam(geometry, target, scene, at, recipe, random);
    row.print = row.beam.darkness > 0.5 ? Print::kBlack : Print::kWhite;
    row.sigma_m = recipe.range_sigma_m;
    row.measured_m = row.beam.range_m + row.sigma_m * random.normal();
    if (wrong.range_m) row.measured_m += wrong.range_m(row.beam);
    table.range.push_back(row);
    IntensityRow intensity{row.beam, row.print, 0.0, recipe.intensity_sigma};
    intensity.log_intensity =
        std::log(table.level_of(row.print)) + intensity.sigma * random.normal();
    if (wrong.log_intensity) intensity.log_intensity += wrong.log_intensity(intensity);
    table.intensity.push_back(intensity);
  }
  for (const TargetNode& node : target.nodes()) {
    info.nodes.push_back(node.id);
    for (int bin = 0; bin < 24; ++bin) {
      BoundaryRow row;
      row.node = node.id;
      row.center_m = node.center_m;
      row.radius_m = target.circle_radius_m;
      row.psi_rad = 2.0 * M_PI * bin / 24.0;
      row.sigma_m = recipe.edge_sigma_m;
      row.transition_m = 0.01;
      row.log_contrast = 2.0;
      const Eigen::Vector2d outward(std::cos(row.psi_rad), std::sin(row.psi_rad));
      row.beam = table_beam(geometry, target, scene, node.center_m + row.radius_m * outward, recipe,
                            random);
      double d = row.sigma_m * random.normal();
      if (wrong.edge_m) d += wrong.edge_m(row);
      const Eigen::Vector2d at = node.center_m + (row.radius_m + d) * outward;
      const Eigen::Vector3d p = geometry.lidar_from_board() * Eigen::Vector3d(at.x(), at.y(), 0.0);
      (void)geometry.describe(p.normalized(), row.beam);
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
      table.boundary.push_back(row);
    }
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
  out.table.level = {100.0, 10.0, 10.0};
  out.table.log_contrast = std::log(10.0);
  if (recipe.lines) out.table.lines = {0, 1, 2, 3, 4, 5};
  out.truth.camera_from_lidar = test_extrinsic();
  Random random(recipe.seed);
  for (int s = 0; s < recipe.scenes; ++s) add_table_scene(out, s, recipe, wrong, random);
  return out;
}

}  // namespace lvcalib::test
