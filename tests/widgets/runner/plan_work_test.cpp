// SPDX-License-Identifier: GPL-3.0-or-later
#include "runner/plan_work.h"

#include <QSignalSpy>
#include <QTemporaryDir>
#include <fstream>

#include <gtest/gtest.h>

#include "cloud/cloud.h"
#include "widgets/support/calibrated_demo.h"

namespace lvcalib::widgets::plan_work_test {
namespace {

PlanRequest going_on() {
  PlanRequest out;
  out.result = test::calibrated_demo().result;
  out.target = out.result->target;
  out.camera = out.result->camera;
  out.go_on = true;
  out.options.scenes = 1;
  return out;
}

class PlanWorkTest : public ::testing::Test {
 protected:
  static void TearDownTestSuite() { EXPECT_TRUE(Runner::wait_for_workers(60'000)); }
  PlanWorkTest() {
    QObject::connect(&work_, &PlanWork::ready, &work_, [this](const auto& plan) { plan_ = plan; });
    QObject::connect(&work_, &PlanWork::failed, &work_, [this](const Error& e) { error_ = e; });
  }
  PlanWork work_;
  std::shared_ptr<const ScenePlan> plan_;
  std::optional<Error> error_;
};

TEST_F(PlanWorkTest, TheLidarIsThatOfTheScenes) {
  QSignalSpy ended(&work_, &PlanWork::ended);
  work_.request(going_on());
  EXPECT_TRUE(work_.busy());
  ASSERT_TRUE(ended.wait(60'000));
  ASSERT_TRUE(plan_) << (error_ ? error_->text() : "");
  const CalibrationResult& result = *test::calibrated_demo().result;
  ASSERT_TRUE(plan_->known.has_value());
  EXPECT_EQ(*plan_->known, result.extrinsic.camera_from_lidar.covariance);
  EXPECT_EQ(plan_->camera_from_lidar.translation,
            result.extrinsic.camera_from_lidar.transform.translation);
  EXPECT_TRUE(plan_->scenes.front().determined);
}

TEST_F(PlanWorkTest, ACloudThatMayNotBeWholeIsNamed) {
  const QTemporaryDir folder;
  PlanRequest request = going_on();
  request.cloud = folder.filePath("cloud.pcd").toStdString();
  Cloud cloud;
  for (int i = 0; i < 50; ++i)
    cloud.points_m.emplace_back(3.0F, 0.1F * static_cast<float>(i), 0.0F);
  ASSERT_TRUE(write_pcd(request.cloud, cloud).ok());
  std::ofstream(request.cloud, std::ios::app) << "more";
  QSignalSpy ended(&work_, &PlanWork::ended);
  work_.request(request);
  ASSERT_TRUE(ended.wait(60'000));
  ASSERT_TRUE(plan_) << (error_ ? error_->text() : "");
  ASSERT_FALSE(plan_->warnings.empty());
  EXPECT_NE(plan_->warnings[0].text().find("cloud.pcd: "), std::string::npos);
}

TEST_F(PlanWorkTest, WithoutTheForwardModelALidarMustBeGiven) {
  PlanRequest request = going_on();
  auto without = std::make_shared<CalibrationResult>(*request.result);
  without->forward.reset();
  request.result = without;
  QSignalSpy ended(&work_, &PlanWork::ended);
  work_.request(request);
  ASSERT_TRUE(ended.wait(60'000));
  ASSERT_TRUE(error_.has_value());
  EXPECT_NE(error_->text().find("choose a description"), std::string::npos);
}

TEST_F(PlanWorkTest, ANewerRequestTakesThePlaceAndACancelledOneSaysNothing) {
  QSignalSpy cancelled(&work_, &PlanWork::cancelled);
  QSignalSpy ended(&work_, &PlanWork::ended);
  PlanRequest many = going_on();
  many.options.scenes = 100;
  work_.request(many);
  work_.request(going_on());
  ASSERT_TRUE(ended.wait(60'000));
  EXPECT_EQ(cancelled.count(), 0);
  ASSERT_TRUE(plan_);
  EXPECT_EQ(plan_->scenes.size(), 1U);
  plan_.reset();
  work_.request(many);
  work_.cancel();
  EXPECT_TRUE(cancelled.count() == 1 || cancelled.wait(5'000));
  EXPECT_EQ(plan_, nullptr);
  EXPECT_FALSE(work_.busy());
}

}  // namespace
}  // namespace lvcalib::widgets::plan_work_test
