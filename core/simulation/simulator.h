// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/progress.h"
#include "base/rigid3.h"
#include "camera/camera.h"
#include "cloud/cloud.h"
#include "simulation/disturbances/effect_plan.h"
#include "simulation/image_renderer.h"
#include "simulation/simulation_options.h"
#include "target/target.h"

namespace lvcalib::simulation {

class PrintedBoard;
struct PlantedEffects;

/// One scene as the sensors see it, with its truth.
struct SimulatedScene {
  std::string name;
  Cloud cloud;
  SimulatedImage image;
  bool has_board = true;  ///< False for a room without the board: the transforms mean nothing then.
  Rigid3 lidar_from_board;
  Rigid3 camera_from_board;
};

/// A rig with its scenes and its truth. Target and camera are what their files say: effects that
/// are planted in them show in the data only. camera_from_lidar is the physical pose.
struct SimulatedRig {
  SimulationOptions options;
  Target target;
  Camera camera;
  Rigid3 camera_from_lidar;
  EffectDetails effect_details;  ///< Of the options' effects.
  std::vector<SimulatedScene> scenes;
};

/// Simulates a rig scene by scene, so that a study need not keep all of them in memory. A scene
/// depends on the options, the seed and its number only: not on order, threads or other scenes.
class Simulator {
 public:
  /// Draws the rig. Errors as check(SimulationOptions).
  static Result<Simulator> create(const SimulationOptions& options);

  /// The rig without scenes.
  [[nodiscard]] const SimulatedRig& rig() const { return rig_; }

  /// Name of a scene: A, B, … Z; S001, S002, … if there are more than 26.
  [[nodiscard]] std::string scene_name(int scene) const;

  /// Scene number 0 … scenes−1. kCancelled within 0.1 s of a stop; kUsage if the board fits
  /// nowhere. Safe to call from several threads.
  [[nodiscard]] Result<SimulatedScene> simulate_scene(int scene, const RunContext& context) const;

 private:
  explicit Simulator(const SimulationOptions& options);
  SimulatedRig rig_;
  std::shared_ptr<const PlantedEffects> planted_;
  std::shared_ptr<const PrintedBoard> board_;
};

/// A rig with all its scenes, one thread per scene.
Result<SimulatedRig> simulate(const SimulationOptions& options, const RunContext& context);

/// Simulates all scenes of a simulator, `threads` at a time, handing each to `take` (one call at a
/// time) with its number. Stops at the first error, of the simulation or of `take`.
Status simulate_each(const Simulator& simulator, const RunContext& context,
                     const std::function<Status(int, SimulatedScene)>& take);

}  // namespace lvcalib::simulation
