// SPDX-License-Identifier: GPL-3.0-or-later
#include "pages/uncertainty_pane.h"

#include <QTextBrowser>

#include <gtest/gtest.h>

#include "views/uncertainty_plots.h"
#include "widgets/support/calibrated_demo.h"

namespace lvcalib::widgets::uncertainty_pane_test {
namespace {

TEST(UncertaintyPane, WordsAndBothFiguresOfTheResult) {
  const CalibrationResult& result = *test::calibrated_demo().result;
  UncertaintyPane pane;
  pane.setResult(&result);
  EXPECT_FALSE(pane.findChild<QTextBrowser*>("uncertainty")->toPlainText().isEmpty());
  const auto* map = pane.findChild<UncertaintyMapPlot*>();
  const auto* range = pane.findChild<UncertaintyRangePlot*>();
  ASSERT_FALSE(result.uncertainty.maps.empty());
  EXPECT_EQ(map->csv().count('\n'),
            static_cast<qsizetype>(result.uncertainty.maps.front().pixel.size()) + 1);
  EXPECT_EQ(range->csv().count('\n'),
            static_cast<qsizetype>(result.uncertainty.by_range.size()) + 1);
  pane.setResult(nullptr);
  EXPECT_TRUE(map->csv().isEmpty());
  EXPECT_TRUE(range->csv().isEmpty());
}

}  // namespace
}  // namespace lvcalib::widgets::uncertainty_pane_test
