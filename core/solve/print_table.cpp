// SPDX-License-Identifier: BSD-3-Clause
#include "solve/print_table.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <tuple>

#include "base/parallel.h"
#include "base/statistics.h"
#include "model/catalogue_effect.h"
#include "model/effect_rows.h"
#include "model/noise_floor.h"
#include "model/scan_velocity.h"
#include "model/scene_geometry.h"
#include "model/sensor_errors.h"
#include "solve/board_returns.h"
#include "solve/pointing_jitter.h"
#include "solve/surface_noise.h"

namespace lvcalib {
namespace {

constexpr int kCells = 16;  // Board cells along a side, for even thinning.
// Black that returns next to nothing has no logarithm: a hundredth of white stands for it.
constexpr double kLeastShare = 0.01;
constexpr double kRobustThreshold = 3.0;  // Huber's threshold, as in the joint solve.

// A return and what is predicted of it.
struct Return {
  BeamPoint beam;
  std::uint32_t point = 0;  // In the scene's cloud.
  std::uint64_t lot = 0;    // Decides which returns stay where there are too many.
  double measured_m = 0.0;
  double range_residual_m = 0.0;
  double intensity = 0.0;
  double predicted = 0.0;
  double plain_level = 0.0;  // Predicted without what effects do to intensities.
  double white = 1.0;        // Share in the blurred spot.
  double slope = 0.0;        // Of the intensity across the edge, per metre.
  PrintView::Kind print = PrintView::Kind::kPlain;
  Eigen::RowVector2d by_angle = Eigen::RowVector2d::Zero();  // Of the intensity, per radian.
  LocalPrint seen;    // The print at the place that the ray meets,
  LocalPrint moved;   // at the one that effects displace under its light,
  LocalPrint ranged;  // and under what is ranged.

  [[nodiscard]] bool is_plain() const { return print == PrintView::Kind::kPlain; }
  [[nodiscard]] bool is_edge() const { return print == PrintView::Kind::kEdge; }
  [[nodiscard]] std::size_t surface() const { return white > 0.5 ? 0 : 1; }
};

// The rows of one scene.
struct TableRows {
  std::vector<RangeRow> range;
  std::vector<BoundaryRow> boundary;
  std::vector<IntensityRow> intensity;
};

// A scene as it is kept for as long as its table may be made again.
struct KeptScene {
  SceneMeasurements measured;
  Cloud cloud;
  std::vector<Eigen::Vector2d> scan_rad_s;  // Empty if the cloud does not tell.
};

struct SurfaceNoise {
  std::array<double, 2> range_m{};  // White, black.
  std::array<double, 2> intensity{};
};

// A number as if drawn by lot, from the ray alone: the same whenever and in whatever order the
// returns are asked (the finalizer of SplitMix64).
std::uint64_t lot_of(const Eigen::Vector3d& direction) {
  std::uint64_t out = 0;
  for (int k = 0; k < 3; ++k) {
    out += 0x9e3779b97f4a7c15ULL + std::bit_cast<std::uint64_t>(direction(k));
    out = (out ^ (out >> 30)) * 0xbf58476d1ce4e5b9ULL;
    out = (out ^ (out >> 27)) * 0x94d049bb133111ebULL;
    out ^= out >> 31;
  }
  return out;
}

double robust_sigma(double sigma, double residual) {
  return sigma / std::sqrt(huber_weight(residual / sigma, kRobustThreshold));
}

// What effects in use do to single returns: the displacement of the print under the beam, the
// logarithm of the intensity, the range.
class ReturnEffects {
 public:
  ReturnEffects(const MeasurementTable& table, const std::vector<EffectInUse>& in_use)
      : table_(table),
        in_use_(in_use),
        columns_(columns_in_use(in_use, table)),
        rows_(table, columns_.list()) {}
  ReturnEffects(const ReturnEffects&) = delete;
  ReturnEffects& operator=(const ReturnEffects&) = delete;

