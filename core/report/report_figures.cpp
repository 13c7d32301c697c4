// SPDX-License-Identifier: BSD-3-Clause
#include "report/report_figures.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace lvcalib {
namespace {

constexpr double kLeft = 58.0;
constexpr double kRight = 12.0;
constexpr double kTop = 10.0;
constexpr double kBottom = 44.0;

// Coordinates on the page: a tenth of a pixel is enough.
std::string at(double v) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f", v);
  return text;
}

std::string text_at(double x, double y, const std::string& anchor, const std::string& text,
                    const std::string& more = "") {
  return "<text x=\"" + at(x) + "\" y=\"" + at(y) + "\" text-anchor=\"" + anchor + "\"" + more +
         ">" + html_escaped(text) + "</text>";
}

}  // namespace

std::string html_escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        // Control characters are not allowed in XML.
        out += static_cast<unsigned char>(c) < 0x20 && c != '\n' && c != '\t' ? ' ' : c;
    }
  }
  return out;
}

std::string shown(double value, int digits) {
  if (!std::isfinite(value)) return "–";
  char text[48];
  // 650, not 6.5e+02.
  const double size = std::abs(value);
  if (size >= std::pow(10.0, digits) && size < 1e6) {
    std::snprintf(text, sizeof text, "%.0f", value);
  } else {
    std::snprintf(text, sizeof text, "%.*g", digits, value);
  }
  return text;
}

std::vector<double> AxisRange::ticks() const {
  const double rough = (high - low) / 5.0;
  if (!(rough > 0.0)) return {low};
  const double power = std::pow(10.0, std::floor(std::log10(rough)));
  double step = power;
  for (const double factor : {2.0, 5.0, 10.0}) {
    if (step < rough) step = factor * power;
  }
  std::vector<double> out;
  for (double t = std::ceil(low / step) * step; t <= high + 1e-9 * step; t += step)
    out.push_back(std::abs(t) < 1e-9 * step ? 0.0 : t);
  return out;
}

AxisRange axis_about(const std::vector<double>& values) {
  AxisRange range{HUGE_VAL, -HUGE_VAL};
  for (const double v : values) {
    if (!std::isfinite(v)) continue;
    range.low = std::min(range.low, v);
    range.high = std::max(range.high, v);
  }
  if (range.low > range.high) return {0.0, 1.0};
  const double room = range.high > range.low ? 0.05 * (range.high - range.low)
                                             : std::max(0.5, 0.1 * std::abs(range.high));
  return {range.low - room, range.high + room};
}

SvgPlot::SvgPlot(AxisRange x, AxisRange y, std::string x_label, std::string y_label, int width,
                 int height)
    : x_(x),
      y_(y),
      x_label_(std::move(x_label)),
      y_label_(std::move(y_label)),
      width_(width),
      height_(height) {}

double SvgPlot::px(double x) const {
  return kLeft + (width_ - kLeft - kRight) * (x - x_.low) / (x_.high - x_.low);
}

double SvgPlot::py(double y) const {
  return height_ - kBottom - (height_ - kTop - kBottom) * (y - y_.low) / (y_.high - y_.low);
}

void SvgPlot::line(const std::vector<Eigen::Vector2d>& points, const std::string& color,
                   double width) {
  body_ += "<polyline fill=\"none\" stroke=\"" + color + "\" stroke-width=\"" + at(width) +
           "\" points=\"";
  for (const auto& p : points) body_ += at(px(p.x())) + "," + at(py(p.y())) + " ";
  body_ += "\"/>";
}

void SvgPlot::dots(const std::vector<Eigen::Vector2d>& points, const std::string& color,
                   double radius) {
  body_ += "<g fill=\"" + color + "\">";
  for (const auto& p : points)
    body_ += "<circle cx=\"" + at(px(p.x())) + "\" cy=\"" + at(py(p.y())) + "\" r=\"" + at(radius) +
             "\"/>";
  body_ += "</g>";
}

void SvgPlot::bar(double x_low, double x_high, double y, const std::string& color) {
  rect({x_low, y_.low}, {x_high, y}, color, "");
}

