// SPDX-License-Identifier: BSD-3-Clause
#include "diagnostics/channel_summary.h"

#include <algorithm>
#include <cmath>

namespace lvcalib {

std::vector<ChannelSummary> summarize_channels(const EveryResidual& residuals,
                                               const std::vector<EffectInUse>& in_use,
                                               const HeldoutSquares& heldout) {
  std::vector<ChannelSummary> out;
  std::size_t parameters = 0;
  for (const EffectInUse& use : in_use) parameters += static_cast<std::size_t>(use.values.size());
  for (const ChannelResiduals& r : residuals) {
    if (r.values.empty()) continue;
    double weights = 0.0;
    double whitened = 0.0;
    for (std::size_t k = 0; k < r.values.size(); ++k) {
      const double weight = 1.0 / (r.sigma[k] * r.sigma[k]);
      weights += weight;
      whitened += weight * r.values[k] * r.values[k];
    }
    const auto n = static_cast<double>(r.values.size());
    // Poses (or levels) and effects are fitted to these rows.
    const double fitted = std::min(0.5 * n, static_cast<double>(6 * heldout.size() + parameters));
    const double unit = display_factor(r.channel);
    ChannelSummary s;
    s.channel = r.channel;
    s.n = r.values.size();
    s.rms = unit * std::sqrt(whitened / weights);
    s.noise_floor = unit * std::sqrt(n / weights);
    s.unexplained =
        std::sqrt(std::max(0.0, s.rms * s.rms * n / (n - fitted) - s.noise_floor * s.noise_floor));
    double squares = 0.0;
    for (const auto& scene : heldout) squares += scene[static_cast<std::size_t>(r.channel)];
    s.heldout_rms = unit * std::sqrt(squares / weights);
    out.push_back(s);
  }
  return out;
}

}  // namespace lvcalib
