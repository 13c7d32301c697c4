// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "model/linear_model.h"

namespace lvcalib {

/// What every beam of some width does at a curved edge, as the scenes' own transitions tell its
/// size (BoundaryRow::curvature_m times one parameter, expected to be one). Not an effect to be
/// found: a nuisance of the model, so that it is not mistaken for ink or a bias of edges.
EffectPtr natural_footprint();

/// Standard deviation of its parameter about one: transitions tell the footprint's variance that
/// well where intensities are not quite linear and footprints not quite normal.
inline constexpr double kNaturalSpread = 0.3;

/// The beam's blur in tables with a print: increments of the three numbers of its covariance. Part
/// of every model there, as a nuisance with a size of its own.
EffectPtr beam_blur();

/// True for effects that describe the footprint themselves and take its place in the model.
bool describes_footprint(const std::string& effect_id);

}  // namespace lvcalib
