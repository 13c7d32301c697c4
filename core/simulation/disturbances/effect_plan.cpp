// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/disturbances/effect_plan.h"

#include <cmath>
#include <utility>

#include "simulation/disturbances/registry.h"
#include "simulation/seeds.h"

namespace lvcalib::simulation {

double EffectPlan::si(const std::string& id, double otherwise) const {
  const auto found = effects_.find(id);
  if (found == effects_.end()) return otherwise;
  const Disturbance* disturbance = find_disturbance(id);
  return found->second * (disturbance == nullptr ? 1.0 : unit_in_si(disturbance->unit));
}

Random EffectPlan::random(const std::string& id) const {
  std::uint64_t key = 0;
  for (const char letter : id) key = spread(key ^ static_cast<unsigned char>(letter));
  return random_for(seed_ ^ key, -1, Purpose::kEffect);
}

std::vector<double> EffectPlan::per_line(const std::string& id, const std::string& name, double rms,
                                         double unit_si, int lines, Random& random) {
  if (!has(id) || lines < 2) return {};
  std::vector<double> values;
  double mean = 0.0;
  for (int i = 0; i < lines; ++i) {
    values.push_back(random.normal());
    mean += values.back() / lines;
  }
  double square = 0.0;
  for (double& value : values) {
    value -= mean;
    square += value * value / lines;
  }
  std::vector<double> noted;
  for (double& value : values) {
    value *= rms / std::sqrt(square);
    noted.push_back(value / unit_si);
  }
  note(id, name, std::move(noted));
  return values;
}

void EffectPlan::note(const std::string& id, const std::string& name, std::vector<double> values) {
  if (has(id)) details_[id][name] = std::move(values);
}

}  // namespace lvcalib::simulation
