// SPDX-License-Identifier: BSD-3-Clause
#include "solve/scene_rows.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <map>
#include <tuple>

#include "base/statistics.h"
#include "model/noise_floor.h"
#include "solve/board_returns.h"
#include "solve/surface_noise.h"

namespace lvcalib {
namespace {

constexpr int kCells = 16;                // Board cells along a side, for even thinning.
constexpr double kRobustThreshold = 3.0;  // Huber's threshold, as in the joint solve.

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

double darkness(const MeasurementTable& table, double predicted) {
  if (!(table.log_contrast > 0.0)) return 0.0;
  const double white = table.level_of(Print::kWhite);
  return std::log(white / std::max(predicted, kLeastShare * white)) / table.log_contrast;
}

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

// Of the jitter in the blur's variance across the print's edge.
double jitter_share(const ReturnPrediction& p, const BeamSpread& beam) {
  const Eigen::RowVector2d& g = p.intensity_by_angle;
  const double blur = g.dot(g * beam.blur_rad2);
  return blur > 0.0 ? std::clamp(g.dot(g * beam.jitter_rad2) / blur, 0.0, 1.0) : 0.0;
}

// The edge that a spot sees, or of which plain print has a trace.
std::optional<NearEdge> near_edge(const PrintView& view) {
  if (!(view.slope > 0.0)) return std::nullopt;
  return NearEdge{view.distance_m, view.psi_rad, view.width_m,
                  view.kind == PrintView::Kind::kPlain};
}

// The same, and where no edge is seen one just out of sight: black that grows may bring it in.
NearEdge edge_of(const ReturnPrediction& p, const PrintView& view) {
  if (const auto edge = near_edge(view)) return *edge;
  const double width = std::sqrt(0.5 * p.spot_m2.trace());
  return {p.white > 0.5 ? 4.0 * width : -4.0 * width, 0.0, width, true};
}

}  // namespace

// What effects in use do to single returns: the displacement of the print under the beam, the
// logarithm of the intensity, the range.
class SceneRows::Effects {
 public:
  Effects(const MeasurementTable& table, const std::vector<EffectInUse>& in_use)
      : table_(table),
        in_use_(in_use),
        columns_(columns_in_use(in_use, table)),
        rows_(table, columns_.list()) {}
  Effects(const Effects&) = delete;
  Effects& operator=(const Effects&) = delete;

