// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/image_renderer.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include <opencv2/imgproc.hpp>

#include "simulation/disturbances/corner_shift.h"

namespace lvcalib::simulation {
namespace {

constexpr double kAmbient = 0.5;
constexpr double kVignetting = 0.15;  // Loss of light in the image corner.
constexpr int kGrid = 4;              // Spacing of the grid of rays, px: 0.001 px of error at most.
constexpr int kTile = 16;             // Pixels that share the candidates for their rays.
constexpr int kEdgeSamples = 5;       // Along either side of a half pixel that an edge crosses.

// Viewing rays of a camera in the LiDAR frame: solved on a coarse grid, bilinear in between.
class RayGrid {
 public:
  RayGrid(const Camera& camera, const CameraDisturbance& disturbance,
          const Rigid3& camera_from_lidar, std::stop_token stop)
      : columns_((camera.width_px + 2 * kGrid) / kGrid + 2),
        rows_((camera.height_px + 2 * kGrid) / kGrid + 2) {
    const Eigen::Matrix3d lidar_from_camera =
        camera_from_lidar.rotation.toRotationMatrix().transpose();
    rays_.reserve(static_cast<std::size_t>(columns_ * rows_));
    for (int j = 0; j < rows_ && !stop.stop_requested(); ++j) {
      for (int i = 0; i < columns_; ++i) {
        const Eigen::Vector2d pixel((i - 1) * kGrid, (j - 1) * kGrid);
        const auto ray =
            disturbance.bends_rays() ? disturbance.unproject(pixel) : camera.unproject(pixel);
        // No ray: beyond the model's reach, left black.
        rays_.push_back(ray ? Eigen::Vector3d(lidar_from_camera * *ray)
                            : Eigen::Vector3d(Eigen::Vector3d::Constant(NAN)));
      }
    }
  }

  // Unit direction through a pixel position; NaN where the model has none.
  [[nodiscard]] Eigen::Vector3d at(double x, double y) const {
    const double gx = x / kGrid + 1.0;
    const double gy = y / kGrid + 1.0;
    const int i = static_cast<int>(gx);
    const int j = static_cast<int>(gy);
    const double fx = gx - i;
    const double fy = gy - j;
    const Eigen::Vector3d* ray = &rays_[static_cast<std::size_t>(j * columns_ + i)];
    const Eigen::Vector3d blend = (1 - fy) * ((1 - fx) * ray[0] + fx * ray[1]) +
                                  fy * ((1 - fx) * ray[columns_] + fx * ray[columns_ + 1]);
    return blend.normalized();
  }

 private:
  int columns_;
  int rows_;
  std::vector<Eigen::Vector3d> rays_;
};

class Renderer {
 public:
  Renderer(const ImageOptions& options, const Camera& camera, const Rigid3& camera_from_lidar,
           const Room& room, std::stop_token stop, const CameraDisturbance& disturbance)
      : options_(options),
        camera_(camera),
        disturbance_(disturbance),
        camera_from_lidar_(camera_from_lidar),
        caster_(room, camera_from_lidar.inverse().translation),
        rays_(camera, disturbance, camera_from_lidar, stop),
        stop_(std::move(stop)) {
    for (std::size_t i = 0; i < room.surfaces.size(); ++i) {
      const Surface& surface = room.surfaces[i];
      shade_.push_back(shade(surface));
      if (surface.board != nullptr) board_ = static_cast<int>(i);
    }
    if (board_ >= 0) {
      corner_shift_ = CornerShift(board().target(), disturbance_.corner_bias_px(),
                                  [this](const Eigen::Vector2d& point) { return pixel_of(point); });
    }
    const double white = PrintedBoard::kWhite * (board_ >= 0 ? shade_[index(board_)] : 1.0);
    exposure_ = options.white_level / white;
  }

  // Grey values before noise, as 32-bit floats; empty if stopped.
  cv::Mat render() {
    const cv::Rect frame(0, 0, camera_.width_px, camera_.height_px);
    cv::Mat image = sample(frame, 1);
    if (image.empty()) return {};
    blur(image, options_.blur_px);
    const cv::Rect inner = board_rectangle(0);
    if (inner.empty()) return image;
    // Wide enough that the blur of its border does not reach the board.
    const int margin = 4 + static_cast<int>(std::ceil(4.0 * options_.blur_px));
    const cv::Rect outer = board_rectangle(margin);
    cv::Mat fine = sample(outer, 2);
    if (fine.empty()) return {};
    blur(fine, 2.0 * options_.blur_px);
    cv::Mat pixels;
    cv::resize(fine, pixels, outer.size(), 0, 0, cv::INTER_AREA);
    pixels(inner - outer.tl()).copyTo(image(inner));
    return image;
  }

 private:
  static std::size_t index(int i) { return static_cast<std::size_t>(i); }

