// SPDX-License-Identifier: GPL-3.0-or-later
#include "pages/uncertainty_text.h"

#include <QTextDocument>
#include <cmath>

#include <gtest/gtest.h>

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
