// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/projection_overlay.h"

#include "report/result_comparison.h"
#include "target/wireframe.h"

namespace lvcalib::widgets {
namespace {

// More dots hide the picture, and each other.
constexpr std::size_t kMostPoints = 6000;

QPolygonF projected(const std::vector<Eigen::Vector3d>& points_m, const Camera& camera,
                    const Rigid3& camera_from_lidar) {
  QPolygonF out;
  for (const Eigen::Vector3d& p : points_m) {
    if (const auto pixel = camera.project(camera_from_lidar * p))
      out.push_back(QPointF(pixel->x(), pixel->y()));
  }
  return out;
}

}  // namespace

QColor first_projection_color() {
  return {255, 170, 0};
}

QColor second_projection_color() {
  return {0, 190, 255};
}

ImageOverlay projection_overlay(const CalibrationResult& result, const SceneResult& scene,
                                const Rigid3& first_camera_from_lidar,
                                const Rigid3& second_camera_from_lidar) {
  ImageOverlay out;
  struct Side {
    const Rigid3& camera_from_lidar;
    QColor color;
  };
  const Side sides[] = {{first_camera_from_lidar, first_projection_color()},
                        {second_camera_from_lidar, second_projection_color()}};
  const auto& points = scene.board_points.points_m;
  const std::size_t step = 1 + points.size() / kMostPoints;
  for (std::size_t i = 0; i < points.size(); i += step) {
    // In turns, so that neither side covers the other.
    for (const Side& side : sides) {
      const auto pixel = result.camera.project(side.camera_from_lidar * points[i].cast<double>());
      if (!pixel) continue;
      out.points.emplace_back(pixel->x(), pixel->y());
      out.point_colors.push_back(side.color.rgb());
    }
  }
  if (!scene.refinement) return out;
  const BoardWireframe wire =
      board_wireframe(result.target, scene.refinement->lidar_from_board, 36);
  for (const Side& side : sides) {
    const auto add = [&](const std::vector<Eigen::Vector3d>& shape) {
      out.outlines.push_back(
          {projected(shape, result.camera, side.camera_from_lidar), side.color.rgb()});
    };
    add(wire.outline_m);
    for (const BoardWireframe::Shape& circle : wire.circles) add(circle.points_m);
  }
  const auto shift = board_shift(result, scene, first_camera_from_lidar, second_camera_from_lidar);
  for (std::size_t k = 0; shift && k < shift->first_px.size(); ++k) {
    out.shifts.emplace_back(QPointF(shift->first_px[k].x(), shift->first_px[k].y()),
                            QPointF(shift->second_px[k].x(), shift->second_px[k].y()));
  }
  return out;
}

}  // namespace lvcalib::widgets
