// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "cloud/cloud.h"

namespace lvcalib {

/// By how many points the intensities may come late (positive: that of a point stands that many
/// points after it) or early: the shifts, up to 1000 points, at which places that the scan passes
/// twice are at least twice as alike as they stand in the cloud; at most four, the best first. To
/// be tried: a scan that runs beside its own trace looks alike at several. Empty where the
/// intensities are in their places, or tell nothing, as those of a spinning scanner: every turn is
/// the same.
std::vector<int> intensity_lags(const Cloud& cloud);

/// The cloud with intensities moved back by `lag`. Points at the end that have none keep the last
/// one that is there (at the start, the first).
Cloud without_intensity_lag(Cloud cloud, int lag);

}  // namespace lvcalib
