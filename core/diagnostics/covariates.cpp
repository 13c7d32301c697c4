// SPDX-License-Identifier: BSD-3-Clause
#include "diagnostics/covariates.h"

#include <cmath>

#include "model/row_covariates.h"

namespace lvcalib {
namespace {

// Rows of a residual, in its channel; corner rows come as u, then v.
CovariateSource source_of(const MeasurementTable& table, Channel channel,
                          const ChannelResiduals& residuals, std::size_t k) {
  const std::size_t row = residuals.row[k];
  switch (channel) {
    case Channel::kRange:
      return CovariateSource::of(table.range[row]);
    case Channel::kBoundary:
      return CovariateSource::of(table.boundary[row]);
    case Channel::kIntensity:
      return CovariateSource::of(table.intensity[row]);
    case Channel::kCorner:
      break;
  }
  const int axis = k > 0 && row == residuals.row[k - 1] ? 1 : 0;
  return CovariateSource::of(table.corner[row], table.camera, axis);
}

}  // namespace

std::vector<Covariate> covariates_of(const MeasurementTable& table, Channel channel,
                                     const ChannelResiduals& residuals) {
  std::vector<Covariate> out;
  for (const RowCovariate& covariate : row_covariates(channel)) {
    if (!covariate.scanned || !has_covariate(table, covariate)) continue;
    Covariate c{covariate.name, covariate.unit, covariate.categories, {}};
    c.values.reserve(residuals.row.size());
    float low = HUGE_VALF;
    float high = -HUGE_VALF;
    for (std::size_t k = 0; k < residuals.row.size(); ++k) {
      const double value = covariate.value(table, source_of(table, channel, residuals, k));
      c.values.push_back(static_cast<float>(value));
      low = std::min(low, c.values.back());
      high = std::max(high, c.values.back());
    }
    if (high > low) out.push_back(std::move(c));
  }
  return out;
}

}  // namespace lvcalib