  struct Sum {
    PrintChange light;   // To the print under the light,
    PrintChange ranged;  // and under what is ranged.
    double log_intensity = 0.0;
    double range_m = 0.0;
  };
  [[nodiscard]] bool any() const { return !in_use_.empty(); }
  // `near`: the edge that the spot sees, if any.
  Sum of(const SceneGeometry& geometry, const Eigen::Matrix3d& rotation, BeamPoint beam,
         double predicted, const std::optional<NearEdge>& near, double log_contrast) {
    Sum out;
    if (in_use_.empty()) return out;
    beam.darkness = darkness(table_, predicted);
    const Print side = beam.darkness < 0.5 ? Print::kWhite : Print::kBlack;
    if (near) beam.edge = near;
    const auto edge = edge_beside(beam, log_contrast);
    const BoundaryRow* seen = edge ? &*edge : nullptr;
    const PrintSensitivity::Moves moves(geometry, rotation, beam.direction);
    double growth = 0.0;
    rows_.reading({beam, side, 0.0, 1.0, {}}, seen, moves,
                  [&](const EffectColumns& c, const PrintSensitivity::Change& by) {
                    for (std::size_t k = 0; k < by.shift_m.size(); ++k) {
                      out.light.shift_m += value(c, k) * by.shift_m[k];
                      growth += value(c, k) * by.growth_m[k];
                      out.log_intensity += value(c, k) * by.log_intensity[k];
                    }
                  });
    RangeRow range;
    range.beam = beam;
    range.print = side;
    range.intensity = predicted;
    rows_.range(range, geometry.range_row(beam.direction), moves, seen,
                [&](const EffectColumns& c, const EffectRows::RangeChange& by) {
                  for (std::size_t k = 0; k < by.range_m.size(); ++k) {
                    out.range_m += value(c, k) * by.range_m[k];
                    out.ranged.shift_m += value(c, k) * by.shift_m[k];
                  }
                });
    if (growth != 0.0) out.light.growth_m = out.ranged.growth_m = growth;
    return out;
  }

  static double darkness(const MeasurementTable& table, double predicted) {
    if (!(table.log_contrast > 0.0)) return 0.0;
    const double white = table.level_of(Print::kWhite);
    return std::log(white / std::max(predicted, kLeastShare * white)) / table.log_contrast;
  }

 private:
  [[nodiscard]] double value(const EffectColumns& c, std::size_t k) const {
    const auto at = static_cast<std::size_t>(&c - columns_.list().data());
    return in_use_[at].values(static_cast<Eigen::Index>(k));
  }
  const MeasurementTable& table_;
  const std::vector<EffectInUse>& in_use_;
  EffectColumnsList columns_;
  EffectRows rows_;
};

// Gradient of a board coordinate along ψ by the LiDAR's angles (see BoundaryRow).
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

class SceneRows {
 public:
  // `known`: the print as all points of the scene saw it before, by their places in the cloud; may
  // be null.
  SceneRows(const KeptScene& input, int scene, const BlurredPrint& print, const ModelState& state,
            const SceneNoise& noise, ReturnEffects& effects, const std::vector<LocalPrint>* known)
      : known_(known),
        input_(input.measured),
        velocities_(input.scan_rad_s),
        scene_(scene),
        print_(print),
        levels_(state.levels[static_cast<std::size_t>(scene)]),
        jitter_rad2_(state.beam.jitter_rad2),
        geometry_(state.camera_from_lidar,
                  state.camera_from_board[static_cast<std::size_t>(scene)]) {
    collect(state.beam, noise, effects);
    measure_noise(noise);
  }

  [[nodiscard]] bool has_intensity() const { return has_intensity_; }
  [[nodiscard]] const BoardLevels& levels() const { return levels_; }
  // The print as every point of the scene saw it.
  [[nodiscard]] std::vector<LocalPrint> seen() const {
    std::vector<LocalPrint> out(input_.board_points->size());
    for (const Return& r : returns_) out[r.point] = r.seen;
    return out;
  }

  // What the scene's edges say of the jitter, and the jitter as all scenes say it.
  [[nodiscard]] JitterRegression scatter() const {
    JitterRegression out;
    for (const Return& r : returns_) {
      if (r.by_angle.isZero()) continue;
      const double plain = plain_sigma(r);
      out.add(r.by_angle, r.intensity - r.predicted, plain * plain,
              intensity_variance(plain, r.by_angle, jitter_rad2_));
    }
    return out;
  }
  void set_jitter(const Eigen::Matrix2d& jitter_rad2) { jitter_rad2_ = jitter_rad2; }

