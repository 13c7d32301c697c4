// SPDX-License-Identifier: BSD-3-Clause
#include "localization/outline_match.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/statistics.h"

namespace lvcalib {
namespace {

// Relative side error at which a patch is no longer the board. A sparse scanner's lines leave up
// to one line spacing of the board unseen, so patches measure small rather than large.
constexpr double kLargestSideError = 0.25;

// A rectangle around the patch that is larger than the smallest one by more stands askew: a small
// panel set on its corner would pass for a large one.
constexpr double kLargestExcessArea = 1.15;

// A stand or a cable is a few per cent of a board's area; a panel a fifth longer than the board,
// which holds one anywhere, leaves out a sixth.
constexpr double kLargestOutside = 0.15;
// Windows that leave out as little: the size's steps of a 24th move as much in or out.
constexpr double kOutsideAlike = 0.03;

// Points of a plane in a turned frame, counted in square cells; summed from the corner, so that a
// window's count is four look-ups.
class SummedCells {
 public:
  SummedCells(const std::vector<double>& x, const std::vector<double>& y, double cell_m)
      : cell_m_(cell_m),
        low_(*std::min_element(x.begin(), x.end()), *std::min_element(y.begin(), y.end())),
        columns_(cells(*std::max_element(x.begin(), x.end()) - low_.x())),
        rows_(cells(*std::max_element(y.begin(), y.end()) - low_.y())),
        sums_(static_cast<std::size_t>((columns_ + 1) * (rows_ + 1)), 0) {
    for (std::size_t k = 0; k < x.size(); ++k) ++at(cells(x[k] - low_.x()), cells(y[k] - low_.y()));
    for (int r = 1; r <= rows_; ++r) {
      for (int c = 1; c <= columns_; ++c)
        at(c, r) += at(c - 1, r) + at(c, r - 1) - at(c - 1, r - 1);
    }
  }

  // Lower left corner of the window that holds most; the middle one of those that hold as many.
  [[nodiscard]] Eigen::Vector2d fullest(const Eigen::Vector2d& size_m) {
    const int w = std::min(columns_, cells(size_m.x()));
    const int h = std::min(rows_, cells(size_m.y()));
    int most = -1;
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();
    int equal = 0;
    for (int r = h; r <= rows_; ++r) {
      for (int c = w; c <= columns_; ++c) {
        const int count = at(c, r) - at(c - w, r) - at(c, r - h) + at(c - w, r - h);
        if (count < most) continue;
        if (count > most) {
          most = count;
          sum.setZero();
          equal = 0;
        }
        sum += Eigen::Vector2d(c - w, r - h);
        ++equal;
      }
    }
    return low_ + cell_m_ * sum / equal;
  }

 private:
  // At least one; a point on the far edge is in the last.
  [[nodiscard]] int cells(double length_m) const {
    return 1 + static_cast<int>(length_m / cell_m_);
  }
  int& at(int column, int row) {
    return sums_[static_cast<std::size_t>(row * (columns_ + 1) + column)];
  }

