// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "model/effect.h"

namespace lvcalib {

/// The beam's blur: increments of the three numbers of its covariance. Not an effect to be found,
/// but part of every model, as a nuisance with a size of its own.
EffectPtr beam_blur();

}  // namespace lvcalib
