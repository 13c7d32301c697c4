// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/corruption_tools.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>

namespace lvcalib::test {
namespace {
using simulation::SimulatedImage;
using simulation::SimulatedScene;

std::size_t place(const SimulatedImage& image, int x, int y) {
  return static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width_px) +
         static_cast<std::size_t>(x);
}

std::uint8_t grey(double value) {
  return static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0, 255.0)));
}

// Between four pixels; the nearest ones beyond the border.
double between(const SimulatedImage& image, double x, double y) {
  const double cx = std::clamp(x, 0.0, image.width_px - 1.001);
  const double cy = std::clamp(y, 0.0, image.height_px - 1.001);
  const int ix = static_cast<int>(cx);
  const int iy = static_cast<int>(cy);
  const double u = cx - ix;
  const double v = cy - iy;
  const auto at = [&](int i, int j) {
    return static_cast<double>(image.pixels[place(image, ix + i, iy + j)]);
  };
  return (1 - v) * ((1 - u) * at(0, 0) + u * at(1, 0)) + v * ((1 - u) * at(0, 1) + u * at(1, 1));
}

// Where the line of sight through a pixel meets the board.
std::optional<Eigen::Vector2d> board_point(const Camera& camera, const Rigid3& board_from_camera,
                                           double x, double y) {
  const auto ray = camera.unproject({x, y});
  if (!ray) return std::nullopt;
  const Eigen::Vector3d origin = board_from_camera.translation;
  const Eigen::Vector3d direction = board_from_camera.rotation * *ray;
  if (!(direction.z() < -1e-6)) return std::nullopt;
  const Eigen::Vector3d meets = origin - direction * (origin.z() / direction.z());
  return Eigen::Vector2d(meets.head<2>());
}

bool inside(const BoardOutline& outline, const Eigen::Vector2d& p) {
  return (p.array() > outline.lower_left_m.array()).all() &&
         (p.array() < outline.upper_right_m.array()).all();
}

// Calls `change(x, y, point on the board)` for every pixel that shows the board.
void each_board_pixel(const SimulatedScene& scene, const Camera& camera, const Target& target,
                      const std::function<void(int, int, const Eigen::Vector2d&)>& change) {
  const BoardOutline outline = target.outline();
  Eigen::Array2d low(1e9, 1e9);
  Eigen::Array2d high(-1e9, -1e9);
  for (const double u : {outline.lower_left_m.x(), outline.upper_right_m.x()}) {
    for (const double v : {outline.lower_left_m.y(), outline.upper_right_m.y()}) {
      const auto pixel = camera.project(scene.camera_from_board * Eigen::Vector3d(u, v, 0.0));
      if (!pixel) return;
      low = low.min(pixel->array());
      high = high.max(pixel->array());
    }
  }
  const Rigid3 back = scene.camera_from_board.inverse();
  const int right = std::min(scene.image.width_px - 1, static_cast<int>(high.x()) + 3);
  const int bottom = std::min(scene.image.height_px - 1, static_cast<int>(high.y()) + 3);
  for (int y = std::max(0, static_cast<int>(low.y()) - 3); y <= bottom; ++y) {
    for (int x = std::max(0, static_cast<int>(low.x()) - 3); x <= right; ++x) {
      const auto point = board_point(camera, back, x, y);
      if (point && inside(outline, *point)) change(x, y, *point);
    }
  }
}

}  // namespace

SimulatedImage mapped(const SimulatedImage& from, int width, int height,
                      const std::function<std::pair<int, int>(int, int)>& source) {
  SimulatedImage out{width, height, {}};
  out.pixels.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 128);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const auto [sx, sy] = source(x, y);
      if (sx < 0 || sy < 0 || sx >= from.width_px || sy >= from.height_px) continue;
      out.pixels[place(out, x, y)] = from.pixels[place(from, sx, sy)];
    }
  }
  return out;
}

SimulatedImage revalued(const SimulatedImage& from, const std::function<double(double)>& change) {
  SimulatedImage out = from;
  for (std::uint8_t& p : out.pixels) p = grey(change(static_cast<double>(p)));
  return out;
}

SimulatedImage zoomed(const SimulatedImage& from, double factor) {
  SimulatedImage out = from;
  const double cx = 0.5 * (from.width_px - 1);
  const double cy = 0.5 * (from.height_px - 1);
  for (int y = 0; y < from.height_px; ++y) {
    for (int x = 0; x < from.width_px; ++x) {
      out.pixels[place(out, x, y)] =
          grey(between(from, cx + (x - cx) / factor, cy + (y - cy) / factor));
    }
  }
  return out;
}

