// SPDX-License-Identifier: BSD-3-Clause
#include "discovery/discovery.h"

#include <algorithm>
#include <cmath>

#include "base/yaml_file.h"
#include "discovery/channel_summary.h"
#include "discovery/effect_search.h"
#include "discovery/findings.h"
#include "discovery/structure_scan.h"

namespace lvcalib {
namespace {

class Discoverer {
 public:
  Discoverer(const DiscoveryInput& input, const DiscoveryOptions& options,
             const RunContext& context)
      : input_(input), options_(options), context_(context) {}

  Result<Discovery> run() {
    if (input_.scenes.size() < 3) {
      return Error::untrusted(
          "not enough scenes to look for effects: " + std::to_string(input_.scenes.size()) +
              ", three or more are needed to hold one out",
          {}, "take scenes at other distances and with the board turned differently");
    }
    context_.report("table", 0.0, "collecting measurements");
    const MeasurementTable table = build_table(input_.scenes, input_.target, input_.camera,
                                               input_.state, input_.sigma_px, options_.table);
    context_.report("model", 0.1, "fitting the base model");
    EffectSearch search(table, input_.state, options_, context_);
    if (Status s = add_wanted(table, search); !s) return s.error();
    if (context_.stopped()) return Error::cancelled();
    record("", search);
    out_.channels = out_.history.front().channels;
    context_.report("structure", 0.2, "looking for structure");
    out_.structure = notable(scan_structure(table, search.state(), search.in_use(), context_));
    grow(search);
    if (context_.stopped()) return Error::cancelled();
    context_.report("verdicts", 0.9, "judging effects");
    out_.effects = judge_effects(search, selections_, options_);
    out_.unknown = notable(scan_structure(table, search.state(), search.in_use(), context_));
    out_.advice = advise(out_.effects);
    for (const Selection& s : selections_) out_.selected.push_back(s.id);
    out_.state = search.state();
    out_.scales = scales_of(table);
    out_.covariance = search.reference().fit.covariance.topLeftCorner<6, 6>();
    out_.model = search.in_use();
    if (context_.stopped()) return Error::cancelled();
    context_.report("verdicts", 1.0, "done");
    return std::move(out_);
  }

 private:
  Status add_wanted(const MeasurementTable& table, EffectSearch& search) {
    std::vector<std::string> known;
    for (const EffectPtr& effect : effect_catalogue()) known.push_back(effect->info().id);
    for (const std::string& id : options_.with) {
      const EffectPtr effect = find_effect(id);
      if (effect == nullptr) {
        const std::string near = nearest_word(id, known);
        return Error::usage("there is no effect '" + id + "'" +
                            (near.empty() ? "" : "; did you mean '" + near + "'?"));
      }
      if (const std::string why = why_not_testable(*effect, table); !why.empty())
        return Error::input("the effect '" + id + "' cannot be used: " + why);
      const bool twice = std::any_of(selections_.begin(), selections_.end(),
                                     [&](const Selection& s) { return s.id == id; });
      if (twice) continue;
      // The shape number that the data prefer.
      double shape = effect->shapes(table).front();
      search.rank();
      for (const Candidate& c : search.candidates()) {
        const EffectColumns& columns = search.linear().columns.list()[c.columns];
        if (columns.effect->info().id != id) continue;
        shape = columns.shape;
        break;
      }
      search.add(effect, shape);
      selections_.push_back({id, {}, 0.0, 0.0, 1.0});
    }
    return Done{};
  }

  void record(const std::string& added, const EffectSearch& search) {
    out_.history.push_back(
        {added,
         summarize_channels(search.table(), search.state(), search.in_use(), search.reference()),
         search.state().camera_from_lidar});
  }

  void grow(EffectSearch& search) {
    for (int step = 0;; ++step) {
      context_.report("rank", 0.3 + 0.55 * step / (options_.max_effects + 1.0),
                      "ranking effects, " + std::to_string(selections_.size()) + " in the model");
      search.rank();
      // Steps are counted as well: what is dropped may come back.
      if (context_.stopped() || static_cast<int>(selections_.size()) >= options_.max_effects ||
          step >= 2 * options_.max_effects)
        return;
      const auto best = search.best();
      if (!best) return;
      const Candidate& c = search.candidates()[*best];
      const EffectColumns columns = search.linear().columns.list()[c.columns];
      Selection s{columns.effect->info().id, aliases_of(search, *best, options_),
                  c.best_heldout_gain(), c.total_gain(), c.p_value};
      search.add(columns.effect, columns.shape);
      selections_.push_back(s);
      drop_superfluous(search);
      record(s.id, search);
      if (context_.stopped()) return;
    }
  }

  // What a later effect explains better goes again (never what the user asked for).
  void drop_superfluous(EffectSearch& search) {
    while (!context_.stopped() && selections_.size() > options_.with.size() + 1) {
      const auto k = search.superfluous();
      if (!k || *k < options_.with.size() || *k + 1 == selections_.size()) return;
      search.remove(*k);
      selections_.erase(selections_.begin() + static_cast<std::ptrdiff_t>(*k));
    }
  }

  [[nodiscard]] std::vector<StructureScore> notable(std::vector<StructureScore> scores) const {
    std::erase_if(scores,
                  [&](const StructureScore& s) { return !(s.score >= options_.min_structure); });
    return scores;
  }

  const DiscoveryInput& input_;
  const DiscoveryOptions& options_;
  const RunContext& context_;
  Discovery out_;
  std::vector<Selection> selections_;
};

}  // namespace

Result<Discovery> discover_effects(const DiscoveryInput& input, const DiscoveryOptions& options,
                                   const RunContext& context) {
  return Discoverer(input, options, context).run();
}

}  // namespace lvcalib
