// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/progress.h"
#include "base/rigid3.h"
#include "discovery/board_grid.h"
#include "model/linear_model.h"
#include "model/mixed_model.h"
#include "model/model_scales.h"
#include "model/user_effect.h"
#include "solve/forward_problem.h"
#include "solve/print_table.h"

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

/// One rule of those that let an effect into the model, and how it came out.
struct Criterion {
  std::string name;  ///< See criteria_of().
  double value = 0.0;
  double threshold = 0.0;
  bool at_most = false;  ///< Holds up to the threshold; else from it on.
  [[nodiscard]] bool holds() const { return at_most ? value <= threshold : value >= threshold; }
};

struct DiscoveryOptions {
  int max_effects = 6;  ///< The search adds no more.
  /// Effects that are in the model from the start: ids of the catalogue, or the user's own (see
  /// parse_user_effect). One that the data cannot bear is left out and said so.
  std::vector<std::string> with;
  double false_alarm = 0.05;          ///< Over all candidates of a round.
  double min_gain = 0.01;             ///< Least fall of a channel's held-out squares …
  double min_gain_few_scenes = 0.03;  ///< … with three scenes or fewer.
  double min_extrinsic_move = 0.5;    ///< Or so many σ that the extrinsic moves.
  double scenes_improved = 0.75;      ///< Share of scenes that must be predicted better, …
  double speaking_nats = 0.5;         ///< … of those whose log-density changes by so much.
  double min_explained = 0.2;         ///< Of what a channel misses by, if that exceeds its noise.
  double alias_correlation = 0.95;    ///< Candidates correlated higher cannot be told apart.
  double min_structure = 0.02;        ///< Held-out share of variance worth a mention, or …
  double min_sure_structure = 0.01;   ///< … where the scenes agree that it is no chance.
  double min_height = 0.1;            ///< Least height (in σ of one range) of something local.
  Tolerance tolerance;                ///< What an effect must move to matter.
  int swaps = 4;                      ///< Aliases tried in place of effects after an addition.
  std::size_t closed_forms = 3;       ///< Covariates with unknown structure that get a formula.
  TableOptions table;
  UserEffectOptions user;
  bool advise_scenes = true;  ///< Compute the board poses worth taking next.
  BoardGridOptions grid;      ///< Where they are looked for.
};

enum class EffectVerdict { kPresent, kAbsent, kAliased, kNotTestable };
std::string name_of(EffectVerdict verdict);

/// A parameter's estimate in SI units with what people read.
struct ParameterEstimate {
  std::string name;
  std::string unit;
  double unit_in_si = 1.0;
  double value = 0.0;  ///< SI
  double sigma = 0.0;  ///< SI
};

/// A curve at one place, SI units (and px); y only for curves of two covariates.
struct CurvePoint {
  double x = 0.0;
  double y = 0.0;
  double value = 0.0;
  double sigma = 0.0;
};

/// A user's curve as it was found.
struct FoundCurve {
  Channel channel = Channel::kRange;
  std::vector<std::string> covariates;  ///< One or two.
  std::vector<std::string> units;       ///< Of the covariates.
  std::vector<CurvePoint> points;       ///< Empty if the effect is no curve.
};

/// What was found out about one effect, of the catalogue or the user's own.
struct EffectFinding {
  std::string id;
  int rank = 0;  ///< 1: explains most.
  EffectVerdict verdict = EffectVerdict::kNotTestable;
  std::vector<ParameterEstimate> parameters;
  double shape = 0.0;             ///< Chosen shape number; 0 if the effect has none.
  double shape_sigma = 0.0;       ///< Its standard deviation; 0 if it was not estimated.
  std::string shape_name = {};    ///< With its unit; empty if the effect has none.
  double heldout_gain = 0.0;      ///< Largest relative fall of a channel's held-out squares.
  double log_density_gain = 0.0;  ///< Sum over held-out scenes, nats.
  double p_value = 1.0;           ///< Of the F test, before the correction for the search.
  std::vector<std::string> aliases;
  /// What it does to the extrinsic if left out: at its estimate if present, else at the size that
  /// would matter (or its upper 95 % limit if that is larger).
  double extrinsic_move_mm = 0.0;
  double extrinsic_move_mrad = 0.0;
  bool matters = false;  ///< Left out it moves, or where it is undecided may move, the extrinsic by
                         ///< more than the tolerance.
  /// Whether it was let in, rule by rule; empty if nobody asked: the user's own wish, or no data.
  std::vector<Criterion> criteria;
  double kept = 0.0;  ///< Share of its squared effect that pose and levels cannot absorb.
  std::string explanation;
  std::string spec;  ///< Of a user's own effect: makes it again (EffectInfo::spec).
  FoundCurve curve;
};

