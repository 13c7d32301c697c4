// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/beam.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace lvcalib::simulation {
namespace {

constexpr double kGoldenAngle = 2.399963229728653;
constexpr std::size_t kMaxRays = 256;  // As check() allows.
constexpr double kReferenceRange = 3.0;
// The weakest signal still ranged like a black print, not worse: receivers adapt their gain.
constexpr double kLowestReflectivity = 0.03;

}  // namespace

Beam::Beam(const LidarOptions& options, const RayCaster& caster)
    : options_(options), caster_(caster) {
  double variance = 0.0;
  for (int i = 0; i < options.beam_rays; ++i) {
    const double radius = std::sqrt(-2.0 * std::log(1.0 - (i + 0.5) / options.beam_rays));
    nodes_.push_back({radius * std::cos(kGoldenAngle * i), radius * std::sin(kGoldenAngle * i)});
    variance += 0.5 * radius * radius / options.beam_rays;
  }
  const double scale = 1.0 / std::sqrt(variance);
  for (Node& node : nodes_) {
    node.x *= scale;
    node.y *= scale;
  }
  const double farthest = std::hypot(nodes_.back().x, nodes_.back().y);
  reach_rad_ = farthest * 1e-3 * std::max(options.beam_horizontal_mrad, options.beam_vertical_mrad);
}

// Whether the whole footprint lies on one plain piece of the surface that its axis meets.
bool Beam::is_plain(const Eigen::Vector3d& direction, const Axes& axes, const Hit& hit,
                    std::span<const std::uint8_t> candidates) const {
  const Surface& surface = caster_.room().surfaces[static_cast<std::size_t>(hit.surface)];
  const double reach = reach_rad_ * hit.range_m / std::max(0.02, hit.cos_incidence);
  if (surface.half_u_m - std::abs(hit.u_m) < reach || surface.half_v_m - std::abs(hit.v_m) < reach)
    return false;
  if (surface.board != nullptr) {
    const Eigen::Vector2d point = caster_.on_board(hit);
    if (surface.board->clearance_m(point.x(), point.y()) <= reach) return false;
  }
  const auto other = [&](std::uint8_t i) {
    return i != hit.surface && !caster_.encloses_origin(i);
  };
  if (std::none_of(candidates.begin(), candidates.end(), other)) return true;
  // Something else is near the line of sight: feel around the rim of the footprint. Whatever could
  // hide between these rays is thinner than anything in the room.
  constexpr int kRim = 6;
  const double radius = std::hypot(nodes_.back().x, nodes_.back().y);
  for (int i = 0; i < kRim; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kRim;
    const Eigen::Vector3d ray =
        (direction + radius * (std::cos(angle) * axes.horizontal + std::sin(angle) * axes.vertical))
            .normalized();
    if (caster_.cast(ray, candidates).surface != hit.surface) return false;
  }
  return true;
}

// What the device's compensation leaves of incidence and range.
double Beam::uncompensated(const Hit& hit) const {
  return std::pow(hit.cos_incidence, options_.incidence_exponent) *
         std::pow(hit.range_m / kReferenceRange, -options_.range_exponent);
}

Beam::SubRay Beam::sub_ray(const Hit& hit, double uncompensated) const {
  const double reflectivity = caster_.reflectivity(hit);
  return {hit.range_m, reflectivity * hit.cos_incidence / (hit.range_m * hit.range_m), reflectivity,
          options_.intensity_scale * reflectivity * uncompensated};
}

