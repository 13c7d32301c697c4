// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "diagnostics/binned_residuals.h"
#include "diagnostics/covariates.h"
#include "model/fitted_model.h"

namespace lvcalib {

/// Residuals of one channel in display units (see unit_of()), with everything they may depend on.
/// All columns have one entry per residual.
struct ResidualColumns {
  Channel channel = Channel::kCorner;
  std::vector<float> value;      ///< Measured − predicted.
  std::vector<float> before;     ///< The same with the other model; NaN where it has none.
  std::vector<float> sigma;      ///< Stated noise of one residual.
  std::vector<int> scene;        ///< Index into the table's scenes.
  std::vector<std::size_t> row;  ///< Row of the table's channel.
  std::vector<int> component;    ///< Corners: 0 for u, 1 for v; else empty.
  std::vector<Covariate> covariates;

  [[nodiscard]] std::size_t size() const { return value.size(); }
  /// By name; nullptr if there is none.
  [[nodiscard]] const Covariate* find(const std::string& name) const;
  [[nodiscard]] ResidualSample sample() const { return {value, sigma, scene}; }
  [[nodiscard]] ResidualSample sample_before() const { return {before, sigma, scene}; }
};

/// The residuals of a model, beside those of another one (or itself) on the same measurements.
ResidualColumns residual_columns(const FittedModel& model, const FittedModel& before,
                                 Channel channel);

/// What an effect of given values (SI) adds to the residuals of a model without it, display units,
/// row by row as residual_columns() has them. `adapted`: after extrinsic, board poses and intensity
/// levels have given way to it as far as the fit of all channels lets them, which is what the
/// residuals show as long as the effect is not in the model.
std::vector<float> effect_pattern(const FittedModel& model, const EffectInUse& effect,
                                  Channel channel, bool adapted);

/// Channels in which an effect shows at all on these measurements.
std::vector<Channel> channels_of(const Effect& effect, double shape, const FittedModel& model);

}  // namespace lvcalib
