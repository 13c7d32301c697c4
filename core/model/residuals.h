// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "model/linear_model.h"

namespace lvcalib {

/// A row's derivative by the scene's pose (6) and intensity levels.
using NuisanceRow = Eigen::Matrix<double, LocalLayout::kFixed, 1>;

/// Residuals of a channel's rows (measured − predicted − effects in use; SI and px). Corner rows
/// give two values each, u and v. For plots and for the search for structure.
struct ChannelResiduals {
  Channel channel = Channel::kRange;
  std::vector<double> values;
  std::vector<double> sigma;
  std::vector<int> scene;
  std::vector<std::size_t> row;  ///< Row of the table's channel.
  /// Derivative by pose and levels; three quarters of the memory, so only there where asked for.
  std::vector<NuisanceRow> nuisance;
};
/// Without derivatives. On the context's threads; incomplete when stopped.
ChannelResiduals residuals_of(const MeasurementTable& table, const ModelState& state,
                              const std::vector<EffectInUse>& in_use, Channel channel,
                              const RunContext& context = {});
/// The same with derivatives.
ChannelResiduals residuals_and_nuisance(const MeasurementTable& table, const ModelState& state,
                                        const std::vector<EffectInUse>& in_use, Channel channel,
                                        const RunContext& context = {});

/// Those of every channel with derivatives, in the order of Channel. Incomplete when stopped.
using EveryResidual = std::array<ChannelResiduals, kChannels>;
EveryResidual every_residual(const MeasurementTable& table, const ModelState& state,
                             const std::vector<EffectInUse>& in_use, const RunContext& context);

}  // namespace lvcalib
