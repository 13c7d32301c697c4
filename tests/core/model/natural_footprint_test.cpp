// SPDX-License-Identifier: GPL-3.0-or-later
#include "model/natural_footprint.h"

#include <array>
#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <gtest/gtest.h>

namespace lvcalib {
namespace {

constexpr double kRadius = 0.05;

// Share of a normal footprint with the given covariance about a point that lies on a disk about the
// origin, by a grid over ±5 σ.
double share_on_disk(const Eigen::Vector2d& at, const Eigen::Matrix2d& covariance) {
  constexpr int kCells = 400;
  const Eigen::Matrix2d root = covariance.llt().matrixL();
  double on = 0.0;
  double all = 0.0;
  for (int i = 0; i < kCells; ++i) {
    for (int j = 0; j < kCells; ++j) {
      const Eigen::Vector2d z(10.0 * (i + 0.5) / kCells - 5.0, 10.0 * (j + 0.5) / kCells - 5.0);
      const double weight = std::exp(-0.5 * z.squaredNorm());
      all += weight;
      if ((at + root * z).norm() < kRadius) on += weight;
    }
  }
  return on / all;
}

// Where half of the footprint sees the disk, measured from its edge along a direction.
double mid_level_shift(const Eigen::Vector2d& direction, const Eigen::Matrix2d& covariance) {
  double low = -0.01;
  double high = 0.01;
  for (int k = 0; k < 30; ++k) {
    const double middle = 0.5 * (low + high);
    (share_on_disk((kRadius + middle) * direction, covariance) > 0.5 ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

TEST(NaturalFootprint, ShiftIsTheVarianceAlongTheEdgeOverTwiceTheRadius) {
  const double s2 = 0.004 * 0.004;
  Eigen::Matrix2d turned;
  turned << 1.5, 0.6, 0.6, 1.0;
  const std::array<Eigen::Matrix2d, 3> footprints{
      s2 * Eigen::Matrix2d::Identity(), s2 * Eigen::Vector2d(2.0, 1.0).asDiagonal().toDenseMatrix(),
      s2 * turned};
  for (const Eigen::Matrix2d& f : footprints) {
    for (const double psi : {0.0, 0.6, M_PI / 2.0, 2.2}) {
      const Eigen::Vector2d n(std::cos(psi), std::sin(psi));
      const double expected = -f.determinant() / n.dot(f * n) / (2.0 * kRadius);
      EXPECT_NEAR(mid_level_shift(n, f), expected, 0.05 * std::abs(expected)) << f << " at " << psi;
    }
  }
}

TEST(NaturalFootprint, ActsOnEdgesOnlyAndByWhatTheTransitionsTell) {
  const EffectPtr effect = natural_footprint();
  MeasurementTable table;
  BoundaryRow row;
  row.curvature_m = -2e-4;
  double by = 0.0;
  effect->edge(row, table, 0.0, {&by, 1});
  EXPECT_DOUBLE_EQ(by, -2e-4);
  EXPECT_EQ(effect->parameters(table).size(), 1U);
  EXPECT_EQ(find_effect(effect->info().id), nullptr);  // nothing to be found
}

TEST(NaturalFootprint, GivesWayToEffectsThatDescribeIt) {
  EXPECT_TRUE(describes_footprint("beam_divergence"));
  EXPECT_TRUE(describes_footprint("footprint_anisotropy"));
  EXPECT_FALSE(describes_footprint("ink_gain"));
}

}  // namespace
}  // namespace lvcalib
