// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "model/residuals.h"

namespace lvcalib {

/// A covariate's value at every residual of a channel.
struct Covariate {
  std::string name;
  std::string unit;
  bool categories = false;  ///< Values are labels (tag id, node, line), not a scale.
  std::vector<float> values;
};

/// All covariates of a channel that the table has and that vary, in a fixed order.
std::vector<Covariate> covariates_of(const MeasurementTable& table, Channel channel,
                                     const ChannelResiduals& residuals);

}  // namespace lvcalib
