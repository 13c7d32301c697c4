// SPDX-License-Identifier: BSD-3-Clause
#include "model/print_rows.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace lvcalib {
namespace {

void add_growth(double growth_m, PrintChange& change) {
  change.growth_m = change.growth_m.value_or(0.0) + growth_m;
}

}  // namespace

PrintRows::PrintRows(const MeasurementTable& table, const ModelState& state, std::size_t scene,
                     const std::vector<EffectInUse>& in_use, bool growth)
    : table_(table),
      in_use_(in_use),
      columns_(columns_in_use(in_use, table)),
      rows_(table, columns_.list()),
      geometry_(state.camera_from_lidar, state.camera_from_board[scene]),
      rotation_(geometry_.lidar_from_board().rotation.toRotationMatrix()),
      predictor_(*table.print, geometry_.lidar_from_board(), state.levels[scene], state.beam),
      levels_(state.levels[scene]),
      log_contrast_(log_contrast(levels_)),
      growth_(growth) {
  for (const EffectColumns& c : columns_.list())
    if (c.effect->follows_white() && !c.print_contrast) following_.push_back(&c);
}

void PrintRows::set_pose(const Vector6d& by_lidar_pose, PrintRow& out) const {
  out.by_board_pose = geometry_.by_camera_pose(by_lidar_pose);
}

// A return's range and its intensity mostly ask for the same.
const std::optional<ReturnPrediction>& PrintRows::predicted(const BeamPoint& beam,
                                                            const PrintChange& change,
                                                            const LocalPrint& known,
                                                            LocalPrint* seen) {
  const ReturnKey key(beam);
  const bool same = last_ && last_->key == key && last_->change.shift_m == change.shift_m &&
                    last_->change.growth_m == change.growth_m;
  if (!same) {
    last_.emplace(Predicted{key, change, seen != nullptr ? *seen : known, {}});
    last_->prediction = predictor_.predict(beam.direction, change, &last_->seen, &last_->seen);
  }
  if (seen != nullptr) *seen = last_->seen;
  return last_->prediction;
}

double PrintRows::white_by_intensity(const ReturnPrediction& p) const {
  const double light = p.intensity_by_levels(0) + p.intensity_by_levels(1);
  const double by_white = light * (levels_.white - levels_.black);
  return by_white != 0.0 ? 1.0 / by_white : 0.0;
}

template <class Ask>
PrintRows::Followed PrintRows::follow_white(const BeamPoint& beam, double white,
                                            double UnitChange::*changed, const Ask& ask) {
  Followed out;
  if (following_.empty()) return out;
  // Print of one kind that stays so says what it said: a trace of a ten-thousandth of the contrast
  // is a hundredth of the noise of the best receivers.
  constexpr double kPlain = 1e-4;
  // Central differences over a share of white: off by a millionth of the third derivative, and
  // rounding is far below.
  constexpr double kStep = 1e-3;
  const auto plain = [](double w) { return w < kPlain || w > 1.0 - kPlain; };
  if (plain(white) && plain(beam.white) && std::abs(white - beam.white) < 0.5) return out;
  const double middle = std::clamp(white, kPlain, 1.0 - kPlain);
  const double step = std::min({kStep, middle, 1.0 - middle});
  // Hooks read the darkness of a mixture as well.
  const auto level = [this](double w) {
    return std::max(std::lerp(levels_.black, levels_.white, std::clamp(w, 0.0, 1.0)),
                    kLeastShare * std::max(levels_.white, 1e-12));
  };
  BeamPoint asked = beam;
  const auto answer = [&](const EffectColumns& c, double w, std::vector<double>& by) {
    asked.white = w;
    if (table_.log_contrast > 0.0)
      asked.darkness = beam.darkness + std::log(level(beam.white) / level(w)) / table_.log_contrast;
    by.assign(c.parameters.size(), 0.0);
    ask(c, asked, std::span(by));
  };
  for (const EffectColumns* c : following_) {
    answer(*c, middle, here_);
    answer(*c, middle + step, above_);
    answer(*c, middle - step, below_);
    for (std::size_t k = 0; k < here_.size(); ++k) {
      double& unit = changes_[static_cast<std::size_t>(c->first) + k].*changed;
      out.more += value(*c, k) * (here_[k] - unit);
      out.by_white += value(*c, k) * (above_[k] - below_[k]) / (2.0 * step);
      unit = here_[k];
    }
  }
  return out;
}

