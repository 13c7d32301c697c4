// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulation/disturbances/registry.h"

#include <cmath>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace lvcalib::simulation {
namespace {

using testing::HasSubstr;

std::string complaint(const std::map<std::string, double>& effects, int lines = 6) {
  const Status status = check_effects(effects, lines);
  if (status.ok()) return {};
  EXPECT_EQ(status.error().kind, ErrorKind::kUsage);
  return status.error().text();
}

TEST(Registry, EveryEntryIsWhole) {
  const std::set<std::string> units = {"mm", "mm/s", "ppm", "mrad", "px", "us", "1"};
  std::set<std::string> ids;
  for (const Disturbance& disturbance : disturbances()) {
    EXPECT_TRUE(ids.insert(disturbance.id).second) << disturbance.id;
    EXPECT_TRUE(units.contains(disturbance.unit)) << disturbance.id;
    EXPECT_LT(disturbance.lowest, disturbance.highest) << disturbance.id;
    EXPECT_GE(disturbance.typical, disturbance.lowest) << disturbance.id;
    EXPECT_LE(disturbance.typical, disturbance.highest) << disturbance.id;
    EXPECT_FALSE(disturbance.sentence.empty()) << disturbance.id;
    EXPECT_EQ(find_disturbance(disturbance.id), &disturbance);
    EXPECT_EQ(complaint({{disturbance.id, disturbance.typical}}), "");
  }
  EXPECT_EQ(ids.size(), 38U);
  EXPECT_EQ(find_disturbance("gravity"), nullptr);
}

TEST(Registry, UnitsAreSi) {
  EXPECT_DOUBLE_EQ(unit_in_si("mm"), 1e-3);
  EXPECT_DOUBLE_EQ(unit_in_si("mm/s"), 1e-3);
  EXPECT_DOUBLE_EQ(unit_in_si("mrad"), 1e-3);
  EXPECT_DOUBLE_EQ(unit_in_si("ppm"), 1e-6);
  EXPECT_DOUBLE_EQ(unit_in_si("us"), 1e-6);
  EXPECT_DOUBLE_EQ(unit_in_si("px"), 1.0);
  EXPECT_DOUBLE_EQ(unit_in_si("1"), 1.0);
}

TEST(Registry, UnknownIdsPointToTheNearest) {
  EXPECT_THAT(complaint({{"range_wlak", 1.0}}), HasSubstr("did you mean 'range_walk'?"));
  EXPECT_THAT(complaint({{"warp_drive", 1.0}}), HasSubstr("known effects: range_offset"));
}

TEST(Registry, ValuesOutOfRangeAreRefusedWithTheirUnit) {
  EXPECT_THAT(complaint({{"range_walk", 101.0}}), HasSubstr("is 101 mm, expected -100 to 100 mm"));
  EXPECT_THAT(complaint({{"print_scale", -30000.0}}), HasSubstr("ppm"));
  EXPECT_THAT(complaint({{"range_offset", NAN}}), HasSubstr("range_offset"));
  EXPECT_THAT(complaint({{"range_offset", INFINITY}}), HasSubstr("range_offset"));
}

TEST(Registry, LineEffectsNeedLines) {
  for (const char* id : {"channel_range_offset", "channel_angle_offset"}) {
    EXPECT_THAT(complaint({{id, 1.0}}, 1), HasSubstr("one line only")) << id;
    EXPECT_EQ(complaint({{id, 1.0}}, 6), "") << id;
  }
}

}  // namespace
}  // namespace lvcalib::simulation
