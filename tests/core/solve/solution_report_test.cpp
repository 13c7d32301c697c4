// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/solution_report.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/synthetic_observations.h"

namespace lvcalib {
namespace {

using ::testing::HasSubstr;

class SolutionReporting : public ::testing::Test {
 protected:
  SolutionReporting() : scenes_(test::observed_scenes(4, target_, camera_, truth_, {}, 1)) {
    auto result = fit_robustly({scenes_, camera_, target_, options_});
    EXPECT_TRUE(result.ok());
    fit_ = std::move(result).value();
  }
  [[nodiscard]] ExtrinsicSolution report() const {
    return report_solution(fit_, {scenes_, camera_, target_, options_});
  }
  Target target_;
  Camera camera_ = test::test_camera();
  Rigid3 truth_ = test::test_extrinsic();
  ExtrinsicOptions options_;
  std::vector<SceneObservations> scenes_;
  RobustFit fit_;
};

TEST_F(SolutionReporting, CovarianceIsTheInverseInformation) {
  const ExtrinsicSolution solution = report();
  const Matrix6d product = solution.camera_from_lidar.covariance * fit_.fit.information;
  EXPECT_TRUE(product.isApprox(Matrix6d::Identity(), 1e-6)) << product;
  EXPECT_EQ(solution.rank, 6);
  EXPECT_TRUE(solution.weak_directions.empty());
}

TEST_F(SolutionReporting, AnOpenDirectionIsNamedAndGetsAnAbsurdSigma) {
  Vector6d scale = Vector6d::Ones();
  scale(1) = 0.0;  // translation along y
  fit_.fit.information = scale.asDiagonal() * fit_.fit.information * scale.asDiagonal();
  const ExtrinsicSolution solution = report();
  EXPECT_EQ(solution.rank, 5);
  ASSERT_FALSE(solution.weak_directions.empty());
  EXPECT_THAT(solution.weak_directions.front(), HasSubstr("camera's y axis is not determined"));
  EXPECT_GT(std::sqrt(solution.camera_from_lidar.covariance(1, 1)), 100.0);
}

TEST_F(SolutionReporting, TheRatioDecidesWhatCountsAsWeak) {
  Vector6d scale = Vector6d::Ones();
  scale(0) = 0.05;  // twenty times less known
  fit_.fit.information = scale.asDiagonal() * fit_.fit.information * scale.asDiagonal();
  EXPECT_FALSE(report().weak_directions.empty());
  options_.weak_direction_ratio = 1e3;
  EXPECT_TRUE(report().weak_directions.empty());
}

TEST_F(SolutionReporting, RmsIsOfUsedScenesAndObservations) {
  const ExtrinsicSolution all = report();
  double sum = 0.0;
  double count = 0.0;
  for (const SceneSolution& scene : all.scenes) {
    for (const CornerResidual& c : scene.corners) {
      sum += c.residual_px.squaredNorm();
      count += 1.0;
    }
  }
  EXPECT_NEAR(all.rms_px, std::sqrt(sum / count), 1e-9);
  fit_.mask.scene[0] = false;
  fit_.reasons[0] = Message("for a reason");
  const ExtrinsicSolution rest = report();
  EXPECT_FALSE(rest.scenes[0].used);
  EXPECT_EQ(rest.scenes[0].reason.text(), "for a reason");
  EXPECT_NE(rest.rms_px, all.rms_px);
  EXPECT_EQ(rest.leave_one_out.size(), 3U);
}

}  // namespace
}  // namespace lvcalib
