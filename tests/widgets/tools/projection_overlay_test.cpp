// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/projection_overlay.h"

#include <gtest/gtest.h>

#include "widgets/support/calibrated_demo.h"

namespace lvcalib::widgets::projection_overlay_test {
namespace {

TEST(ProjectionOverlay, EitherExtrinsicHasItsColourAndArrowsLeadFromOneToTheOther) {
  const CalibrationResult& result = *test::calibrated_demo().result;
  const SceneResult& scene = result.scenes[0];
  const Rigid3& first = result.extrinsic.camera_from_lidar.transform;
  Rigid3 second = first;
  second.translation.x() += 0.01;  // To the right in the picture.
  const ImageOverlay overlay = projection_overlay(result, scene, first, second);
  ASSERT_EQ(overlay.outlines.size(), 2U * (1U + scene.refinement->nodes.size()));
  EXPECT_EQ(overlay.outlines.front().color, first_projection_color().rgb());
  EXPECT_EQ(overlay.outlines.back().color, second_projection_color().rgb());
  ASSERT_FALSE(overlay.shifts.empty());
  for (const QLineF& shift : overlay.shifts) {
    EXPECT_GT(shift.dx(), 1.0);
    EXPECT_LT(std::abs(shift.dy()), 0.2 * shift.dx());
  }
  ASSERT_EQ(overlay.points.size(), overlay.point_colors.size());
  ASSERT_GT(overlay.points.size(), 2U);
  EXPECT_NE(overlay.point_colors[0], overlay.point_colors[1]);
  EXPECT_GT(overlay.points[1].x(), overlay.points[0].x());
}

TEST(ProjectionOverlay, ASceneThatTheLidarDoesNotHaveIsEmpty) {
  CalibrationResult result;
  result.camera = test::calibrated_demo().result->camera;
  const ImageOverlay overlay = projection_overlay(result, {}, {}, {});
  EXPECT_TRUE(overlay.outlines.empty());
  EXPECT_TRUE(overlay.shifts.empty());
  EXPECT_TRUE(overlay.points.empty());
}

}  // namespace
}  // namespace lvcalib::widgets::projection_overlay_test
