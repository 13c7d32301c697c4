// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <Eigen/Core>

#include "model/linear_model.h"

namespace lvcalib {

/// The beam's blur: increments of the three numbers of its covariance. Not an effect to be found,
/// but part of every model, as a nuisance with a size of its own.
EffectPtr beam_blur();

/// Its place among the global unknowns of a fit: behind the extrinsic and the effects in use.
Eigen::Index blur_place(const std::vector<EffectInUse>& in_use);

}  // namespace lvcalib
