// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "base/rigid3.h"
#include "solve/global_solution.h"

namespace lvcalib {

/// What a score test says about a fault within the scans that the solve does not have.
struct ScanFault {
  enum class Kind {
    kMotion,  ///< The boards move against the LiDAR while it scans.
    kLag,     ///< The intensities trail the reported directions along the scan.
  };
  Kind kind = Kind::kMotion;
  std::optional<std::size_t> scene;  ///< Of one scene alone; without it the same in all.
  double size = 0.0;                 ///< Speed (m/s) or time (s), the latter with its sign.
  double sigma = 0.0;                ///< Of it.
  double chi_square = 0.0;
  double gate = 0.0;  ///< That chance exceeds once in a thousand data sets, all tests together.
  /// How the extrinsic moves with the fault in the model: left perturbation in the camera frame.
  Vector6d move = Vector6d::Zero();
  [[nodiscard]] bool is_there() const { return chi_square > gate; }
};

/// Score tests (Rao 1948) on the equations of the solved problem, whose fault columns are filled:
/// with A, B, S the information of the solve's unknowns, of both and of the fault, e the residuals,
/// θ = (S − BᵀA⁻¹B)⁻¹ (g − BᵀA⁻¹JᵀV⁻¹e) is the fault's size, and χ² what it explains. All errors
/// that measurements share, motions of boards among them, are in V. Motions of single scenes follow
/// where those of all together are not there. Empty where no cloud has times.
std::vector<ScanFault> find_scan_faults(const std::vector<SceneEquations>& scenes,
                                        const GlobalPrior& prior, const SensorErrors& sensor,
                                        const SharedVariances& variances, int threads);

}  // namespace lvcalib
