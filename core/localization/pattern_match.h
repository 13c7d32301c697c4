// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <Eigen/Core>

#include "base/progress.h"
#include "localization/pattern_template.h"

namespace lvcalib {

/// Intensity at a point of a plane.
struct PlanarSample {
  Eigen::Vector2f uv_m = Eigen::Vector2f::Zero();
  float intensity = 0.0F;
};

/// Where the board lies in a plane: uv = R(angle)·(board − outline centre) + center.
struct PlanarPose {
  double angle_rad = 0.0;
  Eigen::Vector2d center_m = Eigen::Vector2d::Zero();
};

/// A pose with how well the intensities match the pattern there.
struct PatternMatch {
  PlanarPose pose;
  double correlation = 0.0;  ///< Pearson correlation of intensity and albedo inside the outline.
  int inside = 0;            ///< Samples inside the outline.
  double scale = 1.0;        ///< Measured size of the pattern over the model's.
  double scale_sigma = 0.0;
  /// Log-likelihood gain of the pattern over a plain surface, in nats: −n/2·ln(1−ρ²), where n
  /// counts independent samples.
  [[nodiscard]] double gain(double samples_per_independent = 1.0) const;
};

/// Boards are looked for at these angles and centres.
struct PatternSearchRange {
  Eigen::Vector2d center_m = Eigen::Vector2d::Zero();
  double slack_m = 0.1;  ///< Centres within ± this of center_m along both axes.
  std::vector<double> angles_rad;
  double step_m = 0.025;
  double separation_m = 0.1;  ///< How far apart the poses that are told are, or 20°.
  std::size_t count = 8;      ///< So many at the most.
};

/// Best poses over the whole range, best first.
std::vector<PatternMatch> search_pattern(const std::vector<PlanarSample>& samples,
                                         const PatternTemplate& pattern,
                                         const Eigen::Vector2d& outline_center_m,
                                         const PatternSearchRange& range,
                                         const RunContext& context);

/// Gauss–Newton on intensity = a + b·albedo(pose): pose to a fraction of the blur.
PatternMatch refine_pattern_pose(const std::vector<PlanarSample>& samples,
                                 const PatternTemplate& pattern,
                                 const Eigen::Vector2d& outline_center_m, const PlanarPose& start);

/// Means of the samples over square cells: removes density differences.
std::vector<PlanarSample> average_cells(const std::vector<PlanarSample>& samples, double cell_m);

}  // namespace lvcalib
