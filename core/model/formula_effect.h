// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "model/user_effect.h"

namespace lvcalib {

/// A formula as an effect. Without a table (nullptr) only its values can be applied; its priors are
/// then those of columns of size one, and that it is linear in its coefficients is tried on made-up
/// covariates. Errors: as make_user_effect.
Result<EffectPtr> make_formula_effect(const UserEffectSpec& spec, const MeasurementTable* table,
                                      const UserEffectOptions& options);

}  // namespace lvcalib
