// SPDX-License-Identifier: GPL-3.0-or-later
#include "words/quality_text.h"

#include <gtest/gtest.h>

namespace lvcalib::widgets::quality_text_test {
namespace {

CalibrationResult of(Quality quality) {
  CalibrationResult result;
  result.quality = quality;
  return result;
}

// Nothing is called good beside a list that says what is missing, nor before there is such a list.
TEST(QualityText, GoodIsWhatMissesNothing) {
  const CalibrationResult good = of(Quality::kGood);
  const ToldQuality sought = told_quality(good, {Missing::kSought, true});
  EXPECT_EQ(sought.words, "good so far; still looking for what is missing");
  EXPECT_TRUE(sought.open);
  const ToldQuality unasked = told_quality(good, {Missing::kNotSought, true});
  EXPECT_EQ(unasked.words, "good so far; nobody has looked for what is missing");
  EXPECT_TRUE(unasked.open);
  const ToldQuality lacking = told_quality(good, {Missing::kSomething, true});
  EXPECT_EQ(lacking.words, "doubtful");
  EXPECT_EQ(lacking.quality, Quality::kDoubtful);
  EXPECT_FALSE(lacking.open);
  const ToldQuality whole = told_quality(good, {Missing::kNothing, true});
  EXPECT_EQ(whole.words, "good");
  EXPECT_EQ(whole.quality, Quality::kGood);
  EXPECT_FALSE(whole.open);
}

TEST(QualityText, WhatIsBadAlreadyDoesNotWaitForMore) {
  for (const Missing missing :
       {Missing::kNothing, Missing::kSomething, Missing::kSought, Missing::kNotSought}) {
    EXPECT_EQ(told_quality(of(Quality::kFailed), {missing, true}).words, "failed");
    EXPECT_FALSE(told_quality(of(Quality::kDoubtful), {missing, true}).open);
  }
}

TEST(QualityText, WhatIsOutOfDateSaysSo) {
  const ToldQuality told = told_quality(of(Quality::kGood), {Missing::kNothing, false});
  EXPECT_EQ(told.words, "good (out of date)");
  EXPECT_TRUE(told.open);
}

}  // namespace
}  // namespace lvcalib::widgets::quality_text_test
