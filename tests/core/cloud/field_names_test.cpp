// SPDX-License-Identifier: GPL-3.0-or-later
#include "cloud/field_names.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace lvcalib {
namespace {

TEST(FieldNames, KnowsTheUsualAliases) {
  for (const char* name : {"intensity", "Intensity", "i", "reflectivity", "scalar_intensity",
                           "scalar_Intensity", "INTENSITY", "remission"}) {
    const auto roles = assign_roles({"x", "y", "z", name}, "f");
    ASSERT_TRUE(roles.ok());
    EXPECT_EQ((*roles)[kIntensity], 3) << name;
    EXPECT_EQ((*roles)[kTime], -1) << name;
  }
  for (const char* name : {"time", "t", "timestamp", "time_stamp", "offset_time", "scalar_Time"}) {
    EXPECT_EQ((*assign_roles({"x", "y", "z", name}, "f"))[kTime], 3) << name;
  }
  for (const char* name : {"line", "ring", "channel", "scalar_Ring"}) {
    EXPECT_EQ((*assign_roles({"x", "y", "z", name}, "f"))[kLine], 3) << name;
  }
}

TEST(FieldNames, OrderOfFieldsDoesNotMatterButOrderOfPreferenceDoes) {
  const auto roles =
      assign_roles({"ring", "reflectivity", "Z", "_", "scalar_X", "y", "intensity"}, "f");
  ASSERT_TRUE(roles.ok());
  EXPECT_THAT(*roles, testing::ElementsAre(4, 5, 2, 6, -1, 0));
}

TEST(FieldNames, MissingCoordinateIsAnErrorThatListsWhatIsThere) {
  const auto roles = assign_roles({"x", "y", "intensity"}, "f.pcd");
  ASSERT_FALSE(roles.ok());
  EXPECT_EQ(roles.error().where, "f.pcd");
  EXPECT_THAT(roles.error().message, testing::HasSubstr("no field 'z'"));
  EXPECT_THAT(roles.error().message, testing::HasSubstr("x y intensity"));
}

}  // namespace
}  // namespace lvcalib
