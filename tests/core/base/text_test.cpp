// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/text.h"

#include <cmath>

#include <gtest/gtest.h>

namespace lvcalib {
namespace {

TEST(Text, NumbersInAFormat) {
  EXPECT_EQ(formatted("%.1f mm and %.2f mrad", 1.25, -0.5), "1.2 mm and -0.50 mrad");
  EXPECT_EQ(formatted("%.0f %%", 41.6), "42 %");
}

TEST(Text, AValueIsGivenToTheDigitsThatItsSigmaBears) {
  EXPECT_EQ(with_sigma(4885.3, 1297.2), "4885 ± 1297");
  EXPECT_EQ(with_sigma(15.798, 0.412), "15.80 ± 0.41");
  EXPECT_EQ(with_sigma(0.0278, 0.112), "0.03 ± 0.11");
  EXPECT_EQ(with_sigma(-8.9, 2.87), "-8.9 ± 2.9");
  EXPECT_EQ(with_sigma(-0.00012, 0.000034), "-0.000120 ± 0.000034");
  EXPECT_EQ(with_sigma(5.0, 0.0), "5 ± 0") << "known exactly";
  EXPECT_EQ(with_sigma(1.5e7, 2e6), "1.5e+07 ± 2e+06");
  EXPECT_EQ(with_sigma(1.0, NAN), "1 ± nan");
}

TEST(Text, NumbersWithoutAUnitHaveNone) {
  EXPECT_EQ(behind_number("mm"), " mm");
  EXPECT_EQ(behind_number("1"), "");
}

TEST(Text, WordsAreJoined) {
  EXPECT_EQ(joined({"a", "b", "c"}, " or "), "a or b or c");
  EXPECT_EQ(joined({"a"}, ", "), "a");
  EXPECT_EQ(joined({}, ", "), "");
}

TEST(Text, TooLongATextIsCut) {
  EXPECT_EQ(formatted("%400.0f", 1.0).size(), 255U);
}

}  // namespace
}  // namespace lvcalib
