// SPDX-License-Identifier: BSD-3-Clause
#include "target/blurred_print.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "base/parallel.h"
#include "base/statistics.h"

namespace lvcalib {
namespace {

// From one width to the next. Between two levels LevelBlend then misses an edge by at most 2·10⁻⁵
// of the contrast and its largest slope by 0.3 %: (v₁−v₀)⁴/384 · max|∂⁴A/∂v⁴| with ∂/∂v = ½∇², and
// (1/σ₀−1/σ₁)²/8 · max|∂²|∇A|/∂(1/σ)²|.
constexpr double kRatio = 1.15;
// Largest raster side; the first width follows from it. 1.1 mm on a board of a metre: below what
// any LiDAR's beam is wide at the nearest useful range.
constexpr double kLargestRaster = 1800.0;
// A spot sees nothing but white or black if less than this of another colour is in it: a fifth of
// what the parabola between levels may miss by.
constexpr double kPlain = 1e-4;

struct BlackRectangle {
  Eigen::Vector2d lower_left, upper_right;
};

// The print as disjoint black rectangles (bits of tags, squares) and discs.
struct BlackShapes {
  std::vector<BlackRectangle> rectangles;
  std::vector<Eigen::Vector2d> discs;
  double disc_radius = 0.0;
};

void add_squares(const Target& t, BlackShapes& shapes) {
  const Eigen::Vector2d square(t.column_spacing_m, t.row_spacing_m);
  for (int row = -1; row < t.corner_rows; ++row) {
    for (int column = -1; column < t.corner_columns; ++column) {
      if (!t.square_is_black(column, row)) continue;
      const Eigen::Vector2d from = square.cwiseProduct(Eigen::Vector2d(column, row));
      shapes.rectangles.push_back({from, from + square});
    }
  }
}

void add_tag(const Target& t, const TargetTag& tag, BlackShapes& shapes) {
  const TagPattern* pattern = tag_pattern(t.tag_family, tag.id);
  const double bit = t.tag_bit_m();
  const int border = t.tag_border_bits;
  const int side = static_cast<int>(std::lround(t.tag_size_m / bit));
  const Eigen::Vector2d origin = tag.center_m - 0.5 * t.tag_size_m * Eigen::Vector2d(1.0, 1.0);
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side;) {
      const auto white = [&](int column) {
        const int c = column - border;
        const int r = side - 1 - y - border;
        return pattern != nullptr && c >= 0 && r >= 0 && c < pattern->width && r < pattern->width &&
               pattern->at(r, c);
      };
      if (white(x)) {
        ++x;
        continue;
      }
      int end = x;
      while (end < side && !white(end)) ++end;
      shapes.rectangles.push_back(
          {origin + bit * Eigen::Vector2d(x, y), origin + bit * Eigen::Vector2d(end, y + 1)});
      x = end;
    }
  }
}

BlackShapes black_shapes(const Target& target) {
  BlackShapes shapes;
  if (target.has_squares()) add_squares(target, shapes);
  for (const TargetTag& tag : target.tags()) add_tag(target, tag, shapes);
  for (const TargetNode& node : target.nodes()) shapes.discs.push_back(node.center_m);
  shapes.disc_radius = target.circle_radius_m;
  return shapes;
}

// Beyond so many widths from an edge nothing of it is left: Φ(−5) = 3·10⁻⁷.
constexpr double kReach = 5.0;

