// SPDX-License-Identifier: GPL-3.0-or-later
// plan, as a user runs it: a good plan, and everything that can be wrong with its input.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "camera/camera.h"
#include "cli/child_process.h"
#include "cli/good_dataset.h"
#include "target/target.h"

namespace lvcalib::testing {
namespace {
namespace fs = std::filesystem;
using ::testing::HasSubstr;

class PlanCommand : public ::testing::Test {
 protected:
  void SetUp() override {
    Camera camera;
    camera.width_px = 1440;
    camera.height_px = 900;
    camera.fx = camera.fy = 1000.0;
    camera.cx = 719.5;
    camera.cy = 449.5;
    write_file(at("camera.yaml"), to_yaml(camera));
    write_file(at("target.yaml"), to_yaml(Target{}));
    fs::copy_file(fs::path(LVCALIB_SOURCE_DIR) / "resources" / "lidars" / "avia.yaml",
                  at("lidar.yaml"));
  }
  [[nodiscard]] fs::path at(const std::string& name) const { return folder_.path() / name; }
  [[nodiscard]] Outcome plan(const std::vector<std::string>& more = {}) const {
    std::vector<std::string> arguments = {
        "plan",         "--target",       at("target.yaml"), "--camera", at("camera.yaml"),
        "--lidar",      at("lidar.yaml"), "--scenes",        "3",        "-o",
        at("plan.json")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_lvcalib(arguments);
  }
  void expect_refused(int status, const std::string& what,
                      const std::vector<std::string>& more = {}) const {
    const Outcome outcome = plan(more);
    EXPECT_EQ(outcome.status, status) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr(what));
    EXPECT_EQ(outcome.out, "");
    EXPECT_FALSE(fs::exists(at("plan.json")));
  }
  TemporaryFolder folder_{"plan"};
};

TEST_F(PlanCommand, WritesPosesWithTheirPredictions) {
  const Outcome outcome = plan({"--effect", "range_walk"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("3 scenes of"));
  EXPECT_THAT(outcome.out, HasSubstr("predicted sigma"));
  const auto j = nlohmann::json::parse(read_file(at("plan.json")));
  ASSERT_EQ(j["scenes"].size(), 3U);
  for (const auto& scene : j["scenes"]) {
    EXPECT_EQ(scene["T_camera_board"].size(), 4U);
    EXPECT_THAT(scene["description"].get<std::string>(), HasSubstr("board at"));
    EXPECT_EQ(scene["effects"][0]["id"], "range_walk");
  }
  EXPECT_EQ(j["covariance"].size(), 6U);
  EXPECT_LT(j["scenes"][2]["sigma_translation_mm"][0].get<double>(),
            j["scenes"][0]["sigma_translation_mm"][0].get<double>());
}

TEST_F(PlanCommand, SameInputSamePlan) {
  ASSERT_EQ(plan({"--threads", "1"}).status, 0);
  const std::string once = read_file(at("plan.json"));
  ASSERT_EQ(plan({"--threads", "2"}).status, 0);
  EXPECT_EQ(read_file(at("plan.json")), once);
}

TEST_F(PlanCommand, WrongUsage) {
  expect_refused(2, "did you mean 'range_walk'", {"--effect", "range_wlk"});
  EXPECT_EQ(run_lvcalib({"plan", "--scenes", "3"}).status, 2);
}

TEST_F(PlanCommand, EffectsThatTheLidarCannotShow) {
  replace_text(at("lidar.yaml"), "time: true", "time: false");
  expect_refused(3, "no time", {"--effect", "scan_motion"});
}

TEST_F(PlanCommand, UnusableFiles) {
  replace_text(at("lidar.yaml"), "[-35.2, 35.2]", "[150, 200]");
  expect_refused(3, "in view of both sensors");
  replace_text(at("lidar.yaml"), "[150, 200]", "[35.2]");
  expect_refused(3, "lidar.yaml");
  fs::remove(at("lidar.yaml"));
  expect_refused(3, "lidar.yaml");
}

}  // namespace
}  // namespace lvcalib::testing
