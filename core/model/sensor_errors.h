// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "model/effect.h"

namespace lvcalib {

/// Errors of the LiDAR's ranges that all scenes share and that no effect explains: of all ranges,
/// of those on black print, of those of each line. Random effects, N(0, σ²) in each kind, as in the
/// joint solve; not effects to be found.
inline constexpr std::size_t kSensorErrors = 3;
/// Their variances (m²).
/// So small that no data see them: a kind that is not there.
inline constexpr double kAbsentSensorError = 1e-12;

/// One kind of them, as columns of a model. `kind` below kSensorErrors.
EffectPtr sensor_error(std::size_t kind);

}  // namespace lvcalib