// Share of black that a round spot sees of a disc, by the distance of its middle from the disc's:
// value and first two derivatives, tabled at a sixteenth of the spot's width.
class DiscProfile {
 public:
  DiscProfile(double radius, double sigma)
      : step_(sigma / 16.0), begin_(std::max(0.0, radius - kReach * sigma)) {
    const int count = static_cast<int>(std::ceil((radius + kReach * sigma - begin_) / step_)) + 2;
    // The spot's strips across: Σ over y of N(y)·(what the chord at y covers of the strip).
    const double most = std::min(radius, 6.0 * sigma);
    constexpr int kStrips = 400;
    std::array<double, kStrips> weight{};
    std::array<double, kStrips> chord{};
    for (int i = 0; i < kStrips; ++i) {
      // Chebyshev's places: chords end steeply where the strip touches the disc.
      const double angle = std::numbers::pi * (i + 0.5) / kStrips;
      const double y = most * std::cos(angle);
      const auto k = static_cast<std::size_t>(i);
      weight[k] =
          normal_pdf(y / sigma) / sigma * most * std::sin(angle) * std::numbers::pi / kStrips;
      chord[k] = std::sqrt(std::max(0.0, radius * radius - y * y));
    }
    for (int n = 0; n < count; ++n) {
      const double rho = begin_ + n * step_;
      Derivatives d{};
      for (std::size_t k = 0; k < kStrips; ++k) {
        const double near = (rho + chord[k]) / sigma;
        const double far = (rho - chord[k]) / sigma;
        d[0] += weight[k] * (normal_cdf(near) - normal_cdf(far));
        d[1] += weight[k] * (normal_pdf(near) - normal_pdf(far)) / sigma;
        d[2] += weight[k] * (far * normal_pdf(far) - near * normal_pdf(near)) / (sigma * sigma);
      }
      table_.push_back(d);
    }
  }

  using Derivatives = std::array<double, 3>;
  [[nodiscard]] Derivatives at(double rho) const {
    const double t = (rho - begin_) / step_;
    if (t < 0.0) return {1.0, 0.0, 0.0};
    const auto n = static_cast<std::size_t>(t);
    if (n + 1 >= table_.size()) return {0.0, 0.0, 0.0};
    const double f = t - static_cast<double>(n);
    // Taylor from either side, blended: exact to the fourth order.
    Derivatives out{};
    for (const bool upper : {false, true}) {
      const Derivatives& d = table_[n + (upper ? 1 : 0)];
      const double h = step_ * (upper ? f - 1.0 : f);
      const double w = upper ? f : 1.0 - f;
      out[0] += w * (d[0] + h * d[1] + 0.5 * h * h * d[2]);
      out[1] += w * (d[1] + h * d[2]);
      out[2] += w * d[2];
    }
    return out;
  }

 private:
  double step_;
  double begin_;
  std::vector<Derivatives> table_;
};

// Cubic Hermite weights at t in [0, 1]: of the values and slopes at 0 and 1; with derivatives.
template <class Real>
struct HermiteWeights {
  Real v0, s0, v1, s1;
};
template <class Real>
HermiteWeights<Real> hermite(Real t) {
  const Real u = 1 - t;
  return {(1 + 2 * t) * u * u, t * u * u, t * t * (3 - 2 * t), -t * t * u};
}
template <class Real>
HermiteWeights<Real> hermite_slope(Real t) {
  const Real u = 1 - t;
  return {-6 * t * u, u * (1 - 3 * t), 6 * t * u, t * (3 * t - 2)};
}
template <class Real>
HermiteWeights<Real> hermite_curvature(Real t) {
  return {12 * t - 6, 6 * t - 4, 6 - 12 * t, 6 * t - 2};
}

// Quadrature along the longer axis, in units of its excess width: exact to 5·10⁻⁴ of the contrast
// for an edge across it (Gauss–Hermite while the excess is small, else equal steps, whose error is
// 2·exp(−2π²σ₁²σₑ²/((σ₁²+σₑ²)Δ²))).
struct Quadrature {
  static constexpr int kMost = 33;
  std::array<double, kMost> at, weight;
  int count = 0;
};

// A Gauss–Hermite rule, half of it: the middle first.
struct HermiteRule {
  double largest_excess;  // σₑ²/σ₁² up to which it misses an edge by less than 3·10⁻⁴.
  int half;
  std::array<double, 5> at, weight;
};
// Of three, five, nine and eleven places, the last two without their outermost pair, whose weights
// are 2·10⁻⁵ and 8·10⁻⁷.
constexpr std::array<HermiteRule, 4> kHermite{{
    {0.27, 1, {0.0, 1.732050807568877}, {2.0 / 3.0, 1.0 / 6.0}},
    {0.85,
     2,
     {0.0, 1.355626179974266, 2.856970013872806},
     {0.533333333333333, 0.222075922005613, 0.011257411327721}},
    {2.1,
     3,
     {0.0, 1.023255663789132, 2.076847978677830, 3.205429002856470},
     {0.406349206349206, 0.244097502894939, 0.049916406765218, 0.002789141321232}},
    {2.8,
     4,
     {0.0, 0.928868997381064, 1.876035020154846, 2.865123160643645, 3.936166607129977},
     {0.369408369408369, 0.242240299873970, 0.066138746071058, 0.006720285235537,
      0.000195671930271}},
}};

