// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

#include <Eigen/Core>
#include <cairo.h>

#include "base/error.h"
#include "detection/board_view.h"

namespace lvcalib::study {

struct Color {
  double r = 0, g = 0, b = 0, a = 1;
};

// One palette for all pictures; readable on white and for colour-blind readers.
inline constexpr Color kInk{0.13, 0.15, 0.18, 1};
inline constexpr Color kSoft{0.42, 0.45, 0.50, 1};
inline constexpr Color kGrid{0.88, 0.89, 0.91, 1};
inline constexpr Color kRefused{0.68, 0.70, 0.73, 1};
inline constexpr Color kBlue{0.10, 0.38, 0.70, 1};
inline constexpr Color kOrange{0.86, 0.36, 0.05, 1};

/// A colour of the scale from dark violet over teal to light yellow whose perceived lightness
/// grows evenly with x = 0…1.
Color scale_color(double x);

enum class Anchor { kLeft, kMiddle, kRight };

/// A PNG picture of fixed size on a white ground.
class Canvas {
 public:
  Canvas(const std::filesystem::path& path, int width_px, int height_px);
  ~Canvas();
  Canvas(const Canvas&) = delete;
  Canvas& operator=(const Canvas&) = delete;

  [[nodiscard]] cairo_t* context() const { return cairo_; }

  void fill(const Color& color);
  void stroke(const Color& color, double width_px, double dash_px = 0.0);
  void line(double x0, double y0, double x1, double y1, const Color& color, double width_px,
            double dash_px = 0.0);
  void disc(double x, double y, double radius_px, const Color& color);
  /// Text with its baseline at y; angle in radians, clockwise.
  void text(double x, double y, const std::string& words, double size_px, Anchor anchor,
            const Color& color = kInk, double angle_rad = 0.0, bool bold = false);
  /// A part of a grey image, scaled to fill a rectangle of the canvas.
  void image(const GrayImage& gray, const Eigen::Vector2d& from, const Eigen::Vector2d& size,
             const Eigen::Vector2d& to, const Eigen::Vector2d& to_size);

  /// Writes the PNG.
  Status save();

 private:
  void coarsen(const Eigen::Vector2d& from, const Eigen::Vector2d& size);

  std::filesystem::path path_;
  cairo_surface_t* surface_ = nullptr;
  cairo_t* cairo_ = nullptr;
};

}  // namespace lvcalib::study
