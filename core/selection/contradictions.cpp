// SPDX-License-Identifier: BSD-3-Clause
// What speaks against candidates of a search although scenes held out are predicted better.
#include <algorithm>
#include <array>
#include <iterator>
#include <optional>

#include "diagnostics/structure_scan.h"
#include "selection/advice_text.h"
#include "selection/effect_search.h"
#include "selection/findings.h"
#include "selection/print_contrast.h"

namespace lvcalib {

void EffectSearch::ask_both_prints() {
  if (!table().has_intensity) return;  // Nobody knows which print a return is on.
  constexpr auto kRangeChannel = static_cast<std::size_t>(Channel::kRange);
  const std::vector<EffectInUse> effects = model();
  const EffectColumnsList own = own_columns();
  const ColumnSubset subset = own_subset(own);
  const auto disagree = [&](const Candidate& c) {
    return prints_disagree({table(), state_, effects, own, subset, variances_},
                           linear_.columns.list()[c.columns], c.must_show.value_or(Channel::kRange),
                           *options_, context_);
  };
  doubt_levels(disagree);
  while (!context_.stopped()) {
    const auto chosen = best();
    if (!chosen || !(candidates_[*chosen].acting_share[kRangeChannel] > 0.0)) return;
    if (!disagree(candidates_[*chosen])) return;
    contradict(candidates_[*chosen], Contradiction::kPrints);
  }
}

// Edges are found in intensities. Where the two prints tell different stories about what these do,
// as where a receiver saturates, edges are not to be trusted either.
void EffectSearch::doubt_levels(const std::function<bool(const Candidate&)>& disagree) {
  bool doubted = false;
  for (const Candidate& c : candidates_) {
    if (context_.stopped()) return;
    const bool asked = c.must_show && c.contradiction == Contradiction::kNone &&
                       is_accepted(c, candidates_.size(), table().scenes.size(), *options_);
    if (!asked || !disagree(c)) continue;
    contradict(c, Contradiction::kPrints);
    doubted = true;
  }
  if (!doubted) return;
  for (Candidate& c : candidates_) {
    if (c.acts_on_edges_alone()) c.contradiction = Contradiction::kLevels;
  }
}

void EffectSearch::contradict(const Candidate& candidate, Contradiction by) {
  const auto id_of = [&](const Candidate& c) {
    return linear_.columns.list()[c.columns].effect->info().id;
  };
  const std::string id = id_of(candidate);
  for (Candidate& c : candidates_) {
    if (id_of(c) == id) c.contradiction = by;
  }
}

// What shows over a covariate that no effect of the catalogue follows is explained in part by
// effects that happen to vary with it on these boards. Such a one has nothing left to say beside
// the curve. What is local (a bump on the board, dirt on the window) is explained in part by
// effects that act everywhere: these leave most of it where it is.
void EffectSearch::ask_structure() {
  // A channel's residuals are the same whichever candidate is asked.
  std::array<std::optional<std::vector<StructureScore>>, kChannels> found;
  const auto scores_of = [&](Channel channel) -> const std::vector<StructureScore>& {
    const auto k = static_cast<std::size_t>(channel);
    if (!found[k]) {
      EveryResidual residuals;
      residuals[k] = residuals_and_nuisance(table(), state_, model(), channel, context_);
      found[k] = notable_of(scan_structure(table(), std::move(residuals), context_), *options_);
    }
    return *found[k];
  };
  while (!context_.stopped()) {
    const auto chosen = best();
    if (!chosen) return;
    const Candidate& candidate = candidates_[*chosen];
    const Channel main = candidate.main_channel();
    const std::vector<StructureScore>& scores = scores_of(main);
    if (!scores.empty() && stands_in(candidate, main, scores.front())) {
      contradict(candidate, Contradiction::kCurve);
      continue;
    }
    std::vector<StructureScore> places;
    for (const Channel channel : kAllChannels) {
      if (!(candidate.acting_share[static_cast<std::size_t>(channel)] > 0.0)) continue;
      std::ranges::copy_if(scores_of(channel), std::back_inserter(places),
                           &StructureScore::is_at_a_place);
    }
    if (context_.stopped() || !leaves_a_place(candidate, places)) return;
    contradict(candidate, Contradiction::kPlace);
  }
}

bool EffectSearch::stands_in(const Candidate& candidate, Channel channel,
                             const StructureScore& curve) const {
  // A curve that holds the effect predicts what the effect predicts, noise aside; one that predicts
  // twice as much holds something else.
  constexpr double kMore = 2.0;
  if (curve.score < kMore * candidate.heldout_gain[static_cast<std::size_t>(channel)]) return false;
  const auto effect = make_user_effect(curve_spec(curve), table(), options_->user);
  if (!effect) return false;
  EffectColumnsList columns = own_columns();
  ColumnSubset subset = own_subset(columns);
  const EffectColumns& tried = linear_.columns.list()[candidate.columns];
  const double shape = preferred_shape(*effect);
  if (context_.stopped()) return false;
  columns.add(*effect, shape, table());
  columns.add(tried.effect, tried.shape, table());
  append_columns(columns.list()[own_count()], nullptr, subset);
  append_columns(columns.list()[own_count() + 1], nullptr, subset);
  const Linearization linear = linearized(model(), columns);
  if (context_.stopped()) return false;
  const ModelFit fit = fit_model(linear, subset, variances_, how(3));
  return f_test(fit, tried.count()) * static_cast<double>(candidates_.size()) >
         options_->false_alarm;
}

bool EffectSearch::leaves_a_place(const Candidate& candidate,
                                  std::vector<StructureScore> places) const {
  // Its cause leaves nothing but noise of it, a stranger nearly all: halfway between.
  constexpr double kMost = 0.5;
  std::erase_if(places, [&](const StructureScore& place) {
    return place.local_score() < candidate.heldout_gain[static_cast<std::size_t>(place.channel)];
  });
  if (places.empty()) return false;
  const EffectColumns& tried = linear_.columns.list()[candidate.columns];
  EffectSearch trial(*this);
  trial.add(tried.effect, tried.shape);
  return std::ranges::any_of(places, [&](const StructureScore& place) {
    if (context_.stopped()) return false;
    ChannelResiduals left = residuals_and_nuisance(trial.table(), trial.state(), trial.model(),
                                                   place.channel, context_);
    return place_score(place, trial.table(), std::move(left)).local_score() >
           kMost * place.local_score();
  });
}

}  // namespace lvcalib