Quadrature quadrature(double excess_ratio) {
  Quadrature q;
  if (excess_ratio < 1e-3) {
    q.at[0] = 0.0;
    q.weight[0] = 1.0;
    q.count = 1;
    return q;
  }
  for (const HermiteRule& rule : kHermite) {
    if (excess_ratio >= rule.largest_excess) continue;
    for (int k = -rule.half; k <= rule.half; ++k) {
      const auto from = static_cast<std::size_t>(std::abs(k));
      const auto to = static_cast<std::size_t>(q.count++);
      q.at[to] = k < 0 ? -rule.at[from] : rule.at[from];
      q.weight[to] = rule.weight[from];
    }
    return q;
  }
  constexpr double kExtent = 3.5;
  const double step = 1.35 / std::sqrt(1.0 + excess_ratio);
  const int half =
      std::min((Quadrature::kMost - 1) / 2, static_cast<int>(std::ceil(kExtent / step)));
  double sum = 0.0;
  double variance = 0.0;
  for (int i = -half; i <= half; ++i) {
    const double x = std::min(step, kExtent / half) * i;
    const double w = std::exp(-0.5 * x * x);
    const auto k = static_cast<std::size_t>(q.count++);
    q.at[k] = x;
    q.weight[k] = w;
    sum += w;
    variance += w * x * x;
  }
  // Cutting the tails must not make the spot narrower.
  const double stretch = std::sqrt(sum / variance);
  for (int k = 0; k < q.count; ++k) {
    q.at[static_cast<std::size_t>(k)] *= stretch;
    q.weight[static_cast<std::size_t>(k)] /= sum;
  }
  return q;
}

// Weights of two levels v₀ ≤ v ≤ v₁ for what lies between. Values: the cubic whose slopes by v are
// known, ∂A/∂v = ½∇²A. Slopes and curvatures: linear in 1/σ, as the slope of an edge grows.
struct LevelBlend {
  std::array<double, 2> value, heat, slope;  // `heat`: weight of ∇²A.
  LevelBlend(double v0, double v1, double v) {
    const double step = v1 - v0;
    const HermiteWeights<double> w = hermite((v - v0) / step);
    value = {w.v0, w.v1};
    heat = {0.5 * step * w.s0, 0.5 * step * w.s1};
    const double near = 1.0 / std::sqrt(v0);
    const double far = 1.0 / std::sqrt(v1);
    const double t = (near - 1.0 / std::sqrt(v)) / (near - far);
    slope = {1.0 - t, t};
  }
};

}  // namespace

// One isotropic blur: at each sample the value, the slopes along y and x and the mixed derivative,
// all per step: in this order value and y slope, and x slope and mixed derivative, are interpolated
// along x side by side.
struct BlurredPrint::Level {
  Eigen::Vector2d origin = Eigen::Vector2d::Zero();  // Of sample (0, 0).
  double step = 0.0;
  double per_step = 0.0;
  int columns = 0;
  int rows = 0;
  template <class Number>
  using Samples = std::vector<std::array<Number, 4>>;
  Samples<std::int16_t> samples;  // In kUnit.

