// SPDX-License-Identifier: BSD-3-Clause
#include "target/print_edges.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "base/statistics.h"

namespace lvcalib {
namespace {

// A cell lists what any spot in it may reach: a sixth of the width of the larger reach, so that
// little is listed in vain, and some thousand cells a board.
constexpr double kCell = 0.015;
// Edges farther than this are beyond four widths of any spot that still tells edges of bits apart.
constexpr double kFar = 0.08;
// Most spots are small, and ask a third of the edges: √2 · kReach · 8 mm.
constexpr double kNear = 0.045;
// Widths beyond which an edge is not asked: 3·10⁻⁵ of the spot.
constexpr double kReach = 4.0;

// By how much one end of an edge goes on as it sweeps: half the growth where the corner stays
// sharp, π/8 of it where it turns round (the strip's mean; at its far side twice that). Where two
// corners of either colour meet, both strips run into each other whichever grows.
double end_growth(double turn, double growth_m) {
  constexpr double kRound = 0.39269908169872414;  // π/8
  if (turn == 0.0) return -0.5 * std::abs(growth_m);
  return turn * growth_m * (turn * growth_m > 0.0 ? kRound : 0.5);
}

// Φ(x) and φ(x), where an end of an edge is out of reach 0 or 1, and 0.
double share_below(double x) {
  return std::abs(x) > kReach ? (x > 0.0 ? 1.0 : 0.0) : normal_cdf(x);
}
double density_at(double x) {
  return std::abs(x) > kReach ? 0.0 : normal_pdf(x);
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
  origin_ = t.outline().lower_left_m;
  const Eigen::Vector2d size = t.outline().size_m();
  columns_ = std::max(1, static_cast<int>(std::ceil(size.x() / kCell)));
  rows_ = std::max(1, static_cast<int>(std::ceil(size.y() / kCell)));
  for (const Segment& s : segments_) at_.push_back(s.at);
  near_ = within(kNear);
  far_ = within(kFar);
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
      // 1 where black lies below, −1 where it lies above, 0 between like cells.
      const auto side = [&](int i) {
        return static_cast<int>(black(i, j - 1)) - static_cast<int>(black(i, j));
      };
      // Whose corner the end before cell `beyond` is: black's if white goes on there, white's if
      // black does, both's if the colours change places.
      const auto turn = [&](int beyond) {
        if (side(beyond) != 0) return 0.0;
        return black(beyond, j) ? -1.0 : 1.0;
      };
      for (int i = 0; i < along; ++i) {
        if (side(i) == 0) continue;
        const int first = i;
        while (i + 1 < along && side(i + 1) == side(first)) ++i;
        segments_.push_back({axis, origin(1 - axis) + j * cell(1 - axis),
                             origin(axis) + first * cell(axis), origin(axis) + (i + 1) * cell(axis),
                             static_cast<double>(side(first)), turn(first - 1), turn(i + 1)});
      }
    }
  }
}

std::vector<PrintEdges::Nearby> PrintEdges::within(double reach_m) const {
  std::vector<Nearby> cells(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_));
  const auto add = [&](const Eigen::Vector2d& low, const Eigen::Vector2d& high, std::size_t index,
                       const auto& list_of) {
    const Eigen::Vector2d a = (low - origin_).array() - reach_m;
    const Eigen::Vector2d b = (high - origin_).array() + reach_m;
    const auto place = [](double x, int count) {
      return std::clamp(static_cast<int>(std::floor(x / kCell)), 0, count - 1);
    };
    for (int r = place(a.y(), rows_); r <= place(b.y(), rows_); ++r) {
      for (int c = place(a.x(), columns_); c <= place(b.x(), columns_); ++c)
        list_of(cells[static_cast<std::size_t>(r * columns_ + c)])
            .push_back(static_cast<int>(index));
    }
  };
  for (std::size_t k = 0; k < segments_.size(); ++k) {
    const Segment& s = segments_[k];
    Eigen::Vector2d low;
    Eigen::Vector2d high;
    low(s.axis) = s.from;
    high(s.axis) = s.to;
    low(1 - s.axis) = high(1 - s.axis) = s.at;
    add(
        low, high,
        k, [&](Nearby & cell) -> auto& { return cell.segments[static_cast<std::size_t>(s.axis)]; });
  }
  const Eigen::Vector2d radius(radius_m_, radius_m_);
  for (std::size_t k = 0; k < circles_.size(); ++k)
    add(
        circles_[k] - radius, circles_[k] + radius, k,
        [](Nearby & cell) -> auto& { return cell.circles; });
  return cells;
}

std::size_t PrintEdges::cell_of(const Eigen::Vector2d& board_m) const {
  const Eigen::Vector2d at = (board_m - origin_) / kCell;
  const int c = std::clamp(static_cast<int>(std::floor(at.x())), 0, columns_ - 1);
  const int r = std::clamp(static_cast<int>(std::floor(at.y())), 0, rows_ - 1);
  return static_cast<std::size_t>(r * columns_ + c);
}

