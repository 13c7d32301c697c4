// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/rigid3.h"

namespace lvcalib {

class EffectSearch;
struct LeftOutSizes;

/// What an effect that is not in the model could still do to the extrinsic.
struct BudgetItem {
  std::string id;
  std::string parameter;  ///< The one whose size is given: the largest, measured by what matters.
  std::string unit;
  double size = 0.0;  ///< Upper 95 % limit (display units); the prior's where data say nothing.
  double translation_mm = 0.0;  ///< Movement of the extrinsic at that limit.
  double rotation_mrad = 0.0;
  /// Second moment (one σ) of the movement, left perturbation in the camera frame.
  Matrix6d moment = Matrix6d::Zero();
};

/// What every testable effect that is not in the model could still do to the extrinsic, largest
/// movement first. rank() must have run on the final model.
///
/// An effect with parameters θ ~ N(θ̂, Σ), given data and prior, moves the extrinsic by G θ when it
/// is left out. `size` is the upper 95 % limit |θ̂| + 1.645 σ of the parameter that is largest in
/// units of what matters; where the data say nothing, σ is that of the prior. `translation_mm` and
/// `rotation_mrad` are the movement at that limit (for several parameters: of all of them together,
/// in quadrature). `moment` is the second moment G (θ̂ θ̂ᵀ + Σ) Gᵀ, at one σ.
std::vector<BudgetItem> sensitivity_budget(const EffectSearch& search);

/// The covariance with the moments of the budget added: effects left out count as independent
/// errors.
Matrix6d covariance_with_budget(const Matrix6d& covariance, const std::vector<BudgetItem>& budget);

/// The extrinsic's covariance `own` of the search's model if faults that every device has, and that
/// the model leaves out, may be there: what total_covariance() says of a calibration. Nothing if
/// stopped.
std::optional<Matrix6d> total_covariance(const EffectSearch& search, const Matrix6d& own,
                                         const LeftOutSizes& sizes);

}  // namespace lvcalib
