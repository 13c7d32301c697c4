// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/discovery_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace lvcalib {
namespace {

using ::testing::HasSubstr;

Discovery sample_discovery() {
  Discovery d;
  EffectFinding f;
  f.id = "range_cyclic";
  f.rank = 1;
  f.verdict = EffectVerdict::kPresent;
  f.parameters = {{"a", "mm", 1e-3, 0.004, 0.0002}};
  f.shape = 0.31;
  f.shape_sigma = 0.002;
  f.shape_name = "period (m)";
  d.effects.push_back(f);
  EffectFinding curve;
  curve.id = "curve:range:azimuth";
  curve.verdict = EffectVerdict::kPresent;
  curve.spec = "curve:range:azimuth[-1..1]";
  curve.curve = {Channel::kRange, {"azimuth"}, {"rad"}, {{-1.0, 0.0, 0.002, 0.0001}}};
  d.effects.push_back(curve);
  d.selected = {"range_cyclic"};
  StructureScore unknown{Channel::kRange, "azimuth", 0.05, 1.0};
  unknown.formula = "formula:range:a*azimuth^2";
  unknown.formula_score = 0.04;
  d.unknown = {unknown};
  d.budget = {{"range_offset", "a", "mm", 12.0, 9.5, 0.8, Matrix6d::Identity()}};
  d.covariance = 1e-6 * Matrix6d::Identity();
  d.covariance_with_budget = 4e-6 * Matrix6d::Identity();
  d.warnings = {Message("something was left out")};
  return d;
}

TEST(DiscoveryFile, HasBudgetShapesCurvesAndClosedForms) {
  const auto j = nlohmann::json::parse(discovery_as_json(sample_discovery()));
  EXPECT_EQ(j["effects"][0]["shape_sigma"], 0.002);
  EXPECT_EQ(j["effects"][0]["shape_name"], "period (m)");
  EXPECT_FALSE(j["effects"][0].contains("curve"));
  EXPECT_EQ(j["effects"][1]["spec"], "curve:range:azimuth[-1..1]");
  const auto& point = j["effects"][1]["curve"]["points"][0];
  EXPECT_DOUBLE_EQ(point["value"].get<double>(), 2.0);  // mm
  EXPECT_FALSE(point.contains("y"));
  EXPECT_EQ(j["unknown"][0]["closed_form"]["with"], "formula:range:a*azimuth^2");
  const auto& item = j["sensitivity_budget"][0];
  EXPECT_EQ(item["id"], "range_offset");
  EXPECT_EQ(item["size"], 12.0);
  EXPECT_EQ(item["unit"], "mm");
  EXPECT_EQ(item["translation_mm"], 9.5);
  EXPECT_EQ(item["rotation_mrad"], 0.8);
  EXPECT_EQ(j["covariance_with_budget"][3][3], 4e-6);
  EXPECT_EQ(j["warnings"][0], "something was left out");
}

TEST(DiscoveryFile, TheSummarySaysWhatIsLeftOpen) {
  const std::string text = discovery_summary(sample_discovery());
  EXPECT_THAT(text, HasSubstr("Warning: something was left out"));
  EXPECT_THAT(text, HasSubstr("could still do"));
  EXPECT_THAT(text, HasSubstr("range_offset"));
  EXPECT_THAT(text, HasSubstr("in total"));
  EXPECT_THAT(text, HasSubstr("with the budget below"));
}

}  // namespace
}  // namespace lvcalib
