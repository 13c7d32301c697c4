// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <Eigen/Core>

#include "cloud/cloud.h"

namespace lvcalib {

/// Scan velocity (azimuth·cos elevation, elevation; rad/s) at every point: the slope of a straight
/// line through the neighbours in time on the same laser line. Zero where they are too few or too
/// far apart in time (ten times the usual step). Empty if the cloud has no time.
std::vector<Eigen::Vector2d> scan_velocities(const Cloud& cloud);

}  // namespace lvcalib
