// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/beam.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "base/units.h"

namespace lvcalib::simulation {
namespace {

constexpr std::size_t kMaxRays = 256;  // As check() allows.
constexpr double kReferenceRange = 3.0;
// The weakest signal still ranged like a black print, not worse: receivers adapt their gain.
constexpr double kLowestReflectivity = 0.03;

// One shot on its way, with its noise drawn and the effects of scanner and motion applied.
class ShotSimulator {
 public:
  ShotSimulator(const LidarOptions& options, const ScanPattern& pattern, const RayCaster& caster,
                const PlantedEffects& planted, double clock_s)
      : options_(options),
        pattern_(pattern),
        planted_(planted),
        beam_(options, caster, planted.beam, planted.radiometry),
        clock_s_(clock_s),
        jitter_rad_(options.angle_sigma_deg * std::numbers::pi / 180.0) {}

  // The return of a shot; range without noise but with error, intensity without noise.
  Return fire(const Shot& shot, Random& random) const {
    const double across = jitter_rad_ * random.normal();
    const double up = jitter_rad_ * random.normal();
    const Eigen::Vector3d direction = aim(shot, 0.0, across, up);
    const double turn = 2.0 * std::numbers::pi * random.uniform();
    Eigen::Vector3d start_m = Eigen::Vector3d::Zero();
    const bool moved = move_start(shot, direction, start_m);
    const Eigen::Vector3d* start = moved ? &start_m : nullptr;
    Return hit = beam_.fire(direction, turn, start);
    if (!(hit.range_m > 0.0)) return hit;
    if (planted_.beam.splits_intensity()) {
      look_elsewhere(shot, {across, up}, turn, start, hit);
    }
    disturb(shot, hit);
    return hit;
  }

 private:
  // Where the beam goes: beside the scanner's direction by two small angles.
  [[nodiscard]] Eigen::Vector3d aim(const Shot& shot, double delay_s, double across,
                                    double up) const {
    const Eigen::Vector3d scanner = planted_.angle.active() || delay_s != 0.0
                                        ? planted_.angle.true_direction(pattern_, shot, delay_s)
                                        : shot.direction;
    const Eigen::Vector3d horizontal = Eigen::Vector3d::UnitZ().cross(scanner).normalized();
    const Eigen::Vector3d vertical = scanner.cross(horizontal);
    return (scanner + across * horizontal + up * vertical).normalized();
  }

  bool move_start(const Shot& shot, const Eigen::Vector3d& direction,
                  Eigen::Vector3d& start_m) const {
    if (planted_.angle.moves_start()) start_m += planted_.angle.start_m(direction);
    if (planted_.motion.active()) start_m += planted_.motion.position_m(shot.time_s);
    return planted_.angle.moves_start() || planted_.motion.active();
  }

  // Takes the intensity from where the beam's light goes or went, the range stays.
  void look_elsewhere(const Shot& shot, const Eigen::Vector2d& jitter_rad, double turn,
                      const Eigen::Vector3d* start, Return& hit) const {
    hit.reflectivity = 0.0;
    hit.intensity = 0.0;
    for (const BeamDisturbance::Lag& lag : planted_.beam.lags()) {
      if (lag.weight == 0.0) continue;
      const Eigen::Vector3d direction =
          aim(shot, lag.delay_s, jitter_rad.x() + planted_.beam.offset_horizontal_rad(),
              jitter_rad.y() + planted_.beam.offset_vertical_rad());
      const Return seen = beam_.fire(direction, turn, start);
      hit.reflectivity += lag.weight * seen.reflectivity;
      hit.intensity += lag.weight * seen.intensity;
    }
  }

  // Errors of the receiver.
  void disturb(const Shot& shot, Return& hit) const {
    const RadiometryDisturbance& radiometry = planted_.radiometry;
    double error = 0.0;
    if (planted_.range.active()) {
      error += planted_.range.error_m({hit.range_m, hit.power, hit.cos_incidence,
                                       std::atan2(shot.direction.y(), shot.direction.x()),
                                       clock_s_ + shot.time_s, shot.time_s, shot.line});
    }
    if (radiometry.saturates()) error += radiometry.saturation_error_m(hit.power);
    if (error != 0.0) hit.range_m += error;
    if (radiometry.changes_intensity()) {
      hit.intensity = radiometry.intensity(hit.intensity, hit.power, shot.direction, shot.line,
                                           options_.intensity_scale);
    }
  }

