// SPDX-License-Identifier: GPL-3.0-or-later
#include "views/color_bar.h"

#include <QSignalSpy>
#include <QTest>

#include <gtest/gtest.h>

#include "widgets/views/plots_test.h"

namespace lvcalib::widgets::color_bar_test {
namespace {

TEST(ColorBar, ShowsTheWholeScaleFromBelowUpwards) {
  ColorBar bar;
  ColorScale scale;
  scale.low = -3.0;
  scale.high = 17.0;
  bar.setScale(scale, "range (m)");
  bar.resize(bar.sizeHint().width(), 300);
  EXPECT_TRUE(test::shows(bar, QColor::fromRgb(scale.color(-3.0))));
  EXPECT_TRUE(test::shows(bar, QColor::fromRgb(scale.color(17.0))));
  const QImage image = bar.grab().toImage();
  const QRgb low = image.pixel(12, 280);
  const QRgb high = image.pixel(12, 20);
  EXPECT_GT(qGreen(high), qGreen(low));
}

TEST(ColorBar, NameOnlyIsNarrower) {
  ColorBar bar;
  bar.setScale({}, "x");
  const int wide = bar.sizeHint().width();
  bar.setNameOnly("camera colour");
  EXPECT_LT(bar.sizeHint().width(), wide);
}

TEST(ColorBar, CategoriesStandByName) {
  ColorBar bar;
  std::vector<CloudCategory> scenes;
  for (int k = 0; k < 4; ++k)
    scenes.push_back({QStringLiteral("scene %1").arg(k), qRgb(40 + 50 * k, 0, 200 - 50 * k)});
  bar.setCategories(scenes, "scene");
  bar.resize(bar.sizeHint().width(), 300);
  for (const CloudCategory& scene : scenes) {
    EXPECT_TRUE(test::shows(bar, QColor(scene.color)));
    EXPECT_TRUE(bar.toolTip().contains(scene.name));
  }
  // Where there is no room for all, the tool tip still has them.
  bar.resize(bar.sizeHint().width(), 60);
  EXPECT_FALSE(test::shows(bar, QColor(scenes.back().color)));
  EXPECT_TRUE(bar.toolTip().contains(scenes.back().name));
  bar.setNameOnly("camera colour");
  EXPECT_FALSE(test::shows(bar, QColor(scenes.front().color)));
}

TEST(ColorBar, OddScalesAreDrawn) {
  ColorBar bar;
  bar.resize(80, 200);
  for (const auto& [low, high] : {std::pair{5.0, 5.0}, {0.0, 1e-9}, {-1e12, 1e12}, {3.0, 1.0}}) {
    ColorScale scale;
    scale.low = low;
    scale.high = high;
    bar.setScale(scale, "odd");
    EXPECT_FALSE(bar.grab().isNull());
  }
}

TEST(ColorBar, EndsOfTheColoursAreDraggedOverTheHistogram) {
  ColorBar bar;
  bar.resize(120, 300);
  bar.show();
  ColorScale whole;
  whole.low = 0.0;
  whole.high = 100.0;
  bar.setScale(whole, "range (m)", whole, std::vector<int>(48, 5));
  QSignalSpy chosen(&bar, &ColorBar::rangeChosen);
  QSignalSpy cleared(&bar, &ColorBar::rangeCleared);
  QTest::mousePress(&bar, Qt::LeftButton, {}, QPoint(40, 285));
  QTest::mouseMove(&bar, QPoint(40, 150));
  QTest::mouseRelease(&bar, Qt::LeftButton, {}, QPoint(40, 150));
  ASSERT_GE(chosen.count(), 1);
  EXPECT_NEAR(chosen.last().at(0).toDouble(), 50.0, 5.0);
  EXPECT_EQ(chosen.last().at(1).toDouble(), 100.0);
  QTest::mouseDClick(&bar, Qt::LeftButton, {}, QPoint(40, 150));
  EXPECT_EQ(cleared.count(), 1);
  // Without values there is nothing to choose from.
  bar.setScale(whole, "range (m)");
  QTest::mousePress(&bar, Qt::LeftButton, {}, QPoint(40, 285));
  QTest::mouseMove(&bar, QPoint(40, 100));
  EXPECT_EQ(chosen.last().at(1).toDouble(), 100.0);
  EXPECT_FALSE(bar.grab().isNull());
}

}  // namespace
}  // namespace lvcalib::widgets::color_bar_test
