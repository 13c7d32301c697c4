// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <vector>

#include <Eigen/Core>

#include "target/target.h"

namespace lvcalib {

/// The board's albedo as a LiDAR of finite footprint sees it: sampled on a raster and blurred by
/// a Gaussian. Gives value and gradient at board points.
class PatternTemplate {
 public:
  /// `blur_sigma_m`: standard deviation of the blur; the raster is twice as fine.
  PatternTemplate(const Target& target, double blur_sigma_m);

  struct Sample {
    double value = 0.0;
    Eigen::Vector2d gradient_per_m = Eigen::Vector2d::Zero();
    bool inside = false;  ///< Within the outline.
  };
  [[nodiscard]] Sample at(const Eigen::Vector2d& board_m) const;

  /// Value alone; −1 outside the outline. The inner loop of the search.
  [[nodiscard]] float value(float x_m, float y_m) const {
    const float x = (x_m - origin_x_) * inverse_step_;
    const float y = (y_m - origin_y_) * inverse_step_;
    if (!(x >= 0.0F && y >= 0.0F && x < max_x_ && y < max_y_)) return -1.0F;
    const float right = x + 0.5F;  // Neither is negative: truncation rounds.
    const float down = y + 0.5F;
    return raster_[static_cast<std::size_t>(static_cast<int>(down) * columns_ +
                                            static_cast<int>(right))];
  }

  [[nodiscard]] double blur_sigma_m() const { return blur_sigma_m_; }
  /// Half the outline's diagonal.
  [[nodiscard]] double radius_m() const {
    return 0.5 * static_cast<double>(std::hypot(max_x_, max_y_) / inverse_step_);
  }

 private:
  double blur_sigma_m_ = 0.0;
  int columns_ = 0;
  int rows_ = 0;
  float origin_x_ = 0.0F;
  float origin_y_ = 0.0F;
  float inverse_step_ = 1.0F;
  float max_x_ = 0.0F;
  float max_y_ = 0.0F;
  std::vector<float> raster_;
};

}  // namespace lvcalib
