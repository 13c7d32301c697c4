// SPDX-License-Identifier: GPL-3.0-or-later
#include "runner/recording_work.h"

#include <QDir>
#include <QFile>
#include <QSignalSpy>
#include <QTest>

#include <gtest/gtest.h>

#include "widgets/importing/recorded_walk.h"

namespace lvcalib::widgets::recording_work_test {
namespace {

class RecordingWorkTest : public ::testing::Test {
 protected:
  RecordingWorkTest() {
    QObject::connect(&work_, &RecordingWork::opened, &work_,
                     [this](const OpenedRecording& opened) { opened_ = opened; });
    QObject::connect(&work_, &RecordingWork::looked, &work_,
                     [this](const RecordingLook& look) { look_ = look; });
  }
  static void TearDownTestSuite() { EXPECT_TRUE(Runner::wait_for_workers(60'000)); }
  bool look() {
    work_.open(test::small_walk().path);
    if (!QTest::qWaitFor([&] { return opened_.has_value(); }, 60'000)) return false;
    work_.look(opened_->recording, {});
    return QTest::qWaitFor([&] { return look_.has_value(); }, 60'000);
  }
  QTemporaryDir folder_;
  std::optional<OpenedRecording> opened_;
  std::optional<RecordingLook> look_;
  RecordingWork work_;
};

TEST_F(RecordingWorkTest, OpensLooksAndImports) {
  ASSERT_TRUE(look());
  ASSERT_EQ(opened_->candidates.images.size(), 1U);
  EXPECT_EQ(opened_->info_of_images.front(), opened_->candidates.infos.front());
  EXPECT_EQ(look_->stretches.size(), 3U);
  EXPECT_FALSE(look_->motion.image.empty());
  QSignalSpy imported(&work_, &RecordingWork::imported);
  const QString dataset = folder_.filePath(QStringLiteral("rig"));
  work_.import(opened_->recording, look_->survey, test::small_walk().rig.target, {}, dataset);
  ASSERT_TRUE(QTest::qWaitFor([&] { return !imported.isEmpty(); }, 60'000));
  EXPECT_TRUE(QFile::exists(dataset + QStringLiteral("/camera.yaml")));
}

TEST_F(RecordingWorkTest, AJobThatMakesRoomForAnotherIsNotCalledCancelled) {
  QSignalSpy cancelled(&work_, &RecordingWork::cancelled);
  work_.open(test::small_walk().path);
  ASSERT_TRUE(look());
  EXPECT_EQ(cancelled.size(), 0);
}

TEST_F(RecordingWorkTest, WhatIsCancelledIsNotHandedOverAnyMore) {
  QSignalSpy cancelled(&work_, &RecordingWork::cancelled);
  work_.open(test::small_walk().path);
  QTest::qSleep(300);  // Done, and not delivered yet.
  work_.cancel();
  ASSERT_TRUE(QTest::qWaitFor([&] { return !cancelled.isEmpty(); }, 5000));
  EXPECT_FALSE(opened_.has_value());
}

TEST_F(RecordingWorkTest, PicturesSayWhetherTheBoardIsSeen) {
  ASSERT_TRUE(look());
  QSignalSpy pictured(&work_, &RecordingWork::pictured);
  work_.show_pictures(opened_->recording, *look_, {0, 1, 2}, test::small_walk().rig.target,
                      std::nullopt);
  ASSERT_TRUE(QTest::qWaitFor([&] { return pictured.size() == 3; }, 60'000));
  EXPECT_FALSE(pictured[0][2].toBool()) << "without a camera nobody looks for the board";
  EXPECT_EQ(pictured[0][1].value<QImage>().width(), RecordingWork::kThumbnailPx);
  work_.show_pictures(opened_->recording, *look_, {0, 1, 2}, test::small_walk().rig.target,
                      look_->survey->camera);
  ASSERT_TRUE(QTest::qWaitFor([&] { return pictured.size() == 6; }, 60'000));
  EXPECT_TRUE(pictured[3][2].toBool());
}

}  // namespace
}  // namespace lvcalib::widgets::recording_work_test
