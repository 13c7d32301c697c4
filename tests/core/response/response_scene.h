// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Simulated scenes refined from a disturbed true pose: what the boundary response is given, without
// detection and localization.

#include <gtest/gtest.h>

#include "response/boundary_response.h"
#include "support/simulated_boards.h"

namespace lvcalib::test {

struct RefinedScene {
  std::string name;
  Cloud cloud;
  BoardRefinement refinement;
};

inline RefinedScene refined_scene(const simulation::SimulationOptions& options, int scene) {
  const auto truth = simulated_scene(options, scene);
  RefinedScene out;
  out.name = truth.name;
  out.cloud = points_about(truth.cloud, options.target, truth.lidar_from_board);
  const Rigid3 start = off_by(truth.lidar_from_board, options.target, 0.004, 0.004, 3);
  auto refinement = refine_board(out.cloud, options.target, start, {}, {});
  if (!refinement) {
    ADD_FAILURE() << refinement.error().text();
    return out;
  }
  out.refinement = std::move(*refinement);
  return out;
}

inline std::vector<RefinedScene> refined_scenes(const simulation::SimulationOptions& options) {
  std::vector<RefinedScene> out;
  for (int s = 0; s < options.scenes; ++s) out.push_back(refined_scene(options, s));
  return out;
}

inline std::vector<ResponseInput> inputs_of(const std::vector<RefinedScene>& scenes) {
  std::vector<ResponseInput> out;
  for (const RefinedScene& s : scenes) out.push_back({s.name, &s.cloud, &s.refinement});
  return out;
}

}  // namespace lvcalib::test
