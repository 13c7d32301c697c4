// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "base/random.h"

namespace lvcalib::simulation {

/// Parameters of planted effects beyond their value, by effect and name (with the unit as suffix).
using EffectDetails = std::map<std::string, std::map<std::string, std::vector<double>>>;

/// The effects asked for, as the groups of disturbances read them: values in SI units, one random
/// stream per effect, so that adding an effect does not change the details of another.
class EffectPlan {
 public:
  EffectPlan(const std::map<std::string, double>& effects, std::uint64_t seed)
      : effects_(effects), seed_(seed) {}

  [[nodiscard]] bool has(const std::string& id) const { return effects_.contains(id); }

  /// Value in SI units (m, rad, s, m/s, px or plain); `otherwise` if the effect is not planted.
  [[nodiscard]] double si(const std::string& id, double otherwise = 0.0) const;

  [[nodiscard]] Random random(const std::string& id) const;

  /// Deviations of the lines: normal, mean zero and an RMS of exactly `rms`; noted as `name` in
  /// `unit_si`. Empty if the effect is not planted.
  std::vector<double> per_line(const std::string& id, const std::string& name, double rms,
                               double unit_si, int lines, Random& random);

  /// Records details of a planted effect; forgotten for one that is not planted.
  void note(const std::string& id, const std::string& name, std::vector<double> values);
  void note(const std::string& id, const std::string& name, double value) {
    note(id, name, std::vector<double>{value});
  }

  [[nodiscard]] const EffectDetails& details() const { return details_; }

 private:
  const std::map<std::string, double>& effects_;
  std::uint64_t seed_;
  EffectDetails details_;
};

}  // namespace lvcalib::simulation
