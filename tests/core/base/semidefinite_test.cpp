// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/semidefinite.h"

#include <gtest/gtest.h>

namespace lvcalib {
namespace {

TEST(WithoutNegativeAxes, KeepsWhatIsACovariance) {
  const Eigen::Matrix2d m = (Eigen::Matrix2d() << 2.0, 0.5, 0.5, 1.0).finished();
  EXPECT_NEAR((without_negative_axes<2>(m) - m).norm(), 0.0, 1e-12);
}

// Along (1, 1) three, along (1, −1) minus one: the first is left.
TEST(WithoutNegativeAxes, TakesOutTheAxisBelowZero) {
  const Eigen::Matrix2d m = (Eigen::Matrix2d() << 1.0, 2.0, 2.0, 1.0).finished();
  EXPECT_NEAR((without_negative_axes<2>(m) - Eigen::Matrix2d::Constant(1.5)).norm(), 0.0, 1e-12);
}

}  // namespace
}  // namespace lvcalib
