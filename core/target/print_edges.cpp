// SPDX-License-Identifier: BSD-3-Clause
#include "target/print_edges.h"

#include <algorithm>
#include <cmath>

#include "base/statistics.h"

namespace lvcalib {
namespace {

constexpr double kCell = 0.03;
// Edges farther than this are beyond four widths of any spot that still tells edges of bits apart.
constexpr double kFar = 0.08;
constexpr double kReach = 4.0;  // Widths beyond which an edge is not asked.

// I₀(x)·exp(−x), by Abramowitz and Stegun 9.8.1 and 9.8.2 (to 2·10⁻⁷).
double scaled_bessel_0(double x) {
  if (x < 3.75) {
    const double t = (x / 3.75) * (x / 3.75);
    return std::exp(-x) *
           (1.0 + t * (3.5156229 +
                       t * (3.0899424 +
                            t * (1.2067492 + t * (0.2659732 + t * (0.0360768 + t * 0.0045813))))));
  }
  const double t = 3.75 / x;
  return (0.39894228 +
          t * (0.01328592 +
               t * (0.00225319 +
                    t * (-0.00157565 +
                         t * (0.00916281 +
                              t * (-0.02057706 +
                                   t * (0.02635537 + t * (-0.01647633 + t * 0.00392377)))))))) /
         std::sqrt(x);
}

}  // namespace

PrintEdges::PrintEdges(const Target& t) {
  if (t.has_squares()) {
    // From the outer white to the outer white: one more square on every side.
    const Eigen::Vector2d cell(t.column_spacing_m, t.row_spacing_m);
    const auto black = [&](int column, int row) {
      const int c = column - 1;
      const int r = row - 1;
      return c >= -1 && r >= -1 && c < t.corner_columns && r < t.corner_rows &&
             t.square_is_black(c, r);
    };
    add_grid(-2.0 * cell, cell, t.corner_columns + 3, t.corner_rows + 3,
             [&](int c, int r) { return black(c - 1, r - 1); });
  }
  const double bit = t.has_tags() ? t.tag_bit_m() : 0.0;
  for (const TargetTag& tag : t.tags()) {
    const int side = static_cast<int>(std::lround(t.tag_size_m / bit));
    const Eigen::Vector2d lower_left =
        tag.center_m - 0.5 * t.tag_size_m * Eigen::Vector2d(1.0, 1.0);
    const TagPattern* pattern = tag_pattern(t.tag_family, tag.id);
    add_grid(lower_left, {bit, bit}, side, side, [&](int c, int r) {
      if (c < 0 || r < 0 || c >= side || r >= side) return false;
      const int column = c - t.tag_border_bits;
      const int row = side - 1 - r - t.tag_border_bits;
      const bool inside = pattern != nullptr && column >= 0 && row >= 0 &&
                          column < pattern->width && row < pattern->width;
      return !(inside && pattern->at(row, column));
    });
  }
  for (const TargetNode& node : t.nodes()) circles_.push_back(node.center_m);
  radius_m_ = t.circle_radius_m;
  fill_cells(t.outline());
}

// Edges of a grid of cells whose surroundings are white; runs along one line are one segment.
template <class IsBlack>
void PrintEdges::add_grid(const Eigen::Vector2d& origin, const Eigen::Vector2d& cell, int columns,
                          int rows, const IsBlack& is_black) {
  for (const int axis : {0, 1}) {
    const int along = axis == 0 ? columns : rows;
    const int across = axis == 0 ? rows : columns;
    const auto black = [&](int i, int j) { return axis == 0 ? is_black(i, j) : is_black(j, i); };
    for (int j = 0; j <= across; ++j) {
      const auto differ = [&](int i) { return black(i, j - 1) != black(i, j); };
      for (int i = 0; i < along; ++i) {
        if (!differ(i)) continue;
        const int first = i;
        while (i + 1 < along && differ(i + 1)) ++i;
        segments_.push_back({axis, origin(1 - axis) + j * cell(1 - axis),
                             origin(axis) + first * cell(axis),
                             origin(axis) + (i + 1) * cell(axis)});
      }
    }
  }
}

void PrintEdges::fill_cells(const BoardOutline& outline) {
  origin_ = outline.lower_left_m;
  columns_ = std::max(1, static_cast<int>(std::ceil(outline.size_m().x() / kCell)));
  rows_ = std::max(1, static_cast<int>(std::ceil(outline.size_m().y() / kCell)));
  const auto count = static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_);
  near_segments_.resize(count);
  near_circles_.resize(count);
  const auto add = [&](const Eigen::Vector2d& low, const Eigen::Vector2d& high, int index,
                       std::vector<std::vector<int>>& near) {
    const Eigen::Vector2d a = (low - origin_).array() - kFar;
    const Eigen::Vector2d b = (high - origin_).array() + kFar;
    const auto place = [](double x, int last) {
      return std::clamp(static_cast<int>(std::floor(x / kCell)), 0, last - 1);
    };
    for (int r = place(a.y(), rows_); r <= place(b.y(), rows_); ++r) {
      for (int c = place(a.x(), columns_); c <= place(b.x(), columns_); ++c)
        near[static_cast<std::size_t>(r * columns_ + c)].push_back(index);
    }
  };
  for (std::size_t k = 0; k < segments_.size(); ++k) {
    const Segment& s = segments_[k];
    Eigen::Vector2d low;
    Eigen::Vector2d high;
    low(s.axis) = s.from;
    high(s.axis) = s.to;
    low(1 - s.axis) = high(1 - s.axis) = s.at;
    add(low, high, static_cast<int>(k), near_segments_);
  }
  for (std::size_t k = 0; k < circles_.size(); ++k) {
    const Eigen::Vector2d reach(radius_m_, radius_m_);
    add(circles_[k] - reach, circles_[k] + reach, static_cast<int>(k), near_circles_);
  }
}

