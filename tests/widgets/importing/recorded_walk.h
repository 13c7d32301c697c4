// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QString>
#include <QTemporaryDir>

#include "core/recording/containers.h"
#include "core/recording/walk.h"
#include "simulation/simulator.h"
#include "target/target.h"

namespace lvcalib::test {

inline simulation::SimulationOptions walk_simulation(int scenes, int points, int width_px,
                                                     int height_px) {
  simulation::SimulationOptions options;
  options.seed = 5;
  options.scenes = scenes;
  options.lidar.points = points;
  options.image.width_px = width_px;
  options.image.height_px = height_px;
  options.placement.min_distance_m = 2.0;
  options.placement.max_distance_m = 2.5;
  return options;
}

/// A bag of a simulated walk in a folder of its own, written by the tests' own writer.
class RecordedWalk {
 public:
  explicit RecordedWalk(const simulation::SimulationOptions& simulated,
                        const WalkOptions& walk = {}) {
    rig = std::move(*simulation::simulate(simulated, {}));
    path = write(simulated_walk(rig, walk), QStringLiteral("walk.bag"));
  }
  QString write(const std::vector<BagMessage>& messages, const QString& name) const {
    const QString file = folder.filePath(name);
    write_bytes(file.toStdString(), ros1_bag(messages, {}));
    return file;
  }
  QTemporaryDir folder;
  simulation::SimulatedRig rig;
  QString path;
};

/// Three scenes, small and quick to read; too small to calibrate well.
inline const RecordedWalk& small_walk() {
  static const RecordedWalk walk(walk_simulation(3, 30'000, 480, 320));
  return walk;
}

}  // namespace lvcalib::test
