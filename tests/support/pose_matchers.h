// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Compares poses in the units people think in, and says on failure how far off they are.

#include <cstdio>
#include <string>

#include <Eigen/Cholesky>
#include <gmock/gmock.h>

#include "base/rigid3.h"

namespace lvcalib::test {

/// "1.23 mm, 0.45 mrad (perturbation x y z … mm, rx ry rz … mrad)".
inline std::string pose_difference(const Rigid3& estimate, const Rigid3& truth) {
  const Vector6d d = 1e3 * se3_log(truth * estimate.inverse());
  char text[200];
  std::snprintf(text, sizeof text,
                "%.4g mm, %.4g mrad (perturbation %.3g %.3g %.3g mm, %.3g %.3g %.3g mrad)",
                1e3 * translation_distance_m(estimate, truth),
                1e3 * rotation_distance_rad(estimate, truth), d(0), d(1), d(2), d(3), d(4), d(5));
  return text;
}

/// The pose's origin is within `mm` and its rotation within `mrad` of `truth`.
MATCHER_P3(IsNearPose, truth, mm, mrad,
           "is a pose within " + std::to_string(mm) + " mm and " + std::to_string(mrad) +
               " mrad of the truth") {
  *result_listener << "differs by " << pose_difference(arg, truth);
  return 1e3 * translation_distance_m(arg, truth) <= mm &&
         1e3 * rotation_distance_rad(arg, truth) <= mrad;
}

/// Squared Mahalanobis distance of the truth from an estimate (left perturbation): χ² with six
/// degrees of freedom if the covariance is right.
inline double chi_square_of(const UncertainRigid3& estimate, const Rigid3& truth) {
  const Vector6d d = se3_log(truth * estimate.transform.inverse());
  return d.dot(estimate.covariance.ldlt().solve(d));
}

}  // namespace lvcalib::test
