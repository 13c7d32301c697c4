// SPDX-License-Identifier: GPL-3.0-or-later
#include "selection/advice_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "model/row_covariates.h"
#include "model/user_effect.h"

namespace lvcalib::advice_text_test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

EffectFinding finding(const std::string& id, EffectVerdict verdict, double move_mm) {
  EffectFinding f;
  f.id = id;
  f.verdict = verdict;
  f.extrinsic_move_mm = move_mm;
  f.extrinsic_move_mrad = 0.1 * move_mm;
  f.parameters = {{"a", "mm", 1e-3, 0.002, 0.0005}};
  return f;
}

TEST(AdviceText, ACurveCanBeAskedForAsItIsWritten) {
  for (const Channel channel : kAllChannels) {
    const auto& all = row_covariates(channel);
    for (std::size_t k = 0; k < all.size(); ++k) {
      if (all[k].categories) continue;
      StructureScore one{channel, all[k].name};
      const auto spec = parse_user_effect(curve_spec(one));
      ASSERT_TRUE(spec) << spec.error().text();
      EXPECT_EQ(spec->channel, channel);
      ASSERT_EQ(spec->covariates.size(), 1u);
      EXPECT_EQ(find_covariate(channel, spec->covariates.front()), &all[k]);
      EXPECT_THAT(curve_spec(one), Not(HasSubstr(" ")));
    }
  }
  StructureScore two{Channel::kCorner, "image x"};
  two.second_covariate = "image y";
  const auto spec = parse_user_effect(curve_spec(two));
  ASSERT_TRUE(spec) << spec.error().text();
  EXPECT_EQ(spec->covariates.size(), 2u);
}

TEST(AdviceText, WhatCouldSpoilTheExtrinsicMostComesFirst) {
  const std::vector<Message> advice =
      advise({finding("range_offset", EffectVerdict::kNotTestable, 2.0),
              finding("range_walk", EffectVerdict::kAbsent, 9.0),
              finding("range_scale", EffectVerdict::kNotTestable, 0.9),
              finding("scan_motion", EffectVerdict::kNotTestable, 5.0)});
  ASSERT_EQ(advice.size(), 2u) << "absent is absent, and below a millimetre nobody need look";
  EXPECT_THAT(advice[0].text(), HasSubstr("5.0 mm and 0.50 mrad"));
  EXPECT_THAT(advice[0].text(), HasSubstr(find_effect("scan_motion")->info().discriminating_pose));
  EXPECT_THAT(advice[1].text(), HasSubstr("2.0 mm and 0.20 mrad"));
}

TEST(AdviceText, WhatIsInDoubtInTheModelComesBeforeThat) {
  EffectFinding doubt = finding("range_walk", EffectVerdict::kAliased, 1.5);
  doubt.aliases = {"range_offset"};
  std::vector<EffectFinding> all(7, finding("scan_motion", EffectVerdict::kNotTestable, 5.0));
  all.push_back(doubt);
  const std::vector<Message> advice = advise(all);
  ASSERT_EQ(advice.size(), 5u);
  EXPECT_THAT(advice[0].text(), HasSubstr(find_effect("range_walk")->info().discriminating_pose));
}

TEST(AdviceText, OfAChannelThatNothingExplainsTheStrongestIsNamed) {
  StructureScore azimuth{Channel::kRange, "azimuth", 0.2, 3.0};
  azimuth.formula = "formula:range:a*sin(azimuth)";
  const StructureScore weaker{Channel::kRange, "elevation", 0.1, 2.0};
  const StructureScore corner{Channel::kCorner, "image x", 0.05, 0.1};
  const std::vector<Message> advice = advise_unknown({azimuth, weaker, corner});
  ASSERT_EQ(advice.size(), 2u);
  EXPECT_THAT(advice[0].text(), HasSubstr("--with curve:range:azimuth"));
  EXPECT_THAT(advice[0].text(), HasSubstr("20 %"));
  EXPECT_THAT(advice[0].text(), HasSubstr("--with 'formula:range:a*sin(azimuth)'"));
  EXPECT_THAT(advice[1].text(), HasSubstr(curve_spec(corner)));
}

TEST(AdviceText, ValuesAreInTheirUnitsAndNotTooMany) {
  EffectFinding f = finding("range_walk", EffectVerdict::kPresent, 2.0);
  EXPECT_THAT(values_text(f).text(), HasSubstr("2.00 ± 0.50 mm"));
  f.parameters.assign(9, f.parameters.front());
  EXPECT_THAT(values_text(f).text(), HasSubstr("…"));
}

}  // namespace
}  // namespace lvcalib::advice_text_test