  Level(const Target& target, const BoardOutline& outline, double sigma, double spacing) {
    step = spacing * sigma;
    per_step = 1.0 / step;
    // Room for the blur beyond the outline, where the print is white.
    const Eigen::Vector2d border = 4.0 * sigma * Eigen::Vector2d(1.0, 1.0);
    const Eigen::Vector2d size = outline.size_m() + 2.0 * border;
    columns = static_cast<int>(std::ceil(size.x() / step)) + 1;
    rows = static_cast<int>(std::ceil(size.y() / step)) + 1;
    origin = outline.lower_left_m - border;
    Samples<float> exact(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows),
                         {1.0F, 0.0F, 0.0F, 0.0F});
    const BlackShapes shapes = black_shapes(target);
    // Tags have many bits between the same two lines.
    std::map<std::pair<double, double>, Strip> across;
    std::map<std::pair<double, double>, Strip> along;
    const auto of = [&](auto& strips, double a, double b, double start, int count) -> const Strip& {
      const auto [at, fresh] = strips.try_emplace({a, b});
      if (fresh) at->second = strip(a, b, start, count, sigma);
      return at->second;
    };
    for (const BlackRectangle& r : shapes.rectangles) {
      blacken(of(across, r.lower_left.x(), r.upper_right.x(), origin.x(), columns),
              of(along, r.lower_left.y(), r.upper_right.y(), origin.y(), rows), exact);
    }
    if (!shapes.discs.empty()) {
      const DiscProfile profile(shapes.disc_radius, sigma);
      for (const Eigen::Vector2d& center : shapes.discs)
        blacken(center, shapes.disc_radius + kReach * sigma, profile, exact);
    }
    samples.resize(exact.size());
    for (std::size_t k = 0; k < exact.size(); ++k) {
      for (std::size_t i = 0; i < 4; ++i)
        samples[k][i] = static_cast<std::int16_t>(std::lround(exact[k][i] / kUnit));
    }
  }

  // What a strip from a to b lets a spot see, per sample: value and slope per step.
  struct Strip {
    int first = 0;
    std::vector<double> value, slope;
  };
  [[nodiscard]] Strip strip(double a, double b, double start, int count, double sigma) const {
    Strip s;
    s.first =
        std::clamp(static_cast<int>(std::floor((a - kReach * sigma - start) / step)), 0, count);
    const int last =
        std::clamp(static_cast<int>(std::ceil((b + kReach * sigma - start) / step)), 0, count - 1);
    for (int i = s.first; i <= last; ++i) {
      const double x = start + i * step;
      s.value.push_back(normal_cdf((x - a) / sigma) - normal_cdf((x - b) / sigma));
      s.slope.push_back((normal_pdf((x - a) / sigma) - normal_pdf((x - b) / sigma)) * step / sigma);
    }
    return s;
  }

  // A rectangle's blur is the product of its two strips'.
  void blacken(const Strip& x, const Strip& y, Samples<float>& exact) const {
    for (std::size_t j = 0; j < y.value.size(); ++j) {
      std::array<float, 4>* row =
          &exact[(static_cast<std::size_t>(y.first) + j) * static_cast<std::size_t>(columns) +
                 static_cast<std::size_t>(x.first)];
      for (std::size_t i = 0; i < x.value.size(); ++i) {
        row[i][0] -= static_cast<float>(x.value[i] * y.value[j]);
        row[i][1] -= static_cast<float>(x.value[i] * y.slope[j]);
        row[i][2] -= static_cast<float>(x.slope[i] * y.value[j]);
        row[i][3] -= static_cast<float>(x.slope[i] * y.slope[j]);
      }
    }
  }

  void blacken(const Eigen::Vector2d& center, double reach, const DiscProfile& profile,
               Samples<float>& exact) const {
    const auto index = [&](double at, int count) {
      return std::clamp(static_cast<int>(std::floor(at / step)), 0, count - 1);
    };
    const Eigen::Vector2d c = center - origin;
    for (int r = index(c.y() - reach, rows); r <= index(c.y() + reach, rows); ++r) {
      for (int k = index(c.x() - reach, columns); k <= index(c.x() + reach, columns); ++k) {
        const Eigen::Vector2d d = step * Eigen::Vector2d(k, r) - c;
        const double rho = d.norm();
        const auto [value, first, second] = profile.at(rho);
        auto& sample = exact[static_cast<std::size_t>(r) * static_cast<std::size_t>(columns) +
                             static_cast<std::size_t>(k)];
        sample[0] -= static_cast<float>(value);
        if (rho <= 0.0) continue;
        const Eigen::Vector2d u = d / rho;
        sample[1] -= static_cast<float>(first * u.y() * step);
        sample[2] -= static_cast<float>(first * u.x() * step);
        sample[3] -= static_cast<float>((second - first / rho) * u.x() * u.y() * step * step);
      }
    }
  }

  [[nodiscard]] const std::array<std::int16_t, 4>& sample(int c, int r) const {
    return samples[static_cast<std::size_t>(r) * static_cast<std::size_t>(columns) +
                   static_cast<std::size_t>(c)];
  }

  [[nodiscard]] double nearest(const Eigen::Vector2d& p) const {
    const Eigen::Vector2d at = per_step * (p - origin);
    const auto place = [](double x, int count) {
      return static_cast<int>(std::clamp(x + 0.5, 0.0, count - 1.0));
    };
    return static_cast<double>(kUnit) * sample(place(at.x(), columns), place(at.y(), rows))[0];
  }

  // Tables are larger than a processor's own cache: what add() will read there is asked for ahead.
  void expect(const Eigen::Vector2d& p) const {
    const double ax = (p.x() - origin.x()) * per_step;
    const double ay = (p.y() - origin.y()) * per_step;
    if (!(ax >= 0.0 && ay >= 0.0 && ax < columns - 1 && ay < rows - 1)) return;
    const auto* const lower = &sample(static_cast<int>(ax), static_cast<int>(ay));
    __builtin_prefetch(lower);
    __builtin_prefetch(lower + columns);
  }

  // Value, slopes and second derivatives, per step, summed over places with weights: each in four
  // parts, of value and y slope on the rows below and above, which are added at the end.
  class Sum {
   public:
    [[nodiscard]] double white() const { return outside_ + of(white_); }
    [[nodiscard]] double x() const { return of(x_); }
    [[nodiscard]] double y() const { return of(y_); }
    [[nodiscard]] double xx() const { return of(xx_); }
    [[nodiscard]] double xy() const { return of(xy_); }
    [[nodiscard]] double yy() const { return of(yy_); }

   private:
    friend struct Level;
    using Four = Eigen::Array4f;
    static double of(const Four& four) { return static_cast<double>(four.sum()); }
    double outside_ = 0.0;  // White beyond the samples.
    Four white_ = Four::Zero(), x_ = Four::Zero(), y_ = Four::Zero();
    Four xx_ = Four::Zero(), xy_ = Four::Zero(), yy_ = Four::Zero();
  };

  // Adds weight × what is seen at a place. Hot: four numbers of single precision at once, as the
  // samples have; all six come from the three interpolations along x.
  void add(const Eigen::Vector2d& p, double weight, Sum& out) const {
    const double ax = (p.x() - origin.x()) * per_step;
    const double ay = (p.y() - origin.y()) * per_step;
    if (!(ax >= 0.0 && ay >= 0.0 && ax < columns - 1 && ay < rows - 1)) {
      out.outside_ += weight;
      return;
    }
    const int c = static_cast<int>(ax);
    const int r = static_cast<int>(ay);
    const auto tx = static_cast<float>(ax - c);
    const auto ty = static_cast<float>(ay - r);
    const std::array<std::int16_t, 4>* lower = &sample(c, r);
    const std::array<std::int16_t, 4>* upper = lower + columns;
    using Four = Eigen::Array4f;
    const auto four = [](const std::array<std::int16_t, 4>& below,
                         const std::array<std::int16_t, 4>& above, std::size_t k) {
      return Four(below[k], below[k + 1], above[k], above[k + 1]);
    };
    const Four a = four(lower[0], upper[0], 0), as = four(lower[0], upper[0], 2);
    const Four b = four(lower[1], upper[1], 0), bs = four(lower[1], upper[1], 2);
    const auto along = [&](const HermiteWeights<float>& w) -> Four {
      return w.v0 * a + w.s0 * as + w.v1 * b + w.s1 * bs;
    };
    const auto across = [unit = static_cast<float>(weight) *
                                kUnit](const HermiteWeights<float>& w) -> Four {
      return unit * Four(w.v0, w.s0, w.v1, w.s1);
    };
    const Four value = along(hermite(tx)), slope = along(hermite_slope(tx)),
               curvature = along(hermite_curvature(tx));
    const Four y = across(hermite(ty)), dy = across(hermite_slope(ty)),
               ddy = across(hermite_curvature(ty));
    out.white_ += value * y;
    out.x_ += slope * y;
    out.y_ += value * dy;
    out.xx_ += curvature * y;
    out.xy_ += slope * dy;
    out.yy_ += value * ddy;
  }
};

