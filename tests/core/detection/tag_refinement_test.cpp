// SPDX-License-Identifier: GPL-3.0-or-later
#include "detection/tag_refinement.h"

#include <cmath>
#include <functional>
#include <numbers>
#include <utility>

#include <gtest/gtest.h>

#include "base/random.h"
#include "base/statistics.h"
#include "support/rendered_board.h"

namespace lvcalib {
namespace {

Target one_tag(int id, int border_bits = 1) {
  Target target;
  target.type = TargetType::kAprilGrid;
  target.tag_columns = target.tag_rows = 1;
  target.first_tag_id = id;
  target.tag_border_bits = border_bits;
  target.tag_size_m = 0.12;
  return target;
}

Camera distorted(int side_px, double focal_px) {
  Camera camera = testing::pinhole(side_px, side_px, focal_px);
  camera.distortion.head<4>() << -0.3, 0.1, 0.001, -0.001;
  return camera;
}

// Black where any print within a radius is, by trying many places.
std::function<std::optional<double>(const Eigen::Vector2d&)> black_within(double radius_m,
                                                                          const Target& target) {
  return [=](const Eigen::Vector2d& p) -> std::optional<double> {
    constexpr int kDirections = 16;
    for (int k = 0; k < kDirections; ++k) {
      const double angle = 2.0 * std::numbers::pi * k / kDirections;
      const auto at =
          target.albedo(p + radius_m * Eigen::Vector2d(std::cos(angle), std::sin(angle)));
      if (at && *at < 0.5) return 0.0;
    }
    return std::nullopt;
  };
}

struct Measured {
  std::vector<double> outward, errors, normalized;
  int failed = 0;
};

struct Study {
  double side_px = 50;
  int border_bits = 1;
  int tags = 8;
  double start_error_px = 0.4;
  double ink_m = 0.0;  // By which black has grown all around.
  testing::RenderOptions render;
};

// Tags of many ids and attitudes off the middle of a distorted image; errors of all their corners.
Measured measure(const Study& study) {
  Measured out;
  const double focal = 400;
  const double distance = 0.12 * focal / study.side_px;
  Random random(5);
  for (int i = 0; i < study.tags; ++i) {
    const Target target = one_tag(17 * i, study.border_bits);
    const int side = static_cast<int>(2.2 * study.side_px) + 24;
    Camera camera = distorted(side, focal);
    Rigid3 pose = testing::facing_pose(target, distance, random.uniform(-3, 3),
                                       random.uniform(-0.6, 0.6), random.uniform(-0.6, 0.6));
    // A crop near the corner of a larger image, where the distortion bends the edges.
    camera.cx += 120;
    camera.cy -= 90;
    pose.translation += distance * Eigen::Vector3d(-120, 90, 0) / focal * 1.06;
    testing::RenderOptions render = study.render;
    render.seed = 100 + static_cast<unsigned>(i);
    if (study.ink_m > 0.0) render.cover = black_within(study.ink_m, target);
    const GrayImage image = testing::render_board(target, camera, pose, render);
    TagCorners truth, start;
    const auto board = target.tag_corners_m(target.tags()[0]);
    Eigen::Vector2d center = Eigen::Vector2d::Zero();
    for (std::size_t k = 0; k < 4; ++k) {
      truth[k] = *camera.project(pose * Eigen::Vector3d(board[k].x(), board[k].y(), 0));
      const double e = study.start_error_px;
      start[k] = truth[k] + Eigen::Vector2d(random.uniform(-e, e), random.uniform(-e, e));
      center += 0.25 * truth[k];
    }
    const auto fit =
        refine_tag(image, *tag_pattern("tag36h11", 17 * i), study.border_bits, start, &camera, {});
    if (!fit) {
      ++out.failed;
      continue;
    }
    for (std::size_t k = 0; k < 4; ++k) {
      const Eigen::Vector2d error = fit->corners[k] - truth[k];
      out.outward.push_back(error.dot((truth[k] - center).normalized()));
      out.errors.push_back(error.x());
      out.errors.push_back(error.y());
      out.normalized.push_back(error.dot(fit->covariance_px2[k].inverse() * error));
    }
  }
  return out;
}

double mean(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

TEST(TagRefinement, HasNoBiasAndLittleNoise) {
  for (const int border : {1, 2}) {
    Study study;
    study.border_bits = border;
    const Measured result = measure(study);
    EXPECT_EQ(result.failed, 0);
    RecordProperty("outward_px_" + std::to_string(border), std::to_string(mean(result.outward)));
    RecordProperty("rms_px_" + std::to_string(border), std::to_string(rms(result.errors)));
    EXPECT_LT(std::abs(mean(result.outward)), 0.005) << "border " << border;
    EXPECT_LT(rms(result.errors), 0.015) << "border " << border;
  }
}

TEST(TagRefinement, StatedCovarianceIsTrue) {
  Study study;
  study.render.noise = 8.0;
  study.tags = 25;
  const Measured result = measure(study);
  EXPECT_EQ(result.failed, 0);
  // χ² of two degrees of freedom; the mean of 100 has a standard deviation of 0.2 (more, since the
  // corners of a tag are correlated).
  EXPECT_NEAR(mean(result.normalized), 2.0, 0.7);
}

TEST(TagRefinement, CurvedResponseDoesNotMoveTheCorners) {
  Study study;
  study.render.gamma = 0.6;
  study.render.blur_px = 1.2;
  const Measured result = measure(study);
  EXPECT_EQ(result.failed, 0);
  EXPECT_LT(std::abs(mean(result.outward)), 0.02);
}

// A third of a pixel all around, as black as the print of a bad printer gets; also under a blur in
// which both sides of a bit are seen at once.
TEST(TagRefinement, InkThatSpreadsDoesNotMoveTheCorners) {
  for (const auto& [blur_px, most_px] : {std::pair(0.8, 0.002), std::pair(1.4, 0.006)}) {
    Study study;
    study.ink_m = 0.8e-3;
    study.tags = 12;
    study.render.blur_px = blur_px;
    const Measured result = measure(study);
    EXPECT_EQ(result.failed, 0);
    EXPECT_LT(std::abs(mean(result.outward)), most_px) << blur_px;
  }
}

TEST(TagRefinement, WorksWithMuchAndWithoutBlur) {
  for (const double blur : {0.0, 0.4, 2.5}) {
    Study study;
    study.render.blur_px = blur;
    const Measured result = measure(study);
    EXPECT_EQ(result.failed, 0) << blur;
    EXPECT_LT(std::abs(mean(result.outward)), 0.02) << blur;
    EXPECT_LT(rms(result.errors), 0.04) << blur;
  }
}

TEST(TagRefinement, TinyTagsAreRefinedOrRefusedNeverWorsened) {
  for (const double side : {12.0, 16.0, 20.0}) {
    Study study;
    study.side_px = side;
    study.tags = 16;
    const Measured result = measure(study);
    EXPECT_LE(result.failed, 4) << side;
    EXPECT_LT(rms(result.errors), 0.06) << side;
    EXPECT_LT(std::abs(mean(result.outward)), 0.02) << side;
  }
}

TEST(TagRefinement, HiddenPartsDoNotMoveTheRest) {
  Study study;
  study.side_px = 60;
  // A dark bar over a fifth of the tag.
  study.render.cover = [](const Eigen::Vector2d& p) -> std::optional<double> {
    if (p.x() > 0.085 && p.x() < 0.109) return 0.25;
    return std::nullopt;
  };
  const Measured result = measure(study);
  EXPECT_LE(result.failed, 1);
  EXPECT_LT(rms(result.errors), 0.06);
}

TEST(TagRefinement, OtherTagsAndPlainSurfacesAreRefused) {
  const Target target = one_tag(3);
  const Camera camera = testing::pinhole(140, 140, 400);
  const Rigid3 pose = testing::facing_pose(target, 0.8, 0.2, 0.1, 0.1);
  const GrayImage image = testing::render_board(target, camera, pose, {});
  TagCorners corners;
  const auto board = target.tag_corners_m(target.tags()[0]);
  for (std::size_t k = 0; k < 4; ++k) {
    corners[k] = *camera.project(pose * Eigen::Vector3d(board[k].x(), board[k].y(), 0));
  }
  EXPECT_TRUE(refine_tag(image, *tag_pattern("tag36h11", 3), 1, corners, &camera, {}).has_value());
  EXPECT_FALSE(refine_tag(image, *tag_pattern("tag36h11", 4), 1, corners, &camera, {}).has_value());
  GrayImage plain = image;
  std::fill(plain.pixels.begin(), plain.pixels.end(), 90.0F);
  EXPECT_FALSE(refine_tag(plain, *tag_pattern("tag36h11", 3), 1, corners, &camera, {}).has_value());
  TagCorners broken = corners;
  broken[2].x() = std::nan("");
  EXPECT_FALSE(refine_tag(image, *tag_pattern("tag36h11", 3), 1, broken, &camera, {}).has_value());
  broken.fill(corners[0]);
  EXPECT_FALSE(refine_tag(image, *tag_pattern("tag36h11", 3), 1, broken, &camera, {}).has_value());
  broken = corners;
  std::swap(broken[0], broken[2]);
  EXPECT_FALSE(refine_tag(image, *tag_pattern("tag36h11", 3), 1, broken, &camera, {}).has_value());
}

}  // namespace
}  // namespace lvcalib
