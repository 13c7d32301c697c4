// SPDX-License-Identifier: GPL-3.0-or-later
// check, as a user runs it: a calibration that holds, one that no longer does, and wrong input.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "base/rigid3.h"
#include "cli/child_process.h"
#include "cli/good_dataset.h"

namespace lvcalib::testing {
namespace {
namespace fs = std::filesystem;
using ::testing::HasSubstr;

class CheckCommand : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new TemporaryFolder("check");
    const Outcome outcome =
        run_lvcalib({"calibrate", good_dataset(), "-o", at("result"), "--quiet"});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    // The same images and clouds as another tool would leave them.
    fs::create_directories(at("pairs"));
    for (const std::string& scene : scene_names(good_dataset())) {
      fs::copy(good_dataset() / "scenes" / scene / "image.png", at("pairs") / (scene + ".png"));
      fs::copy(good_dataset() / "scenes" / scene / "cloud.pcd", at("pairs") / (scene + ".pcd"));
    }
    // A rig that was bumped: turned by 12 mrad about the camera's y axis.
    auto j = nlohmann::json::parse(read_file(at("result") / "result.json"));
    Eigen::Matrix4d m;
    auto& rows = j["T_camera_lidar"]["matrix"];
    for (int r = 0; r < 4; ++r)
      for (int c = 0; c < 4; ++c) m(r, c) = rows[r][c].get<double>();
    Vector6d turn = Vector6d::Zero();
    turn(4) = 0.012;
    m = se3_exp(turn).matrix() * m;
    for (int r = 0; r < 4; ++r)
      for (int c = 0; c < 4; ++c) rows[r][c] = m(r, c);
    write_file(at("bumped.json"), j.dump());
  }
  static void TearDownTestSuite() {
    delete folder_;
    folder_ = nullptr;
  }
  static fs::path at(const std::string& name) { return folder_->path() / name; }
  static TemporaryFolder* folder_;
};

TemporaryFolder* CheckCommand::folder_ = nullptr;

TEST_F(CheckCommand, ARightCalibrationAgreesWithScenesAndWithPairs) {
  for (const fs::path& place : {good_dataset(), at("pairs")}) {
    const Outcome outcome = run_lvcalib(
        {"check", at("result") / "result.json", place, "-o", at("check.json"), "--quiet"});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_THAT(outcome.out, HasSubstr("agrees: edges agree to"));
    const auto j = nlohmann::json::parse(read_file(at("check.json")));
    EXPECT_EQ(j["verdict"], "agrees");
    EXPECT_EQ(j["places"].size(), 3U);
    EXPECT_GT(j["given"]["score"].get<double>(), 0.2);
    fs::remove(at("check.json"));
  }
}

TEST_F(CheckCommand, TellsOfACloudThatMayNotBeWhole) {
  fs::copy(at("pairs"), at("longer"));
  const std::string scene = scene_names(good_dataset()).front();
  write_file(at("longer") / (scene + ".pcd"),
             read_file(at("longer") / (scene + ".pcd")) + "twelve bytes");
  const Outcome outcome = run_lvcalib(
      {"check", at("result") / "result.json", at("longer"), "-o", at("longer.json"), "--quiet"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("scene " + scene + ": its cloud: 12 bytes follow"));
  const auto j = nlohmann::json::parse(read_file(at("longer.json")));
  ASSERT_EQ(j["warnings"].size(), 1U);
  EXPECT_THAT(j["warnings"][0], HasSubstr("its cloud: 12 bytes follow"));
}

TEST_F(CheckCommand, ABumpedRigIsFoundOut) {
  const Outcome outcome =
      run_lvcalib({"check", at("bumped.json"), at("pairs"), "-o", at("check.json"), "--quiet"});
  EXPECT_EQ(outcome.status, 1);
  EXPECT_THAT(outcome.err, HasSubstr("contradicts: edges agree better after a turn by"));
  EXPECT_EQ(outcome.out, "");
  const auto j = nlohmann::json::parse(read_file(at("check.json")));
  EXPECT_NEAR(j["offset"]["rotation_rad"][1].get<double>(), -0.012, 0.004);
}

TEST_F(CheckCommand, SaysWhatIsWrongWithItsInput) {
  const Outcome nowhere = run_lvcalib({"check", at("result") / "result.json", at("nowhere")});
  EXPECT_EQ(nowhere.status, 3);
  EXPECT_THAT(nowhere.err, HasSubstr("nowhere: is no folder"));
  const Outcome no_result = run_lvcalib({"check", at("absent.json"), at("pairs")});
  EXPECT_EQ(no_result.status, 3);
  EXPECT_THAT(no_result.err, HasSubstr("absent.json: file not found"));
  EXPECT_EQ(run_lvcalib({"check", at("result") / "result.json"}).status, 2);
  EXPECT_EQ(run_lvcalib({"check", at("bumped.json"), at("pairs"), "--tolerance", "0"}).status, 2);
  // One pair that cannot be read is left out with a warning; none that can is an error.
  fs::create_directories(at("broken"));
  for (const char* name : {"A.png", "A.pcd"}) fs::copy(at("pairs") / name, at("broken") / name);
  write_file(at("broken") / "B.png", "no image");
  write_file(at("broken") / "B.pcd", read_file(at("pairs") / "B.pcd"));
  const Outcome one = run_lvcalib({"check", at("bumped.json"), at("broken"), "--quiet"});
  EXPECT_THAT(one.err, HasSubstr("warning: left out: "));
  EXPECT_THAT(one.err, HasSubstr("B.png"));
  write_file(at("broken") / "A.pcd", read_file(at("broken") / "A.pcd").substr(0, 300));
  const Outcome none = run_lvcalib({"check", at("bumped.json"), at("broken"), "--quiet"});
  EXPECT_EQ(none.status, 3) << none.err;
  EXPECT_EQ(lines_with(none.err, "lvcalib: error: ").size(), 1U);
}

}  // namespace
}  // namespace lvcalib::testing
