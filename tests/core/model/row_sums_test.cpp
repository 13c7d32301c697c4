// SPDX-License-Identifier: GPL-3.0-or-later
#include "model/row_sums.h"

#include <cmath>

#include <gtest/gtest.h>

#include "base/random.h"

namespace lvcalib {
namespace {

// Rows of which each uses the last columns and some few of the others, as rows do of which each
// sees one patch of the board; which ones changes now and then.
TEST(RowSums, AreThoseOfWholeRows) {
  constexpr int kColumns = 37;
  constexpr int kEffects = 3;
  Random random(3);
  RowSums sums(kColumns, kEffects);
  Eigen::MatrixXd products = Eigen::MatrixXd::Zero(kColumns, kColumns);
  Eigen::VectorXd fourth_powers = Eigen::VectorXd::Zero(kEffects);
  constexpr int kRows = 501;  // No multiple of what is added up at a time.
  for (int k = 0; k < kRows; ++k) {
    Eigen::VectorXd row = Eigen::VectorXd::Zero(kColumns);
    const int first = k / 30 * 5 % 30;
    for (int c = first; c < first + 4; ++c) row(c) = random.normal();
    row.tail<kEffects + 1>().setConstant(random.normal());
    if (k % 7 == 0) row(kColumns - 2) = 0.0;
    const double weight = 0.5 + random.uniform();
    for (int c = 0; c < kColumns; ++c) sums.set(c, row(c));
    sums.finish(weight);
    products += weight * row * row.transpose();
    fourth_powers +=
        (weight * row.segment<kEffects>(kColumns - 1 - kEffects).cwiseAbs2()).cwiseAbs2();
  }
  const ChannelSums out = sums.sums();
  EXPECT_EQ(out.rows, kRows);
  const Eigen::MatrixXd upper = products.triangularView<Eigen::Upper>();
  EXPECT_LT((out.products - upper).cwiseAbs().maxCoeff(), 1e-11);
  EXPECT_LT((out.fourth_powers - fourth_powers).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(RowSums, OfNoRowsAreNothing) {
  const ChannelSums out = RowSums(5, 1).sums();
  EXPECT_EQ(out.rows, 0);
  EXPECT_EQ(out.products.size(), 0);
}

}  // namespace
}  // namespace lvcalib
