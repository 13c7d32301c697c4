// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/scan_pattern.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/units.h"

namespace lvcalib::simulation {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;

// Prism speeds in turns per second, and the share of the deflection that the first prism makes:
// slightly more than half, so that the middle is a small ring as on the real device.
constexpr double kFirstPrismHz = 7294.0 / 60.0;
constexpr double kSecondPrismHz = -4664.0 / 60.0;
constexpr double kFirstPrismShare = 0.505;

constexpr double kRosetteRateHz = 100'000.0;
constexpr double kAviaRateHz = 240'000.0;
// 77.2° by 70.4°: six fields of 70.4° spread over the difference.
constexpr double kAviaLineStep = (77.2 - 70.4) / 5.0 * kRadPerDeg;

constexpr double kRevolutionS = 0.1;

// Devices of 16 lines cover 30° in steps of 2° (Velodyne VLP-16), those of more 45° (Ouster OS1).
double spinning_elevation_rad(std::size_t lines) {
  return (lines <= 16 ? 30.0 : 45.0) * kRadPerDeg;
}

}  // namespace

ScanPattern::ScanPattern(const LidarOptions& options, Random random)
    : kind_(options.kind),
      size_(static_cast<std::size_t>(point_count(options))),
      lines_(static_cast<std::size_t>(line_count(options))),
      half_fov_rad_(0.5 * options.fov_deg * kRadPerDeg),
      phase_first_rad_(random.uniform(0.0, kTurn)),
      phase_second_rad_(random.uniform(0.0, kTurn)) {
  const double step = kind_ == LidarKind::kSpinning
                          ? spinning_elevation_rad(lines_) / (static_cast<double>(lines_) - 1.0)
                          : kAviaLineStep;
  for (std::size_t line = 0; line < lines_; ++line) {
    line_elevation_rad_.push_back(
        step * (static_cast<double>(line) - 0.5 * (static_cast<double>(lines_) - 1.0)));
  }
  if (kind_ != LidarKind::kSpinning) return;
  const std::size_t shots_per_revolution = lines_ * kColumnsPerRevolution;
  for (std::size_t start = 0; start < size_; start += shots_per_revolution) {
    revolution_start_rad_.push_back(random.uniform() * kTurn / kColumnsPerRevolution);
  }
}

Shot ScanPattern::shot(std::size_t index) const {
  return kind_ == LidarKind::kSpinning ? spinning_shot(index) : rosette_shot(index);
}

Shot ScanPattern::rosette_shot(std::size_t index) const {
  Shot shot;
  shot.line = static_cast<std::uint16_t>(index % lines_);
  const double rate_hz = kind_ == LidarKind::kAvia ? kAviaRateHz : kRosetteRateHz;
  shot.time_s = static_cast<double>(index) / rate_hz;
  shot.direction = rosette_direction(shot.line, shot.time_s);
  return shot;
}

Eigen::Vector3d ScanPattern::rosette_direction(std::size_t line, double time_s) const {
  const double first = kTurn * kFirstPrismHz * time_s + phase_first_rad_;
  const double second = kTurn * kSecondPrismHz * time_s + phase_second_rad_;
  const double share = kFirstPrismShare;
  const double y = half_fov_rad_ * (share * std::cos(first) + (1.0 - share) * std::cos(second));
  const double z = half_fov_rad_ * (share * std::sin(first) + (1.0 - share) * std::sin(second));
  const double angle = std::hypot(y, z);
  const double scale = angle > 0.0 ? std::sin(angle) / angle : 1.0;
  const Eigen::Vector3d fan(std::cos(angle), scale * y, scale * z);
  const double elevation = line_elevation_rad_[line];
  const double c = std::cos(elevation);
  const double s = std::sin(elevation);
  return {c * fan.x() - s * fan.z(), fan.y(), s * fan.x() + c * fan.z()};
}

Eigen::Vector3d ScanPattern::direction_at(const Shot& shot, double time_s) const {
  if (kind_ != LidarKind::kSpinning) return rosette_direction(shot.line, time_s);
  const double turn = -kTurn * (time_s - shot.time_s) / kRevolutionS;
  const double c = std::cos(turn);
  const double s = std::sin(turn);
  return {c * shot.direction.x() - s * shot.direction.y(),
          s * shot.direction.x() + c * shot.direction.y(), shot.direction.z()};
}

Shot ScanPattern::spinning_shot(std::size_t index) const {
  const std::size_t column = index / lines_;
  const std::size_t revolution = column / kColumnsPerRevolution;
  const double position = static_cast<double>(column % kColumnsPerRevolution);
  Shot shot;
  shot.line = static_cast<std::uint16_t>(index % lines_);
  shot.time_s = kRevolutionS * static_cast<double>(column) / kColumnsPerRevolution;
  // Clockwise from behind, as spinning devices turn.
  const double azimuth = std::numbers::pi - position * kTurn / kColumnsPerRevolution -
                         revolution_start_rad_[revolution];
  const double elevation = line_elevation_rad_[shot.line];
  shot.direction = {std::cos(elevation) * std::cos(azimuth),
                    std::cos(elevation) * std::sin(azimuth), std::sin(elevation)};
  return shot;
}

bool ScanPattern::in_field(const Eigen::Vector3d& direction) const {
  const Eigen::Vector3d unit = direction.normalized();
  if (kind_ == LidarKind::kSpinning) {
    return std::abs(std::asin(std::clamp(unit.z(), -1.0, 1.0))) <=
           0.5 * spinning_elevation_rad(lines_);
  }
  const double cos_half = std::cos(half_fov_rad_);
  return std::any_of(line_elevation_rad_.begin(), line_elevation_rad_.end(), [&](double elevation) {
    return std::cos(elevation) * unit.x() + std::sin(elevation) * unit.z() >= cos_half;
  });
}

}  // namespace lvcalib::simulation
