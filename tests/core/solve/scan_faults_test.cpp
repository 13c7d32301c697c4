// SPDX-License-Identifier: GPL-3.0-or-later
// What score tests say of motion and lag within the scans, against the simulator's truth.
#include "solve/scan_faults.h"

#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "forward_rig.h"
#include "solve/total_uncertainty.h"

namespace lvcalib {
namespace {

using simulation::LidarKind;
using test::forward_rig;
using test::ForwardRig;
using test::solve;

simulation::SimulationOptions moving_options(std::uint64_t seed, LidarKind kind,
                                             const std::map<std::string, double>& effects) {
  auto o = test::cloud_only_options(seed, kind);
  o.scenes = 4;
  o.effects = effects;
  return o;
}

std::vector<ScanFault> faults_of(const ForwardRig& rig) {
  const auto solution = solve(rig, Vector6d::Zero());
  EXPECT_TRUE(solution) << solution.error().text();
  return solution ? solution->scan_faults : std::vector<ScanFault>{};
}

const ScanFault* of_all(const std::vector<ScanFault>& faults, ScanFault::Kind kind) {
  const auto found = std::find_if(faults.begin(), faults.end(),
                                  [&](const ScanFault& f) { return f.kind == kind && !f.scene; });
  return found == faults.end() ? nullptr : &*found;
}

class ScanFaults : public testing::TestWithParam<LidarKind> {};

TEST_P(ScanFaults, NothingIsFoundWhereNothingIs) {
  for (const std::uint64_t seed : {61, 62}) {
    const auto faults = faults_of(forward_rig(moving_options(seed, GetParam(), {})));
    // Angles, origin, lag and motion of all scenes, and each scene's motion.
    EXPECT_EQ(faults.size(), 8U);
    for (const ScanFault& fault : faults) EXPECT_FALSE(fault.is_there()) << fault.chi_square;
  }
}

TEST_P(ScanFaults, AMotionIsFoundAndMeasured) {
  const ForwardRig rig = forward_rig(moving_options(63, GetParam(), {{"scan_motion", 20.0}}));
  const auto solution = solve(rig, Vector6d::Zero());
  ASSERT_TRUE(solution);
  const ScanFault* motion = of_all(solution->scan_faults, ScanFault::Kind::kMotion);
  ASSERT_TRUE(motion != nullptr);
  EXPECT_TRUE(motion->is_there());
  // To first order about a state that it has moved and blurred.
  EXPECT_NEAR(motion->size, 0.02, 0.002);
  // With it in the model the extrinsic moves back to where it is.
  const Rigid3& found = solution->camera_from_lidar.transform;
  const double before = translation_distance_m(found.inverse(), rig.camera_from_lidar.inverse());
  const Rigid3 moved = se3_exp(motion->move) * found;
  EXPECT_GT(before, 0.002);
  EXPECT_LT(translation_distance_m(moved.inverse(), rig.camera_from_lidar.inverse()), 0.1 * before);
}

// Beams that start beside the origin; and, with little of it, what may be wrong.
TEST_P(ScanFaults, AnOriginIsFoundAndMeasured) {
  const ForwardRig rig =
      forward_rig(moving_options(68, GetParam(), {{"beam_origin_offset", 20.0}}));
  const auto solution = solve(rig, Vector6d::Zero());
  ASSERT_TRUE(solution);
  const ScanFault* origin = of_all(solution->scan_faults, ScanFault::Kind::kOrigin);
  ASSERT_TRUE(origin != nullptr);
  EXPECT_TRUE(origin->is_there());
  EXPECT_NEAR(origin->size, 0.02, 0.006) << "chi2 " << origin->chi_square;
  const Rigid3& found = solution->camera_from_lidar.transform;
  const double before = translation_distance_m(found.inverse(), rig.camera_from_lidar.inverse());
  EXPECT_GT(before, 0.005);
  // Board and extrinsic have shared errors that took up part of it.
  const Rigid3 moved = se3_exp(origin->move) * found;
  EXPECT_LT(translation_distance_m(moved.inverse(), rig.camera_from_lidar.inverse()), 0.8 * before);
}

TEST_P(ScanFaults, AnglesThatDoNotHoldAreFoundOrInTheTotalUncertainty) {
  for (const auto& [effect, size] : std::map<std::string, double>{
           {"angle_scale", 2000.0}, {"encoder_eccentricity", 1.0}, {"beam_origin_offset", 3.0}}) {
    const ForwardRig rig = forward_rig(moving_options(69, GetParam(), {{effect, size}}));
    const auto solution = solve(rig, Vector6d::Zero());
    ASSERT_TRUE(solution);
    const UncertainRigid3& own = solution->camera_from_lidar;
    const UncertainRigid3 total{own.transform, total_covariance(*solution, {})};
    EXPECT_LT(test::size_in_sigmas(total, rig.camera_from_lidar), 3.0) << effect;
    EXPECT_GT(test::size_in_sigmas(own, rig.camera_from_lidar),
              test::size_in_sigmas(total, rig.camera_from_lidar))
        << effect;
  }
}

// A fault too small to matter is still in what may be wrong.
TEST_P(ScanFaults, WhatIsFoundIsInTheTotalUncertainty) {
  const ForwardRig rig = forward_rig(moving_options(67, GetParam(), {{"scan_motion", 3.0}}));
  const auto solution = solve(rig, Vector6d::Zero());
  ASSERT_TRUE(solution);
  const UncertainRigid3& own = solution->camera_from_lidar;
  EXPECT_GT(test::size_in_sigmas(own, rig.camera_from_lidar), 3.0);
  const UncertainRigid3 total{own.transform, total_covariance(*solution, {})};
  EXPECT_LT(test::size_in_sigmas(total, rig.camera_from_lidar), 1.7);
}

INSTANTIATE_TEST_SUITE_P(Scanners, ScanFaults,
                         testing::Values(LidarKind::kAvia, LidarKind::kRosette,
                                         LidarKind::kSpinning),
                         [](const auto& info) {
                           return info.param == LidarKind::kAvia      ? "Avia"
                                  : info.param == LidarKind::kRosette ? "Rosette"
                                                                      : "Spinning";
                         });

TEST(ScanFaultsOfOneScene, AMotionInOneSceneIsThatScenes) {
  ForwardRig rig = forward_rig(moving_options(64, LidarKind::kAvia, {}));
  // The board of the second scene drifts by 15 mm/s across the view.
  Cloud& cloud = rig.clouds[1];
  for (std::size_t k = 0; k < cloud.size(); ++k) cloud.points_m[k].y() += 0.015F * cloud.time_s[k];
  const auto faults = faults_of(rig);
  for (const ScanFault& fault : faults) {
    if (!fault.scene) continue;
    EXPECT_EQ(fault.is_there(), *fault.scene == 1) << *fault.scene << ' ' << fault.chi_square;
    if (*fault.scene == 1) EXPECT_NEAR(fault.size, 0.015, 0.002);
  }
}

TEST(ScanFaultsLag, ALagIsMeasuredWhereTheScanTurns) {
  const auto faults =
      faults_of(forward_rig(moving_options(65, LidarKind::kRosette, {{"encoder_lag", 5.0}})));
  const ScanFault* lag = of_all(faults, ScanFault::Kind::kLag);
  ASSERT_TRUE(lag != nullptr);
  EXPECT_TRUE(lag->is_there());
  EXPECT_NEAR(std::abs(lag->size), 5e-6, 5e-7);
  EXPECT_LT(lag->sigma, 2e-7);
}

TEST(ScanFaultsTimes, WithoutTimesAnglesAndOriginAreTestedAlone) {
  ForwardRig rig = forward_rig(moving_options(66, LidarKind::kAvia, {{"scan_motion", 20.0}}));
  for (Cloud& cloud : rig.clouds) cloud.time_s.clear();
  const auto kind = [](ScanFault::Kind k) { return testing::Field(&ScanFault::kind, k); };
  EXPECT_THAT(faults_of(rig),
              testing::ElementsAre(kind(ScanFault::Kind::kAngles), kind(ScanFault::Kind::kOrigin)));
}

}  // namespace
}  // namespace lvcalib
