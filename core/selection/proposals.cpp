// SPDX-License-Identifier: BSD-3-Clause
#include "selection/proposals.h"

#include <algorithm>
#include <map>

#include "base/text.h"
#include "design/scene_advice.h"
#include "diagnostics/closed_form.h"
#include "diagnostics/structure_scan.h"
#include "selection/advice_text.h"
#include "selection/effect_search.h"
#include "selection/findings.h"
#include "selection/sensitivity_budget.h"

namespace lvcalib {
namespace {

Message explain(const EffectInfo& info, Channel best, const EffectProposal& proposal) {
  Message out = Message(
      "%1 Found: %2. With it, scenes held out have %3 % less squared error in the %4 channel and "
      "the extrinsic moves by %5 mm and %6 mrad.",
      Message::listed(info.physics), values_text(proposal.finding),
      formatted("%.0f", 100.0 * proposal.heldout_fall[static_cast<std::size_t>(best)]),
      word_for(best), formatted("%.1f", proposal.gained_mm),
      formatted("%.2f", proposal.gained_mrad));
  if (!proposal.finding.aliases.empty()) out += not_told_apart(proposal.finding, info);
  return out;
}

// What adding the effect of candidate number k would do. `in_force`: the extrinsic that is stated
// without it.
void judge(const EffectSearch& search, std::size_t k, const Rigid3& in_force,
           const DiscoveryOptions& options, EffectProposal& proposal) {
  const Candidate& c = search.candidates()[k];
  proposal.heldout_fall = c.heldout_gain;
  proposal.channel = c.main_channel();
  // From where it is stated, which errors of the sensor may have moved towards the effect
  // already.
  const Rigid3 with =
      se3_exp(Vector6d(c.fit.solution.head<6>())) * search.state().camera_from_lidar;
  proposal.gained_mm = 1e3 * (with.translation - in_force.translation).norm();
  proposal.gained_mrad = 1e3 * rotation_distance_rad(with, in_force);
  proposal.suggested =
      is_accepted(c, search.candidates().size(), search.table().scenes.size(), options);
  if (!proposal.suggested) return;
  EffectFinding& f = proposal.finding;
  f.aliases = aliases_of(search, k, options);
  f.verdict = f.aliases.empty() ? EffectVerdict::kPresent : EffectVerdict::kAliased;
  f.extrinsic_move_mm = proposal.gained_mm;
  f.extrinsic_move_mrad = proposal.gained_mrad;
  f.matters =
      ExtrinsicMove{1e-3 * proposal.gained_mm, 1e-3 * proposal.gained_mrad}.exceeds(c.tolerance);
  f.explanation = explain(columns_of(search, c).effect->info(), c.main_channel(), proposal);
}

// Each suggested effect takes those that it cannot be told from to its side.
std::vector<EffectProposal> grouped_by_alias(const std::vector<EffectProposal>& proposals) {
  std::vector<EffectProposal> out;
  std::vector<bool> taken(proposals.size(), false);
  for (std::size_t k = 0; k < proposals.size(); ++k) {
    if (taken[k]) continue;
    taken[k] = true;
    out.push_back(proposals[k]);
    if (!proposals[k].suggested) continue;
    const auto& aliases = proposals[k].finding.aliases;
    for (std::size_t j = k + 1; j < proposals.size(); ++j) {
      const std::string& id = proposals[j].finding.id;
      if (taken[j] || std::find(aliases.begin(), aliases.end(), id) == aliases.end()) continue;
      taken[j] = true;
      out.push_back(proposals[j]);
      out.back().alias_of = proposals[k].finding.id;
      out.back().finding.verdict = EffectVerdict::kAliased;
    }
  }
  return out;
}

// Of effects that are not in the model: the suggested ones first, each with its aliases.
std::vector<EffectProposal> propose(const EffectSearch& search, const Rigid3& in_force,
                                    const std::vector<EffectFinding>& findings,
                                    const DiscoveryOptions& options) {
  std::map<std::string, std::size_t> first;  // An effect's best candidate.
  for (std::size_t k = 0; k < search.candidates().size(); ++k)
    first.try_emplace(columns_of(search, search.candidates()[k]).effect->info().id, k);
  std::vector<EffectProposal> out;
  for (const EffectFinding& finding : findings) {
    EffectProposal& proposal = out.emplace_back();
    proposal.finding = finding;
    if (const auto at = first.find(finding.id); at != first.end())
      judge(search, at->second, in_force, options, proposal);
  }
  std::stable_partition(out.begin(), out.end(),
                        [](const EffectProposal& p) { return p.suggested; });
  out = grouped_by_alias(out);
  for (std::size_t k = 0; k < out.size(); ++k) out[k].finding.rank = static_cast<int>(k) + 1;
  return out;
}

// What is known of an effect in the model without asking whether it belongs there.
EffectFinding finding_in_model(const ModelTerm& term) {
  EffectFinding f;
  f.id = term.spec;
  f.verdict = EffectVerdict::kPresent;
  f.parameters = term.estimates();
  f.shape = term.use.shape;
  const Message physics = Message::listed(term.use.effect->info().physics);
  const Message values = values_text(f);
  f.explanation = term.use.held ? Message("%1 In the model, held: %2.", physics, values)
                                : Message("%1 In the model: %2.", physics, values);
  return f;
}

}  // namespace

namespace {

bool any_suggested(const std::vector<EffectProposal>& proposals) {
  return std::any_of(proposals.begin(), proposals.end(),
                     [](const EffectProposal& p) { return p.suggested; });
}

}  // namespace

bool ModelRanking::nothing_missing() const {
  return unknown.empty() && !any_suggested(proposals);
}

bool ModelRanking::unknown_matters() const {
  return std::any_of(unknown.begin(), unknown.end(),
                     [](const StructureScore& s) { return s.matters; });
}

bool ModelRanking::speaks_against_good() const {
  return any_suggested(proposals) || unknown_matters();
}

Result<ModelRanking> rank_effects(const ModelStep& step, const RunContext& context) {
  const DiscoveryOptions& options = step.basis->options;
  context.report("rank", 0.1, Message("ranking effects"));
  EffectSearch search(*step.search);
  search.go_on(context);
  search.rank();
  search.forget_print();
  if (context.stopped()) return Error::cancelled();
  context.report("verdicts", 0.7, Message("judging effects"));
  std::vector<Selection> selected;
  for (const ModelTerm& term : step.terms) {
    if (term.on) selected.push_back(term.selection);
  }
  ModelRanking out;
  const std::vector<EffectFinding> findings =
      judge_effects(search, selected, options, step.stated.get());
  // Those in use come first.
  const auto others = findings.begin() + static_cast<std::ptrdiff_t>(selected.size());
  out.in_use.assign(findings.begin(), others);
  out.proposals = propose(search, step.state.camera_from_lidar, {others, findings.end()}, options);
  if (context.stopped()) return Error::cancelled();
  if (!any_suggested(out.proposals)) {
    const EffectSearch explained = search.with_faint();
    if (context.stopped()) return Error::cancelled();
    out.unknown = notable_of(
        scan_structure(explained.table(), explained.state(), explained.model(), context), options);
    judge_unknown(explained, options, out.unknown);
    suggest_closed_forms(explained.table(), explained.state(), explained.model(),
                         options.closed_forms, context, out.unknown);
  }
  if (context.stopped()) return Error::cancelled();
  context.report("advice", 0.85, Message("looking for the next scene"));
  out.advice = options.advise_scenes
                   ? advise_scenes(scenes_taken(search), open_questions(search, findings),
                                   options.grid, context)
                   : advise(findings);
  out.budget = sensitivity_budget(search);
  const auto total =
      total_covariance(step.stated ? *step.stated : search, step.covariance, options.left_out);
  if (!total || context.stopped()) return Error::cancelled();
  out.covariance_total = *total;
  if (const auto best = search.best()) {
    const std::string& id = columns_of(search, search.candidates()[*best]).effect->info().id;
    for (const BudgetItem& item : out.budget) {
      if (item.id == id) out.covariance_total += item.moment;
    }
  }
  context.report("verdicts", 1.0, Message("done"));
  return out;
}

Discovery as_discovery(const std::vector<ModelStepPtr>& steps, const ModelRanking* ranking) {
  Discovery out;
  if (steps.empty()) return out;
  const ModelStep& base = *steps.front();
  const ModelStep& last = *steps.back();
  out.channels = base.channels;
  out.structure = notable_of({base.structure, base.places}, base.basis->options);
  for (const ModelTerm& term : last.terms) {
    if (!term.on) continue;
    if (ranking == nullptr) out.effects.push_back(finding_in_model(term));
    if (!term.selection.wanted) out.selected.push_back(term.spec);
    out.model.push_back(term.use);
  }
  if (ranking != nullptr) {
    out.effects = ranking->in_use;
    for (const EffectProposal& p : ranking->proposals) out.effects.push_back(p.finding);
    out.unknown = ranking->unknown;
    out.advice = ranking->advice;
    const auto about_unknown = advise_unknown(out.unknown);
    out.advice.insert(out.advice.end(), about_unknown.begin(), about_unknown.end());
    out.budget = ranking->budget;
    out.covariance_total = ranking->covariance_total;
  }
  for (std::size_t k = 0; k < out.effects.size(); ++k)
    out.effects[k].rank = static_cast<int>(k) + 1;
  for (const ModelStepPtr& step : steps) {
    const bool added = !step->without_change && (step->change == ModelChange::kAdd ||
                                                 step->change == ModelChange::kSwitchOn);
    out.history.push_back(
        {added ? step->changed : "", step->channels, step->state.camera_from_lidar});
  }
  out.state = last.state;
  out.covariance = last.covariance;
  out.scales = scales_of(last.table());
  out.fit = last.fit;
  out.covariance_with_budget = covariance_with_budget(out.covariance, out.budget);
  return out;
}

}  // namespace lvcalib
