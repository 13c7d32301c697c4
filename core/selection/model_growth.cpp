// SPDX-License-Identifier: BSD-3-Clause
#include "selection/model_growth.h"

#include <algorithm>

#include "selection/findings.h"
#include "solve/fit_inference.h"

namespace lvcalib {
namespace {

class Growth {
 public:
  Growth(EffectSearch& search, std::vector<Selection>& selections, const DiscoveryOptions& options,
         const RunContext& context, const std::function<void()>& on_added)
      : search_(search),
        selections_(selections),
        options_(options),
        context_(context),
        on_added_(on_added) {}

  void run() {
    for (int step = 0;; ++step) {
      context_.report("rank", std::min(1.0, found() / (options_.max_effects + 1.0)),
                      Message("ranking effects, %1 in the model", selections_.size()));
      search_.rank();
      // Steps are counted as well: what is dropped may come back.
      if (context_.stopped() || found() >= options_.max_effects || step >= 2 * options_.max_effects)
        return;
      const auto best = search_.best();
      if (!best) return;
      const Candidate& c = search_.candidates()[*best];
      const EffectColumns columns = search_.linear().columns.list()[c.columns];
      Selection s{
          columns.effect->info().id,
          aliases_of(search_, *best, options_),
          c.best_heldout_gain(),
          c.total_gain(),
          c.p_value,
          criteria_of(c, search_.candidates().size(), search_.table().scenes.size(), options_),
          false};
      const Channel channel = c.main_channel();
      const double before = heldout_squares(channel);
      search_.add(columns.effect, columns.shape);
      search_.refine_shape(search_.in_use().size() - 1);
      if (context_.stopped()) return;
      // One scene with all the leverage can choose a shape that the others know nothing of.
      if (heldout_squares(channel) > (1.0 + options_.min_gain) * before) {
        search_.remove(search_.in_use().size() - 1);
        search_.refuse(s.id);
        continue;
      }
      selections_.push_back(s);
      try_swaps();
      drop_superfluous();
      search_.remake();
      search_.refine_shapes();
      on_added_();
      if (context_.stopped()) return;
    }
  }

 private:
  [[nodiscard]] double heldout_squares(Channel channel) const {
    double sum = 0.0;
    for (const auto& scene : search_.reference().heldout)
      sum += scene[static_cast<std::size_t>(channel)];
    return sum;
  }

  [[nodiscard]] int found() const {
    return static_cast<int>(std::count_if(selections_.begin(), selections_.end(),
                                          [](const Selection& s) { return !s.wanted; }));
  }

  [[nodiscard]] bool is_wanted(const std::string& id) const {
    return std::any_of(selections_.begin(), selections_.end(),
                       [&](const Selection& s) { return s.id == id && s.wanted; });
  }

  // Puts an alias in an effect's place if it predicts held-out scenes better by more than one
  // standard error over scenes, after a full refit; or as well, with fewer effects in the model.
  void try_swaps() {
    int left = options_.swaps;
    for (std::size_t k = 0; k < selections_.size(); ++k) {
      if (selections_[k].wanted) continue;
      std::vector<std::string> aliases = selections_[k].aliases;
      // What is tried against an effect is tried against the one that took its place.
      for (bool swapped = true; swapped && !aliases.empty();) {
        swapped = false;
        for (const EffectSearch::Swap& next : search_.swaps(k, unused(aliases))) {
          std::erase(aliases, next.effect->info().id);
          if (is_hopeless(next.gain)) continue;
          if (left-- <= 0 || context_.stopped()) return;
          EffectSearch trial(search_);
          trial.replace(k, next.effect, next.shape);
          if (context_.stopped()) return;
          if (is_gain(difference(trial, search_))) {
            swap(k, next.effect, next.shape);
            swapped = true;
            break;
          }
          const auto dropped = dispensable(trial, k);
          if (context_.stopped()) return;
          if (dropped.empty() || is_gain(difference(search_, trial))) continue;
          swap(k, next.effect, next.shape);
          for (const std::string& gone : dropped) drop(gone);
          return;  // Places have moved; what is left is tried after the next addition.
        }
      }
    }
  }

  // Effects of the catalogue that are not in the model.
  [[nodiscard]] std::vector<EffectPtr> unused(const std::vector<std::string>& ids) const {
    std::vector<EffectPtr> out;
    for (const std::string& id : ids) {
      const bool used = std::any_of(selections_.begin(), selections_.end(),
                                    [&](const Selection& other) { return other.id == id; });
      if (EffectPtr effect = find_effect(id); effect != nullptr && !used)
        out.push_back(std::move(effect));
    }
    return out;
  }

  // What acts exactly alike differs by rounding alone and cannot do better; and what a refit adds
  // to a swap of effects that act nearly alike is some nats, a tenth of what is foreseen lost.
  static bool is_hopeless(const std::vector<double>& gain) {
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
  static std::vector<double> difference(const EffectSearch& a, const EffectSearch& b) {
    std::vector<double> out;
    for (std::size_t s = 0; s < a.reference().density.size(); ++s)
      out.push_back(a.reference().density[s] - b.reference().density[s]);
    return out;
  }

  // Takes out of a trial what it does not need; never the user's own or effect number k.
  [[nodiscard]] std::vector<std::string> dispensable(EffectSearch& trial, std::size_t k) const {
    const std::string kept = trial.in_use()[k].effect->info().id;
    std::vector<std::string> out;
    while (!context_.stopped()) {
      const auto j = trial.superfluous();
      if (!j) break;
      const std::string& id = trial.in_use()[*j].effect->info().id;
      if (is_wanted(id) || id == kept) break;
      out.push_back(id);
      trial.remove(*j);
    }
    return out;
  }

  void swap(std::size_t k, const EffectPtr& effect, double shape) {
    const std::string id = effect->info().id;
    search_.replace(k, effect, shape);
    std::replace(selections_[k].aliases.begin(), selections_[k].aliases.end(), id,
                 selections_[k].id);
    selections_[k].id = id;
  }

  void drop(const std::string& id) {
    const auto at = std::find_if(selections_.begin(), selections_.end(),
                                 [&](const Selection& s) { return s.id == id; });
    search_.remove(static_cast<std::size_t>(at - selections_.begin()));
    selections_.erase(at);
  }

  // What a later effect explains better goes again (never what the user asked for).
  void drop_superfluous() {
    while (!context_.stopped() && found() > 1) {
      const auto k = search_.superfluous();
      if (!k || selections_[*k].wanted || *k + 1 == selections_.size()) return;
      search_.remove(*k);
      selections_.erase(selections_.begin() + static_cast<std::ptrdiff_t>(*k));
    }
  }

  EffectSearch& search_;
  std::vector<Selection>& selections_;
  const DiscoveryOptions& options_;
  const RunContext& context_;
  const std::function<void()>& on_added_;
};

}  // namespace

void grow_model(EffectSearch& search, std::vector<Selection>& selections,
                const DiscoveryOptions& options, const RunContext& context,
                const std::function<void()>& on_added) {
  Growth(search, selections, options, context, on_added).run();
}

}  // namespace lvcalib
