// SPDX-License-Identifier: GPL-3.0-or-later
#include "pages/uncertainty_text.h"

#include <QTextDocument>
#include <cmath>

#include <gtest/gtest.h>

#include "widgets/support/calibrated_demo.h"

namespace lvcalib::widgets::uncertainty_text_test {
namespace {

QString text_of(const CalibrationResult& result) {
  QTextDocument document;
  document.setHtml(uncertainty_html(result, QPalette()));
  return document.toPlainText();
}

TEST(UncertaintyText, HalvesInfluenceAndProjectionWithTheirNumbers) {
  CalibrationResult result;
  result.extrinsic.weak_directions = {Message("translation along <z> is known ten times worse")};
  SplitHalf split;
  split.name = Message("near/far");
  split.first = {"A"};
  split.second = {"B", "C"};
  split.translation_mm = 4.321;
  split.expected_translation_mm = 1.25;
  split.chi_square = 44.4;
  split.gate = 22.5;
  result.uncertainty.splits = {split};
  result.extrinsic.leave_one_out = {{}};
  result.extrinsic.leave_one_out[0].without = "C";
  result.extrinsic.leave_one_out[0].translation_mm = 0.77;
  result.uncertainty.by_range = {{5.0, 1.23, 0.45}};
  ProjectedUncertainty map;
  map.range_m = 5.0;
  map.sigma_px = {0.25, std::nan(""), 0.5};
  result.uncertainty.maps = {map};
  const QString text = text_of(result);
  for (const char* part :
       {"<z> is known ten times worse", "near/far", "A | B, C", "4.32 mm", "1.25 mm", "44.4 (22.5)",
        "disagree", "0.77 mm", "1.23 mm", "0.45 mm", "0.250 px", "0.500 px"}) {
    EXPECT_TRUE(text.contains(QString::fromUtf8(part))) << part << "\n" << text.toStdString();
  }
  result.uncertainty.splits[0].chi_square = 5.0;
  EXPECT_FALSE(text_of(result).contains("disagree"));
}

// Beside a pose that is stated to some millimetres, tenths of them must not stand alone.
TEST(UncertaintyText, TheTotalStandsBesideTheNoise) {
  const CalibrationResult& result = *test::calibrated_demo().result;
  ASSERT_GT(result.covariance_total.trace(), 0.0);
  const std::optional<UncertaintyReport> total = total_report(result);
  ASSERT_TRUE(total);
  ASSERT_EQ(total->by_range.size(), result.uncertainty.by_range.size());
  ASSERT_EQ(total->maps.size(), 1U);
  for (std::size_t k = 0; k < total->by_range.size(); ++k) {
    // A point at this range ahead, moved by the six errors together.
    const Eigen::Vector3d at(0.0, 0.0, total->by_range[k].range_m);
    Eigen::Matrix<double, 3, 6> by_pose;
    by_pose << Eigen::Matrix3d::Identity(), -skew(at);
    const Eigen::Matrix3d spread = by_pose * result.covariance_total * by_pose.transpose();
    EXPECT_NEAR(total->by_range[k].along_mm, 1e3 * std::sqrt(spread(2, 2)), 1e-6);
    EXPECT_NEAR(total->by_range[k].across_mm, 1e3 * std::sqrt(spread(0, 0) + spread(1, 1)), 1e-6);
    EXPECT_GT(total->by_range[k].across_mm, result.uncertainty.by_range[k].across_mm);
  }
  const QString text = text_of(result);
  EXPECT_TRUE(text.contains(QString::number(total->by_range[1].along_mm, 'f', 2) + " mm"));
  EXPECT_TRUE(text.contains("In total:")) << text.toStdString();
}

TEST(UncertaintyText, TooFewScenesAreSaid) {
  CalibrationResult result;
  result.uncertainty.splits_reason = Message("not enough scenes for halves: 3 of 4");
  const QString text = text_of(result);
  EXPECT_TRUE(text.contains("not enough scenes for halves: 3 of 4"));
  EXPECT_TRUE(text.contains("Not enough scenes: three are needed"));
  EXPECT_FALSE(text.contains("nan"));
}

}  // namespace
}  // namespace lvcalib::widgets::uncertainty_text_test
