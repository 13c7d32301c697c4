// SPDX-License-Identifier: BSD-3-Clause
#include "detection/tag_refinement.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <Eigen/QR>

#include "base/statistics.h"
#include "detection/blurred_tag.h"
#include "detection/undistorted_patch.h"

namespace lvcalib {
namespace {

// Order of the unknowns: homography (8), blur, curvature of the response, black level and its
// slopes, contrast and its slopes.
constexpr int kHomography = 0, kBlur = 8, kCurve = 9, kBlack = 10, kContrast = 13, kUnknowns = 16;
using Vector = Eigen::Matrix<double, kUnknowns, 1>;
using Matrix = Eigen::Matrix<double, kUnknowns, kUnknowns>;

const std::array<Eigen::Vector2d, 4> kTagCorners = {Eigen::Vector2d(-1, -1), Eigen::Vector2d(1, -1),
                                                    Eigen::Vector2d(1, 1), Eigen::Vector2d(-1, 1)};

Eigen::Vector2d transform(const Eigen::Matrix3d& homography, const Eigen::Vector2d& point) {
  return (homography * point.homogeneous()).hnormalized();
}

// Homography that takes the four corners of the tag to four points.
Eigen::Matrix3d homography_to(const std::array<Eigen::Vector2d, 4>& points) {
  Eigen::Matrix<double, 8, 8> a;
  Eigen::Matrix<double, 8, 1> b;
  for (int i = 0; i < 4; ++i) {
    const Eigen::Vector2d& t = kTagCorners[static_cast<std::size_t>(i)];
    const Eigen::Vector2d& p = points[static_cast<std::size_t>(i)];
    a.row(2 * i) << t.x(), t.y(), 1, 0, 0, 0, -p.x() * t.x(), -p.x() * t.y();
    a.row(2 * i + 1) << 0, 0, 0, t.x(), t.y(), 1, -p.y() * t.x(), -p.y() * t.y();
    b.segment<2>(2 * i) = p;
  }
  const Eigen::Matrix<double, 8, 1> h = a.partialPivLu().solve(b);
  Eigen::Matrix3d out;
  out << h[0], h[1], h[2], h[3], h[4], h[5], h[6], h[7], 1.0;
  return out;
}

struct TagPixel {
  Eigen::Vector2d plane;
  double gray = 0.0;
};

struct State {
  Eigen::Matrix3d tag_from_plane = Eigen::Matrix3d::Identity();
  double blur_px = 1.0;
  double curve = 0.0;
  Eigen::Vector3d black = Eigen::Vector3d::Zero();     // level, slopes by u and v
  Eigen::Vector3d contrast = Eigen::Vector3d::Zero();  // white − black, likewise
};

State moved(const State& state, const Vector& step) {
  State out = state;
  Eigen::Matrix3d change = Eigen::Matrix3d::Identity();
  change.row(0) += step.segment<3>(0).transpose();
  change.row(1) += step.segment<3>(3).transpose();
  change(2, 0) += step[6];
  change(2, 1) += step[7];
  out.tag_from_plane = change * state.tag_from_plane;
  out.tag_from_plane /= out.tag_from_plane(2, 2);
  // The area of a pixel alone blurs by √(1/12).
  out.blur_px = std::clamp(state.blur_px + step[kBlur], 0.29, 10.0);
  out.curve = std::clamp(state.curve + step[kCurve], -0.95, 0.95);
  out.black += step.segment<3>(kBlack);
  out.contrast += step.segment<3>(kContrast);
  return out;
}

// The fit of one tag. Pixels are chosen once; the state moves.
class TagFit {
 public:
  TagFit(const GrayImage& image, const UndistortedPatch& patch, BlurredTag tag,
         const TagCorners& start, const TagRefinementOptions& options)
      : image_(image), patch_(patch), tag_(std::move(tag)), options_(options) {
    std::array<Eigen::Vector2d, 4> points;
    std::transform(start.begin(), start.end(), points.begin(),
                   [&](const Eigen::Vector2d& p) { return patch.to_plane(p); });
    state_.tag_from_plane = homography_to(points).inverse();
    center_ = 0.25 * (start[0] + start[1] + start[2] + start[3]);
    plane_by_pixel_ = patch.plane_by_pixel(center_);
    choose_pixels(start);
  }

