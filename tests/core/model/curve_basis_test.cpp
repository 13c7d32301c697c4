// SPDX-License-Identifier: GPL-3.0-or-later
#include "model/curve_basis.h"

#include <array>
#include <cmath>

#include <Eigen/Dense>
#include <gtest/gtest.h>

namespace lvcalib {
namespace {

Eigen::VectorXd at(const CurveBasis& basis, std::vector<double> x) {
  Eigen::VectorXd out(basis.columns());
  basis.evaluate(x, {out.data(), static_cast<std::size_t>(out.size())});
  return out;
}

TEST(CurveBasis, HasMeanZeroAndUnitRoughness) {
  const CurveBasis basis({{-2.0, 3.0, {}}}, 10);
  EXPECT_EQ(basis.columns(), 9);  // a linear and eight bent ones; the constant is out
  EXPECT_EQ(basis.free_columns(), 1);
  Eigen::VectorXd mean = Eigen::VectorXd::Zero(9);
  double squares = 0.0;
  const int n = 2001;
  for (int k = 0; k < n; ++k) {
    const Eigen::VectorXd b = at(basis, {-2.0 + 5.0 * k / (n - 1.0)});
    mean += b / n;
    squares += b.tail(8).squaredNorm() / n;
  }
  EXPECT_LT(mean.norm(), 0.02);
  EXPECT_NEAR(squares, 1.0, 0.1);
}

TEST(CurveBasis, FollowsSmoothFunctions) {
  const CurveBasis basis({{0.0, 1.0, {}}}, 10);
  const int n = 200;
  Eigen::MatrixXd x(n, basis.columns() + 1);
  Eigen::VectorXd y(n);
  for (int k = 0; k < n; ++k) {
    const double t = k / (n - 1.0);
    x.row(k) << at(basis, {t}).transpose(), 1.0;
    y(k) = std::sin(7.0 * t) + 3.0 * t;
  }
  const Eigen::VectorXd fitted = x * x.colPivHouseholderQr().solve(y);
  EXPECT_LT((fitted - y).cwiseAbs().maxCoeff(), 0.02);
}

TEST(CurveBasis, StraightLinesAreNotPenalised) {
  const CurveBasis basis({{1.0, 5.0, {}}}, 8);
  // The only free column is the line itself.
  EXPECT_NEAR(at(basis, {1.0})(0), -1.0, 1e-12);
  EXPECT_NEAR(at(basis, {3.0})(0), 0.0, 1e-12);
  EXPECT_NEAR(at(basis, {5.0})(0), 1.0, 1e-12);
}

TEST(CurveBasis, StaysAtItsEndsBeyondThem) {
  const CurveBasis basis({{0.0, 1.0, {}}}, 10);
  EXPECT_EQ(at(basis, {1.0}), at(basis, {7.0}));
  EXPECT_EQ(at(basis, {0.0}), at(basis, {-7.0}));
}

TEST(CurveBasis, TensorFollowsASurface) {
  const CurveBasis basis({{0.0, 1.0, {}}, {-1.0, 1.0, {}}}, 8);
  EXPECT_EQ(basis.columns(), 63);
  EXPECT_EQ(basis.free_columns(), 3);
  const int n = 30;
  Eigen::MatrixXd x(n * n, basis.columns() + 1);
  Eigen::VectorXd y(n * n);
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const double a = i / (n - 1.0);
      const double b = 2.0 * j / (n - 1.0) - 1.0;
      x.row(i * n + j) << at(basis, {a, b}).transpose(), 1.0;
      y(i * n + j) = std::sin(3.0 * a) * std::cos(2.0 * b);
    }
  }
  const Eigen::VectorXd fitted = x * x.colPivHouseholderQr().solve(y);
  EXPECT_LT((fitted - y).cwiseAbs().maxCoeff(), 0.01);
}

TEST(CurveBasis, LabelsHaveAColumnEach) {
  const CurveBasis basis({{0.0, 0.0, {2.0, 5.0, 9.0}}}, 10);
  ASSERT_EQ(basis.columns(), 3);
  EXPECT_TRUE(at(basis, {5.0}).isApprox(Eigen::Vector3d(-1.0 / 3, 2.0 / 3, -1.0 / 3)));
  EXPECT_EQ(at(basis, {4.0}), Eigen::Vector3d::Zero());
}

}  // namespace
}  // namespace lvcalib
