// SPDX-License-Identifier: GPL-3.0-or-later
#include "canvas.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>

namespace lvcalib::study {
namespace {

double srgb(double linear) {
  const double x = std::clamp(linear, 0.0, 1.0);
  return x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1.0 / 2.4) - 0.055;
}

// Oklab (Ottosson 2020) to sRGB; colours outside the gamut are clamped.
Color from_oklab(double lightness, double a, double b) {
  const double l = std::pow(lightness + 0.3963377774 * a + 0.2158037573 * b, 3);
  const double m = std::pow(lightness - 0.1055613458 * a - 0.0638541728 * b, 3);
  const double s = std::pow(lightness - 0.0894841775 * a - 1.2914855480 * b, 3);
  return {srgb(4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s),
          srgb(-1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s),
          srgb(-0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s), 1};
}

// Median of a pixel and its neighbours inside the image.
float median_at(const GrayImage& gray, int x, int y) {
  std::array<float, 9> values{};
  std::size_t n = 0;
  for (int v = std::max(0, y - 1); v <= std::min(gray.height_px - 1, y + 1); ++v) {
    for (int u = std::max(0, x - 1); u <= std::min(gray.width_px - 1, x + 1); ++u)
      values[n++] = gray.at(u, v);
  }
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(n / 2);
  std::nth_element(values.begin(), middle, values.begin() + static_cast<std::ptrdiff_t>(n));
  return *middle;
}

}  // namespace

Color scale_color(double x) {
  const double t = std::clamp(x, 0.0, 1.0);
  // Even steps of lightness; the hue turns from violet through blue and green to yellow.
  const double hue = (300.0 - 195.0 * t) * std::numbers::pi / 180.0;
  const double chroma = 0.10 + 0.06 * t;
  return from_oklab(0.34 + 0.56 * t, chroma * std::cos(hue), chroma * std::sin(hue));
}

Canvas::Canvas(const std::filesystem::path& path, int width_px, int height_px) : path_(path) {
  surface_ = cairo_image_surface_create(CAIRO_FORMAT_RGB24, width_px, height_px);
  cairo_ = cairo_create(surface_);
  cairo_set_line_cap(cairo_, CAIRO_LINE_CAP_ROUND);
  cairo_set_line_join(cairo_, CAIRO_LINE_JOIN_ROUND);
  cairo_set_source_rgb(cairo_, 1, 1, 1);
  cairo_paint(cairo_);
}

Canvas::~Canvas() {
  cairo_destroy(cairo_);
  cairo_surface_destroy(surface_);
}

void Canvas::fill(const Color& color) {
  cairo_set_source_rgba(cairo_, color.r, color.g, color.b, color.a);
  cairo_fill(cairo_);
}

void Canvas::stroke(const Color& color, double width_px, double dash_px) {
  cairo_set_source_rgba(cairo_, color.r, color.g, color.b, color.a);
  cairo_set_line_width(cairo_, width_px);
  cairo_set_dash(cairo_, &dash_px, dash_px > 0 ? 1 : 0, 0);
  cairo_stroke(cairo_);
}

void Canvas::line(double x0, double y0, double x1, double y1, const Color& color, double width_px,
                  double dash_px) {
  cairo_new_path(cairo_);
  cairo_move_to(cairo_, x0, y0);
  cairo_line_to(cairo_, x1, y1);
  stroke(color, width_px, dash_px);
}

void Canvas::disc(double x, double y, double radius_px, const Color& color) {
  cairo_new_sub_path(cairo_);
  cairo_arc(cairo_, x, y, radius_px, 0, 2 * std::numbers::pi);
  fill(color);
}

