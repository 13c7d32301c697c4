// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/rigid3.h"
#include "simulation/simulator.h"

namespace lvcalib::study {

/// Fisher information that one simulated scene holds about T_camera_lidar (left perturbation in
/// the camera frame), computed from the truth and the simulator's own noise figures, with no part
/// of the estimator: every edge of the tags in the image, blurred and with the image's shot and
/// read noise; range and intensity of every return on the board. Intensity levels, their slopes
/// over the board and the beam's blur are nuisances that each scene has to itself. The inverse of
/// the sum over scenes is the Cramér–Rao bound for any estimator that uses these observations.
Matrix6d scene_information(const simulation::SimulatedRig& rig,
                           const simulation::SimulatedScene& scene);

/// What the returns alone hold about T_lidar_board (left perturbation in the LiDAR frame), with the
/// same nuisances.
Matrix6d board_information(const simulation::SimulatedRig& rig,
                           const simulation::SimulatedScene& scene);

}  // namespace lvcalib::study
