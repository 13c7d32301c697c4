// SPDX-License-Identifier: BSD-3-Clause
#include "selection/model_growth.h"

#include <algorithm>
#include <numeric>

#include "selection/findings.h"
#include "solve/fit_inference.h"

namespace lvcalib {
namespace {

// The model as it grows: a selection for each of the search's effects in use, in their order.
struct GrowingModel {
  EffectSearch& search;
  std::vector<Selection>& selections;

  // Effects that nobody asked for.
  [[nodiscard]] int found() const {
    return static_cast<int>(std::count_if(selections.begin(), selections.end(),
                                          [](const Selection& s) { return !s.wanted; }));
  }

  // Takes a trial over that has another effect in place k and does without some.
  void swap(std::size_t k, const std::string& id, const EffectSearch& trial,
            const std::vector<std::string>& dropped) {
    Selection& s = selections[k];
    std::replace(s.aliases.begin(), s.aliases.end(), id, s.id);
    s.id = id;
    search = trial;
    std::erase_if(selections, [&](const Selection& other) {
      return std::find(dropped.begin(), dropped.end(), other.id) != dropped.end();
    });
  }

  void drop(std::size_t k) {
    search.remove(k);
    selections.erase(selections.begin() + static_cast<std::ptrdiff_t>(k));
  }
};

HeldoutScenes heldout_scenes(const EffectSearch& search) {
  return heldout_scenes(search.table(), search.linear(), search.reference());
}

// Adds a candidate, at the shape that it turns out to have. False if it is not to stay: one scene
// with all the leverage can choose a shape that the others know nothing of, and what it gains in
// one channel may be lost in the others.
bool add_candidate(GrowingModel& model, std::size_t candidate, const HeldoutScenes& before,
                   const DiscoveryOptions& options, const RunContext& context) {
  EffectSearch& search = model.search;
  const Candidate& c = search.candidates()[candidate];
  const EffectColumns columns = columns_of(search, c);
  model.selections.push_back(
      {columns.effect->info().id, aliases_of(search, candidate, options), c.best_heldout_gain(),
       c.total_gain(), c.p_value,
       criteria_of(c, search.candidates().size(), search.table().scenes.size(), options), false});
  const Channel channel = c.main_channel();
  search.add(columns.effect, columns.shape);
  search.refine_shape(search.in_use().size() - 1);
  if (context.stopped()) return false;
  const HeldoutScenes after = heldout_scenes(search);
  return total_squares(after, channel) <=
             (1.0 + options.min_gain) * total_squares(before, channel) &&
         !predicts_worse(before, after, options.min_gain);
}

// Effects of the catalogue that are not in the model.
std::vector<EffectPtr> unused(const std::vector<Selection>& selections,
                              const std::vector<std::string>& ids) {
  std::vector<EffectPtr> out;
  for (const std::string& id : ids) {
    const bool used = std::any_of(selections.begin(), selections.end(),
                                  [&](const Selection& other) { return other.id == id; });
    if (EffectPtr effect = find_effect(id); effect != nullptr && !used)
      out.push_back(std::move(effect));
  }
  return out;
}

// What acts exactly alike differs by rounding alone and cannot do better; and what a refit adds
// to a swap of effects that act nearly alike is some nats, a tenth of what is foreseen lost.
bool is_hopeless(const std::vector<double>& gain) {
  constexpr double kSame = 1e-6;
  constexpr double kLost_nats = 30.0;
  std::vector<double> loss;
  double lost = 0.0;
  double largest = 0.0;
  for (const double g : gain) {
    loss.push_back(-g);
    lost -= g;
    largest = std::max(largest, std::abs(g));
  }
  return largest < kSame || (lost > kLost_nats && is_gain(loss));
}

// Held-out log-density of one model over that of another, per scene.
std::vector<double> difference(const EffectSearch& a, const EffectSearch& b) {
  std::vector<double> out;
  for (std::size_t s = 0; s < a.reference().density.size(); ++s)
    out.push_back(a.reference().density[s] - b.reference().density[s]);
  return out;
}

bool is_wanted(const std::vector<Selection>& selections, const std::string& id) {
  return std::any_of(selections.begin(), selections.end(),
                     [&](const Selection& s) { return s.id == id && s.wanted; });
}

// Takes out of a trial what it does not need; never the user's own or effect number k.
std::vector<std::string> dispensable(EffectSearch& trial, std::size_t k,
                                     const std::vector<Selection>& selections,
                                     const RunContext& context) {
  const std::string kept = trial.in_use()[k].effect->info().id;
  std::vector<std::string> out;
  while (!context.stopped()) {
    const auto j = trial.superfluous();
    if (!j) break;
    const std::string& id = trial.in_use()[*j].effect->info().id;
    if (is_wanted(selections, id) || id == kept) break;
    out.push_back(id);
    trial.remove(*j);
  }
  return out;
}

// Puts an alias in an effect's place if it predicts held-out scenes better by more than one
// standard error over scenes, after a full refit; or as well, with fewer effects in the model. At
// most `left` of them are tried.
void try_swaps(GrowingModel& model, int left, const RunContext& context) {
  auto& [search, selections] = model;
  for (std::size_t k = 0; k < selections.size(); ++k) {
    if (selections[k].wanted) continue;
    std::vector<std::string> aliases = selections[k].aliases;
    // What is tried against an effect is tried against the one that took its place.
    for (bool swapped = true; swapped && !aliases.empty();) {
      swapped = false;
      for (const EffectSearch::Swap& next : search.swaps(k, unused(selections, aliases))) {
        const std::string& id = next.effect->info().id;
        std::erase(aliases, id);
        if (is_hopeless(next.gain)) continue;
        if (left-- <= 0 || context.stopped()) return;
        EffectSearch trial(search);
        trial.replace(k, next);
        if (context.stopped()) return;
        if (is_gain(difference(trial, search))) {
          model.swap(k, id, trial, {});
          swapped = true;
          break;
        }
        const auto dropped = dispensable(trial, k, selections, context);
        if (context.stopped()) return;
        if (dropped.empty() || is_gain(difference(search, trial))) continue;
        model.swap(k, id, trial, dropped);
        return;  // Places have moved; what is left is tried after the next addition.
      }
    }
  }
}

// An effect's shape number was chosen while the last one was missing, or among rows that did not
// know of the effect: another of its shapes takes its place if it predicts held-out scenes better
// by more than one standard error over scenes, after a full refit. Refining moves a shape between
// its neighbours alone. Of the first `count` effects; whether any changed.
bool try_shapes(GrowingModel& model, std::size_t count, const RunContext& context) {
  auto& [search, selections] = model;
  bool any = false;
  for (std::size_t k = 0; k < count; ++k) {
    const EffectPtr effect = search.in_use()[k].effect;
    if (selections[k].wanted || effect->shapes(search.table()).size() < 2) continue;
    for (const EffectSearch::Swap& next : search.swaps(k, {effect})) {
      if (std::accumulate(next.gain.begin(), next.gain.end(), 0.0) <= 0.0) continue;
      EffectSearch trial(search);
      trial.replace(k, next);
      trial.refine_shape(k);
      if (context.stopped()) return false;
      if (!is_gain(difference(trial, search))) continue;
      search = trial;
      any = true;
    }
    if (context.stopped()) return false;
  }
  return any;
}

struct Superfluous {
  bool dropped = false;  // Some were, and are out of the model.
  bool newest = false;   // The last addition is, and is in the model still.
};

// What a later effect explains better goes again (never what the user asked for).
Superfluous drop_superfluous(GrowingModel& model, const RunContext& context) {
  Superfluous out;
  while (!context.stopped()) {
    const auto k = model.search.superfluous();
    if (!k || model.selections[*k].wanted) break;
    out.newest = *k + 1 == model.selections.size();
    if (out.newest) break;
    model.drop(*k);
    out.dropped = true;
  }
  return out;
}

// One addition with all that follows from it. False if the model is not to keep it.
bool step_forward(GrowingModel& model, std::size_t candidate, const DiscoveryOptions& options,
                  const RunContext& context) {
  EffectSearch& search = model.search;
  const HeldoutScenes before = heldout_scenes(search);
  if (!add_candidate(model, candidate, before, options, context)) return false;
  try_swaps(model, options.swaps, context);
  drop_superfluous(model, context);
  try_shapes(model, model.selections.size() - 1, context);
  // Rows that an effect had chosen may have held it in the model, the newest too, or at a shape.
  // One round is the rule, two are seen; should two shapes take turns, that ends.
  constexpr int kRounds = 5;
  Superfluous left;
  bool moved = true;
  for (int round = 0; moved && round < kRounds && !context.stopped(); ++round) {
    search.remake();
    search.refine_shapes();
    left = drop_superfluous(model, context);
    moved = try_shapes(model, model.selections.size(), context) || left.dropped;
  }
  if (left.newest) return false;
  // A wrong model chooses and weighs rows that suit it, and these lead it further astray.
  return !context.stopped() && !predicts_worse(before, heldout_scenes(search), options.min_gain);
}

}  // namespace

void grow_model(EffectSearch& search, std::vector<Selection>& selections,
                const DiscoveryOptions& options, const RunContext& context,
                const std::function<void()>& on_added) {
  GrowingModel model{search, selections};
  for (int step = 0;; ++step) {
    context.report("rank", std::min(1.0, model.found() / (options.max_effects + 1.0)),
                   Message("ranking effects, %1 in the model", selections.size()));
    search.rank();
    // Steps are counted as well: what is dropped may come back.
    if (context.stopped() || model.found() >= options.max_effects ||
        step >= 2 * options.max_effects)
      return;
    const auto best = search.best();
    if (!best) return;
    const EffectSearch before(search);
    const std::vector<Selection> selected = selections;
    const std::string id = columns_of(search, search.candidates()[*best]).effect->info().id;
    const bool better = step_forward(model, *best, options, context);
    if (context.stopped()) return;
    if (!better) {
      search = before;
      selections = selected;
      search.refuse(id);
      continue;
    }
    search.forget_refusals();
    on_added();
    if (context.stopped()) return;
  }
}

}  // namespace lvcalib