void Canvas::text(double x, double y, const std::string& words, double size_px, Anchor anchor,
                  const Color& color, double angle_rad, bool bold) {
  cairo_select_font_face(cairo_, "DejaVu Sans", CAIRO_FONT_SLANT_NORMAL,
                         bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(cairo_, size_px);
  cairo_text_extents_t extents;
  cairo_text_extents(cairo_, words.c_str(), &extents);
  const double share = anchor == Anchor::kLeft ? 0.0 : anchor == Anchor::kMiddle ? 0.5 : 1.0;
  cairo_save(cairo_);
  cairo_translate(cairo_, x, y);
  cairo_rotate(cairo_, angle_rad);
  cairo_move_to(cairo_, -share * extents.x_advance, 0);
  cairo_set_source_rgba(cairo_, color.r, color.g, color.b, color.a);
  cairo_show_text(cairo_, words.c_str());
  cairo_new_path(cairo_);
  cairo_restore(cairo_);
}

void Canvas::image(const GrayImage& gray, const Eigen::Vector2d& from, const Eigen::Vector2d& size,
                   const Eigen::Vector2d& to, const Eigen::Vector2d& to_size) {
  cairo_surface_t* pixels =
      cairo_image_surface_create(CAIRO_FORMAT_RGB24, gray.width_px, gray.height_px);
  unsigned char* data = cairo_image_surface_get_data(pixels);
  const auto stride = static_cast<std::size_t>(cairo_image_surface_get_stride(pixels));
  for (int y = 0; y < gray.height_px; ++y) {
    auto* row = reinterpret_cast<std::uint32_t*>(data + stride * static_cast<std::size_t>(y));
    for (int x = 0; x < gray.width_px; ++x) {
      const auto level = static_cast<std::uint32_t>(std::clamp(median_at(gray, x, y), 0.F, 255.F));
      row[x] = level * 0x010101U;
    }
  }
  cairo_surface_mark_dirty(pixels);
  cairo_save(cairo_);
  cairo_rectangle(cairo_, to.x(), to.y(), to_size.x(), to_size.y());
  cairo_clip(cairo_);
  cairo_translate(cairo_, to.x(), to.y());
  cairo_scale(cairo_, to_size.x() / size.x(), to_size.y() / size.y());
  cairo_set_source_surface(cairo_, pixels, -from.x(), -from.y());
  cairo_pattern_set_filter(cairo_get_source(cairo_), CAIRO_FILTER_GOOD);
  cairo_paint(cairo_);
  cairo_restore(cairo_);
  cairo_surface_destroy(pixels);
  coarsen(to, to_size);
}

// Noise is what a PNG spends its bytes on: with medians and 32 steps of grey the picture looks the
// same at a third of the size.
void Canvas::coarsen(const Eigen::Vector2d& from, const Eigen::Vector2d& size) {
  cairo_surface_flush(surface_);
  unsigned char* data = cairo_image_surface_get_data(surface_);
  const auto stride = static_cast<std::size_t>(cairo_image_surface_get_stride(surface_));
  const int x1 = std::min(cairo_image_surface_get_width(surface_),
                          static_cast<int>(std::ceil(from.x() + size.x())));
  const int y1 = std::min(cairo_image_surface_get_height(surface_),
                          static_cast<int>(std::ceil(from.y() + size.y())));
  for (int y = std::max(0, static_cast<int>(from.y())); y < y1; ++y) {
    auto* row = reinterpret_cast<std::uint32_t*>(data + stride * static_cast<std::size_t>(y));
    for (int x = std::max(0, static_cast<int>(from.x())); x < x1; ++x)
      row[x] = (row[x] & 0x00F8F8F8U) | ((row[x] >> 5U) & 0x00070707U);
  }
  cairo_surface_mark_dirty(surface_);
}

Status Canvas::save() {
  cairo_status_t status = cairo_status(cairo_);
  if (status == CAIRO_STATUS_SUCCESS) status = cairo_surface_write_to_png(surface_, path_.c_str());
  if (status == CAIRO_STATUS_SUCCESS) return Done{};
  return Error::output(Message("the picture cannot be written: %1", cairo_status_to_string(status)),
                       path_.string());
}

}  // namespace lvcalib::study
