// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <stop_token>
#include <vector>

#include <Eigen/Core>

#include "base/random.h"
#include "cloud/cloud.h"
#include "simulation/disturbances/planted_effects.h"
#include "simulation/room.h"
#include "simulation/scan_pattern.h"
#include "simulation/simulation_options.h"

namespace lvcalib::simulation {

/// What the receiver makes of one shot, before noise.
struct Return {
  double range_m = 0.0;
  double reflectivity = 0.0;   ///< Seen over the footprint; less than the surface's where part of
                               ///< the light is lost behind an edge.
  double intensity = 0.0;      ///< Calibrated scale, with the device's residual dependence on
                               ///< incidence and range.
  double power = 0.0;          ///< ρ cos θ / r², mean over the footprint.
  double cos_incidence = 1.0;  ///< Of the beam's axis.
};

/// The laser beam: an elliptic Gaussian footprint of sub-rays of equal energy.
///
/// Sub-ray i of n sits at radius √(−2 ln(1 − (i+½)/n)) and at golden-angle steps, the whole turned
/// by a random angle from shot to shot; scaled so that the variance is exactly one. Each returns
/// power P = ρ cos θ / r². Returns closer than the pulse length merge; of several the strongest
/// counts. Its range is Σ P r / Σ P, its intensity the mean of ρ cosᵃθ (r/3 m)⁻ᵇ over all sub-rays,
/// those of other returns counting as zero. A footprint clear of every edge takes a single ray.
class Beam {
 public:
  Beam(const LidarOptions& options, const RayCaster& caster,
       const BeamDisturbance& disturbance = {}, const RadiometryDisturbance& radiometry = {});

  /// The return of a shot that truly leaves along `direction` (unit), turned by `turn_rad`, from
  /// the caster's origin or from `start_m` beside it.
  [[nodiscard]] Return fire(const Eigen::Vector3d& direction, double turn_rad,
                            const Eigen::Vector3d* start_m = nullptr) const;

 private:
  struct Axes {
    Eigen::Vector3d horizontal, vertical;  // Scaled by the divergence.
  };
  struct SubRay {
    double range_m, power, reflectivity, intensity;
  };
  struct Node {
    double x, y;
  };

  struct Aim {
    const Eigen::Vector3d& direction;
    const Eigen::Vector3d* start_m;
    std::span<const std::uint8_t> candidates;
  };

  [[nodiscard]] bool is_plain(const Aim& aim, const Axes& axes, const Hit& hit) const;
  [[nodiscard]] double uncompensated(const Hit& hit) const;
  [[nodiscard]] SubRay sub_ray(const Hit& hit, double uncompensated) const;
  [[nodiscard]] Return mix(std::span<SubRay> rays) const;
  [[nodiscard]] double bloom(std::span<const SubRay> pulse, double mean_reflectivity) const;

  const LidarOptions& options_;
  const RayCaster& caster_;
  BeamDisturbance disturbance_;
  RadiometryDisturbance radiometry_;
  double horizontal_mrad_;
  double vertical_mrad_;
  double incidence_exponent_;
  double range_exponent_;
  std::vector<Node> nodes_;
  double reach_rad_;  // Radius that holds every node.
};

/// What is planted in one scene.
struct PlantedScene {
  PlantedEffects effects = {};
  double clock_s = 0.0;  ///< Since the first scene.
};

/// Fires all shots of a pattern and adds the noise: direction jitter before the shot, range and
/// intensity noise after it. The point lies in the commanded direction; intensity is a whole
/// number, 0 … 255 on the default scale. Planted effects act before the noise. Empty if stopped.
Cloud scan(const LidarOptions& options, const ScanPattern& pattern, const RayCaster& caster,
           Random random, std::stop_token stop, const PlantedScene& planted = {});

}  // namespace lvcalib::simulation
