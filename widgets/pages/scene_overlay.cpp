// SPDX-License-Identifier: GPL-3.0-or-later
#include "pages/scene_overlay.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "pipeline/refusals.h"
#include "target/wireframe.h"

namespace lvcalib::widgets {
namespace {

// The pyramids of both views, and the LiDAR's axes between them.
constexpr double kPyramid_m = 0.4;

constexpr std::array<double, 3> kLidarColor{1.0, 0.6, 0.0};
constexpr std::array<double, 3> kCameraColor{0.15, 0.55, 1.0};
constexpr std::array<double, 3> kRefusedColor{1.0, 0.2, 0.2};
constexpr std::array<double, 3> kLeftOutColor3d{0.75, 0.43, 1.0};
constexpr std::array<double, 3> kKeptColor{0.15, 0.7, 0.3};

QPointF as_point(const Eigen::Vector2d& p) {
  return {p.x(), p.y()};
}

// Projects a polygon; points that the camera does not image are left out.
QPolygonF projected(const std::vector<Eigen::Vector3d>& points_m, const Camera& camera,
                    const Rigid3& camera_from_points) {
  QPolygonF out;
  for (const Eigen::Vector3d& p : points_m) {
    if (const auto pixel = camera.project(camera_from_points * p)) out.push_back(as_point(*pixel));
  }
  return out;
}

// Residuals by (feature, corner).
std::map<std::pair<int, int>, CornerResidual> residuals_of(const SceneSolution* solution) {
  std::map<std::pair<int, int>, CornerResidual> out;
  if (solution == nullptr) return out;
  for (const CornerResidual& r : solution->corners) out[{r.feature_id, r.corner}] = r;
  return out;
}

void add_corners(ImageOverlay& overlay, const CalibrationResult& result, const SceneResult& scene) {
  const auto residuals = residuals_of(solution_of(result, scene.name));
  for (const CornerObservation& c : scene.view->corners) {
    ImageOverlay::Corner corner;
    corner.feature_id = c.feature_id;
    corner.corner = c.corner;
    corner.detected = as_point(c.pixel);
    const auto known = residuals.find({c.feature_id, c.corner});
    if (known != residuals.end()) {
      corner.predicted = as_point(c.pixel - known->second.residual_px);
      corner.used = known->second.used;
      corner.has_prediction = true;
    } else if (const auto pixel =
                   result.camera.project(scene.view->camera_from_board.transform *
                                         Eigen::Vector3d(c.board_m.x(), c.board_m.y(), 0.0))) {
      // A scene that took no part: the camera's own board pose predicts.
      corner.predicted = as_point(*pixel);
      corner.has_prediction = true;
    }
    overlay.corners.push_back(corner);
  }
}

void add_tags(ImageOverlay& overlay, const CalibrationResult& result) {
  if (!result.target.has_tags()) return;
  std::map<int, ImageOverlay::Tag> tags;
  for (const ImageOverlay::Corner& c : overlay.corners) {
    ImageOverlay::Tag& tag = tags[c.feature_id];
    tag.id = c.feature_id;
    tag.corners.push_back(c.detected);
    tag.used = tag.used && c.used;
  }
  for (auto& [id, tag] : tags) overlay.tags.push_back(std::move(tag));
}

// Tags of which the solve knows nothing: the user left them out, or the program did for good.
void add_unused_tags(ImageOverlay& overlay, const CalibrationResult& result,
                     const std::vector<CornerObservation>& corners, bool left_out) {
  std::map<int, ImageOverlay::Tag> tags;
  for (const CornerObservation& c : corners) {
    ImageOverlay::Tag& tag = tags[c.feature_id];
    tag.id = c.feature_id;
    tag.used = false;
    tag.left_out = left_out;
    tag.corners.push_back(as_point(c.pixel));
  }
  if (!result.target.has_tags()) return;
  for (auto& [id, tag] : tags) overlay.tags.push_back(std::move(tag));
}

// Circles of a scene that the refinement or the solve does not use.
std::set<int> refused_circles(const CalibrationResult& result, const SceneResult& scene) {
  std::set<int> out;
  if (scene.refinement) {
    for (const RefinedNode& node : scene.refinement->nodes) {
      if (!node.valid) out.insert(node.id);
    }
  }
  if (const SceneSolution* solution = solution_of(result, scene.name)) {
    for (const NodeResidual& node : solution->nodes) {
      if (solution->used && !node.used) out.insert(node.id);
    }
  }
  return out;
}

void add_circles(ImageOverlay& overlay, const CalibrationResult& result, const SceneResult& scene) {
  const BoardRefinement& refinement = *scene.refinement;
  const Rigid3& camera_from_lidar = result.extrinsic.camera_from_lidar.transform;
  const BoardWireframe wire = board_wireframe(result.target, refinement.lidar_from_board, 36);
  const std::set<int> refused = refused_circles(result, scene);
  overlay.outline = projected(wire.outline_m, result.camera, camera_from_lidar);
  for (const BoardWireframe::Shape& shape : wire.circles) {
    const auto node = std::find_if(refinement.nodes.begin(), refinement.nodes.end(),
                                   [&](const RefinedNode& n) { return n.id == shape.id; });
    if (node == refinement.nodes.end()) continue;
    const auto center = result.camera.project(
        camera_from_lidar * (node->valid ? node->center_lidar_m : node->raw_lidar_m));
    if (!center) continue;
    overlay.circles.push_back(
        {shape.id, projected(shape.points_m, result.camera, camera_from_lidar), as_point(*center),
         !refused.contains(shape.id), contains_id(scene.edits.circles, shape.id)});
  }
}

void add_parts(ImageOverlay& overlay, const CalibrationResult& result, const SceneResult& scene) {
  const Rigid3 camera_from_board =
      result.extrinsic.camera_from_lidar.transform * scene.refinement->lidar_from_board;
  for (const BoardPart& part : board_parts(result, scene)) {
    std::vector<Eigen::Vector3d> corners;
    for (const Eigen::Vector2d& p : part.edge_m) corners.emplace_back(p.x(), p.y(), 0.0);
    overlay.parts.push_back({projected(corners, result.camera, camera_from_board),
                             part.use == BoardPart::Use::kKept,
                             part.use == BoardPart::Use::kByHand});
  }
}

std::vector<CloudLine> lidar_axes(double length_m) {
  const Eigen::Vector3d o = Eigen::Vector3d::Zero();
  return {{{o, length_m * Eigen::Vector3d::UnitX()}, {0.9, 0.15, 0.15}, false},
          {{o, length_m * Eigen::Vector3d::UnitY()}, {0.1, 0.65, 0.1}, false},
          {{o, length_m * Eigen::Vector3d::UnitZ()}, {0.2, 0.35, 1.0}, false}};
}

void add_board(std::vector<CloudLine>& lines, const Target& target, const Rigid3& lidar_from_board,
               const std::array<double, 3>& color, CloudLineWidth width,
               const std::set<int>& refused = {}) {
  const BoardWireframe wire = board_wireframe(target, lidar_from_board);
  lines.push_back({wire.outline_m, color, true, width});
  for (const BoardWireframe::Shape& circle : wire.circles) {
    lines.push_back(
        {circle.points_m, refused.contains(circle.id) ? kRefusedColor : color, true, width});
  }
}

}  // namespace

bool has_extrinsic(const CalibrationResult& result) {
  return result.extrinsic.used_scenes > 0 &&
         result.extrinsic.camera_from_lidar.transform.translation.allFinite();
}

std::vector<BoardPart> board_parts(const CalibrationResult& result, const SceneResult& scene) {
  std::vector<BoardPart> out;
  // First: in what is refused as well, it is what can be taken back.
  for (const auto& patch : scene.edits.patches_m) out.push_back({patch, BoardPart::Use::kByHand});
  for (const Refusal& refusal : refusals(result)) {
    if (refusal.scene != scene.name || refusal.what != Refusal::What::kPatch) continue;
    const BoardOutline board{refusal.board_m.min(), refusal.board_m.max()};
    out.push_back({board.corners_m(), BoardPart::Use::kRefused, refusal.points, refusal.reason});
  }
  for (const BoardOutline& kept : scene.edits.kept_patches)
    out.push_back({kept.corners_m(), BoardPart::Use::kKept});
  return out;
}

ImageOverlay image_overlay(const CalibrationResult& result, const SceneResult& scene) {
  ImageOverlay overlay;
  if (scene.view) {
    add_corners(overlay, result, scene);
    add_tags(overlay, result);
    add_unused_tags(overlay, result, scene.left_out_corners, true);
    add_unused_tags(overlay, result, scene.refused_corners, false);
  }
  if (scene.refinement && has_extrinsic(result)) {
    add_circles(overlay, result, scene);
    add_parts(overlay, result, scene);
  }
  return overlay;
}

UnusedPoints unused_points(const CalibrationResult& result, const SceneResult& scene) {
  UnusedPoints out;
  out.left_out_m = scene.left_out_points.points_m;
  const auto index = static_cast<std::size_t>(&scene - result.scenes.data());
  for (const std::uint32_t i : refused_returns(result, index))
    out.refused_m.push_back(scene.board_points.points_m[i]);
  return out;
}

void add_unused(ImageOverlay& overlay, const CalibrationResult& result,
                const UnusedPoints& points) {
  if (!has_extrinsic(result)) return;
  const Rigid3& camera_from_lidar = result.extrinsic.camera_from_lidar.transform;
  const auto add = [&](const std::vector<Eigen::Vector3f>& from, std::vector<QPointF>& to) {
    to.clear();
    for (const Eigen::Vector3f& p : from) {
      if (const auto pixel = result.camera.project(camera_from_lidar * p.cast<double>()))
        to.push_back(as_point(*pixel));
    }
  };
  add(points.refused_m, overlay.refused_points);
  add(points.left_out_m, overlay.left_out_points);
}

std::vector<CloudLine> unused_marks(const UnusedPoints& points) {
  constexpr double kHalf = 0.0012;  // Of the range.
  constexpr std::size_t kMost = 5000;
  std::vector<CloudLine> lines;
  const auto add = [&](const std::vector<Eigen::Vector3f>& from,
                       const std::array<double, 3>& color) {
    const std::size_t step = 1 + from.size() / kMost;
    for (std::size_t i = 0; i < from.size(); i += step) {
      const Eigen::Vector3d p = from[i].cast<double>();
      const Eigen::Vector3d side = p.unitOrthogonal() * kHalf * p.norm();
      const Eigen::Vector3d other = p.normalized().cross(side);
      lines.push_back({{p - side - other, p + side + other}, color, false, CloudLineWidth::kHair});
      lines.push_back({{p - side + other, p + side - other}, color, false, CloudLineWidth::kHair});
    }
  };
  add(points.refused_m, kRefusedColor);
  add(points.left_out_m, kLeftOutColor3d);
  return lines;
}

void add_points(ImageOverlay& overlay, const CloudScene& cloud) {
  overlay.points.clear();
  overlay.point_colors.clear();
  if (cloud.pixels.empty()) return;
  // The beginning of the order is a fair thinning; more dots than this cannot be told apart.
  constexpr std::size_t kMost = 150'000;
  const std::size_t count = std::min(cloud.size(), kMost);
  for (std::size_t k = 0; k < count; ++k) {
    const Eigen::Vector2f& pixel = cloud.pixels[cloud.order[k]];
    if (!std::isfinite(pixel.x())) continue;
    overlay.points.emplace_back(static_cast<double>(pixel.x()), static_cast<double>(pixel.y()));
    overlay.point_colors.push_back(
        qRgb(cloud.rgb[3 * k], cloud.rgb[3 * k + 1], cloud.rgb[3 * k + 2]));
  }
}

std::vector<CloudLine> cloud_lines(const CalibrationResult& result, const SceneResult& scene) {
  std::vector<CloudLine> lines;
  const SceneSolution* solution = solution_of(result, scene.name);
  if (solution != nullptr && has_extrinsic(result)) {
    const Rigid3 lidar_from_board =
        result.extrinsic.camera_from_lidar.transform.inverse() * solution->camera_from_board;
    add_board(lines, result.target, lidar_from_board, kCameraColor, CloudLineWidth::kUsual);
  }
  if (scene.refinement) {
    add_board(lines, result.target, scene.refinement->lidar_from_board, kLidarColor,
              CloudLineWidth::kBroad, refused_circles(result, scene));
    for (const BoardPart& part : board_parts(result, scene)) {
      CloudLine line{{},
                     part.use == BoardPart::Use::kKept      ? kKeptColor
                     : part.use == BoardPart::Use::kRefused ? kRefusedColor
                                                            : kLeftOutColor3d,
                     true};
      for (const Eigen::Vector2d& p : part.edge_m)
        line.points_m.emplace_back(scene.refinement->lidar_from_board *
                                   Eigen::Vector3d(p.x(), p.y(), 0.0));
      lines.push_back(std::move(line));
    }
  }
  return lines;
}

Cloud all_boards(const CalibrationResult& result) {
  Cloud out;
  const bool intensity =
      std::all_of(result.scenes.begin(), result.scenes.end(), [](const SceneResult& s) {
        return s.board_points.size() == 0 || s.board_points.has_intensity();
      });
  for (std::size_t s = 0; s < result.scenes.size(); ++s) {
    const Cloud& board = result.scenes[s].board_points;
    out.points_m.insert(out.points_m.end(), board.points_m.begin(), board.points_m.end());
    out.line.insert(out.line.end(), board.size(), static_cast<std::uint16_t>(s + 1));
    if (intensity)
      out.intensity.insert(out.intensity.end(), board.intensity.begin(), board.intensity.end());
  }
  return out;
}

std::vector<Eigen::Vector3d> camera_pyramid(const CalibrationResult& result) {
  const Rigid3 lidar_from_camera = result.extrinsic.camera_from_lidar.transform.inverse();
  const double right = result.camera.width_px - 0.5;
  const double bottom = result.camera.height_px - 0.5;
  std::vector<Eigen::Vector3d> out = {lidar_from_camera.translation};
  for (const Eigen::Vector2d& pixel :
       {Eigen::Vector2d(-0.5, -0.5), Eigen::Vector2d(right, -0.5), Eigen::Vector2d(right, bottom),
        Eigen::Vector2d(-0.5, bottom)}) {
    const auto ray = result.camera.unproject(pixel);
    if (ray) out.emplace_back(lidar_from_camera * Eigen::Vector3d(kPyramid_m * *ray));
  }
  return out;
}

std::vector<CloudLine> lidar_pyramid(const FieldOfView& view) {
  std::vector<CloudLine> lines;
  for (const Eigen::Vector3d& edge : view.edges)
    lines.push_back({{Eigen::Vector3d::Zero(), kPyramid_m * edge}, kLidarColor, false});
  for (const std::vector<Eigen::Vector3d>& border : view.outlines) {
    CloudLine& line = lines.emplace_back(CloudLine{{}, kLidarColor, true});
    for (const Eigen::Vector3d& d : border) line.points_m.push_back(kPyramid_m * d);
  }
  return lines;
}

std::vector<CloudLine> world_lines(const CalibrationResult& result, const FieldOfView& lidar) {
  std::vector<CloudLine> lines = lidar_axes(kPyramid_m);
  for (CloudLine& line : lidar_pyramid(lidar)) lines.push_back(std::move(line));
  for (const SceneResult& scene : result.scenes) {
    for (CloudLine& line : cloud_lines(result, scene)) lines.push_back(std::move(line));
  }
  if (!has_extrinsic(result)) return lines;
  const auto pyramid = camera_pyramid(result);
  for (std::size_t k = 1; k < pyramid.size(); ++k)
    lines.push_back({{pyramid[0], pyramid[k]}, kCameraColor, false});
  if (pyramid.size() > 2)
    lines.push_back({{pyramid.begin() + 1, pyramid.end()}, kCameraColor, true});
  return lines;
}

std::vector<CloudLine> axes_and_grid(const Eigen::Vector3d& low_m, const Eigen::Vector3d& high_m) {
  std::vector<CloudLine> lines = lidar_axes(1.0);
  constexpr double kMostLines = 40.0;
  const double reach = std::max(high_m.x() - low_m.x(), high_m.y() - low_m.y());
  if (!(reach > 0.0) || !std::isfinite(reach)) return lines;
  double step = 1.0;
  while (reach / step > kMostLines) step *= 10.0;
  const Eigen::Vector2d low = step * (low_m.head<2>() / step).array().floor();
  const Eigen::Vector2d high = step * (high_m.head<2>() / step).array().ceil();
  const std::array<double, 3> gray{0.5, 0.5, 0.5};
  for (double x = low.x(); x <= high.x() + 0.5 * step; x += step)
    lines.push_back({{{x, low.y(), low_m.z()}, {x, high.y(), low_m.z()}}, gray, false});
  for (double y = low.y(); y <= high.y() + 0.5 * step; y += step)
    lines.push_back({{{low.x(), y, low_m.z()}, {high.x(), y, low_m.z()}}, gray, false});
  return lines;
}

CropBox box_about_board(const CalibrationResult* result, const SceneResult* scene,
                        const Eigen::Vector3d& fallback_m) {
  CropBox box;
  if (result == nullptr || scene == nullptr || !scene->refinement) {
    box.center_m = fallback_m;
    box.half_size_m.setConstant(0.75);
    return box;
  }
  const Rigid3& lidar_from_board = scene->refinement->lidar_from_board;
  const BoardOutline outline = result->target.outline();
  const Eigen::Vector2d middle = outline.center_m();
  const Eigen::Vector2d size = outline.size_m();
  box.center_m = lidar_from_board * Eigen::Vector3d(middle.x(), middle.y(), 0.0);
  box.half_size_m = {0.6 * size.x(), 0.6 * size.y(), 0.25 * size.minCoeff()};
  box.rotation = lidar_from_board.rotation;
  return box;
}

}  // namespace lvcalib::widgets