  [[nodiscard]] std::size_t pixel_count() const { return pixels_.size(); }
  bool start_levels();
  /// One Gauss–Newton step; the largest motion of a corner in plane units, negative on failure.
  double iterate(bool robust);
  [[nodiscard]] std::optional<TagRefinement> result() const;

 private:
  void choose_pixels(const TagCorners& start);
  void find_quadrants(double threshold);
  [[nodiscard]] std::optional<double> gray_near(const Eigen::Vector2d& tag) const;
  double evaluate(const State& state, const TagPixel& pixel, Vector* jacobian) const;
  Vector accumulate(bool robust);
  void measure_noise();
  [[nodiscard]] double weight(double residual) const { return tukey_weight(residual / noise_); }
  [[nodiscard]] std::array<Eigen::Vector2d, 4> plane_corners(const State& state) const;
  bool describe_agreement(TagRefinement& out) const;

  const GrayImage& image_;
  const UndistortedPatch& patch_;
  BlurredTag tag_;
  const TagRefinementOptions& options_;
  Eigen::Vector2d center_;
  Eigen::Matrix2d plane_by_pixel_;
  std::vector<TagPixel> pixels_;
  State state_;
  double noise_ = 0.0;
  std::vector<double> residuals_;
  Matrix information_ = Matrix::Zero();
  int iterations_ = 0;
};

// Pixels of the tag and its surround. The outer quadrants at the corners are left out: circles and
// Kalibr's squares may be there. Cells' insides tell nothing about the edges, so that only every
// third pixel there is kept.
void TagFit::choose_pixels(const TagCorners& start) {
  Eigen::Vector2d low = start[0], high = start[0];
  for (const Eigen::Vector2d& corner : start) {
    low = low.cwiseMin(corner);
    high = high.cwiseMax(corner);
  }
  const double rim = 1.0 + options_.surround_bits * tag_.cell();
  const Eigen::Vector2d margin = (rim - 1.0) * (high - low) + Eigen::Vector2d::Ones();
  const int x0 = std::max(0, static_cast<int>(low.x() - margin.x()));
  const int y0 = std::max(0, static_cast<int>(low.y() - margin.y()));
  const int x1 = std::min(image_.width_px - 1, static_cast<int>(high.x() + margin.x()) + 1);
  const int y1 = std::min(image_.height_px - 1, static_cast<int>(high.y() + margin.y()) + 1);
  const double side_px =
      std::sqrt(std::abs(((start[2] - start[0]).x() * (start[3] - start[1]).y() -
                          (start[2] - start[0]).y() * (start[3] - start[1]).x()) /
                         2.0));
  // An edge is felt over about 3 pixels; in cells:
  const double felt = 3.0 * tag_.side() / std::max(side_px, 1.0);
  const auto near_edge = [&](double position) {
    const double in_cells = (position + 1.0) / tag_.cell();
    return std::abs(in_cells - std::round(in_cells)) < felt;
  };
  for (int y = y0; y <= y1; ++y) {
    for (int x = x0; x <= x1; ++x) {
      const Eigen::Vector2d plane = patch_.to_plane(Eigen::Vector2d(x, y));
      const Eigen::Vector2d t = transform(state_.tag_from_plane, plane);
      if (!(t.cwiseAbs().maxCoeff() < rim) || t.cwiseAbs().minCoeff() > 1.0) continue;
      if (!near_edge(t.x()) && !near_edge(t.y()) && (x + 2 * y) % 3 != 0) continue;
      if (std::isfinite(image_.at(x, y))) pixels_.push_back({plane, image_.at(x, y)});
    }
  }
  const auto most = static_cast<std::size_t>(std::max(options_.max_pixels, 4 * kUnknowns));
  if (pixels_.size() <= most) return;
  // Steps of the golden ratio spread the chosen ones without a pattern in rows or columns.
  std::vector<TagPixel> thinned;
  const double share = static_cast<double>(most) / static_cast<double>(pixels_.size());
  double phase = 0.0;
  for (const TagPixel& pixel : pixels_) {
    phase += 0.6180339887498949;
    phase -= std::floor(phase);
    if (phase < share) thinned.push_back(pixel);
  }
  pixels_ = std::move(thinned);
}

// Black and white levels as medians of the pixels in black and white cells.
bool TagFit::start_levels() {
  std::vector<double> black, white;
  for (const TagPixel& pixel : pixels_) {
    const Eigen::Vector2d t = transform(state_.tag_from_plane, pixel.plane);
    (tag_.albedo(t.x(), t.y()) > 0.5 ? white : black).push_back(pixel.gray);
  }
  if (black.size() < kUnknowns || white.size() < kUnknowns) return false;
  state_.black[0] = median(std::move(black));
  state_.contrast[0] = median(std::move(white)) - state_.black[0];
  if (!(state_.contrast[0] > 0.0)) return false;
  find_quadrants(state_.black[0] + 0.5 * state_.contrast[0]);
  return true;
}

std::optional<double> TagFit::gray_near(const Eigen::Vector2d& tag) const {
  const auto pixel = patch_.to_pixel(transform(state_.tag_from_plane.inverse(), tag));
  if (!pixel) return std::nullopt;
  const int x = static_cast<int>(std::lround(pixel->x()));
  const int y = static_cast<int>(std::lround(pixel->y()));
  if (x < 0 || y < 0 || x >= image_.width_px || y >= image_.height_px) return std::nullopt;
  return image_.at(x, y);
}

void TagFit::find_quadrants(double threshold) {
  for (std::size_t k = 0; k < 4; ++k) {
    const auto gray = gray_near(kTagCorners[k] * (1.0 + 0.75 * tag_.cell()));
    tag_.set_quadrant(k, gray && *gray < threshold ? 0.0 : 1.0);
  }
}

// Residual of one pixel, image − model, and the model's derivatives.
double TagFit::evaluate(const State& state, const TagPixel& pixel, Vector* jacobian) const {
  const Eigen::Matrix3d& h = state.tag_from_plane;
  const Eigen::Vector3d q = h * pixel.plane.homogeneous();
  const double u = q.x() / q.z();
  const double v = q.y() / q.z();
  Eigen::Matrix2d tag_by_plane;
  tag_by_plane << h(0, 0) - u * h(2, 0), h(0, 1) - u * h(2, 1), h(1, 0) - v * h(2, 0),
      h(1, 1) - v * h(2, 1);
  const Eigen::Matrix2d by_pixel = tag_by_plane * plane_by_pixel_ / q.z();
  const double g_uu = by_pixel.row(0).squaredNorm();
  const double g_uv = by_pixel.row(0).dot(by_pixel.row(1));
  const double g_vv = by_pixel.row(1).squaredNorm();
  const double s2 = state.blur_px * state.blur_px;
  const TagSample sample = tag_.sample(u, v, {s2 * g_uu, s2 * g_uv, s2 * g_vv});
  const double bump = sample.value * (1.0 - sample.value);
  const double response = sample.value + state.curve * bump;
  const double contrast = state.contrast[0] + state.contrast[1] * u + state.contrast[2] * v;
  const double black = state.black[0] + state.black[1] * u + state.black[2] * v;
  if (jacobian != nullptr) {
    const double gain = contrast * (1.0 + state.curve * (1.0 - 2.0 * sample.value));
    const double by_u = gain * sample.by_u;
    const double by_v = gain * sample.by_v;
    const double radial = by_u * u + by_v * v;
    const double by_blur = gain * 2.0 * state.blur_px *
                           (g_uu * sample.by_uu + g_uv * sample.by_uv + g_vv * sample.by_vv);
    *jacobian << by_u * u, by_u * v, by_u, by_v * u, by_v * v, by_v, -radial * u, -radial * v,
        by_blur, contrast * bump, 1.0, u, v, response, response * u, response * v;
  }
  return pixel.gray - black - contrast * response;
}

// Scale of the residuals for Tukey's weights. The model is not exact at the edges, which carry all
// of the geometry: a few per cent of the contrast are not an outlier.
void TagFit::measure_noise() {
  const double spread = mad_sigma(residuals_);
  noise_ = std::hypot(spread, 0.02 * state_.contrast[0]);
}

std::array<Eigen::Vector2d, 4> TagFit::plane_corners(const State& state) const {
  const Eigen::Matrix3d plane_from_tag = state.tag_from_plane.inverse();
  std::array<Eigen::Vector2d, 4> out;
  std::transform(kTagCorners.begin(), kTagCorners.end(), out.begin(),
                 [&](const Eigen::Vector2d& t) { return transform(plane_from_tag, t); });
  return out;
}

// Normal equations, a block of pixels at a time. Returns the gradient.
Vector TagFit::accumulate(bool robust) {
  constexpr int kBlock = 64;
  Eigen::Matrix<double, kUnknowns, kBlock> rows;
  Eigen::Matrix<double, kBlock, 1> values;
  Vector gradient = Vector::Zero();
  information_.setZero();
  residuals_.resize(pixels_.size());
  Vector jacobian;
  for (std::size_t begin = 0; begin < pixels_.size(); begin += kBlock) {
    const std::size_t end = std::min(pixels_.size(), begin + kBlock);
    if (end - begin < kBlock) {
      rows.setZero();
      values.setZero();
    }
    for (std::size_t i = begin; i < end; ++i) {
      const double residual = evaluate(state_, pixels_[i], &jacobian);
      residuals_[i] = residual;
      const double root = robust ? std::sqrt(weight(residual)) : 1.0;
      rows.col(static_cast<Eigen::Index>(i - begin)) = root * jacobian;
      values[static_cast<Eigen::Index>(i - begin)] = root * residual;
    }
    gradient.noalias() += rows * values;
    information_.noalias() += rows * rows.transpose();
  }
  return gradient;
}

double TagFit::iterate(bool robust) {
  ++iterations_;
  if (robust) measure_noise();  // from the residuals of the iteration before
  const Vector gradient = accumulate(robust);
  // The curvature is a small correction; half the range as its prior keeps it so when the tag is
  // too small to tell it from the blur.
  const double prior = noise_ > 0.0 ? noise_ : 0.05 * state_.contrast[0];
  information_(kCurve, kCurve) += prior * prior / 0.25;
  const Eigen::LDLT<Matrix> solver(information_);
  if (solver.info() != Eigen::Success || !solver.isPositive()) return -1.0;
  const Vector step =
      solver.solve(gradient - prior * prior / 0.25 * state_.curve * Vector::Unit(kCurve));
  if (!step.allFinite()) return -1.0;
  const auto before = plane_corners(state_);
  state_ = moved(state_, step);
  const auto after = plane_corners(state_);
  double motion = 0.0;
  for (std::size_t k = 0; k < 4; ++k) motion = std::max(motion, (after[k] - before[k]).norm());
  return std::isfinite(motion) && state_.contrast[0] > 0.0 ? motion : -1.0;
}

// Share and noise of the pixels that agree; correlation of image and model over the data bits, for
// which the pixels that do not agree count as well: they are what another tag would show.
bool TagFit::describe_agreement(TagRefinement& out) const {
  double agreeing = 0, n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0, syy = 0, squares = 0;
  for (const TagPixel& pixel : pixels_) {
    const double residual = evaluate(state_, pixel, nullptr);
    if (weight(residual) > 0.0) {
      agreeing += 1;
      squares += residual * residual;
    }
    const Eigen::Vector2d t = transform(state_.tag_from_plane, pixel.plane);
    if (t.cwiseAbs().maxCoeff() > tag_.data_edge()) continue;
    const double model = pixel.gray - residual;
    n += 1;
    sx += model;
    sy += pixel.gray;
    sxx += model * model;
    sxy += model * pixel.gray;
    syy += pixel.gray * pixel.gray;
  }
  if (agreeing < 2 * kUnknowns || n < kUnknowns) return false;
  out.inliers = agreeing / static_cast<double>(pixels_.size());
  out.noise = std::sqrt(squares / (agreeing - kUnknowns));
  const double variance = (sxx - sx * sx / n) * (syy - sy * sy / n);
  out.correlation = variance > 0.0 ? (sxy - sx * sy / n) / std::sqrt(variance) : 0.0;
  return true;
}

std::optional<TagRefinement> TagFit::result() const {
  TagRefinement out;
  if (!describe_agreement(out)) return std::nullopt;
  out.blur_px = state_.blur_px;
  out.contrast = state_.contrast[0];
  out.iterations = iterations_;
  // Uniform noise; thinned-out pixels and Tukey's loss of efficiency are in the information.
  const Matrix covariance = out.noise * out.noise * information_.ldlt().solve(Matrix::Identity());
  const auto corners = plane_corners(state_);
  for (std::size_t k = 0; k < 4; ++k) {
    const auto pixel = patch_.to_pixel(corners[k]);
    if (!pixel) return std::nullopt;
    out.corners[k] = *pixel;
    const double u = kTagCorners[k].x();
    const double v = kTagCorners[k].y();
    Eigen::Matrix<double, 2, 8> tag_by_step;
    tag_by_step << u, v, 1, 0, 0, 0, -u * u, -u * v, 0, 0, 0, u, v, 1, -u * v, -v * v;
    const Eigen::Matrix3d& h = state_.tag_from_plane;
    const double w = h.row(2).dot(corners[k].homogeneous());
    Eigen::Matrix2d tag_by_plane;
    tag_by_plane << h(0, 0) - u * h(2, 0), h(0, 1) - u * h(2, 1), h(1, 0) - v * h(2, 0),
        h(1, 1) - v * h(2, 1);
    const Eigen::Matrix2d tag_by_pixel = tag_by_plane / w * patch_.plane_by_pixel(*pixel);
    const Eigen::Matrix<double, 2, 8> pixel_by_step = tag_by_pixel.inverse() * tag_by_step;
    out.covariance_px2[k] =
        pixel_by_step * covariance.topLeftCorner<8, 8>() * pixel_by_step.transpose();
    if (!out.corners[k].allFinite() || !out.covariance_px2[k].allFinite()) return std::nullopt;
  }
  return out;
}

bool plausible(const TagCorners& corners, const GrayImage& image) {
  const auto usable = [&](const Eigen::Vector2d& p) {
    return p.allFinite() && p.x() > -image.width_px && p.y() > -image.height_px &&
           p.x() < 2.0 * image.width_px && p.y() < 2.0 * image.height_px;
  };
  return std::all_of(corners.begin(), corners.end(), usable);
}

}  // namespace

std::optional<TagRefinement> refine_tag(const GrayImage& image, const TagPattern& pattern,
                                        int border_bits, const TagCorners& start,
                                        const Camera* camera, const TagRefinementOptions& options) {
  if (!plausible(start, image)) return std::nullopt;
  const Eigen::Vector2d center = 0.25 * (start[0] + start[1] + start[2] + start[3]);
  double radius = 0.0;
  for (const Eigen::Vector2d& corner : start) {
    radius = std::max(radius, (corner - center).lpNorm<Eigen::Infinity>());
  }
  if (radius < 2.0) return std::nullopt;
  BlurredTag tag(pattern, border_bits);
  const double reach = radius * (1.0 + 1.5 * tag.cell()) + 2.0;
  const auto patch = UndistortedPatch::create(camera, center, reach);
  if (!patch) return std::nullopt;
  const double bit_px = radius * tag.cell();
  TagFit fit(image, *patch, std::move(tag), start, options);
  if (fit.pixel_count() < 4 * kUnknowns || !fit.start_levels()) return std::nullopt;

  // Outliers can be told only once the edges are about right.
  bool robust = false;
  bool done = false;
  for (int i = 0; i < options.max_iterations && !done; ++i) {
    const double motion = fit.iterate(robust);
    if (motion < 0.0) return std::nullopt;
    done = robust && motion < options.stop_px;
    robust = robust || i >= 1;
  }
  auto out = fit.result();
  if (!done || !out || out->inliers < options.min_inliers ||
      out->correlation < options.min_correlation) {
    return std::nullopt;
  }
  for (std::size_t k = 0; k < 4; ++k) {
    if ((out->corners[k] - start[k]).norm() > std::max(bit_px, 1.5)) return std::nullopt;
  }
  return out;
}

}  // namespace lvcalib
