// SPDX-License-Identifier: BSD-3-Clause
#include "detection/tag_refinement.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include "base/paired_moments.h"
#include "base/statistics.h"
#include "detection/blurred_tag.h"
#include "detection/tag_model.h"
#include "detection/undistorted_patch.h"

namespace lvcalib {
namespace {

constexpr int kUnknowns = TagModel::kUnknowns;
using Vector = TagModel::Vector;
using Matrix = Eigen::Matrix<double, kUnknowns, kUnknowns>;

struct TagPixel {
  Eigen::Vector2d plane;
  double gray = 0.0;
};

// The fit of one tag. Pixels are chosen once; the state moves.
class TagFit {
 public:
  TagFit(const GrayImage& image, const UndistortedPatch& patch, BlurredTag tag,
         const TagCorners& start, const TagRefinementOptions& options, bool grows)
      : image_(image), patch_(patch), tag_(std::move(tag)), options_(options), grows_(grows) {
    std::array<Eigen::Vector2d, 4> points;
    std::transform(start.begin(), start.end(), points.begin(),
                   [&](const Eigen::Vector2d& p) { return patch.to_plane(p); });
    state_.tag_from_plane = plane_from_tag_corners(points).inverse();
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
  Vector accumulate(bool robust);
  void measure_noise();
  [[nodiscard]] double weight(double residual) const { return tukey_weight(residual / noise_); }
  bool describe_agreement(TagRefinement& out) const;

  const GrayImage& image_;
  const UndistortedPatch& patch_;
  BlurredTag tag_;
  const TagRefinementOptions& options_;
  bool grows_;  // Whether black may have grown.
  Eigen::Vector2d center_;
  Eigen::Matrix2d plane_by_pixel_;
  std::vector<TagPixel> pixels_;
  TagModel state_;
  double noise_ = 0.0;
  std::vector<double> residuals_;
  Matrix information_ = Matrix::Zero();
  double growth_step_ = 0.0;
  bool swings_ = false;  // Steps of the growth went to and fro.
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
      const Eigen::Vector2d t = state_.tag_point(plane);
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
    const Eigen::Vector2d t = state_.tag_point(pixel.plane);
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
  const auto pixel = patch_.to_pixel(state_.plane_point(tag));
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

// Scale of the residuals for Tukey's weights. The model is not exact at the edges, which carry all
// of the geometry: a few per cent of the contrast are not an outlier.
void TagFit::measure_noise() {
  const double spread = mad_sigma(residuals_);
  noise_ = std::hypot(spread, 0.02 * state_.contrast[0]);
}

// Normal equations, a block of pixels at a time. Returns the gradient. The last unknown goes by
// itself: the product of sixteen rows fills the processor's registers, that of seventeen takes
// twice as long.
Vector TagFit::accumulate(bool robust) {
  constexpr int kBlock = 64;
  constexpr int kMany = kUnknowns - 1;
  Eigen::Matrix<double, kMany, kBlock> rows;
  Eigen::Matrix<double, kBlock, 1> last;
  Eigen::Matrix<double, kBlock, 1> values;
  Vector gradient = Vector::Zero();
  information_.setZero();
  residuals_.resize(pixels_.size());
  Vector jacobian;
  for (std::size_t begin = 0; begin < pixels_.size(); begin += kBlock) {
    const std::size_t end = std::min(pixels_.size(), begin + kBlock);
    if (end - begin < kBlock) {
      rows.setZero();
      last.setZero();
      values.setZero();
    }
    for (std::size_t i = begin; i < end; ++i) {
      const double residual =
          pixels_[i].gray - state_.gray(tag_, plane_by_pixel_, pixels_[i].plane, &jacobian);
      residuals_[i] = residual;
      const double root = robust ? std::sqrt(weight(residual)) : 1.0;
      const auto at = static_cast<Eigen::Index>(i - begin);
      rows.col(at) = root * jacobian.head<kMany>();
      last[at] = root * jacobian[kMany];
      values[at] = root * residual;
    }
    gradient.head<kMany>().noalias() += rows * values;
    gradient[kMany] += last.dot(values);
    information_.topLeftCorner<kMany, kMany>().noalias() += rows * rows.transpose();
    information_.col(kMany).head<kMany>().noalias() += rows * last;
    information_(kMany, kMany) += last.squaredNorm();
  }
  information_.row(kMany).head<kMany>() = information_.col(kMany).head<kMany>().transpose();
  return gradient;
}

double TagFit::iterate(bool robust) {
  if (robust) measure_noise();  // from the residuals of the iteration before
  const Vector gradient = accumulate(robust);
  // Curvature and growth are small corrections; half the range and a tenth of a bit as their
  // priors keep them so when the tag is too small to tell them from the blur.
  const double noise = noise_ > 0.0 ? noise_ : 0.05 * state_.contrast[0];
  Vector prior = Vector::Zero();
  prior(TagModel::kCurve) = std::pow(noise / 0.5, 2);
  const double most = grows_ ? 0.1 * tag_.cell() : 1e-9;  // That small, it stays zero.
  prior(TagModel::kGrowth) = std::pow(noise / most, 2);
  Vector values = Vector::Zero();
  values(TagModel::kCurve) = state_.curve;
  values(TagModel::kGrowth) = state_.growth;
  information_.diagonal() += prior;
  // Where pixels hardly resolve the edges the two are hardly told from each other, and steps along
  // that swing to and fro: they are held to a fifth of that at a time, which moves no solution.
  Matrix damped = information_;
  if (swings_) damped.diagonal() += 25.0 * prior;
  const Eigen::LDLT<Matrix> solver(damped);
  if (solver.info() != Eigen::Success || !solver.isPositive()) return -1.0;
  const Vector step = solver.solve(gradient - prior.cwiseProduct(values));
  swings_ = swings_ || (robust && step(TagModel::kGrowth) * growth_step_ < 0.0);
  growth_step_ = step(TagModel::kGrowth);
  if (!step.allFinite()) return -1.0;
  const auto before = state_.plane_corners();
  state_ = state_.moved(step);
  const auto after = state_.plane_corners();
  double motion = 0.0;
  for (std::size_t k = 0; k < 4; ++k) motion = std::max(motion, (after[k] - before[k]).norm());
  return std::isfinite(motion) && state_.contrast[0] > 0.0 ? motion : -1.0;
}

// Share and noise of the pixels that agree; correlation of image and model over the data bits, for
// which the pixels that do not agree count as well: they are what another tag would show.
bool TagFit::describe_agreement(TagRefinement& out) const {
  double agreeing = 0.0;
  double squares = 0.0;
  PairedMoments data;
  for (const TagPixel& pixel : pixels_) {
    const double model = state_.gray(tag_, plane_by_pixel_, pixel.plane);
    const double residual = pixel.gray - model;
    if (weight(residual) > 0.0) {
      agreeing += 1;
      squares += residual * residual;
    }
    const Eigen::Vector2d t = state_.tag_point(pixel.plane);
    if (t.cwiseAbs().maxCoeff() > tag_.data_edge()) continue;
    data.add(model, pixel.gray);
  }
  if (agreeing < 2 * kUnknowns || data.n < kUnknowns) return false;
  out.inliers = agreeing / static_cast<double>(pixels_.size());
  out.noise = std::sqrt(squares / (agreeing - kUnknowns));
  out.correlation = data.correlation();
  return true;
}

std::optional<TagRefinement> TagFit::result() const {
  TagRefinement out;
  if (!describe_agreement(out)) return std::nullopt;
  out.blur_px = state_.blur_px;
  out.contrast = state_.contrast[0];
  // Uniform noise; thinned-out pixels and Tukey's loss of efficiency are in the information.
  const Matrix covariance = out.noise * out.noise * information_.ldlt().solve(Matrix::Identity());
  const auto corners = state_.plane_corners();
  for (std::size_t k = 0; k < 4; ++k) {
    const auto pixel = patch_.to_pixel(corners[k]);
    if (!pixel) return std::nullopt;
    out.corners[k] = *pixel;
    const Eigen::Matrix2d pixel_by_tag =
        (state_.tag_by_plane(corners[k]) * patch_.plane_by_pixel(*pixel)).inverse();
    const Eigen::Matrix<double, 2, 8> pixel_by_step =
        pixel_by_tag * TagModel::tag_by_homography_step(kTagCorners[k]);
    out.covariance_px2[k] =
        pixel_by_step * covariance.topLeftCorner<8, 8>() * pixel_by_step.transpose();
    if (!out.corners[k].allFinite() || !out.covariance_px2[k].allFinite()) return std::nullopt;
  }
  return out;
}

// The fit iterated to its end; nothing if it does not get there or does not show the tag.
std::optional<TagRefinement> refined(TagFit& fit, const TagRefinementOptions& options) {
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
      out->correlation < options.min_correlation)
    return std::nullopt;
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
  // Where something covers a part of the tag the growth may follow that; without it the fit holds.
  for (const bool grows : {true, false}) {
    TagFit fit(image, *patch, tag, start, options, grows);
    auto out = refined(fit, options);
    if (!out) continue;
    const bool near = std::equal(
        start.begin(), start.end(), out->corners.begin(),
        [&](const auto& a, const auto& b) { return (a - b).norm() <= std::max(bit_px, 1.5); });
    if (near) return out;
  }
  return std::nullopt;
}

}  // namespace lvcalib
