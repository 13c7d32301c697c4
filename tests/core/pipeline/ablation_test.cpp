// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/ablation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/pose_matchers.h"
#include "support/simulated_dataset.h"

namespace lvcalib {
namespace {

using ::testing::ElementsAre;

const MethodResult& method_of(const CalibrationResult& result, const std::string& name) {
  for (const MethodResult& m : result.methods) {
    if (m.name == name) return m;
  }
  throw std::runtime_error("no method " + name);
}

class Ablation : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    data_ = new test::SimulatedDataset(test::dataset_options(1, 4));
    CalibrationRequest request;
    request.options.ablation = true;
    auto result = calibrate(data_->open(), request, {});
    ASSERT_TRUE(result.ok()) << result.error().text();
    result_ = new CalibrationResult(std::move(*result));
  }
  static void TearDownTestSuite() {
    delete result_;
    delete data_;
  }
  static test::SimulatedDataset* data_;
  static CalibrationResult* result_;
};
test::SimulatedDataset* Ablation::data_ = nullptr;
CalibrationResult* Ablation::result_ = nullptr;

TEST_F(Ablation, ThePapersMethodIsNearTheTruthAndNotOurs) {
  ASSERT_EQ(result_->scenes[0].paper_nodes.size(), 9U);
  const MethodResult& paper = method_of(*result_, "joint_paper");
  EXPECT_THAT(paper.camera_from_lidar, test::IsNearPose(data_->rig().camera_from_lidar, 8.0, 3.0));
  EXPECT_GT(paper.translation_mm, 0.01);  // To joint_refined.
  EXPECT_EQ(paper.scenes.size(), 4U);
  EXPECT_TRUE(paper.heldout_px && paper.heldout_mm);
}

TEST_F(Ablation, LeadsFromThePaperToTheResultOneChangeAtATime) {
  std::vector<std::string> names;
  for (const AblationStep& step : result_->ablation) names.push_back(step.method.name);
  ASSERT_THAT(names, ElementsAre("joint_paper", "along_rays", "transition", "covariance", "planes",
                                 "robust_loss", "joint_refined", "forward_model"));
  const auto& steps = result_->ablation;
  const Rigid3& final = result_->extrinsic.camera_from_lidar.transform;
  for (std::size_t k = 0; k < steps.size(); ++k) {
    const MethodResult& m = steps[k].method;
    EXPECT_FALSE(steps[k].change.empty());
    EXPECT_TRUE(m.heldout_px && m.heldout_mm) << m.name;
    EXPECT_GT(m.rms_mm, 0.0) << m.name;
    EXPECT_NEAR(m.translation_mm, 1e3 * translation_distance_m(m.camera_from_lidar, final), 1e-9);
    // Up to the loss every change moves the extrinsic; a loss that no residual reaches moves none.
    if (k >= 1 && k <= 4) {
      EXPECT_GT(translation_distance_m(m.camera_from_lidar, steps[k - 1].method.camera_from_lidar),
                1e-8)
          << m.name;
    }
  }
  EXPECT_EQ(steps.front().method.camera_from_lidar.matrix(),
            method_of(*result_, "joint_paper").camera_from_lidar.matrix());
  EXPECT_EQ(steps[6].method.camera_from_lidar.matrix(),
            method_of(*result_, "joint_refined").camera_from_lidar.matrix());
  EXPECT_EQ(steps.back().method.translation_mm, 0.0);
  EXPECT_EQ(steps.back().method.rotation_mrad, 0.0);
}

TEST_F(Ablation, IsSolvedAgainForTheScenesInUseAndGoneWhenNotAskedFor) {
  CalibrationOptions options = result_->options;
  const auto less = resolve_calibration(*result_, {true, true, false, true}, options);
  ASSERT_TRUE(less.ok());
  ASSERT_EQ(less->ablation.size(), 8U);
  EXPECT_EQ(less->ablation[2].method.scenes.size(), 3U);
  options.ablation = false;
  const auto none = resolve_calibration(*result_, {true, true, true, true}, options);
  ASSERT_TRUE(none.ok());
  EXPECT_TRUE(none->ablation.empty());
  EXPECT_EQ(none->methods.size(), 10U);
}

}  // namespace
}  // namespace lvcalib
