// SPDX-License-Identifier: GPL-3.0-or-later
#include "words/total_note.h"

#include <gtest/gtest.h>

namespace lvcalib::widgets::total_note_test {
namespace {

// Numbers that change by themselves a moment later must say so.
TEST(TotalNote, SaysThatAModelsOwnTotalIsToCome) {
  CalibrationResult result;
  const QString plain = total_note(result);
  EXPECT_FALSE(plain.isEmpty());
  EXPECT_FALSE(plain.contains("still the base model's"));
  result.model = {{"range_walk", {{"a", "mm", 1e-3, 0.01, 0.001}}}};
  EXPECT_TRUE(total_note(result).startsWith(plain));
  EXPECT_TRUE(total_note(result).contains("still the base model's"));
  result.budget = {BudgetItem{}};
  EXPECT_EQ(total_note(result), plain);
}

}  // namespace
}  // namespace lvcalib::widgets::total_note_test