/// How an effect came into the model: as it was judged then, with those that could not be told from
/// it.
struct Selection {
  std::string id;
  std::vector<std::string> aliases = {};
  double heldout_gain = 0.0;
  double log_density_gain = 0.0;
  double p_value = 1.0;
  std::vector<Criterion> criteria = {};
  bool wanted = false;  ///< The user's own wish: the search never takes it out.
};

/// How well a channel is predicted. Display units; each row counts by its own standard deviation:
/// rms² = Σ(r/σ)² / Σ(1/σ²), floor² = n / Σ(1/σ²).
struct ChannelSummary {
  Channel channel = Channel::kCorner;
  std::size_t n = 0;
  double rms = 0.0;
  double noise_floor = 0.0;
  double unexplained = 0.0;  ///< √(rms²·n/(n−p) − floor²).
  double heldout_rms = 0.0;
};

/// Structure that a covariate explains in held-out scenes.
struct StructureScore {
  Channel channel = Channel::kCorner;
  std::string covariate;
  double score = 0.0;      ///< Share of held-out variance.
  double amplitude = 0.0;  ///< RMS of the curve, display units.
  /// A closed form that predicts scenes held out as well, as a formula to ask for; empty if none.
  std::string formula = {};
  double formula_score = 0.0;  ///< Share of held-out variance that it explains.
  /// Of surfaces: largest deviation from the median, in standard deviations of one row.
  double height = 0.0;
  /// Gain of every scene held out, in units of log-density (half the fall of whitened squares).
  std::vector<double> scene_gain = {};
  /// What a curve or surface over it would do to the extrinsic, where it was asked for, and whether
  /// that exceeds the tolerance.
  ExtrinsicMove extrinsic_move = {};
  bool matters = false;
  /// Of a surface over two covariates; empty of a curve.
  std::string second_covariate = {};
  /// "board x" or "board x and board y".
  [[nodiscard]] std::string covariates() const {
    return second_covariate.empty() ? covariate : covariate + " and " + second_covariate;
  }
};

/// The model after a step of the search.
struct HistoryStep {
  std::string added;  ///< Empty at the start.
  std::vector<ChannelSummary> channels;
  Rigid3 camera_from_lidar;
};

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

struct Discovery {
  std::vector<ChannelSummary> channels;   ///< Of the base model.
  std::vector<StructureScore> structure;  ///< Of the base model, best first.
  std::vector<EffectFinding> effects;     ///< By rank.
  std::vector<std::string> selected;      ///< In the order added.
  std::vector<StructureScore> unknown;    ///< Left when the catalogue stopped.
  std::vector<HistoryStep> history;
  std::vector<std::string> advice;
  std::vector<std::string> warnings;  ///< Effects asked for that could not be used, and why.
  std::vector<BudgetItem> budget;     ///< Sensitivity budget, largest movement first.
  /// `covariance` plus the moments of the budget: what is not in the model counted as well.
  Matrix6d covariance_with_budget = Matrix6d::Zero();
  /// The final model.
  ModelState state;
  Matrix6d covariance = Matrix6d::Zero();  ///< Left perturbation, camera frame.
  std::vector<EffectInUse> model;
  ModelScales scales;  ///< What the model's numbers refer to.
  /// The linearised model about `state`, scene by scene: what some of the scenes would give.
  std::shared_ptr<const ModelFit> fit;
};

/// What discovery starts from: the scenes in use and the state of the plain calibration.
struct DiscoveryInput {
  std::vector<SceneMeasurements> scenes;
  Target target;
  Camera camera;
  ModelState state;
  double sigma_px = 0.0;
  /// The print and the noise that the joint solve over every return found. Null where that failed.
  std::shared_ptr<const BlurredPrint> print;
  ForwardNoise noise;
};

/// The measurements of a calibration, with every covariate. The input needs its print.
MeasurementTable table_of(const DiscoveryInput& input, const TableOptions& options);

/// Checks the texts of `with` without data, so that a slip of the pen is known before long work.
Status check_wanted(const std::vector<std::string>& with);

/// Searches which effects of the catalogue are missing in the model (linearised mixed model with
/// random effects for structure that nothing explains, candidates compared on held-out scenes,
/// full refit after each addition, drops and swaps). Deterministic.
/// Errors: kUntrusted with fewer than three scenes or without a joint solve over every return;
/// kUsage for an unknown effect in `with` or one of the user's own with an error in its text;
/// kCancelled. Effects in `with` that these data cannot bear (a missing field, values that are not
/// finite, the same as what is in the model) are left out with a warning and the verdict "not
/// testable".
Result<Discovery> discover_effects(const DiscoveryInput& input, const DiscoveryOptions& options,
                                   const RunContext& context);

/// The same on a table of measurements; its scenes must have one board pose each in `state`.
Result<Discovery> discover_effects(const MeasurementTable& table, const ModelState& state,
                                   const DiscoveryOptions& options, const RunContext& context);

}  // namespace lvcalib
