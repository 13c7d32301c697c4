// SPDX-License-Identifier: GPL-3.0-or-later
#include "importing/import_foot.h"

#include <QDialog>
#include <QLabel>
#include <QProgressBar>
#include <QPushButton>
#include <QSignalSpy>

#include <gtest/gtest.h>

#include "widgets/support/driver.h"

namespace lvcalib::widgets::import_foot_test {
namespace {

using test::find;

class ImportFootTest : public ::testing::Test {
 protected:
  ImportFootTest() : foot_(&dialog_) { dialog_.show(); }
  QPushButton& button(const char* name) { return *find<QPushButton>(foot_, name); }
  QLabel& problem() { return *find<QLabel>(foot_, "import_problem"); }

  QDialog dialog_;
  ImportFoot foot_;
};

TEST_F(ImportFootTest, WhatIsInTheWayComesBeforeTheNote) {
  foot_.setProblem({});
  EXPECT_FALSE(problem().isVisible());
  foot_.noteWithoutCamera("/data/made");
  foot_.setProblem("choose a folder");
  EXPECT_EQ(problem().text(), "Choose a folder");
  foot_.setProblem({});
  EXPECT_TRUE(problem().text().startsWith("/data/made is written, without intrinsics"));
  EXPECT_TRUE(problem().isVisible());
  foot_.begin();
  foot_.setProblem({});
  EXPECT_FALSE(problem().isVisible());
}

TEST_F(ImportFootTest, OneButtonStopsTheWorkOrLooksAgain) {
  foot_.setBusy(true, true);
  foot_.setProgress(0.25, "Reading…");
  QPushButton& stop = button("import_stop");
  EXPECT_EQ(stop.text(), "&Stop");
  EXPECT_EQ(find<QProgressBar>(foot_, "import_progress")->value(), 250);
  foot_.setBusy(false, true);
  EXPECT_EQ(stop.text(), "&Look again");
  EXPECT_TRUE(stop.isVisible());
  EXPECT_FALSE(find<QProgressBar>(foot_, "import_progress")->isVisible());
  QSignalSpy asked(&foot_, &ImportFoot::stopWanted);
  stop.click();
  EXPECT_EQ(asked.count(), 1);
  foot_.setBusy(false);
  EXPECT_FALSE(stop.isVisible());
}

TEST_F(ImportFootTest, EnterImportsAndNothingElse) {
  EXPECT_TRUE(button("import_start").isDefault());
  for (const char* other : {"import_stop", "import_close"})
    EXPECT_FALSE(button(other).autoDefault()) << other;
  foot_.setReady(false);
  EXPECT_FALSE(button("import_start").isEnabled());
}

TEST(ImportWarningsTest, HaveMarksInTheColoursOfTheWindow) {
  ImportWarnings warnings;
  EXPECT_TRUE(warnings.isHidden());
  warnings.setWarnings({"one", "two"});
  EXPECT_FALSE(warnings.isHidden());
  ASSERT_EQ(warnings.count(), 2);
  const qint64 light = warnings.item(1)->icon().cacheKey();
  QPalette dark = warnings.palette();
  dark.setColor(QPalette::Base, Qt::black);
  dark.setColor(QPalette::Text, Qt::white);
  warnings.setPalette(dark);
  EXPECT_NE(warnings.item(1)->icon().cacheKey(), light);
  warnings.setWarnings({});
  EXPECT_TRUE(warnings.isHidden());
}

}  // namespace
}  // namespace lvcalib::widgets::import_foot_test
