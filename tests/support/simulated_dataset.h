// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A simulated dataset on disk with its truth, for tests of the whole pipeline.

#include <gtest/gtest.h>

#include "pipeline/dataset.h"
#include "simulation/dataset_writer.h"
#include "support/temporary_folder.h"

namespace lvcalib::test {

inline simulation::SimulationOptions dataset_options(std::uint64_t seed, int scenes) {
  simulation::SimulationOptions options;
  options.seed = seed;
  options.scenes = scenes;
  options.lidar.points = 100'000;
  options.image.width_px = 800;
  options.image.height_px = 500;
  return options;
}

/// Simulates a rig and writes it as a dataset.
class SimulatedDataset {
 public:
  explicit SimulatedDataset(const simulation::SimulationOptions& options) {
    auto rig = simulation::simulate(options, {});
    if (!rig) {
      ADD_FAILURE() << rig.error().text();
      return;
    }
    rig_ = std::move(*rig);
    const Status written = simulation::write_dataset(rig_, path());
    if (!written) ADD_FAILURE() << written.error().text();
  }
  [[nodiscard]] std::filesystem::path path() const { return folder_.path() / "dataset"; }
  [[nodiscard]] const simulation::SimulatedRig& rig() const { return rig_; }
  [[nodiscard]] Dataset open() const {
    auto dataset = open_dataset(path());
    if (!dataset) {
      ADD_FAILURE() << dataset.error().text();
      return {};
    }
    return std::move(*dataset);
  }
  /// Replaces target.yaml by one that says `factor` times the size.
  void scale_target(double factor) const {
    Target target = rig_.target;
    target.tag_size_m *= factor;
    target.circle_radius_m *= factor;
    target.margin_m *= factor;
    folder_.write("dataset/target.yaml", to_yaml(target));
  }

 private:
  TemporaryFolder folder_;
  simulation::SimulatedRig rig_;
};

}  // namespace lvcalib::test
