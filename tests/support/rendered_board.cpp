// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/rendered_board.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>

#include "base/random.h"

namespace lvcalib::testing {
namespace {

// Where the ray through a pixel meets the board's plane, in board coordinates.
std::optional<Eigen::Vector2d> board_point(const Camera& camera, const Rigid3& board_from_camera,
                                           const Eigen::Vector2d& pixel) {
  const auto ray = camera.unproject(pixel);
  if (!ray) return std::nullopt;
  const Eigen::Vector3d direction = board_from_camera.rotation * *ray;
  const double length = -board_from_camera.translation.z() / direction.z();
  if (!(length > 0.0)) return std::nullopt;
  return (board_from_camera.translation + length * direction).head<2>();
}

struct Samples {
  int width = 0;
  int height = 0;
  std::vector<float> values;
  float& at(int x, int y) {
    return values[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                  static_cast<std::size_t>(x)];
  }
};

double light(const Target& target, const RenderOptions& options, const Eigen::Vector2d& point) {
  std::optional<double> albedo = target.albedo(point);
  if (albedo && options.cover) {
    if (const auto covered = options.cover(point)) albedo = covered;
  }
  if (!albedo) return options.background;
  return options.black + (options.white - options.black) * *albedo;
}

// Inside a pixel the map to the board is bilinear to far better than a thousandth of a pixel.
void fill_pixel(const Target& target, const RenderOptions& options, Samples& samples, int x, int y,
                const std::optional<Eigen::Vector2d> (&corner)[4]) {
  const int n = options.samples_per_side;
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) {
      const double s = (i + 0.5) / n;
      const double t = (j + 0.5) / n;
      double value = options.background;
      if (corner[0] && corner[1] && corner[2] && corner[3]) {
        const Eigen::Vector2d point = (1 - s) * (1 - t) * *corner[0] + s * (1 - t) * *corner[1] +
                                      (1 - s) * t * *corner[2] + s * t * *corner[3];
        value = light(target, options, point);
      }
      samples.at(x * n + i, y * n + j) = static_cast<float>(value);
    }
  }
}

Samples sample_board(const Target& target, const Camera& camera, const Rigid3& camera_from_board,
                     const RenderOptions& options) {
  const int n = options.samples_per_side;
  const int width = camera.width_px;
  const int height = camera.height_px;
  Samples out{width * n, height * n, {}};
  out.values.resize(static_cast<std::size_t>(out.width) * static_cast<std::size_t>(out.height));
  const Rigid3 board_from_camera = camera_from_board.inverse();
  std::vector<std::optional<Eigen::Vector2d>> nodes;
  for (int y = 0; y <= height; ++y) {
    for (int x = 0; x <= width; ++x) {
      nodes.push_back(board_point(camera, board_from_camera, {x - 0.5, y - 0.5}));
    }
  }
  const auto node = [&](int x, int y) {
    return nodes[static_cast<std::size_t>(y * (width + 1) + x)];
  };
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      fill_pixel(target, options, out, x, y,
                 {node(x, y), node(x + 1, y), node(x, y + 1), node(x + 1, y + 1)});
    }
  }
  return out;
}

// Gaussian along rows, with the result transposed, so that twice makes the whole.
Samples blurred_transposed(Samples in, double sigma) {
  Samples out{in.height, in.width, std::vector<float>(in.values.size())};
  const int reach = static_cast<int>(std::ceil(4.0 * sigma));
  std::vector<float> kernel;
  double sum = 0.0;
  for (int k = -reach; k <= reach; ++k) {
    kernel.push_back(
        static_cast<float>(sigma > 0.0 ? std::exp(-0.5 * k * k / (sigma * sigma)) : 1));
    sum += kernel.back();
  }
  for (int y = 0; y < in.height; ++y) {
    for (int x = 0; x < in.width; ++x) {
      float value = 0.0F;
      for (int k = -reach; k <= reach; ++k) {
        value += kernel[static_cast<std::size_t>(k + reach)] *
                 in.at(std::clamp(x + k, 0, in.width - 1), y);
      }
      out.at(y, x) = value / static_cast<float>(sum);
    }
  }
  return out;
}

}  // namespace

GrayImage render_board(const Target& target, const Camera& camera, const Rigid3& camera_from_board,
                       const RenderOptions& options) {
  const int n = options.samples_per_side;
  Samples samples = sample_board(target, camera, camera_from_board, options);
  if (options.blur_px > 0.0) {
    const double sigma = options.blur_px * n;
    samples = blurred_transposed(blurred_transposed(std::move(samples), sigma), sigma);
  }
  GrayImage image{camera.width_px, camera.height_px, {}};
  Random random(options.seed);
  for (int y = 0; y < image.height_px; ++y) {
    for (int x = 0; x < image.width_px; ++x) {
      double sum = 0.0;
      for (int j = 0; j < n; ++j) {
        for (int i = 0; i < n; ++i) sum += samples.at(x * n + i, y * n + j);
      }
      const double linear = std::clamp(sum / (n * n) / 255.0, 0.0, 1.0);
      const double value =
          255.0 * std::pow(linear, options.gamma) + random.normal(0, options.noise);
      image.pixels.push_back(static_cast<float>(std::clamp(std::round(value), 0.0, 255.0)));
    }
  }
  return image;
}

Rigid3 facing_pose(const Target& target, double distance_m, double roll_rad, double tilt_rad,
                   double pan_rad) {
  const Eigen::Quaterniond upright(Eigen::AngleAxisd(std::numbers::pi, Eigen::Vector3d::UnitX()));
  const Eigen::Quaterniond turn =
      so3_exp({0, 0, roll_rad}) * so3_exp({tilt_rad, 0, 0}) * so3_exp({0, pan_rad, 0});
  const Eigen::Quaterniond rotation = turn * upright;
  const Eigen::Vector2d center = target.outline().center_m();
  return {rotation, Eigen::Vector3d(0, 0, distance_m) -
                        rotation * Eigen::Vector3d(center.x(), center.y(), 0.0)};
}

Camera pinhole(int width_px, int height_px, double focal_px) {
  Camera camera;
  camera.width_px = width_px;
  camera.height_px = height_px;
  camera.fx = camera.fy = focal_px;
  camera.cx = 0.5 * (width_px - 1);
  camera.cy = 0.5 * (height_px - 1);
  return camera;
}

std::optional<std::filesystem::path> shared_data() {
  const char* set = std::getenv("LVCALIB_SHARED_DATA");
  const std::filesystem::path folder =
      set != nullptr ? std::filesystem::path(set)
                     : std::filesystem::path(LVCALIB_SOURCE_DIR) / "../shared/data";
  std::error_code code;
  if (!std::filesystem::is_directory(folder, code)) return std::nullopt;
  return folder;
}

}  // namespace lvcalib::testing