double PrintEdges::grow(const Eigen::Vector2d& p, const Eigen::Matrix2d& blur, double growth_m,
                        PrintSample& sample) const {
  // Along an edge a spot reaches as far again as its middle moves while the edge is within reach
  // across, by at most √2 times its width in all; ends move by the growth or less.
  const double reach = std::numbers::sqrt2 * kReach * std::sqrt(blur.diagonal().maxCoeff()) +
                       2.0 * std::abs(growth_m);
  const Nearby& cell = (reach < kNear ? near_ : far_)[cell_of(p)];
  double density = 0.0;
  for (const int axis : {0, 1}) {
    const Spot spot(blur, axis);
    const double across = p(1 - axis);
    const double farthest = spot.reach_across + std::abs(growth_m);
    for (const int k : cell.segments[static_cast<std::size_t>(axis)]) {
      const auto at = static_cast<std::size_t>(k);
      if (std::abs(at_[at] - across) <= farthest)
        density += sweep(segments_[at], p, spot, growth_m, sample);
    }
  }
  for (const int k : cell.circles)
    density += sweep_circle(p - circles_[static_cast<std::size_t>(k)], blur, growth_m, sample);
  // Strips that overlap where little is left are taken away twice.
  if (growth_m != 0.0) sample.white = std::clamp(sample.white, 0.0, 1.0);
  return density;
}

PrintEdges::Spot::Spot(const Eigen::Matrix2d& blur, int axis)
    : across(std::sqrt(blur(1 - axis, 1 - axis))),
      slope(blur(0, 1) / blur(1 - axis, 1 - axis)),
      along(std::sqrt(std::max(1e-18, blur(axis, axis) - slope * blur(0, 1)))),
      reach_across(1.001 * kReach * across) {}

double PrintEdges::sweep(const Segment& s, const Eigen::Vector2d& p, const Spot& spot,
                         double growth_m, PrintSample& sample) {
  const int n = 1 - s.axis;  // Across.
  const double old_z = (s.at - p(n)) / spot.across;
  const double new_z = old_z + s.outward * growth_m / spot.across;
  if (std::min(std::abs(old_z), std::abs(new_z)) > kReach && old_z * new_z > 0.0) return 0.0;
  const double middle = p(s.axis) + spot.slope * 0.5 * (old_z + new_z) * spot.across;
  const double from_end = end_growth(s.turn_from, growth_m);
  const double to_end = end_growth(s.turn_to, growth_m);
  const double from = (s.from - from_end - middle) / spot.along;
  const double to = (s.to + to_end - middle) / spot.along;
  if (from > kReach || to < -kReach) return 0.0;
  const double new_pdf = normal_pdf(new_z) / spot.across;
  // At the far side of the strip.
  const double farther = spot.slope * 0.5 * (new_z - old_z) * spot.across;
  const double density =
      std::max(0.0, new_pdf * (share_below(to + (to_end - farther) / spot.along) -
                               share_below(from - (from_end + farther) / spot.along)));
  if (growth_m == 0.0) return density;

  const double length = share_below(to) - share_below(from);
  const double old_pdf = normal_pdf(old_z) / spot.across;
  const double from_pdf = density_at(from) / spot.along;
  const double to_pdf = density_at(to) / spot.along;
  const double length1 = from_pdf - to_pdf;  // By the middle, which follows p along and across.
  const double length2 = (from * from_pdf - to * to_pdf) / spot.along;
  const double width = s.outward * (normal_cdf(new_z) - normal_cdf(old_z));
  const double width1 = s.outward * (old_pdf - new_pdf);  // By p across.
  const double width2 = s.outward * (old_z * old_pdf - new_z * new_pdf) / spot.across;
  sample.white -= width * length;
  sample.gradient_per_m(n) -= width1 * length - spot.slope * width * length1;
  sample.gradient_per_m(s.axis) -= width * length1;
  sample.hessian_per_m2(n, n) -= width2 * length - 2.0 * spot.slope * width1 * length1 +
                                 spot.slope * spot.slope * width * length2;
  sample.hessian_per_m2(s.axis, s.axis) -= width * length2;
  const double mixed = width1 * length1 - spot.slope * width * length2;
  sample.hessian_per_m2(0, 1) -= mixed;
  sample.hessian_per_m2(1, 0) -= mixed;
  return density;
}

double PrintEdges::sweep_circle(const Eigen::Vector2d& from_center, const Eigen::Matrix2d& blur,
                                double growth_m, PrintSample& sample) const {
  const double rho = std::max(from_center.norm(), 1e-9);
  const Eigen::Vector2d radial = from_center / rho;
  const double across = std::sqrt(radial.dot(blur * radial));
  const double old_z = (radius_m_ - rho) / across;
  const double new_z = old_z + growth_m / across;
  if (std::min(std::abs(old_z), std::abs(new_z)) > kReach && old_z * new_z > 0.0) return 0.0;
  const double new_pdf = normal_pdf(new_z) / across;
  if (growth_m != 0.0) {
    const double old_pdf = normal_pdf(old_z) / across;
    const double length = std::sqrt((radius_m_ + 0.5 * growth_m) / rho);
    const double width = length * (normal_cdf(new_z) - normal_cdf(old_z));
    const double by_rho = length * (old_pdf - new_pdf) - 0.5 * width / rho;
    const Eigen::Matrix2d outer = radial * radial.transpose();
    sample.white -= width;
    sample.gradient_per_m -= by_rho * radial;
    sample.hessian_per_m2 -= length * (old_z * old_pdf - new_z * new_pdf) / across * outer +
                             by_rho / rho * (Eigen::Matrix2d::Identity() - outer);
  }
  return std::sqrt((radius_m_ + growth_m) / rho) * new_pdf;
}

}  // namespace lvcalib