BlurredPrint::BlurredPrint(const Target& target, double spacing)
    : target_(target), outline_(target.outline()), edges_(target), spacing_(spacing) {
  first_sigma_m_ = outline_.size_m().maxCoeff() / (kSpacing * kLargestRaster);
  for (int k = 0; k < kLevels; ++k)
    variance_m2_[static_cast<std::size_t>(k)] = std::pow(sigma_m(k), 2);
}

BlurredPrint::~BlurredPrint() {
  for (auto& level : levels_) delete level.load();
}

double BlurredPrint::sigma_m(int index) const {
  return first_sigma_m_ * std::pow(kRatio, index);
}

int BlurredPrint::level_below(double sigma) const {
  return static_cast<int>(std::floor(std::log(sigma / first_sigma_m_) / std::log(kRatio)));
}

const BlurredPrint::Level& BlurredPrint::level(int index) const {
  auto& slot = levels_[static_cast<std::size_t>(index)];
  const Level* made = slot.load(std::memory_order_acquire);
  if (made != nullptr) return *made;
  const std::lock_guard lock(building_[static_cast<std::size_t>(index)]);
  made = slot.load(std::memory_order_acquire);
  if (made == nullptr) {
    made = new Level(target_, outline_, sigma_m(index), spacing_);
    slot.store(made, std::memory_order_release);
  }
  return *made;
}

