// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/text.h"

#include <gtest/gtest.h>

namespace lvcalib {
namespace {

TEST(Text, NumbersInAFormat) {
  EXPECT_EQ(formatted("%.1f mm and %.2f mrad", 1.25, -0.5), "1.2 mm and -0.50 mrad");
  EXPECT_EQ(formatted("%.0f %%", 41.6), "42 %");
}

TEST(Text, TooLongATextIsCut) {
  EXPECT_EQ(formatted("%400.0f", 1.0).size(), 255U);
}

}  // namespace
}  // namespace lvcalib
