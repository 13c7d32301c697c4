// SPDX-License-Identifier: BSD-3-Clause
#include "localization/pattern_match.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <numbers>
#include <utility>

#include <Eigen/Cholesky>

#include "base/paired_moments.h"
#include "base/statistics.h"

namespace lvcalib {
namespace {

// Below this a correlation says nothing and the gain would be noise.
constexpr int kMinInside = 12;

// Of print and intensities.
double correlation(const PairedMoments& moments) {
  return moments.n < kMinInside ? 0.0 : moments.correlation();
}

double angle_difference(double a, double b) {
  return std::abs(std::remainder(a - b, 2.0 * std::numbers::pi));
}

// A sample as the search sees it: where it is in the plane, or from the tried centre.
struct LocalSample {
  float x = 0.0F, y = 0.0F, intensity = 0.0F;
};

// The samples of a plane in square cells, for those about a place: read thousands of times, so that
// those of neighbours in a row of cells lie one after the other.
class SampleGrid {
 public:
  SampleGrid(const std::vector<PlanarSample>& samples, double radius_m)
      : radius_m_(static_cast<float>(radius_m)), cell_m_(0.25F * radius_m_) {
    std::map<std::pair<int, int>, std::vector<LocalSample>> cells;
    for (const PlanarSample& sample : samples) {
      const Eigen::Vector2f& uv = sample.uv_m;
      cells[{index(uv.y()), index(uv.x())}].push_back({uv.x(), uv.y(), sample.intensity});
    }
    samples_.reserve(samples.size());
    for (const auto& [place, in_cell] : cells) {
      std::vector<Cell>& row = rows_[place.first];
      row.push_back({place.second, samples_.size(), samples_.size() + in_cell.size()});
      samples_.insert(samples_.end(), in_cell.begin(), in_cell.end());
    }
  }

  [[nodiscard]] double radius_m() const { return radius_m_; }

  // At most about `count` of the samples within the radius, spread evenly.
  void about(const Eigen::Vector2f& center, std::size_t count,
             std::vector<LocalSample>& out) const {
    std::size_t found = 0;
    const float most = radius_m_ * radius_m_;
    const int left = index(center.x() - radius_m_);
    const int right = index(center.x() + radius_m_);
    const auto end = rows_.upper_bound(index(center.y() + radius_m_));
    for (auto row = rows_.lower_bound(index(center.y() - radius_m_)); row != end; ++row) {
      const auto [begin, behind] = run_of(row->second, left, right);
      if (out.size() < found + behind - begin) out.resize(found + behind - begin);
      for (std::size_t k = begin; k < behind; ++k) {
        const LocalSample& sample = samples_[k];
        const float x = sample.x - center.x();
        const float y = sample.y - center.y();
        out[found] = {x, y, sample.intensity};
        found += x * x + y * y > most ? 0 : 1;
      }
    }
    out.resize(found);
    const std::size_t stride = out.size() / count;
    if (stride < 2) return;
    for (std::size_t k = 0; k * stride < out.size(); ++k) out[k] = out[k * stride];
    out.resize((out.size() + stride - 1) / stride);
  }

