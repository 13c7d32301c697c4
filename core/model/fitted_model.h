// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "model/linear_model.h"

namespace lvcalib {

/// A fitted model to those who look at what it predicts: nothing of how it was found. Refers to its
/// table and state, which must outlive it.
struct FittedModel {
  const MeasurementTable& table;
  const ModelState& state;
  std::vector<EffectInUse> effects;  ///< That it predicts with.
};

}  // namespace lvcalib