void SvgPlot::rect(const Eigen::Vector2d& low, const Eigen::Vector2d& high,
                   const std::string& color, const std::string& title) {
  body_ += "<rect x=\"" + at(px(low.x())) + "\" y=\"" + at(py(high.y())) + "\" width=\"" +
           at(px(high.x()) - px(low.x())) + "\" height=\"" + at(py(low.y()) - py(high.y())) +
           "\" fill=\"" + color + "\">" +
           (title.empty() ? "" : "<title>" + html_escaped(title) + "</title>") + "</rect>";
}

void SvgPlot::box(double x, double half_width, const std::vector<double>& five,
                  const std::string& color) {
  if (five.size() != 5) return;
  line({{x, five[0]}, {x, five[1]}}, color, 1.0);
  line({{x, five[3]}, {x, five[4]}}, color, 1.0);
  const double a = x - half_width;
  const double b = x + half_width;
  line({{a, five[1]}, {b, five[1]}, {b, five[3]}, {a, five[3]}, {a, five[1]}}, color, 1.2);
  line({{a, five[2]}, {b, five[2]}}, color, 2.4);
}

void SvgPlot::x_names(const std::vector<std::pair<double, std::string>>& names) {
  names_ = names;
}

std::string SvgPlot::svg(const std::string& description) const {
  std::string out = "<svg class=\"plot\" viewBox=\"0 0 " + std::to_string(width_) + " " +
                    std::to_string(height_) + "\" role=\"img\" aria-label=\"" +
                    html_escaped(description) + "\"><g stroke=\"#ddd\" stroke-width=\"0.7\">";
  const double bottom = height_ - kBottom;
  std::string labels;
  for (const double t : y_.ticks()) {
    out += "<path d=\"M" + at(kLeft) + " " + at(py(t)) + "H" + at(width_ - kRight) + "\"/>";
    labels += text_at(kLeft - 5, py(t) + 4, "end", shown(t, 3));
  }
  if (names_.empty()) {
    for (const double t : x_.ticks()) {
      out += "<path d=\"M" + at(px(t)) + " " + at(kTop) + "V" + at(bottom) + "\"/>";
      labels += text_at(px(t), bottom + 15, "middle", shown(t, 3));
    }
  }
  for (const auto& [x, name] : names_) labels += text_at(px(x), bottom + 15, "middle", name);
  out += "</g>" + body_ + "<g font-size=\"11\" fill=\"#333\">" + labels;
  out += text_at(0.5 * (kLeft + width_ - kRight), height_ - 8.0, "middle", x_label_);
  const double middle = 0.5 * (kTop + bottom);
  out +=
      text_at(13, middle, "middle", y_label_, " transform=\"rotate(-90 13 " + at(middle) + ")\"");
  return out + "</g></svg>\n";
}

std::string heat_color(double share) {
  const double s = std::clamp(share, 0.0, 1.0);
  char text[16];
  std::snprintf(text, sizeof text, "#%02x%02x%02x",
                static_cast<unsigned>(std::lround(235 - 215 * s)),
                static_cast<unsigned>(std::lround(243 - 175 * s)),
                static_cast<unsigned>(std::lround(250 - 110 * s)));
  return text;
}

std::string heat_bar(double low, double high, const std::string& unit) {
  constexpr int kSteps = 40;  // Finer steps of this scale cannot be told apart.
  // In units of the picture, which is as wide as a plot (420); the rest is room for the end
  // numbers.
  constexpr double kLeftEnd = 20.0;
  constexpr double kWidth = 380.0;
  std::string out =
      "<svg class=\"plot\" viewBox=\"0 0 420 40\" role=\"img\" aria-label=\"colours, " +
      html_escaped(unit) + "\">";
  for (int k = 0; k < kSteps; ++k) {
    out += "<rect x=\"" + at(kLeftEnd + kWidth * k / kSteps) + "\" y=\"4\" width=\"" +
           at(kWidth / kSteps + 0.3) + "\" height=\"12\" fill=\"" + heat_color((k + 0.5) / kSteps) +
           "\"/>";
  }
  out += "<g font-size=\"11\" fill=\"#333\">";
  for (int k = 0; k <= 4; ++k) {
    out += text_at(kLeftEnd + 0.25 * k * kWidth, 32.0,
                   k == 0   ? "start"
                   : k == 4 ? "end"
                            : "middle",
                   shown(low + 0.25 * k * (high - low), 3) + (k == 4 ? " " + unit : ""));
  }
  return out + "</g></svg>\n";
}

}  // namespace lvcalib
