// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "model/residuals.h"

namespace lvcalib {

/// How well a channel is predicted. Display units; each row counts by its own standard deviation:
/// rms² = Σ(r/σ)² / Σ(1/σ²), floor² = n / Σ(1/σ²).
struct ChannelSummary {
  Channel channel = Channel::kCorner;
  std::size_t n = 0;
  double rms = 0.0;
  double noise_floor = 0.0;
  double unexplained = 0.0;  ///< √(rms²·n/(n−p) − floor²).
  double heldout_rms = 0.0;
};

/// Squares of a scene held out, over σ², per channel; one entry per scene.
using HeldoutSquares = std::vector<std::array<double, kChannels>>;

/// RMS, noise floor, unexplained part and held-out RMS of every channel that has rows. `heldout`:
/// what the model of all other scenes leaves of each.
std::vector<ChannelSummary> summarize_channels(const EveryResidual& residuals,
                                               const std::vector<EffectInUse>& in_use,
                                               const HeldoutSquares& heldout);

}  // namespace lvcalib