  // `usual`: has the levels of all scenes, to which darkness refers.
  [[nodiscard]] TableRows rows(const MeasurementTable& usual, std::size_t most) {
    for (Return& r : returns_) r.beam.darkness = ReturnEffects::darkness(usual, r.plain_level);
    TableRows out;
    for (const std::size_t k : thinned([](const Return&) { return true; }, most))
      out.range.push_back(range_row(returns_[k]));
    if (!has_intensity_) return out;
    for (const std::size_t k : thinned([](const Return& r) { return r.is_edge(); }, most))
      out.boundary.push_back(edge_row(returns_[k]));
    for (const std::size_t k : thinned([](const Return& r) { return r.is_plain(); }, most))
      out.intensity.push_back(intensity_row(returns_[k]));
    return out;
  }

 private:
  // A point of the cloud as the model sees it, and what effects in use do to it.
  struct Look {
    Return r;
    ReturnPrediction predicted;
    ReturnEffects::Sum by_effects;
  };
  [[nodiscard]] std::optional<Look> look_at(std::uint32_t i, const BoardPredictor& predictor,
                                            const Eigen::Matrix3d& rotation, const BeamSpread& beam,
                                            ReturnEffects& effects) const {
    const Cloud& cloud = *input_.board_points;
    Look out;
    Return& r = out.r;
    r.point = i;
    const Eigen::Vector3d point = cloud.points_m[i].cast<double>();
    r.measured_m = point.norm();
    r.beam.scene = scene_;
    const Eigen::Vector3d direction = point / r.measured_m;
    r.lot = lot_of(direction);
    if (known_ != nullptr) r.seen = (*known_)[i];
    const auto p = predictor.predict(direction, {}, &r.seen, &r.seen);
    if (!p || !geometry_.describe(direction, r.beam)) return std::nullopt;
    out.predicted = *p;
    if (cloud.has_time()) r.beam.time_s = cloud.time_s[i];
    if (cloud.has_line()) r.beam.line = cloud.line[i];
    if (!velocities_.empty()) r.beam.scan_rad_s = velocities_[i];
    const PrintView view = view_print(*p, levels_, beam);
    r.beam.white = p->white;
    r.beam.jitter_share = jitter_share(*p, beam);
    out.by_effects = effects.of(geometry_, rotation, r.beam, p->intensity, edge_of(*p, view),
                                log_contrast(levels_));
    return out;
  }

  void collect(const BeamSpread& beam, const SceneNoise& noise, ReturnEffects& effects) {
    const Eigen::Matrix3d rotation = geometry_.lidar_from_board().rotation.toRotationMatrix();
    const Cloud& cloud = *input_.board_points;
    const BoardPredictor predictor(print_, geometry_.lidar_from_board(), levels_, beam);
    // A return belongs to the board if its range is what the model in force predicts: offsets of a
    // sensor and of one of its lines add up to more than five of its deviations.
    std::function<double(std::uint32_t)> added_m;
    if (effects.any()) {
      added_m = [&](std::uint32_t i) {
        const auto look = look_at(i, predictor, rotation, beam, effects);
        return look ? look->by_effects.range_m : 0.0;
      };
    }
    ReturnSelection selection;
    selection.uncovered = input_.uncovered;
    const BoardReturns kept =
        select_returns(cloud, print_, geometry_.lidar_from_board(), beam,
                       {noise.range_white_m, noise.range_black_m}, selection, added_m);
    has_intensity_ = kept.has_intensity;
    for (std::size_t k = 0; k < kept.size(); ++k) {
      const auto look = look_at(kept.index[k], predictor, rotation, beam, effects);
      if (!look) continue;
      Return r = look->r;
      const ReturnEffects::Sum& sum = look->by_effects;
      const Eigen::Vector3d direction = kept.point_m(k) / r.measured_m;
      std::optional<ReturnPrediction> p = look->predicted;
      r.ranged = r.moved = r.seen;
      auto ranged = p;
      if (!sum.ranged.shift_m.isZero() || sum.ranged.growth_m)
        ranged = predictor.predict(direction, sum.ranged, &r.ranged, &r.ranged);
      if ((sum.light.shift_m - sum.ranged.shift_m).isZero(1e-9)) {
        r.moved = r.ranged;
        p = ranged;
      } else {
        p = predictor.predict(direction, sum.light, &r.moved, &r.moved);
      }
      r.range_residual_m = r.measured_m - ranged->range_m - sum.range_m;
      r.white = r.beam.white = p->white;
      r.plain_level = p->intensity;
      if (has_intensity_)
        describe_print(*p, beam, kept.intensity(k), std::exp(sum.log_intensity), r);
      returns_.push_back(r);
    }
    // In the order of the scan, whatever order the file has.
    const auto key = [](const Return& r) {
      return std::tuple{r.beam.time_s, r.beam.line, r.beam.azimuth_rad, r.beam.elevation_rad,
                        r.measured_m};
    };
    std::sort(returns_.begin(), returns_.end(),
              [&](const Return& a, const Return& b) { return key(a) < key(b); });
  }