void BlurredPrint::prepare(double smallest_m, double largest_m, int threads) const {
  const int first = std::clamp(level_below(smallest_m) - 1, 0, kLevels - 1);
  const int last = std::clamp(level_below(largest_m) + 2, 0, kLevels - 1);
  // The finest take longest: they come first.
  parallel_for(static_cast<std::size_t>(last - first + 1), threads,
               [&](std::size_t k) { level(first + static_cast<int>(k)); });
}

BlurredPrint::Coarse BlurredPrint::coarse(double sigma) const {
  const Level& source = level(std::clamp(level_below(sigma), 0, kLevels - 1));
  Coarse view;
  view.first_ = source.samples.front().data();
  view.origin_ = source.origin;
  view.per_step_ = source.per_step;
  view.columns_ = source.columns;
  view.rows_ = source.rows;
  return view;
}

PrintSample BlurredPrint::at(const Eigen::Vector2d& board_m, const Eigen::Matrix2d& blur_m2) const {
  static const double kPerLevel = 0.5 / std::log(kRatio);  // Of the logarithm of a variance.
  const double mean = 0.5 * (blur_m2(0, 0) + blur_m2(1, 1));
  const double difference = 0.5 * (blur_m2(0, 0) - blur_m2(1, 1));
  const double spread = std::sqrt(difference * difference + blur_m2(0, 1) * blur_m2(0, 1));
  const double minor = std::clamp(mean - spread, variance_m2_.front(), variance_m2_[kLevels - 2]);
  const double major = std::max(mean + spread, minor);

  PrintSample out;
  // Plain print: N(0, S) lies nowhere above √(major/minor) times the isotropic N(0, major).
  const double per_first = 1.0 / variance_m2_.front();
  const auto level_of = [&](double variance) {
    return static_cast<int>(kPerLevel * std::log(variance * per_first));
  };
  const int wide = std::min(kLevels - 1, level_of(major) + 2);
  const double around = level(wide).nearest(board_m);
  const double plain = kPlain * std::sqrt(minor / major);
  if (around > 1.0 - plain || around < plain) {
    out.white = around > 0.5 ? 1.0 : 0.0;
    return out;
  }

  // Between two levels: their blends by v = σ².
  const int below = std::min(level_of(minor), kLevels - 2);
  const std::array<const Level*, 2> sources{&level(below), &level(below + 1)};
  for (const Level* const source : sources) source->expect(board_m);
  const LevelBlend blend(variance_m2_[static_cast<std::size_t>(below)],
                         variance_m2_[static_cast<std::size_t>(below + 1)], minor);

  const double excess = major - minor;
  const Quadrature q = quadrature(excess / minor);
  Eigen::Vector2d axis(1.0, 0.0);
  if (spread > 0.0) {
    // Half the angle of (difference, covariance).
    const double cosine = std::sqrt(std::max(0.0, 0.5 * (1.0 + difference / spread)));
    const double sine = std::sqrt(std::max(0.0, 0.5 * (1.0 - difference / spread)));
    axis = {cosine, std::copysign(sine, blur_m2(0, 1))};
  }
  axis *= std::sqrt(excess);
  out.white = 0.0;
  for (std::size_t i = 0; i < 2; ++i) {
    if (i == 1 && blend.slope[1] == 0.0) break;
    const Level& source = *sources[i];
    Level::Sum sum;
    for (int k = 0; k < q.count; ++k) {
      const auto j = static_cast<std::size_t>(k);
      source.add(board_m + q.at[j] * axis, q.weight[j], sum);
    }
    const double second = source.per_step * source.per_step;
    const double xx = sum.xx();
    const double yy = sum.yy();
    out.white += blend.value[i] * sum.white() + blend.heat[i] * second * (xx + yy);
    out.gradient_per_m += blend.slope[i] * source.per_step * Eigen::Vector2d(sum.x(), sum.y());
    out.hessian_per_m2(0, 0) += blend.slope[i] * second * xx;
    out.hessian_per_m2(0, 1) += blend.slope[i] * second * sum.xy();
    out.hessian_per_m2(1, 1) += blend.slope[i] * second * yy;
  }
  out.hessian_per_m2(1, 0) = out.hessian_per_m2(0, 1);
  return out;
}