 private:
  struct Cell {
    int column = 0;
    std::size_t begin = 0, end = 0;  // Of its samples.
  };
  [[nodiscard]] int index(float x) const { return static_cast<int>(std::floor(x / cell_m_)); }
  // The samples of a row's cells from column `left` to `right`.
  static std::pair<std::size_t, std::size_t> run_of(const std::vector<Cell>& row, int left,
                                                    int right) {
    const auto first = std::partition_point(row.begin(), row.end(),
                                            [&](const Cell& c) { return c.column < left; });
    const auto behind =
        std::partition_point(first, row.end(), [&](const Cell& c) { return c.column <= right; });
    if (first == behind) return {0, 0};
    return {first->begin, std::prev(behind)->end};
  }
  std::vector<LocalSample> samples_;
  std::map<int, std::vector<Cell>> rows_;
  float radius_m_;
  float cell_m_;
};

// Correlation over every stride-th sample, the board turned by (cosine, sine).
PairedMoments moments_at(const std::vector<LocalSample>& samples, const PatternTemplate& pattern,
                         const Eigen::Vector2f& outline_center, const Eigen::Vector2f& turn,
                         std::size_t stride) {
  const float c = turn.x();
  const float s = turn.y();
  PairedMoments m;
  for (std::size_t k = 0; k < samples.size(); k += stride) {
    const LocalSample& d = samples[k];
    const float v = pattern.value(c * d.x + s * d.y + outline_center.x(),
                                  -s * d.x + c * d.y + outline_center.y());
    if (v >= 0.0F) m.add(v, d.intensity);
  }
  return m;
}

double spread(const std::vector<LocalSample>& samples) {
  double sum = 0.0;
  double squares = 0.0;
  for (const LocalSample& sample : samples) {
    sum += sample.intensity;
    squares += static_cast<double>(sample.intensity) * sample.intensity;
  }
  const auto n = static_cast<double>(samples.size());
  return std::sqrt(std::max(0.0, squares / n - sum * sum / (n * n)));
}

// The centres worth a try. Of a plane so large that a board can touch only part of it, those
// about which the intensities vary more than they do on its plainest quarter.
std::vector<Eigen::Vector2d> promising_centers(const SampleGrid& grid,
                                               const PatternSearchRange& range, std::size_t count,
                                               const RunContext& context) {
  // Four times the variance, which noise alone does not reach in a dozen samples.
  constexpr double kLively = 2.0;
  const int reach = static_cast<int>(std::ceil(range.slack_m / range.step_m));
  std::vector<Eigen::Vector2d> all;
  for (int iy = -reach; iy <= reach; ++iy) {
    for (int ix = -reach; ix <= reach; ++ix)
      all.emplace_back(range.center_m + range.step_m * Eigen::Vector2d(ix, iy));
  }
  // A board changes what is seen from centres up to a diagonal away.
  const auto touched_all = [&](std::size_t tried) {
    const double touched_m2 = 16.0 * grid.radius_m() * grid.radius_m();
    return static_cast<double>(tried) * range.step_m * range.step_m < touched_m2;
  };
  if (touched_all(all.size())) return all;
  std::vector<Eigen::Vector2d> centers;
  std::vector<double> spreads;
  std::vector<LocalSample> near;
  for (const Eigen::Vector2d& center : all) {
    if (context.stopped()) return {};
    grid.about(center.cast<float>(), count, near);
    if (near.size() < kMinInside) continue;
    centers.push_back(center);
    spreads.push_back(spread(near));
  }
  if (touched_all(centers.size())) return centers;
  const double plain = quantile(spreads, 0.25);
  std::vector<Eigen::Vector2d> lively;
  for (std::size_t k = 0; k < centers.size(); ++k) {
    if (spreads[k] > kLively * plain) lively.push_back(centers[k]);
  }
  return lively;
}

// A match with its evidence, which takes a logarithm, computed once.
struct RankedMatch {
  PatternMatch match;
  double gain = 0.0;
};

// The best of the well separated ones.
std::vector<PatternMatch> separated(std::vector<RankedMatch> all, double separation_m,
                                    std::size_t count) {
  std::sort(all.begin(), all.end(),
            [](const RankedMatch& a, const RankedMatch& b) { return a.gain > b.gain; });
  std::vector<PatternMatch> best;
  // Several of the steps in which angles are tried, and far from a square board's quarter turn.
  constexpr double kSeparationAngle = 20.0 * std::numbers::pi / 180.0;
  for (const RankedMatch& ranked : all) {
    const PatternMatch& match = ranked.match;
    const bool taken = std::any_of(best.begin(), best.end(), [&](const PatternMatch& other) {
      return (match.pose.center_m - other.pose.center_m).norm() < separation_m &&
             angle_difference(match.pose.angle_rad, other.pose.angle_rad) < kSeparationAngle;
    });
    if (taken) continue;
    best.push_back(match);
    if (best.size() == count) break;
  }
  return best;
}

}  // namespace

double PatternMatch::gain(double samples_per_independent) const {
  if (correlation <= 0 || inside < kMinInside) return 0.0;
  const double r = std::min(correlation, 0.9999);
  return -0.5 * (inside / samples_per_independent) * std::log(1.0 - r * r);
}

std::vector<PatternMatch> search_pattern(const std::vector<PlanarSample>& samples,
                                         const PatternTemplate& pattern,
                                         const Eigen::Vector2d& outline_center_m,
                                         const PatternSearchRange& range,
                                         const RunContext& context) {
  // About 250 on a square board, which fills 64 % of the circle around it.
  constexpr std::size_t kSearchSamples = 400;
  // A few samples tell most of the poses that do not match at all.
  constexpr std::size_t kQuickSamples = 60;
  constexpr double kHopeless = 0.15;
  const SampleGrid grid(samples, pattern.radius_m());
  const Eigen::Vector2f outline_center = outline_center_m.cast<float>();
  std::vector<Eigen::Vector2f> turns;
  for (const double angle : range.angles_rad) {
    turns.push_back(Eigen::Vector2d(std::cos(angle), std::sin(angle)).cast<float>());
  }
  std::vector<LocalSample> near;
  std::vector<RankedMatch> all;
  for (const Eigen::Vector2d& center : promising_centers(grid, range, kSearchSamples, context)) {
    if (context.stopped()) return {};
    grid.about(center.cast<float>(), kSearchSamples, near);
    const std::size_t quick = std::max<std::size_t>(1, near.size() / kQuickSamples);
    for (std::size_t t = 0; t < turns.size(); ++t) {
      const PairedMoments few = moments_at(near, pattern, outline_center, turns[t], quick);
      if (quick > 1 && few.n >= kMinInside && correlation(few) < kHopeless) continue;
      const PairedMoments m = moments_at(near, pattern, outline_center, turns[t], 1);
      RankedMatch ranked;
      ranked.match.pose = {range.angles_rad[t], center};
      ranked.match.correlation = correlation(m);
      ranked.match.inside = static_cast<int>(m.n);
      ranked.gain = ranked.match.gain();
      if (ranked.gain > 0) all.push_back(ranked);
    }
  }
  return separated(std::move(all), range.separation_m, range.count);
}

namespace {

// Normal equations of intensity = a + b·albedo(pose, scale) at one pose.
struct PatternSystem {
  PairedMoments moments;
  double a = 0.0;
  double b = 0.0;
  Eigen::Matrix4d normal = Eigen::Matrix4d::Zero();  // u, v, angle, scale
  Eigen::Vector4d rhs = Eigen::Vector4d::Zero();
  double variance = 0.0;
};

PatternSystem build_system(const std::vector<PlanarSample>& samples, const PatternTemplate& pattern,
                           const Eigen::Vector2d& outline_center, const PlanarPose& pose) {
  PatternSystem system;
  const double c = std::cos(pose.angle_rad);
  const double s = std::sin(pose.angle_rad);
  struct Row {
    PatternTemplate::Sample sample;
    Eigen::Vector2d local;
    double intensity;
  };
  std::vector<Row> rows;
  rows.reserve(samples.size());
  for (const PlanarSample& sample : samples) {
    const Eigen::Vector2d d = sample.uv_m.cast<double>() - pose.center_m;
    const Eigen::Vector2d local(c * d.x() + s * d.y(), -s * d.x() + c * d.y());
    const auto at = pattern.at(local + outline_center);
    if (!at.inside) continue;
    rows.push_back({at, local, sample.intensity});
    system.moments.add(at.value, sample.intensity);
  }
  const PairedMoments& m = system.moments;
  if (m.n < kMinInside || m.x_squares() <= 0) return system;
  system.b = m.slope();
  system.a = (m.y - system.b * m.x) / m.n;
  // Moving the pose by (du, dv) in the plane moves board points by −Rᵀ(du, dv).
  double sum_sq = 0.0;
  for (const Row& row : rows) {
    const Eigen::Vector2d g = system.b * row.sample.gradient_per_m;
    Eigen::Vector4d j;
    j << -(g.x() * c - g.y() * s), -(g.x() * s + g.y() * c),
        g.x() * row.local.y() - g.y() * row.local.x(), -g.dot(row.local);
    const double e = row.intensity - system.a - system.b * row.sample.value;
    system.normal += j * j.transpose();
    system.rhs += j * e;
    sum_sq += e * e;
  }
  system.variance = sum_sq / m.n;
  return system;
}

}  // namespace

PatternMatch refine_pattern_pose(const std::vector<PlanarSample>& samples,
                                 const PatternTemplate& pattern,
                                 const Eigen::Vector2d& outline_center_m, const PlanarPose& start) {
  constexpr int kIterations = 12;
  PatternMatch match;
  match.pose = start;
  double damping = 1e-3;
  PatternSystem system = build_system(samples, pattern, outline_center_m, start);
  for (int i = 0; i < kIterations && system.b > 0; ++i) {
    Eigen::Matrix3d normal = system.normal.topLeftCorner<3, 3>();
    normal.diagonal() *= 1.0 + damping;
    const Eigen::Vector3d step = normal.ldlt().solve(system.rhs.head<3>());
    if (!step.allFinite()) break;
    // A gradient is valid only within about the blur.
    const double limit = 2.0 * pattern.blur_sigma_m();
    const double factor = std::min(1.0, limit / std::max(step.head<2>().norm(), 1e-12));
    const PlanarPose next{match.pose.angle_rad + factor * step.z(),
                          match.pose.center_m + factor * step.head<2>()};
    PatternSystem candidate = build_system(samples, pattern, outline_center_m, next);
    const bool better = correlation(candidate.moments) >= correlation(system.moments);
    if (better) {
      match.pose = next;
      system = candidate;
      damping = std::max(1e-6, 0.3 * damping);
      if (step.head<2>().norm() < 1e-5) break;
    } else {
      damping *= 10.0;
    }
  }
  match.correlation = system.b > 0 ? correlation(system.moments) : 0.0;
  match.inside = static_cast<int>(system.moments.n);
  const Eigen::LDLT<Eigen::Matrix4d> full(system.normal);
  if (full.info() == Eigen::Success && full.isPositive() && full.rcond() > 1e-12) {
    match.scale = 1.0 + full.solve(system.rhs)(3);
    const Eigen::Matrix4d covariance = system.variance * full.solve(Eigen::Matrix4d::Identity());
    match.scale_sigma = std::sqrt(std::max(0.0, covariance(3, 3)));
  }
  return match;
}

std::vector<PlanarSample> average_cells(const std::vector<PlanarSample>& samples, double cell_m) {
  std::unordered_map<std::uint64_t, std::size_t> cells;
  std::vector<PlanarSample> out;
  std::vector<int> count;
  const auto inverse = static_cast<float>(1.0 / cell_m);
  for (const PlanarSample& sample : samples) {
    const auto x = static_cast<std::int64_t>(std::floor(sample.uv_m.x() * inverse));
    const auto y = static_cast<std::int64_t>(std::floor(sample.uv_m.y() * inverse));
    const std::uint64_t key = static_cast<std::uint64_t>(x + (1LL << 31)) << 32U |
                              static_cast<std::uint64_t>((y + (1LL << 31)) & 0xFFFFFFFF);
    const auto [slot, fresh] = cells.try_emplace(key, out.size());
    if (fresh) {
      out.emplace_back();
      count.push_back(0);
    }
    PlanarSample& cell = out[slot->second];
    const float share = 1.0F / static_cast<float>(++count[slot->second]);
    cell.uv_m += share * (sample.uv_m - cell.uv_m);
    cell.intensity += share * (sample.intensity - cell.intensity);
  }
  return out;
}

}  // namespace lvcalib