  // Of the jitter in the blur's variance across the print's edge.
  [[nodiscard]] static double jitter_share(const ReturnPrediction& p, const BeamSpread& beam) {
    const Eigen::RowVector2d& g = p.intensity_by_angle;
    const double blur = g.dot(g * beam.blur_rad2);
    return blur > 0.0 ? std::clamp(g.dot(g * beam.jitter_rad2) / blur, 0.0, 1.0) : 0.0;
  }

  // The edge that a spot sees, or of which plain print has a trace.
  [[nodiscard]] static std::optional<NearEdge> near_edge(const PrintView& view) {
    if (!(view.slope > 0.0)) return std::nullopt;
    return NearEdge{view.distance_m, view.psi_rad, view.width_m,
                    view.kind == PrintView::Kind::kPlain};
  }

  // The same, and where no edge is seen one just out of sight: black that grows may bring it in.
  [[nodiscard]] static NearEdge edge_of(const ReturnPrediction& p, const PrintView& view) {
    if (const auto edge = near_edge(view)) return *edge;
    const double width = std::sqrt(0.5 * p.spot_m2.trace());
    return {p.white > 0.5 ? 4.0 * width : -4.0 * width, 0.0, width, true};
  }

  void describe_print(const ReturnPrediction& p, const BeamSpread& beam, double intensity,
                      double gain, Return& r) const {
    r.intensity = intensity;
    r.predicted = gain * p.intensity;
    r.by_angle = gain * p.intensity_by_angle;
    const PrintView view = view_print(p, levels_, beam);
    r.print = view.kind;
    r.slope = view.slope;
    r.beam.edge = near_edge(view);
  }

  void measure_noise(const SceneNoise& fallback) {
    std::array<Replicates, 2> ranges;
    std::array<Replicates, 2> intensities;
    for (const Return& r : returns_) {
      if (!r.is_plain()) continue;
      ranges[r.surface()].add(r.beam, r.range_residual_m);
      if (has_intensity_) intensities[r.surface()].add(r.beam, r.intensity - r.predicted);
    }
    const std::array<double, 2> range{fallback.range_white_m, fallback.range_black_m};
    const std::array<double, 2> intensity{fallback.intensity_white, fallback.intensity_black};
    for (std::size_t k = 0; k < 2; ++k) {
      noise_.range_m[k] = ranges[k].sigma();
      if (noise_.range_m[k] <= 0.0) noise_.range_m[k] = range[k];
      noise_.range_m[k] = std::max(noise_.range_m[k], 1e-5);
      noise_.intensity[k] = intensities[k].sigma();
      // Whole numbers: most replicates may be alike.
      constexpr double kStep = 0.2887;
      if (noise_.intensity[k] < kStep) noise_.intensity[k] = std::max(1e-9, intensity[k]);
    }
  }

  // Places of the returns wanted, at most `most`, evenly over board cells and surfaces. Which ones
  // stay is drawn by lot, the same for every table: if a few change their kind, the others stay.
  template <class Wanted>
  [[nodiscard]] std::vector<std::size_t> thinned(const Wanted& wanted, std::size_t most) const {
    std::map<int, std::vector<std::size_t>> cells;
    std::size_t all = 0;
    const BoardOutline& outline = print_.outline();
    for (std::size_t k = 0; k < returns_.size(); ++k) {
      if (!wanted(returns_[k])) continue;
      const Eigen::Vector2d share =
          (returns_[k].beam.board_m - outline.lower_left_m).cwiseQuotient(outline.size_m());
      const int x = std::clamp(static_cast<int>(share.x() * kCells), 0, kCells - 1);
      const int y = std::clamp(static_cast<int>(share.y() * kCells), 0, kCells - 1);
      cells[2 * (y * kCells + x) + static_cast<int>(returns_[k].surface())].push_back(k);
      ++all;
    }
    std::vector<std::size_t> out;
    const double quota =
        static_cast<double>(most) / static_cast<double>(std::max<std::size_t>(1, cells.size()));
    for (auto& [cell, members] : cells) {
      const std::size_t take =
          all <= most ? members.size()
                      : std::min(members.size(), static_cast<std::size_t>(std::max(1.0, quota)));
      if (take < members.size()) {
        std::nth_element(
            members.begin(), members.begin() + static_cast<std::ptrdiff_t>(take), members.end(),
            [&](std::size_t a, std::size_t b) { return returns_[a].lot < returns_[b].lot; });
      }
      out.insert(out.end(), members.begin(), members.begin() + static_cast<std::ptrdiff_t>(take));
    }
    std::sort(out.begin(), out.end());
    return out;
  }

