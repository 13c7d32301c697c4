// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "target/print_edges.h"
#include "target/target.h"

namespace lvcalib {

/// A sample with the place and the blur that it was taken for: it answers for their neighbourhood,
/// where a solve comes back to the same returns again and again.
class LocalPrint {
 public:
  LocalPrint() = default;
  LocalPrint(const Eigen::Vector2d& board_m, const Eigen::Matrix2d& blur_m2,
             const PrintSample& sample);
  /// The sample at another place and blur, by Taylor's series (second order in the place, first in
  /// the blur, ∂A/∂S = ½∇∇ᵀA). Nothing beyond a tenth of the blur's width or a hundredth of its
  /// variance: nearer it misses an edge by less than 3·10⁻⁴ of the contrast.
  [[nodiscard]] std::optional<PrintSample> at(const Eigen::Vector2d& board_m,
                                              const Eigen::Matrix2d& blur_m2) const;

 private:
  // Single precision: tables keep one per row. 10⁻⁷ of a board is far below what any row measures.
  Eigen::Vector2f board_m_ = Eigen::Vector2f::Zero();
  Eigen::Vector3f blur_m2_ = Eigen::Vector3f::Zero();  // xx, xy, yy; zero: nothing is known.
  float white_ = 0.0F;
  Eigen::Vector2f gradient_ = Eigen::Vector2f::Zero();
  Eigen::Vector3f hessian_ = Eigen::Vector3f::Zero();
};

/// The print under any Gaussian blur.
///
/// Kept is the print under a series of isotropic blurs of widths σ_k = σ_0·q^k, each sampled with a
/// spacing of h·σ_k, h = ½ (value, both slopes and the mixed second derivative, for bicubic Hermite
/// interpolation; the error of that is h⁴/384·max|A''''| = 2·10⁻⁴ a direction). A level is made
/// when it is first asked for. Its samples are exact, but for being whole numbers of 1/32000, a
/// tenth of that error in half the memory: the blur of a rectangle is a product of error functions,
/// that of a disc a function of the distance from its middle. Between levels the value
/// is interpolated by a parabola in σ². A blur that is longer in one direction is the isotropic one
/// of its smaller axis, averaged along the larger one (a Gaussian is a Gaussian of Gaussians).
/// Beyond the board's outline the print goes on white. Safe to use from several threads.
class BlurredPrint {
 public:
  /// h of what is measured: the interpolation's 2·10⁻⁴ a direction stay below the 10⁻³ of the
  /// contrast that a prediction may be off by.
  static constexpr double kSpacing = 0.5;
  /// h of plans, whose blurs are finer than any measured: a quarter of the memory, and by the
  /// fourth power of h a value off by 16 times as much, 3·10⁻³.
  static constexpr double kPlanSpacing = 1.0;
  /// `spacing`: h. Errors are the target's own: it must pass check().
  explicit BlurredPrint(const Target& target, double spacing = kSpacing);
  ~BlurredPrint();
  BlurredPrint(const BlurredPrint&) = delete;
  BlurredPrint& operator=(const BlurredPrint&) = delete;

  /// The print seen at a board point with blur covariance S (m², symmetric, positive). Widths
  /// below that of the first level are taken as that one.
  [[nodiscard]] PrintSample at(const Eigen::Vector2d& board_m,
                               const Eigen::Matrix2d& blur_m2) const;

  /// The value alone under one isotropic blur, from the nearest sample: for coarse searches.
  class Coarse {
   public:
    [[nodiscard]] double at(const Eigen::Vector2d& board_m) const;
    /// The same in two steps, for many places moved together: in samples from the first one, and
    /// what is there.
    [[nodiscard]] Eigen::Vector2d in_samples(const Eigen::Vector2d& board_m) const {
      return (board_m - origin_) * per_step_;
    }
    [[nodiscard]] double per_m() const { return per_step_; }
    [[nodiscard]] float at_sample(float column, float row) const {
      const auto nearest = [](float at, int count) {
        return static_cast<int>(std::clamp(at + 0.5F, 0.0F, static_cast<float>(count) - 1.0F));
      };
      return kUnit * first_[4 * (static_cast<std::ptrdiff_t>(nearest(row, rows_)) * columns_ +
                                 nearest(column, columns_))];
    }

   private:
    friend class BlurredPrint;
    const std::int16_t* first_ = nullptr;
    Eigen::Vector2d origin_ = Eigen::Vector2d::Zero();
    double per_step_ = 0.0;
    int columns_ = 0, rows_ = 0;
  };
  /// The view lives as long as the print.
  [[nodiscard]] Coarse coarse(double sigma_m) const;

  /// Makes the levels that spots of these widths need, on several threads. What is not made ahead
  /// is made when it is first asked for.
  void prepare(double smallest_m, double largest_m, int threads) const;

  [[nodiscard]] const Target& target() const { return target_; }
  [[nodiscard]] const PrintEdges& edges() const { return edges_; }
  [[nodiscard]] const BoardOutline& outline() const { return outline_; }
  /// Distance of a point to the outline; negative outside.
  [[nodiscard]] double inside_m(const Eigen::Vector2d& board_m) const {
    const Eigen::Vector2d a = board_m - outline_.lower_left_m;
    const Eigen::Vector2d b = outline_.upper_right_m - board_m;
    return std::min(a.minCoeff(), b.minCoeff());
  }

 private:
  struct Level;
  static constexpr int kLevels = 44;
  // Of samples: values lie in 0 … 1, slopes and mixed derivatives a step in ±0.4.
  static constexpr float kUnit = 1.0F / 32000.0F;
  const Level& level(int index) const;
  [[nodiscard]] double sigma_m(int index) const;
  [[nodiscard]] int level_below(double sigma_m) const;

  Target target_;
  BoardOutline outline_;
  PrintEdges edges_;
  double spacing_ = kSpacing;
  double first_sigma_m_ = 0.0;
  std::array<double, kLevels> variance_m2_{};
  // Each level has its own lock: two threads may make two levels.
  mutable std::array<std::atomic<const Level*>, kLevels> levels_{};
  mutable std::array<std::mutex, kLevels> building_;
};

// Called for every sample of every place that a search tries.
inline double BlurredPrint::Coarse::at(const Eigen::Vector2d& board_m) const {
  const auto nearest = [](double at, int count) {
    return static_cast<std::size_t>(std::clamp(at + 0.5, 0.0, count - 1.0));
  };
  const std::size_t c = nearest((board_m.x() - origin_.x()) * per_step_, columns_);
  const std::size_t r = nearest((board_m.y() - origin_.y()) * per_step_, rows_);
  return static_cast<double>(kUnit) * first_[4 * (r * static_cast<std::size_t>(columns_) + c)];
}

}  // namespace lvcalib
