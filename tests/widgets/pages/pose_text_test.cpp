// SPDX-License-Identifier: GPL-3.0-or-later
#include "pages/pose_text.h"

#include <QTextDocument>

#include <gtest/gtest.h>

namespace lvcalib::widgets::pose_text_test {
namespace {

CalibrationResult example() {
  CalibrationResult result;
  result.extrinsic.used_scenes = 3;
  result.extrinsic.rms_px = 0.211;
  result.extrinsic.rms_mm = 1.25;
  result.extrinsic.camera_from_lidar.transform.translation = {0.0815, -0.112, 0.05};
  Vector6d variances;
  variances << 1e-6, 4e-6, 9e-6, 1e-8, 4e-8, 9e-8;
  result.extrinsic.camera_from_lidar.covariance = variances.asDiagonal();
  result.quality = Quality::kGood;
  return result;
}

QString plain(const CalibrationResult& result, const Standing& standing = {}) {
  QTextDocument document;
  document.setHtml(pose_html(result, standing, QPalette()));
  return document.toPlainText();
}

TEST(PoseText, NamesPoseAndStandardDeviations) {
  const QString text = plain(example());
  for (const char* part : {"good", "3 scenes", "0.211 px", "1.25 mm", "81.50 mm", "−112.00 mm",
                           "± 1.00", "± 2.00", "± 3.00", "± 0.0057", "± 0.0172", "0.300 mrad"}) {
    EXPECT_TRUE(text.contains(part)) << part << "\n" << text.toStdString();
  }
}

TEST(PoseText, NothingIsCalledGoodWhileTheSearchGoesOn) {
  const auto first = [](const Standing& standing) {
    return plain(example(), standing).section(u'\n', 0, 0);
  };
  EXPECT_TRUE(first({Missing::kSought, true}).contains("good so far; still looking"));
  EXPECT_TRUE(first({Missing::kSomething, true}).contains("doubtful"));
  EXPECT_TRUE(first({Missing::kNothing, false}).contains("good (out of date)"));
  EXPECT_FALSE(first({Missing::kNothing, true}).contains("so far"));
}

TEST(PoseText, WeakDirectionsAndWarningsAreTextNotMarkup) {
  CalibrationResult result = example();
  result.quality = Quality::kDoubtful;
  result.quality_reason = Message("two scenes <only>");
  result.extrinsic.weak_directions = {Message("rotation about the camera's y axis is weak")};
  result.warnings = {Message("a & b")};
  const QString text = plain(result);
  EXPECT_TRUE(text.contains("doubtful"));
  EXPECT_TRUE(text.contains("two scenes <only>"));
  EXPECT_TRUE(text.contains("rotation about the camera's y axis is weak"));
  EXPECT_TRUE(text.contains("a & b"));
  EXPECT_FALSE(text.contains("None:"));
}

TEST(PoseText, GimbalLockIsSaid) {
  CalibrationResult result = example();
  result.extrinsic.camera_from_lidar.transform.rotation =
      Eigen::AngleAxisd(1.5707963267948966, Eigen::Vector3d::UnitY());
  EXPECT_TRUE(plain(result).contains("unbounded"));
}

}  // namespace
}  // namespace lvcalib::widgets::pose_text_test