  [[nodiscard]] RangeRow range_row(const Return& r) const {
    RangeRow row;
    row.beam = r.beam;
    row.measured_m = r.measured_m;
    row.intensity = r.intensity;
    row.print = r.surface() == 0 ? Print::kWhite : Print::kBlack;
    row.sigma_m = robust_sigma(noise_between(noise_.range_m[0], noise_.range_m[1], r.white),
                               r.range_residual_m);
    row.seen = r.ranged;
    return row;
  }

  [[nodiscard]] double plain_sigma(const Return& r) const {
    return noise_between(noise_.intensity[0], noise_.intensity[1], r.white);
  }

  [[nodiscard]] double intensity_sigma(const Return& r) const {
    const double variance = intensity_variance(plain_sigma(r), r.by_angle, jitter_rad2_);
    return robust_sigma(std::sqrt(variance), r.intensity - r.predicted);
  }

  [[nodiscard]] BoundaryRow edge_row(const Return& r) const {
    BoundaryRow row;
    row.beam = r.beam;
    row.psi_rad = r.beam.edge->psi_rad;
    row.transition_m = r.beam.edge->transition_m;
    row.log_contrast = log_contrast(levels_);
    row.sigma_m = intensity_sigma(r) / r.slope;
    row.edge_normal_rad = edge_normal(geometry_, r.beam, row.psi_rad);
    row.reading = {r.intensity, -r.slope, r.moved};
    const double radius = print_.target().circle_radius_m;
    for (const TargetNode& node : print_.target().nodes()) {
      if (std::abs((r.beam.board_m - node.center_m).norm() - radius) > 3.0 * row.transition_m)
        continue;
      row.node = node.id;
    }
    return row;
  }

  [[nodiscard]] IntensityRow intensity_row(const Return& r) const {
    const double sigma = intensity_sigma(r);
    // Told as a logarithm as far as there is one.
    const double unit = std::max(r.predicted, 3.0 * sigma);
    return {r.beam,
            r.surface() == 0 ? Print::kWhite : Print::kBlack,
            std::log(std::max(r.intensity, 1e-3 * unit)),
            sigma / unit,
            {r.intensity, unit, r.moved}};
  }