SimulatedImage blurred(const SimulatedImage& from, double sigma_px) {
  // A box of 2n + 1 pixels has the variance n(n + 1)/3; three of them add up.
  const int half = std::max(
      1, static_cast<int>(std::lround(0.5 * (std::sqrt(1.0 + 4.0 * sigma_px * sigma_px) - 1.0))));
  SimulatedImage out = from;
  for (int pass = 0; pass < 6; ++pass) {
    const SimulatedImage before = out;
    for (int y = 0; y < out.height_px; ++y) {
      for (int x = 0; x < out.width_px; ++x) {
        double sum = 0.0;
        for (int k = -half; k <= half; ++k) {
          const int sx = pass % 2 == 0 ? std::clamp(x + k, 0, out.width_px - 1) : x;
          const int sy = pass % 2 == 0 ? y : std::clamp(y + k, 0, out.height_px - 1);
          sum += static_cast<double>(before.pixels[place(before, sx, sy)]);
        }
        out.pixels[place(out, x, y)] = grey(sum / (2 * half + 1));
      }
    }
  }
  return out;
}

SimulatedImage blocky(const SimulatedImage& from, double step) {
  constexpr int kSide = 8;
  std::array<std::array<double, kSide>, kSide> wave{};
  for (std::size_t f = 0; f < kSide; ++f) {
    for (std::size_t k = 0; k < kSide; ++k) {
      wave[f][k] = (f == 0 ? std::sqrt(1.0 / kSide) : std::sqrt(2.0 / kSide)) *
                   std::cos((static_cast<double>(k) + 0.5) * static_cast<double>(f) *
                            std::numbers::pi / kSide);
    }
  }
  using Block = Eigen::Matrix<double, kSide, kSide>;
  Block basis;
  for (int f = 0; f < kSide; ++f) {
    for (int k = 0; k < kSide; ++k)
      basis(f, k) = wave[static_cast<std::size_t>(f)][static_cast<std::size_t>(k)];
  }
  SimulatedImage out = from;
  for (int top = 0; top + kSide <= from.height_px; top += kSide) {
    for (int left = 0; left + kSide <= from.width_px; left += kSide) {
      Block block;
      for (int y = 0; y < kSide; ++y) {
        for (int x = 0; x < kSide; ++x)
          block(y, x) = static_cast<double>(from.pixels[place(from, left + x, top + y)]);
      }
      Block waves = basis * block * basis.transpose();
      for (int v = 0; v < kSide; ++v) {
        for (int u = 0; u < kSide; ++u) {
          const double q = step * (1.0 + 0.5 * (u + v));
          waves(v, u) = q * std::round(waves(v, u) / q);
        }
      }
      block = basis.transpose() * waves * basis;
      for (int y = 0; y < kSide; ++y) {
        for (int x = 0; x < kSide; ++x)
          out.pixels[place(out, left + x, top + y)] = grey(block(y, x));
      }
    }
  }
  return out;
}

Cloud selected(const Cloud& cloud, const std::function<bool(std::size_t)>& keep) {
  Cloud out;
  for (std::size_t k = 0; k < cloud.size(); ++k) {
    if (!keep(k)) continue;
    out.points_m.push_back(cloud.points_m[k]);
    if (cloud.has_intensity()) out.intensity.push_back(cloud.intensity[k]);
    if (cloud.has_time()) out.time_s.push_back(cloud.time_s[k]);
    if (cloud.has_line()) out.line.push_back(cloud.line[k]);
  }
  return out;
}

std::optional<Eigen::Vector2d> on_board(const SimulatedScene& scene, const Target& target,
                                        const Eigen::Vector3f& point_m) {
  // Six standard deviations of the range noise on black print.
  constexpr double kNear_m = 0.1;
  const Eigen::Vector3d p = scene.lidar_from_board.inverse() * point_m.cast<double>();
  if (std::abs(p.z()) > kNear_m || !inside(target.outline(), p.head<2>())) return std::nullopt;
  return Eigen::Vector2d(p.head<2>());
}

void cover(CorruptedRig& c, std::size_t scene, double share, bool in_cloud, bool in_image) {
  SimulatedScene& s = c.rig.scenes[scene];
  const BoardOutline outline = c.rig.target.outline();
  const double edge = outline.lower_left_m.x() + share * outline.size_m().x();
  if (in_cloud) {
    for (std::size_t k = 0; k < s.cloud.size(); ++k) {
      const auto at = on_board(s, c.rig.target, s.cloud.points_m[k]);
      if (!at || at->x() > edge) continue;
      s.cloud.points_m[k] *= 0.5F;
      if (s.cloud.has_intensity()) s.cloud.intensity[k] = 60.0F;
    }
  }
  if (!in_image) return;
  each_board_pixel(s, c.rig.camera, c.rig.target, [&](int x, int y, const Eigen::Vector2d& p) {
    if (p.x() < edge) s.image.pixels[place(s.image, x, y)] = 90;
  });
}

