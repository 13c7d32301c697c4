// SPDX-License-Identifier: GPL-3.0-or-later
#include "refinement_figure.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>

#include "canvas.h"

namespace lvcalib::study {
namespace {

constexpr int kPanelWidth = 1200;
constexpr int kPanelHeight = 470;
constexpr double kDegrees = 180.0 / std::numbers::pi;

struct Choice {
  const SceneResult* scene = nullptr;
  std::size_t node = 0;
};

// The node with the largest first correction.
Choice choose_node(const CalibrationResult& result) {
  Choice best;
  double largest = 0.0;
  for (const SceneResult& scene : result.scenes) {
    if (!scene.used || !scene.refinement || scene.refinement->history.size() < 2) continue;
    const auto& first = scene.refinement->history.front().nodes;
    const auto& last = scene.refinement->history.back().nodes;
    for (std::size_t k = 0; k < first.size(); ++k) {
      const double step = first[k].wave_m.head<2>().norm();
      if (!first[k].valid || !last[k].valid || step <= largest) continue;
      largest = step;
      best = {&scene, k};
    }
  }
  return best;
}

/// One diagram: degrees across, millimetres up.
class Plot {
 public:
  Plot(Canvas& canvas, double left, double half_range_mm)
      : canvas_(canvas), left_(left), range_mm_(half_range_mm) {}

  void draw_axes(const std::string& title, bool label_y) {
    canvas_.text(left_, kTop - 20, title, 17, Anchor::kLeft, kInk, 0, true);
    const double step = tick_step();
    for (double mm = -std::floor(range_mm_ / step) * step; mm <= range_mm_ + 1e-9; mm += step) {
      canvas_.line(left_, y(mm), left_ + kPlotWidth, y(mm), kGrid, 1);
      char text[16];
      std::snprintf(text, sizeof text, "%s%.3g", mm < -1e-9 ? "\u2212" : "", std::abs(mm));
      canvas_.text(left_ - 10, y(mm) + 5, text, 14, Anchor::kRight, kSoft);
    }
    for (int degrees = -180; degrees <= 180; degrees += 60) {
      canvas_.line(x(degrees), kTop, x(degrees), kTop + kPlotHeight, kGrid, 1);
      const std::string text =
          (degrees < 0 ? "\u2212" : "") + std::to_string(std::abs(degrees)) + "°";
      canvas_.text(x(degrees), kTop + kPlotHeight + 22, text, 14, Anchor::kMiddle, kSoft);
    }
    canvas_.line(left_, y(0), left_ + kPlotWidth, y(0), kInk, 1.3);
    canvas_.text(left_ + 0.5 * kPlotWidth, kTop + kPlotHeight + 50, "polar angle on the circle", 15,
                 Anchor::kMiddle);
    if (label_y) {
      canvas_.text(left_ - 58, kTop + 0.5 * kPlotHeight, "midpoint of the edge, mm outwards", 15,
                   Anchor::kMiddle, kInk, -0.5 * std::numbers::pi);
    }
  }

  void draw_node(const NodeRecord& node) {
    cairo_t* cairo = canvas_.context();
    for (int degrees = -180; degrees <= 180; degrees += 2) {
      const double a = degrees / kDegrees;
      const double mm =
          1e3 * (node.wave_m.x() * std::cos(a) + node.wave_m.y() * std::sin(a) + node.wave_m.z());
      cairo_line_to(cairo, x(degrees), y(mm));
    }
    canvas_.stroke(kOrange, 2.5);
    for (const BinRecord& bin : node.bins) draw_bin(bin);
  }

 private:
  static constexpr double kTop = 62;
  static constexpr double kPlotHeight = 290;
  static constexpr double kPlotWidth = 495;

  [[nodiscard]] double x(double degrees) const {
    return left_ + kPlotWidth * (degrees + 180.0) / 360.0;
  }
  [[nodiscard]] double y(double mm) const {
    return kTop + kPlotHeight * 0.5 * (1.0 - std::clamp(mm / range_mm_, -1.0, 1.0));
  }
  [[nodiscard]] double tick_step() const {
    const double power = std::pow(10.0, std::floor(std::log10(range_mm_ / 2)));
    for (const double m : {1.0, 2.0, 5.0}) {
      if (range_mm_ / (m * power) <= 5.5) return m * power;
    }
    return 10 * power;
  }