  const std::vector<LocalPrint>* known_;
  const SceneMeasurements& input_;
  const std::vector<Eigen::Vector2d>& velocities_;
  int scene_;
  const BlurredPrint& print_;
  BoardLevels levels_;
  Eigen::Matrix2d jitter_rad2_;
  SceneGeometry geometry_;
  std::vector<Return> returns_;
  SurfaceNoise noise_;
  bool has_intensity_ = false;
};

// The joint solve's variances by the groups of the search; what was not admitted there stays
// absent.
std::vector<double> structure_variances(const ForwardNoise& noise) {
  std::vector<double> out(kAbsentVariance.begin(), kAbsentVariance.end());
  const auto take = [&](VarianceGroup to, SharedError from) {
    if (noise.admitted[static_cast<std::size_t>(from)])
      out[static_cast<std::size_t>(to)] = noise.shared[static_cast<std::size_t>(from)];
  };
  take(VarianceGroup::kRangeShape, SharedError::kRangeShape);
  take(VarianceGroup::kCornerGroup, SharedError::kCornerGroup);
  take(VarianceGroup::kBoardShift, SharedError::kBoardShift);
  take(VarianceGroup::kBoardNormal, SharedError::kBoardNormal);
  take(VarianceGroup::kBoardTilt, SharedError::kBoardTilt);
  take(VarianceGroup::kBoardSpin, SharedError::kBoardSpin);
  take(VarianceGroup::kPrintPatch, SharedError::kPrintPatch);
  take(VarianceGroup::kLineRange, SharedError::kLineRange);
  take(VarianceGroup::kLineGain, SharedError::kLineGain);
  return out;
}

// The same of the sensor's errors.
std::vector<double> sensor_variances(const ForwardNoise& noise) {
  std::vector<double> out;
  for (const SharedError kind :
       {SharedError::kSensorRange, SharedError::kSensorDark, SharedError::kSensorLine}) {
    const auto k = static_cast<std::size_t>(kind);
    out.push_back(noise.admitted[k] ? noise.shared[k] : kAbsentSensorError);
  }
  return out;
}

// One channel's rows of all scenes, in their order; those of the scenes are gone.
template <class Row>
void gather(std::vector<Row> TableRows::*rows, std::vector<TableRows>& scenes,
            std::vector<Row>& to) {
  std::size_t count = 0;
  for (const TableRows& scene : scenes) count += (scene.*rows).size();
  to.reserve(count);
  for (TableRows& scene : scenes) {
    to.insert(to.end(), (scene.*rows).begin(), (scene.*rows).end());
    (scene.*rows) = {};
  }
}

// Makes the table of some scenes, and makes it again for other states and effects in use.
class TableMaker {
 public:
  TableMaker(const TableInput& input, const TableOptions& options, const RunContext& context)
      : input_(input), options_(options), scenes_(input.scenes.size()) {
    parallel_for(scenes_.size(), context.thread_count(), [&](std::size_t s) {
      KeptScene& scene = scenes_[s];
      scene.measured = input.scenes[s];
      scene.cloud = *input.scenes[s].board_points;
      scene.measured.board_points = &scene.cloud;
      scene.scan_rad_s = scan_velocities(scene.cloud);
    });
    input_.scenes.clear();
  }
  TableMaker(const TableMaker&) = delete;
  TableMaker& operator=(const TableMaker&) = delete;

  // Keeps what tables that replace it are like. Incomplete when stopped.
  MeasurementTable first(const ModelState& state, const RunContext& context) {
    MeasurementTable table = without_rows({}, state);
    Rows rows = see(table, state, {}, nullptr, context);
    if (context.stopped()) return table;
    tell_levels(rows, table);
    seen_.resize(scenes_.size());
    fill(rows, state, &seen_, context, table);
    if (all_have_lines()) tell_lines(table);
    if (!context.stopped()) like_ = table.without_rows();
    return table;
  }

  [[nodiscard]] MeasurementTable again(const ModelState& state,
                                       const std::vector<EffectInUse>& in_use,
                                       const RunContext& context) const {
    MeasurementTable table = without_rows(like_, state);
    Rows rows = see(table, state, in_use, &seen_, context);
    if (context.stopped()) return table;
    if (table.has_intensity) tell_jitter(state, rows, table);
    fill(rows, state, nullptr, context, table);
    return table;
  }

 private:
  using Rows = std::vector<std::optional<SceneRows>>;
  using Seen = std::vector<std::vector<LocalPrint>>;

  [[nodiscard]] MeasurementTable without_rows(MeasurementTable table,
                                              const ModelState& state) const {
    const ForwardNoise& noise = input_.noise;
    table.scenes.clear();
    table.print = input_.print;
    table.target = input_.print->target();
    table.camera = input_.camera;
    table.placed_by = state;
    table.structure_variances = structure_variances(noise);
    table.sensor_variances = sensor_variances(noise);
    table.has_time = !scenes_.empty();
    for (std::size_t s = 0; s < scenes_.size(); ++s) {
      TableScene scene;
      scene.name = scenes_[s].measured.name;
      scene.clock = scene_clock(s, scenes_.size());
      scene.inflation[static_cast<std::size_t>(Channel::kRange)] = noise.scenes[s].range_inflation;
      for (const Channel channel : {Channel::kBoundary, Channel::kIntensity})
        scene.inflation[static_cast<std::size_t>(channel)] = noise.scenes[s].intensity_inflation;
      table.scenes.push_back(std::move(scene));
      table.has_time = table.has_time && scenes_[s].cloud.has_time();
      SceneGeometry(state.camera_from_lidar, state.camera_from_board[s])
          .tell_middle(table.target.outline().center_m(), table.scenes.back());
    }
    return table;
  }

