// SPDX-License-Identifier: GPL-3.0-or-later
#include "importing/time_line.h"

#include <QSignalSpy>
#include <QTest>

#include <gtest/gtest.h>

namespace lvcalib::widgets::time_line_test {
namespace {

ImportedStretch stretch(double first_s, double last_s) {
  ImportedStretch out;
  out.first_s = first_s;
  out.last_s = last_s;
  out.taken = out.usable = true;
  return out;
}

RecordedMotion motion_of(double at_rest, double between) {
  RecordedMotion out;
  for (int i = 0; i <= 100; ++i) {
    const bool rest = (i > 10 && i < 30) || (i > 60 && i < 90);
    out.image.push_back({0.1 * i, rest ? at_rest : between});
  }
  out.cloud = out.image;
  return out;
}

TEST(TimeLine, PicturesStandAtTheirTimesUntilAnotherRecordingIsOpened) {
  TimeLine line;
  line.resize(600, 190);
  QImage red(64, 40, QImage::Format_RGB32);
  red.fill(Qt::red);
  line.addPicture(7.5, red);
  line.addPicture(2.5, red);
  line.setRecording(10.0, motion_of(0.2, 40.0), {stretch(1.0, 3.0)});
  EXPECT_EQ(line.pictureCount(), 2U);
  const QImage shown = line.grab().toImage();
  const QRect band = line.stretchRect(0);
  // Between the two nothing is red; above the middle of the stretch, near its time, it is.
  EXPECT_EQ(shown.pixelColor(band.left() + band.width() * 3 / 4, band.top() - 20), QColor(Qt::red));
  const int middle = band.left() + 2 * band.width();
  EXPECT_NE(shown.pixelColor(middle, band.top() - 20), QColor(Qt::red));
  line.clear();
  EXPECT_EQ(line.pictureCount(), 0U);
}

TEST(TimeLine, StretchesStandWhereTheirTimesAreAndCanBeClicked) {
  TimeLine line;
  line.resize(600, 150);
  line.setRecording(10.0, motion_of(0.2, 40.0), {stretch(1.0, 3.0), stretch(6.0, 9.0)});
  const QRect first = line.stretchRect(0);
  const QRect second = line.stretchRect(1);
  EXPECT_LT(first.right(), second.left());
  EXPECT_NEAR(1.5 * first.width(), second.width(), 2.0);
  EXPECT_TRUE(line.stretchRect(2).isNull());
  QSignalSpy clicked(&line, &TimeLine::clicked);
  QTest::mouseClick(&line, Qt::LeftButton, {}, second.center());
  QTest::mouseClick(&line, Qt::LeftButton, {}, QPoint(first.right() + 10, first.center().y()));
  ASSERT_EQ(clicked.size(), 1);
  EXPECT_EQ(clicked[0][0].toInt(), 1);
}

TEST(TimeLine, EdgesCanBeDraggedAsFarAsTheNextStretch) {
  TimeLine line;
  line.resize(600, 150);
  line.setRecording(10.0, motion_of(0.2, 40.0), {stretch(1.0, 3.0), stretch(6.0, 9.0)});
  QSignalSpy clicked(&line, &TimeLine::clicked);
  QSignalSpy moved(&line, &TimeLine::edgesMoved);
  const auto drag = [&](const QPoint& from, const QPoint& to) {
    QTest::mousePress(&line, Qt::LeftButton, {}, from);
    QTest::mouseMove(&line, (from + to) / 2);
    QTest::mouseMove(&line, to);
    QTest::mouseRelease(&line, Qt::LeftButton, {}, to);
  };
  const QRect second = line.stretchRect(1);
  const int third = second.width() / 3;  // One second.
  const QPoint edge(second.left(), second.center().y());
  drag(edge, edge + QPoint(third, 20));
  ASSERT_EQ(moved.size(), 1);
  EXPECT_EQ(moved[0][0].toInt(), 1);
  EXPECT_NEAR(moved[0][1].toDouble(), 7.0, 0.05);
  EXPECT_EQ(moved[0][2].toDouble(), 9.0);
  EXPECT_NEAR(line.stretchRect(1).left(), second.left() + third, 2);
  // Not into the stretch before it, and not beyond its own end.
  drag(QPoint(line.stretchRect(1).left(), edge.y()), QPoint(0, edge.y()));
  EXPECT_EQ(moved.last()[1].toDouble(), 3.0);
  drag(QPoint(line.stretchRect(1).left() + 3, edge.y()), QPoint(599, edge.y()));
  EXPECT_NEAR(moved.last()[1].toDouble(), 8.9, 1e-9);
  EXPECT_TRUE(clicked.isEmpty());
  // A press without a move on an edge is a click on the stretch.
  QTest::mouseClick(&line, Qt::LeftButton, {}, line.stretchRect(0).topLeft() + QPoint(1, 30));
  ASSERT_EQ(clicked.size(), 1);
  EXPECT_EQ(clicked[0][0].toInt(), 0);
  EXPECT_EQ(moved.size(), 3);
}

TEST(TimeLine, TakenAndLeftStretchesLookDifferent) {
  TimeLine line;
  line.resize(600, 150);
  line.setRecording(10.0, motion_of(0.2, 40.0), {stretch(1.0, 3.0)});
  line.setTaken({true});
  const QImage taken = line.grab().toImage();
  line.setTaken({false});
  EXPECT_NE(line.grab().toImage(), taken);
  line.setTaken({true, false});  // Of another recording: not for this one.
  line.setTaken({true});
  EXPECT_EQ(line.grab().toImage(), taken);
  line.setCurrent(0);
  EXPECT_NE(line.grab().toImage(), taken);
  line.setRecording(10.0, motion_of(0.2, 4.0), {stretch(1.0, 3.0)});
  line.setTaken({true});
  EXPECT_NE(line.grab().toImage(), taken) << "less motion is a lower curve";
  line.clear();
  line.grab();  // Nothing to draw is no accident.
}

}  // namespace
}  // namespace lvcalib::widgets::time_line_test
