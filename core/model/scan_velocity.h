// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <Eigen/Core>

#include "cloud/cloud.h"

namespace lvcalib {

/// Scan velocity (azimuth·cos elevation, elevation; rad/s) at every point: the slope of a parabola
/// (with fewer than five, a straight line) through up to five neighbours in time on either side, on
/// the same laser line and without a break of more than three of the usual steps. Zero where there
/// is none. Empty if the cloud has no time.
std::vector<Eigen::Vector2d> scan_velocities(const Cloud& cloud);

}  // namespace lvcalib
