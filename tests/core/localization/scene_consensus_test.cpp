// SPDX-License-Identifier: GPL-3.0-or-later
#include "localization/scene_consensus.h"

#include <numbers>

#include <gtest/gtest.h>

#include "support/pose_matchers.h"
#include "support/synthetic_observations.h"

namespace lvcalib {
namespace {

Matrix6d covariance(double translation_m, double rotation_rad) {
  Matrix6d c = Matrix6d::Zero();
  c.diagonal().head<3>().setConstant(translation_m * translation_m);
  c.diagonal().tail<3>().setConstant(rotation_rad * rotation_rad);
  return c;
}

class SceneConsensusTest : public ::testing::Test {
 protected:
  // A candidate with the board's true place and one of its four turns about its middle.
  [[nodiscard]] BoardCandidate candidate(const Rigid3& lidar_from_board, int quarter, double gain) {
    const Eigen::Vector2d c = target_.outline().center_m();
    const Eigen::Vector3d center(c.x(), c.y(), 0.0);
    const Eigen::Quaterniond turn = so3_exp({0, 0, quarter * std::numbers::pi / 2});
    BoardCandidate out;
    out.lidar_from_board.transform = test::disturbed(
        lidar_from_board * Rigid3{turn, center - turn * center}, random_, 0.003, 0.003);
    out.lidar_from_board.covariance = covariance(0.005, 0.005);
    out.gain = gain;
    return out;
  }
  // A scene whose second candidate is right; the others are turned and fit worse.
  SceneHypotheses scene(int number) {
    SceneHypotheses out;
    const Rigid3 camera_from_board = test::spread_board(target_, number);
    out.camera_from_board = {camera_from_board, covariance(0.002, 0.002)};
    const Rigid3 lidar_from_board = truth_.inverse() * camera_from_board;
    for (const int quarter : {1, 0, 2, 3})
      out.candidates.push_back(candidate(lidar_from_board, quarter, quarter == 0 ? 60.0 : 50.0));
    return out;
  }
  Target target_;
  Rigid3 truth_ = test::test_extrinsic();
  Random random_{1};
  ConsensusOptions options_;
};

TEST_F(SceneConsensusTest, TheExtrinsicThatAllScenesShareWins) {
  const std::vector<SceneHypotheses> scenes{scene(0), scene(1), scene(2)};
  const auto decided = decide_scenes(scenes, std::nullopt, options_);
  ASSERT_TRUE(decided.has_value());
  EXPECT_EQ(decided->agreeing, 3);
  for (const auto& chosen : decided->chosen) EXPECT_EQ(chosen, 1U);
  EXPECT_THAT(decided->camera_from_lidar.transform, test::IsNearPose(truth_, 30.0, 15.0));
  EXPECT_GT(decided->margin(), 50.0);
  EXPECT_LE(decided->score, 180.0);
  EXPECT_GT(decided->score, 150.0);
}

TEST_F(SceneConsensusTest, TheScenesOutvoteABetterLookingWrongTurn) {
  std::vector<SceneHypotheses> scenes{scene(0), scene(1), scene(2)};
  for (std::size_t s = 0; s < 3; ++s) scenes[s].candidates[2 * (s % 2)].gain = 75.0;
  const auto decided = decide_scenes(scenes, std::nullopt, options_);
  ASSERT_TRUE(decided.has_value());
  for (const auto& chosen : decided->chosen) EXPECT_EQ(chosen, 1U);
}

TEST_F(SceneConsensusTest, ASceneWithADecoyOnlyIsVotedDown) {
  std::vector<SceneHypotheses> scenes{scene(0), scene(1), scene(2)};
  scenes[1].candidates.resize(1);
  scenes[1].candidates[0].lidar_from_board.transform.translation += Eigen::Vector3d(0.4, 1.2, 0.0);
  scenes[1].candidates[0].gain = 100.0;
  const auto decided = decide_scenes(scenes, std::nullopt, options_);
  ASSERT_TRUE(decided.has_value());
  EXPECT_EQ(decided->agreeing, 2);
  EXPECT_EQ(decided->chosen[0], 1U);
  EXPECT_FALSE(decided->chosen[1].has_value());
  EXPECT_EQ(decided->chosen[2], 1U);
  EXPECT_THAT(decided->camera_from_lidar.transform, test::IsNearPose(truth_, 30.0, 15.0));
}

TEST_F(SceneConsensusTest, OnlyABoardThatStandsElsewhereIsEvidenceOfASecondOne) {
  std::vector<SceneHypotheses> scenes{scene(0), scene(1), scene(2)};
  for (SceneHypotheses& s : scenes) s.board_middle_m = target_.outline().center_m();
  // Other readings of the same board, and one that is off by some centimetres.
  scenes[1].candidates[0] = scenes[1].candidates[1];
  scenes[1].candidates[0].lidar_from_board.transform.translation.y() += 0.08;
  const auto one = decide_scenes(scenes, std::nullopt, options_);
  ASSERT_TRUE(one.has_value());
  EXPECT_DOUBLE_EQ(one->elsewhere, 0.0);
  EXPECT_GT(one->runner_up, 40.0);
  // A second board beside the first, wherever that is.
  for (SceneHypotheses& s : scenes) {
    BoardCandidate second = s.candidates[1];
    second.lidar_from_board.transform.translation.y() += 1.2;
    second.gain -= 1.0;
    s.candidates.push_back(second);
  }
  const auto two = decide_scenes(scenes, std::nullopt, options_);
  ASSERT_TRUE(two.has_value());
  EXPECT_EQ(two->chosen[0], 1U);
  EXPECT_GT(two->elsewhere, 0.9 * two->score);
}

TEST_F(SceneConsensusTest, OneSceneAloneHasNoMarginToSpeakOf) {
  std::vector<SceneHypotheses> scenes{scene(0)};
  for (BoardCandidate& c : scenes[0].candidates) c.gain = 50.0;
  const auto decided = decide_scenes(scenes, std::nullopt, options_);
  ASSERT_TRUE(decided.has_value());
  EXPECT_EQ(decided->agreeing, 1);
  EXPECT_NEAR(decided->margin(), 0.0, 1e-9);
}

TEST_F(SceneConsensusTest, AGuessSortsOutWhatIsFarFromIt) {
  std::vector<SceneHypotheses> scenes{scene(0)};
  for (BoardCandidate& c : scenes[0].candidates) c.gain = 50.0;
  scenes[0].candidates[3].gain = 90.0;
  EXPECT_EQ(decide_scenes(scenes, std::nullopt, options_)->chosen[0], 3U);
  const Rigid3 guess = test::disturbed(truth_, random_, 0.05, 0.05);
  const auto decided = decide_scenes(scenes, guess, options_);
  ASSERT_TRUE(decided.has_value());
  EXPECT_EQ(decided->chosen[0], 1U);
  // With nothing near it there is no answer rather than a wrong one.
  Rigid3 wrong = truth_;
  wrong.rotation = so3_exp({0.0, 0.8, 0.0}) * wrong.rotation;
  EXPECT_FALSE(decide_scenes(scenes, wrong, options_).has_value());
}

TEST_F(SceneConsensusTest, TheOtherReadingOfAnAmbiguousImageCounts) {
  std::vector<SceneHypotheses> scenes{scene(0), scene(1), scene(2)};
  // Detection preferred the wrong one of the two planar poses.
  scenes[2].alternative_camera_from_board = scenes[2].camera_from_board.transform;
  scenes[2].camera_from_board.transform.rotation =
      so3_exp({0.5, 0.3, 0.0}) * scenes[2].camera_from_board.transform.rotation;
  const auto decided = decide_scenes(scenes, std::nullopt, options_);
  ASSERT_TRUE(decided.has_value());
  EXPECT_EQ(decided->agreeing, 3);
  EXPECT_EQ(decided->chosen[2], 1U);
}

TEST_F(SceneConsensusTest, CovarianceShrinksWithAgreement) {
  const auto one = decide_scenes({scene(0)}, truth_, options_);
  const auto three = decide_scenes({scene(0), scene(1), scene(2)}, truth_, options_);
  ASSERT_TRUE(one && three);
  EXPECT_LT(three->camera_from_lidar.covariance.trace(), one->camera_from_lidar.covariance.trace());
  EXPECT_LT(test::chi_square_of(three->camera_from_lidar, truth_), 25.0);
}

TEST_F(SceneConsensusTest, NothingToDecideOnGivesNothing) {
  EXPECT_FALSE(decide_scenes({}, std::nullopt, options_).has_value());
  SceneHypotheses empty = scene(0);
  empty.candidates.clear();
  EXPECT_FALSE(decide_scenes({empty, empty}, std::nullopt, options_).has_value());
  // Scenes without candidates do not disturb the others.
  const auto decided = decide_scenes({empty, scene(1), scene(2)}, std::nullopt, options_);
  ASSERT_TRUE(decided.has_value());
  EXPECT_FALSE(decided->chosen[0].has_value());
  EXPECT_EQ(decided->agreeing, 2);
}

}  // namespace
}  // namespace lvcalib
