// SPDX-License-Identifier: GPL-3.0-or-later
// The joint solve over corners and returns, on rigs by the simulator.
#include "solve/forward_solver.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include "forward_rig.h"
#include "solve/total_uncertainty.h"
#include "support/ordinary_boards.h"

namespace lvcalib {
namespace {

using simulation::LidarKind;
using test::forward_rig;
using test::ForwardRig;
using test::size_in_sigmas;
using test::solve;

simulation::SimulationOptions options(std::uint64_t seed, LidarKind kind, int scenes = 3) {
  auto o = test::cloud_only_options(seed, kind);
  o.scenes = scenes;
  o.target.tag_spacing = 0.1 / 0.12;
  return o;
}

// Six centimetres and some milliradians in a direction of its own.
Vector6d far_off(std::uint64_t seed) {
  Random random(seed);
  Vector6d off;
  for (double& v : off) v = random.normal();
  off.head<3>() *= 0.06 / off.head<3>().norm();
  off.tail<3>() *= 0.004 / off.tail<3>().norm();
  return off;
}

class ForwardSolver : public testing::TestWithParam<LidarKind> {};

TEST_P(ForwardSolver, FindsTheExtrinsicWithinItsInterval) {
  for (const TargetType type : {TargetType::kAprilGridCircles, TargetType::kAprilGrid}) {
    auto o = options(31, GetParam());
    o.target.type = type;
    const ForwardRig rig = forward_rig(o);
    const auto solution = solve(rig, Vector6d::Zero());
    ASSERT_TRUE(solution) << solution.error().text();
    EXPECT_TRUE(solution->converged);
    EXPECT_TRUE(solution->uses_intensity);
    EXPECT_LT(translation_distance_m(solution->camera_from_lidar.transform, rig.camera_from_lidar),
              0.001);
    EXPECT_LT(size_in_sigmas(solution->camera_from_lidar, rig.camera_from_lidar), 2.2);
    // The beam: 1.2 and 0.8 mrad of footprint and 0.42 mrad of jitter, in quadrature.
    const Eigen::Matrix2d& blur = solution->state.beam.blur_rad2;
    EXPECT_NEAR(1e3 * std::sqrt(blur(0, 0)), 1.27, 0.05);
    EXPECT_NEAR(1e3 * std::sqrt(blur(1, 1)), 0.90, 0.05);
    EXPECT_NEAR(1e6 * blur(0, 0), 1.615, 5.0 * 1e6 * std::sqrt(solution->blur_covariance(0, 0)));
    for (const ForwardSceneResult& scene : solution->scenes) {
      EXPECT_LT(scene.intensity_left, 0.12);
      // A clean scene loses less than a hundredth of its rows.
      EXPECT_LT(100 * scene.refused, scene.on_board);
    }
  }
}

TEST_P(ForwardSolver, ComesBackFromSixCentimetres) {
  for (std::uint64_t seed : {5, 6}) {
    auto o = options(40 + seed, GetParam());
    if (seed == 6) o.target = test::checkerboard_target();
    const ForwardRig rig = forward_rig(o);
    const auto near = solve(rig, Vector6d::Zero());
    const auto far = solve(rig, far_off(seed));
    ASSERT_TRUE(near && far);
    EXPECT_LT(
        translation_distance_m(near->camera_from_lidar.transform, far->camera_from_lidar.transform),
        5e-5);  // A third of the standard deviation or less: rows at the gate differ.
    EXPECT_LT(size_in_sigmas(far->camera_from_lidar, rig.camera_from_lidar), 2.5);
  }
}

INSTANTIATE_TEST_SUITE_P(Scanners, ForwardSolver,
                         testing::Values(LidarKind::kRosette, LidarKind::kAvia,
                                         LidarKind::kSpinning));

// Spots too wide to see black alone anywhere: what they scatter more where they see more of it
// tells how ranges scatter there.
TEST(ForwardSolver, MeasuresTheNoiseOnPrintThatNoSpotSeesAlone) {
  auto o = options(33, LidarKind::kAvia, 2);
  o.target.type = TargetType::kAprilGrid;
  o.lidar.beam_horizontal_mrad = o.lidar.beam_vertical_mrad = 4.0;
  const ForwardRig rig = forward_rig(o);
  const auto solution = solve(rig, Vector6d::Zero());
  ASSERT_TRUE(solution) << solution.error().text();
  const double darker =
      std::pow(simulation::PrintedBoard::kWhite / simulation::PrintedBoard::kBlack,
               o.lidar.range_dark_exponent);
  for (const ForwardSceneResult& scene : solution->scenes) {
    EXPECT_NEAR(scene.noise.range_white_m, o.lidar.range_sigma_m, 0.1 * o.lidar.range_sigma_m);
    EXPECT_NEAR(scene.noise.range_black_m / scene.noise.range_white_m, darker, 0.3 * darker);
  }
}

TEST(ForwardSolver, OneSceneIsEnoughForAPrint) {
  const ForwardRig rig = forward_rig(options(51, LidarKind::kAvia, 1));
  const auto solution = solve(rig, Vector6d::Zero());
  ASSERT_TRUE(solution);
  EXPECT_LT(size_in_sigmas(solution->camera_from_lidar, rig.camera_from_lidar), 2.5);
}

TEST(ForwardSolver, WithoutIntensityRestsOnRangesAndSaysHowLittleTheyTell) {
  ForwardRig rig = forward_rig(options(52, LidarKind::kAvia, 4));
  const auto with = solve(rig, Vector6d::Zero());
  ForwardRig constant = forward_rig(options(52, LidarKind::kAvia, 4));
  for (Cloud& cloud : rig.clouds) cloud.intensity.clear();
  for (Cloud& cloud : constant.clouds)
    std::fill(cloud.intensity.begin(), cloud.intensity.end(), 7.0F);
  const auto without = solve(rig, Vector6d::Zero());
  const auto same = solve(constant, Vector6d::Zero());
  ASSERT_TRUE(with && without && same) << without.error().text();
  EXPECT_FALSE(without->uses_intensity);
  EXPECT_FALSE(same->uses_intensity);
  EXPECT_EQ(without->camera_from_lidar.transform.translation,
            same->camera_from_lidar.transform.translation);
  EXPECT_GT(without->camera_from_lidar.covariance.trace(),
            9.0 * with->camera_from_lidar.covariance.trace());
  EXPECT_LT(size_in_sigmas(without->camera_from_lidar, rig.camera_from_lidar), 2.5);
  // A plane tells three numbers. What its print would do to ranges, were its levels known, tells
  // nothing of its place.
  for (const GlobalTerm& term : without->terms) {
    const Eigen::SelfAdjointEigenSolver<Matrix6d> told(
        Matrix6d(term.information.topLeftCorner<6, 6>()));
    EXPECT_LT(told.eigenvalues()(2), 1e-6 * told.eigenvalues()(3));
  }
}

// Three boards that face nearly the same way hardly hold the extrinsic: it is stated so.
TEST(ForwardSolver, PlanesAloneStateWhatTheyKnow) {
  double squares = 0.0;
  constexpr int kRigs = 10;
  for (std::uint64_t seed = 0; seed < kRigs; ++seed) {
    ForwardRig rig = forward_rig(options(400 + seed, LidarKind::kAvia, 3));
    for (Cloud& cloud : rig.clouds) cloud.intensity.clear();
    const auto solution = solve(rig, Vector6d::Zero());
    ASSERT_TRUE(solution) << solution.error().text();
    squares += std::pow(size_in_sigmas(solution->camera_from_lidar, rig.camera_from_lidar), 2);
  }
  // The mean of ten χ²₆/6 exceeds this once in ten thousand times.
  EXPECT_LT(squares / kRigs, 1.83);
}

TEST(ForwardSolver, APostBeforeTheBoardIsRefused) {
  ForwardRig rig = forward_rig(options(53, LidarKind::kAvia));
  // An upright post 4 cm wide, half a metre before the first board: black, so that its mixed edges
  // would look like print.
  Cloud& cloud = rig.clouds.front();
  const Eigen::Vector2d c = rig.target.outline().center_m();
  const Eigen::Vector3d middle = rig.lidar_from_board.front() * Eigen::Vector3d(c.x(), c.y(), 0.0);
  const double azimuth = std::atan2(middle.y(), middle.x());
  std::size_t hidden = 0;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Eigen::Vector3d p = cloud.points_m[i].cast<double>();
    const double off = (std::atan2(p.y(), p.x()) - azimuth) * p.norm();
    if (std::abs(off) > 0.02) continue;
    cloud.points_m[i] = ((p.norm() - 0.5) * p.normalized()).cast<float>();
    cloud.intensity[i] = 15.0F;
    ++hidden;
  }
  const auto solution = solve(rig, Vector6d::Zero());
  ASSERT_TRUE(solution);
  EXPECT_GE(solution->scenes.front().refused, hidden * 8 / 10);
  EXPECT_LT(size_in_sigmas(solution->camera_from_lidar, rig.camera_from_lidar), 2.5);
}

// Whether some patch refused in a scene holds a place of the board.
bool is_covered(const ForwardSceneResult& scene, const Eigen::Vector2d& place_m) {
  return std::any_of(scene.covered.begin(), scene.covered.end(),
                     [&](const CoveredPatch& patch) { return patch.board_m.contains(place_m); });
}

TEST(ForwardSolver, AHandAndDirtOnTheBoardAreRefused) {
  ForwardRig rig = forward_rig(options(57, LidarKind::kAvia));
  const BoardOutline outline = rig.target.outline();
  // A hand holds the first board by its edge, two and a half centimetres thick.
  const Eigen::Vector2d hand(outline.lower_left_m.x() + 0.05, outline.center_m().y());
  // Mud on the second, flat, as dark as ink.
  const Eigen::Vector2d mud = outline.upper_right_m - Eigen::Vector2d(0.06, 0.09);
  const auto near = [&](std::size_t s, std::size_t i, const Eigen::Vector2d& place, double size) {
    const Eigen::Vector3d p =
        rig.lidar_from_board[s].inverse() * rig.clouds[s].points_m[i].cast<double>().eval();
    return (p.head<2>() - place).cwiseAbs().maxCoeff() < size;
  };
  std::size_t held = 0;
  for (std::size_t i = 0; i < rig.clouds[0].size(); ++i) {
    if (!near(0, i, hand, 0.06)) continue;
    const Eigen::Vector3d p = rig.clouds[0].points_m[i].cast<double>();
    rig.clouds[0].points_m[i] = ((p.norm() - 0.025) * p.normalized()).cast<float>();
    rig.clouds[0].intensity[i] = 60.0F;
    ++held;
  }
  for (std::size_t i = 0; i < rig.clouds[1].size(); ++i) {
    if (near(1, i, mud, 0.04)) rig.clouds[1].intensity[i] = 15.0F;
  }
  const auto solution = solve(rig, Vector6d::Zero());
  ASSERT_TRUE(solution);
  EXPECT_TRUE(is_covered(solution->scenes[0], hand));
  EXPECT_TRUE(is_covered(solution->scenes[1], mud));
  EXPECT_GE(solution->scenes[0].refused, held * 8 / 10);
  for (std::size_t s = 2; s < solution->scenes.size(); ++s)
    EXPECT_TRUE(solution->scenes[s].covered.empty()) << s;
  EXPECT_LT(size_in_sigmas(solution->camera_from_lidar, rig.camera_from_lidar), 2.5);
}

// Who knows that nothing covers the board there has the returns back, and only those.
TEST(ForwardSolver, APartOfTheBoardIsUsedAllTheSame) {
  ForwardRig rig = forward_rig(options(57, LidarKind::kAvia));
  const BoardOutline outline = rig.target.outline();
  const Eigen::Vector2d stain = outline.upper_right_m - Eigen::Vector2d(0.06, 0.09);
  for (const std::size_t s : {0U, 1U}) {
    for (std::size_t i = 0; i < rig.clouds[s].size(); ++i) {
      const Eigen::Vector3d p =
          rig.lidar_from_board[s].inverse() * rig.clouds[s].points_m[i].cast<double>().eval();
      if ((p.head<2>() - stain).cwiseAbs().maxCoeff() < 0.04) rig.clouds[s].intensity[i] = 15.0F;
    }
  }
  const auto refused = solve(rig, Vector6d::Zero());
  ASSERT_TRUE(refused);
  ASSERT_TRUE(is_covered(refused->scenes[0], stain) && is_covered(refused->scenes[1], stain));
  for (const CoveredPatch& patch : refused->scenes[1].covered)
    rig.scenes[1].uncovered.push_back({patch.board_m.min(), patch.board_m.max()});
  const auto kept = solve(rig, Vector6d::Zero());
  ASSERT_TRUE(kept);
  EXPECT_TRUE(is_covered(kept->scenes[0], stain));
  EXPECT_FALSE(is_covered(kept->scenes[1], stain));
  EXPECT_GT(kept->scenes[1].returns, refused->scenes[1].returns + 50);
}

TEST(ForwardSolver, EveryKindOfBoardIsFoundAndMeasured) {
  for (const Target& target : {test::checkerboard_target(), test::charuco_target(),
                               test::legacy_charuco_target(), test::single_tag_target()}) {
    auto o = options(61, LidarKind::kAvia);
    o.target = target;
    const ForwardRig rig = forward_rig(o);
    const auto solution = solve(rig, far_off(3));
    ASSERT_TRUE(solution) << solution.error().text();
    EXPECT_LT(size_in_sigmas(solution->camera_from_lidar, rig.camera_from_lidar), 2.5);
    EXPECT_GT(solution->lattice_margin, 100.0);
    ASSERT_TRUE(solution->print_size.measured);
    for (Eigen::Index k = 0; k < 2; ++k) {
      EXPECT_LT(std::abs(solution->print_size.scale(k) - 1.0), 4.0 * solution->print_size.sigma(k));
      EXPECT_LT(solution->print_size.sigma(k), 2e-3);
    }
  }
}

TEST(PrintSize, FollowsFromWhereBoardsStandHoweverThePrintIsMatched) {
  const ForwardRig rig = forward_rig(options(65, LidarKind::kAvia, 5));
  Random random(5);
  double squares = 0.0;
  constexpr int kTrials = 200;
  for (int trial = 0; trial < kTrials; ++trial) {
    std::vector<Rigid3> by_camera;
    std::vector<Rigid3> by_lidar;
    for (const ForwardScene& scene : rig.scenes) {
      // The camera took boards of 90 % of their size for whole ones, the LiDAR found them to 1 cm.
      by_camera.push_back(scene.camera_from_board);
      by_camera.back().translation /= 0.9;
      by_lidar.push_back(scene.lidar_from_board);
      for (double& part : by_lidar.back().translation) part += 0.01 * random.normal();
    }
    const PrintSize size = size_from_places(by_camera, by_lidar, rig.camera_from_lidar, {0, 0});
    ASSERT_TRUE(size.measured);
    EXPECT_NEAR(size.scale.x(), 0.9, 0.05);
    squares += std::pow((size.scale.x() - 0.9) / size.sigma.x(), 2);
  }
  EXPECT_NEAR(squares / kTrials, 1.0, 0.4);
  EXPECT_FALSE(size_from_places({}, {}, {}, {0, 0}).measured);
  const std::vector<Rigid3> same(4, rig.lidar_from_board.front());
  EXPECT_FALSE(size_from_places(same, same, {}, {0, 0}).measured);
}

TEST(ForwardSolver, IntensitiesThatDoNotShowThePrintAreLeftOut) {
  ForwardRig rig = forward_rig(options(63, LidarKind::kAvia, 4));
  Random random(4);
  for (Cloud& cloud : rig.clouds) {
    for (float& i : cloud.intensity) i = static_cast<float>(100.0 + 4.0 * random.normal());
  }
  const auto solution = solve(rig, Vector6d::Zero());
  ASSERT_TRUE(solution);
  EXPECT_FALSE(solution->uses_intensity);
  EXPECT_LT(size_in_sigmas(solution->camera_from_lidar, rig.camera_from_lidar), 2.5);
}

TEST(ForwardSolver, SubsetsAreThoseSolvedByThemselves) {
  ForwardRig rig = forward_rig(options(54, LidarKind::kRosette, 4));
  const auto all = solve(rig, Vector6d::Zero());
  ASSERT_TRUE(all);
  const auto same = solve_subset(*all, {true, true, true, true});
  ASSERT_TRUE(same);
  EXPECT_LT(size_in_sigmas({same->transform, all->camera_from_lidar.covariance},
                           all->camera_from_lidar.transform),
            0.02);
  const auto three = solve_subset(*all, {true, true, true, false});
  rig.scenes.pop_back();
  const auto alone = solve(rig, Vector6d::Zero());
  ASSERT_TRUE(three && alone);
  EXPECT_LT(size_in_sigmas(*three, alone->camera_from_lidar.transform), 0.2);
  EXPECT_FALSE(solve_subset(*all, {false, false, false, false}));
}

TEST(ForwardSolver, DoesNotDependOnThreads) {
  const ForwardRig rig = forward_rig(options(55, LidarKind::kAvia));
  RunContext one;
  one.threads = 1;
  RunContext three;
  three.threads = 3;
  const auto a = solve(rig, Vector6d::Zero(), one);
  const auto b = solve(rig, Vector6d::Zero(), three);
  ASSERT_TRUE(a && b);
  EXPECT_EQ(a->camera_from_lidar.transform.translation, b->camera_from_lidar.transform.translation);
  EXPECT_EQ(a->camera_from_lidar.covariance, b->camera_from_lidar.covariance);
}

TEST(ForwardSolver, StopsWhenAsked) {
  const ForwardRig rig = forward_rig(options(56, LidarKind::kAvia));
  std::stop_source stop;
  stop.request_stop();
  RunContext context;
  context.stop = stop.get_token();
  const auto solution = solve(rig, Vector6d::Zero(), context);
  ASSERT_FALSE(solution);
  EXPECT_EQ(solution.error().kind, ErrorKind::kCancelled);
}

TEST(ForwardSolver, NeedsReturnsOnTheBoard) {
  ForwardRig rig = forward_rig(options(57, LidarKind::kAvia));
  for (Cloud& cloud : rig.clouds) cloud = Cloud{};
  const auto solution = solve(rig, Vector6d::Zero());
  ASSERT_FALSE(solution);
  EXPECT_EQ(solution.error().kind, ErrorKind::kUntrusted);
}

TEST(ForwardSolver, ErrorsThatScenesShareWidenTheInterval) {
  // Boards that moved by 3 mm between cloud and image, each its own way.
  ForwardRig rig = forward_rig(options(58, LidarKind::kAvia, 6));
  const auto clean = solve(rig, Vector6d::Zero());
  Random random(9);
  for (Cloud& cloud : rig.clouds) {
    Eigen::Vector3f shift;
    for (float& part : shift) part = 0.003F * static_cast<float>(random.normal());
    for (Eigen::Vector3f& p : cloud.points_m) p += shift;
  }
  const auto moved = solve(rig, Vector6d::Zero());
  ASSERT_TRUE(clean && moved);
  EXPECT_GT(moved->camera_from_lidar.covariance.trace(),
            10.0 * clean->camera_from_lidar.covariance.trace());
  EXPECT_LT(size_in_sigmas(moved->camera_from_lidar, rig.camera_from_lidar), 2.5);
  EXPECT_LT(moved->dof, 100.0);
}

TEST(ForwardSolver, FewCornersTellTheirNoiseBadly) {
  auto o = options(63, LidarKind::kAvia, 3);
  const auto many = solve(forward_rig(o), Vector6d::Zero());
  o.target = test::single_tag_target();
  const auto few = solve(forward_rig(o), Vector6d::Zero());
  ASSERT_TRUE(many && few);
  EXPECT_GT(many->dof, 1000.0);
  // Four corners, eight coordinates, of which the pose takes six: two a scene; ranges and
  // intensities say their part of the extrinsic with all the freedom that they have.
  EXPECT_LT(few->dof, 100.0);
  EXPECT_GE(few->dof, 6.0 - 1e-6);
  // The total uncertainty is that of Student's distribution.
  ForwardSolution sure = *few;
  sure.dof = 1e6;
  ForwardSolution unsure = *few;
  unsure.dof = 6.0;
  const Matrix6d wider = total_covariance(unsure, {}) - total_covariance(sure, {});
  EXPECT_LT((wider - 0.5 * few->camera_from_lidar.covariance).norm(),
            1e-3 * few->camera_from_lidar.covariance.norm());
}

TEST(ForwardSolver, AnOffsetOfAllRangesIsTheSensorsOwn) {
  // Every range reads 15 mm far. The boards stand in many directions, so that no extrinsic makes up
  // for it.
  ForwardRig rig = forward_rig(options(61, LidarKind::kSpinning, 8));
  const auto clean = solve(rig, Vector6d::Zero());
  constexpr double kOffset_m = 0.015;
  for (Cloud& cloud : rig.clouds) {
    for (Eigen::Vector3f& p : cloud.points_m)
      p *= static_cast<float>(1.0 + kOffset_m / static_cast<double>(p.norm()));
  }
  const auto off = solve(rig, Vector6d::Zero());
  ASSERT_TRUE(clean && off);
  const auto kind = static_cast<std::size_t>(SharedError::kSensorRange);
  EXPECT_FALSE(clean->noise.admitted[kind]);
  ASSERT_TRUE(off->noise.admitted[kind]);
  EXPECT_NEAR(off->state.sensor.values(0), kOffset_m, 0.3 * kOffset_m);
  EXPECT_LT(size_in_sigmas(off->camera_from_lidar, rig.camera_from_lidar), 2.0);
  // It explains what would otherwise move the boards.
  for (std::size_t k = 0; k < kSceneErrors; ++k) {
    if (!moves_board(k)) continue;
    EXPECT_LT(std::sqrt(off->noise.shared[k]), 0.5e-3) << k;
  }
}

TEST(ForwardSolver, LinesThatReadFarInAllScenesAreOneError) {
  ForwardRig rig = forward_rig(options(62, LidarKind::kSpinning, 4));
  const auto wrong = [](int line) { return 0.01 * std::sin(2.3 * line); };
  for (Cloud& cloud : rig.clouds) {
    for (std::size_t k = 0; k < cloud.points_m.size(); ++k) {
      Eigen::Vector3f& p = cloud.points_m[k];
      p *= static_cast<float>(1.0 + wrong(cloud.line[k]) / static_cast<double>(p.norm()));
    }
  }
  const auto solution = solve(rig, Vector6d::Zero());
  ASSERT_TRUE(solution);
  EXPECT_TRUE(solution->noise.admitted[static_cast<std::size_t>(SharedError::kSensorLine)]);
  EXPECT_LT(size_in_sigmas(solution->camera_from_lidar, rig.camera_from_lidar), 2.0);
  // What all lines have in common is the offset's.
  const SensorErrors& found = solution->state.sensor;
  ASSERT_GT(found.lines.size(), 8U);
  double mean_found = 0.0;
  double mean_wrong = 0.0;
  for (std::size_t k = 0; k < found.lines.size(); ++k) {
    mean_found += found.values(SensorErrors::kFirstLine + static_cast<Eigen::Index>(k));
    mean_wrong += wrong(found.lines[k]);
  }
  const auto count = static_cast<double>(found.lines.size());
  double squares = 0.0;
  for (std::size_t k = 0; k < found.lines.size(); ++k) {
    const double value = found.values(SensorErrors::kFirstLine + static_cast<Eigen::Index>(k));
    squares += std::pow(value - mean_found / count - wrong(found.lines[k]) + mean_wrong / count, 2);
  }
  EXPECT_LT(std::sqrt(squares / count), 2e-3);
}

}  // namespace
}  // namespace lvcalib