Return Beam::fire(const Eigen::Vector3d& direction, double turn_rad) const {
  RayCaster::Candidates storage;
  const auto candidates = caster_.candidates(direction, reach_rad_, storage);
  const Hit axis = caster_.cast(direction, candidates);
  if (axis.surface < 0) return {};
  const Eigen::Vector3d horizontal = Eigen::Vector3d::UnitZ().cross(direction).normalized();
  const Axes axes{1e-3 * options_.beam_horizontal_mrad * horizontal,
                  1e-3 * options_.beam_vertical_mrad * direction.cross(horizontal)};
  double left = uncompensated(axis);
  if (reach_rad_ <= 0.0 || is_plain(direction, axes, axis, candidates)) {
    const SubRay ray = sub_ray(axis, left);
    return {ray.range_m, ray.reflectivity, ray.intensity};
  }
  std::array<SubRay, kMaxRays> rays{};
  std::size_t count = 0;
  const double c = std::cos(turn_rad);
  const double s = std::sin(turn_rad);
  int surface = axis.surface;
  bool one_surface = true;
  for (const Node& node : nodes_) {
    const Eigen::Vector3d ray = (direction + (c * node.x - s * node.y) * axes.horizontal +
                                 (s * node.x + c * node.y) * axes.vertical)
                                    .normalized();
    const Hit hit = caster_.cast(ray, candidates);
    if (hit.surface < 0) continue;
    if (hit.surface != surface) {
      surface = hit.surface;
      left = uncompensated(hit);
      one_surface = false;
    }
    rays[count++] = sub_ray(hit, left);
  }
  Return result = mix({rays.data(), count});
  if (one_surface && !options_.range_follows_power) result.range_m = axis.range_m;
  return result;
}

Return Beam::mix(std::span<SubRay> rays) const {
  const auto nearer = [](const SubRay& a, const SubRay& b) { return a.range_m < b.range_m; };
  const auto [near, far] = std::minmax_element(rays.begin(), rays.end(), nearer);
  // The common case of a single pulse needs no order.
  if (far->range_m - near->range_m > options_.pulse_length_m) {
    std::sort(rays.begin(), rays.end(), nearer);
  }
  const double share = 1.0 / static_cast<double>(nodes_.size());
  Return best;
  double best_power = 0.0;
  for (std::size_t begin = 0; begin < rays.size();) {
    Return pulse;
    double power = 0.0;
    std::size_t i = begin;
    for (; i < rays.size(); ++i) {
      if (i > begin && std::abs(rays[i].range_m - rays[i - 1].range_m) > options_.pulse_length_m)
        break;
      power += rays[i].power;
      pulse.range_m += rays[i].power * rays[i].range_m;
      pulse.reflectivity += share * rays[i].reflectivity;
      pulse.intensity += share * rays[i].intensity;
    }
    pulse.range_m /= power;
    if (power > best_power) {
      best = pulse;
      best_power = power;
    }
    begin = i;
  }
  return best;
}

Cloud scan(const LidarOptions& options, const ScanPattern& pattern, const RayCaster& caster,
           Random random, std::stop_token stop) {
  constexpr std::size_t kStopInterval = 4096;
  const Beam beam(options, caster);
  const double jitter = options.angle_sigma_deg * std::numbers::pi / 180.0;
  Cloud cloud;
  const std::size_t count = pattern.size();
  cloud.points_m.reserve(count);
  cloud.intensity.reserve(count);
  cloud.time_s.reserve(count);
  cloud.line.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    if (i % kStopInterval == 0 && stop.stop_requested()) return {};
    const Shot shot = pattern.shot(i);
    const Eigen::Vector3d horizontal = Eigen::Vector3d::UnitZ().cross(shot.direction).normalized();
    const Eigen::Vector3d vertical = shot.direction.cross(horizontal);
    const double across = jitter * random.normal();
    const double up = jitter * random.normal();
    const Eigen::Vector3d direction =
        (shot.direction + across * horizontal + up * vertical).normalized();
    const Return hit = beam.fire(direction, 2.0 * std::numbers::pi * random.uniform());
    const double dark = PrintedBoard::kWhite / std::max(kLowestReflectivity, hit.reflectivity);
    const double range = hit.range_m + options.range_sigma_m *
                                           std::pow(dark, options.range_dark_exponent) *
                                           random.normal();
    const double intensity = hit.intensity + options.intensity_sigma * random.normal();
    if (!(range > 0.0)) continue;
    cloud.points_m.emplace_back((range * shot.direction).cast<float>());
    // 255 for a scale of 150: a retroreflector saturates the device's byte.
    cloud.intensity.push_back(static_cast<float>(
        std::round(std::clamp(intensity, 0.0, options.intensity_scale * 255.0 / 150.0))));
    cloud.time_s.push_back(static_cast<float>(shot.time_s));
    cloud.line.push_back(shot.line);
  }
  return cloud;
}

}  // namespace lvcalib::simulation
