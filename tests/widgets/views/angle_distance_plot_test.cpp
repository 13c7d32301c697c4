// SPDX-License-Identifier: GPL-3.0-or-later
#include "views/angle_distance_plot.h"

#include <QSignalSpy>
#include <QTemporaryDir>
#include <QTest>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "widgets/views/plots_test.h"

namespace lvcalib::widgets::angle_distance_plot_test {
namespace {

AngleDistanceData example() {
  AngleDistanceData data;
  data.reach_m = 0.02;
  data.intensity.low = 10;
  data.intensity.high = 130;
  data.record.id = 4;
  data.record.valid = true;
  data.record.wave_m = {0.003, -0.002, 0.001};
  for (int k = 0; k < 12; ++k) {
    BinRecord bin;
    bin.angle_rad = -std::numbers::pi + (k + 0.5) * std::numbers::pi / 6.0;
    bin.midpoint_m = 0.003 * std::cos(bin.angle_rad) - 0.002 * std::sin(bin.angle_rad) + 0.001;
    bin.sigma_m = 4e-4;
    bin.samples = 20;
    bin.state = k == 3 ? BinState::kOutlier : k == 7 ? BinState::kTooFewSamples : BinState::kUsed;
    data.record.bins.push_back(bin);
  }
  for (int k = 0; k < 400; ++k) {
    const double distance = -0.018 + 0.036 * (k % 40) / 40.0;
    data.samples.push_back(
        {-3.1 + 0.0155 * k, distance, distance > 0 ? 130.0 : 10.0, static_cast<std::uint32_t>(k)});
  }
  return data;
}

TEST(AngleDistancePlot, DrawsSamplesWaveBinsAndRefusals) {
  for (const bool dark : {false, true}) {
    AngleDistancePlot plot;
    plot.setPalette(test::palette_of(dark));
    plot.resize(600, 400);
    plot.setTitle("node 4");
    plot.setData(example());
    const PlotColors& colors = plot.colors();
    EXPECT_EQ(colors.dark, dark);
    EXPECT_TRUE(test::shows(plot, colors.fit));
    EXPECT_TRUE(test::shows(plot, colors.refused));
    const double bright = dark ? 1.0 : 0.92;
    EXPECT_TRUE(test::shows(plot, QColor::fromRgb(map_color(ColorMap::kSequential, bright))));
    EXPECT_TRUE(test::shows(plot, colors.background));
  }
}

TEST(AngleDistancePlot, CsvCarriesBinsAndSamples) {
  AngleDistancePlot plot;
  plot.setData(example());
  const auto rows = test::rows_of(plot.csv());
  ASSERT_EQ(rows.size(), 412);
  const auto cells = rows[3].split(',');
  EXPECT_EQ(cells[0], "bin");
  EXPECT_NEAR(cells[1].toDouble(), -75.0, 1e-9);
  EXPECT_NEAR(cells[3].toDouble(), 0.4, 1e-12);
  EXPECT_EQ(cells[5], "contradicts the other bins");
  EXPECT_TRUE(rows[12].startsWith("sample,"));
}

TEST(AngleDistancePlot, WheelZoomsAndHomeShowsAllAgain) {
  AngleDistancePlot plot;
  plot.resize(500, 400);
  plot.setData(example());
  plot.show();
  const QCPRange before = plot.xAxis->range();
  QWheelEvent wheel(QPointF(250, 200), plot.mapToGlobal(QPointF(250, 200)), {}, QPoint(0, 120),
                    Qt::NoButton, Qt::NoModifier, Qt::NoScrollPhase, false);
  QApplication::sendEvent(&plot, &wheel);
  EXPECT_LT(plot.xAxis->range().size(), before.size());
  plot.setData(example());  // A replay keeps the zoom.
  EXPECT_LT(plot.xAxis->range().size(), before.size());
  QTest::keyClick(&plot, Qt::Key_Home);
  EXPECT_NEAR(plot.xAxis->range().size(), before.size(), 1e-9);
}

TEST(AngleDistancePlot, AClickIsNotADrag) {
  AngleDistancePlot plot;
  plot.resize(500, 400);
  plot.setData(example());
  plot.show();
  QSignalSpy clicks(&plot, &PlotView::clicked);
  QTest::mouseClick(&plot, Qt::LeftButton, {}, QPoint(250, 200));
  EXPECT_EQ(clicks.size(), 1);
  QTest::mousePress(&plot, Qt::LeftButton, {}, QPoint(250, 200));
  QTest::mouseMove(&plot, QPoint(320, 230));
  QTest::mouseRelease(&plot, Qt::LeftButton, {}, QPoint(320, 230));
  EXPECT_EQ(clicks.size(), 1);
}

TEST(AngleDistancePlot, NoDataIsSaid) {
  AngleDistancePlot plot;
  plot.resize(300, 200);
  plot.clear("nothing here");
  EXPECT_TRUE(plot.csv().isEmpty());
  EXPECT_GT(test::colours_shown(plot), 3);
  EXPECT_FALSE(plot.figureActions()->save("/tmp/never.csv"));
}

TEST(AngleDistancePlot, SavesAllFormats) {
  AngleDistancePlot plot;
  plot.resize(400, 300);
  plot.setData(example());
  const QTemporaryDir folder;
  for (const char* name : {"a.png", "a.pdf", "a.csv"}) {
    EXPECT_TRUE(plot.figureActions()->save(folder.filePath(name))) << name;
    EXPECT_GT(QFileInfo(folder.filePath(name)).size(), 500) << name;
  }
}

}  // namespace
}  // namespace lvcalib::widgets::angle_distance_plot_test
