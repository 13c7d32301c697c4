// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/method_comparison.h"

#include <map>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/statistics.h"
#include "support/pose_matchers.h"
#include "support/synthetic_observations.h"

namespace lvcalib {
namespace {

using ::testing::ElementsAre;

class Methods : public ::testing::Test {
 protected:
  // Scenes whose raw nodes are off as one board: by some millimetres, as a coarse pose leaves them.
  [[nodiscard]] std::vector<SceneObservations> scenes(int count, std::uint64_t seed) const {
    auto out = test::observed_scenes(count, target_, camera_, truth_, noise_, seed);
    Random random(seed, 5);
    for (SceneObservations& scene : out) {
      const Eigen::Vector2d shift = test::random_2d(random, raw_error_m_);
      for (RefinedNode& node : scene.nodes) {
        node.raw_lidar_m = scene.plane.to_lidar(node.center_uv_m + shift);
      }
    }
    return out;
  }
  [[nodiscard]] std::map<std::string, MethodResult> compare(
      const std::vector<SceneObservations>& observations, bool held_out = true) const {
    const auto joint = solve_extrinsic({observations, camera_, target_, {}});
    if (!joint) {
      ADD_FAILURE() << joint.error().text();
      return {};
    }
    std::map<std::string, MethodResult> out;
    for (MethodResult& m :
         compare_methods({observations, camera_, target_, {}}, *joint, {held_out}))
      out[m.name] = std::move(m);
    return out;
  }

  Target target_;
  Camera camera_ = test::test_camera();
  Rigid3 truth_ = test::test_extrinsic();
  test::ObservationNoise noise_;
  double raw_error_m_ = 0.003;
};

TEST_F(Methods, AllFindTheTruthFromNoiseFreeObservations) {
  noise_ = {0.0, 0.0, 0.0, 0.0};
  raw_error_m_ = 0.0;
  const auto methods = compare(scenes(3, 1));
  ASSERT_EQ(methods.size(), 8U);
  for (const auto& [name, m] : methods) {
    EXPECT_THAT(m.camera_from_lidar, test::IsNearPose(truth_, 1e-3, 1e-3)) << name;
    EXPECT_LT(m.rms_px, 1e-3) << name;
    EXPECT_LT(m.rms_mm, 1e-2) << name;
    ASSERT_TRUE(m.heldout_px && m.heldout_mm) << name;
    EXPECT_LT(*m.heldout_mm, 1e-2) << name;
  }
}

TEST_F(Methods, JointRefinedIsTheSolveItself) {
  const auto observations = scenes(3, 2);
  const auto joint = solve_extrinsic({observations, camera_, target_, {}});
  ASSERT_TRUE(joint.ok());
  const auto methods = compare(observations);
  const MethodResult& m = methods.at("joint_refined");
  EXPECT_EQ(m.translation_mm, 0.0);
  EXPECT_EQ(m.rotation_mrad, 0.0);
  EXPECT_NEAR(m.rms_px, joint->rms_px, 1e-4 * joint->rms_px);
  EXPECT_NEAR(m.rms_mm, joint->rms_mm, 1e-3 * joint->rms_mm);
  ASSERT_EQ(m.scenes.size(), 3U);
  EXPECT_EQ(m.scenes[1].name, "B");
  EXPECT_NEAR(m.scenes[1].rms_mm, joint->scenes[1].rms_mm, 1e-3 * joint->rms_mm);
  EXPECT_EQ(m.scenes[1].errors_mm.size(), 9U);
  EXPECT_EQ(m.scenes[1].errors_px.size(), 64U);
}

// Judged by the truth, which no method knows: over many draws the joint objective errs least, and
// refined centres serve every method better than raw ones.
TEST_F(Methods, JointAndRefinedAreNearestTheTruth) {
  std::map<std::string, std::vector<double>> error;
  noise_.corner_px = 0.3;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    for (const auto& [name, m] : compare(scenes(3, seed), false))
      error[name].push_back(
          1e3 * translation_distance_m(m.camera_from_lidar.inverse(), truth_.inverse()));
  }
  for (const char* objective : {"svd", "wsvd", "pnp", "joint"}) {
    EXPECT_LT(rms(error[std::string(objective) + "_refined"]),
              rms(error[std::string(objective) + "_raw"]))
        << objective;
    EXPECT_LE(rms(error["joint_refined"]), rms(error[std::string(objective) + "_refined"]))
        << objective;
  }
}

// A scene held out tells more than one that was fitted to.
TEST_F(Methods, HeldOutErrorsExceedFittedOnes) {
  double fitted = 0.0;
  double held = 0.0;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const auto methods = compare(scenes(4, 20 + seed));
    fitted += methods.at("joint_refined").rms_mm;
    held += *methods.at("joint_refined").heldout_mm;
  }
  EXPECT_GT(held, fitted);
}

TEST_F(Methods, OneSceneHasNothingToHoldOut) {
  const auto methods = compare(scenes(1, 3));
  for (const auto& [name, m] : methods) {
    EXPECT_FALSE(m.heldout_px || m.heldout_mm) << name;
    EXPECT_FALSE(m.scenes[0].heldout_px) << name;
  }
}

