// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// What a fit says about its last unknowns, an effect's parameters: whether they are zero, how well
// the data determine them, and how the extrinsic moves when they are left out. And what gains over
// scenes held out say.

#include <algorithm>
#include <vector>

#include <Eigen/Core>

#include "model/mixed_model.h"

namespace lvcalib {

/// A movement of the extrinsic: of the origin (m) and about it (rad).
struct ExtrinsicMove {
  double translation_m = 0.0;
  double rotation_rad = 0.0;
  [[nodiscard]] bool exceeds(const ExtrinsicMove& other) const {
    return translation_m > other.translation_m || rotation_rad > other.rotation_rad;
  }
  /// The larger of both over those of another.
  [[nodiscard]] double over(const ExtrinsicMove& other) const {
    return std::max(translation_m / other.translation_m, rotation_rad / other.rotation_rad);
  }
};

/// How far the extrinsic may be off before it matters to the user: so much, or so many standard
/// deviations of it (the worst axis) if that is more. Zero standard deviations for users who know
/// what they need.
struct Tolerance {
  ExtrinsicMove move{5e-4, 2e-4};
  double sigmas = 0.5;
};

/// A tolerance with what a fit leaves open of the extrinsic.
ExtrinsicMove tolerated(const Tolerance& tolerance, const ModelFit& fit);

/// By how much the extrinsic moves if the last unknowns of a fit are left out at these values.
ExtrinsicMove move_if_omitted(const ModelFit& fit, const Eigen::VectorXd& values);

/// Share of the squared effect of the last unknowns of a fit, at these values, that the other
/// unknowns do not absorb, 0…1; zero for no effect at all.
double unabsorbed_share(const ModelFit& fit, const Eigen::VectorXd& values);

/// How far the extrinsic may move if the last p unknowns of a fit are left out.
struct MoveLimit {
  ExtrinsicMove most;     ///< Upper 95 % limit over the joint confidence region of the values.
  ExtrinsicMove unknown;  ///< The same if the estimate were zero: what the data cannot exclude.
};
MoveLimit move_limit(const ModelFit& fit, Eigen::Index p);

/// P value of the squared length, in standard deviations, of p unknowns that may be zero.
/// Between-scene effects have no more degrees of freedom than the scenes leave: three of each
/// scene's board pose minus the extrinsic.
double f_test(double squares, Eigen::Index p, std::size_t scenes);

/// Information about the last p unknowns of a fit once all others are integrated out, from the data
/// alone (without their priors).
Eigen::MatrixXd information_of_last(const ModelFit& fit, Eigen::Index p);

/// Wald F test that the last p unknowns of a fit are zero, from the data alone.
double f_test(const ModelFit& fit, Eigen::Index p);

/// How much of the effect in the unknowns [first, first + count) of a fit the data can tell from
/// all other unknowns: the largest share of a squared effect that is left, over its parameters.
/// Next to nothing makes a solve singular.
double determined_share(const ModelFit& fit, Eigen::Index first, Eigen::Index count);

/// Mean of some values with its standard error, which is infinite for fewer than two.
struct MeanAndError {
  double mean = 0.0;
  double error = 0.0;
};
MeanAndError mean_and_error(const std::vector<double>& values);

/// True if the mean over scenes exceeds its standard error: the one-standard-error rule (Breiman et
/// al. 1984) for gains of scenes held out.
bool is_gain(const std::vector<double>& per_scene);

}  // namespace lvcalib
