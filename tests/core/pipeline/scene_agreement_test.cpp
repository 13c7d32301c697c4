// SPDX-License-Identifier: GPL-3.0-or-later
// What contradictions between scenes are taken for.
#include <functional>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/random.h"
#include "pipeline/verdict.h"

namespace lvcalib {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr double kSigma_m = 3e-4;
constexpr double kSigma_rad = 1e-4;

// Scenes A, B, … that each know the extrinsic to kSigma, and see it displaced as told besides
// scatter of so many of these; boards stand ever farther away, or in turn near and far.
CalibrationResult scenes_that_see(std::size_t count,
                                  const std::function<Vector6d(std::size_t)>& displaced,
                                  double scatter, std::uint64_t seed, bool farther = false) {
  CalibrationResult result;
  result.forward.emplace();
  Random random(seed);
  Vector6d sigma;
  sigma << Eigen::Vector3d::Constant(kSigma_m), Eigen::Vector3d::Constant(kSigma_rad);
  const Vector6d weight = sigma.cwiseAbs2().cwiseInverse();
  Matrix6d all = Matrix6d::Zero();
  for (std::size_t s = 0; s < count; ++s) {
    SceneSolution scene;
    scene.name = std::string(1, static_cast<char>('A' + s));
    scene.used = true;
    scene.camera_from_board.translation.z() =
        farther ? 2.0 + 0.5 * static_cast<double>(s) : 2.0 + 1.0 * static_cast<double>(s % 2);
    result.extrinsic.scenes.push_back(scene);
    Vector6d seen = displaced(s);
    for (Eigen::Index k = 0; k < 6; ++k) seen(k) += scatter * sigma(k) * random.normal();
    GlobalTerm term;
    term.information = Eigen::MatrixXd::Zero(kGlobals, kGlobals);
    term.information.topLeftCorner<6, 6>() = weight.asDiagonal();
    term.gradient = Eigen::VectorXd::Zero(kGlobals);
    term.gradient.head<6>() = weight.cwiseProduct(seen);
    term.spread = Eigen::MatrixXd::Zero(kGlobals, kGlobals);
    term.usable = true;
    all += term.information.topLeftCorner<6, 6>();
    result.forward->terms.push_back(term);
  }
  result.extrinsic.camera_from_lidar.covariance = all.inverse();
  return result;
}

Vector6d by(double x_m) {
  Vector6d out = Vector6d::Zero();
  out(0) = x_m;
  return out;
}

std::vector<std::string> said_of(CalibrationResult result,
                                 void (*judge)(const CalibrationResult&, Verdict&) = judge_bump) {
  Verdict verdict(result);
  judge(result, verdict);
  std::vector<std::string> out;
  for (const Message& reason : result.quality_reasons) out.push_back(reason.text());
  return out;
}

TEST(SceneAgreement, ABumpIsToldWithBothGroups) {
  const auto bump = [](std::size_t s) { return by(s < 2 ? 0.0 : 0.004); };
  EXPECT_THAT(said_of(scenes_that_see(4, bump, 1.0, 1)),
              ElementsAre(testing::AllOf(HasSubstr("scenes A, B give"), HasSubstr("scenes C, D"),
                                         HasSubstr("move between scenes B and C?"))));
  // Three scenes are enough for a large one.
  const auto last = [](std::size_t s) { return by(s < 2 ? 0.0 : 0.01); };
  EXPECT_THAT(said_of(scenes_that_see(3, last, 1.0, 2)),
              ElementsAre(HasSubstr("move between scenes B and C?")));
}

TEST(SceneAgreement, OneSceneThatMovedIsNamed) {
  const auto one = [](std::size_t s) { return by(s == 2 ? 0.004 : 0.0); };
  EXPECT_THAT(said_of(scenes_that_see(5, one, 1.0, 3)),
              ElementsAre(HasSubstr("scene C contradicts the others")));
}

TEST(SceneAgreement, ADriftIsNoBump) {
  const auto drift = [](std::size_t s) { return by(0.002 * static_cast<double>(s)); };
  EXPECT_THAT(said_of(scenes_that_see(6, drift, 1.0, 4)),
              ElementsAre(HasSubstr("moves steadily from scene to scene, by ")));
  // Where boards stand ever farther away it may be an effect that grows with the distance.
  EXPECT_THAT(said_of(scenes_that_see(6, drift, 1.0, 4, true)), IsEmpty());
}

// Of scenes that weigh alike; what all see together is where the solve ends.
std::vector<std::string> leverage_of(std::size_t count, std::size_t odd, double by_m,
                                     double scatter, std::uint64_t seed) {
  CalibrationResult result = scenes_that_see(
      count, [&](std::size_t s) { return by(s == odd ? by_m : 0.0); }, scatter, seed);
  Eigen::VectorXd mean = Eigen::VectorXd::Zero(kGlobals);
  for (const GlobalTerm& term : result.forward->terms)
    mean += term.gradient / static_cast<double>(count);
  for (GlobalTerm& term : result.forward->terms) term.gradient -= mean;
  result.forward->dof = 1e4;
  return said_of(result, judge_leverage);
}

TEST(SceneAgreement, AResultThatRestsOnOneSceneNamesIt) {
  EXPECT_THAT(leverage_of(5, 2, 0.004, 1.0, 5),
              ElementsAre(testing::AllOf(HasSubstr("without scene C the extrinsic moves by 0."),
                                         HasSubstr("more than three of its standard deviations"))));
  // Less than the tolerance matters to nobody; two scenes cannot tell.
  EXPECT_THAT(leverage_of(5, 2, 0.0015, 0.0, 6), IsEmpty());
  EXPECT_THAT(leverage_of(2, 1, 0.004, 1.0, 7), IsEmpty());
}

// One in a thousand each, whatever scenes differ by: 400 rigs, of which 3 are seen by chance once
// in a hundred times.
TEST(SceneAgreement, ScatterIsNoMotion) {
  int noise = 0;
  int effect = 0;
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    const auto still = [](std::size_t) { return by(0.0); };
    noise += said_of(scenes_that_see(5, still, 1.0, 100 + seed)).empty() ? 0 : 1;
    effect += said_of(scenes_that_see(5, still, 20.0, 900 + seed)).empty() ? 0 : 1;
  }
  EXPECT_LE(noise, 3);
  EXPECT_LE(effect, 3);
}

}  // namespace
}  // namespace lvcalib
