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

}  // namespace

OutlineFit fit_outline(const std::vector<PlanarSample>& samples, const Eigen::Vector2d& size_m) {
  constexpr int kAngles = 60;  // Half a turn in three-degree steps: width and height differ.
  const std::size_t stride = std::max<std::size_t>(1, samples.size() / 600);
  std::vector<double> x;
  std::vector<double> y;
  struct Rectangle {
    OutlineFit fit;
    double area;
    double cost;
  };
  std::vector<Rectangle> rectangles;
  for (int a = 0; a < kAngles; ++a) {
    const double angle = std::numbers::pi * a / kAngles;
    const double c = std::cos(angle);
    const double s = std::sin(angle);
    x.clear();
    y.clear();
    for (std::size_t k = 0; k < samples.size(); k += stride) {
      const Eigen::Vector2d p = samples[k].uv_m.cast<double>();
      x.push_back(c * p.x() + s * p.y());
      y.push_back(-s * p.x() + c * p.y());
    }
    const Eigen::Vector2d low(quantile(x, 0.01), quantile(y, 0.01));
    const Eigen::Vector2d high(quantile(x, 0.99), quantile(y, 0.99));
    // One per cent is trimmed at each end.
    const Eigen::Vector2d sides = (high - low) / 0.98;
    const Eigen::Vector2d middle = 0.5 * (low + high);
    Rectangle r;
    r.fit.angle_rad = angle;
    r.fit.center_m = {c * middle.x() - s * middle.y(), s * middle.x() + c * middle.y()};
    r.fit.side_error_m = sides - size_m;
    r.area = sides.prod();
    r.cost = r.fit.side_error_m.cwiseQuotient(size_m).squaredNorm();
    rectangles.push_back(r);
  }
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
                                        const Target& target) {
  std::vector<PlanarSample> samples;
  samples.reserve(patch.voxels.size());
  for (const auto i : patch.voxels) {
    samples.push_back(
        {patch.to_plane(cloud.voxels()[i].mean_m.cast<double>()).cast<float>(), 0.0F});
  }
  const Eigen::Vector2d size = target.outline().size_m();
  const OutlineFit fit = fit_outline(samples, size);
  const double error = fit.side_error_m.cwiseQuotient(size).cwiseAbs().maxCoeff();
  if (error > kLargestSideError) return {};
  std::vector<PatternMatch> out;
  const int symmetry = target.outline_symmetry();
  for (int turn = 0; turn < symmetry; ++turn) {
    PatternMatch match;
    match.pose = {fit.angle_rad + 2.0 * std::numbers::pi * turn / symmetry, fit.center_m};
    // A perfect outline counts as a correlation of 0.9, the worst accepted one as 0.5.
    match.correlation = 0.9 - 0.4 * error / kLargestSideError;
    match.inside = static_cast<int>(std::min<std::size_t>(samples.size(), 100));
    out.push_back(match);
  }
  return out;
}

}  // namespace lvcalib
