// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/check_file.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace lvcalib {
namespace {

TEST(CheckFile, HasVerdictScoresOffsetAndPlaces) {
  EdgeCheck check;
  check.verdict = EdgeVerdict::kContradicts;
  check.given.score = 0.25;
  check.given.edges = 900;
  check.best.score = 0.5;
  check.gain = 0.2;
  check.offset << 0.001, 0.002, 0.003, 0.004, 0.005, 0.006;
  check.offset_px = 4.0;
  check.best_pose.translation = {1.0, 2.0, 3.0};
  check.noticed_turn_rad = {0.001, 0.002, 0.003};
  const auto j = nlohmann::json::parse(check_as_json(
      check, {{"yard", "yard.png", "yard.pcd", {}, {}}}, {Message("half of a cloud")}));
  EXPECT_EQ(j["verdict"], "contradicts");
  EXPECT_EQ(j["reason"], reason_of(check));
  EXPECT_EQ(j["given"]["score"], 0.25);
  EXPECT_EQ(j["given"]["edges"], 900);
  EXPECT_EQ(j["best"]["score"], 0.5);
  EXPECT_EQ(j["gain"]["value"], 0.2);
  EXPECT_EQ(j["offset"]["translation_m"][2], 0.003);
  EXPECT_EQ(j["offset"]["rotation_rad"][0], 0.004);
  EXPECT_EQ(j["offset"]["rms_px"], 4.0);
  EXPECT_EQ(j["covariance"].size(), 6U);
  EXPECT_EQ(j["T_camera_lidar_best"][1][3], 2.0);
  EXPECT_DOUBLE_EQ(j["noticed_turn_mrad"][1].get<double>(), 2.0);
  EXPECT_EQ(j["places"][0]["cloud"], "yard.pcd");
  EXPECT_EQ(j["warnings"], nlohmann::json({"half of a cloud"}));
}

}  // namespace
}  // namespace lvcalib
