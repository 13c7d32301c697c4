// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "cloud/cloud.h"

namespace lvcalib {

/// By how many points the intensities seem to come late (positive: that of a point stands that many
/// points after it) or early: the shift, up to 1000 points, at which places that the scan passes
/// twice, long apart, are most alike. A suggestion to be tried: the best of 2001 shifts is some
/// shift in any cloud. 0 as well where the scan passes no place twice, or intensity tells nothing.
int intensity_lag(const Cloud& cloud);

/// The cloud with intensities moved back by `lag`. Points at the end that have none keep the last
/// one that is there (at the start, the first).
Cloud without_intensity_lag(Cloud cloud, int lag);

}  // namespace lvcalib