LocalPrint::LocalPrint(const Eigen::Vector2d& board_m, const Eigen::Matrix2d& blur_m2,
                       const PrintSample& sample)
    : board_m_(board_m.cast<float>()),
      blur_m2_(Eigen::Vector3d(blur_m2(0, 0), blur_m2(0, 1), blur_m2(1, 1)).cast<float>()),
      white_(static_cast<float>(sample.white)),
      gradient_(sample.gradient_per_m.cast<float>()),
      hessian_(Eigen::Vector3d(sample.hessian_per_m2(0, 0), sample.hessian_per_m2(0, 1),
                               sample.hessian_per_m2(1, 1))
                   .cast<float>()) {}

std::optional<PrintSample> LocalPrint::at(const Eigen::Vector2d& board_m,
                                          const Eigen::Matrix2d& blur_m2) const {
  constexpr double kNear2 = 0.1 * 0.1;
  constexpr double kLike2 = 0.03 * 0.03;
  const Eigen::Vector3d s = blur_m2_.cast<double>();
  const double determinant = s(0) * s(2) - s(1) * s(1);
  if (!(determinant > 0.0)) return std::nullopt;
  const Eigen::Vector2d d = board_m - board_m_.cast<double>();
  // dᵀS⁻¹d, and the squared Frobenius norm of S⁻¹ΔS.
  const double far2 = s(2) * d.x() * d.x() - 2.0 * s(1) * d.x() * d.y() + s(0) * d.y() * d.y();
  if (!(far2 < kNear2 * determinant)) return std::nullopt;
  const Eigen::Vector3d grown(blur_m2(0, 0) - s(0), blur_m2(0, 1) - s(1), blur_m2(1, 1) - s(2));
  const double aa = s(2) * grown(0) - s(1) * grown(1);
  const double ab = s(2) * grown(1) - s(1) * grown(2);
  const double ba = s(0) * grown(1) - s(1) * grown(0);
  const double bb = s(0) * grown(2) - s(1) * grown(1);
  if (!(aa * aa + ab * ab + ba * ba + bb * bb < kLike2 * determinant * determinant))
    return std::nullopt;
  PrintSample out;
  const Eigen::Vector3d h = hessian_.cast<double>();
  out.hessian_per_m2 << h(0), h(1), h(1), h(2);
  const Eigen::Vector2d bent = out.hessian_per_m2 * d;
  out.gradient_per_m = gradient_.cast<double>() + bent;
  out.white = static_cast<double>(white_) + gradient_.cast<double>().dot(d) + 0.5 * bent.dot(d) +
              0.5 * (h(0) * grown(0) + 2.0 * h(1) * grown(1) + h(2) * grown(2));
  return out;
}

}  // namespace lvcalib