TEST_F(Methods, ScenesOutOfUseTakeNoPart) {
  auto observations = scenes(4, 4);
  observations[1].use = false;
  for (RefinedNode& node : observations[1].nodes) node.center_lidar_m.x() += 0.5;
  for (const auto& [name, m] : compare(observations)) {
    ASSERT_EQ(m.scenes.size(), 3U) << name;
    EXPECT_EQ(m.scenes[1].name, "C") << name;
    EXPECT_LT(m.translation_mm, 50.0) << name;
  }
}

TEST_F(Methods, BoardsWithoutCirclesHaveTheJointSolveOnly) {
  target_.type = TargetType::kAprilGrid;
  auto observations = test::observed_scenes(5, target_, camera_, truth_, noise_, 5);
  const auto methods = compare(observations);
  ASSERT_EQ(methods.size(), 1U);
  EXPECT_TRUE(methods.contains("joint_refined"));
  EXPECT_LT(methods.at("joint_refined").rms_mm, 1.0);
}

class PaperMethod : public Methods {
 protected:
  [[nodiscard]] std::vector<MethodResult> compare_with_paper(
      const std::vector<SceneObservations>& observations,
      const std::vector<SceneObservations>& paper, int threads = 1) const {
    const auto joint = solve_extrinsic({observations, camera_, target_, {}});
    if (!joint) {
      ADD_FAILURE() << joint.error().text();
      return {};
    }
    MethodOptions options;
    options.paper = JointVariant{"joint_paper", paper, paper_objective({})};
    options.threads = threads;
    return compare_methods({observations, camera_, target_, {}}, *joint, options);
  }
};

TEST_F(PaperMethod, StandsBehindTheOthersAndFindsTheTruthWithoutNoise) {
  noise_ = {0.0, 0.0, 0.0, 0.0};
  const auto observations = scenes(3, 7);
  const auto methods = compare_with_paper(observations, observations);
  ASSERT_EQ(methods.size(), 9U);
  const MethodResult& paper = methods.back();
  EXPECT_EQ(paper.name, "joint_paper");
  EXPECT_THAT(paper.camera_from_lidar, test::IsNearPose(truth_, 1e-3, 1e-3));
  ASSERT_TRUE(paper.heldout_mm);
  EXPECT_LT(*paper.heldout_mm, 1e-2);
}

TEST_F(PaperMethod, ThreadsChangeNeitherOrderNorDigits) {
  const auto observations = scenes(4, 9);
  const auto one = compare_with_paper(observations, observations);
  const auto several = compare_with_paper(observations, observations, 3);
  ASSERT_EQ(one.size(), several.size());
  for (std::size_t k = 0; k < one.size(); ++k) {
    EXPECT_EQ(one[k].name, several[k].name);
    EXPECT_EQ(one[k].camera_from_lidar.translation, several[k].camera_from_lidar.translation);
    EXPECT_EQ(one[k].heldout_px, several[k].heldout_px);
    EXPECT_EQ(one[k].heldout_mm, several[k].heldout_mm);
  }
}

// Nothing is left out and squares count: one bad centre moves the paper's extrinsic, not ours.
TEST_F(PaperMethod, KeepsWhatContradicts) {
  const auto clean = scenes(3, 8);
  auto spoilt = clean;
  spoilt[0].nodes[0].center_lidar_m += 0.05 * spoilt[0].plane.axis_u;
  spoilt[0].nodes[0].center_uv_m.x() += 0.05;
  const auto moved = [&](std::size_t k) {
    return translation_distance_m(compare_with_paper(clean, clean)[k].camera_from_lidar,
                                  compare_with_paper(spoilt, spoilt)[k].camera_from_lidar);
  };
  EXPECT_LT(moved(7), 0.001);
  EXPECT_GT(moved(8), 0.002);
}

TEST_F(PaperMethod, IsNotListedWithoutThreeNodesOrWithoutCircles) {
  const auto observations = scenes(3, 9);
  auto without = observations;
  for (SceneObservations& scene : without) scene.nodes.clear();
  EXPECT_EQ(compare_with_paper(observations, without).size(), 8U);
  target_.type = TargetType::kAprilGrid;
  const auto plain = test::observed_scenes(5, target_, camera_, truth_, noise_, 5);
  EXPECT_EQ(compare_with_paper(plain, plain).size(), 1U);
}

// How long that takes is told by calibration_benchmark.
TEST_F(Methods, EveryOneOfTenScenesIsLeftOutOnce) {
  const auto observations = scenes(10, 6);
  const auto joint = solve_extrinsic({observations, camera_, target_, {}});
  ASSERT_TRUE(joint.ok());
  ASSERT_EQ(joint->leave_one_out.size(), 10U);
  for (std::size_t s = 0; s < observations.size(); ++s)
    EXPECT_EQ(joint->leave_one_out[s].without, observations[s].name);
}

}  // namespace
}  // namespace lvcalib
