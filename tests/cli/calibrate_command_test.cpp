// SPDX-License-Identifier: GPL-3.0-or-later
// What calibrate's own flags add to files and streams, and what evaluate makes of it.
#include <iterator>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "cli/child_process.h"
#include "cli/good_dataset.h"

namespace lvcalib::testing {
namespace {
namespace fs = std::filesystem;
using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::StartsWith;

const std::vector<std::string> kSteps = {"joint_paper",   "along_rays",   "transition",
                                         "covariance",    "planes",       "robust_loss",
                                         "joint_refined", "forward_model"};

class CalibrateFlags : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new TemporaryFolder("calibrate_flags");
    methods_ = new Outcome(calibrate("methods", {"--methods", "--quiet"}));
  }
  static void TearDownTestSuite() {
    delete methods_;
    delete folder_;
  }
  static std::string at(const std::string& name) { return folder_->path() / name; }
  static Outcome calibrate(const std::string& out, std::vector<std::string> flags) {
    flags.insert(flags.begin(), {"calibrate", good_dataset(), "-o", at(out)});
    return run_lvcalib(flags);
  }
  static json result(const std::string& out) {
    return json::parse(read_file(fs::path(at(out)) / "result.json"));
  }
  static TemporaryFolder* folder_;
  static Outcome* methods_;
};
TemporaryFolder* CalibrateFlags::folder_ = nullptr;
Outcome* CalibrateFlags::methods_ = nullptr;

TEST_F(CalibrateFlags, MethodsIsATableBeforeTheSummaryAndAKeyOfTheResult) {
  ASSERT_EQ(methods_->status, 0) << methods_->err;
  const auto lines = lines_of(methods_->out);
  ASSERT_EQ(lines.size(), kSteps.size() + 2);
  EXPECT_THAT(lines[0], HasSubstr("heldout [mm]"));
  EXPECT_THAT(lines.back(), HasSubstr("3 of 3 scenes"));
  const json j = result("methods");
  ASSERT_EQ(j["ablation"].size(), kSteps.size());
  for (std::size_t k = 0; k < kSteps.size(); ++k) {
    const json& step = j["ablation"][k];
    EXPECT_THAT(lines[k + 1], StartsWith(kSteps[k] + " "));
    EXPECT_EQ(step["name"], kSteps[k]);
    EXPECT_FALSE(step["change"].get<std::string>().empty());
    for (const char* key :
         {"rms_px", "rms_mm", "heldout_px", "heldout_mm", "translation_mm", "rotation_mrad"})
      EXPECT_TRUE(step[key].is_number()) << key;
  }
  EXPECT_EQ(j["ablation"].back()["T_camera_lidar"], j["T_camera_lidar"]["matrix"]);
}

// The frames as the user calls them, in the result and in what is exported from it.
TEST_F(CalibrateFlags, FramesAreCalledAsTheUserCallsThem) {
  const Outcome named = calibrate(
      "named", {"--lidar-frame", "velodyne", "--camera-frame", "cam0/optical", "--quiet"});
  ASSERT_EQ(named.status, 0) << named.err;
  EXPECT_EQ(result("named")["frames"], (json{{"lidar", "velodyne"}, {"camera", "cam0/optical"}}));
  const std::string file = fs::path(at("named")) / "result.json";
  const Outcome urdf = run_lvcalib({"export", file, "--format", "urdf", "-o", at("rig.urdf")});
  ASSERT_EQ(urdf.status, 0) << urdf.err;
  EXPECT_THAT(read_file(at("rig.urdf")), HasSubstr("<parent link=\"velodyne\"/>"));
  EXPECT_EQ(run_lvcalib({"report", at("named"), "-o", at("named.html")}).status, 0);
  EXPECT_THAT(read_file(at("named.html")), HasSubstr("<code>cam0/optical</code>"));
  const Outcome bad = calibrate("bad", {"--lidar-frame", "a b", "--quiet"});
  EXPECT_EQ(bad.status, 2);
  EXPECT_THAT(bad.err, HasSubstr("'a b' is no name of a frame"));
  EXPECT_FALSE(fs::exists(at("bad")));
}

