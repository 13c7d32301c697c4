// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "base/rigid3.h"
#include "solve/global_solution.h"

namespace lvcalib {

/// What a score test says about a fault of the scans that the solve does not have.
struct ScanFault {
  enum class Kind {
    kMotion,  ///< The boards move against the LiDAR while it scans.
    kLag,     ///< The intensities trail the reported directions along the scan.
    kAngles,  ///< Directions are off by scales, an eccentric encoder or a tilted axis.
    kOrigin,  ///< Beams start beside the frame's origin.
  };
  Kind kind = Kind::kMotion;
  std::optional<std::size_t> scene;  ///< Of one scene alone; without it the same in all.
  /// Speed (m/s), time (s, with its sign), largest of the angles' errors (rad, at a radian off
  /// where they are scales), or distance (m).
  double size = 0.0;
  double sigma = 0.0;  ///< Of it.
  double chi_square = 0.0;
  double gate = 0.0;  ///< That chance exceeds once in a thousand data sets, all tests together.
  /// How the extrinsic moves with the fault in the model: left perturbation in the camera frame.
  Vector6d move = Vector6d::Zero();
  /// The same if the fault is drawn to zero by its usual size, as long as it is not known to be
  /// there; of angles and origin only (see LeftOutSizes).
  Vector6d usual_move = Vector6d::Zero();
  [[nodiscard]] bool is_there() const { return chi_square > gate; }
};

/// Score tests (Rao 1948) on the equations of the solved problem, whose fault columns are filled:
/// with A, B, S the information of the solve's unknowns, of both and of the fault, e the residuals,
/// θ = (S − BᵀA⁻¹B)⁻¹ (g − BᵀA⁻¹JᵀV⁻¹e) is the fault's size, and χ² what it explains. All errors
/// that measurements share, motions of boards among them, are in V. Angles and origin come first;
/// where clouds have times, lag and motion follow, and motions of single scenes where that of all
/// together is not there.
std::vector<ScanFault> find_scan_faults(const std::vector<SceneEquations>& scenes,
                                        const GlobalPrior& prior, const SensorErrors& sensor,
                                        const SharedVariances& variances, int threads);

}  // namespace lvcalib
