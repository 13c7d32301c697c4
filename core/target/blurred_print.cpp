// SPDX-License-Identifier: BSD-3-Clause
#include "target/blurred_print.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lvcalib {
namespace {

// From one width to the next. The parabola through three levels then misses an edge by at most
// 8·10⁻⁴ of the contrast: |(v−v₀)(v−v₁)(v−v₂)|/6 · max|∂³A/∂v³| with ∂/∂v = ½∇².
constexpr double kRatio = 1.18;
// Spacing of the samples in widths.
constexpr double kSpacing = 0.5;
// Largest raster side; the first width follows from it. 1.6 mm on a board of a metre: below what
// any LiDAR's beam is wide at the nearest useful range.
constexpr double kLargestRaster = 1800.0;
// A spot sees nothing but white or black if less than this of another colour is in it.
constexpr double kPlain = 1e-5;

struct BlackRectangle {
  Eigen::Vector2d lower_left, upper_right;
};

// The print as disjoint black rectangles (bits of tags, squares) and discs.
struct BlackShapes {
  std::vector<BlackRectangle> rectangles;
  std::vector<Eigen::Vector2d> discs;
  double disc_radius = 0.0;
};

void add_checkerboard(const Target& t, BlackShapes& shapes) {
  const Eigen::Vector2d square(t.column_spacing_m, t.row_spacing_m);
  for (int row = -1; row < t.corner_rows; ++row) {
    for (int column = -1; column < t.corner_columns; ++column) {
      if (((column + row) & 1) != 0) continue;
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
  const Eigen::Vector2d origin =
      tag.center_m - 0.5 * t.tag_size_m * Eigen::Vector2d(1.0, 1.0);
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side;) {
      const auto white = [&](int column) {
        const int c = column - border;
        const int r = side - 1 - y - border;
        return pattern != nullptr && c >= 0 && r >= 0 && c < pattern->width &&
               r < pattern->width && pattern->at(r, c);
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
  if (target.type == TargetType::kCheckerboard) {
    add_checkerboard(target, shapes);
    return shapes;
  }
  for (const TargetTag& tag : target.tags()) add_tag(target, tag, shapes);
  for (const TargetNode& node : target.nodes()) shapes.discs.push_back(node.center_m);
  shapes.disc_radius = target.circle_radius_m;
  return shapes;
}

// ∫ √(r²−x²) dx.
double half_disc_integral(double x, double r) {
  const double c = std::clamp(x / r, -1.0, 1.0);
  return 0.5 * r * r * (c * std::sqrt(1.0 - c * c) + std::asin(c));
}

// Area of the disc (about the origin) within x₀ ≤ x ≤ x₁ and y ≤ top.
double disc_area_below(double x0, double x1, double top, double r) {
  x0 = std::clamp(x0, -r, r);
  x1 = std::clamp(x1, -r, r);
  if (x1 <= x0 || top <= -r) return 0.0;
  const double whole = 2.0 * (half_disc_integral(x1, r) - half_disc_integral(x0, r));
  if (top >= r) return whole;
  // Where the chord lies inside the disc the column is cut at it.
  const double c = std::sqrt(std::max(0.0, r * r - top * top));
  const double a = std::clamp(-c, x0, x1);
  const double b = std::clamp(c, x0, x1);
  const double cut = half_disc_integral(b, r) - half_disc_integral(a, r);
  const double below = top * (b - a) + cut;
  return top >= 0.0 ? whole - 2.0 * cut + below : below;
}

double disc_area(const Eigen::Vector2d& low, const Eigen::Vector2d& high, double r) {
  return disc_area_below(low.x(), high.x(), high.y(), r) -
         disc_area_below(low.x(), high.x(), low.y(), r);
}

// Share of white in every cell of a raster.
class CoverageRaster {
 public:
  CoverageRaster(const Eigen::Vector2d& origin, double step, int columns, int rows)
      : origin_(origin), step_(step), columns_(columns), rows_(rows) {
    white.assign(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows), 1.0F);
  }

  void blacken(const BlackShapes& shapes) {
    for (const BlackRectangle& r : shapes.rectangles) blacken(r);
    for (const Eigen::Vector2d& center : shapes.discs) blacken(center, shapes.disc_radius);
  }

  std::vector<float> white;

 private:
  struct Cells {
    int c0, c1, r0, r1;
  };
  [[nodiscard]] Cells cells(const Eigen::Vector2d& low, const Eigen::Vector2d& high) const {
    const auto index = [this](double x, int last) {
      return std::clamp(static_cast<int>(std::floor(x / step_)), 0, last);
    };
    const Eigen::Vector2d a = low - origin_;
    const Eigen::Vector2d b = high - origin_;
    return {index(a.x(), columns_ - 1), index(b.x(), columns_ - 1), index(a.y(), rows_ - 1),
            index(b.y(), rows_ - 1)};
  }
  float& at(int c, int r) {
    return white[static_cast<std::size_t>(r) * static_cast<std::size_t>(columns_) +
                 static_cast<std::size_t>(c)];
  }
  // Length of [low, high] within cell i, in cells.
  static double overlap(double low, double high, int i) {
    return std::max(0.0, std::min(high, i + 1.0) - std::max(low, static_cast<double>(i)));
  }

  void blacken(const BlackRectangle& rectangle) {
    const Eigen::Vector2d a = (rectangle.lower_left - origin_) / step_;
    const Eigen::Vector2d b = (rectangle.upper_right - origin_) / step_;
    const Cells n = cells(rectangle.lower_left, rectangle.upper_right);
    for (int r = n.r0; r <= n.r1; ++r) {
      const double y = overlap(a.y(), b.y(), r);
      for (int c = n.c0; c <= n.c1; ++c)
        at(c, r) -= static_cast<float>(y * overlap(a.x(), b.x(), c));
    }
  }

  void blacken(const Eigen::Vector2d& center, double radius) {
    const Eigen::Vector2d reach(radius, radius);
    const Cells n = cells(center - reach, center + reach);
    for (int r = n.r0; r <= n.r1; ++r) {
      for (int c = n.c0; c <= n.c1; ++c) {
        const Eigen::Vector2d low = origin_ + step_ * Eigen::Vector2d(c, r) - center;
        const Eigen::Vector2d high = low + Eigen::Vector2d(step_, step_);
        at(c, r) -= static_cast<float>(disc_area(low, high, radius) / (step_ * step_));
      }
    }
  }

  Eigen::Vector2d origin_;
  double step_;
  int columns_, rows_;
};

// Gaussian weights and those of its slope, over whole samples.
struct Kernels {
  std::vector<float> value, slope;
  int half = 0;
};

Kernels gaussian_kernels(double sigma) {
  Kernels k;
  k.half = static_cast<int>(std::ceil(4.5 * sigma));
  double sum = 0.0;
  double moment = 0.0;
  std::vector<double> value;
  std::vector<double> slope;
  for (int i = -k.half; i <= k.half; ++i) {
    const double g = std::exp(-0.5 * i * i / (sigma * sigma));
    value.push_back(g);
    slope.push_back(i * g);
    sum += g;
    moment += static_cast<double>(i) * i * g;
  }
  for (std::size_t i = 0; i < value.size(); ++i) {
    k.value.push_back(static_cast<float>(value[i] / sum));
    k.slope.push_back(static_cast<float>(slope[i] / moment));
  }
  return k;
}

// Cubic Hermite weights at t in [0, 1]: of the values and slopes at 0 and 1; with derivatives.
struct HermiteWeights {
  double v0, s0, v1, s1;
};
HermiteWeights hermite(double t) {
  const double u = 1.0 - t;
  return {(1.0 + 2.0 * t) * u * u, t * u * u, t * t * (3.0 - 2.0 * t), -t * t * u};
}
HermiteWeights hermite_slope(double t) {
  const double u = 1.0 - t;
  return {-6.0 * t * u, u * (1.0 - 3.0 * t), 6.0 * t * u, t * (3.0 * t - 2.0)};
}
HermiteWeights hermite_curvature(double t) {
  return {12.0 * t - 6.0, 6.0 * t - 4.0, 6.0 - 12.0 * t, 6.0 * t - 2.0};
}

// Quadrature along the longer axis, in units of its excess width: exact to 5·10⁻⁴ of the contrast
// for an edge across it (Gauss–Hermite while the excess is small, else equal steps, whose error is
// 2·exp(−2π²σ₁²σₑ²/((σ₁²+σₑ²)Δ²))).
struct Quadrature {
  static constexpr int kMost = 33;
  std::array<double, kMost> at, weight;
  int count = 0;
};

Quadrature quadrature(double excess_ratio) {
  Quadrature q;
  if (excess_ratio < 1e-3) {
    q.at[0] = 0.0;
    q.weight[0] = 1.0;
    q.count = 1;
    return q;
  }
  if (excess_ratio < 0.27) {
    const double x = std::sqrt(3.0);
    q.at = {-x, 0.0, x};
    q.weight = {1.0 / 6.0, 2.0 / 3.0, 1.0 / 6.0};
    q.count = 3;
    return q;
  }
  if (excess_ratio < 0.61) {
    const double a = std::sqrt(5.0 - std::sqrt(10.0));
    const double b = std::sqrt(5.0 + std::sqrt(10.0));
    const double wa = (7.0 + 2.0 * std::sqrt(10.0)) / 60.0;
    const double wb = (7.0 - 2.0 * std::sqrt(10.0)) / 60.0;
    q.at = {-b, -a, 0.0, a, b};
    q.weight = {wb, wa, 8.0 / 15.0, wa, wb};
    q.count = 5;
    return q;
  }
  constexpr double kExtent = 3.2;
  const double step = 1.54 / std::sqrt(1.0 + excess_ratio);
  const int half = std::min((Quadrature::kMost - 1) / 2, static_cast<int>(std::ceil(kExtent / step)));
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

}  // namespace

// One isotropic blur: at each sample the value, both slopes and the mixed derivative, all per step.
struct BlurredPrint::Level {
  Eigen::Vector2d origin = Eigen::Vector2d::Zero();  // Of sample (0, 0).
  double step = 0.0;
  int columns = 0;
  int rows = 0;
  std::vector<std::array<float, 4>> samples;

  Level(const Target& target, const BoardOutline& outline, double sigma) {
    step = kSpacing * sigma;
    // Room for the blur beyond the outline, where the print is white.
    const double border = 4.0 * sigma;
    const Eigen::Vector2d low = outline.lower_left_m - Eigen::Vector2d(border, border);
    const Eigen::Vector2d size = outline.size_m() + 2.0 * Eigen::Vector2d(border, border);
    columns = static_cast<int>(std::ceil(size.x() / step)) + 1;
    rows = static_cast<int>(std::ceil(size.y() / step)) + 1;
    origin = low + 0.5 * step * Eigen::Vector2d(1.0, 1.0);
    CoverageRaster raster(low, step, columns, rows);
    raster.blacken(black_shapes(target));
    blur(raster.white, gaussian_kernels(std::sqrt(sigma * sigma / (step * step) - 1.0 / 12.0)));
  }

  void blur(const std::vector<float>& white, const Kernels& kernels) {
    const auto width = static_cast<std::size_t>(columns);
    const int h = kernels.half;
    samples.resize(white.size());
    // Along the rows, then across them; white goes on beyond the border.
    std::vector<float> padded(width + 2 * static_cast<std::size_t>(h), 1.0F);
    std::vector<float> along(white.size());
    std::vector<float> along_slope(white.size());
    const std::size_t taps = kernels.value.size();
    for (int r = 0; r < rows; ++r) {
      const std::size_t start = static_cast<std::size_t>(r) * width;
      std::copy_n(white.begin() + static_cast<std::ptrdiff_t>(start), width, padded.begin() + h);
      for (std::size_t c = 0; c < width; ++c) {
        float v = 0.0F;
        float s = 0.0F;
        for (std::size_t t = 0; t < taps; ++t) {
          v += kernels.value[t] * padded[c + t];
          s += kernels.slope[t] * padded[c + t];
        }
        along[start + c] = v;
        along_slope[start + c] = s;
      }
    }
    std::vector<std::array<float, 4>> row(width);
    for (int r = 0; r < rows; ++r) {
      std::fill(row.begin(), row.end(), std::array<float, 4>{});
      for (int t = -h; t <= h; ++t) {
        const float kv = kernels.value[static_cast<std::size_t>(t + h)];
        const float ks = kernels.slope[static_cast<std::size_t>(t + h)];
        const int from = r + t;
        const bool outside = from < 0 || from >= rows;
        const float* v = outside ? nullptr : along.data() + static_cast<std::size_t>(from) * width;
        const float* s =
            outside ? nullptr : along_slope.data() + static_cast<std::size_t>(from) * width;
        for (std::size_t c = 0; c < width; ++c) {
          const float value = outside ? 1.0F : v[c];
          const float slope = outside ? 0.0F : s[c];
          row[c][0] += kv * value;
          row[c][1] += kv * slope;
          row[c][2] += ks * value;
          row[c][3] += ks * slope;
        }
      }
      std::copy(row.begin(), row.end(),
                samples.begin() + static_cast<std::ptrdiff_t>(static_cast<std::size_t>(r) * width));
    }
  }

  [[nodiscard]] const std::array<float, 4>& sample(int c, int r) const {
    return samples[static_cast<std::size_t>(r) * static_cast<std::size_t>(columns) +
                   static_cast<std::size_t>(c)];
  }

  [[nodiscard]] double nearest(const Eigen::Vector2d& p) const {
    const Eigen::Vector2d at = (p - origin) / step;
    const int c = std::clamp(static_cast<int>(std::lround(at.x())), 0, columns - 1);
    const int r = std::clamp(static_cast<int>(std::lround(at.y())), 0, rows - 1);
    return static_cast<double>(sample(c, r)[0]);
  }

  // Adds weight × (value, gradient, Hessian), the derivatives per metre.
  void add(const Eigen::Vector2d& p, double weight, PrintSample& out) const {
    const Eigen::Vector2d at = (p - origin) / step;
    if (!(at.x() >= 0.0 && at.y() >= 0.0 && at.x() < columns - 1 && at.y() < rows - 1)) {
      out.white += weight;
      return;
    }
    const int c = static_cast<int>(at.x());
    const int r = static_cast<int>(at.y());
    const double tx = at.x() - c;
    const double ty = at.y() - r;
    const HermiteWeights x = hermite(tx), dx = hermite_slope(tx), ddx = hermite_curvature(tx);
    const HermiteWeights y = hermite(ty), dy = hermite_slope(ty), ddy = hermite_curvature(ty);
    const std::array<float, 4>& a = sample(c, r);
    const std::array<float, 4>& b = sample(c + 1, r);
    const std::array<float, 4>& d = sample(c, r + 1);
    const std::array<float, 4>& e = sample(c + 1, r + 1);
    // Along x at the lower and upper row: the value's and the y slope's interpolants.
    const auto along = [](const HermiteWeights& w, const std::array<float, 4>& p0,
                          const std::array<float, 4>& p1, std::size_t k) {
      return w.v0 * p0[k] + w.s0 * p0[k + 1] + w.v1 * p1[k] + w.s1 * p1[k + 1];
    };
    const auto combine = [&](const HermiteWeights& wx, const HermiteWeights& wy) {
      return wy.v0 * along(wx, a, b, 0) + wy.s0 * along(wx, a, b, 2) +
             wy.v1 * along(wx, d, e, 0) + wy.s1 * along(wx, d, e, 2);
    };
    const double first = weight / step;
    const double second = first / step;
    out.white += weight * combine(x, y);
    out.gradient_per_m.x() += first * combine(dx, y);
    out.gradient_per_m.y() += first * combine(x, dy);
    out.hessian_per_m2(0, 0) += second * combine(ddx, y);
    out.hessian_per_m2(1, 1) += second * combine(x, ddy);
    out.hessian_per_m2(0, 1) += second * combine(dx, dy);
  }
};

BlurredPrint::BlurredPrint(const Target& target) : target_(target), outline_(target.outline()) {
  first_sigma_m_ = outline_.size_m().maxCoeff() / (kSpacing * kLargestRaster);
}

BlurredPrint::~BlurredPrint() {
  for (auto& level : levels_) delete level.load();
}

double BlurredPrint::sigma_m(int index) const {
  return first_sigma_m_ * std::pow(kRatio, index);
}

double BlurredPrint::smallest_sigma_m() const {
  return first_sigma_m_;
}

double BlurredPrint::largest_sigma_m() const {
  return sigma_m(kLevels - 1);
}

int BlurredPrint::level_below(double sigma) const {
  return static_cast<int>(std::floor(std::log(sigma / first_sigma_m_) / std::log(kRatio)));
}

const BlurredPrint::Level& BlurredPrint::level(int index) const {
  auto& slot = levels_[static_cast<std::size_t>(index)];
  const Level* made = slot.load(std::memory_order_acquire);
  if (made != nullptr) return *made;
  const std::lock_guard lock(building_);
  made = slot.load(std::memory_order_acquire);
  if (made == nullptr) {
    made = new Level(target_, outline_, sigma_m(index));
    slot.store(made, std::memory_order_release);
  }
  return *made;
}

double BlurredPrint::coarse(const Eigen::Vector2d& board_m, double sigma) const {
  const int k = std::clamp(level_below(sigma), 0, kLevels - 1);
  return level(k).nearest(board_m);
}

PrintSample BlurredPrint::at(const Eigen::Vector2d& board_m, const Eigen::Matrix2d& blur_m2) const {
  const double mean = 0.5 * (blur_m2(0, 0) + blur_m2(1, 1));
  const double difference = 0.5 * (blur_m2(0, 0) - blur_m2(1, 1));
  const double spread = std::hypot(difference, blur_m2(0, 1));
  const double floor = first_sigma_m_ * first_sigma_m_;
  const double ceiling = std::pow(sigma_m(kLevels - 3), 2);
  const double minor = std::clamp(mean - spread, floor, ceiling);
  const double major = std::max(mean + spread, minor);

  PrintSample out;
  out.white = 0.0;
  // Plain print: N(0, S) lies nowhere above √(major/minor) times the isotropic N(0, major).
  const int wide = std::min(kLevels - 1, level_below(std::sqrt(major)) + 2);
  const double around = level(wide).nearest(board_m);
  const double plain = kPlain * std::sqrt(minor / major);
  if (around > 1.0 - plain || around < plain) {
    out.white = around > 0.5 ? 1.0 : 0.0;
    return out;
  }

  // Parabola in v = σ² through three neighbouring levels, the middle one nearest.
  const double sigma = std::sqrt(minor);
  int middle = static_cast<int>(std::lround(std::log(sigma / first_sigma_m_) / std::log(kRatio)));
  middle = std::clamp(middle, 1, kLevels - 2);
  std::array<double, 3> v{};
  for (int i = 0; i < 3; ++i) v[static_cast<std::size_t>(i)] = std::pow(sigma_m(middle + i - 1), 2);
  const std::array<double, 3> share{
      (minor - v[1]) * (minor - v[2]) / ((v[0] - v[1]) * (v[0] - v[2])),
      (minor - v[0]) * (minor - v[2]) / ((v[1] - v[0]) * (v[1] - v[2])),
      (minor - v[0]) * (minor - v[1]) / ((v[2] - v[0]) * (v[2] - v[1]))};

  const double excess = major - minor;
  const Quadrature q = quadrature(excess / minor);
  Eigen::Vector2d axis(1.0, 0.0);
  if (spread > 0.0) {
    const double angle = 0.5 * std::atan2(blur_m2(0, 1), difference);
    axis = {std::cos(angle), std::sin(angle)};
  }
  axis *= std::sqrt(excess);
  for (int i = 0; i < 3; ++i) {
    const double w = share[static_cast<std::size_t>(i)];
    if (std::abs(w) < 1e-9) continue;
    const Level& source = level(middle + i - 1);
    for (int k = 0; k < q.count; ++k) {
      const auto j = static_cast<std::size_t>(k);
      source.add(board_m + q.at[j] * axis, w * q.weight[j], out);
    }
  }
  out.hessian_per_m2(1, 0) = out.hessian_per_m2(0, 1);
  return out;
}

}  // namespace lvcalib