TEST_F(CalibrateFlags, EvaluateTellsEveryStepsDistanceToTheTruth) {
  const fs::path file = fs::path(at("methods")) / "result.json";
  const std::string truth = good_dataset().string() + "-truth.json";
  const Outcome outcome = run_lvcalib({"evaluate", file, "--truth", truth});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const auto lines = lines_of(outcome.out);
  ASSERT_EQ(lines.size(), kSteps.size() + 2);
  for (std::size_t k = 0; k < kSteps.size(); ++k)
    EXPECT_THAT(lines[k + 1], StartsWith(kSteps[k] + " "));
  EXPECT_THAT(lines.back(), StartsWith("translation "));
  // The last step is the result.
  const auto words = [](const std::string& line) {
    std::istringstream stream(line);
    return std::vector<std::string>(std::istream_iterator<std::string>(stream), {});
  };
  EXPECT_EQ(words(lines[kSteps.size()])[3], words(lines.back())[1]);
  // A step without its pose is named.
  json j = result("methods");
  j["ablation"][2].erase("T_camera_lidar");
  write_file(at("spoilt.json"), j.dump());
  const Outcome spoilt = run_lvcalib({"evaluate", at("spoilt.json"), "--truth", truth});
  EXPECT_EQ(spoilt.status, 3);
  EXPECT_THAT(spoilt.err, HasSubstr("ablation[2]"));
}

TEST_F(CalibrateFlags, TheReportShowsTheTable) {
  ASSERT_EQ(run_lvcalib({"report", at("methods"), "-o", at("report.html")}).status, 0);
  EXPECT_THAT(read_file(at("report.html")), HasSubstr("one change at a time"));
}

TEST_F(CalibrateFlags, WithoutIntensityPlanesAndCornersHaveToDo) {
  const Outcome outcome = calibrate("plain", {"--no-intensity", "--quiet"});
  ASSERT_TRUE(outcome.status == 0 || outcome.status == 1) << outcome.err;
  const json j = result("plain");
  EXPECT_EQ(j["print"]["used"], false);
  EXPECT_THAT(j["warnings"].dump(), HasSubstr("intensity is left out, as you decided"));
  EXPECT_FALSE(j.contains("ablation"));
  // No circles are measured, so the paper's method has nothing to work on.
  for (const json& method : j["methods"]) EXPECT_NE(method["name"], "joint_paper");
  EXPECT_THAT(outcome.err, HasSubstr("intensity is left out, as you decided"));
}

// What three scenes could not test, the one line says with the verdict.
TEST_F(CalibrateFlags, SaysWithTheVerdictThatTheCameraIsNotVerified) {
  const Outcome outcome = calibrate("fixed", {"--quiet"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const json j = result("fixed");
  ASSERT_EQ(j["quality"], "good");
  EXPECT_THAT(outcome.out,
              StartsWith(j["verified"] == true ? "good: 3 of 3" : "good, camera not verified: 3"));
}

// Neither escape sequences nor bells, in one byte or as UTF-8, and no second line.
TEST_F(CalibrateFlags, ControlCharactersOfNamesStayFromTheTerminal) {
  for (const std::string name : {"no\x1b[31msuch", "no\asuch", "no\xc2\x9bsuch", "no\nsuch"}) {
    const Outcome outcome = run_lvcalib({"calibrate", at(name), "-o", at("nowhere")});
    EXPECT_EQ(outcome.status, 3);
    EXPECT_THAT(outcome.err, HasSubstr("such"));
    EXPECT_EQ(outcome.err.find_first_of("\x1b\a\x9b"), std::string::npos) << outcome.err;
    EXPECT_EQ(lines_of(outcome.err).size(), 1U) << outcome.err;
  }
}

TEST_F(CalibrateFlags, DiscoverTakesTheOneAndNotTheOther) {
  const Outcome help = run_lvcalib({"discover", "--help"});
  EXPECT_THAT(help.out, HasSubstr("--no-intensity"));
  const Outcome outcome =
      run_lvcalib({"discover", good_dataset(), "-o", at("discovered"), "--methods"});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_FALSE(fs::exists(at("discovered")));
}

}  // namespace
}  // namespace lvcalib::testing
