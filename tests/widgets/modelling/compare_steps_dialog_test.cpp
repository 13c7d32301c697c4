// SPDX-License-Identifier: GPL-3.0-or-later
#include "modelling/compare_steps_dialog.h"

#include <QComboBox>
#include <QLabel>
#include <QTest>
#include <QTreeWidget>

#include <gtest/gtest.h>

#include "pipeline/model_discovery.h"
#include "widgets/support/calibrated_demo.h"

namespace lvcalib::widgets::compare_steps_dialog_test {
namespace {

TEST(CompareStepsDialog, TellsTheMoveAndTheResidualsOfEveryScene) {
  const auto source = test::calibrated_demo().result;
  const auto base = start_model(discovery_input(*source), discovery_options(source->options), {});
  ASSERT_TRUE(base.ok()) << base.error().text();
  const auto next = add_effect(*base, "range_offset", 0.0, {});
  ASSERT_TRUE(next.ok()) << next.error().text();
  const std::vector<ModelStepPtr> steps = {*base, *next};
  auto* dialog = new CompareStepsDialog(source, steps, 1);
  dialog->show();
  auto* scenes = dialog->findChild<QTreeWidget*>("steps_scenes");
  auto* pose = dialog->findChild<QTreeWidget*>("steps_pose");
  ASSERT_TRUE(QTest::qWaitFor([&] { return pose->topLevelItemCount() == 6; }, 20'000));
  ASSERT_EQ(scenes->topLevelItemCount(), 3);
  const CalibrationResult after = with_model(*source, as_discovery(steps, nullptr));
  const auto& was = source->extrinsic;
  const auto& is = after.extrinsic;
  const double moved =
      translation_distance_m(was.camera_from_lidar.transform, is.camera_from_lidar.transform);
  EXPECT_GT(moved, 0.0);
  const auto* verdict = dialog->findChild<QLabel*>("steps_verdict");
  EXPECT_TRUE(verdict->text().contains(QString("moves by %1 mm").arg(1e3 * moved, 0, 'f', 3)))
      << verdict->text().toStdString();
  const QTreeWidgetItem* row = scenes->topLevelItem(1);
  EXPECT_EQ(row->text(0), "B");
  EXPECT_EQ(row->text(3), QString::number(was.scenes[1].rms_mm, 'f', 3));
  EXPECT_EQ(row->text(4), QString::number(is.scenes[1].rms_mm, 'f', 3));
  // A step beside itself.
  dialog->findChild<QComboBox*>("first_step")->setCurrentIndex(1);
  EXPECT_EQ(pose->topLevelItemCount(), 0);
  ASSERT_TRUE(QTest::qWaitFor([&] { return pose->topLevelItemCount() == 6; }, 20'000));
  EXPECT_TRUE(verdict->text().contains("moves by 0.000 mm"));
  dialog->close();
}

}  // namespace
}  // namespace lvcalib::widgets::compare_steps_dialog_test
