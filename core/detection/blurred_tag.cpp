// SPDX-License-Identifier: BSD-3-Clause
#include "detection/blurred_tag.h"

#include <algorithm>
#include <cmath>

#include "base/statistics.h"

namespace lvcalib {
namespace {

constexpr double kReach = 4.0;  // standard deviations beyond which an edge is not felt

struct Normal {
  double cdf = 0.0, pdf = 0.0;
};

// Normal distribution by table: the error of 1e-5 is far below a grey level, and the fit spends
// most of its time here.
class NormalTable {
 public:
  NormalTable() {
    for (int i = 0; i < kSize; ++i) {
      const double x = (i - kHalf) / kPerUnit;
      entries_[static_cast<std::size_t>(i)] = {normal_cdf(x), normal_pdf(x)};
    }
  }
  [[nodiscard]] Normal at(double x) const {
    const double position = std::clamp(x, -kReach, kReach) * kPerUnit + kHalf;
    const int index = static_cast<int>(position);
    const double t = position - index;
    const Normal& a = entries_[static_cast<std::size_t>(index)];
    const Normal& b = entries_[static_cast<std::size_t>(index) + 1];
    return {a.cdf + t * (b.cdf - a.cdf), a.pdf + t * (b.pdf - a.pdf)};
  }

 private:
  static constexpr double kPerUnit = 64.0;
  static constexpr int kHalf = static_cast<int>(kReach * kPerUnit);
  static constexpr int kSize = 2 * kHalf + 2;
  std::array<Normal, kSize> entries_;
};

const NormalTable& normal_table() {
  static const NormalTable table;
  return table;
}

}  // namespace

BlurredTag::BlurredTag(const TagPattern& pattern, int border_bits)
    : side_(pattern.width + 2 * border_bits),
      data_edge_(static_cast<double>(pattern.width) / side_),
      width_(side_ + 2),
      cells_(static_cast<std::size_t>(width_ * width_), 1.0) {
  for (int row = 0; row < side_; ++row) {
    for (int column = 0; column < side_; ++column) {
      const int data_row = side_ - 1 - row - border_bits;  // data rows count from the top
      const int data_column = column - border_bits;
      const bool data = data_row >= 0 && data_row < pattern.width && data_column >= 0 &&
                        data_column < pattern.width;
      at(row + 1, column + 1) = data && pattern.at(data_row, data_column) ? 1.0 : 0.0;
    }
  }
  find_edges();
}

void BlurredTag::find_edges() {
  edge_right_.assign(cells_.size(), 0.0);
  edge_up_.assign(cells_.size(), 0.0);
  const auto width = static_cast<std::size_t>(width_);
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    if (i % width + 1 < width) edge_right_[i] = std::abs(cells_[i + 1] - cells_[i]);
    if (i + width < cells_.size()) edge_up_[i] = std::abs(cells_[i + width] - cells_[i]);
  }
}

void BlurredTag::set_quadrant(std::size_t corner, double albedo) {
  const bool right = corner == 1 || corner == 2;
  const bool top = corner >= 2;
  at(top ? width_ - 1 : 0, right ? width_ - 1 : 0) = albedo;
  find_edges();
}

int BlurredTag::cell_index(double position) const {
  return std::clamp(static_cast<int>(std::floor((position + 1.0) / cell())) + 1, 0, width_ - 1);
}

double BlurredTag::albedo(double u, double v) const {
  return cells_[static_cast<std::size_t>(cell_index(v) * width_ + cell_index(u))];
}

void BlurredTag::profile(double position, double sigma, Profile& out) const {
  // Edge k lies between cells k and k + 1.
  const double in_cells = (position + 1.0) / cell();
  const double reach = kReach * sigma / cell();
  int low = std::max(0, static_cast<int>(std::ceil(in_cells - reach)));
  int high = std::min(side_, static_cast<int>(std::floor(in_cells + reach)));
  if (high - low + 2 > kMaxCells) {  // blurred beyond use; keep the nearest edges
    low = std::clamp(static_cast<int>(in_cells) - kMaxCells / 2 + 1, 0, side_);
    high = std::min(side_, low + kMaxCells - 2);
  }
  out.first = high < low ? cell_index(position) : low;
  out.count = high < low ? 1 : high - low + 2;
  double cdf = 1.0, slope = 0.0, curvature = 0.0;
  for (int k = low; k <= high; ++k) {
    const double a = (in_cells - k) * cell() / sigma;
    const Normal normal = normal_table().at(a);
    const double edge_slope = normal.pdf / sigma;
    const double edge_curvature = -a * normal.pdf / (sigma * sigma);
    const auto i = static_cast<std::size_t>(k - low);
    out.share[i] = cdf - normal.cdf;
    out.slope[i] = slope - edge_slope;
    out.curvature[i] = curvature - edge_curvature;
    out.edge[i] = edge_slope;
    out.edge_slope[i] = edge_curvature;
    cdf = normal.cdf;
    slope = edge_slope;
    curvature = edge_curvature;
  }
  const auto last = static_cast<std::size_t>(out.count - 1);
  out.share[last] = cdf;
  out.slope[last] = slope;
  out.curvature[last] = curvature;
  out.edge[last] = 0.0;
  out.edge_slope[last] = 0.0;
}

TagSample BlurredTag::sample(double u, double v, const TagBlur& blur) const {
  Profile across;
  Profile upwards;
  profile(u, std::sqrt(blur.uu), across);
  profile(v, std::sqrt(blur.vv), upwards);
  // Derivatives of orders (i in u, j in v), i and j up to 2.
  double d[3][3] = {};
  TagSample out;
  for (int row = 0; row < upwards.count; ++row) {
    const auto first = static_cast<std::size_t>((upwards.first + row) * width_ + across.first);
    const double* cells = &cells_[first];
    const double* right = &edge_right_[first];
    const double* up = &edge_up_[first];
    double sum = 0.0, slope = 0.0, curvature = 0.0, vertical = 0.0, horizontal = 0.0;
    double vertical_slope = 0.0, horizontal_slope = 0.0;
    for (int column = 0; column < across.count; ++column) {
      const auto i = static_cast<std::size_t>(column);
      sum += cells[column] * across.share[i];
      slope += cells[column] * across.slope[i];
      curvature += cells[column] * across.curvature[i];
      vertical += right[column] * across.edge[i];
      vertical_slope += right[column] * across.edge_slope[i];
      horizontal += up[column] * across.share[i];
      horizontal_slope += up[column] * across.slope[i];
    }
    const auto j = static_cast<std::size_t>(row);
    out.edges += vertical * upwards.share[j] + horizontal * upwards.edge[j];
    out.edges_by_u += vertical_slope * upwards.share[j] + horizontal_slope * upwards.edge[j];
    out.edges_by_v += vertical * upwards.slope[j] + horizontal * upwards.edge_slope[j];
    const double weights[3] = {upwards.share[j], upwards.slope[j], upwards.curvature[j]};
    for (int order = 0; order < 3; ++order) {
      d[0][order] += sum * weights[order];
      d[1][order] += slope * weights[order];
      d[2][order] += curvature * weights[order];
    }
  }
  const double c = blur.uv;
  out.value = d[0][0] + c * d[1][1] + 0.5 * c * c * d[2][2];
  out.by_u = d[1][0] + c * d[2][1];
  out.by_v = d[0][1] + c * d[1][2];
  out.by_uu = 0.5 * d[2][0];
  out.by_uv = d[1][1] + c * d[2][2];
  out.by_vv = 0.5 * d[0][2];
  return out;
}

}  // namespace lvcalib
