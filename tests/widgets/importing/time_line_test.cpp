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
