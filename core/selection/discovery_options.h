// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "design/board_grid.h"
#include "model/user_effect.h"
#include "solve/fit_inference.h"
#include "solve/print_table.h"
#include "solve/total_uncertainty.h"

namespace lvcalib {

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
  double informative_nats = 0.5;      ///< … of those whose log-density changes by so much.
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
  LeftOutSizes left_out;      ///< What the total uncertainty counts of faults left out.
  bool advise_scenes = true;  ///< Compute the board poses worth taking next.
  BoardGridOptions grid;      ///< Where they are looked for.
};

}  // namespace lvcalib
