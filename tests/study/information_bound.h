// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/rigid3.h"
#include "simulation/simulator.h"

namespace lvcalib::study {

/// Fisher information that one simulated scene holds about T_camera_lidar (left perturbation in
/// the camera frame), computed from the truth and the simulator's own noise figures: tag corners
/// with the given standard deviation; range of every point on the board; intensity of every point
/// in the rings of the circles. The inverse of the sum over scenes is the Cramér–Rao bound for
/// any estimator that uses these observations.
Matrix6d scene_information(const simulation::SimulatedRig& rig,
                           const simulation::SimulatedScene& scene, double corner_sigma_px);

}  // namespace lvcalib::study
