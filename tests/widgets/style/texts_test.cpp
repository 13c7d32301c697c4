// SPDX-License-Identifier: GPL-3.0-or-later
#include "style/texts.h"

#include <QCoreApplication>
#include <QEvent>
#include <QTest>
#include <QWidget>

#include <gtest/gtest.h>

namespace lvcalib::widgets::texts_test {
namespace {

TEST(FollowLanguage, SetsTextsNowAndOnEveryChange) {
  QWidget widget;
  int set = 0;
  follow_language(&widget, [&] { ++set; });
  EXPECT_EQ(set, 1);
  QEvent change(QEvent::LanguageChange);
  QCoreApplication::sendEvent(&widget, &change);
  EXPECT_EQ(set, 2);
  QEvent other(QEvent::PaletteChange);
  QCoreApplication::sendEvent(&widget, &other);
  EXPECT_EQ(set, 2);
}

// A click on a language is answered by what is in sight; the rest follows, or comes when looked at.
TEST(FollowLanguage, WhatIsOutOfSightWaitsForItsTurn) {
  QWidget window;
  QWidget behind(&window);
  behind.hide();
  int set = 0;
  follow_language(&behind, [&] { ++set; });
  window.show();
  const auto change = [&] {
    QEvent event(QEvent::LanguageChange);
    QCoreApplication::sendEvent(&behind, &event);
  };
  change();
  EXPECT_EQ(set, 1);
  EXPECT_TRUE(QTest::qWaitFor([&] { return set == 2; }, 1000));
  change();
  behind.show();
  EXPECT_EQ(set, 3) << "before it is seen";
  QTest::qWait(20);
  EXPECT_EQ(set, 3) << "once is enough";
  change();
  EXPECT_EQ(set, 4) << "it is in sight";
}

}  // namespace
}  // namespace lvcalib::widgets::texts_test