  const LidarOptions& options_;
  const ScanPattern& pattern_;
  const PlantedEffects& planted_;
  Beam beam_;
  double clock_s_;
  double jitter_rad_;
};

}  // namespace

Beam::Beam(const LidarOptions& options, const RayCaster& caster, const BeamDisturbance& disturbance,
           const RadiometryDisturbance& radiometry)
    : options_(options),
      caster_(caster),
      disturbance_(disturbance),
      radiometry_(radiometry),
      horizontal_mrad_(disturbance.horizontal_mrad(options)),
      vertical_mrad_(disturbance.vertical_mrad(options)),
      incidence_exponent_(radiometry.incidence_exponent(options)),
      range_exponent_(radiometry.range_exponent(options)) {
  double variance = 0.0;
  for (int i = 0; i < options.beam_rays; ++i) {
    const double radius = std::sqrt(-2.0 * std::log(1.0 - (i + 0.5) / options.beam_rays));
    nodes_.push_back(
        {radius * std::cos(kGoldenAngleRad * i), radius * std::sin(kGoldenAngleRad * i)});
    variance += 0.5 * radius * radius / options.beam_rays;
  }
  const double scale = 1.0 / std::sqrt(variance);
  for (Node& node : nodes_) {
    node.x *= scale;
    node.y *= scale;
  }
  const double farthest = std::hypot(nodes_.back().x, nodes_.back().y);
  reach_rad_ = farthest * 1e-3 * std::max(horizontal_mrad_, vertical_mrad_);
}

// Whether the whole footprint lies on one plain piece of the surface that its axis meets.
bool Beam::is_plain(const Aim& aim, const Axes& axes, const Hit& hit) const {
  const Surface& surface = caster_.room().surfaces[static_cast<std::size_t>(hit.surface)];
  const double reach = reach_rad_ * hit.range_m / std::max(0.02, hit.cos_incidence);
  if (surface.half_u_m - std::abs(hit.u_m) < reach || surface.half_v_m - std::abs(hit.v_m) < reach)
    return false;
  if (surface.board != nullptr) {
    const Eigen::Vector2d point = caster_.on_board(hit);
    if (surface.board->clearance_m(point.x(), point.y()) <=
        reach + std::abs(disturbance_.edge_shift_m())) {
      return false;
    }
  }
  const auto other = [&](std::uint8_t i) {
    return i != hit.surface && !caster_.encloses_origin(i);
  };
  if (std::none_of(aim.candidates.begin(), aim.candidates.end(), other)) return true;
  // Something else is near the line of sight: feel around the rim of the footprint. Whatever could
  // hide between these rays is thinner than anything in the room.
  constexpr int kRim = 6;
  const double radius = std::hypot(nodes_.back().x, nodes_.back().y);
  for (int i = 0; i < kRim; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kRim;
    const Eigen::Vector3d ray = (aim.direction + radius * (std::cos(angle) * axes.horizontal +
                                                           std::sin(angle) * axes.vertical))
                                    .normalized();
    if (caster_.cast(ray, aim.candidates, aim.start_m).surface != hit.surface) return false;
  }
  return true;
}

// What the device's compensation leaves of incidence and range.
double Beam::uncompensated(const Hit& hit) const {
  return std::pow(hit.cos_incidence, incidence_exponent_) *
         std::pow(hit.range_m / kReferenceRange, -range_exponent_);
}

Beam::SubRay Beam::sub_ray(const Hit& hit, double uncompensated) const {
  double reflectivity = caster_.reflectivity(hit, disturbance_.edge_shift_m());
  if (radiometry_.is_glossy() && caster_.is_board(hit)) {
    reflectivity += radiometry_.gloss(hit.cos_incidence);
  }
  return {hit.range_m, reflectivity * hit.cos_incidence / (hit.range_m * hit.range_m), reflectivity,
          options_.intensity_scale * reflectivity * uncompensated};
}

Return Beam::fire(const Eigen::Vector3d& direction, double turn_rad,
                  const Eigen::Vector3d* start_m) const {
  RayCaster::Candidates storage;
  const auto candidates = caster_.candidates(direction, reach_rad_, storage,
                                             start_m == nullptr ? 0.0 : start_m->norm());
  const Hit axis = caster_.cast(direction, candidates, start_m);
  if (axis.surface < 0) return {};
  const Eigen::Vector3d horizontal = Eigen::Vector3d::UnitZ().cross(direction).normalized();
  const Axes axes{1e-3 * horizontal_mrad_ * horizontal,
                  1e-3 * vertical_mrad_ * direction.cross(horizontal)};
  double left = uncompensated(axis);
  if (reach_rad_ <= 0.0 || is_plain({direction, start_m, candidates}, axes, axis)) {
    const SubRay ray = sub_ray(axis, left);
    return {ray.range_m, ray.reflectivity, ray.intensity, ray.power, axis.cos_incidence};
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
    const Hit hit = caster_.cast(ray, candidates, start_m);
    if (hit.surface < 0) continue;
    if (hit.surface != surface) {
      surface = hit.surface;
      left = uncompensated(hit);
      one_surface = false;
    }
    rays[count++] = sub_ray(hit, left);
  }
  Return result = mix({rays.data(), count});
  result.cos_incidence = axis.cos_incidence;
  const double pull = options_.range_follows_power ? disturbance_.range_pull() : 0.0;
  if (one_surface && pull != 1.0) {
    result.range_m = axis.range_m + pull * (result.range_m - axis.range_m);
  }
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
    pulse.power = share * power;
    if (disturbance_.mean_exponent() != 1.0) {
      const double factor = bloom(rays.subspan(begin, i - begin), pulse.reflectivity);
      pulse.reflectivity *= factor;
      pulse.intensity *= factor;
    }
    if (power > best_power) {
      best = pulse;
      best_power = power;
    }
    begin = i;
  }
  return best;
}

// Power mean over mean of a pulse's reflectivities.
double Beam::bloom(std::span<const SubRay> pulse, double mean_reflectivity) const {
  const double q = disturbance_.mean_exponent();
  double sum = 0.0;
  for (const SubRay& ray : pulse) sum += std::pow(ray.reflectivity, q);
  return std::pow(sum / static_cast<double>(nodes_.size()), 1.0 / q) / mean_reflectivity;
}

Cloud scan(const LidarOptions& options, const ScanPattern& pattern, const RayCaster& caster,
           Random random, std::stop_token stop, const PlantedScene& planted) {
  constexpr std::size_t kStopInterval = 4096;
  const ShotSimulator simulator(options, pattern, caster, planted.effects, planted.clock_s);
  Cloud cloud;
  const std::size_t count = pattern.size();
  cloud.points_m.reserve(count);
  cloud.intensity.reserve(count);
  cloud.time_s.reserve(count);
  cloud.line.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    if (i % kStopInterval == 0 && stop.stop_requested()) return {};
    const Shot shot = pattern.shot(i);
    const Return hit = simulator.fire(shot, random);
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
