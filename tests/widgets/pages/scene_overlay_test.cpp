// SPDX-License-Identifier: GPL-3.0-or-later
#include "pages/scene_overlay.h"

#include <cmath>

#include <gtest/gtest.h>

#include "widgets/support/calibrated_demo.h"

namespace lvcalib::widgets::scene_overlay_test {
namespace {

class SceneOverlayTest : public ::testing::Test {
 protected:
  const CalibrationResult& result_ = *test::calibrated_demo().result;
  const SceneResult& scene_ = result_.scenes[0];
};

TEST_F(SceneOverlayTest, PredictedCornersMissTheDetectedOnesByTheResidual) {
  const ImageOverlay overlay = image_overlay(result_, scene_);
  const SceneSolution* solution = solution_of(result_, scene_.name);
  ASSERT_NE(solution, nullptr);
  ASSERT_EQ(overlay.corners.size(), scene_.view->corners.size());
  double sum_sq = 0.0;
  for (const ImageOverlay::Corner& c : overlay.corners) {
    ASSERT_TRUE(c.has_prediction);
    const QPointF r = c.detected - c.predicted;
    sum_sq += r.x() * r.x() + r.y() * r.y();
    // The prediction is the board of the solution, projected.
    const auto tag = result_.target.tag(c.feature_id);
    const Eigen::Vector2d p =
        result_.target.tag_corners_m(*tag)[static_cast<std::size_t>(c.corner)];
    const auto pixel =
        result_.camera.project(solution->camera_from_board * Eigen::Vector3d(p.x(), p.y(), 0.0));
    ASSERT_TRUE(pixel);
    EXPECT_NEAR(pixel->x(), c.predicted.x(), 1e-6);
    EXPECT_NEAR(pixel->y(), c.predicted.y(), 1e-6);
  }
  EXPECT_GT(sum_sq, 0.0);
}

TEST_F(SceneOverlayTest, CirclesFromTheLidarLieOnThePrintedOnes) {
  const ImageOverlay overlay = image_overlay(result_, scene_);
  ASSERT_EQ(overlay.circles.size(), 9U);
  ASSERT_EQ(overlay.tags.size(), static_cast<std::size_t>(scene_.view->tag_count));
  const SceneSolution* solution = solution_of(result_, scene_.name);
  for (const ImageOverlay::Circle& circle : overlay.circles) {
    const Eigen::Vector2d c = result_.target.nodes()[static_cast<std::size_t>(circle.id)].center_m;
    const auto pixel =
        result_.camera.project(solution->camera_from_board * Eigen::Vector3d(c.x(), c.y(), 0.0));
    ASSERT_TRUE(pixel);
    // A millimetre at two metres is about half a pixel.
    EXPECT_NEAR(circle.center.x(), pixel->x(), 1.5);
    EXPECT_NEAR(circle.center.y(), pixel->y(), 1.5);
    EXPECT_TRUE(circle.edge.containsPoint(circle.center, Qt::OddEvenFill));
  }
}

TEST_F(SceneOverlayTest, LinesOfBothSensorsAgree) {
  const auto lines = cloud_lines(result_, scene_);
  ASSERT_EQ(lines.size(), 20U);  // Outline and nine circles, twice.
  for (std::size_t k = 0; k < lines[0].points_m.size(); ++k) {
    EXPECT_LT((lines[0].points_m[k] - lines[10].points_m[k]).norm(), 0.005);
  }
  SceneResult nothing;
  nothing.name = "nobody";
  EXPECT_TRUE(cloud_lines(result_, nothing).empty());
  EXPECT_TRUE(image_overlay(result_, nothing).corners.empty());
}

// Both sensors show where they look: the boards' points lie within what is drawn of the LiDAR.
TEST_F(SceneOverlayTest, TheLidarsViewIsDrawnLikeTheCameras) {
  const FieldOfView view = field_of_view(scene_.board_points);
  ASSERT_EQ(view.outlines.size(), 1U);
  const auto pyramid = lidar_pyramid(view);
  EXPECT_EQ(pyramid.size(), view.edges.size() + 1);
  EXPECT_EQ(world_lines(result_, view).size(), world_lines(result_).size() + pyramid.size());
  EXPECT_TRUE(pyramid.front().points_m.front().isZero());
  const CloudLine& border = pyramid.back();
  EXPECT_TRUE(border.closed);
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& p : border.points_m) middle += p.normalized();
  middle.normalize();
  double inside = 1.0;
  double outside = 1.0;
  for (const Eigen::Vector3d& p : border.points_m)
    inside = std::min(inside, middle.dot(p.normalized()));
  for (const Eigen::Vector3f& p : scene_.board_points.points_m)
    outside = std::min(outside, middle.dot(p.cast<double>().normalized()));
  EXPECT_LT(std::acos(outside), 1.05 * std::acos(inside));
}

TEST_F(SceneOverlayTest, WhatTheSolveRefusedIsDrawnAsRefused) {
  CalibrationResult result = result_;
  for (SceneSolution& solution : result.extrinsic.scenes) {
    if (solution.name == scene_.name) solution.nodes[4].used = false;
  }
  for (const ImageOverlay::Circle& circle : image_overlay(result, scene_).circles)
    EXPECT_EQ(circle.valid, circle.id != 4);
  const auto before = cloud_lines(result_, scene_);
  const auto lines = cloud_lines(result, scene_);
  int changed = 0;
  for (std::size_t k = 0; k < lines.size(); ++k) changed += lines[k].color != before[k].color;
  EXPECT_EQ(changed, 1);
}

// Where on the board it lies, in the image and in space.
TEST_F(SceneOverlayTest, PartsLeftOutByHandAreDrawnAsSuch) {
  SceneResult scene = scene_;
  const Eigen::Vector2d middle = result_.target.outline().center_m();
  scene.edits.patches_m = {
      {middle, middle + Eigen::Vector2d(0.1, 0.0), middle + Eigen::Vector2d(0.0, 0.1)}};
  const ImageOverlay overlay = image_overlay(result_, scene);
  ASSERT_EQ(overlay.parts.size(), 1U);
  EXPECT_TRUE(overlay.parts[0].left_out);
  EXPECT_FALSE(overlay.parts[0].used);
  ASSERT_EQ(overlay.parts[0].edge.size(), 3);
  const auto pixel = result_.camera.project(
      result_.extrinsic.camera_from_lidar.transform *
      (scene.refinement->lidar_from_board * Eigen::Vector3d(middle.x(), middle.y(), 0.0)));
  ASSERT_TRUE(pixel);
  EXPECT_NEAR(overlay.parts[0].edge[0].x(), pixel->x(), 1e-6);
  EXPECT_EQ(cloud_lines(result_, scene).size(), cloud_lines(result_, scene_).size() + 1);
}

TEST_F(SceneOverlayTest, TheSuggestedBoxHoldsTheBoard) {
  const CropBox box = box_about_board(&result_, &scene_, {});
  for (const CloudLine& line : cloud_lines(result_, scene_)) {
    for (const Eigen::Vector3d& p : line.points_m) EXPECT_TRUE(box.contains(p));
  }
  EXPECT_TRUE(check(box).ok());
  const CropBox fallback = box_about_board(nullptr, nullptr, {1, 2, 3});
  EXPECT_TRUE(fallback.contains({1, 2, 3}));
}

TEST_F(SceneOverlayTest, PointsKeepTheirColours) {
  CloudScene cloud;
  cloud.order = {1, 0, 2};
  cloud.rgb = {1, 2, 3, 4, 5, 6, 7, 8, 9};
  const float nan = std::nanf("");
  cloud.pixels = {{10, 11}, {20, 21}, {nan, nan}};
  ImageOverlay overlay;
  add_points(overlay, cloud);
  ASSERT_EQ(overlay.points.size(), 2U);
  EXPECT_EQ(overlay.points[0], QPointF(20, 21));
  EXPECT_EQ(overlay.point_colors[0], qRgb(1, 2, 3));
  EXPECT_EQ(overlay.point_colors[1], qRgb(4, 5, 6));
}

}  // namespace
}  // namespace lvcalib::widgets::scene_overlay_test
