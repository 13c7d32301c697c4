// SPDX-License-Identifier: GPL-3.0-or-later
#include "words/core_text.h"

#include <QCoreApplication>
#include <QHash>
#include <QTranslator>

#include <gtest/gtest.h>

#include "pipeline/verdict.h"

namespace lvcalib::widgets::core_text_test {
namespace {

// A catalogue of the test's own.
class Upside : public QTranslator {
 public:
  [[nodiscard]] QString translate(const char* context, const char* source, const char*,
                                  int) const override {
    if (qstrcmp(context, "Core") != 0) return {};
    return words_.value(QString::fromUtf8(source));
  }
  [[nodiscard]] bool isEmpty() const override { return false; }

 private:
  QHash<QString, QString> words_ = {
      {"scene %1: %2", "<%2> in %1"},
      {"%1 is known %2 times worse than the typical direction: %3", "%2-fold: %1 (%3)"},
      {"rotation about the camera's x axis", "RX"},
      {"file not found", "NO FILE"},
      {"horizontal", "ACROSS"},
      {"Range offset", "OFFSET"},
      {"used", "in use"}};
};

class CoreTextTest : public ::testing::Test {
 protected:
  void SetUp() override { QCoreApplication::installTranslator(&upside_); }
  void TearDown() override { QCoreApplication::removeTranslator(&upside_); }
  Upside upside_;
};

TEST_F(CoreTextTest, SentencesAndWhatFillsThem) {
  EXPECT_EQ(core_text(Message("used")), "in use");
  EXPECT_EQ(core_text(Message("nothing like it")), "nothing like it");
  EXPECT_EQ(core_text(Message()), "");
  EXPECT_EQ(core_text(Message("scene %1: %2", "A", Message("used"))), "<in use> in A");
  EXPECT_EQ(
      core_text(Message("%1 is known %2 times worse than the typical direction: %3",
                        Message("rotation about the camera's x axis"), 7, Message("add a scene"))),
      "7-fold: RX (add a scene)");
  EXPECT_EQ(core_text(Message::listed("used")), "in use");
}

TEST_F(CoreTextTest, NamesAreNobodysToTranslate) {
  EXPECT_EQ(core_text(Message::verbatim("used")), "used");
  EXPECT_EQ(core_text(Message("scene %1: %2", "used", Message("used"))), "<in use> in used");
}

TEST_F(CoreTextTest, ParametersThatAreWordsAreTranslated) {
  const std::vector<Message> values = {
      parameter_is("footprint_offset", "horizontal", "1.2 ± 0.1 mm"),
      parameter_is("footprint_offset", "vertical", "3 mm")};
  EXPECT_EQ(core_text(Message("scene %1: %2", joined(values, ", "), 1)),
            "<1> in ACROSS = 1.2 ± 0.1 mm, vertical = 3 mm");
  EXPECT_EQ(parameter_name("horizontal"), "ACROSS");
  EXPECT_EQ(parameter_name("δf"), "δf");
  // No parameter of the catalogue, though the core has a sentence of these letters.
  EXPECT_EQ(parameter_name("used"), "used");
  // What the user calls a coefficient of his own stays, as do words of a file.
  EXPECT_EQ(core_text(parameter_is("mine", "horizontal", "1")), "horizontal = 1");
  EXPECT_EQ(core_text(Message::verbatim("horizontal = 1")), "horizontal = 1");
}

TEST_F(CoreTextTest, EffectsAreSaidByTheirTitles) {
  EXPECT_EQ(core_text(effect_named("range_offset")), "OFFSET");
  EXPECT_EQ(core_text(Message("%1 or %2", effect_named("range_offset"), effect_named("blooming"))),
            "OFFSET or Blooming");
  EXPECT_EQ(effect_named("range_offset").text(), "range_offset");
  EXPECT_EQ(core_text(effect_named("mine")), "mine");
  // A scene or a file may be called like an effect.
  EXPECT_EQ(core_text(Message("scene %1: %2", "range_offset", 1)), "<1> in range_offset");
}

TEST_F(CoreTextTest, AnErrorSaysWhereAndWhatToDo) {
  EXPECT_EQ(core_text(Error::input(Message("file not found"), "/a/b.pcd", Message("used"))),
            "/a/b.pcd: NO FILE (in use)");
}

TEST_F(CoreTextTest, WhatIsFilledInIsNotReadAsAPlace) {
  EXPECT_EQ(core_text(Message("scene %1: %2", "%2", "100 %1")), "<100 %1> in %2");
}

// The word is for the lines of a terminal; whether it is still the same one, the core's own verdict
// tells.
TEST(CoreText, AWarningOfTheWholeResultStandsWithoutItsHead) {
  CalibrationResult result;
  Verdict(result).note(Message("take more scenes"));
  ASSERT_EQ(result.warnings.size(), 1U);
  EXPECT_EQ(result.warnings.front().text(), "result: take more scenes");
  EXPECT_EQ(warning_text(result.warnings.front()), "take more scenes");
  EXPECT_EQ(warning_text(Message("scene %1: %2", "A", Message("used"))), "scene A: used");
}

TEST(CoreText, WithoutACatalogueTheCoreSpeaks) {
  EXPECT_EQ(core_text(Message("scene %1: %2", "A", Message("used"))), "scene A: used");
}

}  // namespace
}  // namespace lvcalib::widgets::core_text_test
