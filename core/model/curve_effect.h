// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "model/user_effect.h"

namespace lvcalib {

/// A curve as an effect. With a table, intervals that the spec leaves open are those of the table's
/// rows. Its shape number is the RMS (SI) that its bent part may have: how rough it is; the search
/// takes the one that predicts held-out scenes best. Errors: as make_user_effect.
Result<EffectPtr> make_curve_effect(const UserEffectSpec& spec, const MeasurementTable* table,
                                    const UserEffectOptions& options);

}  // namespace lvcalib
