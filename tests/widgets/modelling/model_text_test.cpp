// SPDX-License-Identifier: GPL-3.0-or-later
#include "modelling/model_text.h"

#include <gtest/gtest.h>

#include "model_example.h"

namespace lvcalib::widgets::model_text_test {
namespace {

TEST(ModelText, ValuesHaveTheirUnitsAndDeviations) {
  const ParameterEstimate a{"a", "mm", 1e-3, 0.00812, 0.00013};
  EXPECT_EQ(value_text(a, false), QString::fromUtf8("8.12 ± 0.13 mm"));
  EXPECT_EQ(value_text(a, true), "8.12 mm (held)");
  EXPECT_EQ(unit_behind("px"), " px");
  EXPECT_EQ(unit_behind("1"), "");
  EXPECT_EQ(value_text({"n", "1", 1.0, 2.0, 0.5}, false), QString::fromUtf8("2.00 ± 0.50"));
  EXPECT_TRUE(values_text({a, a, a, a}, false).endsWith(QString::fromUtf8(", …")));
}

TEST(ModelText, NumbersHaveNoExponentsOfPrograms) {
  EXPECT_EQ(plain_number(1670.0), "1670");
  EXPECT_EQ(plain_number(120.0, 2), "120");
  EXPECT_EQ(plain_number(99.7, 2), "100");
  EXPECT_EQ(plain_number(-2.345), "-2.35");
  EXPECT_EQ(plain_number(0.0299), "0.0299");
  EXPECT_EQ(plain_number(1.01e-7), QString::fromUtf8("1.0·10⁻⁷"));
  EXPECT_EQ(plain_number(3.2e-12), QString::fromUtf8("3.2·10⁻¹²"));
  EXPECT_EQ(plain_number(0.0), "0");
  EXPECT_EQ(plain_number(1e9), QString::fromUtf8("∞"));
}

// A bound of a chance over many trials may exceed one; a chance does not.
TEST(ModelText, AChanceIsAtMostCertainty) {
  EffectProposal proposal;
  proposal.finding.criteria = {{"p_value", 4.65, 0.05, true}};
  const QString html = criteria_html(proposal);
  EXPECT_FALSE(html.contains("4.65")) << html.toStdString();
  EXPECT_TRUE(html.contains("1&nbsp;&gt;&nbsp;0.05")) << html.toStdString();
}

TEST(ModelText, EveryCovariateOfAChannelHasAName) {
  const auto& base = *test::model_example().base;
  for (const StructureScore& s : base.structure)
    EXPECT_FALSE(covariate_name(s.covariate).isEmpty()) << s.covariate;
  EXPECT_EQ(covariate_name("line"), "laser line");
  EXPECT_EQ(covariate_name("something new"), "something new");
  EXPECT_EQ(category_name("print", 1.0), "black");
  EXPECT_EQ(category_name("tag", 7.0), "7");
}

TEST(ModelText, EveryRuleThatAnEffectMustPassHasAName) {
  ASSERT_TRUE(test::model_example().missing);
  std::size_t asked = 0;
  for (const EffectProposal& p : test::model_example().missing->proposals) {
    const QString html = criteria_html(p);
    EXPECT_EQ(html.isEmpty(), p.finding.criteria.empty()) << p.finding.id;
    bool all = !p.finding.criteria.empty();
    for (const Criterion& c : p.finding.criteria) {
      EXPECT_FALSE(html.contains("<td>" + QString::fromStdString(c.name) + "&nbsp;")) << c.name;
      all = all && c.holds();
      ++asked;
    }
    // What is suggested has passed them all, and nothing else has.
    if (!p.finding.criteria.empty()) {
      EXPECT_EQ(all, p.suggested) << p.finding.id;
    }
    EXPECT_EQ(html.contains(QChar(0x2717)), !html.isEmpty() && !all) << p.finding.id;
  }
  EXPECT_GT(asked, 0U);
}

TEST(ModelText, StepsSayWhatWasDone) {
  const auto& example = test::model_example();
  EXPECT_EQ(step_text(*example.base), "base model");
  EXPECT_EQ(step_text(*example.mended), "+ Range walk");
  EXPECT_EQ(effect_title("formula:range:a*range"), "formula:range:a*range");
  // What could not be done, as with an effect that another version has, is in brackets.
  ModelStep carried = *example.base;
  carried.change = ModelChange::kAdd;
  carried.changed = "quantum_foam";
  carried.without_change = true;
  EXPECT_EQ(step_text(carried), "(+ quantum_foam: not possible)");
}

}  // namespace
}  // namespace lvcalib::widgets::model_text_test
