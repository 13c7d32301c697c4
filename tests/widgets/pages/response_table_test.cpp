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
                                "−0.0100\u00a0±\u00a00.0010",
                                "0.0200\u00a0±\u00a00.0020",
                                "1.50\u00a0±\u00a00.20",
                                "0.1500\u00a0±\u00a00.0030",
                                "0.2000\u00a0±\u00a00.0040",
                                "9.00\u00a0±\u00a00.40",
                                "0.420\u00a0±\u00a00.030",
                                "5.100\u00a0±\u00a00.040"};
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

// In a window of 1280 pixels as in a large one: a number that loses its ± to a second line, or its
// last digits, is misread.
TEST(ResponseTable, ANumberAndItsPlusMinusStandOnOneLine) {
  QWidget window;
  QTableWidget* table = new_response_table(&window);
  title_response_table(*table, "Scene");
  constexpr double kRadians = std::numbers::pi / 180.0;
  ResponseStatistics s;
  s.n = 2650;
  s.mean << -0.0022 * kRadians, -0.0015 * kRadians, -0.0101;
  s.mean_sigma << 0.0011 * kRadians, 0.0014 * kRadians, 0.00023;
  s.covariance.diagonal() << 0.0025 * kRadians * kRadians, 0.0054 * kRadians * kRadians, 118e-6;
  s.std_sigma << 0.0008 * kRadians, 0.0012 * kRadians, 0.00022;
  TransitionFit fit;
  fit.delta_m = -0.000397;
  fit.delta_sigma_m = 0.000103;
  fit.sigma_m = 0.00422;
  fit.sigma_sigma_m = 0.000043;
  add_response_row(*table, "All scenes", s, fit, {});
  for (const int width : {900, 930, 1400}) {
    window.resize(width + 10, 300);
    table->setGeometry(0, 0, width, 250);
    window.show();
    QCoreApplication::processEvents();
    const QFontMetrics metrics(table->font());
    int all = 0;
    for (int c = 0; c < table->columnCount(); ++c) {
      EXPECT_GT(table->columnWidth(c), metrics.horizontalAdvance(table->item(0, c)->text()) + 3)
          << c << " of " << width;
      all += table->columnWidth(c);
    }
    EXPECT_LE(all, table->viewport()->width()) << width;
    EXPECT_LT(table->rowHeight(0), 2 * metrics.height());
  }
}

}  // namespace
}  // namespace lvcalib::widgets::response_table_test