  // `known`: the print as every return saw it before; may be null.
  [[nodiscard]] Rows see(const MeasurementTable& table, const ModelState& state,
                         const std::vector<EffectInUse>& in_use, const Seen* known,
                         const RunContext& context) const {
    Rows rows(scenes_.size());
    parallel_for(scenes_.size(), context.thread_count(), [&](std::size_t s) {
      if (context.stopped()) return;
      ReturnEffects effects(table, in_use);
      rows[s].emplace(scenes_[s], static_cast<int>(s), *input_.print, state, input_.noise.scenes[s],
                      effects, known != nullptr ? &(*known)[s] : nullptr);
    });
    return rows;
  }

  static void tell_levels(const Rows& rows, MeasurementTable& table) {
    std::vector<double> white;
    std::vector<double> black;
    table.has_intensity = !rows.empty();
    for (const auto& scene : rows) {
      table.has_intensity = table.has_intensity && scene->has_intensity();
      white.push_back(scene->levels().white);
      black.push_back(std::max(scene->levels().black, kLeastShare * scene->levels().white));
    }
    if (!table.has_intensity) return;
    table.level = {median(white), median(black)};
    table.log_contrast = std::log(table.level[0] / table.level[1]);
  }

  // What an effect explains is no jitter.
  static void tell_jitter(const ModelState& state, Rows& rows, MeasurementTable& table) {
    JitterRegression jitter;
    for (const auto& scene : rows) jitter.add(scene->scatter());
    const auto found = jitter.jitter_rad2(state.beam.blur_rad2);
    if (!found) return;
    table.placed_by.beam.jitter_rad2 = *found;
    for (auto& scene : rows) scene->set_jitter(*found);
  }

  [[nodiscard]] bool all_have_lines() const {
    return !scenes_.empty() && std::all_of(scenes_.begin(), scenes_.end(),
                                           [](const KeptScene& s) { return s.cloud.has_line(); });
  }

  static void tell_lines(MeasurementTable& table) {
    for (const RangeRow& row : table.range) table.lines.push_back(row.beam.line);
    std::sort(table.lines.begin(), table.lines.end());
    table.lines.erase(std::unique(table.lines.begin(), table.lines.end()), table.lines.end());
  }

  // Every row; `seen`, if wanted, becomes the print as every return saw it.
  void fill(Rows& rows, const ModelState& state, Seen* seen, const RunContext& context,
            MeasurementTable& table) const {
    std::vector<TableRows> lidar(rows.size());
    parallel_for(rows.size(), context.thread_count(), [&](std::size_t s) {
      lidar[s] = rows[s]->rows(table, static_cast<std::size_t>(options_.max_rows_per_scene));
      if (seen != nullptr) (*seen)[s] = rows[s]->seen();
      rows[s].reset();
    });
    for (std::size_t s = 0; s < scenes_.size(); ++s)
      add_corners(scenes_[s].measured, static_cast<int>(s), state, input_.sigma_px, table);
    const std::array<std::function<void()>, 3> channels{
        [&] { gather(&TableRows::range, lidar, table.range); },
        [&] { gather(&TableRows::boundary, lidar, table.boundary); },
        [&] { gather(&TableRows::intensity, lidar, table.intensity); }};
    parallel_for(channels.size(), context.thread_count(), [&](std::size_t k) { channels[k](); });
    const double noise_px = corner_noise(table, state, input_.sigma_px);
    for (CornerRow& row : table.corner) row.sigma_px = noise_px;
  }

  TableInput input_;  // But for its scenes:
  TableOptions options_;
  std::vector<KeptScene> scenes_;
  // The first table without its rows, to whose usual levels and lines effects in use refer,
  MeasurementTable like_;
  Seen seen_;  // and the print as its returns saw it.
};

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

MeasurementTable print_table(const TableInput& input, const ModelState& state,
                             const TableOptions& options, const RunContext& context) {
  const auto maker = std::make_shared<TableMaker>(input, options, context);
  MeasurementTable table = maker->first(state, context);
  if (context.stopped()) return table;
  table.again = [maker = std::shared_ptr<const TableMaker>(maker)](
                    const ModelState& at, const std::vector<EffectInUse>& in_use,
                    const RunContext& now) { return maker->again(at, in_use, now); };
  return table;
}

}  // namespace lvcalib