  [[nodiscard]] const PrintedBoard& board() const {
    return *caster_.room().surfaces[index(board_)].board;
  }

  // Where the calibrated camera has a point of the board.
  [[nodiscard]] std::optional<Eigen::Vector2d> pixel_of(const Eigen::Vector2d& on_board_m) const {
    const Surface& surface = caster_.room().surfaces[index(board_)];
    const Eigen::Vector2d from_center = on_board_m - board().outline().center_m();
    return camera_.project(camera_from_lidar_ * (surface.center_m + from_center.x() * surface.u +
                                                 from_center.y() * surface.v));
  }

  static void blur(cv::Mat& image, double sigma) {
    if (sigma <= 0.0) return;
    const int half = static_cast<int>(std::ceil(4.0 * sigma));
    cv::GaussianBlur(image, image, cv::Size(2 * half + 1, 2 * half + 1), sigma, sigma,
                     cv::BORDER_REPLICATE);
  }

  [[nodiscard]] double shade(const Surface& surface) const {
    Eigen::Vector3d normal = surface.normal();
    const Eigen::Vector3d eye = camera_from_lidar_.inverse().translation;
    if (normal.dot(eye - surface.center_m) < 0.0) normal = -normal;
    return kAmbient + (1.0 - kAmbient) * std::max(0.0, normal.dot(caster_.room().light));
  }

  // Pixels that the board may touch, with a margin that takes in its own blurred edge.
  [[nodiscard]] cv::Rect board_rectangle(int margin) const {
    if (board_ < 0) return {};
    const Surface& board = caster_.room().surfaces[index(board_)];
    Eigen::Array2d low = Eigen::Array2d::Constant(1e9);
    Eigen::Array2d high = -low;
    constexpr int kSteps = 16;
    for (int j = -kSteps; j <= kSteps; ++j) {
      for (int i = -kSteps; i <= kSteps; ++i) {
        const Eigen::Vector3d point = board.center_m + board.half_u_m * i / kSteps * board.u +
                                      board.half_v_m * j / kSteps * board.v;
        const auto pixel = camera_.project(camera_from_lidar_ * point);
        if (!pixel) continue;
        low = low.min(pixel->array());
        high = high.max(pixel->array());
      }
    }
    if (low.x() > high.x()) return {};
    const int border = margin + 3 + static_cast<int>(std::ceil(4.0 * options_.blur_px)) +
                       static_cast<int>(std::ceil(disturbance_.reach_px()));
    const double edge = 1e5;
    const cv::Point first(static_cast<int>(std::clamp(low.x(), -edge, edge)) - border,
                          static_cast<int>(std::clamp(low.y(), -edge, edge)) - border);
    const cv::Point last(static_cast<int>(std::clamp(high.x(), -edge, edge)) + border,
                         static_cast<int>(std::clamp(high.y(), -edge, edge)) + border);
    return cv::Rect(first, last) & cv::Rect(0, 0, camera_.width_px, camera_.height_px);
  }

  // Samples a part of the image with `scale` × `scale` samples a pixel, tile by tile.
  cv::Mat sample(const cv::Rect& part, int scale) {
    cv::Mat out(part.height * scale, part.width * scale, CV_32F);
    for (int y = 0; y < out.rows; y += kTile) {
      if (stop_.stop_requested()) return {};
      for (int x = 0; x < out.cols; x += kTile) {
        const cv::Rect tile(x, y, std::min(kTile, out.cols - x), std::min(kTile, out.rows - y));
        sample_tile(tile, part.tl(), scale, out);
      }
    }
    return out;
  }

  void sample_tile(const cv::Rect& tile, const cv::Point& origin, int scale, cv::Mat& out) {
    const double step = 1.0 / scale;
    // Centre of sample i along an axis; samples of a pixel share its area evenly.
    const auto position = [&](int i, int start) { return start + (i + 0.5) * step - 0.5; };
    const Eigen::Vector3d middle = rays_.at(position(tile.x + tile.width / 2, origin.x),
                                            position(tile.y + tile.height / 2, origin.y));
    const Eigen::Vector3d corner = rays_.at(position(tile.x, origin.x), position(tile.y, origin.y));
    const double angle = std::acos(std::clamp(middle.dot(corner), -1.0, 1.0));
    RayCaster::Candidates storage;
    // Half as much again as the corner's angle covers the other corners under any distortion;
    // a tile at the edge of the lens's reach asks for everything.
    const double margin = std::isfinite(angle) ? 1.5 * angle + 1e-3 : std::numbers::pi;
    const auto candidates = caster_.candidates(middle, margin, storage);
    for (int y = tile.y; y < tile.y + tile.height; ++y) {
      for (int x = tile.x; x < tile.x + tile.width; ++x) {
        const double px = position(x, origin.x);
        const double py = position(y, origin.y);
        const double light = scale == 1 ? radiance(rays_.at(px, py), candidates)
                                        : area_radiance(px, py, step, candidates);
        out.at<float>(y, x) = static_cast<float>(exposure_ * vignetting(px, py) * light);
      }
    }
  }

