// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <vector>

#include "base/error.h"

namespace lvcalib::simulation {

/// One disturbance that can be planted. "Reported − true" is meant where a sign is asked for.
struct Disturbance {
  std::string id;       ///< Ids that start with x_ lie outside the estimator's catalogue.
  std::string unit;     ///< Of the value: mm, mm/s, ppm, mrad, px, us or 1.
  double lowest = 0.0;  ///< Smallest and largest value accepted.
  double highest = 0.0;
  double typical = 0.0;      ///< A size met on real rigs.
  bool needs_lines = false;  ///< Acts between lines, so the LiDAR must have several.
  std::string sentence;      ///< What the value is.
};

/// All of them, in the order of their groups.
const std::vector<Disturbance>& disturbances();

/// The disturbance of an id, or null.
const Disturbance* find_disturbance(const std::string& id);

/// What one unit of a value is in metres, radians, seconds, pixels or as a plain number.
double unit_in_si(const std::string& unit);

/// kUsage for an unknown id (naming the nearest and the known ones), a value that is not within the
/// id's range, or an effect between lines on a LiDAR of one line.
Status check_effects(const std::map<std::string, double>& effects, int lines);

}  // namespace lvcalib::simulation
