// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A simulated dataset, calibrated, with its clouds and images in memory: what pages are shown.

#include <QImage>
#include <QTemporaryDir>
#include <memory>
#include <stdexcept>
#include <vector>

#include "pipeline/calibration.h"
#include "simulation/dataset_writer.h"
#include "simulation/simulator.h"

namespace lvcalib::test {

struct CalibratedDemo {
  std::shared_ptr<const CalibrationResult> result;
  std::vector<std::shared_ptr<const Cloud>> clouds;
  std::vector<QImage> images;
};

inline CalibratedDemo make_calibrated_demo(int scenes, int points) {
  simulation::SimulationOptions options;
  options.seed = 7;
  options.scenes = scenes;
  options.lidar.points = points;
  options.image.width_px = 1000;
  options.image.height_px = 640;
  options.placement.max_distance_m = 2.6;
  const auto rig = simulation::simulate(options, {});
  if (!rig) throw std::runtime_error(rig.error().text());
  const QTemporaryDir folder;
  const std::filesystem::path path = folder.filePath("demo").toStdString();
  if (const Status s = simulation::write_dataset(*rig, path); !s) {
    throw std::runtime_error(s.error().text());
  }
  const auto dataset = open_dataset(path);
  if (!dataset) throw std::runtime_error(dataset.error().text());
  auto result = calibrate(*dataset, {}, {});
  if (!result) throw std::runtime_error(result.error().text());
  CalibratedDemo demo;
  for (std::size_t s = 0; s < rig->scenes.size(); ++s) {
    demo.clouds.push_back(std::make_shared<Cloud>(rig->scenes[s].cloud));
    demo.images.emplace_back(QString::fromStdString(dataset->scenes[s].image.string()));
  }
  demo.result = std::make_shared<CalibrationResult>(std::move(*result));
  return demo;
}

/// The same for all tests of a program.
inline const CalibratedDemo& calibrated_demo() {
  static const CalibratedDemo demo = make_calibrated_demo(3, 120'000);
  return demo;
}

}  // namespace lvcalib::test
