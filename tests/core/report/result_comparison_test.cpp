// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/result_comparison.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/file_io.h"
#include "support/temporary_folder.h"

namespace lvcalib {
namespace {

StatedExtrinsic stated(const Vector6d& xi, double sigma_m, double sigma_rad) {
  StatedExtrinsic out;
  out.camera_from_lidar = se3_exp(xi);
  Vector6d variance;
  variance << Eigen::Vector3d::Constant(sigma_m * sigma_m),
      Eigen::Vector3d::Constant(sigma_rad * sigma_rad);
  out.covariance = out.covariance_total = variance.asDiagonal();
  return out;
}

TEST(ResultComparison, IsZeroBetweenEqualsAndAddsVariances) {
  Vector6d pose;
  pose << 0.1, -0.2, 0.3, 0.5, -1.0, 0.7;
  const StatedExtrinsic a = stated(pose, 3e-3, 4e-3);
  const StatedExtrinsic b = stated(pose, 4e-3, 3e-3);
  const ExtrinsicDifference d = difference_of(a, b);
  EXPECT_NEAR(d.translation_mm, 0.0, 1e-9);
  EXPECT_NEAR(d.rotation_mrad, 0.0, 1e-9);
  EXPECT_NEAR(d.sigma_first(0), 3e-3, 1e-12);
  EXPECT_NEAR(d.sigma_second(0), 4e-3, 1e-12);
  EXPECT_NEAR(d.sigma(0), 5e-3, 1e-12);
  EXPECT_NEAR(d.sigma(5), 5e-3, 1e-12);
  ASSERT_TRUE(d.probability.has_value());
  EXPECT_NEAR(*d.probability, 1.0, 1e-9);
}

TEST(ResultComparison, ProbabilityIsThatOfChiSquaredWithSixDegrees) {
  // Quantiles from tables: P(χ²₆ > 12.592) = 0.05, P(χ²₆ > 22.458) = 0.001.
  for (const auto& [chi2, probability] :
       std::vector<std::pair<double, double>>{{12.5916, 0.05}, {22.4577, 0.001}, {5.3481, 0.5}}) {
    Vector6d off = Vector6d::Zero();
    off(0) = 1e-3 * std::sqrt(chi2);
    StatedExtrinsic truth;
    truth.is_truth = true;
    truth.camera_from_lidar = se3_exp(off);
    const ExtrinsicDifference d = difference_of(stated(Vector6d::Zero(), 1e-3, 1e-3), truth);
    ASSERT_TRUE(d.chi2.has_value());
    EXPECT_NEAR(*d.chi2, chi2, 1e-6);
    EXPECT_NEAR(*d.probability, probability, 1e-4);
  }
}

TEST(ResultComparison, WithoutStatedErrorsThereIsNoProbability) {
  const ExtrinsicDifference d =
      difference_of(stated(Vector6d::Zero(), 1e-3, 1e-3), stated(Vector6d::Zero(), 0.0, 0.0));
  EXPECT_FALSE(d.chi2.has_value());
  EXPECT_FALSE(d.probability.has_value());
}

TEST(ResultComparison, ReadsResultsAndTruthsAndNothingElse) {
  const test::TemporaryFolder folder;
  const auto write = [&](const char* name, const std::string& text) {
    EXPECT_TRUE(write_file_atomically(folder.path() / name, text).ok());
    return folder.path() / name;
  };
  const std::string rows = "[[1,0,0,0.1],[0,1,0,0.2],[0,0,1,0.3]";
  const auto truth = read_stated_extrinsic(write("truth.json", "{\"T_CL\": " + rows + "]}"));
  ASSERT_TRUE(truth.ok()) << truth.error().text();
  EXPECT_TRUE(truth->is_truth);
  EXPECT_EQ(truth->camera_from_lidar.translation.z(), 0.3);
  std::string covariance = "[";
  for (int r = 0; r < 6; ++r) {
    covariance += r == 0 ? "[" : ",[";
    for (int c = 0; c < 6; ++c) covariance += (c == 0 ? "" : ",") + std::string(r == c ? "4" : "0");
    covariance += "]";
  }
  covariance += "]";
  const std::string result = "{\"T_camera_lidar\": {\"matrix\": " + rows +
                             ",[0,0,0,1]]}, \"covariance_total\": " + covariance + "}";
  const auto read = read_stated_extrinsic(write("result.json", result));
  ASSERT_TRUE(read.ok()) << read.error().text();
  EXPECT_FALSE(read->is_truth);
  EXPECT_EQ(read->covariance_total(2, 2), 4.0);
  for (const char* bad : {"", "[]", "{}", "{\"T_CL\": 3}", "{\"T_camera_lidar\": 3}"}) {
    const auto refused = read_stated_extrinsic(write("bad.json", bad));
    ASSERT_FALSE(refused.ok()) << bad;
    EXPECT_THAT(refused.error().text(), ::testing::HasSubstr("bad.json"));
  }
}

}  // namespace
}  // namespace lvcalib
