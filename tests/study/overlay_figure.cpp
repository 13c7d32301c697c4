// SPDX-License-Identifier: GPL-3.0-or-later
#include "overlay_figure.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <optional>
#include <vector>

#include "base/statistics.h"
#include "canvas.h"

namespace lvcalib::study {
namespace {

constexpr int kWidth = 1200;
constexpr int kPicture = 560;  // height of the photograph
constexpr int kLegend = 76;
constexpr double kMargin = 36;

struct Rectangle {
  Eigen::Vector2d from = Eigen::Vector2d::Zero();
  Eigen::Vector2d size = Eigen::Vector2d::Zero();
  [[nodiscard]] Eigen::Vector2d middle() const { return from + 0.5 * size; }
};

/// A part of the camera image on a part of the canvas.
struct Window {
  Rectangle image_px, canvas_px;
  [[nodiscard]] double zoom() const { return canvas_px.size.x() / image_px.size.x(); }
  // Image coordinates have pixel centres at whole numbers, the canvas at halves.
  [[nodiscard]] Eigen::Vector2d operator()(const Eigen::Vector2d& pixel) const {
    return canvas_px.from + zoom() * (pixel + Eigen::Vector2d(0.5, 0.5) - image_px.from);
  }
};

struct Point {
  Eigen::Vector2d pixel;
  double intensity;
};

/// What the overlay shows, in image coordinates.
struct Overlay {
  std::vector<Point> points;
  std::vector<std::vector<Eigen::Vector2d>> circles;
  std::vector<Eigen::Vector2d> centers;
  Rectangle board;
  double low = 0, high = 1;  // intensities at the ends of the colour scale
};

Rectangle bounds_of(const Camera& camera, const Target& target, const Rigid3& camera_from_board) {
  const BoardOutline outline = target.outline();
  Eigen::Vector2d low(1e9, 1e9);
  Eigen::Vector2d high(-1e9, -1e9);
  for (const double x : {outline.lower_left_m.x(), outline.upper_right_m.x()}) {
    for (const double y : {outline.lower_left_m.y(), outline.upper_right_m.y()}) {
      const auto p = camera.project(camera_from_board * Eigen::Vector3d(x, y, 0));
      if (!p) continue;
      low = low.cwiseMin(*p);
      high = high.cwiseMax(*p);
    }
  }
  return {low, (high - low).cwiseMax(1.0)};
}

std::vector<Eigen::Vector2d> circle_in_image(const Camera& camera, const Rigid3& camera_from_board,
                                             const Eigen::Vector2d& center_m, double radius_m) {
  std::vector<Eigen::Vector2d> out;
  for (int k = 0; k < 72; ++k) {
    const double a = 2 * std::numbers::pi * k / 72;
    const Eigen::Vector3d p(center_m.x() + radius_m * std::cos(a),
                            center_m.y() + radius_m * std::sin(a), 0);
    if (const auto pixel = camera.project(camera_from_board * p)) out.push_back(*pixel);
  }
  return out;
}

Overlay collect(const CalibrationResult& result, const SceneResult& scene,
                const SceneSolution& solution) {
  Overlay overlay;
  const Rigid3& camera_from_lidar = result.extrinsic.camera_from_lidar.transform;
  const Rigid3 board_from_camera = solution.camera_from_board.inverse();
  std::vector<double> intensities;
  for (std::size_t i = 0; i < scene.board_points.size(); ++i) {
    const Eigen::Vector3d p =
        camera_from_lidar * scene.board_points.points_m[i].cast<double>().eval();
    const Eigen::Vector3d on_board = board_from_camera * p;
    const auto pixel = result.camera.project(p);
    if (!pixel || !result.target.albedo(on_board.head<2>())) continue;
    const double intensity =
        scene.board_points.has_intensity() ? scene.board_points.intensity[i] : 0;
    overlay.points.push_back({*pixel, intensity});
    intensities.push_back(intensity);
  }
  if (intensities.size() > 10) {
    std::sort(intensities.begin(), intensities.end());
    overlay.low = intensities[intensities.size() / 50];
    overlay.high = std::max(overlay.low + 1e-6, intensities[intensities.size() * 49 / 50]);
  }
  for (const TargetNode& node : result.target.nodes()) {
    overlay.circles.push_back(circle_in_image(result.camera, solution.camera_from_board,
                                              node.center_m, result.target.circle_radius_m));
  }
  for (const RefinedNode& node : scene.refinement->nodes) {
    if (!node.valid) continue;
    if (const auto p = result.camera.project(camera_from_lidar * node.center_lidar_m))
      overlay.centers.push_back(*p);
  }
  overlay.board = bounds_of(result.camera, result.target, solution.camera_from_board);
  return overlay;
}

void mark_center(Canvas& canvas, const Eigen::Vector2d& at, double arm_px) {
  const double width = std::max(1.6, arm_px / 4);
  for (const auto& [color, extra] : {std::pair{Color{1, 1, 1, 1}, 2.0}, std::pair{kOrange, 0.0}}) {
    canvas.line(at.x() - arm_px, at.y(), at.x() + arm_px, at.y(), color, width + extra);
    canvas.line(at.x(), at.y() - arm_px, at.x(), at.y() + arm_px, color, width + extra);
  }
}

void draw_window(Canvas& canvas, const GrayImage& image, const Overlay& overlay,
                 const Window& window, double dot_px, double arm_px) {
  cairo_t* cairo = canvas.context();
  canvas.image(image, window.image_px.from, window.image_px.size, window.canvas_px.from,
               window.canvas_px.size);
  cairo_save(cairo);
  cairo_rectangle(cairo, window.canvas_px.from.x(), window.canvas_px.from.y(),
                  window.canvas_px.size.x(), window.canvas_px.size.y());
  cairo_clip(cairo);
  // Dots of one or two pixels need no smooth edge, which would triple the file.
  cairo_set_antialias(cairo, dot_px < 2 ? CAIRO_ANTIALIAS_NONE : CAIRO_ANTIALIAS_DEFAULT);
  for (const Point& p : overlay.points) {
    const Eigen::Vector2d at = window(p.pixel);
    const double x = (p.intensity - overlay.low) / (overlay.high - overlay.low);
    canvas.disc(at.x(), at.y(), dot_px, scale_color(std::round(8 * x) / 8));
  }
  cairo_set_antialias(cairo, CAIRO_ANTIALIAS_DEFAULT);
  for (const auto& circle : overlay.circles) {
    for (const Eigen::Vector2d& pixel : circle) {
      const Eigen::Vector2d at = window(pixel);
      cairo_line_to(cairo, at.x(), at.y());
    }
    cairo_close_path(cairo);
    cairo_path_t* path = cairo_copy_path(cairo);
    canvas.stroke({1, 1, 1, 1}, arm_px / 2 + 2);
    cairo_append_path(cairo, path);
    canvas.stroke(kOrange, arm_px / 2);
    cairo_path_destroy(path);
  }
  for (const Eigen::Vector2d& center : overlay.centers) mark_center(canvas, window(center), arm_px);
  cairo_restore(cairo);
}

// Part of the image that shows the board at the given place and share of the picture's height.
Rectangle crop_about(const Overlay& overlay, const Camera& camera, double share, double middle_x) {
  const double zoom = std::max(share * kPicture / overlay.board.size.y(),
                               static_cast<double>(kWidth) / camera.width_px);
  Rectangle crop;
  crop.size = Eigen::Vector2d(kWidth, kPicture) / zoom;
  crop.from = overlay.board.middle() - Eigen::Vector2d(middle_x * kWidth, 0.5 * kPicture) / zoom;
  const Eigen::Vector2d most = Eigen::Vector2d(camera.width_px, camera.height_px) - crop.size;
  crop.from = crop.from.cwiseMin(most).cwiseMax(0.0);
  return crop;
}

void draw_inset(Canvas& canvas, const GrayImage& image, const Overlay& overlay,
                const Window& picture) {
  if (overlay.centers.empty()) return;
  // The refined centre nearest to the board's middle.
  const auto nearest = std::min_element(
      overlay.centers.begin(), overlay.centers.end(), [&](const auto& a, const auto& b) {
        return (a - overlay.board.middle()).norm() < (b - overlay.board.middle()).norm();
      });
  const double half = 0.1 * overlay.board.size.y();
  const double side = 330;
  Window inset;
  inset.image_px = {*nearest + Eigen::Vector2d(0.5 - half, 0.5 - half), {2 * half, 2 * half}};
  // On the side where the board leaves more room.
  const bool right = picture(overlay.board.middle()).x() < 0.5 * kWidth;
  inset.canvas_px = {{right ? kWidth - side - kMargin : kMargin, 0.5 * (kPicture - side)},
                     {side, side}};
  // Lines from the enlarged square to the inset.
  const Eigen::Vector2d corner = picture(*nearest - Eigen::Vector2d(half, half));
  const double small = 2 * half * picture.zoom();
  const Eigen::Vector2d to = inset.canvas_px.from;
  const double x0 = corner.x() + (right ? small : 0.0);
  const double x1 = to.x() + (right ? 0.0 : side);
  canvas.line(x0, corner.y(), x1, to.y(), {1, 1, 1, 0.9}, 1.5);
  canvas.line(x0, corner.y() + small, x1, to.y() + side, {1, 1, 1, 0.9}, 1.5);
  cairo_t* cairo = canvas.context();
  cairo_rectangle(cairo, corner.x(), corner.y(), small, small);
  canvas.stroke({1, 1, 1, 1}, 2);
  draw_window(canvas, image, overlay, inset, 3.2, 11);
  cairo_rectangle(cairo, to.x(), to.y(), side, side);
  canvas.stroke({1, 1, 1, 1}, 3);
}

void draw_legend(Canvas& canvas, const Overlay& overlay) {
  const double y = kPicture + 0.5 * kLegend;
  constexpr double kText = 16;
  const double left = kMargin;
  cairo_new_path(canvas.context());
  canvas.text(left, y + 6, "LiDAR intensity", kText, Anchor::kLeft);
  const double bar = left + 150;
  for (int k = 0; k < 160; ++k) {
    cairo_rectangle(canvas.context(), bar + k, y - 9, 1.5, 18);
    canvas.fill(scale_color(k / 159.0));
  }
  char text[32];
  std::snprintf(text, sizeof text, "%.0f", overlay.low);
  canvas.text(bar, y + 27, text, 13, Anchor::kMiddle, kSoft);
  std::snprintf(text, sizeof text, "%.0f", overlay.high);
  canvas.text(bar + 160, y + 27, text, 13, Anchor::kMiddle, kSoft);
  const double circle = 452;
  cairo_new_sub_path(canvas.context());
  cairo_arc(canvas.context(), circle, y, 11, 0, 2 * std::numbers::pi);
  canvas.stroke(kOrange, 3);
  canvas.text(circle + 24, y + 6, "circle as the camera predicts it", kText, Anchor::kLeft);
  const double cross = 826;
  mark_center(canvas, {cross, y}, 10);
  canvas.text(cross + 24, y + 6, "centre as the LiDAR measures it", kText, Anchor::kLeft);
}

}  // namespace

Status draw_overlay(const Dataset& dataset, const CalibrationResult& result,
                    const std::filesystem::path& path) {
  // The scene that shows the board largest.
  const SceneResult* best = nullptr;
  const SceneSolution* best_solution = nullptr;
  double best_area = 0.0;
  for (const SceneResult& scene : result.scenes) {
    for (const SceneSolution& solution : result.extrinsic.scenes) {
      if (solution.name != scene.name || !solution.used || !scene.refinement) continue;
      const double area =
          bounds_of(result.camera, result.target, solution.camera_from_board).size.prod();
      if (area <= best_area) continue;
      best_area = area;
      best = &scene;
      best_solution = &solution;
    }
  }
  if (best == nullptr)
    return Error::untrusted(Message("no used scene to draw"), dataset.path.string());
  const auto files = std::find_if(dataset.scenes.begin(), dataset.scenes.end(),
                                  [&](const SceneFiles& f) { return f.name == best->name; });
  if (files == dataset.scenes.end())
    return Error::input(Message("no such scene: %1", best->name), dataset.path.string());
  const auto image = read_image(files->image);
  if (!image) return image.error();

  const Overlay overlay = collect(result, *best, *best_solution);
  Canvas canvas(path, kWidth, kPicture + kLegend);
  Window picture;
  picture.image_px = crop_about(overlay, result.camera, 0.9, 0.36);
  picture.canvas_px = {{0, 0}, {kWidth, kPicture}};
  draw_window(canvas, *image, overlay, picture, 1.1, 5);
  draw_inset(canvas, *image, overlay, picture);
  draw_legend(canvas, overlay);
  return canvas.save();
}

}  // namespace lvcalib::study
