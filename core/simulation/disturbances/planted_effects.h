// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "camera/camera.h"
#include "simulation/disturbances/beam.h"
#include "simulation/disturbances/board.h"
#include "simulation/disturbances/camera.h"
#include "simulation/disturbances/effect_plan.h"
#include "simulation/disturbances/lidar_angle.h"
#include "simulation/disturbances/lidar_range.h"
#include "simulation/disturbances/motion.h"
#include "simulation/disturbances/radiometry.h"
#include "simulation/simulation_options.h"

namespace lvcalib::simulation {

/// Everything that is wrong with a rig beyond its noise. Made without effects, every group leaves
/// the simulation as it is, to the last bit.
struct PlantedEffects {
  RangeDisturbance range;
  AngleDisturbance angle;
  BeamDisturbance beam;
  RadiometryDisturbance radiometry;
  BoardDisturbance board;
  CameraDisturbance camera;
  MotionDisturbance motion;
  EffectDetails details;
};

/// The effects of checked options; `camera` is the one that goes to the calibration file.
PlantedEffects plant_effects(const SimulationOptions& options, const Camera& camera);

}  // namespace lvcalib::simulation