  double cell_m_;
  Eigen::Vector2d low_;
  int columns_, rows_;
  std::vector<int> sums_;
};

// The points that the fullest window of the board's size leaves out are a stand's, a cable's, a
// neighbour's: the rectangle is that of the others.
void keep_fullest(const Eigen::Vector2d& size_m, std::vector<double>& x, std::vector<double>& y) {
  const double cell = size_m.minCoeff() / 24.0;
  const Eigen::Vector2d window = size_m + Eigen::Vector2d::Constant(cell);
  const Eigen::Vector2d low = SummedCells(x, y, cell).fullest(window);
  std::size_t kept = 0;
  for (std::size_t k = 0; k < x.size(); ++k) {
    if (x[k] < low.x() || y[k] < low.y() || x[k] > low.x() + window.x() + cell ||
        y[k] > low.y() + window.y() + cell)
      continue;
    x[kept] = x[k];
    y[kept] = y[k];
    ++kept;
  }
  x.resize(kept);
  y.resize(kept);
}

// A rectangle about points in one direction.
struct Rectangle {
  OutlineFit fit;
  double area;
  double cost;
};

Rectangle rectangle_at(const std::vector<PlanarSample>& samples, const Eigen::Vector2d& size_m,
                       double angle_rad) {
  const std::size_t stride = std::max<std::size_t>(1, samples.size() / 600);
  const double c = std::cos(angle_rad);
  const double s = std::sin(angle_rad);
  std::vector<double> x;
  std::vector<double> y;
  for (std::size_t k = 0; k < samples.size(); k += stride) {
    const Eigen::Vector2d p = samples[k].uv_m.cast<double>();
    x.push_back(c * p.x() + s * p.y());
    y.push_back(-s * p.x() + c * p.y());
  }
  const auto all = static_cast<double>(x.size());
  keep_fullest(size_m, x, y);
  const Eigen::Vector2d low(quantile(x, 0.01), quantile(y, 0.01));
  const Eigen::Vector2d high(quantile(x, 0.99), quantile(y, 0.99));
  // One per cent is trimmed at each end.
  const Eigen::Vector2d sides = (high - low) / 0.98;
  const Eigen::Vector2d middle = 0.5 * (low + high);
  Rectangle r;
  r.fit.angle_rad = angle_rad;
  r.fit.center_m = {c * middle.x() - s * middle.y(), s * middle.x() + c * middle.y()};
  r.fit.side_error_m = sides - size_m;
  r.fit.outside = 1.0 - static_cast<double>(x.size()) / all;
  r.area = sides.prod();
  r.cost = r.fit.side_error_m.cwiseQuotient(size_m).squaredNorm();
  return r;
}

}  // namespace

OutlineFit fit_outline(const std::vector<PlanarSample>& samples, const Eigen::Vector2d& size_m) {
  constexpr int kAngles = 60;  // Half a turn in three-degree steps: width and height differ.
  std::vector<Rectangle> rectangles;
  for (int a = 0; a < kAngles; ++a)
    rectangles.push_back(rectangle_at(samples, size_m, std::numbers::pi * a / kAngles));
  double least_outside = 1.0;
  for (const Rectangle& r : rectangles) least_outside = std::min(least_outside, r.fit.outside);
  std::erase_if(rectangles,
                [&](const Rectangle& r) { return r.fit.outside > least_outside + kOutsideAlike; });
  double smallest = 1e300;
  for (const Rectangle& r : rectangles) smallest = std::min(smallest, r.area);
  const Rectangle* best = nullptr;
  for (const Rectangle& r : rectangles) {
    if (!(r.area <= kLargestExcessArea * smallest)) continue;
    if (best == nullptr || r.cost < best->cost) best = &r;
  }
  return best == nullptr ? OutlineFit{} : best->fit;
}

std::vector<PatternMatch> outline_poses(const VoxelCloud& cloud, const PlanarPatch& patch,
                                        const Target& target,
                                        const std::optional<Eigen::Vector3d>& width) {
  std::vector<PlanarSample> samples;
  samples.reserve(patch.voxels.size());
  for (const auto i : patch.voxels) {
    samples.push_back(
        {patch.to_plane(cloud.voxels()[i].mean_m.cast<double>()).cast<float>(), 0.0F});
  }
  const Eigen::Vector2d size = target.outline().size_m();
  std::vector<OutlineFit> fits{fit_outline(samples, size)};
  if (width) {
    constexpr double kAlike_rad = 0.05;  // Of two of the directions that were tried.
    const double angle = std::atan2(width->dot(patch.axis_v), width->dot(patch.axis_u));
    const double turn = 2.0 * std::numbers::pi / target.outline_symmetry();
    if (std::abs(std::remainder(angle - fits.front().angle_rad, turn)) > kAlike_rad)
      fits.push_back(rectangle_at(samples, size, angle).fit);
  }
  std::vector<PatternMatch> out;
  const int symmetry = target.outline_symmetry();
  for (const OutlineFit& fit : fits) {
    const double error = fit.side_error_m.cwiseQuotient(size).cwiseAbs().maxCoeff();
    if (error > kLargestSideError || fit.outside > kLargestOutside) continue;
    for (int turn = 0; turn < symmetry; ++turn) {
      PatternMatch match;
      match.pose = {fit.angle_rad + 2.0 * std::numbers::pi * turn / symmetry, fit.center_m};
      // A perfect outline counts as a correlation of 0.9, the worst accepted one as 0.5.
      match.correlation =
          0.9 - 0.4 * std::max(error / kLargestSideError, fit.outside / kLargestOutside);
      match.inside = static_cast<int>(std::min<std::size_t>(samples.size(), 100));
      out.push_back(match);
    }
  }
  return out;
}

}  // namespace lvcalib
