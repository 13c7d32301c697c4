// SPDX-License-Identifier: GPL-3.0-or-later
#include "style/texts.h"

#include <QCoreApplication>
#include <QEvent>
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

}  // namespace
}  // namespace lvcalib::widgets::texts_test
