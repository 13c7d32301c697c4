// SPDX-License-Identifier: GPL-3.0-or-later
// The catalogue and why an effect cannot be tested.
#include <cmath>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "model/effect.h"
#include "support/synthetic_table.h"

namespace lvcalib {
namespace {

using ::testing::HasSubstr;

TEST(Registry, EveryEffectTellsWhoItIs) {
  std::set<std::string> ids;
  const std::set<std::string> groups = {"LiDAR range", "LiDAR angle", "beam", "radiometry",
                                        "board",       "camera",      "time"};
  for (const EffectPtr& effect : effect_catalogue()) {
    const EffectInfo& info = effect->info();
    EXPECT_TRUE(ids.insert(info.id).second) << info.id << " twice";
    EXPECT_TRUE(groups.contains(info.group)) << info.id << ": " << info.group;
    for (const std::string* text :
         {&info.title, &info.physics, &info.formula, &info.source, &info.discriminating_pose})
      EXPECT_FALSE(text->empty()) << info.id;
    EXPECT_EQ(info.physics.back(), '.') << info.id;
    EXPECT_EQ(find_effect(info.id), effect);
  }
  EXPECT_GE(ids.size(), 33U);
}

TEST(Registry, UnknownIdsAreNothing) {
  EXPECT_EQ(find_effect("range_wlak"), nullptr);
  EXPECT_EQ(find_effect(""), nullptr);
}

TEST(Registry, ShapesAreFiniteAndNamed) {
  const auto made = test::synthetic_table({});
  for (const EffectPtr& effect : effect_catalogue()) {
    const auto shapes = effect->shapes(made.table);
    ASSERT_FALSE(shapes.empty()) << effect->info().id;
    EXPECT_EQ(shapes.size() > 1, !effect->shape_name().empty()) << effect->info().id;
    for (const double shape : shapes) EXPECT_TRUE(std::isfinite(shape)) << effect->info().id;
  }
}

TEST(Registry, WhatATableLacksIsNamed) {
  const auto why = [](const std::string& id, const MeasurementTable& table) {
    return why_not_testable(*find_effect(id), table);
  };
  const auto full = test::synthetic_table({}).table;
  for (const EffectPtr& effect : effect_catalogue()) {
    const Message reason = why_not_testable(*effect, full);
    EXPECT_EQ(!reason.empty(), effect->is_gauge() || effect->is_in_base_model())
        << effect->info().id << ": " << reason.text();
    if (effect->is_gauge()) {
      EXPECT_THAT(reason, HasSubstr("not defined"));
    }
  }
  MeasurementTable table = full;
  table.has_time = false;
  EXPECT_THAT(why("scan_motion", table), HasSubstr("the time is not in every cloud"));
  table = full;
  table.lines = {3};
  EXPECT_THAT(why("channel_range_offset", table),
              HasSubstr("the laser line is not in every cloud"));
  table = full;
  table.has_intensity = false;
  EXPECT_THAT(why("range_walk", table), HasSubstr("the intensity is not in every cloud"));
  table = full;
  table.boundary.clear();
  EXPECT_THAT(why("boundary_bias", table), HasSubstr("no edges"));
  table = full;
  table.target.type = TargetType::kCheckerboard;
  EXPECT_THAT(why("corner_bias", table), HasSubstr("no tags"));
}

}  // namespace
}  // namespace lvcalib
