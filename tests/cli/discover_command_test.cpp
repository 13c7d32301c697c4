// SPDX-License-Identifier: GPL-3.0-or-later
// discover on what it cannot work with: every case gets a verdict or a message in words.
#include <algorithm>
#include <cmath>
#include <functional>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "cli/child_process.h"
#include "cli/good_dataset.h"
#include "cloud/cloud.h"

namespace lvcalib::testing {
namespace {
namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;

class DiscoverCommand : public ::testing::Test {
 protected:
  [[nodiscard]] fs::path out() const { return folder_.path() / "out"; }
  [[nodiscard]] Outcome discover(const fs::path& dataset,
                                 const std::vector<std::string>& more = {}) const {
    std::vector<std::string> arguments = {"discover", dataset,         "-o", out(),
                                          "--quiet",  "--max-effects", "2"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_lvcalib(arguments);
  }
  [[nodiscard]] Outcome discover_simulated(const char* seed, const char* scenes, const char* points,
                                           const char* effect) const {
    const fs::path dataset = folder_.path() / "simulated";
    const Outcome made = run_lvcalib({"simulate", "-o", dataset, "--quiet", "--seed", seed,
                                      "--scenes", scenes, "--points", points, "--effect", effect});
    EXPECT_EQ(made.status, 0) << made.err;
    return discover(dataset);
  }
  [[nodiscard]] nlohmann::json json(const char* name) const {
    return nlohmann::json::parse(read_file(out() / name));
  }
  static nlohmann::json effect(const nlohmann::json& discovery, const std::string& id) {
    for (const auto& e : discovery["effects"]) {
      if (e["id"] == id) return e;
    }
    ADD_FAILURE() << id << " is not listed";
    return {};
  }
  // A copy of the good dataset with changed clouds.
  [[nodiscard]] fs::path with_clouds(const std::function<void(Cloud&)>& change) const {
    const fs::path copy = folder_.path() / "changed";
    copy_dataset(good_dataset(), copy);
    for (const std::string& name : scene_names(copy)) {
      const fs::path path = copy / "scenes" / name / "cloud.pcd";
      auto read = read_cloud(path);
      EXPECT_TRUE(read.ok());
      change(*read);
      fs::remove(path);
      EXPECT_TRUE(write_pcd(path, *read).ok());
    }
    return copy;
  }
  TemporaryFolder folder_{"discover"};
};

TEST_F(DiscoverCommand, SlipsOfThePenAreSaidBeforeLongWork) {
  const fs::path none = "/nowhere";  // not even looked at
  const Outcome formula = discover(none, {"--with", "formula:range:a*sin("});
  EXPECT_EQ(formula.status, 2);
  EXPECT_THAT(formula.err, HasSubstr("character"));
  const Outcome covariate = discover(none, {"--with", "curve:range:azimut"});
  EXPECT_EQ(covariate.status, 2);
  EXPECT_THAT(covariate.err, HasSubstr("did you mean 'azimuth'?"));
  EXPECT_FALSE(fs::exists(out()));
}

TEST_F(DiscoverCommand, OneSceneAndTwoAreTooFewButCalibrated) {
  const Outcome two = discover(good_dataset(), {"--reject", "C"});
  EXPECT_EQ(two.status, 1);
  EXPECT_THAT(two.err, HasSubstr("2 scenes, three or more are needed"));
  EXPECT_TRUE(fs::exists(out() / "result.json"));
  EXPECT_FALSE(fs::exists(out() / "discovery.json"));
  const Outcome one = discover(good_dataset(), {"--reject", "C", "--reject", "B"});
  EXPECT_EQ(one.status, 1);
  EXPECT_THAT(one.err, HasSubstr("1 scene, three or more are needed"));
}

TEST_F(DiscoverCommand, ThresholdsAreOptions) {
  const auto structure_with = [&](const std::vector<std::string>& more) {
    const Outcome outcome = discover(good_dataset(), more);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return json("discovery.json")["structure"].size();
  };
  const std::size_t usual = structure_with({});
  const fs::path config = folder_.path() / "options.yaml";
  write_file(config, "discovery:\n  min_structure: 0\n");
  EXPECT_GT(structure_with({"--config", config}), usual + 5);
}

TEST_F(DiscoverCommand, TheUsersToleranceDecidesWhatMatters) {
  for (const char* wrong : {"2", "a,b", "-1,1", "0,0", "1,", "nan,1", "2000,1"}) {
    const Outcome outcome = discover(good_dataset(), {"--tolerance", wrong});
    EXPECT_EQ(outcome.status, 2) << wrong;
    EXPECT_THAT(outcome.err, HasSubstr("--tolerance")) << wrong;
  }
  EXPECT_FALSE(fs::exists(out()));
  const auto count = [&](const char* tolerance) {
    const Outcome outcome = discover(good_dataset(), {"--tolerance", tolerance});
    EXPECT_LE(outcome.status, 1) << outcome.err;
    std::pair<int, int> out{0, 0};  // Absent; that matter.
    const auto discovery = json("discovery.json");
    for (const auto& e : discovery["effects"]) {
      out.first += e["verdict"] == "absent" ? 1 : 0;
      out.second += e["matters"].get<bool>() ? 1 : 0;
      for (const auto& c : e["criteria"]) {
        const double value = c["value"].get<double>();
        const double threshold = c["threshold"].get<double>();
        EXPECT_EQ(c["holds"].get<bool>(),
                  c["at_most"].get<bool>() ? value <= threshold : value >= threshold);
      }
    }
    return out;
  };
  const auto wide = count("900,900");
  const auto narrow = count("0.001,0.001");
  EXPECT_EQ(wide.second, 0);
  EXPECT_GT(wide.first, 0);
  EXPECT_GT(narrow.second, 10);
  EXPECT_LT(narrow.first, wide.first);
}

// Dark print reads 10 mm too far, and circles and planes of one scene contradict the others for it;
// by every return all of them miss alike.
TEST_F(DiscoverCommand, NoSceneIsRefusedForAMissingEffect) {
  const Outcome outcome = discover_simulated("2", "4", "240000", "range_walk=10");
  EXPECT_THAT(outcome.err, Not(HasSubstr("is not used")));
  EXPECT_THAT(outcome.out, HasSubstr("doubtful -> good"));
  const auto result = json("result.json");
  for (const auto& scene : result["scenes"]) EXPECT_TRUE(scene["used"].get<bool>());
}

// The nearest board saturates the receiver, whose ranges there contradict the other scenes: these
// agree with each other and miss nothing.
TEST_F(DiscoverCommand, ASceneRefusedForAMissingEffectIsUsedWithIt) {
  const Outcome outcome = discover_simulated("6", "5", "120000", "receiver_saturation=10");
  EXPECT_THAT(outcome.err, HasSubstr("scene E is not used: contradicts the other scenes"));
  EXPECT_THAT(outcome.err,
              HasSubstr("scene E contradicts the others only without receiver_saturation"));
  EXPECT_THAT(outcome.out, HasSubstr("missing: receiver_saturation; doubtful -> good"));
  EXPECT_EQ(effect(json("discovery.json"), "receiver_saturation")["verdict"], "present");
  const auto result = json("result.json");
  for (const auto& scene : result["scenes"]) EXPECT_TRUE(scene["used"].get<bool>());
  EXPECT_THAT(result["warnings"].dump(), Not(HasSubstr("as you decided")));
}

// An image that is another scene's contradicts for good; the user has the last word.
TEST_F(DiscoverCommand, UsesAContradictingSceneIfTheUserInsists) {
  const fs::path dataset = folder_.path() / "exchanged";
  fs::copy(good_dataset(), dataset, fs::copy_options::recursive);
  fs::copy_file(dataset / "scenes/B/image.png", dataset / "scenes/A/image.png",
                fs::copy_options::overwrite_existing);
  const auto used = [&] { return json("result.json")["scenes"][0]["used"].get<bool>(); };
  const Outcome refused = discover(dataset);
  EXPECT_THAT(refused.err, HasSubstr("scene A is not used"));
  EXPECT_FALSE(used());
  const Outcome insisted = discover(dataset, {"--insist", "A"});
  EXPECT_THAT(insisted.err, HasSubstr("scene A is used all the same"));
  EXPECT_TRUE(used());
}

TEST_F(DiscoverCommand, GoesOnWithoutWhatTheDataCannotBear) {
  const Outcome outcome = discover(
      good_dataset(), {"--with", "formula:range:a/(board_x-board_x)", "--with", "range_walk",
                       "--with", "range_walk", "--with", "curve:range:azimuth"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("not a finite number"));
  EXPECT_THAT(outcome.err, HasSubstr("asked for twice"));
  EXPECT_THAT(outcome.out, HasSubstr("with what effects left out could do"));
  const auto discovery = json("discovery.json");
  EXPECT_EQ(effect(discovery, "formula:range:a/(board_x-board_x)")["verdict"], "not_testable");
  const auto curve = effect(discovery, "curve:range:azimuth");
  EXPECT_EQ(curve["curve"]["points"].size(), 33U);
  EXPECT_THAT(curve["spec"].get<std::string>(), HasSubstr("curve:range:azimuth["));
  EXPECT_EQ(discovery["warnings"].size(), 2U);
  ASSERT_FALSE(discovery["sensitivity_budget"].empty());
  const auto result = json("result.json");
  EXPECT_EQ(result["sensitivity_budget"], discovery["sensitivity_budget"]);
  for (std::size_t k = 0; k < 6; ++k) {
    EXPECT_GE(result["covariance_with_budget"][k][k].get<double>(),
              result["covariance"][k][k].get<double>());
  }
  EXPECT_EQ(result["model"]["effects"][1]["id"], "curve:range:azimuth");
  EXPECT_EQ(result["model"]["effects"][1]["spec"], curve["spec"]);
}

// What black print adds to its ranges leaves the nodes as it leaves the ranges, and every file says
// which clouds the pose is for.
TEST_F(DiscoverCommand, ResidualsAndWordsAreOfTheModelInForce) {
  const fs::path walked = with_clouds([](Cloud& cloud) {
    constexpr float kWhite = 125.0F;
    constexpr float kBlack = 11.0F;
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      const float dark = std::log(kWhite / std::max(cloud.intensity[i], 1.0F));
      const float share = std::clamp(dark / std::log(kWhite / kBlack), 0.0F, 1.1F);
      cloud.points_m[i] += 0.02F * share * cloud.points_m[i].normalized();
    }
  });
  const Outcome before = run_lvcalib({"calibrate", walked, "-o", out(), "--quiet"});
  ASSERT_EQ(before.status, 0) << before.err;
  const auto base = json("result.json");
  EXPECT_EQ(base["applies_to"], "raw");
  EXPECT_THAT(read_file(out() / "result.yaml"), HasSubstr("clouds as the LiDAR gives them.\n"));
  const Outcome after = discover(walked, {"--with", "range_walk"});
  ASSERT_EQ(after.status, 0) << after.err;
  EXPECT_THAT(after.out, HasSubstr("corrected clouds"));
  const auto mended = json("result.json");
  EXPECT_EQ(mended["applies_to"], "corrected");
  // What the user put in is not what the tool found.
  EXPECT_THAT(json("discovery.json")["selected"],
              ::testing::Not(::testing::Contains("range_walk")));
  EXPECT_LT(mended["rms_mm"].get<double>(), 0.5 * base["rms_mm"].get<double>());
  for (const auto& scene : mended["scenes"]) {
    double height_mm = 0.0;
    for (const auto& node : scene["nodes"]) height_mm += node["residual_mm"][2].get<double>();
    EXPECT_LT(std::abs(height_mm / static_cast<double>(scene["nodes"].size())), 0.5);
  }
  EXPECT_THAT(read_file(out() / "result.yaml"), HasSubstr("model: \"Base model + Range walk\""));
  const Outcome exported = run_lvcalib(
      {"export", out() / "result.json", "--format", "urdf", "-o", folder_.path() / "rig.urdf"});
  ASSERT_EQ(exported.status, 0) << exported.err;
  EXPECT_THAT(read_file(folder_.path() / "rig.urdf"), HasSubstr("taken out: Range walk"));
  // What is of clouds is of corrected ones.
  for (const char* format : {"boundary-response", "colored-ply"}) {
    const Outcome other = run_lvcalib(
        {"export", out() / "result.json", "--format", format, "-o", folder_.path() / "other"});
    ASSERT_EQ(other.status, 0) << other.err;
    EXPECT_THAT(read_file(folder_.path() / "other"), HasSubstr("model: Base model + Range walk"));
  }
  EXPECT_THAT(read_file(folder_.path() / "other"),
              HasSubstr("comment the model's effects are taken out of the points"));
  const auto range_mm = [](const nlohmann::json& result) {
    return result["boundary_response"]["all"]["mean_range_mm"].get<double>();
  };
  EXPECT_GT(range_mm(base), 2.0);
  EXPECT_LT(std::abs(range_mm(mended)), 0.5 * range_mm(base));
  const Outcome reported =
      run_lvcalib({"report", out() / "result.json", "-o", folder_.path() / "report.html"});
  ASSERT_EQ(reported.status, 0) << reported.err;
  EXPECT_THAT(read_file(folder_.path() / "report.html"), HasSubstr("taken out: Range walk"));
}

// One predicate for the sentence, the files and the verdict.
TEST_F(DiscoverCommand, WhatIsMissingAndNotAddedIsSaid) {
  const fs::path walked = with_clouds([](Cloud& cloud) {
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      if (cloud.intensity[i] < 60.0F) cloud.points_m[i] += 0.02F * cloud.points_m[i].normalized();
    }
  });
  const Outcome outcome =
      run_lvcalib({"discover", walked, "-o", out(), "--quiet", "--max-effects", "0"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const auto discovery = json("discovery.json");
  EXPECT_TRUE(discovery["selected"].empty());
  const std::string first = discovery["effects"][0]["id"];
  for (const auto& c : discovery["effects"][0]["criteria"]) {
    EXPECT_TRUE(c["holds"].get<bool>()) << c["name"];
    EXPECT_FALSE(c["reason"].get<std::string>().empty()) << c["name"];
  }
  EXPECT_THAT(outcome.out, HasSubstr("missing: " + first + " (not added); doubtful"));
  EXPECT_THAT(read_file(out() / "discovery.txt"), HasSubstr("Missing, and not added: " + first));
  const auto result = json("result.json");
  EXPECT_EQ(result["quality"], "doubtful");
  EXPECT_THAT(result["quality_reasons"].dump(), HasSubstr("the model lacks: " + first));
  // Without effects every number is the calibration's.
  EXPECT_EQ(discovery["covariance"], result["covariance"]);
}

// Dark print reads far in one scene alone, which no effect of all scenes is: what the calibration
// says is missing is not denied by the search.
TEST_F(DiscoverCommand, NothingIsMissingIsNotSaidBesideADoubtThatSomethingIs) {
  int seen = 0;
  const fs::path walked = with_clouds([&](Cloud& cloud) {
    if (seen++ != 1) return;
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      if (cloud.intensity[i] < 60.0F) cloud.points_m[i] += 0.012F * cloud.points_m[i].normalized();
    }
  });
  const Outcome outcome = discover(walked);
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("an effect is missing in the model"));
  EXPECT_THAT(outcome.out, HasSubstr("no effect is found to be missing; doubtful"));
  EXPECT_THAT(read_file(out() / "discovery.txt"), Not(HasSubstr("Nothing is missing")));
}

TEST_F(DiscoverCommand, ACloudMayLackTheLineThatTheOthersHave) {
  int seen = 0;
  const fs::path dataset = with_clouds([&](Cloud& cloud) {
    if (seen++ == 0) cloud.line.clear();
  });
  const Outcome outcome = discover(dataset);
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(json("result.json")["quality"], "good");
}

TEST_F(DiscoverCommand, MissingFieldsAreNotTestable) {
  const fs::path dataset = with_clouds([](Cloud& cloud) {
    cloud.time_s.clear();
    cloud.line.clear();
  });
  const Outcome outcome = discover(dataset, {"--with", "scan_motion"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("the time is not in every cloud"));
  const auto discovery = json("discovery.json");
  EXPECT_EQ(effect(discovery, "scan_motion")["verdict"], "not_testable");
  EXPECT_THAT(effect(discovery, "encoder_lag")["explanation"].get<std::string>(),
              HasSubstr("the time is not in every cloud"));
  EXPECT_THAT(effect(discovery, "channel_range_offset")["explanation"].get<std::string>(),
              HasSubstr("the laser line is not in every cloud"));
}

TEST_F(DiscoverCommand, ConstantIntensityLeavesPlanesAndCornersAndSaysSo) {
  const fs::path dataset = with_clouds(
      [](Cloud& cloud) { std::fill(cloud.intensity.begin(), cloud.intensity.end(), 42.0F); });
  const Outcome outcome = discover(dataset);
  // Three scenes of planes: whatever the verdict, it is said what is missing.
  EXPECT_LE(outcome.status, 1) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("intensity is missing or the same everywhere"));
}

TEST_F(DiscoverCommand, TheSameSceneThreeTimesIsOneAndTooFewToSearch) {
  const fs::path copy = folder_.path() / "alike";
  copy_dataset(good_dataset(), copy);
  for (const char* name : {"B", "C"}) {
    for (const char* file : {"image.png", "cloud.pcd"}) {
      fs::remove(copy / "scenes" / name / file);
      fs::copy_file(good_dataset() / "scenes" / "A" / file, copy / "scenes" / name / file);
    }
  }
  const Outcome outcome = discover(copy);
  EXPECT_EQ(outcome.status, 1) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("scene B, C: the same files as scene A"));
  EXPECT_THAT(outcome.err, HasSubstr("not enough scenes"));
  EXPECT_FALSE(fs::exists(out() / "discovery.json"));
}

}  // namespace
}  // namespace lvcalib::testing