  void draw_bin(const BinRecord& bin) {
    const double at = x(bin.angle_rad * kDegrees);
    // A bin in which no crossing was found has no midpoint to show: a mark on the lower edge.
    if (bin.sigma_m <= 0) {
      canvas_.disc(at, kTop + kPlotHeight, 4, kRefused);
      return;
    }
    const Color color = bin.state == BinState::kUsed ? kBlue : kRefused;
    const double mm = 1e3 * bin.midpoint_m;
    const double sigma = 1e3 * bin.sigma_m;
    canvas_.line(at, y(mm - sigma), at, y(mm + sigma), color, 1.8);
    canvas_.line(at - 4, y(mm - sigma), at + 4, y(mm - sigma), color, 1.8);
    canvas_.line(at - 4, y(mm + sigma), at + 4, y(mm + sigma), color, 1.8);
    canvas_.disc(at, y(mm), 4, color);
  }

  Canvas& canvas_;
  double left_;
  double range_mm_;
};

// Range of the vertical axis that holds the used bins of a node with their bars.
double needed_range_mm(const NodeRecord& node) {
  double largest = 1e3 * (node.wave_m.head<2>().norm() + std::abs(node.wave_m.z()));
  for (const BinRecord& bin : node.bins) {
    if (bin.state == BinState::kUsed)
      largest = std::max(largest, 1e3 * (std::abs(bin.midpoint_m) + bin.sigma_m));
  }
  return largest;
}

bool has_refused_bins(const NodeRecord& node) {
  return std::any_of(node.bins.begin(), node.bins.end(),
                     [](const BinRecord& bin) { return bin.state != BinState::kUsed; });
}

void draw_legend(Canvas& canvas, bool refused) {
  const double y = kPanelHeight - 24;
  const auto entry = [&](double x, const Color& color, const char* words) {
    canvas.line(x, y - 8, x, y + 8, color, 1.8);
    canvas.disc(x, y, 4, color);
    canvas.text(x + 14, y + 5, words, 14, Anchor::kLeft);
  };
  entry(90, kBlue, "angular bin ± one standard deviation");
  if (refused) entry(430, kRefused, "bin refused");
  const double next = refused ? 575 : 430;
  canvas.line(next, y, next + 30, y, kOrange, 2.5);
  canvas.text(next + 40, y + 5, "wave: Δu cos ψ + Δv sin ψ + Δr", 14, Anchor::kLeft);
  canvas.line(next + 330, y, next + 360, y, kInk, 1.3);
  canvas.text(next + 370, y + 5, "printed circle (zero)", 14, Anchor::kLeft);
}

}  // namespace

Status draw_refinement(const CalibrationResult& result, const std::filesystem::path& path) {
  const Choice choice = choose_node(result);
  if (choice.scene == nullptr) return Error::untrusted(Message("no refined node to draw"));
  const auto& history = choice.scene->refinement->history;
  const NodeRecord& first = history.front().nodes[choice.node];
  const NodeRecord& last = history.back().nodes[choice.node];
  const double range = 1.08 * std::max(needed_range_mm(first), needed_range_mm(last));
  Canvas canvas(path, kPanelWidth, kPanelHeight);
  char title[96];
  std::snprintf(title, sizeof title, "First iteration: centre off by %.2f mm",
                1e3 * first.wave_m.head<2>().norm());
  Plot before(canvas, 90, range);
  before.draw_axes(title, true);
  before.draw_node(first);
  std::snprintf(title, sizeof title, "Iteration %zu: centre off by %.2f mm", history.size(),
                1e3 * last.wave_m.head<2>().norm());
  Plot after(canvas, 675, range);
  after.draw_axes(title, false);
  after.draw_node(last);
  draw_legend(canvas, has_refused_bins(first) || has_refused_bins(last));
  return canvas.save();
}

}  // namespace lvcalib::study
