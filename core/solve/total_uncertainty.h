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
  /// Angles are stated to 0.05 to 0.15° at one σ, some of which are scales, harmonics and tilts:
  /// half a milliradian each on a board 30° off,
  double angle_scale = 1e-3;
  double eccentricity_rad = 5e-4;
  double axis_tilt_rad = 1e-3;
  /// and drawings of devices show beams that start millimetres beside the frame's origin.
  double origin_m = 3e-3;
  /// All but the intrinsics, by DeviceFault.
  [[nodiscard]] Eigen::Matrix<double, kDeviceFaults, 1> of_the_lidar() const {
    Eigen::Matrix<double, kDeviceFaults, 1> out;
    out << range_offset_m, range_scale, angle_scale, angle_scale, eccentricity_rad,
        eccentricity_rad, axis_tilt_rad, origin_m, origin_m;
    return out;
  }
};

/// The extrinsic's covariance if those faults may be there: the posterior of the joint solve with
/// them as further unknowns that are drawn to zero by their sizes. What the data rule out thus adds
/// nothing, and what leaves no trace adds all it can do. To first order about `solution`; where the
/// data ask for other intrinsics than the held ones, for other angles or another origin of the
/// beams, the squares of those shifts are in it as well, and so are those of motion and lag within
/// the scans where these are there (see ScanFault). The solution's own part is that of Student's
/// distribution with its degrees of freedom.
/// Never below the solution's own covariance.
Matrix6d total_covariance(const ForwardSolution& solution, const LeftOutSizes& sizes);

}  // namespace lvcalib
