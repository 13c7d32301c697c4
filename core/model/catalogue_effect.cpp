// SPDX-License-Identifier: BSD-3-Clause
#include "model/catalogue_effect.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/statistics.h"

namespace lvcalib {

double log_power(double range_m, double incidence_rad) {
  constexpr double kReference_m = 3.0;   // A usual distance of boards; a choice of the scale alone.
  constexpr double kLeastCosine = 0.05;  // 87°: beyond what any prediction is made for (80°).
  const double near = kReference_m / range_m;
  return std::log(std::max(kLeastCosine, std::cos(incidence_rad)) * near * near);
}

AngleAxes angle_axes(const BeamPoint& beam) {
  const double ca = std::cos(beam.azimuth_rad);
  const double sa = std::sin(beam.azimuth_rad);
  const double ce = std::cos(beam.elevation_rad);
  const double se = std::sin(beam.elevation_rad);
  return {beam.range_m * Eigen::Vector3d(-sa, ca, 0.0),
          beam.range_m * Eigen::Vector3d(-se * ca, -se * sa, ce)};
}

Eigen::Vector2d lidar_angle_of(const BoundaryRow& row) {
  const Eigen::Vector2d angle = row.edge_normal_rad;
  const double length = angle.norm();
  return length > 0.0 ? Eigen::Vector2d(angle / length) : Eigen::Vector2d::Zero().eval();
}

std::vector<EffectParameter> alike(const EffectParameter& first,
                                   std::initializer_list<const char*> others) {
  std::vector<EffectParameter> out{first};
  for (const char* name : others) {
    out.push_back(first);
    out.back().name = name;
  }
  return out;
}

std::vector<EffectParameter> one_per_line(const MeasurementTable& table,
                                          const EffectParameter& parameter) {
  std::vector<EffectParameter> out;
  for (const int line : table.lines) {
    out.push_back(parameter);
    out.back().name += std::to_string(line);
  }
  return out;
}

std::size_t line_index(const MeasurementTable& table, int line) {
  const auto at = std::lower_bound(table.lines.begin(), table.lines.end(), line);
  return at != table.lines.end() && *at == line ? static_cast<std::size_t>(at - table.lines.begin())
                                                : std::numeric_limits<std::size_t>::max();
}

Eigen::Vector2d on_unit_square(const Eigen::Vector2d& board_m, const Target& target) {
  const BoardOutline outline = target.outline();
  return (board_m - outline.center_m()).cwiseQuotient(0.5 * outline.size_m());
}

Eigen::Vector2d image_direction_from_tag(const CornerRow& row) {
  return row.from_tag_px.norm() > 0.0 ? row.from_tag_px.normalized().eval()
                                      : Eigen::Vector2d::Zero().eval();
}

std::vector<double> period_grid(const MeasurementTable& table) {
  constexpr double kShortest = 0.05;
  constexpr double kLongest = 1.0;
  double low = std::numeric_limits<double>::max();
  double high = 0.0;
  for (const RangeRow& row : table.range) {
    low = std::min(low, row.beam.range_m);
    high = std::max(high, row.beam.range_m);
  }
  const double span = std::max(high - low, 0.5);
  std::vector<double> out;
  for (double frequency = 1.0 / kShortest; frequency >= 1.0 / kLongest; frequency -= 0.25 / span)
    out.push_back(1.0 / frequency);
  return out;
}

double edge_pull(const BeamPoint& beam, const MeasurementTable& table) {
  if (!beam.edge.has_value()) return 0.0;
  const double sigma = beam.edge->transition_m;
  const double z = beam.edge->distance_m / sigma;
  if (std::abs(z) > 4.0) return 0.0;
  const double black = table.level_of(Print::kBlack);
  const double contrast = table.level_of(Print::kWhite) - black;
  const double level = black + contrast * normal_cdf(z);
  const double slope = contrast * normal_pdf(z) / sigma;
  // σ is the width in the board along ψ: it already holds the stretching by the incidence.
  return std::sin(beam.incidence_rad) * std::cos(beam.edge->psi_rad - beam.slope_rad) * sigma *
         sigma * slope / level;
}

}  // namespace lvcalib
