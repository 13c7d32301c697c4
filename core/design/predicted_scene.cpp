// SPDX-License-Identifier: BSD-3-Clause
#include "design/predicted_scene.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "base/parallel.h"
#include "base/statistics.h"
#include "model/catalogue_effect.h"
#include "model/scene_geometry.h"

namespace lvcalib {
namespace {

// Places on the board, of which each stands for as many points as fall about it. Edges take a tenth
// to a third of a print, so that tens of places see one.
constexpr int kPlaces = 400;
constexpr double kMostPoints = 20000.0;  // kept per scene, as in the table

// Stretch of the footprint along ψ by the incidence.
double stretch(const BeamPoint& beam, double psi_rad) {
  const double c = std::tan(beam.incidence_rad) * std::cos(psi_rad - beam.slope_rad);
  return std::sqrt(1.0 + c * c);
}

double board_area_m2(const Target& target) {
  return target.outline().size_m().prod();
}

// Points that fall on a square metre of the board about a beam.
double points_per_m2(const SensorModel& sensors, const BeamPoint& beam) {
  return sensors.points_per_sr * std::cos(beam.incidence_rad) / (beam.range_m * beam.range_m);
}

// Even in the plane at every length (R2 sequence: powers of the plastic number).
Eigen::Vector2d quasi_random(int k) {
  constexpr double kPlastic = 1.32471795724474602596;
  double whole = 0.0;
  return {std::modf(0.5 + (k + 1) / kPlastic, &whole),
          std::modf(0.5 + (k + 1) / (kPlastic * kPlastic), &whole)};
}

BeamSpread beam_of(const SensorModel& sensors) {
  BeamSpread out;
  out.blur_rad2 = sensors.footprint_rad * sensors.footprint_rad * Eigen::Matrix2d::Identity();
  return out;
}

BoardLevels levels_of(const MeasurementTable& table) {
  return {table.level_of(Print::kWhite), table.level_of(Print::kBlack), Eigen::Vector2d::Zero()};
}

// A board as a pose of it is seen.
struct SeenBoard {
  const SensorModel& sensors;
  const SceneGeometry& geometry;
  BoardLevels levels;
  BeamSpread beam;
};

// What the LiDAR tells of a beam besides its direction.
void set_trait(const SensorModel& sensors, const BeamTrait& trait, BeamPoint& beam) {
  beam.time_s = trait.time_s;
  beam.scan_rad_s = trait.scan_rad_s;
  beam.line = trait.line;
  if (sensors.lines_by_elevation > 0) {
    const double low = sensors.elevation_rad.x();
    const double share = (beam.elevation_rad - low) / (sensors.elevation_rad.y() - low);
    const int lines = sensors.lines_by_elevation;
    beam.line = std::clamp(static_cast<int>(share * lines), 0, lines - 1);
  }
}

// A return that weighs as `root` squared of them.
void add_return(const SeenBoard& board, const ReturnPrediction& p, BeamPoint beam, double root,
                MeasurementTable& table) {
  if (table.log_contrast > 0.0 && p.intensity > 0.0)
    beam.darkness = std::log(table.level_of(Print::kWhite) / p.intensity) / table.log_contrast;
  beam.white = p.white;
  const PrintView view = view_print(p, board.levels, board.beam);
  if (view.slope > 0.0) {
    beam.edge =
        NearEdge{view.distance_m, view.psi_rad, view.width_m, view.kind == PrintView::Kind::kPlain};
  }
  const Print print = p.white > 0.5 ? Print::kWhite : Print::kBlack;
  RangeRow range;
  range.beam = beam;
  range.print = print;
  range.measured_m = p.range_m;
  range.intensity = p.intensity;
  range.sigma_m = board.sensors.range_sigma_m / root;
  table.range.push_back(range);
  if (!table.has_intensity) return;
  if (view.kind == PrintView::Kind::kPlain) {
    table.intensity.push_back({beam,
                               print,
                               std::log(p.intensity),
                               board.sensors.intensity_sigma / root,
                               {p.intensity, p.intensity, {}}});
  } else if (view.kind == PrintView::Kind::kEdge) {
    BoundaryRow edge;
    edge.beam = beam;
    edge.psi_rad = view.psi_rad;
    edge.transition_m = view.width_m;
    edge.log_contrast = table.log_contrast;
    edge.sigma_m = board.sensors.edge_noise * std::abs(board.levels.white - board.levels.black) /
                   view.slope / root;
    edge.reading = {p.intensity, -view.slope, {}};
    const AngleAxes axes = angle_axes(beam);
    const Eigen::Vector3d outward(std::cos(view.psi_rad), std::sin(view.psi_rad), 0.0);
    const Eigen::Vector3d a = board.geometry.edge_row(
        beam.direction, board.geometry.lidar_from_board().rotation * outward);
    edge.edge_normal_rad << a.dot(axes.azimuth_m), a.dot(axes.elevation_m);
    table.boundary.push_back(edge);
  }
}

void add_returns(const SeenBoard& board, MeasurementTable& table) {
  const BoardOutline outline = table.target.outline();
  const Rigid3& lidar_from_board = board.geometry.lidar_from_board();
  const BoardPredictor predictor(*table.print, lidar_from_board, board.levels, board.beam);
  const double cell = board_area_m2(table.target) / kPlaces;
  std::size_t next_trait = 0;
  for (int k = 0; k < kPlaces; ++k) {
    const Eigen::Vector2d at =
        outline.lower_left_m + quasi_random(k).cwiseProduct(outline.size_m());
    const Eigen::Vector3d p = lidar_from_board * Eigen::Vector3d(at.x(), at.y(), 0.0);
    BeamPoint beam;
    beam.scene = static_cast<int>(table.scenes.size());
    if (!board.geometry.describe(p.normalized(), beam)) continue;
    set_trait(board.sensors, board.sensors.traits[next_trait++ % board.sensors.traits.size()],
              beam);
    const auto seen = predictor.predict(beam.direction);
    if (!seen) continue;
    const double points =
        std::clamp(points_per_m2(board.sensors, beam) * cell, 1e-3, kMostPoints / kPlaces);
    add_return(board, *seen, beam, std::sqrt(points), table);
  }
}

void add_corner(const Rigid3& camera_from_board, CornerRow row,
                const std::optional<Eigen::Vector2d>& center, MeasurementTable& table) {
  const auto pixel_of = [&](const Eigen::Vector2d& at) {
    return table.camera.project(camera_from_board * Eigen::Vector3d(at.x(), at.y(), 0.0));
  };
  const auto pixel = pixel_of(row.board_m);
  if (!pixel) return;
  row.pixel = *pixel;
  if (center) {
    row.from_tag_m = row.board_m - *center;
    if (const auto middle = pixel_of(*center)) row.from_tag_px = *pixel - *middle;
  }
  table.corner.push_back(row);
}

// Lists the features that they belong to in `scene`, which is the table's next one.
void add_corners(const Rigid3& camera_from_board, double sigma_px, TableScene& scene,
                 MeasurementTable& table) {
  CornerRow row;
  row.scene = static_cast<int>(table.scenes.size());
  row.sigma_px = sigma_px;
  if (!table.target.has_tags()) {
    for (const Eigen::Vector2d& corner : table.target.checkerboard_corners_m()) {
      row.feature = static_cast<int>(scene.features.size());
      row.board_m = corner;
      scene.features.push_back(row.feature);
      add_corner(camera_from_board, row, std::nullopt, table);
    }
    return;
  }
  for (const TargetTag& tag : table.target.tags()) {
    scene.features.push_back(tag.id);
    row.feature = tag.id;
    const auto corners = table.target.tag_corners_m(tag);
    for (int k = 0; k < 4; ++k) {
      row.corner = k;
      row.board_m = corners[static_cast<std::size_t>(k)];
      add_corner(camera_from_board, row, tag.center_m, table);
    }
  }
}

void measure_field_of_view(const MeasurementTable& table, SensorModel& out) {
  // Boards are seldom held at the edge of what a sensor sees: so much more on either side.
  constexpr double kWider = 0.25;
  Eigen::Vector2d low = Eigen::Vector2d::Constant(HUGE_VAL);
  Eigen::Vector2d high = Eigen::Vector2d::Constant(-HUGE_VAL);
  for (const RangeRow& row : table.range) {
    const Eigen::Vector2d at(row.beam.azimuth_rad, row.beam.elevation_rad);
    low = low.cwiseMin(at);
    high = high.cwiseMax(at);
  }
  const Eigen::Vector2d margin = kWider * (high - low);
  out.azimuth_rad << low.x() - margin.x(), high.x() + margin.x();
  out.elevation_rad << low.y() - margin.y(), high.y() + margin.y();
}

void measure_ranges(const MeasurementTable& table, SensorModel& out) {
  std::map<int, std::vector<const RangeRow*>> scenes;
  std::vector<double> sigma;
  for (const RangeRow& row : table.range) {
    scenes[row.beam.scene].push_back(&row);
    sigma.push_back(row.sigma_m);
  }
  out.range_sigma_m = median(sigma);
  const double area = board_area_m2(table.target);
  std::vector<double> density;
  for (const auto& [scene, rows] : scenes) {
    double solid_angle = 0.0;  // of a square metre of the board
    for (const RangeRow* row : rows)
      solid_angle += std::cos(row->beam.incidence_rad) / (row->beam.range_m * row->beam.range_m);
    solid_angle /= static_cast<double>(rows.size());
    density.push_back(static_cast<double>(rows.size()) / (area * solid_angle));
  }
  out.points_per_sr = median(density);
  out.traits.clear();
  const std::size_t stride = 1 + table.range.size() / 256;
  for (std::size_t k = 0; k < table.range.size(); k += stride) {
    const BeamPoint& beam = table.range[k].beam;
    out.traits.push_back({beam.time_s, beam.scan_rad_s, beam.line});
  }
}

}  // namespace

SensorModel sensors_of(const MeasurementTable& table) {
  SensorModel out;
  if (table.range.empty()) return out;
  measure_field_of_view(table, out);
  measure_ranges(table, out);
  std::vector<double> values;
  for (const IntensityRow& row : table.intensity) values.push_back(row.sigma);
  if (!values.empty()) out.intensity_sigma = median(values);
  values.clear();
  for (const CornerRow& row : table.corner) values.push_back(row.sigma_px);
  if (!values.empty()) out.corner_sigma_px = median(values);
  std::vector<double> footprint;
  std::vector<double> noise;
  const double contrast = std::abs(table.level_of(Print::kWhite) - table.level_of(Print::kBlack));
  for (const BoundaryRow& row : table.boundary) {
    if (!(row.transition_m > 0.0)) continue;
    footprint.push_back(row.transition_m / (row.beam.range_m * stretch(row.beam, row.psi_rad)));
    noise.push_back(row.sigma_m * std::abs(row.reading.unit) / contrast);
  }
  if (!footprint.empty()) {
    out.footprint_rad = median(footprint);
    out.edge_noise = median(noise);
  }
  return out;
}

void take_field_of_view(const Cloud& cloud, SensorModel& sensors) {
  constexpr std::size_t kFewest = 100;   // fewer show no shape of a field
  constexpr std::size_t kMost = 20'000;  // tell an edge to a two-hundredth of the field
  constexpr double kOutermost = 0.002;   // share of returns left out on each side: reflections
  constexpr double kGap = 0.2 * std::numbers::pi;  // 36°: no post beside a scanner hides as much
  std::vector<Eigen::Vector2d> directions;
  std::vector<double> azimuths;
  const std::size_t stride = 1 + cloud.size() / kMost;
  for (std::size_t k = 0; k < cloud.size(); k += stride) {
    const Eigen::Vector3d p = cloud.points_m[k].cast<double>();
    if (!p.allFinite() || p.norm() < 1e-3) continue;
    directions.emplace_back(std::atan2(p.y(), p.x()), std::atan2(p.z(), p.head<2>().norm()));
    azimuths.push_back(directions.back().x());
  }
  if (directions.size() < kFewest) return;
  // The field begins behind the widest gap.
  std::sort(azimuths.begin(), azimuths.end());
  double gap = azimuths.front() + 2.0 * std::numbers::pi - azimuths.back();
  double first = azimuths.front();
  for (std::size_t k = 1; k < azimuths.size(); ++k) {
    if (azimuths[k] - azimuths[k - 1] <= gap) continue;
    gap = azimuths[k] - azimuths[k - 1];
    first = azimuths[k];
  }
  const auto span = [&](int axis) {
    std::vector<double> values;
    for (const Eigen::Vector2d& d : directions) values.push_back(d[axis]);
    std::sort(values.begin(), values.end());
    const auto out = static_cast<std::size_t>(kOutermost * static_cast<double>(values.size()));
    return Eigen::Vector2d(values[out], values[values.size() - 1 - out]);
  };
  const bool around = gap < kGap;
  for (Eigen::Vector2d& d : directions)
    if (!around && d.x() < first) d.x() += 2.0 * std::numbers::pi;
  sensors.azimuth_rad = around ? Eigen::Vector2d(-std::numbers::pi, std::numbers::pi) : span(0);
  sensors.elevation_rad = span(1);
  std::size_t in_corners = 0;
  for (const Eigen::Vector2d& d : directions) {
    const double x = (2.0 * d.x() - sensors.azimuth_rad.sum()) /
                     (sensors.azimuth_rad.y() - sensors.azimuth_rad.x());
    const double y = (2.0 * d.y() - sensors.elevation_rad.sum()) /
                     (sensors.elevation_rad.y() - sensors.elevation_rad.x());
    if (x * x + y * y > 1.0) ++in_corners;
  }
  // An even rectangle has 1 − π/4 of its returns there, an ellipse the few beyond the axes without
  // the outermost returns.
  const double even = (1.0 - 0.25 * std::numbers::pi) * static_cast<double>(directions.size());
  sensors.round = !around && static_cast<double>(in_corners) < 0.5 * even;
}

bool lidar_sees(const SensorModel& sensors, const Target& target, const Rigid3& lidar_from_board) {
  const BoardOutline outline = target.outline();
  const double middle = 0.5 * sensors.azimuth_rad.sum();
  const double half = 0.5 * (sensors.azimuth_rad.y() - sensors.azimuth_rad.x());
  for (int k = 0; k < 4; ++k) {
    const Eigen::Vector2d share(k % 2, k / 2);
    const Eigen::Vector2d at = outline.lower_left_m + share.cwiseProduct(outline.size_m());
    const Eigen::Vector3d p = lidar_from_board * Eigen::Vector3d(at.x(), at.y(), 0.0);
    const double azimuth = std::atan2(p.y(), p.x());
    if (std::abs(std::remainder(azimuth - middle, 2.0 * std::numbers::pi)) > half) return false;
    const double elevation = std::atan2(p.z(), p.head<2>().norm());
    if (elevation < sensors.elevation_rad.x() || elevation > sensors.elevation_rad.y())
      return false;
    const double across = std::remainder(azimuth - middle, 2.0 * std::numbers::pi) / half;
    const double up = (2.0 * elevation - sensors.elevation_rad.sum()) /
                      (sensors.elevation_rad.y() - sensors.elevation_rad.x());
    if (sensors.round && across * across + up * up > 1.0) return false;
  }
  // Seen from the front, not grazing.
  constexpr double kSteepest = 0.17;  // cos 80°
  const Eigen::Vector3d normal = lidar_from_board.rotation * Eigen::Vector3d::UnitZ();
  const Eigen::Vector2d center = outline.center_m();
  const Eigen::Vector3d at = lidar_from_board * Eigen::Vector3d(center.x(), center.y(), 0.0);
  return normal.dot(-at.normalized()) > kSteepest;
}

void append_predicted_scene(const GridPose& pose, const SensorModel& sensors,
                            MeasurementTable& table, ModelState& state) {
  const SceneGeometry geometry(state.camera_from_lidar, pose.camera_from_board);
  TableScene scene;
  scene.name = pose.text();
  scene.clock = 0.5;
  geometry.tell_middle(table.target.outline().center_m(), scene);
  add_returns({sensors, geometry, levels_of(table), beam_of(sensors)}, table);
  add_corners(pose.camera_from_board, sensors.corner_sigma_px, scene, table);
  table.scenes.push_back(std::move(scene));
  state.beam = beam_of(sensors);
  state.levels.push_back(levels_of(table));
  state.camera_from_board.push_back(pose.camera_from_board);
}

std::vector<Eigen::MatrixXd> predicted_information(const std::vector<GridPose>& poses,
                                                   const PredictionModel& model,
                                                   const RunContext& context) {
  MeasurementTable empty = model.like.without_rows();
  empty.scenes.clear();
  // Its own: boards nearby are seen through blurs finer than any measured, whose levels are large
  // (from 1.2 to 1.5 mm on a board of a metre 90 MB, with this spacing 23) and asked for by nobody
  // else.
  empty.print = std::make_shared<const BlurredPrint>(empty.target, BlurredPrint::kPlanSpacing);
  RunContext one_thread = context;
  one_thread.threads = 1;
  std::vector<Eigen::MatrixXd> out(poses.size());
  parallel_for(poses.size(), context.thread_count(), [&](std::size_t k) {
    if (context.stopped()) return;
    MeasurementTable table = empty;
    ModelState state{model.camera_from_lidar, {}};
    append_predicted_scene(poses[k], model.sensors, table, state);
    const Linearization linear = linearize(table, state, {}, model.columns, one_thread);
    if (!context.stopped())
      out[k] = scene_term(linear.scenes.front(), model.subset, model.variances).information;
  });
  if (context.stopped()) out.clear();
  return out;
}

}  // namespace lvcalib