void reprint(CorruptedRig& c, const PrintSource& source) {
  constexpr double kCell_m = 0.01;
  constexpr std::uint8_t kWhite = 190;
  const Target& target = c.rig.target;
  for (SimulatedScene& scene : c.rig.scenes) {
    const SimulatedImage before = scene.image;
    each_board_pixel(scene, c.rig.camera, target, [&](int x, int y, const Eigen::Vector2d& p) {
      const auto from = source(p);
      const auto pixel = from ? c.rig.camera.project(scene.camera_from_board *
                                                     Eigen::Vector3d(from->x(), from->y(), 0.0))
                              : std::nullopt;
      scene.image.pixels[place(scene.image, x, y)] =
          pixel ? grey(between(before, pixel->x(), pixel->y())) : kWhite;
    });
    if (!scene.cloud.has_intensity()) continue;
    // The return next to where a return's print comes from.
    std::map<std::pair<int, int>, std::vector<std::size_t>> cells;
    std::vector<std::optional<Eigen::Vector2d>> at(scene.cloud.size());
    const auto cell = [](const Eigen::Vector2d& p) {
      return std::pair(static_cast<int>(std::floor(p.x() / kCell_m)),
                       static_cast<int>(std::floor(p.y() / kCell_m)));
    };
    float white = 0.0F;
    for (std::size_t k = 0; k < scene.cloud.size(); ++k) {
      at[k] = on_board(scene, target, scene.cloud.points_m[k]);
      if (!at[k]) continue;
      cells[cell(*at[k])].push_back(k);
      white = std::max(white, scene.cloud.intensity[k]);
    }
    const std::vector<float> intensity = scene.cloud.intensity;
    for (std::size_t k = 0; k < scene.cloud.size(); ++k) {
      if (!at[k]) continue;
      const auto from = source(*at[k]);
      if (!from) {
        scene.cloud.intensity[k] = 0.8F * white;
        continue;
      }
      const auto [i, j] = cell(*from);
      double nearest = 1e9;
      for (int di = -2; di <= 2; ++di) {
        for (int dj = -2; dj <= 2; ++dj) {
          const auto found = cells.find({i + di, j + dj});
          if (found == cells.end()) continue;
          for (const std::size_t other : found->second) {
            const double d = (*at[other] - *from).squaredNorm();
            if (d >= nearest) continue;
            nearest = d;
            scene.cloud.intensity[k] = intensity[other];
          }
        }
      }
    }
  }
}

PrintSource other_tags(const Target& target,
                       std::function<std::pair<int, int>(int column, int row)> other,
                       bool upside_down) {
  return [=](const Eigen::Vector2d& p) -> std::optional<Eigen::Vector2d> {
    const double pitch = target.tag_pitch_m();
    const double size = target.tag_size_m;
    const int column = static_cast<int>(std::floor(p.x() / pitch));
    const int row = static_cast<int>(std::floor(p.y() / pitch));
    if (column < 0 || row < 0 || column >= target.tag_columns || row >= target.tag_rows) return p;
    Eigen::Vector2d within(p.x() - column * pitch, p.y() - row * pitch);
    if (within.x() > size || within.y() > size) return p;
    if (upside_down) within = Eigen::Vector2d(size, size) - within;
    const auto [c, r] = other(column, row);
    return Eigen::Vector2d(c * pitch + within.x(), r * pitch + within.y());
  };
}

void bump(CorruptedRig& c, std::size_t first, const Rigid3& motion, bool only_one) {
  for (std::size_t s = first; s < (only_one ? first + 1 : c.rig.scenes.size()); ++s) {
    for (Eigen::Vector3f& p : c.rig.scenes[s].cloud.points_m)
      p = (motion * p.cast<double>()).cast<float>();
  }
}

std::string rig_text(const Rigid3& pose, double unit) {
  std::string text = "T_camera_lidar: [";
  const Eigen::Matrix4d m = pose.matrix();
  for (int r = 0; r < 4; ++r) {
    text += r == 0 ? "[" : ", [";
    for (int k = 0; k < 4; ++k) {
      const double v = k == 3 && r < 3 ? unit * m(r, k) : m(r, k);
      text += (k == 0 ? "" : ", ") + std::to_string(v);
    }
    text += "]";
  }
  return text + "]\n";
}

}  // namespace lvcalib::test
