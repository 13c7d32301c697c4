// SPDX-License-Identifier: GPL-3.0-or-later
#include "views/lasso.h"

#include <QSignalSpy>
#include <QTest>
#include <QWheelEvent>

#include <gtest/gtest.h>

namespace lvcalib::widgets::lasso_test {
namespace {

class View : public QWidget {
 public:
  int presses = 0;

 protected:
  void mousePressEvent(QMouseEvent* /*event*/) override { ++presses; }
};

class LassoTest : public ::testing::Test {
 protected:
  void SetUp() override {
    view_.resize(300, 200);
    view_.show();
    ASSERT_TRUE(QTest::qWaitForWindowExposed(&view_));
  }
  // Draws about a square, as a user would.
  void draw(Qt::KeyboardModifiers modifiers = {}) {
    QTest::mousePress(&lasso_, Qt::LeftButton, modifiers, {50, 50});
    for (const QPoint& p : {QPoint(150, 50), QPoint(150, 120), QPoint(50, 120)})
      QTest::mouseMove(&lasso_, p);
    QTest::mouseRelease(&lasso_, Qt::LeftButton, modifiers, {50, 60});
  }
  View view_;
  Lasso lasso_{&view_};
};

TEST_F(LassoTest, ALineIsClosedAboutWhatItHolds) {
  QSignalSpy drawn(&lasso_, &Lasso::drawn);
  lasso_.setOn(true);
  draw();
  ASSERT_EQ(drawn.count(), 1);
  const LassoMask mask(drawn[0][0].value<QPolygonF>());
  EXPECT_FALSE(drawn[0][1].toBool());
  EXPECT_TRUE(mask.contains(100.0, 80.0));
  EXPECT_FALSE(mask.contains(100.0, 130.0));
  EXPECT_FALSE(mask.contains(160.0, 80.0));
  EXPECT_FALSE(mask.contains(-1e300, std::nan("")));
  draw(Qt::ShiftModifier);
  EXPECT_TRUE(drawn[1][1].toBool());
  EXPECT_EQ(view_.presses, 0);
}

TEST_F(LassoTest, OffItIsNotThereAndAClickIsNoLine) {
  EXPECT_FALSE(lasso_.isOn());
  QSignalSpy drawn(&lasso_, &Lasso::drawn);
  lasso_.setOn(true);
  QTest::mouseClick(&lasso_, Qt::LeftButton, {}, {50, 50});
  EXPECT_EQ(drawn.count(), 0);
  // The other buttons are the view's.
  QTest::mouseClick(&lasso_, Qt::RightButton, {}, {50, 50});
  EXPECT_EQ(view_.presses, 1);
}

TEST_F(LassoTest, GrowsWithItsView) {
  lasso_.setOn(true);
  view_.resize(500, 400);
  QTest::qWait(20);
  EXPECT_EQ(lasso_.size(), QSize(500, 400));
}

}  // namespace
}  // namespace lvcalib::widgets::lasso_test
