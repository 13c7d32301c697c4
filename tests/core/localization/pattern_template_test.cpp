// SPDX-License-Identifier: GPL-3.0-or-later
#include "localization/pattern_template.h"

#include <cmath>

#include <gtest/gtest.h>

#include "base/random.h"
#include "base/statistics.h"

namespace lvcalib {
namespace {

constexpr double kBlur = 0.02;

Eigen::Vector2d random_inside(const Target& target, double margin_m, Random& random) {
  const BoardOutline outline = target.outline();
  const double x =
      random.uniform(outline.lower_left_m.x() + margin_m, outline.upper_right_m.x() - margin_m);
  const double y =
      random.uniform(outline.lower_left_m.y() + margin_m, outline.upper_right_m.y() - margin_m);
  return {x, y};
}

// The albedo under a Gaussian, by direct summation.
double blurred_albedo(const Target& target, const Eigen::Vector2d& at) {
  double sum = 0.0;
  double weight = 0.0;
  constexpr int kSteps = 40;
  for (int i = -kSteps; i <= kSteps; ++i) {
    for (int j = -kSteps; j <= kSteps; ++j) {
      const Eigen::Vector2d d(3.2 * kBlur * i / kSteps, 3.2 * kBlur * j / kSteps);
      const double w = std::exp(-0.5 * d.squaredNorm() / (kBlur * kBlur));
      const auto albedo = target.albedo(at + d);
      if (!albedo) continue;
      sum += w * *albedo;
      weight += w;
    }
  }
  return sum / weight;
}

TEST(PatternTemplate, IsTheBlurredAlbedo) {
  const Target target;
  const PatternTemplate pattern(target, kBlur);
  Random random(1);
  std::vector<double> errors;
  for (int i = 0; i < 300; ++i) {
    const Eigen::Vector2d p = random_inside(target, 3.0 * kBlur, random);
    errors.push_back(pattern.at(p).value - blurred_albedo(target, p));
    // A raster of half the blur and bits as wide as the blur: a few per cent.
    EXPECT_NEAR(errors.back(), 0.0, 0.1) << p.transpose();
  }
  EXPECT_LT(rms(errors), 0.03);
}

TEST(PatternTemplate, GradientIsTheValuesSlope) {
  const Target target;
  const PatternTemplate pattern(target, kBlur);
  Random random(2);
  // Bilinear between raster points: exact within a cell; the few steps across a cell's edge see
  // two slopes.
  constexpr double kStep = 1e-6;
  int across = 0;
  constexpr int kCount = 2000;
  for (int i = 0; i < kCount; ++i) {
    const Eigen::Vector2d p = random_inside(target, kBlur, random);
    const auto sample = pattern.at(p);
    ASSERT_TRUE(sample.inside);
    Eigen::Vector2d slope;
    for (int axis = 0; axis < 2; ++axis) {
      const Eigen::Vector2d d = kStep * Eigen::Vector2d::Unit(axis);
      slope(axis) = (pattern.at(p + d).value - pattern.at(p - d).value) / (2.0 * kStep);
    }
    across += (slope - sample.gradient_per_m).norm() > 1e-4 * (1.0 + slope.norm()) ? 1 : 0;
  }
  EXPECT_LT(across, kCount / 200);
}

TEST(PatternTemplate, BlurKeepsTheMean) {
  const Target target;
  Random random(3);
  double albedo = 0.0;
  double fine = 0.0;
  double coarse = 0.0;
  const PatternTemplate a(target, 0.01);
  const PatternTemplate b(target, 0.03);
  constexpr int kCount = 40'000;
  for (int i = 0; i < kCount; ++i) {
    const Eigen::Vector2d p = random_inside(target, 0.02, random);
    albedo += *target.albedo(p) / kCount;
    fine += a.at(p).value / kCount;
    coarse += b.at(p).value / kCount;
  }
  EXPECT_NEAR(fine, albedo, 0.01);
  EXPECT_NEAR(coarse, albedo, 0.02);
}

TEST(PatternTemplate, QuickValueAgreesAndEndsAtTheOutline) {
  const Target target;
  const PatternTemplate pattern(target, kBlur);
  Random random(4);
  for (int i = 0; i < 500; ++i) {
    const Eigen::Vector2d p = random_inside(target, kBlur, random);
    const float quick = pattern.value(static_cast<float>(p.x()), static_cast<float>(p.y()));
    // Half a raster step aside along both axes, at most.
    const double slack = 0.5 * 0.5 * kBlur * pattern.at(p).gradient_per_m.lpNorm<1>() + 0.05;
    EXPECT_NEAR(quick, pattern.at(p).value, slack);
  }
  const BoardOutline outline = target.outline();
  for (const Eigen::Vector2d& p :
       {Eigen::Vector2d(outline.lower_left_m - Eigen::Vector2d(0.001, 0.0)),
        Eigen::Vector2d(outline.upper_right_m + Eigen::Vector2d(0.0, 0.001)),
        Eigen::Vector2d(std::nan(""), 0.0), Eigen::Vector2d(1e30, 0.0)}) {
    EXPECT_FALSE(pattern.at(p).inside);
    EXPECT_EQ(pattern.value(static_cast<float>(p.x()), static_cast<float>(p.y())), -1.0F);
  }
  EXPECT_EQ(pattern.blur_sigma_m(), kBlur);
}

TEST(PatternTemplate, HugeBoardsStayAffordable) {
  Target target;
  target.tag_size_m = 12.0;
  target.circle_radius_m = 4.5;
  target.margin_m = 6.0;
  const PatternTemplate pattern(target, 0.01);
  EXPECT_TRUE(pattern.at(target.outline().center_m()).inside);
  EXPECT_NEAR(pattern.at(target.nodes()[0].center_m).value, 0.0, 0.01);
}

}  // namespace
}  // namespace lvcalib
