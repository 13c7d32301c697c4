// SPDX-License-Identifier: GPL-3.0-or-later
#include "pages/response_table.h"

#include <QTableWidget>
#include <memory>
#include <numbers>

#include <gtest/gtest.h>

namespace lvcalib::widgets::response_table_test {
namespace {

TEST(ResponseTable, NumbersInDegreesAndMillimetresWithTheirSigma) {
  const std::unique_ptr<QTableWidget> table(new_response_table(nullptr));
  title_response_table(*table, "Scene");
  constexpr double kRadians = std::numbers::pi / 180.0;
  ResponseStatistics s;
  s.n = 321;
  s.mean << -0.01 * kRadians, 0.02 * kRadians, 0.0015;
  s.mean_sigma << 0.001 * kRadians, 0.002 * kRadians, 0.0002;
  s.covariance.diagonal() << 0.0225 * kRadians * kRadians, 0.04 * kRadians * kRadians, 81e-6;
  s.std_sigma << 0.003 * kRadians, 0.004 * kRadians, 0.0004;
  TransitionFit fit;
  fit.delta_m = 0.00042;
  fit.delta_sigma_m = 0.00003;
  fit.sigma_m = 0.0051;
  fit.sigma_sigma_m = 0.00004;
  add_response_row(*table, "A", s, fit, {});
  const QStringList expected = {"A",
                                "321",
                                "−0.0100 ± 0.0010",
                                "0.0200 ± 0.0020",
                                "1.50 ± 0.20",
                                "0.1500 ± 0.0030",
                                "0.2000 ± 0.0040",
                                "9.00 ± 0.40",
                                "0.420 ± 0.030",
                                "5.100 ± 0.040"};
  ASSERT_EQ(table->columnCount(), expected.size());
  for (int c = 0; c < expected.size(); ++c)
    EXPECT_EQ(table->item(0, c)->text().toStdString(), expected[c].toStdString());
}

TEST(ResponseTable, WithoutStatisticsTheReasonStandsInPlaceOfNumbers) {
  const std::unique_ptr<QTableWidget> table(new_response_table(nullptr));
  title_response_table(*table, "Scene");
  add_response_row(*table, "B", std::nullopt, std::nullopt, "not enough samples: 7 of 200");
  EXPECT_EQ(table->item(0, 2)->text(), "not enough samples: 7 of 200");
  EXPECT_EQ(table->columnSpan(0, 2), 6);
  EXPECT_EQ(table->item(0, 8), nullptr);
}

}  // namespace
}  // namespace lvcalib::widgets::response_table_test
