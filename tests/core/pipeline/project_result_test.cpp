// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/project_result.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "pipeline/model_discovery.h"
#include "support/pose_matchers.h"
#include "support/simulated_dataset.h"

namespace lvcalib {
namespace {

// One dataset for all cases; none changes it.
class ProjectResult : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    data_ = new test::SimulatedDataset(test::dataset_options(11, 4));
    auto result = calibrate(data_->open(), {}, {});
    ASSERT_TRUE(result.ok()) << result.error().text();
    base_ = std::make_shared<const CalibrationResult>(std::move(*result));
  }
  static void TearDownTestSuite() {
    base_.reset();
    delete data_;
  }
  static Project project() {
    Project out;
    out.dataset = data_->path();
    return out;
  }
  static const Rigid3& pose(const CalibrationResult& result) {
    return result.extrinsic.camera_from_lidar.transform;
  }
  static inline test::SimulatedDataset* data_ = nullptr;
  static inline std::shared_ptr<const CalibrationResult> base_;
};

TEST_F(ProjectResult, WithoutDecisionsItIsTheCalibration) {
  const auto result = calibrate_project(project(), {});
  ASSERT_TRUE(result.ok()) << result.error().text();
  EXPECT_EQ(pose(**result).matrix(), pose(*base_).matrix());
}

TEST_F(ProjectResult, DecisionsAboutScenesAndTheModelCount) {
  Project with = project();
  with.decisions.scenes["D"].use = false;
  with.model = {{ModelChange::kAdd, "range_offset", {}}};
  const auto result = calibrate_project(with, {});
  ASSERT_TRUE(result.ok()) << result.error().text();
  ASSERT_EQ((*result)->model.size(), 1U);
  EXPECT_EQ((*result)->model[0].id, "range_offset");
  EXPECT_FALSE((*result)->scenes[3].used);
  // The same, step by step.
  CalibrationRequest request;
  request.rejected = {"D"};
  auto three = calibrate(data_->open(), request, {});
  ASSERT_TRUE(three.ok()) << three.error().text();
  const auto base = std::make_shared<const CalibrationResult>(std::move(*three));
  const auto start = start_model(discovery_input(*base), discovery_options(base->options), {});
  ASSERT_TRUE(start.ok()) << start.error().text();
  const auto next = apply_decision(*start, with.model[0], {});
  ASSERT_TRUE(next.ok()) << next.error().text();
  EXPECT_EQ(result_at(base, {*start}), base);
  const auto expected = result_at(base, {*start, *next});
  EXPECT_THAT(pose(**result), test::IsNearPose(pose(*expected), 1e-6, 1e-6));
  EXPECT_GT(translation_distance_m(pose(**result), pose(*base)), 0.0);
}

TEST_F(ProjectResult, ADatasetThatMovedAndAStopAreErrors) {
  Project moved = project();
  moved.dataset = data_->path().parent_path() / "gone";
  const auto nowhere = calibrate_project(moved, {});
  ASSERT_FALSE(nowhere.ok());
  EXPECT_THAT(nowhere.error().text(), ::testing::HasSubstr("gone"));
  std::stop_source stop;
  stop.request_stop();
  RunContext context;
  context.stop = stop.get_token();
  const auto stopped = calibrate_project(project(), context);
  ASSERT_FALSE(stopped.ok());
  EXPECT_EQ(stopped.error().kind, ErrorKind::kCancelled);
}

}  // namespace
}  // namespace lvcalib
