// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "model/linear_model.h"

namespace lvcalib {

/// Derivative of what an effect in use does by its shape number (a period, a decay length), as an
/// effect with that one parameter: a fit with it beside the effect gives the standard deviation of
/// the shape number and what it adds to those of all others. Central differences, one-sided at the
/// ends of what the shape number may be. The prior is the whole width of that.
EffectPtr make_shape_slope(const EffectInUse& in_use, const MeasurementTable& table);

}  // namespace lvcalib
