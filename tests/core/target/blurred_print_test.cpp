// SPDX-License-Identifier: GPL-3.0-or-later
// The blurred print against sums over many points of the spot, and its derivatives against
// differences.
#include "target/blurred_print.h"

#include <cmath>
#include <numbers>

#include <Eigen/Cholesky>
#include <gtest/gtest.h>

#include "base/random.h"
#include "support/ordinary_boards.h"

namespace lvcalib {
namespace {

Target circle_grid() {
  Target t;
  t.tag_spacing = 0.1 / 0.12;
  return t;
}

Target squares() {
  Target t;
  t.type = TargetType::kCheckerboard;
  t.corner_columns = 7;
  t.corner_rows = 5;
  t.column_spacing_m = t.row_spacing_m = 0.095;
  t.board_width_m = 0.85;
  t.board_height_m = 0.65;
  return t;
}

// Gaussian points of the plane, spread evenly: Halton's sequence through Box and Muller.
class SpotPoints {
 public:
  explicit SpotPoints(int count) {
    for (int i = 1; i <= count; ++i) {
      const double radius = std::sqrt(-2.0 * std::log(1.0 - halton(i, 2)));
      const double angle = 2.0 * std::numbers::pi * halton(i, 3);
      points_.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
    }
  }
  [[nodiscard]] double white(const Target& target, const Eigen::Vector2d& at,
                             const Eigen::Matrix2d& blur) const {
    const Eigen::Matrix2d root = blur.llt().matrixL();
    double sum = 0.0;
    for (const Eigen::Vector2d& p : points_) sum += target.albedo(at + root * p).value_or(1.0);
    return sum / static_cast<double>(points_.size());
  }

