// SPDX-License-Identifier: GPL-3.0-or-later
#include "workbench/result_actions.h"

#include <QDialog>
#include <QFile>
#include <QListWidget>
#include <QPlainTextEdit>
#include <QPushButton>
#include <QSignalSpy>
#include <QTemporaryDir>
#include <QTextBrowser>
#include <QWidget>

#include <gtest/gtest.h>

#include "dialogs/results_dialog.h"
#include "widgets/support/calibrated_demo.h"
#include "widgets/support/driver.h"

namespace lvcalib::widgets::result_actions_test {
namespace {

class ResultActionsTest : public ::testing::Test {
 protected:
  QTemporaryDir folder_;
  AppSettings settings_{folder_.filePath("settings")};
  test::Answers answers_;
  QWidget window_;
  ResultActions& actions_ = *new ResultActions(answers_, settings_, window_);  // The window's.
  QSignalSpy done_{&actions_, &ResultActions::done};
  QSignalSpy failed_{&actions_, &ResultActions::failed};
};

TEST_F(ResultActionsTest, TheReportIsWrittenAndItsFolderRemembered) {
  QSignalSpy logged(&actions_, &ResultActions::logged);
  answers_.export_to = folder_.filePath("r");  // Gets its suffix.
  actions_.write_report(test::calibrated_demo().result, nullptr);
  EXPECT_TRUE(actions_.busy());
  ASSERT_TRUE(done_.wait(30'000));
  EXPECT_FALSE(actions_.busy());
  EXPECT_TRUE(QFile::exists(folder_.filePath("r.html")));
  EXPECT_EQ(settings_.last_folder(), folder_.path());
  EXPECT_EQ(logged.size(), 4);  // Three photographs are gone; where it was written.
  EXPECT_EQ(failed_.size(), 0);
}

TEST_F(ResultActionsTest, NothingHappensWithoutResultOrWithoutAFile) {
  actions_.show(nullptr, {});
  actions_.write_report(nullptr, nullptr);
  answers_.export_to.clear();
  actions_.write_report(test::calibrated_demo().result, nullptr);
  EXPECT_FALSE(actions_.busy());
  EXPECT_EQ(window_.findChild<QDialog*>("results_dialog"), nullptr);
}

TEST_F(ResultActionsTest, FailureAndCancelAreTold) {
  answers_.export_to = folder_.filePath("no/such/r.html");
  actions_.write_report(test::calibrated_demo().result, nullptr);
  ASSERT_TRUE(failed_.wait(30'000));
  EXPECT_EQ(done_.size(), 1);
  answers_.export_to = folder_.filePath("r.html");
  actions_.write_report(test::calibrated_demo().result, nullptr);
  actions_.cancel();
  ASSERT_TRUE(done_.wait(1000));
  EXPECT_FALSE(actions_.busy());
  EXPECT_TRUE(Runner::wait_for_workers(30'000));
  EXPECT_FALSE(QFile::exists(answers_.export_to));
}

TEST_F(ResultActionsTest, ExportsFromTheDialogAreTold) {
  actions_.show(test::calibrated_demo().result, {});
  auto* dialog = window_.findChild<QDialog*>("results_dialog");
  ASSERT_NE(dialog, nullptr);
  auto* list = test::find<QListWidget>(*dialog, "formats");
  list->setCurrentItem(list->findItems("boundary-response", Qt::MatchExactly).value(0));
  answers_.export_to = folder_.filePath("response.yaml");
  test::find<QPushButton>(*dialog, "save_export")->click();
  EXPECT_EQ(done_.size(), 1);
  EXPECT_EQ(settings_.last_folder(), folder_.path());
  QFile file(answers_.export_to);
  ASSERT_TRUE(file.open(QIODevice::ReadOnly));
  EXPECT_TRUE(file.readAll().contains("covariance"));
}

// As when the user goes back in the history of the model: the dialog shows and hands on what every
// page shows. One of a dataset that is not open any more stays as it is.
TEST_F(ResultActionsTest, AnOpenDialogFollowsTheModelInForce) {
  const auto base = test::calibrated_demo().result;
  actions_.show(base, {Missing::kSought, true});
  auto* dialog = window_.findChild<QDialog*>("results_dialog");
  ASSERT_NE(dialog, nullptr);
  const auto text = [&] { return test::find<QTextBrowser>(*dialog, "results")->toPlainText(); };
  EXPECT_FALSE(text().contains("Range walk"));
  auto modelled = std::make_shared<CalibrationResult>(*base);
  modelled->model = {{"range_walk", {{"a", "mm", 1e-3, 0.01, 0.001}}}};
  modelled->model_scales.darkness_high = 1.0;
  modelled->extrinsic.camera_from_lidar.transform.translation.x() += 0.25;
  actions_.follow(modelled, {Missing::kNothing, true});
  EXPECT_TRUE(text().contains("Range walk")) << text().toStdString();
  const auto matrix = [&] {
    return test::find<QPlainTextEdit>(*dialog, "matrix")->toPlainText().toStdString();
  };
  EXPECT_EQ(matrix(), matrix_text(*modelled).toStdString());
  auto* formats = test::find<QListWidget>(*dialog, "formats");
  formats->setCurrentItem(formats->findItems("urdf", Qt::MatchExactly).value(0));
  const auto preview = [&] {
    return test::find<QPlainTextEdit>(*dialog, "preview")->toPlainText();
  };
  EXPECT_TRUE(preview().contains("taken out: Range walk")) << preview().toStdString();
  actions_.set_frames({"lidar", "camera"});
  actions_.follow(base, {Missing::kNothing, true});
  EXPECT_TRUE(text().contains("Range walk"));
}

}  // namespace
}  // namespace lvcalib::widgets::result_actions_test
