// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "detection/board_view.h"

namespace lvcalib {

/// Edges of an image and, for any place, the nearest of them that a scan in a given direction would
/// cross.
class ImageEdges {
 public:
  struct Edge {
    Eigen::Vector2f pixel;   ///< To fractions of a pixel.
    Eigen::Vector2f normal;  ///< Unit, towards the brighter side.
  };

  /// Finds edges as maxima of the gradient (Canny 1986) of the image blurred with σ = 1.2 px that
  /// stand out of its noise: more than 3.4 times the median gradient, which noise alone exceeds in
  /// 0.03 % of the pixels (its gradient is Rayleigh's), and the strongest 5 % of the pixels at
  /// most.
  explicit ImageEdges(const GrayImage& image);

  /// The edge nearest to a pixel whose normal lies within some 67° of a direction (either way).
  /// Nothing outside the image, or if there is none at all.
  [[nodiscard]] const Edge* nearest(const Eigen::Vector2d& pixel,
                                    const Eigen::Vector2d& direction) const;

  [[nodiscard]] const std::vector<Edge>& edges() const { return edges_; }

 private:
  // Directions are told apart by steps of 45°.
  static constexpr std::size_t kDirections = 4;
  // Side of a cell of the map, px: which edge is nearest may be off by as much, its place is not.
  static constexpr int kCell_px = 2;
  int columns_ = 0;
  int rows_ = 0;
  int width_px_ = 0;
  int height_px_ = 0;
  std::vector<Edge> edges_;
  // Index of the nearest edge of each direction at each cell; empty: none.
  std::array<std::vector<std::int32_t>, kDirections> nearest_;
};

}  // namespace lvcalib
