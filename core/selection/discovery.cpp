// SPDX-License-Identifier: BSD-3-Clause
#include "selection/discovery.h"

#include <algorithm>

#include "base/yaml_file.h"
#include "model/user_effect.h"
#include "selection/proposals.h"

namespace lvcalib {
namespace {

// The model that the user asked for, step by step. What the data cannot bear is left out, named in
// the warnings, and the rest goes on.
struct WantedModel {
  std::vector<ModelStepPtr> steps;     // The base model first.
  std::vector<EffectFinding> refused;  // The user's own that these data cannot bear.
  std::vector<Message> warnings;
};

Result<WantedModel> add_wanted(const ModelStepPtr& start, const RunContext& context) {
  WantedModel out{{start}, {}, {}};
  for (const std::string& text : start->basis->options.with) {
    const bool own = is_user_effect(text);
    const std::string id = own ? parse_user_effect(text)->id : text;
    if (out.steps.back()->find(id)) {
      out.warnings.push_back(Message("the effect '%1' was asked for twice; it is taken once", id));
      continue;
    }
    auto next = add_effect(out.steps.back(), text, std::nullopt, context);
    if (next) {
      out.steps.push_back(*next);
      continue;
    }
    const Error& error = next.error();
    if (error.kind == ErrorKind::kUsage || error.kind == ErrorKind::kCancelled) return error;
    out.warnings.push_back(Message("%1; it is left out", error.sentence()));
    if (!own) continue;  // The catalogue's verdict says so anyway.
    EffectFinding f;
    f.id = id;
    f.verdict = EffectVerdict::kNotTestable;
    f.explanation = Message("Not testable: %1.", error.sentence());
    out.refused.push_back(std::move(f));
  }
  return out;
}

Result<Discovery> search(const ModelStepPtr& start, const RunContext& context) {
  auto wanted = add_wanted(start, context.part(0.2, 0.3));
  if (!wanted) return wanted.error();
  std::vector<ModelStepPtr>& steps = wanted->steps;
  const auto found = find_all(
      steps.back(), [&](const ModelStepPtr& next) { steps.push_back(next); },
      context.part(0.3, 0.85));
  if (!found) return found.error();
  const auto ranking = rank_effects(**found, context.part(0.85, 1.0));
  if (!ranking) return ranking.error();
  Discovery out = as_discovery(steps, &*ranking);
  out.warnings = std::move(wanted->warnings);
  for (EffectFinding& f : wanted->refused) {
    f.rank = static_cast<int>(out.effects.size()) + 1;
    out.effects.push_back(std::move(f));
  }
  return out;
}

// What needs no measurements to be refused.
Status check_options(const DiscoveryOptions& options) {
  if (Status s = check_wanted(options.with); !s) return s;
  if (Status s = options.user.check(); !s) return s;
  return options.grid.check();
}

}  // namespace

bool Discovery::holds(const std::string& id) const {
  return std::any_of(model.begin(), model.end(),
                     [&](const EffectInUse& use) { return use.effect->info().id == id; });
}

std::string Discovery::lacking() const {
  const auto next = std::find_if(effects.begin(), effects.end(), [&](const EffectFinding& f) {
    return !holds(f.id) && !f.criteria.empty() &&
           std::all_of(f.criteria.begin(), f.criteria.end(),
                       [](const Criterion& c) { return c.holds(); });
  });
  return next == effects.end() ? std::string() : next->id;
}

Status check_wanted(const std::vector<std::string>& with) {
  std::vector<std::string> known;
  for (const EffectPtr& effect : effect_catalogue()) known.push_back(effect->info().id);
  for (const std::string& id : with) {
    if (is_user_effect(id)) {
      const auto spec = parse_user_effect(id);
      if (!spec) return spec.error();
      // What no data can make usable is said before a calibration is made for it.
      if (spec->kind == UserEffectSpec::Kind::kFormula) {
        if (const auto effect = make_user_effect(id); !effect) return effect.error();
      }
      continue;
    }
    if (find_effect(id) != nullptr) continue;
    const std::string near = nearest_word(id, known);
    return Error::usage(
        near.empty() ? Message("there is no effect '%1'", id)
                     : Message("there is no effect '%1'; did you mean '%2'?", id, near),
        {}, Message("your own: formula:CHANNEL:EXPRESSION or curve:CHANNEL:COVARIATE"));
  }
  return Done{};
}

Result<Discovery> discover_effects(const MeasurementTable& table, const ModelState& state,
                                   const DiscoveryOptions& options, const RunContext& context) {
  if (Status s = check_options(options); !s) return s.error();
  const auto start =
      start_model(table, state, options, context.part(0.0, 0.2), StructureOf::kFirstStep);
  if (!start) return start.error();
  return search(*start, context);
}

Result<Discovery> discover_effects(const DiscoveryInput& input, const DiscoveryOptions& options,
                                   const RunContext& context) {
  if (Status s = check_options(options); !s) return s.error();
  const auto start = start_model(input, options, context.part(0.0, 0.2), StructureOf::kFirstStep);
  if (!start) return start.error();
  return search(*start, context);
}

}  // namespace lvcalib
