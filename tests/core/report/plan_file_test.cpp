// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/plan_file.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "support/temporary_folder.h"

namespace lvcalib {
namespace {

ScenePlan sample() {
  ScenePlan plan;
  plan.poses_tried = 7;
  PlannedScene scene;
  scene.pose.distance_m = 2.0;
  scene.pose.tilt_y_deg = 30.0;
  scene.covariance = 4e-6 * Matrix6d::Identity();
  plan.scenes.push_back(scene);
  scene.determined = true;
  scene.covariance = 1e-6 * Matrix6d::Identity();
  scene.effects = {{"range_walk", 4.5}};
  plan.scenes.push_back(scene);
  plan.warnings = {Message("beware")};
  return plan;
}

TEST(PlanFile, HasPosesDeviationsAndEffects) {
  const auto j = nlohmann::json::parse(plan_as_json(sample()));
  ASSERT_EQ(j["scenes"].size(), 2U);
  // Nothing is promised while a direction is open.
  EXPECT_TRUE(j["scenes"][0]["sigma_translation_mm"].is_null());
  EXPECT_NEAR(j["scenes"][1]["sigma_translation_mm"][2].get<double>(), 1.0, 1e-12);
  EXPECT_NEAR(j["scenes"][1]["sigma_rotation_mrad"][0].get<double>(), 1.0, 1e-12);
  EXPECT_EQ(j["scenes"][1]["effects"][0]["id"], "range_walk");
  EXPECT_EQ(j["scenes"][1]["effects"][0]["sigmas"], 4.5);
  EXPECT_EQ(j["scenes"][1]["number"], 2);
  EXPECT_EQ(j["scenes"][1]["T_camera_board"].size(), 4U);
  EXPECT_EQ(j["warnings"][0], "beware");
  EXPECT_EQ(j["covariance"].size(), 6U);
  EXPECT_FALSE(j.contains("covariance_before"));
  ScenePlan on = sample();
  on.known = 4e-6 * Matrix6d::Identity();
  EXPECT_EQ(nlohmann::json::parse(plan_as_json(on))["covariance_before"][5][5], 4e-6);
}

TEST(PlanFile, IsWrittenWholeOrNotAtAll) {
  const test::TemporaryFolder folder;
  ASSERT_TRUE(write_plan(sample(), folder.path() / "plan.json").ok());
  const Status refused = write_plan(sample(), folder.path() / "none" / "plan.json");
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().kind, ErrorKind::kOutput);
}

}  // namespace
}  // namespace lvcalib
