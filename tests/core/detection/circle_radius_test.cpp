// SPDX-License-Identifier: GPL-3.0-or-later
#include "detection/circle_radius.h"

#include <gtest/gtest.h>

#include "support/rendered_board.h"

namespace lvcalib {
namespace {

Target circled_target(double radius_m) {
  Target target;
  target.tag_columns = 3;
  target.tag_rows = 3;
  target.circle_radius_m = radius_m;
  return target;
}

// Whatever blur and tone curve do to edges, they do to all.
TEST(CircleRadius, IsThatOfThePrintWhateverTheTargetSays) {
  const Target printed = circled_target(0.040);
  const Camera camera = testing::pinhole(700, 600, 700);
  const Rigid3 pose = testing::facing_pose(printed, 1.2, 0.2, 0.4, -0.2);
  for (const double gamma : {1.0, 0.45}) {
    testing::RenderOptions render;
    render.samples_per_side = 4;
    render.blur_px = 1.2;
    render.gamma = gamma;
    const GrayImage image = testing::render_board(printed, camera, pose, render);
    for (const double said_m : {0.036, 0.040, 0.044}) {
      const auto found = measure_circle_radius(image, circled_target(said_m), camera, pose);
      EXPECT_NEAR(found.pixel_m, 1.2 / 700, 0.3e-3);
      EXPECT_NEAR(found.radius_m, 0.040, 0.1 * found.pixel_m) << gamma << " " << said_m;
    }
  }
}

// Where tags' borders are blurred away there is no place of an edge to compare with.
TEST(CircleRadius, IsNotMeasuredThroughBlurAsWideAsTheBorders) {
  const Target target = circled_target(0.045);
  const Camera camera = testing::pinhole(700, 600, 700);
  const Rigid3 pose = testing::facing_pose(target, 1.4, 0.1, 0.3, -0.2);
  testing::RenderOptions render;
  render.samples_per_side = 3;
  render.blur_px = 3.0;
  const GrayImage image = testing::render_board(target, camera, pose, render);
  EXPECT_EQ(measure_circle_radius(image, target, camera, pose).radius_m, 0.0);
}

TEST(CircleRadius, IsNotMeasuredWithoutCirclesOrContrast) {
  const Target target = circled_target(0.040);
  const Camera camera = testing::pinhole(700, 600, 700);
  const Rigid3 pose = testing::facing_pose(target, 1.2, 0.0, 0.2, 0.0);
  Target plain = target;
  plain.type = TargetType::kAprilGrid;
  const GrayImage image = testing::render_board(plain, camera, pose, {});
  EXPECT_EQ(measure_circle_radius(image, plain, camera, pose).radius_m, 0.0);
  EXPECT_EQ(measure_circle_radius(image, target, camera, pose).radius_m, 0.0) << "none printed";
}

}  // namespace
}  // namespace lvcalib
