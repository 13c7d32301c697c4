// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "solve/forward_solver.h"
#include "solve/intrinsics_fit.h"

namespace lvcalib {

/// Sizes (one standard deviation) of faults that a solve holds for absent though every device has
/// them, and of which the data may show little.
struct LeftOutSizes {
  /// Of the intrinsics, where the solve held them; 0 where it estimated them or they are exact.
  IntrinsicsVector intrinsics = IntrinsicsVector::Zero();
  /// What data sheets allow: ranges of time-of-flight LiDARs are stated to 10 to 30 mm at two σ,
  double range_offset_m = 0.01;
  /// and clock and atmosphere leave their scale to some hundred ppm.
  double range_scale = 5e-4;
};

/// The extrinsic's covariance if those faults may be there: the posterior of the joint solve with
/// them as further unknowns that are drawn to zero by their sizes. What the data rule out thus adds
/// nothing, and what leaves no trace adds all it can do. To first order about `solution`; where the
/// data ask for other intrinsics than the held ones, the square of that shift is in it as well,
/// and so is that of what faults within the scans would move (see ScanFault).
/// Never below the solution's own covariance.
Matrix6d total_covariance(const ForwardSolution& solution, const LeftOutSizes& sizes);

}  // namespace lvcalib
