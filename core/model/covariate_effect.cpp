// SPDX-License-Identifier: BSD-3-Clause
#include "model/covariate_effect.h"

#include <algorithm>

namespace lvcalib {
namespace {

// Corners are described by themselves and the camera alone.
const MeasurementTable& no_table() {
  static const MeasurementTable none;
  return none;
}

}  // namespace

std::vector<double> CovariateEffect::values_at(const MeasurementTable& table,
                                               const CovariateSource& row) const {
  std::vector<double> out;
  out.reserve(covariates_.size());
  for (const RowCovariate* c : covariates_) out.push_back(c->value(table, row));
  return out;
}

void CovariateEffect::at_row(const MeasurementTable& table, const CovariateSource& row,
                             double shape, std::span<double> by_parameter) const {
  columns(values_at(table, row), shape, by_parameter);
}

bool CovariateEffect::needs_row() const {
  return std::any_of(covariates_.begin(), covariates_.end(),
                     [](const RowCovariate* c) { return !c->of_beam; });
}

void CovariateEffect::lidar(const BeamPoint& beam, const MeasurementTable& table, double shape,
                            std::span<Eigen::Vector3d> by_parameter) const {
  if (channel_ != Channel::kRange || needs_row()) return;
  std::vector<double> along(by_parameter.size());
  at_row(table, CovariateSource::of(beam), shape, along);
  for (std::size_t k = 0; k < along.size(); ++k) by_parameter[k] = along[k] * beam.direction;
}

void CovariateEffect::range(const RangeRow& row, const MeasurementTable& table, double shape,
                            std::span<double> by_parameter) const {
  if (channel_ != Channel::kRange || !needs_row()) return;
  at_row(table, CovariateSource::of(row), shape, by_parameter);
}

void CovariateEffect::camera(const CornerRow& row, const Eigen::Vector2d& /*normalized*/,
                             const Camera& camera, double shape,
                             std::span<Eigen::Vector2d> by_parameter) const {
  if (channel_ != Channel::kCorner) return;
  std::vector<double> along(by_parameter.size());
  for (int axis = 0; axis < 2; ++axis) {
    at_row(no_table(), CovariateSource::of(row, camera, axis), shape, along);
    for (std::size_t k = 0; k < along.size(); ++k) by_parameter[k](axis) = along[k];
  }
}

void CovariateEffect::edge(const BoundaryRow& row, const MeasurementTable& table, double shape,
                           std::span<double> by_parameter) const {
  if (channel_ == Channel::kBoundary) at_row(table, CovariateSource::of(row), shape, by_parameter);
}

void CovariateEffect::intensity(const IntensityRow& row, const MeasurementTable& table,
                                double shape, std::span<double> by_parameter) const {
  if (channel_ == Channel::kIntensity) at_row(table, CovariateSource::of(row), shape, by_parameter);
}

EffectInfo user_effect_info(const UserEffectSpec& spec,
                            const std::vector<const RowCovariate*>& covariates) {
  EffectInfo info;
  info.id = spec.id;
  info.group = "user";
  info.title = spec.id;
  info.source = "the user";
  info.discriminating_pose =
      "scenes in which the covariates take more values, each with several board poses";
  std::string units;
  for (const RowCovariate* c : covariates) {
    info.needs.time = info.needs.time || c->needs_time;
    info.needs.line = info.needs.line || c->needs_line;
    units += std::string(units.empty() ? "" : ", ") + c->identifier();
    if (*c->unit != '\0') units += std::string(" [") + c->unit + "]";
  }
  info.needs.intensity = spec.channel == Channel::kIntensity;
  info.needs.circles = spec.channel == Channel::kBoundary;
  info.formula = std::string(name_of(spec.channel)) + " [" + unit_of(spec.channel) + "] + " +
                 spec.body + (units.empty() ? "" : " with " + units);
  return info;
}

EffectParameter user_parameter(const std::string& name, Channel channel, double rms,
                               const UserEffectOptions& options) {
  const auto c = static_cast<std::size_t>(channel);
  return {.name = name,
          .unit = unit_of(channel),
          .unit_in_si = 1.0 / display_factor(channel),
          .size_of_interest = options.size_of_interest[c] / rms,
          .prior_sigma = options.believable[c] / rms};
}

}  // namespace lvcalib
