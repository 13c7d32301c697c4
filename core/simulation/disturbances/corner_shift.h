// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "target/target.h"

namespace lvcalib::simulation {

/// Shows every tag too large about its own centre: its corners lie further out in the image by a
/// number of pixels, along their diagonals. What is around the tags stays in place.
class CornerShift {
 public:
  /// Pixel of a board point, for the camera that takes the photograph.
  using Project = std::function<std::optional<Eigen::Vector2d>(const Eigen::Vector2d&)>;

  CornerShift() = default;
  CornerShift(const Target& target, double shift_px, const Project& project);

  [[nodiscard]] bool active() const { return !tags_.empty(); }

  /// Which point of the board is seen at a place on the board.
  [[nodiscard]] Eigen::Vector2d shown_at(const Eigen::Vector2d& place_m) const;

 private:
  struct Tag {
    Eigen::Vector2d center_m;
    Eigen::Matrix2d shown_from_place;
  };
  double pitch_m_ = 1.0;
  double size_m_ = 0.0;
  double reach_m_ = 0.0;                               // From the tag's centre along each axis.
  Eigen::Vector2d first_m_ = Eigen::Vector2d::Zero();  // Lower left of the first cell.
  int columns_ = 0;
  int rows_ = 0;
  std::vector<int> place_;  // Per cell which tag it holds; −1: none.
  std::vector<Tag> tags_;
};

}  // namespace lvcalib::simulation
