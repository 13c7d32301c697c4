// SPDX-License-Identifier: BSD-3-Clause
#include "discovery/discovery.h"

#include <algorithm>
#include <cmath>

#include "discovery/advice_text.h"
#include "discovery/channel_summary.h"
#include "discovery/closed_form.h"
#include "discovery/effect_search.h"
#include "discovery/findings.h"
#include "discovery/model_growth.h"
#include "discovery/scene_advice.h"
#include "discovery/sensitivity_budget.h"
#include "discovery/structure_scan.h"
#include "discovery/wanted_effects.h"
#include "solve/print_table.h"

namespace lvcalib {
namespace {

// What needs no measurements to be refused.
Status check_usable(std::size_t scenes, const DiscoveryOptions& options) {
  if (Status s = check_wanted(options.with); !s) return s;
  if (Status s = options.user.check(); !s) return s;
  if (Status s = options.grid.check(); !s) return s;
  if (scenes >= 3) return Done{};
  return Error::untrusted(
      "not enough scenes to look for effects: " + std::to_string(scenes) +
          (scenes == 1 ? " scene" : " scenes") + ", three or more are needed to hold one out",
      {}, "take scenes at other distances and with the board turned differently");
}

class Discoverer {
 public:
  Discoverer(const MeasurementTable& table, const ModelState& state,
             const DiscoveryOptions& options, const RunContext& context)
      : table_(table), state_(state), options_(options), context_(context) {}

  Result<Discovery> run() {
    context_.report("model", 0.1, "fitting the base model");
    EffectSearch search(table_, state_, options_, context_);
    if (Status s = add_wanted(search); !s) return s.error();
    search.remeasure();
    if (context_.stopped()) return Error::cancelled();
    record("", search);
    out_.channels = out_.history.front().channels;
    context_.report("structure", 0.2, "looking for structure");
    out_.structure =
        notable_structure(search.table(), search.state(), search.model(), options_, context_);
    grow_model(search, selections_, fixed_, options_, context_,
               [&] { record(selections_.back().id, search); });
    if (context_.stopped()) return Error::cancelled();
    settle_shapes(search);
    context_.report("verdicts", 0.9, "judging effects");
    out_.effects = judge_effects(search, selections_, options_);
    for (EffectFinding& f : refused_) {
      f.rank = static_cast<int>(out_.effects.size()) + 1;
      out_.effects.push_back(std::move(f));
    }
    const EffectSearch explained = search.with_immaterial();
    if (context_.stopped()) return Error::cancelled();
    out_.unknown = notable_structure(explained.table(), explained.state(), explained.model(),
                                     options_, context_);
    judge_unknown(explained, options_, out_.unknown);
    suggest_closed_forms(explained.table(), explained.state(), explained.model(),
                         options_.closed_forms, context_, out_.unknown);
    context_.report("advice", 0.95, "looking for the next scene");
    out_.advice = options_.advise_scenes ? advise_scenes(search, out_.effects, options_, context_)
                                         : advise(out_.effects);
    const auto about_unknown = advise_unknown(out_.unknown);
    out_.advice.insert(out_.advice.end(), about_unknown.begin(), about_unknown.end());
    for (const Selection& s : selections_) out_.selected.push_back(s.id);
    out_.state = search.state();
    out_.scales = scales_of(search.table());
    out_.covariance = search.joint_covariance().topLeftCorner<6, 6>();
    out_.budget = sensitivity_budget(search);
    out_.covariance_with_budget = covariance_with_budget(out_.covariance, out_.budget);
    out_.model = search.in_use();
    out_.fit = std::make_shared<const ModelFit>(search.reference().fit);
    if (context_.stopped()) return Error::cancelled();
    context_.report("verdicts", 1.0, "done");
    return std::move(out_);
  }

 private:
  Status add_wanted(EffectSearch& search) {
    auto wanted = add_wanted_effects(search, options_);
    if (!wanted) return wanted.error();
    for (const std::string& id : wanted->added) selections_.push_back({id, {}, 0.0, 0.0, 1.0});
    fixed_ = selections_.size();
    refused_ = std::move(wanted->refused);
    out_.warnings = std::move(wanted->warnings);
    return Done{};
  }

  void record(const std::string& added, const EffectSearch& search) {
    out_.history.push_back(
        {added,
         summarize_channels(search.table(), search.state(), search.model(), search.reference()),
         search.state().camera_from_lidar});
  }

  // The verdicts come from candidates about the model with its final shape numbers.
  void settle_shapes(EffectSearch& search) {
    const bool shaped =
        std::any_of(search.in_use().begin(), search.in_use().end(),
                    [](const EffectInUse& use) { return use.effect->has_smooth_shape(); });
    if (!shaped) return;
    context_.report("shapes", 0.85, "refining shape numbers");
    search.refine_shapes();
    search.rank();
  }

  const MeasurementTable& table_;
  const ModelState& state_;
  const DiscoveryOptions& options_;
  const RunContext& context_;
  Discovery out_;
  std::vector<Selection> selections_;
  std::size_t fixed_ = 0;  // of the selections: what the user asked for
  std::vector<EffectFinding> refused_;
};

}  // namespace

MeasurementTable table_of(const DiscoveryInput& input, const TableOptions& options) {
  if (input.print) {
    return print_table(input.scenes, input.print, input.camera, input.state, input.noise,
                       input.sigma_px, options, {});
  }
  TableOptions how = options;
  how.refinement = input.refinement;
  return build_table(input.scenes, input.target, input.camera, input.state, input.sigma_px, how);
}

Result<Discovery> discover_effects(const MeasurementTable& table, const ModelState& state,
                                   const DiscoveryOptions& options, const RunContext& context) {
  if (Status s = check_usable(table.scenes.size(), options); !s) return s.error();
  return Discoverer(table, state, options, context).run();
}

Result<Discovery> discover_effects(const DiscoveryInput& input, const DiscoveryOptions& options,
                                   const RunContext& context) {
  if (Status s = check_usable(input.scenes.size(), options); !s) return s.error();
  context.report("table", 0.0, "collecting measurements");
  const MeasurementTable table = table_of(input, options.table);
  if (context.stopped()) return Error::cancelled();
  return Discoverer(table, input.state, options, context).run();
}

}  // namespace lvcalib