  struct Sum {
    PrintChange light;   // To the print under the light,
    PrintChange ranged;  // and under what is ranged.
    double log_intensity = 0.0;
    double range_m = 0.0;
  };
  [[nodiscard]] bool any() const { return !in_use_.empty(); }
  [[nodiscard]] bool follow_white() const {
    return std::any_of(in_use_.begin(), in_use_.end(),
                       [](const EffectInUse& use) { return use.effect->follows_white(); });
  }
  // `near`: the edge that the spot sees, if any.
  Sum of(const SceneGeometry& geometry, BeamPoint beam, double predicted,
         const std::optional<NearEdge>& near, double log_contrast) {
    Sum out;
    if (in_use_.empty()) return out;
    beam.darkness = darkness(table_, predicted);
    const Print side = beam.darkness < 0.5 ? Print::kWhite : Print::kBlack;
    if (near) beam.edge = near;
    const auto edge = edge_beside(beam, log_contrast);
    const BoundaryRow* seen = edge ? &*edge : nullptr;
    const Eigen::Matrix3d rotation = geometry.lidar_from_board().rotation.toRotationMatrix();
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

// A point of the cloud as the model sees it, and what effects in use do to it.
struct SceneRows::Look {
  Return r;
  ReturnPrediction predicted;
  Effects::Sum by_effects;
};

SceneRows::SceneRows(const KeptScene& input, int scene, const SceneNoise& noise,
                     const MeasurementTable& table, const std::vector<EffectInUse>& in_use,
                     const std::vector<LocalPrint>* known)
    : known_(known),
      input_(input),
      scene_(scene),
      print_(*table.print),
      levels_(table.placed_by.levels[static_cast<std::size_t>(scene)]),
      jitter_rad2_(table.placed_by.beam.jitter_rad2),
      geometry_(table.placed_by.camera_from_lidar,
                table.placed_by.camera_from_board[static_cast<std::size_t>(scene)]) {
  Effects effects(table, in_use);
  collect(table.placed_by.beam, noise, effects);
  measure_noise(noise);
}

std::vector<LocalPrint> SceneRows::seen() const {
  std::vector<LocalPrint> out(input_.cloud.size());
  for (const Return& r : returns_) out[r.point] = r.seen;
  return out;
}

JitterRegression SceneRows::scatter() const {
  JitterRegression out;
  for (const Return& r : returns_) {
    if (r.by_angle.isZero()) continue;
    const double plain = plain_sigma(r);
    out.add(r.by_angle, r.intensity - r.predicted, plain * plain,
            intensity_variance(plain, r.by_angle, jitter_rad2_));
  }
  return out;
}

TableRows SceneRows::rows(const MeasurementTable& usual, std::size_t most) {
  for (Return& r : returns_) r.beam.darkness = darkness(usual, r.plain_level);
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

std::optional<SceneRows::Look> SceneRows::look_at(std::uint32_t i, const BoardPredictor& predictor,
                                                  const BeamSpread& beam, Effects& effects) const {
  const Cloud& cloud = input_.cloud;
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
  if (!input_.scan_rad_s.empty()) r.beam.scan_rad_s = input_.scan_rad_s[i];
  const PrintView view = view_print(*p, levels_, beam);
  r.beam.white = p->white;
  r.beam.jitter_share = jitter_share(*p, beam);
  out.by_effects =
      effects.of(geometry_, r.beam, p->intensity, edge_of(*p, view), log_contrast(levels_));
  return out;
}

void SceneRows::collect(const BeamSpread& beam, const SceneNoise& noise, Effects& effects) {
  const Cloud& cloud = input_.cloud;
  const BoardPredictor predictor(print_, geometry_.lidar_from_board(), levels_, beam);
  // A return belongs to the board if its range is what the model in force predicts: offsets of a
  // sensor and of one of its lines add up to more than five of its deviations.
  ReturnSelection selection;
  selection.uncovered = input_.measured.uncovered;
  if (effects.any()) {
    selection.added_m = [&](std::uint32_t i) {
      const auto look = look_at(i, predictor, beam, effects);
      return look ? look->by_effects.range_m : 0.0;
    };
  }
  const BoardReturns kept = select_returns(cloud, print_, geometry_.lidar_from_board(), beam,
                                           {noise.range_white_m, noise.range_black_m}, selection);
  has_intensity_ = kept.has_intensity;
  for (std::size_t k = 0; k < kept.size(); ++k) {
    const auto look = look_at(kept.index[k], predictor, beam, effects);
    if (!look) continue;
    Return r = look->r;
    const Effects::Sum& sum = look->by_effects;
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
    r.white = r.beam.white = p->white;
    r.plain_level = p->intensity;
    // A range's part hardly changes beside its noise.
    r.range_residual_m = r.measured_m - ranged->range_m - sum.range_m;
    double log_intensity = sum.log_intensity;
    if (effects.follow_white())
      log_intensity = effects
                          .of(geometry_, r.beam, p->intensity,
                              edge_of(*p, view_print(*p, levels_, beam)), log_contrast(levels_))
                          .log_intensity;
    if (has_intensity_) describe_print(*p, beam, kept.intensity(k), std::exp(log_intensity), r);
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

void SceneRows::describe_print(const ReturnPrediction& p, const BeamSpread& beam, double intensity,
                               double gain, Return& r) const {
  r.intensity = intensity;
  r.predicted = gain * p.intensity;
  r.by_angle = gain * p.intensity_by_angle;
  const PrintView view = view_print(p, levels_, beam);
  r.print = view.kind;
  r.slope = view.slope;
  r.beam.edge = near_edge(view);
}

void SceneRows::measure_noise(const SceneNoise& fallback) {
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
    range_noise_m_[k] = ranges[k].sigma();
    if (range_noise_m_[k] <= 0.0) range_noise_m_[k] = range[k];
    range_noise_m_[k] = std::max(range_noise_m_[k], 1e-5);
    intensity_noise_[k] = intensities[k].sigma();
    // Of whole numbers most replicates may be alike.
    if (intensity_noise_[k] < kRoundingSigma) intensity_noise_[k] = std::max(1e-9, intensity[k]);
  }
}

// Places of the returns wanted, at most `most`, evenly over board cells and surfaces. Which ones
// stay is drawn by lot, the same for every table: if a few change their kind, the others stay.
template <class Wanted>
std::vector<std::size_t> SceneRows::thinned(const Wanted& wanted, std::size_t most) const {
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

RangeRow SceneRows::range_row(const Return& r) const {
  RangeRow row;
  row.beam = r.beam;
  row.measured_m = r.measured_m;
  row.intensity = r.intensity;
  row.print = r.surface() == 0 ? Print::kWhite : Print::kBlack;
  row.sigma_m = robust_sigma(noise_between(range_noise_m_[0], range_noise_m_[1], r.white),
                             r.range_residual_m);
  row.seen = r.ranged;
  return row;
}

double SceneRows::plain_sigma(const Return& r) const {
  return noise_between(intensity_noise_[0], intensity_noise_[1], r.white);
}

double SceneRows::intensity_sigma(const Return& r) const {
  const double variance = intensity_variance(plain_sigma(r), r.by_angle, jitter_rad2_);
  return robust_sigma(std::sqrt(variance), r.intensity - r.predicted);
}

BoundaryRow SceneRows::edge_row(const Return& r) const {
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

IntensityRow SceneRows::intensity_row(const Return& r) const {
  const double sigma = intensity_sigma(r);
  // Told as a logarithm as far as there is one.
  const double unit = std::max(r.predicted, 3.0 * sigma);
  return {r.beam,
          r.surface() == 0 ? Print::kWhite : Print::kBlack,
          std::log(std::max(r.intensity, 1e-3 * unit)),
          sigma / unit,
          {r.intensity, unit, r.moved}};
}

}  // namespace lvcalib
