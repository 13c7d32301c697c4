// SPDX-License-Identifier: GPL-3.0-or-later
#include "dialogs/results_dialog.h"

#include <QTextDocument>
#include <numbers>

#include <gtest/gtest.h>

namespace lvcalib::widgets::results_dialog_test {
namespace {

CalibrationResult example() {
  CalibrationResult result;
  UncertainRigid3& pose = result.extrinsic.camera_from_lidar;
  pose.transform.translation = {0.1, -0.2345, 0.3};
  pose.transform.rotation = so3_exp({0, 0, 0.25 * std::numbers::pi});
  pose.covariance.diagonal() << 1e-6, 4e-6, 9e-6, 1e-8, 4e-8, 9e-8;
  result.quality = Quality::kDoubtful;
  result.quality_reason = Message("only <one> scene");
  result.warnings = {Message("result: take more")};
  result.extrinsic.weak_directions = {Message("rotation about x is weak")};
  return result;
}

TEST(ResultsDialog, ShowsThePoseInAllFormsWithItsUncertainty) {
  QTextDocument document;
  document.setHtml(results_html(example()));
  const QString text = document.toPlainText();
  for (const char* part :
       {"100.000", "-234.500", "300.000",     // mm
        "1.000", "2.000", "3.000",            // ± mm
        "45.0000", "0.3826834", "0.9238795",  // yaw, quaternion
        "0.100", "0.200", "0.300",            // ± mrad
        "doubtful", "only <one> scene", "take more", "rotation about x is weak"}) {
    EXPECT_TRUE(text.contains(QString::fromUtf8(part))) << part;
  }
}

TEST(ResultsDialog, TheMatrixHasItsRowsInOrder) {
  const QStringList rows = matrix_text(example()).trimmed().split('\n');
  ASSERT_EQ(rows.size(), 4);
  EXPECT_EQ(rows[0].simplified(), "0.70710678 -0.70710678 0.00000000 0.10000000");
  EXPECT_EQ(rows[3].simplified(), "0.00000000 0.00000000 0.00000000 1.00000000");
}

}  // namespace
}  // namespace lvcalib::widgets::results_dialog_test