  [[nodiscard]] double vignetting(double x, double y) const {
    const double dx = x - camera_.cx;
    const double dy = y - camera_.cy;
    const double corner = 0.25 * (static_cast<double>(camera_.width_px) * camera_.width_px +
                                  static_cast<double>(camera_.height_px) * camera_.height_px);
    return 1.0 - kVignetting * (dx * dx + dy * dy) / corner;
  }

  [[nodiscard]] double radiance(const Eigen::Vector3d& ray,
                                std::span<const std::uint8_t> candidates) const {
    const Hit hit = caster_.cast(ray, candidates);
    if (hit.surface < 0) return 0.0;
    if (corner_shift_.active() && hit.surface == board_) {
      const Eigen::Vector2d shown = corner_shift_.shown_at(caster_.on_board(hit));
      return board().reflectivity(shown.x(), shown.y()) * shade_[index(board_)];
    }
    return caster_.reflectivity(hit) * shade_[index(hit.surface)];
  }

  // Mean radiance of a square of side `step` px.
  [[nodiscard]] double area_radiance(double x, double y, double step,
                                     std::span<const std::uint8_t> candidates) const {
    const Eigen::Vector3d ray = rays_.at(x, y);
    if (!board_edge_near(ray, step)) return radiance(ray, candidates);
    double sum = 0.0;
    for (int j = 0; j < kEdgeSamples; ++j) {
      for (int i = 0; i < kEdgeSamples; ++i) {
        const double dx = step * ((i + 0.5) / kEdgeSamples - 0.5);
        const double dy = step * ((j + 0.5) / kEdgeSamples - 0.5);
        sum += radiance(rays_.at(x + dx, y + dy), candidates);
      }
    }
    return sum / (kEdgeSamples * kEdgeSamples);
  }

  // Whether an edge of the print or of the board may cross a square of side `step` px.
  [[nodiscard]] bool board_edge_near(const Eigen::Vector3d& ray, double step) const {
    const Hit hit = caster_.meet_plane(ray, board_);
    if (hit.surface < 0) return false;
    const Surface& board = caster_.room().surfaces[index(board_)];
    // Half a diagonal with room for the lens stretching its corners.
    const double focal = std::min(camera_.fx, camera_.fy);
    const double angle = step / focal;
    const double shift_angle = 1.5 * std::abs(disturbance_.corner_bias_px()) / focal;
    const double reach =
        (0.9 * angle + shift_angle) * hit.range_m / std::max(0.02, hit.cos_incidence);
    if (std::abs(hit.u_m) > board.half_u_m + reach || std::abs(hit.v_m) > board.half_v_m + reach)
      return false;
    const Eigen::Vector2d point = caster_.on_board(hit);
    return board.board->clearance_m(point.x(), point.y()) <= reach;
  }

  const ImageOptions& options_;
  const Camera& camera_;
  const CameraDisturbance& disturbance_;
  CornerShift corner_shift_;
  const Rigid3& camera_from_lidar_;
  RayCaster caster_;
  RayGrid rays_;
  std::stop_token stop_;
  std::vector<double> shade_;
  int board_ = -1;
  double exposure_ = 1.0;
};

void expose(const cv::Mat& image, const ImageOptions& options, Random& random,
            std::vector<std::uint8_t>& pixels) {
  const double electrons_per_grey = options.full_well_e / 255.0;
  pixels.reserve(image.total());
  for (int y = 0; y < image.rows; ++y) {
    for (int x = 0; x < image.cols; ++x) {
      const double grey = image.at<float>(y, x);
      const double shot_variance = std::max(0.0, grey) / electrons_per_grey;
      const double sigma = std::sqrt(shot_variance + options.read_noise * options.read_noise);
      const double value = std::round(grey + sigma * random.normal());
      pixels.push_back(static_cast<std::uint8_t>(std::clamp(value, 0.0, 255.0)));
    }
  }
}

}  // namespace

SimulatedImage photograph(const ImageOptions& options, const PlacedCamera& by, const Room& room,
                          Random random, std::stop_token stop) {
  SimulatedImage image{by.camera.width_px, by.camera.height_px, {}};
  Renderer renderer(options, by.camera, by.camera_from_lidar, room, stop, by.disturbance);
  if (stop.stop_requested()) return image;
  const cv::Mat grey = renderer.render();
  if (grey.empty() || stop.stop_requested()) return image;
  expose(grey, options, random, image.pixels);
  return image;
}

}  // namespace lvcalib::simulation
