// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/quality.h"

#include <cmath>
#include <functional>
#include <regex>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/simulated_dataset.h"

namespace lvcalib {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

// A result of two flawless scenes.
CalibrationResult flawless() {
  CalibrationResult result;
  for (const char* name : {"A", "B", "C"}) {
    SceneResult scene;
    scene.name = name;
    scene.used = true;
    scene.refinement.emplace();
    scene.refinement->scale_sigma = 0.0005;
    result.scenes.push_back(scene);
  }
  result.extrinsic.used_scenes = 3;
  result.extrinsic.sigma_px = 0.1;
  result.consensus.score = 500.0;
  return result;
}

std::string all_warnings(const CalibrationResult& result) {
  std::string text;
  for (const Message& w : result.warnings) text += w.text() + "\n";
  return text;
}

// The first "x.xx %" or "x %" in a text.
double percentage_in(const std::string& text) {
  std::smatch match;
  if (!std::regex_search(text, match, std::regex("([0-9]+(\\.[0-9]+)?)[^%]*%"))) return -1.0;
  return std::stod(match[1]);
}

// Of three scenes; the others miss by 1 mm.
void let_scene_b_miss(double rms_mm, CalibrationResult& r) {
  r.extrinsic.node_scale = 4.0;
  for (const char* name : {"A", "B", "C"}) {
    SceneSolution s;
    s.name = name;
    s.used = true;
    s.rms_mm = s.name == "B" ? rms_mm : 1.0;
    r.extrinsic.scenes.push_back(s);
  }
}

TEST(JudgeQuality, AFlawlessResultIsGoodAndSilent) {
  CalibrationResult result = flawless();
  judge_quality(result, {});
  EXPECT_EQ(result.quality, Quality::kGood);
  EXPECT_TRUE(result.warnings.empty()) << all_warnings(result);
}

TEST(JudgeQuality, EveryFlawHasItsVerdictAndItsWords) {
  struct Case {
    const char* words;
    Quality quality;
    std::function<void(CalibrationResult&)> spoil;
  };
  const std::vector<Case> cases{
      {"only 5 of 6 directions", Quality::kFailed, [](auto& r) { r.extrinsic.rank = 5; }},
      {"leave the extrinsic open: ± 300 mm", Quality::kFailed,
       [](auto& r) { r.extrinsic.camera_from_lidar.covariance(1, 1) = 0.09; }},
      {"± 80.0 mrad", Quality::kFailed,
       [](auto& r) { r.extrinsic.camera_from_lidar.covariance(4, 4) = 0.0064; }},
      {"weak as weak", Quality::kDoubtful,
       [](auto& r) { r.extrinsic.weak_directions = {Message("weak as weak")}; }},
      {"the joint solve puts the LiDAR 220 mm and 0.0 mrad from where the localized boards put it",
       Quality::kDoubtful,
       [](auto& r) {
         r.consensus.camera_from_lidar.covariance = 1e-4 * Matrix6d::Identity();
         r.extrinsic.camera_from_lidar.transform.translation.y() = 0.22;
       }},
      {"only one usable scene", Quality::kDoubtful, [](auto& r) { r.extrinsic.used_scenes = 1; }},
      {"two scenes", Quality::kDoubtful, [](auto& r) { r.extrinsic.used_scenes = 2; }},
      {"miss their model by 3.00 px", Quality::kDoubtful,
       [](auto& r) { r.extrinsic.sigma_px = 3.0; }},
      {"LiDAR residuals are 2.5 times (nodes) and 1.0 times (planes) their noise",
       Quality::kDoubtful,
       [](auto& r) {
         r.extrinsic.node_scale = 2.5;
         r.extrinsic.scenes.emplace_back();
         r.extrinsic.scenes.back().used = true;
         r.extrinsic.scenes.back().nodes.emplace_back();
       }},
      // A board without circles has no nodes to speak of.
      {"the boards' planes miss the LiDAR's ranges by 5.0 times their noise", Quality::kDoubtful,
       [](auto& r) { r.extrinsic.plane_scale = 5.0; }},
      {"an effect is missing in the model; scene B misses most: 4.0 mm", Quality::kDoubtful,
       [](auto& r) { let_scene_b_miss(4.0, r); }},
      {"scene B misses most: 6.0 mm, the others 1.0 mm: did the board or a sensor move while it "
       "was taken, or is an effect missing in the model?",
       Quality::kDoubtful, [](auto& r) { let_scene_b_miss(6.0, r); }},
      {"scene B: its board measures 4.00 ± 0.06 % larger", Quality::kDoubtful,
       [](auto& r) { r.scenes[1].refinement->scale = 1.04; }},
      {"scene B is not used: elsewhere", Quality::kDoubtful,
       [](auto& r) {
         r.scenes[1].used = false;
         r.scenes[1].reason = Message("elsewhere");
         r.scenes[1].contradicts = true;
       }},
      {"scene B is not used: no tags", Quality::kGood,
       [](auto& r) {
         r.scenes[1].used = false;
         r.scenes[1].reason = Message("no tags");
       }},
      {"(near/far) differ by 9.0 mm and 2.0 mrad, more than noise explains (χ² 90",
       Quality::kDoubtful,
       [](auto& r) {
         SplitHalf split;
         split.name = Message("near/far");
         split.translation_mm = 9.0;
         split.rotation_mrad = 2.0;
         split.expected_translation_mm = 1.0;
         split.chi_square = 90.0;
         split.gate = 22.0;
         r.uncertainty.splits.push_back(split);
       }},
      {"nearly as good (margin 2.0)", Quality::kDoubtful,
       [](auto& r) { r.consensus.runner_up = 498.0; }},
      {"0.50 ± 0.03 % larger", Quality::kGood,
       [](auto& r) {
         for (auto& s : r.scenes) s.refinement->scale = 1.005;
       }},
      {"2.00 ± 0.03 % smaller", Quality::kFailed,
       [](auto& r) {
         for (auto& s : r.scenes) s.refinement->scale = 0.98;
       }},
      {"scene B is not used: too dark", Quality::kGood,
       [](auto& r) {
         r.scenes[1].used = false;
         r.scenes[1].reason = Message("too dark");
       }},
      {"scene C: odd", Quality::kGood,
       [](auto& r) { r.scenes[2].refinement->warnings = {Message("odd")}; }},
  };
  for (const Case& c : cases) {
    CalibrationResult result = flawless();
    c.spoil(result);
    judge_quality(result, {});
    EXPECT_EQ(result.quality, c.quality) << c.words << "\n" << all_warnings(result);
    EXPECT_THAT(all_warnings(result), HasSubstr(c.words));
    // Judged again, nothing is said twice.
    const auto once = result.warnings;
    judge_quality(result, {});
    EXPECT_EQ(result.warnings, once);
  }
}

// What follows from a cause that is named is no second cause, and nobody is sent after it.
TEST(JudgeQuality, OneCauseIsToldOnce) {
  const auto other_camera = [](CalibrationResult& r) {
    r.intrinsics.contradiction.emplace();
    r.intrinsics.contradiction->what = Message("the focal length is wrong");
    r.intrinsics.contradiction->matters = true;
  };
  const auto other_print = [](CalibrationResult& r) {
    r.intrinsics.spacing = Message("tagSpacing: 0.5");
  };
  for (const std::function<void(CalibrationResult&)>& cause :
       std::vector<std::function<void(CalibrationResult&)>>{other_camera, other_print}) {
    CalibrationResult result = flawless();
    cause(result);
    result.extrinsic.node_scale = 4.0;
    result.intrinsics.replicate_px = 0.02;
    result.extrinsic.sigma_px = 0.5;
    judge_quality(result, {});
    EXPECT_EQ(result.quality, Quality::kDoubtful);
    EXPECT_EQ(result.warnings.size(), 1U) << all_warnings(result);
    // Without the cause, they are.
    result.intrinsics.contradiction.reset();
    result.intrinsics.spacing = {};
    judge_quality(result, {});
    EXPECT_THAT(all_warnings(result), HasSubstr("their noise"));
  }
}

TEST(JudgeQuality, ScenesThatAreNotUsedForOneReasonAreNamedTogether) {
  CalibrationResult result = flawless();
  for (const std::size_t k : {0U, 2U}) {
    result.scenes[k].used = false;
    result.scenes[k].reason = Message("no tags");
  }
  result.extrinsic.used_scenes = 2;
  judge_quality(result, {});
  EXPECT_THAT(all_warnings(result), HasSubstr("scenes A, C are not used: no tags"));
  // Where the verdict names them, they are not named again.
  result.extrinsic.used_scenes = 1;
  judge_quality(result, {});
  EXPECT_THAT(all_warnings(result), HasSubstr("take two or more; scene A, C: no tags"));
  EXPECT_THAT(all_warnings(result), ::testing::Not(HasSubstr("not used")));
}

TEST(JudgeQuality, KeepsWarningsOfOthersAndTheUsersChoicesToItself) {
  CalibrationResult result = flawless();
  result.warnings = {Message("camera.yaml: unknown key")};
  result.scenes[1].used = false;
  reject(result.scenes[1]);
  judge_quality(result, {});
  EXPECT_EQ(result.warnings, std::vector<Message>{Message("camera.yaml: unknown key")});
}

TEST(JudgeQuality, AScaleWithinItsUncertaintyIsNoDifference) {
  CalibrationResult result = flawless();
  for (SceneResult& scene : result.scenes) {
    scene.refinement->scale = 1.02;
    scene.refinement->scale_sigma = 0.02;
  }
  judge_quality(result, {});
  EXPECT_EQ(result.quality, Quality::kGood) << all_warnings(result);
}

// A print of another size, and what it makes of the angles, the beams' origin and the camera.
CalibrationResult with_print_of(double wide, double high) {
  CalibrationResult result = flawless();
  ForwardSolution& forward = result.forward.emplace();
  forward.converged = true;
  forward.uses_intensity = true;
  forward.lattice_margin = 1000.0;
  forward.print_size = {true, {wide, high}, {0.0002, 0.0002}};
  for (const auto kind : {ScanFault::Kind::kAngles, ScanFault::Kind::kOrigin}) {
    ScanFault& fault = forward.scan_faults.emplace_back();
    fault.kind = kind;
    fault.chi_square = 100.0;
    fault.gate = 20.0;
    fault.move(0) = 0.01;
  }
  IntrinsicsContradiction& camera = result.intrinsics.contradiction.emplace();
  camera.by_ranges = true;
  camera.what = Message("focal length off");
  return result;
}

TEST(JudgeQuality, APrintOfAnotherSizeIsToldAlone) {
  CalibrationResult scaled = with_print_of(1.005, 1.005);
  judge_quality(scaled, {});
  EXPECT_EQ(scaled.quality, Quality::kDoubtful);
  ASSERT_EQ(scaled.quality_reasons.size(), 1U) << all_warnings(scaled);
  EXPECT_THAT(scaled.quality_reasons[0].text(), HasSubstr("the print 0.50 ± 0.01 % larger"));
  // Wider but not higher: angles may be why.
  CalibrationResult wider = with_print_of(1.005, 1.0);
  judge_quality(wider, {});
  EXPECT_THAT(all_warnings(wider), AllOf(HasSubstr("LiDAR's angles"), HasSubstr("beams start"),
                                         HasSubstr("focal length off")));
}

TEST(JudgeQuality, TellsWhatAnImageLeavesOut) {
  CalibrationResult result = flawless();
  result.scenes[1].view.emplace().warnings.push_back(Message("tags were dropped"));
  judge_quality(result, {});
  EXPECT_EQ(result.quality, Quality::kGood);
  EXPECT_THAT(all_warnings(result), HasSubstr("scene B: tags were dropped"));
}

TEST(MeasuredScaleTest, IsTheWeightedMeanOfTheUsedScenes) {
  CalibrationResult result = flawless();
  result.scenes[0].refinement->scale = 1.01;
  result.scenes[0].refinement->scale_sigma = 0.001;
  result.scenes[1].refinement->scale = 1.04;
  result.scenes[1].refinement->scale_sigma = 0.002;
  result.scenes[2].refinement->scale = 3.0;
  result.scenes[2].used = false;
  const MeasuredScale scale = measured_scale(result);
  EXPECT_NEAR(scale.scale, (4 * 1.01 + 1.04) / 5, 1e-12);
  EXPECT_NEAR(scale.sigma, 1.0 / std::sqrt(1.25e6), 1e-9);
  EXPECT_EQ(measured_scale({}).sigma, 0.0);
}

TEST(SizeMismatch, OfAPerCentAndAHalfFailsAndNamesIt) {
  const test::SimulatedDataset data(test::dataset_options(21, 2));
  data.scale_target(1.0 / 1.015);
  const auto result = calibrate(data.open(), {}, {});
  ASSERT_TRUE(result.ok()) << result.error().text();
  EXPECT_EQ(result->quality, Quality::kFailed);
  std::string text;
  for (const Message& w : result->warnings) {
    if (w.text().find("board's size") != std::string::npos) text = w.text();
  }
  EXPECT_THAT(text, HasSubstr("larger"));
  EXPECT_NEAR(percentage_in(text), 1.5, 0.5) << text;
}

TEST(SizeMismatch, OfEightPerCentIsNamedToo) {
  const test::SimulatedDataset data(test::dataset_options(22, 1));
  data.scale_target(1.0 / 1.08);
  const auto result = calibrate(data.open(), {}, {});
  ASSERT_FALSE(result.ok());
  EXPECT_EQ(result.error().kind, ErrorKind::kUntrusted);
  std::string text = result.error().text();
  const auto at = text.find("board's size");
  ASSERT_NE(at, std::string::npos) << text;
  text = text.substr(at);
  EXPECT_THAT(text, HasSubstr("larger"));
  EXPECT_NEAR(percentage_in(text), 8.0, 0.5) << text;
}

}  // namespace
}  // namespace lvcalib
