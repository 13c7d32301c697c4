// SPDX-License-Identifier: GPL-3.0-or-later
#include "runner/correction_work.h"

#include <QFile>
#include <QSignalSpy>
#include <QTemporaryDir>
#include <QTest>
#include <filesystem>
#include <fstream>
#include <optional>

#include <gtest/gtest.h>

#include "cloud/cloud.h"

namespace lvcalib::widgets::correction_work_test {
namespace {

class CorrectionWorkTest : public ::testing::Test {
 protected:
  CorrectionWorkTest() {
    QObject::connect(&work_, &CorrectionWork::corrected, &work_,
                     [this](const CorrectedClouds& clouds) { done_ = clouds; });
    QObject::connect(&work_, &CorrectionWork::failed, &work_,
                     [this](const Error& error) { error_ = error; });
    auto result = std::make_shared<CalibrationResult>();
    result->model.push_back({"range_offset", {{"a", "mm", 1e-3, 0.02, 0.0}}, 0.0, 0.0, {}});
    result_ = result;
  }
  static void TearDownTestSuite() { EXPECT_TRUE(Runner::wait_for_workers(60'000)); }
  void write(const char* name) {
    const std::filesystem::path path = folder_.filePath(QLatin1String(name)).toStdString();
    std::filesystem::create_directories(path.parent_path());
    Cloud cloud;
    for (int i = 0; i < 50; ++i) cloud.points_m.emplace_back(3.0F, 0.0F, 0.0F);
    EXPECT_TRUE(write_pcd(path, cloud).ok());
  }
  void correct(const QString& from, const QString& to, const CorrectionOptions& options = {}) {
    done_.reset();
    error_.reset();
    work_.correct(result_, folder_.filePath(from), folder_.filePath(to), options);
    ASSERT_TRUE(QTest::qWaitFor([&] { return done_ || error_; }, 60'000));
  }
  QTemporaryDir folder_;
  std::shared_ptr<const CalibrationResult> result_;
  std::optional<CorrectedClouds> done_;
  std::optional<Error> error_;
  CorrectionWork work_;
};

TEST_F(CorrectionWorkTest, WhatWasWrittenIntoTheFolderIsNoInputOfTheNextRun) {
  write("run/a.pcd");
  write("run/b.pcd");
  correct("run", "run/corrected");
  ASSERT_TRUE(done_.has_value()) << error_->text();
  EXPECT_EQ(done_->clouds, 2U);
  EXPECT_EQ(done_->total.points, 100U);
  EXPECT_NEAR(done_->total.rms_m, 0.02, 1e-6);
  correct("run", "run/corrected");
  ASSERT_TRUE(done_.has_value()) << error_->text();
  EXPECT_EQ(done_->clouds, 2U);
  const auto cloud = read_cloud(folder_.filePath("run/corrected/a.pcd").toStdString());
  ASSERT_TRUE(cloud.ok());
  EXPECT_NEAR(cloud->points_m.front().x(), 2.98, 1e-5);
}

TEST_F(CorrectionWorkTest, WhatIsToBeSkippedStays) {
  write("a.pcd");
  CorrectionOptions options;
  options.skip = {"range_offset"};
  correct("a.pcd", "b.pcd", options);
  ASSERT_TRUE(done_.has_value()) << error_->text();
  ASSERT_EQ(done_->total.effects.size(), 1U);
  EXPECT_EQ(done_->total.effects[0].state, CorrectionState::kSkipped);
  EXPECT_EQ(done_->total.largest_m, 0.0);
  options.skip = {"no such effect"};
  correct("a.pcd", "c.pcd", options);
  ASSERT_TRUE(error_.has_value());
  EXPECT_EQ(error_->kind, ErrorKind::kUsage);
}

TEST_F(CorrectionWorkTest, CloudsThatMayNotBeWholeAreNamed) {
  write("run/a.pcd");
  write("run/b.pcd");
  std::ofstream(folder_.filePath("run/b.pcd").toStdString(), std::ios::app) << "more";
  correct("run", "out");
  ASSERT_TRUE(done_.has_value()) << error_->text();
  EXPECT_EQ(done_->clouds, 2U);
  ASSERT_EQ(done_->warnings.size(), 1U);
  EXPECT_NE(done_->warnings[0].text().find("b.pcd: "), std::string::npos);
}

TEST_F(CorrectionWorkTest, FoldersWithoutCloudsAndMissingOnesAreErrors) {
  std::filesystem::create_directories(folder_.filePath("empty").toStdString());
  correct("empty", "out");
  ASSERT_TRUE(error_.has_value());
  EXPECT_NE(error_->text().find("holds no clouds"), std::string::npos);
  correct("nowhere.pcd", "out.pcd");
  ASSERT_TRUE(error_.has_value());
  EXPECT_FALSE(QFile::exists(folder_.filePath("out.pcd")));
}

}  // namespace
}  // namespace lvcalib::widgets::correction_work_test
