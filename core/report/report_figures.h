// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

namespace lvcalib {

/// Text that is safe between tags and in attributes.
std::string html_escaped(const std::string& text);

/// A number with `digits` significant digits; "–" for what is not finite.
std::string shown(double value, int digits = 4);

/// A range of values along an axis, with a little room and round ticks.
struct AxisRange {
  double low = 0.0;
  double high = 1.0;
  [[nodiscard]] std::vector<double> ticks() const;
};
AxisRange axis_about(const std::vector<double>& values);

/// A plot of two axes as inline SVG, drawn in data coordinates.
class SvgPlot {
 public:
  SvgPlot(AxisRange x, AxisRange y, std::string x_label, std::string y_label, int width = 420,
          int height = 260);

  void line(const std::vector<Eigen::Vector2d>& points, const std::string& color,
            double width = 1.5);
  void dots(const std::vector<Eigen::Vector2d>& points, const std::string& color,
            double radius = 2.0);
  void bar(double x_low, double x_high, double y, const std::string& color);
  /// A box of five numbers at a place on the x axis.
  void box(double x, double half_width, const std::vector<double>& five, const std::string& color);
  void rect(const Eigen::Vector2d& low, const Eigen::Vector2d& high, const std::string& color,
            const std::string& title);
  /// Names at places on the x axis instead of numbers.
  void x_names(const std::vector<std::pair<double, std::string>>& names);

  [[nodiscard]] std::string svg(const std::string& description) const;

 private:
  [[nodiscard]] double px(double x) const;
  [[nodiscard]] double py(double y) const;

  AxisRange x_, y_;
  std::string x_label_, y_label_;
  int width_, height_;
  std::vector<std::pair<double, std::string>> names_;
  std::string body_;
};

/// A colour between pale and dark blue for 0 … 1.
std::string heat_color(double share);

/// The colours of heat_color() with the numbers they stand for, as inline SVG.
std::string heat_bar(double low, double high, const std::string& unit);

}  // namespace lvcalib
