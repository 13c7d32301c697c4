// SPDX-License-Identifier: GPL-3.0-or-later
#include "start/welcome_page.h"

#include <QCommandLinkButton>
#include <QListWidget>
#include <QSignalSpy>
#include <QTest>

#include <gtest/gtest.h>

namespace lvcalib::widgets::welcome_page_test {
namespace {

TEST(WelcomePage, ButtonsAndRecentPathsAsk) {
  WelcomePage page;
  page.set_recent({"/tmp", "/not/there"});
  page.show();
  QSignalSpy dataset(&page, &WelcomePage::open_dataset_wanted);
  QSignalSpy project(&page, &WelcomePage::open_project_wanted);
  QSignalSpy demo(&page, &WelcomePage::demo_wanted);
  QSignalSpy guide(&page, &WelcomePage::guide_wanted);
  QSignalSpy recent(&page, &WelcomePage::recent_wanted);
  for (const char* name : {"open_dataset", "open_project", "demo", "guide"})
    QTest::mouseClick(page.findChild<QCommandLinkButton*>(name), Qt::LeftButton);
  EXPECT_EQ(dataset.count() + project.count() + demo.count() + guide.count(), 4);
  EXPECT_EQ(demo.count(), 1);
  auto* list = page.findChild<QListWidget*>("recent");
  ASSERT_EQ(list->count(), 2);
  list->setCurrentRow(0);
  QTest::keyClick(list, Qt::Key_Return);
  ASSERT_EQ(recent.count(), 1);
  EXPECT_EQ(recent.first().first().toString(), "/tmp");
  EXPECT_NE(list->item(0)->foreground(), list->item(1)->foreground());
}

}  // namespace
}  // namespace lvcalib::widgets::welcome_page_test
