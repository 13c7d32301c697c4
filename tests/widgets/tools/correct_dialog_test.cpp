// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/correct_dialog.h"

#include <QCheckBox>
#include <QDir>
#include <QDoubleSpinBox>
#include <QFile>
#include <QLineEdit>
#include <QListWidget>
#include <QPushButton>
#include <QTemporaryDir>
#include <cmath>

#include <gtest/gtest.h>

#include "cloud/cloud.h"
#include "model/effect.h"
#include "widgets/support/driver.h"

namespace lvcalib::widgets::correct_dialog_test {
namespace {

using test::find;
using test::wait_until;

// A model with a constant range offset, which every point shows.
std::shared_ptr<CalibrationResult> with_offset(double offset_m) {
  auto out = std::make_shared<CalibrationResult>();
  ParameterEstimate offset;
  offset.name = "a";
  offset.unit = "mm";
  offset.unit_in_si = 1e-3;
  offset.value = offset_m;
  out->model.push_back({"range_offset", {offset}, 0.0, 0.0, {}});
  return out;
}

Cloud example_cloud() {
  Cloud cloud;
  for (int i = 0; i < 200; ++i) {
    cloud.points_m.emplace_back(2.0F, 0.01F * static_cast<float>(i), 0.5F);
    cloud.intensity.push_back(50.0F);
  }
  return cloud;
}

class CorrectDialogTest : public ::testing::Test {
 protected:
  static void TearDownTestSuite() { EXPECT_TRUE(Runner::wait_for_workers(60'000)); }
  QString write(const char* name) {
    const QString path = folder_.filePath(QLatin1String(name));
    QDir().mkpath(QFileInfo(path).absolutePath());
    EXPECT_TRUE(write_pcd(path.toStdString(), example_cloud()).ok());
    return path;
  }
  QString summary() { return find<QLabel>(dialog_, "correct_summary")->text(); }
  QPushButton& button(const char* name) { return *find<QPushButton>(dialog_, name); }
  QTemporaryDir folder_;
  test::Answers answers_;
  CorrectDialog dialog_{with_offset(0.010), answers_, folder_.path()};
};

TEST_F(CorrectDialogTest, TakesTheModelOutOfACloud) {
  answers_.cloud = write("walk.pcd");
  button("correct_cloud").click();
  const QString output = find<QLineEdit>(dialog_, "correct_output")->text();
  EXPECT_TRUE(output.endsWith("walk-corrected.pcd"));
  button("correct_start").click();
  ASSERT_TRUE(wait_until([&] { return !dialog_.busy(); }));
  ASSERT_TRUE(QFile::exists(output)) << summary().toStdString();
  EXPECT_TRUE(summary().contains("10.00 mm")) << summary().toStdString();
  const auto before = read_cloud(answers_.cloud.toStdString());
  const auto after = read_cloud(output.toStdString());
  ASSERT_TRUE(before.ok());
  ASSERT_TRUE(after.ok());
  ASSERT_EQ(before->size(), after->size());
  EXPECT_NEAR(before->points_m[7].norm() - after->points_m[7].norm(), 0.010, 1e-5);
}

TEST_F(CorrectDialogTest, AnEffectThatIsNotTickedStaysInTheCloud) {
  answers_.cloud = write("walk.pcd");
  button("correct_cloud").click();
  auto* effects = find<QListWidget>(dialog_, "correct_effects");
  ASSERT_EQ(effects->count(), 1);
  EXPECT_EQ(effects->item(0)->text(), "Range offset");
  EXPECT_TRUE(button("correct_start").isEnabled());
  effects->item(0)->setCheckState(Qt::Unchecked);
  // Then there is nothing to do.
  EXPECT_FALSE(button("correct_start").isEnabled());
  EXPECT_FALSE(find<QDoubleSpinBox>(dialog_, "correct_clock")->isEnabled());
  find<QCheckBox>(dialog_, "correct_has_clock")->click();
  EXPECT_TRUE(find<QDoubleSpinBox>(dialog_, "correct_clock")->isEnabled());
}

// The time is given in per cent of the way through the calibration, and says so.
TEST(CorrectDialogClock, IsAShareOfTheWayFromTheFirstSceneToTheLast) {
  auto drifting = std::make_shared<CalibrationResult>();
  ParameterEstimate warm;
  warm.name = "b";
  warm.unit = "mm";
  warm.unit_in_si = 1e-3;
  warm.value = 0.020;
  drifting->model.push_back({"range_warmup", {warm}, 1.0, 0.0, {}});
  const QTemporaryDir folder;
  const QString cloud = folder.filePath("walk.pcd");
  ASSERT_TRUE(write_pcd(cloud.toStdString(), example_cloud()).ok());
  test::Answers answers;
  CorrectDialog dialog(drifting, answers, folder.path());
  auto* clock = find<QDoubleSpinBox>(dialog, "correct_clock");
  EXPECT_EQ(clock->text(), "0 %");
  find<QCheckBox>(dialog, "correct_has_clock")->click();
  // b exp(-t/τ) with τ of the whole session: 20 mm at its start, 7.4 mm at its end.
  for (const auto& [percent, moved_m] : {std::pair{0.0, 0.020}, {100.0, 0.020 * std::exp(-1.0)}}) {
    clock->setValue(percent);
    const QString output = folder.filePath(QStringLiteral("at-%1.pcd").arg(percent));
    find<QLineEdit>(dialog, "correct_input")->setText(cloud);
    find<QLineEdit>(dialog, "correct_output")->setText(output);
    find<QPushButton>(dialog, "correct_start")->click();
    ASSERT_TRUE(wait_until([&] { return !dialog.busy(); }));
    const auto after = read_cloud(output.toStdString());
    ASSERT_TRUE(after.ok());
    EXPECT_NEAR(example_cloud().points_m[7].norm() - after->points_m[7].norm(), moved_m, 1e-4);
  }
}

TEST_F(CorrectDialogTest, AFolderKeepsItsNamesAndABrokenCloudDoesNotStopTheOthers) {
  write("run/a.pcd");
  write("run/deep/b.pcd");
  QFile broken(folder_.filePath("run/c.pcd"));
  ASSERT_TRUE(broken.open(QIODevice::WriteOnly));
  broken.write("nothing");
  broken.close();
  answers_.clouds = folder_.filePath("run");
  button("correct_clouds").click();
  button("correct_start").click();
  ASSERT_TRUE(wait_until([&] { return !dialog_.busy(); }));
  EXPECT_TRUE(QFile::exists(folder_.filePath("run-corrected/a.pcd")));
  EXPECT_TRUE(QFile::exists(folder_.filePath("run-corrected/deep/b.pcd")));
  EXPECT_TRUE(summary().startsWith("2 clouds")) << summary().toStdString();
  EXPECT_TRUE(summary().contains("c.pcd"));
}

TEST_F(CorrectDialogTest, TheCloudItselfIsNeverOverwritten) {
  const QString cloud = write("walk.pcd");
  find<QLineEdit>(dialog_, "correct_input")->setText(cloud);
  find<QLineEdit>(dialog_, "correct_output")->setText(cloud);
  button("correct_start").click();
  ASSERT_TRUE(wait_until([&] { return !dialog_.busy(); }));
  EXPECT_TRUE(summary().contains("stays as it is")) << summary().toStdString();
  const auto same = read_cloud(cloud.toStdString());
  ASSERT_TRUE(same.ok());
  EXPECT_EQ(same->points_m[3], example_cloud().points_m[3]);
}

TEST_F(CorrectDialogTest, ACancelledRunSaysSo) {
  for (int i = 0; i < 60; ++i) write(qPrintable(QStringLiteral("run/%1.pcd").arg(i)));
  answers_.clouds = folder_.filePath("run");
  button("correct_clouds").click();
  button("correct_start").click();
  button("correct_stop").click();
  ASSERT_TRUE(wait_until([&] { return !dialog_.busy(); }, 2000));
  EXPECT_TRUE(summary().contains("Cancelled")) << summary().toStdString();
}

TEST(CorrectDialog, WithoutEffectsThereIsNothingToDo) {
  test::Answers answers;
  CorrectDialog dialog(std::make_shared<CalibrationResult>(), answers, {});
  find<QLineEdit>(dialog, "correct_input")->setText("a.pcd");
  find<QLineEdit>(dialog, "correct_output")->setText("b.pcd");
  EXPECT_FALSE(find<QPushButton>(dialog, "correct_start")->isEnabled());
  EXPECT_TRUE(find<QLabel>(dialog, "correct_model")->text().contains("no effects"));
}

}  // namespace
}  // namespace lvcalib::widgets::correct_dialog_test
