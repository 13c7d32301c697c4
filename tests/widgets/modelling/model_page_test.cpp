// SPDX-License-Identifier: GPL-3.0-or-later
// The page by itself; with a dataset it is driven in workbench/model_flow_test.cpp.
#include "modelling/model_page.h"

#include <QLabel>
#include <QPushButton>
#include <QTemporaryDir>
#include <QTreeWidget>

#include <gtest/gtest.h>

#include "model_example.h"
#include "runner/model_work.h"
#include "runner/workspace.h"

namespace lvcalib::widgets::model_page_test {
namespace {

TEST(ModelPageTest, WithoutACalibrationItSaysWhatToDo) {
  const QTemporaryDir folder;
  Workspace workspace(folder.path());
  ModelWork work(workspace);
  ModelPage page(work);
  page.resize(1100, 700);
  page.show();
  QTest::qWait(50);
  const auto* message = page.findChild<QLabel*>("model_message");
  EXPECT_TRUE(message->isVisible());
  EXPECT_TRUE(message->text().contains("Run the calibration"));
  EXPECT_FALSE(page.findChild<QPushButton*>("add_effect")->isEnabled());
  EXPECT_FALSE(page.findChild<QPushButton*>("find_all")->isEnabled());
  // One truth on the whole page, and in the language that is chosen later.
  const auto* missing = page.findChild<QLabel*>("missing_verdict");
  EXPECT_EQ(missing->text(), "Run the calibration first.");
  page.setReason(Message("not enough scenes"));
  EXPECT_EQ(message->text(), "not enough scenes");
  EXPECT_EQ(missing->text(), "not enough scenes");
  QEvent language(QEvent::LanguageChange);
  QCoreApplication::sendEvent(&page, &language);
  EXPECT_EQ(message->text(), "not enough scenes");
  page.setReason({});
  EXPECT_EQ(missing->text(), "Run the calibration first.");
  EXPECT_FALSE(work.busy());
}

}  // namespace
}  // namespace lvcalib::widgets::model_page_test
