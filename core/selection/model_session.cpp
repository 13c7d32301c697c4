// SPDX-License-Identifier: BSD-3-Clause
#include "selection/model_session.h"

#include <algorithm>
#include <cmath>

#include "base/yaml_file.h"
#include "selection/effect_search.h"
#include "selection/model_growth.h"

namespace lvcalib {
namespace {

std::vector<EffectInUse> switched_on(const std::vector<ModelTerm>& terms) {
  std::vector<EffectInUse> out;
  for (const ModelTerm& term : terms) {
    if (term.on) out.push_back(term.use);
  }
  return out;
}

ModelTerm new_term(const EffectInUse& use, const MeasurementTable& table) {
  ModelTerm term;
  term.spec = use.effect->info().id;
  term.parameters = use.effect->parameters(table);
  const auto n = static_cast<Eigen::Index>(term.parameters.size());
  term.use = {use.effect, use.shape, Eigen::VectorXd::Zero(n)};
  term.sigma = Eigen::VectorXd::Zero(n);
  term.selection.id = term.spec;
  return term;
}

// Takes values, shape numbers and standard deviations over from the fit.
void read_back(const EffectSearch& search, std::vector<ModelTerm>& terms) {
  std::size_t next = 0;
  Eigen::Index at = 6;
  for (ModelTerm& term : terms) {
    if (!term.on) continue;
    const EffectInUse& fitted = search.in_use()[next];
    const Eigen::Index n = fitted.values.size();
    if (!term.use.held) {
      term.use.values = fitted.values;
      term.use.shape = fitted.shape;
      term.sigma = search.joint_covariance().diagonal().segment(at, n).cwiseMax(0.0).cwiseSqrt();
    } else {
      term.sigma.setZero(n);
    }
    at += n;
    ++next;
  }
}

Status enough_scenes(std::size_t scenes) {
  if (scenes >= 3) return Done{};
  return Error::untrusted(
      Message("not enough scenes to look for effects: %1, three or more are needed to hold one out",
              scenes == 1 ? Message("1 scene") : Message("%1 scenes", scenes)),
      {}, Message("take scenes at other distances and with the board turned differently"));
}

// The step at which a search stands whose shape numbers are refined.
Result<ModelStepPtr> step_from(EffectSearch found, ModelStep step, const RunContext& context) {
  if (context.stopped()) return Error::cancelled();
  if (auto stated = found.as_stated()) {
    stated->lay_aside();
    step.stated = std::make_shared<const EffectSearch>(std::move(*stated));
  }
  const EffectSearch& search = step.stated ? *step.stated : found;
  if (context.stopped()) return Error::cancelled();
  step.state = search.state();
  step.remade = search.remade();
  step.covariance = search.joint_covariance().topLeftCorner<6, 6>();
  step.fit = std::make_shared<const ModelFit>(search.reference().fit);
  read_back(search, step.terms);
  const auto model = search.model();
  step.nuisance.assign(model.begin() + static_cast<std::ptrdiff_t>(search.in_use().size()),
                       model.end());
  context.report("structure", 0.7, Message("looking for structure"));
  EveryResidual residuals = every_residual(search.table(), search.state(), model, context);
  if (context.stopped()) return Error::cancelled();
  step.channels = summarize_channels(residuals, model, search.reference().heldout);
  if (step.basis->structure == StructureOf::kEveryStep || step.change == ModelChange::kStart) {
    StructureScan scan = scan_structure(search.table(), std::move(residuals), context);
    step.structure = std::move(scan.curves);
    step.places = std::move(scan.places);
  }
  if (context.stopped()) return Error::cancelled();
  found.lay_aside();
  step.search = std::make_shared<const EffectSearch>(std::move(found));
  return ModelStepPtr(std::make_shared<const ModelStep>(std::move(step)));
}

Result<ModelStepPtr> fitted(ModelStep step, const RunContext& context) {
  context.report("model", 0.1, Message("fitting the model"));
  const auto basis = step.basis;
  EffectSearch search(basis->table, step.state, switched_on(step.terms), basis->options, context);
  search.remake();
  search.refine_shapes();
  return step_from(std::move(search), std::move(step), context);
}

ModelStep changed(const ModelStepPtr& from, ModelChange change, const std::string& spec) {
  ModelStep step;
  step.basis = from->basis;
  step.change = change;
  step.changed = spec;
  step.state = from->state;
  step.terms = from->terms;
  return step;
}

// What the effect that was added last cannot be told from; empty if the data determine it.
Message singular_with(const EffectSearch& search) {
  // Less of an effect than this is left by rounding alone.
  constexpr double kSingular = 1e-6;
  const auto& in_use = search.in_use();
  const Eigen::Index count = in_use.back().values.size();
  const ModelFit& fit = search.reference().fit;
  Eigen::Index first = 6;
  for (std::size_t k = 0; k + 1 < in_use.size(); ++k) first += in_use[k].values.size();
  if (fit.solution.size() < first + count || determined_share(fit, first, count) >= kSingular)
    return {};
  std::vector<Message> others = {Message("the extrinsic and the board poses")};
  for (std::size_t k = 0; k + 1 < in_use.size(); ++k)
    others.push_back(effect_named(in_use[k].effect->info().id));
  return all_of(others);
}

std::vector<Selection> selections_of(const std::vector<ModelTerm>& terms) {
  std::vector<Selection> out;
  for (const ModelTerm& term : terms) {
    if (term.on) out.push_back(term.selection);
  }
  return out;
}

// The terms of the search's model, in its order, then those that are switched off. One that was off
// comes back with the shape found.
std::vector<ModelTerm> terms_of(const EffectSearch& search,
                                const std::vector<Selection>& selections,
                                const std::vector<ModelTerm>& before) {
  std::vector<ModelTerm> out;
  const auto same = [](const ModelTerm& term, const EffectInUse& use) {
    return term.use.effect->info().id == use.effect->info().id;
  };
  for (const EffectInUse& use : search.in_use()) {
    const auto at = std::find_if(before.begin(), before.end(),
                                 [&](const ModelTerm& term) { return term.on && same(term, use); });
    out.push_back(at != before.end() ? *at : new_term(use, search.table()));
    out.back().selection = selections[out.size() - 1];
  }
  for (const ModelTerm& term : before) {
    const bool back = std::any_of(search.in_use().begin(), search.in_use().end(),
                                  [&](const EffectInUse& use) { return same(term, use); });
    if (!term.on && !back) out.push_back(term);
  }
  return out;
}

}  // namespace

std::vector<ParameterEstimate> ModelTerm::estimates() const {
  std::vector<ParameterEstimate> out;
  for (std::size_t k = 0; k < parameters.size(); ++k) {
    const auto at = static_cast<Eigen::Index>(k);
    const EffectParameter& p = parameters[k];
    out.push_back({p.name, p.unit, p.unit_in_si, use.values(at), sigma(at)});
  }
  return out;
}

std::vector<EffectInUse> ModelStep::in_use() const {
  return switched_on(terms);
}

std::vector<EffectInUse> ModelStep::predicted_with() const {
  std::vector<EffectInUse> out = in_use();
  out.insert(out.end(), nuisance.begin(), nuisance.end());
  return out;
}

std::optional<std::size_t> ModelStep::find(const std::string& spec) const {
  const auto at = std::find_if(terms.begin(), terms.end(),
                               [&](const ModelTerm& term) { return term.spec == spec; });
  if (at == terms.end()) return std::nullopt;
  return static_cast<std::size_t>(at - terms.begin());
}

MeasurementTable table_of(const DiscoveryInput& input, const TableOptions& options) {
  return print_table(input, input.state, options, {});
}

Result<EffectPtr> make_effect(const std::string& spec, const MeasurementTable& table,
                              const UserEffectOptions& options) {
  if (is_user_effect(spec)) return make_user_effect(spec, table, options);
  if (EffectPtr effect = find_effect(spec)) return effect;
  std::vector<std::string> known;
  for (const EffectPtr& effect : effect_catalogue()) known.push_back(effect->info().id);
  const std::string near = nearest_word(spec, known);
  return Error::usage(near.empty()
                          ? Message("there is no effect '%1'", spec)
                          : Message("there is no effect '%1'; did you mean '%2'?", spec, near));
}

Result<ModelStepPtr> start_model(MeasurementTable table, const ModelState& state,
                                 const DiscoveryOptions& options, const RunContext& context,
                                 StructureOf structure) {
  if (Status s = enough_scenes(table.scenes.size()); !s) return s.error();
  ModelStep step;
  step.basis = std::make_shared<const ModelBasis>(ModelBasis{std::move(table), options, structure});
  step.state = state;
  return fitted(std::move(step), context);
}

Result<ModelStepPtr> start_model(const DiscoveryInput& input, const DiscoveryOptions& options,
                                 const RunContext& context, StructureOf structure) {
  if (Status s = enough_scenes(input.scenes.size()); !s) return s.error();
  if (!input.print) {
    return Error::untrusted(
        Message("the joint solve over every return failed: nothing to look for effects with"), {},
        Message("see the warnings of the calibration"));
  }
  context.report("table", 0.0, Message("collecting measurements"));
  return start_model(table_of(input, options.table), input.state, options, context, structure);
}

Result<ModelStepPtr> add_effect(const ModelStepPtr& from, const std::string& spec,
                                std::optional<double> shape, const RunContext& context) {
  auto effect = make_effect(spec, from->table(), from->basis->options.user);
  if (!effect) return effect.error();
  const std::string& id = (*effect)->info().id;
  if (const auto there = from->find(id)) {
    if (!from->terms[*there].on) return switch_effect(from, *there, true, context);
    return Error::usage(Message("the effect '%1' is in the model already", id));
  }
  if (const Message why = why_not_testable(**effect, from->table()); !why.empty())
    return Error::input(Message("the effect '%1' cannot be used: %2", spec, why));
  context.report("model", 0.0, Message("fitting the model"));
  EffectSearch search(*from->search);
  search.go_on(context);
  search.add(*effect, shape ? *shape : search.preferred_shape(*effect));
  if (context.stopped()) return Error::cancelled();
  if (const Message others = singular_with(search); !others.empty()) {
    return Error::input(Message(
        "the effect '%1' cannot be used: it acts just as %2 do, which makes the solve singular",
        spec, others));
  }
  // Near its shape first: rows that follow another one would have to be made once more.
  search.refine_shape(search.in_use().size() - 1);
  search.remake();
  search.refine_shapes();
  ModelStep step = changed(from, ModelChange::kAdd, id);
  step.terms.push_back(new_term(search.in_use().back(), from->table()));
  step.terms.back().selection.wanted = true;
  return step_from(std::move(search), std::move(step), context);
}

Result<ModelStepPtr> remove_effect(const ModelStepPtr& from, std::size_t k,
                                   const RunContext& context) {
  ModelStep step = changed(from, ModelChange::kRemove, from->terms.at(k).spec);
  step.terms.erase(step.terms.begin() + static_cast<std::ptrdiff_t>(k));
  return fitted(std::move(step), context);
}

Result<ModelStepPtr> switch_effect(const ModelStepPtr& from, std::size_t k, bool on,
                                   const RunContext& context) {
  ModelStep step =
      changed(from, on ? ModelChange::kSwitchOn : ModelChange::kSwitchOff, from->terms.at(k).spec);
  step.terms[k].on = on;
  return fitted(std::move(step), context);
}

Result<ModelStepPtr> hold_effect(const ModelStepPtr& from, std::size_t k,
                                 const std::optional<Eigen::VectorXd>& values,
                                 const RunContext& context) {
  const ModelTerm& term = from->terms.at(k);
  ModelStep step = changed(from, values ? ModelChange::kHold : ModelChange::kRelease, term.spec);
  step.terms[k].use.held = values.has_value();
  if (values) {
    if (values->size() != term.use.values.size() || !values->allFinite()) {
      return Error::usage(
          Message("the effect '%1' takes %2 finite values", term.spec, term.use.values.size()));
    }
    step.terms[k].use.values = *values;
  }
  return fitted(std::move(step), context);
}

Result<ModelStepPtr> apply_decision(const ModelStepPtr& from, const ModelDecision& decision,
                                    const RunContext& context) {
  if (decision.change == ModelChange::kStart) return from;
  if (decision.change == ModelChange::kAdd)
    return add_effect(from, decision.spec, std::nullopt, context);
  const auto k = from->find(decision.spec);
  if (!k) return Error::usage(Message("the effect '%1' is not in the model", decision.spec));
  switch (decision.change) {
    case ModelChange::kRemove:
      return remove_effect(from, *k, context);
    case ModelChange::kSwitchOff:
    case ModelChange::kSwitchOn:
      return switch_effect(from, *k, decision.change == ModelChange::kSwitchOn, context);
    case ModelChange::kHold:
      return hold_effect(
          from, *k,
          Eigen::VectorXd(Eigen::Map<const Eigen::VectorXd>(
              decision.values.data(), static_cast<Eigen::Index>(decision.values.size()))),
          context);
    default:
      return hold_effect(from, *k, std::nullopt, context);
  }
}

std::vector<ModelDecision> decisions_between(const ModelStep& before, const ModelStep& after) {
  std::vector<ModelDecision> out;
  for (const ModelTerm& term : before.terms) {
    if (!after.find(term.spec)) out.push_back({ModelChange::kRemove, term.spec, {}});
  }
  for (const ModelTerm& term : after.terms) {
    const auto at = before.find(term.spec);
    const bool was_on = at && before.terms[*at].on;
    if (term.on && !was_on) out.push_back({ModelChange::kAdd, term.spec, {}});
  }
  return out;
}

Result<ModelStepPtr> find_all(const ModelStepPtr& from,
                              const std::function<void(const ModelStepPtr&)>& on_step,
                              const RunContext& context) {
  ModelStepPtr step = from;
  EffectSearch search(*from->search);
  search.go_on(context);
  std::vector<Selection> selections = selections_of(from->terms);
  const RunContext silent = context.silent();  // Its steps are parts of one work.
  std::optional<Error> failed;
  grow_model(search, selections, from->basis->options, context, [&] {
    if (failed || context.stopped()) return;
    ModelStep next = changed(step, ModelChange::kAdd, selections.back().id);
    next.terms = terms_of(search, selections, step->terms);
    auto made = step_from(search, std::move(next), silent);
    if (!made) {
      failed = made.error();
      return;
    }
    step = *made;
    if (on_step) on_step(step);
    // As whoever goes on from the step that is kept, to the last digit.
    search.lay_aside();
    search.go_on(context);
  });
  if (context.stopped()) return Error::cancelled();
  if (failed) return *failed;
  // What was ranked at last is ranked.
  search.lay_aside();
  auto last = std::make_shared<ModelStep>(*step);
  last->search = std::make_shared<const EffectSearch>(std::move(search));
  return ModelStepPtr(std::move(last));
}

}  // namespace lvcalib
