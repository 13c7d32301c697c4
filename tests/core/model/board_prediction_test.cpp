// SPDX-License-Identifier: GPL-3.0-or-later
// The prediction of a return against a brute-force integral over its footprint, and its Jacobians
// against differences.
#include "model/board_prediction.h"

#include <cmath>
#include <numbers>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include "base/random.h"

namespace lvcalib {
namespace {

Target circles() {
  Target t;
  t.tag_spacing = 0.1 / 0.12;
  return t;
}

// A board about three metres ahead (LiDAR x), facing back, tilted and turned.
Rigid3 board_pose(double tilt, double roll, double distance) {
  Eigen::Matrix3d facing;  // Board x to the right (−y), y up (z), z back (−x).
  facing << 0, 0, -1, -1, 0, 0, 0, 1, 0;
  const Eigen::Quaterniond turn = so3_exp({0, 0, tilt}) * so3_exp({roll, 0, 0});
  const Eigen::Matrix3d r = turn.toRotationMatrix() * facing;
  const Eigen::Vector2d c = circles().outline().center_m();
  return Rigid3::from_matrix(
      r, Eigen::Vector3d(distance, 0.1, -0.05) - r * Eigen::Vector3d(c.x(), c.y(), 0));
}

Eigen::Vector3d towards(const Rigid3& lidar_from_board, const Eigen::Vector2d& board_m) {
  return (lidar_from_board * Eigen::Vector3d(board_m.x(), board_m.y(), 0.0)).normalized();
}

BeamSpread beam(bool jitter) {
  BeamSpread b;
  b.blur_rad2 << 1.6e-6, 0.2e-6, 0.2e-6, 0.8e-6;
  if (jitter) b.jitter_rad2 = 0.18e-6 * Eigen::Matrix2d::Identity();
  return b;
}

BoardLevels levels() {
  return {120.0, 12.0, {0.03, -0.05}};
}

// Mean intensity and power-weighted range over rays spread as the footprint is.
struct BruteForce {
  double intensity = 0.0, range = 0.0;
};
BruteForce integrate(const Target& target, const Rigid3& pose, const Eigen::Vector3d& direction,
                     const Eigen::Matrix2d& blur) {
  const Eigen::Matrix2d root = blur.llt().matrixL();
  const Eigen::Vector3d horizontal = Eigen::Vector3d::UnitZ().cross(direction).normalized();
  const Eigen::Vector3d vertical = direction.cross(horizontal);
  const Rigid3 board_from_lidar = pose.inverse();
  const Eigen::Vector3d normal = pose.rotation * Eigen::Vector3d::UnitZ();
  const Eigen::Vector2d center = target.outline().center_m();
  const double half = 0.5 * target.outline().size_m().maxCoeff();
  const BoardLevels l = levels();
  double sum = 0, power = 0, range = 0;
  constexpr int kRays = 300'000;
  for (int i = 0; i < kRays; ++i) {
    // Vogel's spiral, with the radii of a Gaussian.
    const double radius = std::sqrt(-2.0 * std::log(1.0 - (i + 0.5) / kRays));
    const double angle = 2.399963229728653 * i;
    const Eigen::Vector2d a =
        root * Eigen::Vector2d(radius * std::cos(angle), radius * std::sin(angle));
    // Directions a small angle away, to first order as the model's hit is.
    const Eigen::Vector3d ray = direction + a.x() * horizontal + a.y() * vertical;
    const double r = normal.dot(pose.translation) / normal.dot(ray);
    const Eigen::Vector3d at = board_from_lidar * (r * ray);
    const double white = target.albedo(at.head<2>()).value_or(1.0);
    const double value = l.black + (l.white - l.black) * white;
    const double light = 1.0 + l.slope.dot((at.head<2>() - center) / half);
    sum += value * light;
    power += value;
    range += value * r * ray.norm();
  }
  return {sum / kRays, range / power};
}

std::vector<Eigen::Vector2d> places(int count, std::uint64_t seed) {
  Random random(seed);
  const BoardOutline o = circles().outline();
  std::vector<Eigen::Vector2d> out;
  for (int i = 0; i < count; ++i) {
    out.emplace_back(random.uniform(o.lower_left_m.x() + 0.03, o.upper_right_m.x() - 0.03),
                     random.uniform(o.lower_left_m.y() + 0.03, o.upper_right_m.y() - 0.03));
  }
  return out;
}

TEST(BoardPrediction, IsTheMeanOverTheFootprint) {
  const Target target = circles();
  const BlurredPrint print(target);
  for (const auto& [tilt, roll] :
       {std::pair(0.0, 0.0), std::pair(0.6, 0.2), std::pair(-1.0, 0.1)}) {
    const Rigid3 pose = board_pose(tilt, roll, 3.0);
    const BoardPredictor predictor(print, pose, levels(), beam(false));
    for (const Eigen::Vector2d& p : places(20, 7)) {
      const Eigen::Vector3d direction = towards(pose, p);
      const auto predicted = predictor.predict(direction);
      ASSERT_TRUE(predicted);
      const BruteForce expected = integrate(target, pose, direction, beam(false).blur_rad2);
      EXPECT_NEAR(predicted->intensity, expected.intensity, 1.2e-3 * 108.0) << tilt;
      EXPECT_NEAR(predicted->range_m, expected.range, 5e-5) << tilt;
    }
  }
}

TEST(BoardPrediction, JacobiansAreThoseOfThePrediction) {
  const BlurredPrint print(circles());
  const Rigid3 pose = board_pose(0.5, 0.3, 3.0);
  const BoardPredictor predictor(print, pose, levels(), beam(true));
  for (const Eigen::Vector2d& p : places(150, 11)) {
    const Eigen::Vector3d d = towards(pose, p);
    const auto at = predictor.predict(d);
    ASSERT_TRUE(at);
    for (int k = 0; k < 6; ++k) {
      const double h = 2e-5;
      const Vector6d xi = h * Vector6d::Unit(k);
      const auto up = BoardPredictor(print, se3_exp(xi) * pose, levels(), beam(true)).predict(d);
      const auto down = BoardPredictor(print, se3_exp(-xi) * pose, levels(), beam(true)).predict(d);
      ASSERT_TRUE(up && down);
      // An edge three millimetres wide changes the intensity by 108 over that: 1 % of it.
      const double scale = 108.0 / 0.003 * (k < 3 ? 1.0 : 3.0);
      EXPECT_NEAR(at->intensity_by_pose(k), (up->intensity - down->intensity) / (2 * h),
                  0.01 * scale);
      EXPECT_NEAR(at->range_by_pose(k), (up->range_m - down->range_m) / (2 * h),
                  k < 3 ? 0.03 : 0.09);
    }
    for (int k = 0; k < kLevelParameters; ++k) {
      const double h = 1e-4;
      const auto changed = [&](double by) {
        BoardLevels l = levels();
        (k == 0 ? l.white : k == 1 ? l.black : l.slope(k - 2)) += by;
        return BoardPredictor(print, pose, l, beam(true)).predict(d)->intensity;
      };
      EXPECT_NEAR(at->intensity_by_levels(k), (changed(h) - changed(-h)) / (2 * h), 1e-5);
    }
    for (int k = 0; k < kBlurParameters; ++k) {
      const double h = 2e-8;
      const auto changed = [&](double by) {
        BeamSpread b = beam(true);
        if (k == 0) b.blur_rad2(0, 0) += by;
        if (k == 1) b.blur_rad2(0, 1) += by, b.blur_rad2(1, 0) += by;
        if (k == 2) b.blur_rad2(1, 1) += by;
        return BoardPredictor(print, pose, levels(), b).predict(d)->intensity;
      };
      EXPECT_NEAR(at->intensity_by_blur(k), (changed(h) - changed(-h)) / (2 * h),
                  0.03 * 108.0 / 1e-6);
    }
  }
}

TEST(BoardPrediction, SeesTheFrontOnly) {
  const BlurredPrint print(circles());
  const Rigid3 pose = board_pose(0.2, 0.0, 3.0);
  const BoardPredictor predictor(print, pose, levels(), beam(false));
  EXPECT_TRUE(predictor.predict(Eigen::Vector3d::UnitX()));
  EXPECT_FALSE(predictor.predict(-Eigen::Vector3d::UnitX()));
  // From behind.
  const Rigid3 turned = pose * Rigid3{so3_exp({std::numbers::pi, 0, 0}), {}};
  EXPECT_FALSE(
      BoardPredictor(print, turned, levels(), beam(false)).predict(Eigen::Vector3d::UnitX()));
}

TEST(BoardPrediction, TheDarkerPartOfATiltedFootprintPullsLess) {
  // On a tilted board the spot reaches from near to far; where its near half is black the range is
  // that of the far, white half.
  const Target target = circles();
  const BlurredPrint print(target);
  const Rigid3 pose = board_pose(0.9, 0.0, 3.0);
  const BoardPredictor predictor(print, pose, levels(), beam(false));
  double nearer = 0.0;
  double farther = 0.0;
  for (const Eigen::Vector2d& edge : {Eigen::Vector2d(0.0, 0.06), Eigen::Vector2d(0.12, 0.06)}) {
    const auto p = predictor.predict(towards(pose, edge));
    const double pull = p->range_m - predictor.hit(towards(pose, edge))->range_m;
    nearer = std::min(nearer, pull);
    farther = std::max(farther, pull);
  }
  EXPECT_LT(nearer, -5e-4);
  EXPECT_GT(farther, 5e-4);
}

}  // namespace
}  // namespace lvcalib
