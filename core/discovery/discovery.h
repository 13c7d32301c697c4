// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/progress.h"
#include "base/rigid3.h"
#include "model/linear_model.h"
#include "model/mixed_model.h"
#include "model/model_scales.h"
#include "model/table_builder.h"

namespace lvcalib {

struct DiscoveryOptions {
  int max_effects = 6;                ///< The search adds no more.
  std::vector<std::string> with;      ///< Effects that are in the model from the start.
  double false_alarm = 0.05;          ///< Over all candidates of a round.
  double min_gain = 0.01;             ///< Least fall of a channel's held-out squares …
  double min_gain_few_scenes = 0.03;  ///< … with three scenes or fewer.
  double min_extrinsic_move = 0.5;    ///< Or so many σ that the extrinsic moves.
  double scenes_improved = 0.75;      ///< Share of scenes that must be predicted better.
  double alias_correlation = 0.95;    ///< Candidates correlated higher cannot be told apart.
  double testable = 3.0;              ///< A material size must stand so many σ above zero.
  double min_structure = 0.02;        ///< Held-out share of variance worth a mention.
  TableOptions table;
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

/// What was found out about one effect of the catalogue.
struct EffectFinding {
  std::string id;
  int rank = 0;  ///< 1: explains most.
  EffectVerdict verdict = EffectVerdict::kNotTestable;
  std::vector<ParameterEstimate> parameters;
  double shape = 0.0;             ///< Chosen shape number; 0 if the effect has none.
  double heldout_gain = 0.0;      ///< Largest relative fall of a channel's held-out squares.
  double log_density_gain = 0.0;  ///< Sum over held-out scenes, nats.
  double p_value = 1.0;           ///< Of the F test, before the correction for the search.
  std::vector<std::string> aliases;
  /// What it does to the extrinsic if left out: at its estimate if present, else at the size that
  /// would matter (or its upper 95 % limit if that is larger).
  double extrinsic_move_mm = 0.0;
  double extrinsic_move_mrad = 0.0;
  double kept = 0.0;  ///< Share of its squared effect that pose and levels cannot absorb.
  std::string explanation;
};

/// How well a channel is predicted. Display units.
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
};

/// The model after a step of the search.
struct HistoryStep {
  std::string added;  ///< Empty at the start.
  std::vector<ChannelSummary> channels;
  Rigid3 camera_from_lidar;
};

struct Discovery {
  std::vector<ChannelSummary> channels;   ///< Of the base model.
  std::vector<StructureScore> structure;  ///< Of the base model, best first.
  std::vector<EffectFinding> effects;     ///< By rank.
  std::vector<std::string> selected;      ///< In the order added.
  std::vector<StructureScore> unknown;    ///< Left when the catalogue stopped.
  std::vector<HistoryStep> history;
  std::vector<std::string> advice;
  /// The final model.
  ModelState state;
  Matrix6d covariance = Matrix6d::Zero();  ///< Left perturbation, camera frame.
  std::vector<EffectInUse> model;
  ModelScales scales;  ///< What the model's numbers refer to.
};

/// What discovery starts from: the scenes in use and the state of the plain calibration.
struct DiscoveryInput {
  std::vector<SceneMeasurements> scenes;
  Target target;
  Camera camera;
  ModelState state;
  double sigma_px = 0.0;
};

/// Searches which effects of the catalogue are missing in the model (linearised mixed model with
/// random effects for structure that nothing explains, candidates compared on held-out scenes,
/// full refit after each addition, drops and swaps). Deterministic.
/// Errors: kUntrusted with fewer than three scenes; kUsage for unknown or untestable `with`;
/// kCancelled.
Result<Discovery> discover_effects(const DiscoveryInput& input, const DiscoveryOptions& options,
                                   const RunContext& context);

}  // namespace lvcalib
