// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "selection/discovery.h"
#include "simulation/simulator.h"

namespace lvcalib::test {

/// Which table a rig belongs to.
enum class EffectSet { kNothing, kSingle, kWeak, kPair, kOutside, kAbsorbed };
std::string name_of(EffectSet set);

/// One rig to simulate: what is planted (values in the simulator's units) and its seed.
struct EffectTask {
  EffectSet set = EffectSet::kNothing;
  std::map<std::string, double> planted;
  std::uint64_t seed = 1;
};

/// Task number k of an endless list in which all sets and effects take turns.
EffectTask effect_task(std::size_t k, std::uint64_t first_seed);

/// Six scenes of a six-line rosette (120 000 points) at 1.5 to 4 m, tilts to 50°, nothing else
/// planted or left from the device. Absorbed: boards that face the
/// LiDAR at one distance.
simulation::SimulationOptions effect_rig_options(const EffectTask& task);

/// True parameters of an effect in the estimator's SI units, by the estimator's names, where both
/// sides mean the same number; empty where the functional forms differ.
std::map<std::string, double> true_parameters(const std::string& id,
                                              const simulation::SimulatedRig& rig);

/// Channel in which an effect of the catalogue or outside it shows first.
Channel main_channel(const std::string& id);

/// Effects that every simulated scan has, as its footprint has a size and is not round: that they
/// are found as well is no mistake.
const std::vector<std::string>& always_simulated();

/// Channel and covariates that name an effect outside the catalogue.
struct Signature {
  Channel channel;
  std::vector<std::string> covariates;
};
std::optional<Signature> signature_of(const std::string& outside_id);

}  // namespace lvcalib::test
