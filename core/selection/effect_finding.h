// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "model/channel.h"

namespace lvcalib {

/// One rule of those that let an effect into the model, and how it came out.
struct Criterion {
  std::string name;  ///< See criteria_of().
  double value = 0.0;
  double threshold = 0.0;
  bool at_most = false;  ///< Holds up to the threshold; else from it on.
  [[nodiscard]] bool holds() const { return at_most ? value <= threshold : value >= threshold; }
};

/// Why a criterion is asked, as a clause.
Message reason_of(const Criterion& criterion);

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
  /// Share of its squared effect that pose and levels cannot absorb.
  std::optional<double> unabsorbed_share;
  Message explanation;
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

}  // namespace lvcalib
