// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "model/linear_model.h"

namespace lvcalib {

/// Factor on the stated variance of each channel's rows.
using ChannelVariances = std::array<double, kChannels>;

/// Variances that the mixed model estimates.
struct ModelVariances {
  ChannelVariances channel{1.0, 1.0, 1.0, 1.0};
  /// Where each scene's rows weigh by their own variances instead, those; else empty.
  std::vector<ChannelVariances> scene_channel = {};
  /// Variance of each group of random effects, in the order of VarianceGroup.
  std::array<double, kVarianceGroups> group{1e-7,  4e-4,  1e-12, 1e-7, 1e-7,
                                            1e-12, 1e-12, 1e-12, 1e-9};
  [[nodiscard]] const ChannelVariances& channel_of(std::size_t scene) const {
    return scene < scene_channel.size() ? scene_channel[scene] : channel;
  }
};

/// What one scene says about the global unknowns (extrinsic and effect parameters) once its own
/// unknowns are integrated out: log-likelihood = constant + gᵀx − ½ xᵀHx.
struct SceneTerm {
  Eigen::MatrixXd information;
  Eigen::VectorXd gradient;
  double constant = 0.0;
  /// What the gradient scatters beyond `information`, because the whole board moves; empty:
  /// nothing.
  Eigen::MatrixXd spread = {};
};

/// Which effect columns take part, with the Gaussian prior of each increment.
struct ColumnSubset {
  std::vector<int> columns;
  std::vector<double> prior_sigma;
  std::vector<double> prior_mean;  ///< Of the increment: −(value in use).
  /// Neighbours (the first's place among the columns, and how many) whose sum is zero.
  std::vector<std::pair<std::size_t, std::size_t>> zero_sums;
};

/// Appends an effect's columns, with priors about values in use (zero if none).
void append_columns(const EffectColumns& columns, const Eigen::VectorXd* in_use,
                    ColumnSubset& subset);

/// A fitted mixed model. Global unknowns: extrinsic (6), then the subset's columns.
struct ModelFit {
  ColumnSubset subset;
  Eigen::VectorXd solution;
  Eigen::MatrixXd covariance;
  std::vector<SceneTerm> scenes;
  SceneTerm prior;
  ModelVariances variances;     ///< What it weighs by.
  double log_likelihood = 0.0;  ///< Restricted (REML), up to a constant of the data.
  /// Per scene: pose, levels, and the random effects that are not held absent.
  std::vector<Eigen::VectorXd> local;
  [[nodiscard]] Eigen::VectorXd parameters() const { return solution.tail(solution.size() - 6); }
};

/// Which variances a fit estimates.
enum class Estimated {
  kAll,     ///< Of channels and groups; those of single scenes' channels stay as given.
  kBoards,  ///< Of motions of whole boards alone.
};

struct MixedModelOptions {
  int rounds = 12;          ///< Re-estimations of the variances.
  double tolerance = 0.02;  ///< Done when no log-variance moves by more.
  Estimated estimated = Estimated::kAll;
  int threads = 1;  ///< Scenes are shared among them; results are the same for any number.
};

/// Fits extrinsic, poses, levels, effect columns and random effects, and re-estimates all variances
/// by restricted maximum likelihood (fixed-point updates σ² = uᵀu/γ with γ the number of effects
/// that the data determine; MacKay 1992, equal to REML at the fixed point). Groups that start at
/// kAbsentVariance stay out: they are held there, and would change nothing that is stated.
ModelFit fit_model(const Linearization& linear, const ColumnSubset& subset,
                   const ModelVariances& start, const MixedModelOptions& options);

/// Whether the variances hold motions of whole boards between camera and LiDAR.
bool moves_boards(const ModelVariances& variances);
/// What a model is stated with, as a calibration is (see moves_board(); Liang & Zeger 1986).
struct StatedVariances {
  /// Without motions of whole boards, and each scene's rows by what their own scatter is,
  /// correlation of neighbours included: a scene that the model fits badly would else have the
  /// weight of its replicates.
  ModelVariances weights;
  ModelVariances motion;  ///< The same, with motions of whole boards.
};
/// From the variances of a search; groups that are not held absent are estimated again under the
/// weights, then motions of boards with all else as it is.
StatedVariances stated_variances(const Linearization& linear, const ColumnSubset& subset,
                                 const ModelVariances& variances, int threads = 1);
/// The fit by the weights, in which motions of whole boards widen the covariance instead,
/// A⁻¹(A + S)A⁻¹ with A the information and S the spread. The log-likelihood is that without
/// motions.
ModelFit fit_stated(const Linearization& linear, const ColumnSubset& subset,
                    const StatedVariances& variances, int threads = 1);

/// The linearisation about where a fit of it leads, to first order: extrinsic, boards, levels and
/// the subset's columns moved by the solution. Residuals change, derivatives stay.
Linearization stepped(Linearization linear, const ModelFit& fit);

/// How badly the state itself fits, all increments of extrinsic, poses, levels and columns zero and
/// the random effects fitted: minus twice the log-posterior up to a constant of the variances. What
/// a step of Gauss and Newton has to lower.
double misfit(const Linearization& linear, const ColumnSubset& subset,
              const ModelVariances& variances, int threads = 1);

/// What a scene's rows would say about extrinsic and columns with given variances; for scenes that
/// are only planned. Their residuals may be anything: only `information` is of use.
SceneTerm scene_term(const SceneProducts& products, const ColumnSubset& subset,
                     const ModelVariances& variances);

/// What the data say of a group of random effects that is held absent: with a variance v near
/// nothing, squares/(v·determined) is one on average if there is none of it, and `effective` times
/// that about χ² with as many degrees of freedom (score test).
struct GroupScore {
  double squares = 0.0;
  double determined = 0.0;
  double effective = 0.0;
};
std::array<GroupScore, kVarianceGroups> group_scores(const Linearization& linear,
                                                     const ModelFit& fit, int threads = 1);

/// Log of the density that the other scenes predict for a scene, given the fit's variances.
double predictive_log_density(const ModelFit& fit, std::size_t scene);

/// Solution of the global unknowns from all scenes but one.
Eigen::VectorXd solution_without(const ModelFit& fit, std::size_t scene);

/// Sums of squared residuals over σ (stated) of a scene, per channel, with given global unknowns
/// and the scene's pose and levels fitted; random effects are not subtracted.
std::array<double, kChannels> squares_at(const Linearization& linear, std::size_t scene,
                                         const ColumnSubset& subset, const Eigen::VectorXd& globals,
                                         const ModelVariances& variances);

}  // namespace lvcalib
