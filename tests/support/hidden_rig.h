// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A simulated rig with effects planted by the simulator's own physics, calibrated: what discovery
// starts from, with the truth to compare with.

#include <map>
#include <optional>
#include <string>

#include <gtest/gtest.h>

#include "pipeline/calibration.h"
#include "support/simulated_dataset.h"

namespace lvcalib::test {

/// Six scenes of a six-line rosette at 1.5 to 4 m, tilts to 50°, with nothing but what is planted:
/// what the device leaves of range and incidence in its intensities, and the pull of bright print
/// on the range, are effects themselves.
inline simulation::SimulationOptions hidden_options(std::uint64_t seed,
                                                    const std::map<std::string, double>& planted) {
  simulation::SimulationOptions options = dataset_options(seed, 6);
  options.lidar.points = 80'000;
  options.target.tag_spacing = 0.1 / 0.12;
  options.lidar.incidence_exponent = 0.0;
  options.lidar.range_exponent = 0.0;
  options.placement.min_distance_m = 1.5;
  options.placement.max_distance_m = 4.0;
  options.placement.max_tilt_deg = 50.0;
  options.effects = planted;
  return options;
}

class HiddenRig {
 public:
  explicit HiddenRig(const simulation::SimulationOptions& options) : dataset_(options) {
    auto result = calibrate(dataset_.open(), {}, {});
    if (!result) {
      ADD_FAILURE() << result.error().text();
      return;
    }
    result_ = std::move(*result);
  }
  HiddenRig(std::uint64_t seed, const std::map<std::string, double>& planted)
      : HiddenRig(hidden_options(seed, planted)) {}

  [[nodiscard]] bool ok() const { return result_.has_value(); }
  [[nodiscard]] const CalibrationResult& result() const { return *result_; }
  [[nodiscard]] const simulation::SimulatedRig& rig() const { return dataset_.rig(); }
  [[nodiscard]] double error_m(const Rigid3& camera_from_lidar) const {
    return translation_distance_m(camera_from_lidar, rig().camera_from_lidar);
  }

 private:
  SimulatedDataset dataset_;
  std::optional<CalibrationResult> result_;
};

}  // namespace lvcalib::test
