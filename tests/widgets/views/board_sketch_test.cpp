// SPDX-License-Identifier: GPL-3.0-or-later
#include "views/board_sketch.h"

#include <numbers>

#include <gtest/gtest.h>

namespace lvcalib::widgets::board_sketch_test {
namespace {

// One pixel of the widget for each of the camera.
Camera camera() {
  Camera out;
  out.width_px = 400;
  out.height_px = 300;
  out.fx = out.fy = 300.0;
  out.cx = 199.5;
  out.cy = 149.5;
  return out;
}

// Facing the camera, its middle on the optical axis, rolled about it.
Rigid3 facing(const Target& target, double distance_m, double roll_rad) {
  Rigid3 out;
  out.rotation = Eigen::Quaterniond(Eigen::AngleAxisd(std::numbers::pi, Eigen::Vector3d::UnitX()) *
                                    Eigen::AngleAxisd(roll_rad, Eigen::Vector3d::UnitZ()));
  const Eigen::Vector2d middle = target.outline().center_m();
  out.translation = Eigen::Vector3d(0.0, 0.0, distance_m) -
                    out.rotation * Eigen::Vector3d(middle.x(), middle.y(), 0.0);
  return out;
}

bool is_mark(const QColor& c) {
  return c.red() > 220 && c.green() > 90 && c.green() < 190 && c.blue() < 90;
}

// Mean place of the upper edge's colour.
QPointF mark_of(const QImage& picture) {
  QPointF sum;
  int count = 0;
  for (int y = 0; y < picture.height(); ++y) {
    for (int x = 0; x < picture.width(); ++x) {
      if (!is_mark(picture.pixelColor(x, y))) continue;
      sum += QPointF(x, y);
      ++count;
    }
  }
  return count == 0 ? QPointF() : sum / count;
}

TEST(BoardSketch, DrawsTheBoardWhereTheCameraWillSeeIt) {
  BoardSketch sketch;
  sketch.resize(404, 304);
  const Target target;
  sketch.setPose(target, camera(), std::nullopt);
  EXPECT_TRUE(sketch.outline().isEmpty());
  EXPECT_TRUE(mark_of(sketch.grab().toImage()).isNull());
  sketch.setPose(target, camera(), facing(target, 3.0, 0.0));
  const QPointF middle = sketch.outline().boundingRect().center();
  EXPECT_NEAR(middle.x(), 199.5, 0.5);
  EXPECT_NEAR(middle.y(), 149.5, 0.5);
  const double width_px = 300.0 * target.outline().size_m().x() / 3.0;
  EXPECT_NEAR(sketch.outline().boundingRect().width(), width_px, 0.5);
  EXPECT_EQ(sketch.shapes(), target.tags().size() + target.nodes().size());
  // The upper edge is above, and turns with the board: counter-clockwise to the left.
  QPointF mark = mark_of(sketch.grab().toImage());
  EXPECT_NEAR(mark.x(), 202.0, 4.0);
  EXPECT_LT(mark.y(), 130.0);
  sketch.setPose(target, camera(), facing(target, 3.0, 0.5 * std::numbers::pi));
  mark = mark_of(sketch.grab().toImage());
  EXPECT_LT(mark.x(), 180.0);
  EXPECT_NEAR(mark.y(), 152.0, 4.0);
  sketch.setTopWord("top");
  EXPECT_LT(mark_of(sketch.grab().toImage()).x(), mark.x());
  sketch.clear();
  EXPECT_EQ(sketch.shapes(), 0U);
}

TEST(BoardSketch, WhatIsBehindTheCameraIsNotDrawn) {
  BoardSketch sketch;
  sketch.resize(404, 304);
  const Target target;
  sketch.setPose(target, camera(), facing(target, -1.0, 0.0));
  EXPECT_TRUE(sketch.outline().isEmpty());
  EXPECT_TRUE(mark_of(sketch.grab().toImage()).isNull());
}

}  // namespace
}  // namespace lvcalib::widgets::board_sketch_test
