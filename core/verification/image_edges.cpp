// SPDX-License-Identifier: BSD-3-Clause
#include "verification/image_edges.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <opencv2/imgproc.hpp>

namespace lvcalib {
namespace {

// Leaves 1/(2√π σ) of the pixels' noise, a quarter, and widens an edge by less than a pixel.
constexpr double kBlur_px = 1.2;
// The gradient of noise alone has a Rayleigh distribution, whose median is 1.18 σ: four standard
// deviations, which one pixel in 3000 exceeds.
constexpr double kAboveMedian = 3.4;
// More of an image is texture, where an edge lies near everything.
constexpr double kMostShare = 0.05;

struct Gradient {
  cv::Mat dx, dy, size;
};

Gradient gradient_of(const GrayImage& image) {
  // OpenCV only reads it.
  const cv::Mat pixels(image.height_px, image.width_px, CV_32F,
                       const_cast<float*>(image.pixels.data()));  // NOLINT
  cv::Mat smooth;
  cv::GaussianBlur(pixels, smooth, {}, kBlur_px, kBlur_px, cv::BORDER_REPLICATE);
  Gradient out;
  cv::Scharr(smooth, out.dx, CV_32F, 1, 0, 1.0 / 32.0, 0.0, cv::BORDER_REPLICATE);
  cv::Scharr(smooth, out.dy, CV_32F, 0, 1, 1.0 / 32.0, 0.0, cv::BORDER_REPLICATE);
  cv::magnitude(out.dx, out.dy, out.size);
  return out;
}

double value_at_share(const cv::Mat& values, double share) {
  std::vector<float> all(values.begin<float>(), values.end<float>());
  const auto at =
      all.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(all.size() - 1));
  std::nth_element(all.begin(), at, all.end());
  return *at;
}

}  // namespace

ImageEdges::ImageEdges(const GrayImage& image)
    : columns_((image.width_px + kCell_px - 1) / kCell_px),
      rows_((image.height_px + kCell_px - 1) / kCell_px),
      width_px_(image.width_px),
      height_px_(image.height_px) {
  if (width_px_ < 3 || height_px_ < 3) return;
  const Gradient g = gradient_of(image);
  const double least = std::max(
      {kAboveMedian * value_at_share(g.size, 0.5), value_at_share(g.size, 1.0 - kMostShare), 1e-6});
  // The edge in each cell; −1: none.
  std::array<cv::Mat, kDirections> inside;
  for (cv::Mat& m : inside) m = cv::Mat(rows_, columns_, CV_32S, cv::Scalar(-1));
  for (int y = 1; y + 1 < height_px_; ++y) {
    for (int x = 1; x + 1 < width_px_; ++x) {
      const float size = g.size.at<float>(y, x);
      if (size < least) continue;
      const Eigen::Vector2f normal(g.dx.at<float>(y, x) / size, g.dy.at<float>(y, x) / size);
      // The neighbours across the edge, and the top of the parabola through the three.
      const int sx = static_cast<int>(std::lround(normal.x()));
      const int sy = static_cast<int>(std::lround(normal.y()));
      const float after = g.size.at<float>(y + sy, x + sx);
      const float before = g.size.at<float>(y - sy, x - sx);
      if (size < after || size <= before) continue;
      const float bend = before - 2.0F * size + after;
      const float top =
          bend < 0.0F ? std::clamp(0.5F * (before - after) / bend, -0.5F, 0.5F) : 0.0F;
      edges_.push_back({Eigen::Vector2f(static_cast<float>(x), static_cast<float>(y)) +
                            top * Eigen::Vector2f(static_cast<float>(sx), static_cast<float>(sy)),
                        normal});
      for (std::size_t d = 0; d < kDirections; ++d) {
        const double angle = std::numbers::pi * static_cast<double>(d) / kDirections;
        if (std::abs(std::cos(angle) * normal.x() + std::sin(angle) * normal.y()) >
            std::numbers::sqrt2 / 2.0 - 1e-6)
          inside[d].at<std::int32_t>(y / kCell_px, x / kCell_px) =
              static_cast<std::int32_t>(edges_.size()) - 1;
      }
    }
  }
  for (std::size_t d = 0; d < kDirections; ++d) {
    // Edges are where the mask is zero.
    const cv::Mat mask = inside[d] < 0;
    if (cv::countNonZero(mask) == rows_ * columns_) continue;
    cv::Mat distance, label;
    cv::distanceTransform(mask, distance, label, cv::DIST_L2, cv::DIST_MASK_5,
                          cv::DIST_LABEL_PIXEL);
    std::vector<std::int32_t> edge_of_label(mask.total() + 1, -1);
    const auto* labels = label.ptr<std::int32_t>();
    const auto* edges = inside[d].ptr<std::int32_t>();
    for (std::size_t i = 0; i < mask.total(); ++i) {
      if (edges[i] >= 0) edge_of_label[static_cast<std::size_t>(labels[i])] = edges[i];
    }
    nearest_[d].resize(mask.total());
    for (std::size_t i = 0; i < mask.total(); ++i)
      nearest_[d][i] = edge_of_label[static_cast<std::size_t>(labels[i])];
  }
}

const ImageEdges::Edge* ImageEdges::nearest(const Eigen::Vector2d& pixel,
                                            const Eigen::Vector2d& direction) const {
  const auto x = std::lround(pixel.x());
  const auto y = std::lround(pixel.y());
  if (x < 0 || y < 0 || x >= width_px_ || y >= height_px_) return nullptr;
  const double turns = std::atan2(direction.y(), direction.x()) / std::numbers::pi;
  const auto bin = static_cast<std::size_t>(
      (std::lround(turns * kDirections) + 2 * static_cast<long>(kDirections)) %
      static_cast<long>(kDirections));
  if (nearest_[bin].empty()) return nullptr;
  const std::int32_t index =
      nearest_[bin][static_cast<std::size_t>(y / kCell_px) * static_cast<std::size_t>(columns_) +
                    static_cast<std::size_t>(x / kCell_px)];
  return index < 0 ? nullptr : &edges_[static_cast<std::size_t>(index)];
}

}  // namespace lvcalib