std::size_t PrintEdges::cell_of(const Eigen::Vector2d& board_m) const {
  const Eigen::Vector2d at = (board_m - origin_) / kCell;
  const int c = std::clamp(static_cast<int>(std::floor(at.x())), 0, columns_ - 1);
  const int r = std::clamp(static_cast<int>(std::floor(at.y())), 0, rows_ - 1);
  return static_cast<std::size_t>(r * columns_ + c);
}

double PrintEdges::growth_per_m(const Eigen::Vector2d& p, const Eigen::Matrix2d& blur) const {
  const std::size_t cell = cell_of(p);
  double sum = 0.0;
  for (const int k : near_segments_[cell]) {
    const Segment& s = segments_[static_cast<std::size_t>(k)];
    const double across = std::sqrt(blur(1 - s.axis, 1 - s.axis));
    const double off = s.at - p(1 - s.axis);
    if (std::abs(off) > kReach * across) continue;
    // What the Gaussian is along the edge, given that it lies so far across.
    const double slope = blur(0, 1) / (across * across);
    const double middle = p(s.axis) + slope * off;
    const double along =
        std::sqrt(std::max(1e-18, blur(s.axis, s.axis) - slope * slope * across * across));
    sum += normal_pdf(off / across) / across *
           (normal_cdf((s.to - middle) / along) - normal_cdf((s.from - middle) / along));
  }
  for (const int k : near_circles_[cell]) {
    const Eigen::Vector2d from = p - circles_[static_cast<std::size_t>(k)];
    const double rho = from.norm();
    const Eigen::Vector2d radial = rho > 0.0 ? Eigen::Vector2d(from / rho) : Eigen::Vector2d(1, 0);
    const double variance = radial.dot(blur * radial);
    const double off = rho - radius_m_;
    if (off * off > kReach * kReach * variance) continue;
    sum += radius_m_ / variance * std::exp(-0.5 * off * off / variance) *
           scaled_bessel_0(rho * radius_m_ / variance);
  }
  return sum;
}

}  // namespace lvcalib
