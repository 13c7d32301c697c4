// SPDX-License-Identifier: GPL-3.0-or-later
#include "runner/preview_work.h"

#include <QSignalSpy>
#include <QTemporaryDir>
#include <QTest>

#include <gtest/gtest.h>

#include "runner/demo.h"
#include "runner/workspace.h"

namespace lvcalib::widgets::preview_work_test {
namespace {

class PreviewWorkTest : public ::testing::Test {
 protected:
  void SetUp() override {
    simulation::SimulationOptions options;
    options.seed = 4;
    options.scenes = 3;
    options.lidar.points = 60'000;
    options.image.width_px = 640;
    options.image.height_px = 400;
    ASSERT_TRUE(make_demo(folder_.filePath("d").toStdString(), options, {}).ok());
    QSignalSpy opened(&workspace_, &Workspace::opened);
    workspace_.open_dataset(folder_.filePath("d"));
    ASSERT_TRUE(opened.wait(20'000));
  }
  void run() {
    workspace_.run();
    ASSERT_TRUE(QTest::qWaitFor([&] { return workspace_.up_to_date(); }, 60'000));
  }
  static Decisions with_gate(double gate) {
    Decisions decisions;
    decisions.options.extrinsic.rejection_gate = gate;
    return decisions;
  }

  QTemporaryDir folder_;
  Workspace workspace_{folder_.filePath("data")};
  PreviewWork preview_{workspace_};
};

TEST_F(PreviewWorkTest, TheLastQuestionIsAnsweredAndNothingElseChanges) {
  run();
  const auto before = workspace_.result();
  QSignalSpy ready(&preview_, &PreviewWork::ready);
  for (const double gate : {4.0, 3.0, 1.5}) preview_.request(with_gate(gate));
  ASSERT_TRUE(ready.wait(60'000));
  QTest::qWait(200);
  ASSERT_EQ(ready.count(), 1);
  const auto preview = ready[0][1].value<std::shared_ptr<const CalibrationResult>>();
  EXPECT_EQ(ready[0][0].value<std::shared_ptr<const CalibrationResult>>(), before);
  EXPECT_EQ(preview->options.extrinsic.rejection_gate, 1.5);
  EXPECT_EQ(workspace_.result(), before);
  EXPECT_EQ(workspace_.decisions().options.extrinsic.rejection_gate, 5.0);
  EXPECT_TRUE(workspace_.up_to_date());
}

TEST_F(PreviewWorkTest, ACancelledQuestionIsNotAnswered) {
  preview_.request(with_gate(2.0));  // Before there is a result: nothing to answer with.
  QTest::qWait(2 * PreviewWork::kSettleMs);
  EXPECT_FALSE(preview_.busy());
  run();
  QSignalSpy ready(&preview_, &PreviewWork::ready);
  preview_.request(with_gate(2.0));
  QTest::qWait(PreviewWork::kSettleMs + 30);
  preview_.cancel();
  EXPECT_FALSE(ready.wait(1500));
  EXPECT_FALSE(preview_.busy());
}

}  // namespace
}  // namespace lvcalib::widgets::preview_work_test
