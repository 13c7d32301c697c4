// SPDX-License-Identifier: GPL-3.0-or-later
#include "model/formula_expression.h"

#include <array>
#include <cmath>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace lvcalib {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

const std::vector<std::string> kVariables{"range", "azimuth", "tilt_direction"};

std::string error_of(const std::string& text) {
  const auto made = FormulaExpression::parse(text, kVariables);
  EXPECT_FALSE(made.ok()) << text;
  if (made.ok()) return {};
  EXPECT_EQ(made.error().kind, ErrorKind::kUsage);
  return made.error().text();
}

TEST(FormulaExpression, SeparatesVariablesFromCoefficients) {
  const auto f = FormulaExpression::parse("b*sin(3*azimuth) + a1*range", kVariables);
  ASSERT_TRUE(f.ok()) << f.error().text();
  EXPECT_THAT(f->coefficients(), ElementsAre("a1", "b"));
  EXPECT_THAT(f->variables(), ElementsAre(1U, 0U));  // alphabetic: azimuth, range
  const std::array at{0.4, 2.5};
  const std::array c{10.0, 100.0};
  EXPECT_DOUBLE_EQ(f->evaluate(at, c), 100.0 * std::sin(1.2) + 25.0);
  std::array<double, 2> columns{};
  f->columns(at, columns);
  EXPECT_DOUBLE_EQ(columns[0], 2.5);
  EXPECT_DOUBLE_EQ(columns[1], std::sin(1.2));
}

TEST(FormulaExpression, LogarithmsAreNatural) {
  const auto f = FormulaExpression::parse("a*ln(range)+b*log(range)", kVariables);
  ASSERT_TRUE(f.ok());
  const std::array at{10.0};
  std::array<double, 2> columns{};
  f->columns(at, columns);
  EXPECT_DOUBLE_EQ(columns[0], std::log(10.0));
  EXPECT_DOUBLE_EQ(columns[1], std::log(10.0));
}

TEST(FormulaExpression, SyntaxErrorsNameTheirPlace) {
  EXPECT_THAT(error_of("a*sin(range"), HasSubstr("character"));
  EXPECT_THAT(error_of("a**range"), HasSubstr("at character 3"));
  EXPECT_THAT(error_of("a range"), HasSubstr("at character 3"));
  EXPECT_THAT(error_of(""), HasSubstr("empty"));
  EXPECT_THAT(error_of("a=range"), HasSubstr("at character 2"));
  EXPECT_THAT(error_of("a,b"), HasSubstr("2 values"));
  EXPECT_THAT(error_of(std::string(3000, 'a')), HasSubstr("3000 characters"));
}

TEST(FormulaExpression, UnknownNamesGetTheNearestCovariate) {
  EXPECT_THAT(error_of("a*azimut"), HasSubstr("did you mean 'azimuth'?"));
  EXPECT_THAT(error_of("a*foo"), HasSubstr("tilt_direction"));  // the list
  EXPECT_THAT(error_of("range*2"), HasSubstr("no free coefficient"));
}

TEST(FormulaExpression, WhatIsNotDefinedIsNotFinite) {
  const auto f = FormulaExpression::parse("a/range + b*sqrt(azimuth)", kVariables);
  ASSERT_TRUE(f.ok());
  const std::array c{1.0, 1.0};
  EXPECT_FALSE(std::isfinite(f->evaluate(std::array{1.0, 0.0}, c)));
  EXPECT_FALSE(std::isfinite(f->evaluate(std::array{-1.0, 1.0}, c)));
  EXPECT_DOUBLE_EQ(f->evaluate(std::array{4.0, 2.0}, c), 2.5);
}

TEST(FormulaExpression, ThreadsDoNotDisturbEachOther) {
  const auto f = FormulaExpression::parse("a*range", kVariables);
  ASSERT_TRUE(f.ok());
  std::array<int, 4> wrong{};
  std::vector<std::thread> threads;
  for (std::size_t t = 0; t < wrong.size(); ++t) {
    threads.emplace_back([&, t] {
      for (int k = 0; k < 5000; ++k) {
        const std::array at{static_cast<double>(k)};
        const std::array c{static_cast<double>(t + 1)};
        wrong[t] += f->evaluate(at, c) == static_cast<double>(k) * c[0] ? 0 : 1;
      }
    });
  }
  for (auto& t : threads) t.join();
  EXPECT_THAT(wrong, ElementsAre(0, 0, 0, 0));
}

}  // namespace
}  // namespace lvcalib
