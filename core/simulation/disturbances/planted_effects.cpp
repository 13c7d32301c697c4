// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/disturbances/planted_effects.h"

namespace lvcalib::simulation {

PlantedEffects plant_effects(const SimulationOptions& options, const Camera& camera) {
  const int lines = line_count(options.lidar);
  EffectPlan plan(options.effects, options.seed);
  PlantedEffects planted;
  planted.range = RangeDisturbance(plan, lines);
  planted.angle = AngleDisturbance(plan, lines);
  planted.beam = BeamDisturbance(plan, options.lidar);
  planted.radiometry = RadiometryDisturbance(plan, lines);
  planted.board = BoardDisturbance(plan, options.target.outline());
  planted.camera = CameraDisturbance(plan, camera);
  planted.motion = MotionDisturbance(plan);
  planted.details = plan.details();
  return planted;
}

}  // namespace lvcalib::simulation
