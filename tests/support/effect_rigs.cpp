// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/effect_rigs.h"

#include <algorithm>
#include <cmath>

#include "base/random.h"
#include "simulation/disturbances/registry.h"

namespace lvcalib::test {
namespace {

constexpr double kWeakShare = 0.25;
constexpr double kJitterRad = 0.024 * 3.14159265358979 / 180.0;

std::vector<std::string> planted_ids(bool outside) {
  std::vector<std::string> ids;
  for (const simulation::Disturbance& d : simulation::disturbances()) {
    if (d.id.starts_with("x_") == outside) ids.push_back(d.id);
  }
  return ids;
}

double typical(const std::string& id) {
  return simulation::find_disturbance(id)->typical;
}

// Effects whose neutral value is one are weakened towards it.
double weak(const std::string& id) {
  const double value = typical(id);
  const bool neutral_is_one = id == "intensity_nonlinearity" || id == "boundary_range_pull";
  return neutral_is_one ? 1.0 + kWeakShare * (value - 1.0) : kWeakShare * value;
}

std::map<std::string, double> pair_of(std::uint64_t seed) {
  const auto ids = planted_ids(false);
  Random random(seed);
  std::map<std::string, double> out;
  while (out.size() < 2) {
    const std::string& id = ids[random.below(ids.size())];
    out[id] = typical(id);
  }
  return out;
}

double detail(const simulation::SimulatedRig& rig, const std::string& id, const std::string& name,
              std::size_t k = 0) {
  return rig.effect_details.at(id).at(name).at(k);
}

std::map<std::string, double> per_line(const simulation::SimulatedRig& rig, const std::string& id,
                                       const std::string& name, const std::string& prefix) {
  std::map<std::string, double> out;
  const auto& values = rig.effect_details.at(id).at(name);
  for (std::size_t k = 0; k < values.size(); ++k)
    out[prefix + std::to_string(k)] = 1e-3 * values[k];
  return out;
}

}  // namespace

std::string name_of(EffectSet set) {
  switch (set) {
    case EffectSet::kNothing:
      return "nothing";
    case EffectSet::kSingle:
      return "single";
    case EffectSet::kWeak:
      return "weak";
    case EffectSet::kPair:
      return "pair";
    case EffectSet::kOutside:
      return "outside";
    case EffectSet::kAbsorbed:
      break;
  }
  return "absorbed";
}

EffectTask effect_task(std::size_t k, std::uint64_t first_seed) {
  static const std::vector<std::string> inside = planted_ids(false);
  static const std::vector<std::string> outside = planted_ids(true);
  static const std::vector<std::string> absorbed = {"range_offset", "range_scale",
                                                    "beam_origin_offset", "print_scale"};
  EffectTask task;
  task.seed = first_seed + k;
  // Of eight rigs four hold one effect and one each belongs to the other sets in turn.
  const std::size_t round = k / 8;
  switch (k % 8) {
    case 1:
      return task;
    case 3:
      task.set = EffectSet::kPair;
      task.planted = pair_of(task.seed);
      return task;
    case 5: {
      task.set = EffectSet::kOutside;
      const std::string& id = outside[round % outside.size()];
      task.planted[id] = typical(id);
      return task;
    }
    case 7: {
      const bool weakened = round % 2 == 0;
      task.set = weakened ? EffectSet::kWeak : EffectSet::kAbsorbed;
      const auto& ids = weakened ? inside : absorbed;
      const std::string& id = ids[(round / 2) % ids.size()];
      task.planted[id] = weakened ? weak(id) : typical(id);
      return task;
    }
    default:
      break;
  }
  task.set = EffectSet::kSingle;
  const std::string& id = inside[(4 * round + (k % 8) / 2) % inside.size()];
  task.planted[id] = typical(id);
  return task;
}

simulation::SimulationOptions effect_rig_options(const EffectTask& task) {
  simulation::SimulationOptions options;
  options.seed = task.seed;
  options.scenes = 6;
  options.target.tag_spacing = 0.1 / 0.12;
  options.lidar.kind = simulation::LidarKind::kAvia;
  options.lidar.points = 120'000;
  // Nothing but what is planted: these two are effects of the catalogue themselves.
  options.lidar.incidence_exponent = 0.0;
  options.lidar.range_exponent = 0.0;
  options.placement.min_distance_m = 1.5;
  options.placement.max_distance_m = 4.0;
  options.placement.max_tilt_deg = 50.0;
  if (task.set == EffectSet::kAbsorbed) {
    options.placement.min_distance_m = 2.9;
    options.placement.max_distance_m = 3.1;
    options.placement.max_tilt_deg = 4.0;
  }
  options.effects = task.planted;
  return options;
}

// Of effects whose size means the same to nature and to the estimator. Blooming does not: its κ
// counts the footprint here and the whole transition there. Nor does the detector's lag: the middle
// between two levels passes before the mean delay is over.
std::map<std::string, double> true_parameters(const std::string& id,
                                              const simulation::SimulatedRig& rig) {
  const auto at = rig.options.effects.find(id);
  if (at == rig.options.effects.end()) return {};
  const double si = at->second * simulation::unit_in_si(simulation::find_disturbance(id)->unit);
  static const std::map<std::string, std::string> same = {
      {"range_offset", "a"},      {"range_scale", "m"},    {"range_incidence", "a"},
      {"angle_scale", "azimuth"}, {"axis_wobble", "i"},    {"beam_origin_offset", "horizontal"},
      {"encoder_lag", "τ"},       {"boundary_bias", "δ0"}, {"footprint_offset", "βh"},
      {"print_scale", "scale"},   {"ink_gain", "g"},       {"corner_bias", "b"},
      {"rolling_shutter", "v"}};
  if (const auto name = same.find(id); name != same.end()) return {{name->second, si}};
  if (id == "channel_range_offset") return per_line(rig, id, "line_mm", "a");
  if (id == "channel_angle_offset") {
    auto out = per_line(rig, id, "line_elevation_mrad", "b");
    out.merge(per_line(rig, id, "line_azimuth_mrad", "c"));
    return out;
  }
  // The model has nature's share; the effect is what goes beyond.
  if (id == "boundary_range_pull") return {{"a", si - 1.0}};
  if (id == "beam_divergence") return {{"γ²", si * si + kJitterRad * kJitterRad}};
  if (id == "intensity_geometry") return {{"n", si}};
  // Planted as the error where the power is 1/0.6 of the limit; the effect's is that of e times it.
  if (id == "receiver_saturation") return {{"a", si / std::log(1.0 / 0.6)}, {"c", 1.0}};
  if (id == "intrinsics_error") {
    return {{"δf", si * rig.camera.fx},
            {"δcx", detail(rig, id, "principal_point_px", 0)},
            {"δcy", detail(rig, id, "principal_point_px", 1)}};
  }
  if (id == "scan_motion") {
    // The LiDAR moves, so what it sees moves the other way.
    return {{"vx", -1e-3 * detail(rig, id, "velocity_mm_s", 0)},
            {"vy", -1e-3 * detail(rig, id, "velocity_mm_s", 1)},
            {"vz", -1e-3 * detail(rig, id, "velocity_mm_s", 2)}};
  }
  return {};
}

Channel main_channel(const std::string& id) {
  static const std::map<std::string, Channel> outside = {{"x_board_bump", Channel::kRange},
                                                         {"x_azimuth_ripple", Channel::kRange},
                                                         {"x_lens_flaw", Channel::kCorner},
                                                         {"x_window_smudge", Channel::kIntensity}};
  if (const auto at = outside.find(id); at != outside.end()) return at->second;
  if (id == "board_bow" || id == "scan_motion" || id == "receiver_saturation")
    return Channel::kRange;
  if (id == "print_scale" || id == "rolling_shutter") return Channel::kCorner;
  const EffectPtr effect = find_effect(id);
  const std::string group = effect ? effect->info().group : "";
  if (group == "LiDAR range") return Channel::kRange;
  if (group == "radiometry") return Channel::kIntensity;
  if (group == "camera") return Channel::kCorner;
  return Channel::kBoundary;
}

const std::vector<std::string>& always_simulated() {
  static const std::vector<std::string> ids = {"beam_divergence", "footprint_anisotropy"};
  return ids;
}

std::optional<Signature> signature_of(const std::string& outside_id) {
  if (outside_id == "x_board_bump")
    return Signature{Channel::kRange, {"board x", "board y", "board radius"}};
  if (outside_id == "x_azimuth_ripple") return Signature{Channel::kRange, {"azimuth"}};
  if (outside_id == "x_lens_flaw")
    return Signature{Channel::kCorner, {"image x", "image y", "image radius"}};
  if (outside_id == "x_window_smudge")
    return Signature{Channel::kIntensity, {"azimuth", "elevation"}};
  return std::nullopt;
}

}  // namespace lvcalib::test
