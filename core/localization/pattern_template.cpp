// SPDX-License-Identifier: BSD-3-Clause
#include "localization/pattern_template.h"

#include <algorithm>
#include <cmath>

namespace lvcalib {
namespace {

// One direction of a separable Gaussian; beyond the edge the outermost value goes on (the white
// margin does not darken just because the board ends).
void blur_lines(std::vector<float>& data, int count, int length, int line_stride, int step,
                const std::vector<float>& kernel) {
  const int half = static_cast<int>(kernel.size()) / 2;
  std::vector<float> line(static_cast<std::size_t>(length));
  for (int l = 0; l < count; ++l) {
    float* start = data.data() + static_cast<std::ptrdiff_t>(l) * line_stride;
    for (int i = 0; i < length; ++i)
      line[static_cast<std::size_t>(i)] = start[static_cast<std::ptrdiff_t>(i) * step];
    for (int i = 0; i < length; ++i) {
      float sum = 0.0F;
      for (int k = -half; k <= half; ++k) {
        sum += kernel[static_cast<std::size_t>(k + half)] *
               line[static_cast<std::size_t>(std::clamp(i + k, 0, length - 1))];
      }
      start[static_cast<std::ptrdiff_t>(i) * step] = sum;
    }
  }
}

std::vector<float> gaussian_kernel(double sigma) {
  const int half = std::max(1, static_cast<int>(std::ceil(3.0 * sigma)));
  std::vector<float> kernel;
  float sum = 0.0F;
  for (int k = -half; k <= half; ++k) {
    kernel.push_back(static_cast<float>(std::exp(-0.5 * k * k / (sigma * sigma))));
    sum += kernel.back();
  }
  for (float& v : kernel) v /= sum;
  return kernel;
}

}  // namespace

PatternTemplate::PatternTemplate(const Target& target, double blur_sigma_m)
    : blur_sigma_m_(blur_sigma_m) {
  const BoardOutline outline = target.outline();
  // Fine enough for the blur; a raster of at most 600² bounds the work for huge boards.
  const double step = std::max(0.5 * blur_sigma_m, outline.size_m().maxCoeff() / 600.0);
  columns_ = static_cast<int>(outline.size_m().x() / step) + 1;
  rows_ = static_cast<int>(outline.size_m().y() / step) + 1;
  origin_x_ = static_cast<float>(outline.lower_left_m.x());
  origin_y_ = static_cast<float>(outline.lower_left_m.y());
  inverse_step_ = static_cast<float>(1.0 / step);
  max_x_ = static_cast<float>(columns_ - 1);
  max_y_ = static_cast<float>(rows_ - 1);
  raster_.resize(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_));
  constexpr int kSub = 3;  // Sub-samples a side: area average of each raster cell.
  for (int r = 0; r < rows_; ++r) {
    for (int c = 0; c < columns_; ++c) {
      double sum = 0.0;
      for (int s = 0; s < kSub * kSub; ++s) {
        const int right = s % kSub;
        const int up = s / kSub;
        const Eigen::Vector2d offset((right + 0.5) / kSub - 0.5, (up + 0.5) / kSub - 0.5);
        const Eigen::Vector2d p = outline.lower_left_m + step * (Eigen::Vector2d(c, r) + offset);
        sum += target.albedo(p.cwiseMax(outline.lower_left_m).cwiseMin(outline.upper_right_m))
                   .value_or(1.0);
      }
      raster_[static_cast<std::size_t>(r * columns_ + c)] = static_cast<float>(sum / (kSub * kSub));
    }
  }
  const auto kernel = gaussian_kernel(blur_sigma_m / step);
  blur_lines(raster_, rows_, columns_, columns_, 1, kernel);
  blur_lines(raster_, columns_, rows_, 1, columns_, kernel);
}

PatternTemplate::Sample PatternTemplate::at(const Eigen::Vector2d& board_m) const {
  const double x = (board_m.x() - origin_x_) * inverse_step_;
  const double y = (board_m.y() - origin_y_) * inverse_step_;
  if (!(x >= 0 && y >= 0 && x < max_x_ && y < max_y_)) return {};
  const int c = static_cast<int>(x);
  const int r = static_cast<int>(y);
  const double fx = x - c;
  const double fy = y - r;
  const float* p = raster_.data() + static_cast<std::ptrdiff_t>(r) * columns_ + c;
  const double v00 = p[0];
  const double v10 = p[1];
  const double v01 = p[columns_];
  const double v11 = p[columns_ + 1];
  Sample s;
  s.inside = true;
  s.value = (1 - fy) * ((1 - fx) * v00 + fx * v10) + fy * ((1 - fx) * v01 + fx * v11);
  s.gradient_per_m = {((1 - fy) * (v10 - v00) + fy * (v11 - v01)) * inverse_step_,
                      ((1 - fx) * (v01 - v00) + fx * (v11 - v10)) * inverse_step_};
  return s;
}

}  // namespace lvcalib
