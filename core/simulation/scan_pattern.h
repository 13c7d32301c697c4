// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "base/random.h"
#include "simulation/simulation_options.h"

namespace lvcalib::simulation {

/// One laser shot: where the scanner believes it points, when, and with which line.
struct Shot {
  Eigen::Vector3d direction = Eigen::Vector3d::UnitX();  ///< LiDAR frame, unit length.
  double time_s = 0.0;                                   ///< From the start of the scan.
  std::uint16_t line = 0;
};

/// The directions of a scan.
///
/// Rosettes: two prisms turning at different speeds deflect the beam by δ₁, δ₂, so that in angular
/// coordinates a(t) = δ₁ e^{iω₁t} + δ₂ e^{iω₂t} (first order Risley pair; the speeds are those that
/// Brazeal et al. 2021, Remote Sensing 13(22), report for the Mid-40). The pattern does not repeat
/// within a scan and is densest at its middle. The six lines of an Avia are the same pattern,
/// fanned out in elevation.
/// Spinning: lines at even steps over 45° of elevation (16 lines: 30°), 1800 columns a revolution;
/// every revolution starts at another fraction of a column.
class ScanPattern {
 public:
  static constexpr int kColumnsPerRevolution = 1800;

  ScanPattern(const LidarOptions& options, Random random);

  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] Shot shot(std::size_t index) const;

  /// Where the line of a shot points at another time.
  [[nodiscard]] Eigen::Vector3d direction_at(const Shot& shot, double time_s) const;

  /// Whether a direction of the LiDAR frame lies in the field of view of at least one line.
  [[nodiscard]] bool in_field(const Eigen::Vector3d& direction) const;

 private:
  [[nodiscard]] Shot rosette_shot(std::size_t index) const;
  [[nodiscard]] Shot spinning_shot(std::size_t index) const;
  [[nodiscard]] Eigen::Vector3d rosette_direction(std::size_t line, double time_s) const;

  LidarKind kind_;
  std::size_t size_;
  std::size_t lines_;
  double half_fov_rad_;
  double phase_first_rad_;
  double phase_second_rad_;
  std::vector<double> line_elevation_rad_;
  std::vector<double> revolution_start_rad_;
};

}  // namespace lvcalib::simulation