 private:
  static double halton(int i, int base) {
    double f = 1.0;
    double r = 0.0;
    for (; i > 0; i /= base) {
      f /= base;
      r += f * (i % base);
    }
    return r;
  }
  std::vector<Eigen::Vector2d> points_;
};

Eigen::Matrix2d spot(double major, double minor, double angle) {
  const Eigen::Vector2d a(std::cos(angle), std::sin(angle));
  const Eigen::Vector2d b(-a.y(), a.x());
  return major * major * a * a.transpose() + minor * minor * b * b.transpose();
}

struct Case {
  Eigen::Vector2d at;
  Eigen::Matrix2d blur;
};

// Spots from round to six times as long as wide (3 : 1, tilted by 60°), from fine to coarse.
std::vector<Case> cases(const BlurredPrint& print, int count, std::uint64_t seed) {
  Random random(seed);
  std::vector<Case> out;
  const BoardOutline& o = print.outline();
  for (int i = 0; i < count; ++i) {
    const double minor = 0.0015 * std::exp(random.uniform(0.0, 2.2));
    const double ratio = std::exp(random.uniform(0.0, std::log(6.0)));
    out.push_back({{random.uniform(o.lower_left_m.x(), o.upper_right_m.x()),
                    random.uniform(o.lower_left_m.y(), o.upper_right_m.y())},
                   spot(ratio * minor, minor, random.uniform(0.0, 3.2))});
  }
  return out;
}

TEST(BlurredPrint, IsTheMeanOverTheSpot) {
  const SpotPoints points(200'000);
  double worst = 0.0;
  for (const Target& target : {circle_grid(), squares(), test::charuco_target(),
                               test::legacy_charuco_target(), test::single_tag_target()}) {
    const BlurredPrint print(target);
    for (const Case& c : cases(print, 60, 3)) {
      const double expected = points.white(target, c.at, c.blur);
      const double error = std::abs(print.at(c.at, c.blur).white - expected);
      worst = std::max(worst, error);
      EXPECT_LT(error, 1e-3) << c.at.transpose() << "\n" << c.blur;
    }
  }
  RecordProperty("worst", std::to_string(worst));
}

// The coarser samples of plans: each value within what is said, and slopes, which decide what a
// place measures, the same in the mean square to two percent.
TEST(BlurredPrint, ThatOfPlansIsNearlyTheSame) {
  for (const Target& target : {circle_grid(), squares(), test::charuco_target()}) {
    const BlurredPrint fine(target);
    const BlurredPrint plan(target, BlurredPrint::kPlanSpacing);
    double worst = 0.0;
    double fine_sum = 0.0;
    double plan_sum = 0.0;
    for (const Case& c : cases(fine, 400, 5)) {
      const PrintSample a = fine.at(c.at, c.blur);
      const PrintSample b = plan.at(c.at, c.blur);
      worst = std::max(worst, std::abs(a.white - b.white));
      fine_sum += a.gradient_per_m.squaredNorm();
      plan_sum += b.gradient_per_m.squaredNorm();
    }
    EXPECT_LT(worst, 3e-3);
    EXPECT_GT(worst, 2e-5) << "sampled as finely";
    EXPECT_NEAR(plan_sum / fine_sum, 1.0, 0.02);
  }
}

TEST(BlurredPrint, HasItsEdgesWhereTheyAreDrawn) {
  // Crossing of half white along a line over the lowest tag's left edge, x = 0.
  const BlurredPrint print(circle_grid());
  for (const double sigma : {0.0015, 0.0031, 0.0077}) {
    const Eigen::Matrix2d blur = sigma * sigma * Eigen::Matrix2d::Identity();
    double low = -0.005;
    double high = 0.005;
    for (int i = 0; i < 40; ++i) {
      const double middle = 0.5 * (low + high);
      (print.at({middle, 0.06}, blur).white > 0.5 ? low : high) = middle;
    }
    // Other edges of the tag lie 15 mm away; they show in the widest blur.
    EXPECT_NEAR(low, 0.0, sigma < 0.004 ? 3e-6 : 3e-4) << sigma;
  }
}

TEST(BlurredPrint, DerivativesAreThoseOfTheValue) {
  for (const Target& target : {circle_grid(), squares()}) {
    const BlurredPrint print(target);
    for (const Case& c : cases(print, 200, 5)) {
      const PrintSample s = print.at(c.at, c.blur);
      const double sigma =
          std::sqrt(Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(c.blur).eigenvalues()(0));
      const double h = 0.02 * sigma;
      for (int k = 0; k < 2; ++k) {
        const Eigen::Vector2d step = h * Eigen::Vector2d::Unit(k);
        const PrintSample up = print.at(c.at + step, c.blur);
        const PrintSample down = print.at(c.at - step, c.blur);
        EXPECT_NEAR(s.gradient_per_m(k), (up.white - down.white) / (2 * h), 3e-3 / sigma);
        for (int l = 0; l < 2; ++l) {
          EXPECT_NEAR(s.hessian_per_m2(k, l),
                      (up.gradient_per_m(l) - down.gradient_per_m(l)) / (2 * h),
                      4e-2 / (sigma * sigma));
        }
      }
      // ∂A/∂S = ½∇∇ᵀA, along each entry of S.
      const double grow = 0.05 * sigma * sigma;
      for (int k = 0; k < 2; ++k) {
        Eigen::Matrix2d wider = c.blur;
        wider(k, k) += grow;
        const double slope = (print.at(c.at, wider).white - s.white) / grow;
        EXPECT_NEAR(slope, 0.5 * s.hessian_per_m2(k, k), 4e-2 / (sigma * sigma));
      }
    }
  }
}

TEST(BlurredPrint, IsPlainWhereNoEdgeIsNear) {
  const BlurredPrint print(circle_grid());
  const Eigen::Matrix2d blur = 4e-6 * Eigen::Matrix2d::Identity();
  const Eigen::Vector2d middle_of_circle = circle_grid().nodes().front().center_m;
  EXPECT_EQ(print.at(middle_of_circle, blur).white, 0.0);
  EXPECT_EQ(print.at(middle_of_circle, blur).gradient_per_m.norm(), 0.0);
  EXPECT_EQ(print.at({-0.045, -0.045}, blur).white, 1.0);
  // Beyond the outline it goes on white.
  EXPECT_EQ(print.at({-10.0, 3.0}, blur).white, 1.0);
}

TEST(LocalPrint, AnswersForItsNeighbourhoodOnly) {
  const BlurredPrint print{Target{}};
  Random random(5);
  const BoardOutline outline = print.outline();
  int near = 0;
  for (int k = 0; k < 2000; ++k) {
    const Eigen::Vector2d at =
        outline.lower_left_m +
        Eigen::Vector2d(random.uniform(0, 1), random.uniform(0, 1)).cwiseProduct(outline.size_m());
    Eigen::Matrix2d blur;
    const double a = random.uniform(2e-3, 6e-3);
    const double b = random.uniform(2e-3, 6e-3);
    const double c = random.uniform(-0.6, 0.6) * a * b;
    blur << a * a, c, c, b * b;
    const LocalPrint local(at, blur, print.at(at, blur));
    const Eigen::Vector2d there =
        at + random.uniform(0.0, 0.2) * std::sqrt(blur.determinant()) / std::max(a, b) *
                 Eigen::Vector2d(random.normal(), random.normal()).normalized();
    const Eigen::Matrix2d other = blur * random.uniform(0.985, 1.015);
    const auto answer = local.at(there, other);
    if (!answer) continue;
    ++near;
    const PrintSample truth = print.at(there, other);
    // The print's own interpolation misses by as much at either place.
    EXPECT_NEAR(answer->white, truth.white, 1e-3);
    EXPECT_LT((answer->gradient_per_m - truth.gradient_per_m).norm() * std::min(a, b), 0.02);
  }
  EXPECT_GT(near, 300);
  EXPECT_LT(near, 1700);
  EXPECT_FALSE(LocalPrint().at({0.1, 0.1}, Eigen::Matrix2d::Identity()));
}

}  // namespace
}  // namespace lvcalib
