// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>

#include "target/target.h"

namespace lvcalib {

/// Covariance of a blur, seen in tag coordinates.
struct TagBlur {
  double uu = 0.0, uv = 0.0, vv = 0.0;
};

/// Albedo and its derivatives at one point of the blurred tag.
struct TagSample {
  double value = 0.0;
  double by_u = 0.0, by_v = 0.0;
  /// By the blur's covariance entries; by_uv belongs to the pair of off-diagonal entries.
  double by_uu = 0.0, by_uv = 0.0, by_vv = 0.0;
  /// Length of black's edges in the spot, weighted with the blur: −∂value/∂g where all black grows
  /// by g. (|∇value| where one edge is near; two that face each other cancel there, not here.)
  double edges = 0.0;
  double edges_by_u = 0.0, edges_by_v = 0.0;
};

/// A printed tag as a grid of black and white cells, convolved with a Gaussian in closed form.
/// Tag coordinates (u, v): the outer edge of the black border is at ±1, u right, v up. Beyond it
/// everything is white but for the four corner quadrants, whose colour can be set (Kalibr prints
/// black squares there).
class BlurredTag {
 public:
  BlurredTag(const TagPattern& pattern, int border_bits);

  /// Cells along a side of the black square.
  [[nodiscard]] int side() const { return side_; }
  /// Width of a cell in tag coordinates.
  [[nodiscard]] double cell() const { return 2.0 / side_; }
  /// Distance of the data area's edge from the middle.
  [[nodiscard]] double data_edge() const { return data_edge_; }
  /// Quadrants in the order of TagCorners; albedo 0 or 1.
  void set_quadrant(std::size_t corner, double albedo);
  /// Albedo of the cell at a point, without blur.
  [[nodiscard]] double albedo(double u, double v) const;

  /// The blurred albedo. An axis-aligned blur separates into one-dimensional profiles; the
  /// off-diagonal covariance c enters by the heat equation, exp(c ∂u∂v), up to c².
  [[nodiscard]] TagSample sample(double u, double v, const TagBlur& blur) const;

 private:
  static constexpr int kMaxCells = 16;
  // Share of each cell along one axis with its first and second derivatives, and of the edge after
  // it the density of the blur there with its derivative.
  struct Profile {
    int first = 0;
    int count = 0;
    std::array<double, kMaxCells> share, slope, curvature, edge, edge_slope;
  };
  void profile(double position, double sigma, Profile& out) const;
  [[nodiscard]] int cell_index(double position) const;
  void find_edges();
  double& at(int row, int column) {
    return cells_[static_cast<std::size_t>(row * width_ + column)];
  }

  int side_;
  double data_edge_;
  int width_;                  // side plus one surrounding cell on either side
  std::vector<double> cells_;  // rows from bottom to top
  // 1 where a cell differs from the next one to the right, or upwards.
  std::vector<double> edge_right_, edge_up_;
};

}  // namespace lvcalib