std::optional<PrintRow> PrintRows::range(const RangeRow& row, LocalPrint* seen) {
  PrintChange change;
  // Not of a range, but its intensity asks for it.
  if (row.beam.edge && growth_) change.growth_m = 0.0;
  double further = 0.0;
  // A trace of black in a white spot hardly pulls a range; light in a black one does.
  const bool pulled = row.beam.edge && !(row.beam.edge->plain && row.beam.edge->distance_m > 0.0);
  const auto edge = pulled ? edge_beside(row.beam, log_contrast_) : std::nullopt;
  const BoundaryRow* const beside = edge ? &*edge : nullptr;
  const PrintSensitivity::Moves moves(geometry_, rotation_, row.beam.direction);
  changes_.clear();
  rows_.range(row, geometry_.range_row(row.beam.direction), moves, beside,
              [&](const EffectColumns& c, const EffectRows::RangeChange& by) {
                for (std::size_t k = 0; k < by.range_m.size(); ++k) {
                  changes_.push_back({by.range_m[k], by.shift_m[k], by.growth_m[k]});
                  further += value(c, k) * by.range_m[k];
                  change.shift_m += value(c, k) * by.shift_m[k];
                  const double growth = value(c, k) * by.growth_m[k];
                  if (growth != 0.0) add_growth(growth, change);
                }
              });
  const auto& p = predicted(row.beam, change, row.seen, seen);
  if (!p) return std::nullopt;
  PrintRow out;
  const Eigen::RowVector3d along = geometry_.range_row(row.beam.direction);
  const Followed followed =
      follow_white(row.beam, p->white, &UnitChange::range_m,
                   [&](const EffectColumns& c, const BeamPoint& beam, std::span<double> by) {
                     RangeRow asked = row;
                     asked.beam = beam;
                     c.effect->range(asked, table_, c.shape, by);
                     own_moves_.assign(by.size(), Eigen::Vector3d::Zero());
                     c.effect->lidar(beam, table_, c.shape, own_moves_);
                     for (std::size_t k = 0; k < by.size(); ++k) by[k] += along.dot(own_moves_[k]);
                   });
  // Through the white, as the intensity.
  const double through = followed.by_white * white_by_intensity(*p);
  out.residual = row.measured_m - p->range_m - further - followed.more;
  out.range_by_shift = p->range_by_shift + through * p->intensity_by_shift;
  out.range_by_growth = p->range_by_growth + through * p->intensity_by_growth;
  set_pose((p->range_by_pose + through * p->intensity_by_pose).transpose(), out);
  return out;
}

std::optional<PrintRow> PrintRows::edge(const BoundaryRow& row, LocalPrint* seen) {
  const Print side = row.beam.darkness < 0.5 ? Print::kWhite : Print::kBlack;
  return reading({row.beam, side, 0.0, 1.0, row.reading}, &row, seen);
}

std::optional<PrintRow> PrintRows::intensity(const IntensityRow& row, LocalPrint* seen) {
  const auto edge = edge_beside(row.beam, log_contrast_);
  return reading(row, edge ? &*edge : nullptr, seen);
}

std::optional<PrintRow> PrintRows::reading(const IntensityRow& row, const BoundaryRow* edge,
                                           LocalPrint* seen) {
  const Eigen::Vector3d& direction = row.beam.direction;
  // Sums of what the effects in use do: to the print under the beam, to the blur, to the logarithm
  // of the intensity.
  PrintChange change;
  if (edge != nullptr && growth_) change.growth_m = 0.0;
  Eigen::Vector3d blur = Eigen::Vector3d::Zero();
  double log = 0.0;
  PrintSensitivity::Moves moves(geometry_, rotation_, direction);
  changes_.clear();
  rows_.reading(row, edge, moves, [&](const EffectColumns& c, const PrintSensitivity::Change& by) {
    for (std::size_t k = 0; k < by.shift_m.size(); ++k) {
      changes_.push_back(
          {0.0, by.shift_m[k], by.growth_m[k], by.blur_rad2[k], by.log_intensity[k]});
      const double v = value(c, k);
      change.shift_m += v * by.shift_m[k];
      // What growth does is asked for, be it none yet.
      if (by.growth_m[k] != 0.0) add_growth(v * by.growth_m[k], change);
      blur += v * by.blur_rad2[k];
      log += v * by.log_intensity[k];
    }
  });
  const auto& p = predicted(row.beam, change, row.reading.seen, seen);
  if (!p) return std::nullopt;
  PrintRow out;
  const double by_blur = p->intensity_by_blur.dot(blur);
  const double intensity = p->intensity + by_blur;
  const double by_intensity = white_by_intensity(*p);
  const Followed followed =
      follow_white(row.beam, p->white + by_intensity * by_blur, &UnitChange::log_intensity,
                   [&](const EffectColumns& c, const BeamPoint& beam, std::span<double> by) {
                     IntensityRow asked = row;
                     asked.beam = beam;
                     c.effect->intensity(asked, table_, c.shape, by);
                   });
  const double unit = row.reading.unit;
  const double gain = std::exp(log + followed.more);
  const double predicted = gain * intensity;
  // What moves the print changes the intensity, and what the effects make of it.
  const double print_gain = gain * (1.0 + intensity * followed.by_white * by_intensity);
  out.residual = (row.reading.measured - predicted) / unit;
  set_pose(print_gain / unit * p->intensity_by_pose.transpose(), out);
  out.by_levels = gain / unit * p->intensity_by_levels.transpose();
  out.print.by_shift = print_gain / unit * p->intensity_by_shift;
  out.print.by_growth = print_gain / unit * p->intensity_by_growth;
  out.print.by_blur = print_gain / unit * p->intensity_by_blur;
  out.print.by_log_intensity = predicted / unit;
  return out;
}

}  // namespace lvcalib
