// SPDX-License-Identifier: BSD-3-Clause
#include "selection/advice_text.h"

#include <algorithm>
#include <iterator>
#include <set>

#include "base/text.h"
#include "model/row_covariates.h"

namespace lvcalib {

std::string curve_spec(const StructureScore& s) {
  const auto identifier = [&](const std::string& covariate) {
    const RowCovariate* known = find_covariate(s.channel, covariate);
    return known != nullptr ? known->identifier() : covariate;
  };
  std::string spec = std::string("curve:") + name_of(s.channel) + ":" + identifier(s.covariate);
  if (!s.second_covariate.empty()) spec += "," + identifier(s.second_covariate);
  return spec;
}

Message values_text(const EffectFinding& finding) {
  constexpr std::size_t kShown = 4;  // What a sentence bears; the others are in the table.
  std::vector<Message> parts;
  for (const ParameterEstimate& p : finding.parameters) {
    if (parts.size() == kShown) {
      parts.push_back(Message::verbatim("…"));
      break;
    }
    parts.push_back(parameter_is(
        finding.id, p.name,
        with_sigma(p.value / p.unit_in_si, p.sigma / p.unit_in_si) + behind_number(p.unit)));
  }
  return joined(parts, ", ");
}

Message not_told_apart(const EffectFinding& finding, const EffectInfo& info) {
  return Message(" These scenes cannot tell it from %1; to tell: %2.",
                 one_of(effects_named(finding.aliases)), Message::listed(info.discriminating_pose));
}

std::vector<StructureScore> strongest_of_each_channel(const std::vector<StructureScore>& unknown) {
  std::vector<StructureScore> out;
  std::set<Channel> seen;
  std::copy_if(unknown.begin(), unknown.end(), std::back_inserter(out),
               [&](const StructureScore& s) { return seen.insert(s.channel).second; });
  return out;
}

Message unknown_text(const StructureScore& s) {
  return Message(
      "No effect of the catalogue explains what the %1 channel does over %2 (%3 % of its held-out "
      "variance, %4).",
      word_for(s.channel), covariates_named(s.covariates()), formatted("%.2g", 100.0 * s.score),
      formatted("%.2g", s.amplitude) + behind_number(unit_of(s.channel)));
}

std::vector<Message> advise_unknown(const std::vector<StructureScore>& unknown) {
  std::vector<Message> out;
  for (const StructureScore& s : strongest_of_each_channel(unknown)) {
    out.push_back(Message("%1 To take it out anyway: --with %2", unknown_text(s), curve_spec(s)));
    if (!s.formula.empty()) out.back() += Message(", or as a closed form: --with '%1'", s.formula);
  }
  return out;
}

std::vector<Message> advise(const std::vector<EffectFinding>& findings) {
  std::vector<Message> out;
  constexpr std::size_t kMost = 5;
  // First what is in doubt in the model, then what could spoil the extrinsic most unseen.
  for (const EffectFinding& f : findings) {
    if (f.verdict != EffectVerdict::kAliased || f.aliases.empty() || out.size() >= kMost) continue;
    if (f.parameters.empty()) continue;
    const EffectPtr effect = find_effect(f.id);
    if (effect == nullptr) continue;  // the user's own
    out.push_back(Message("To tell %1 from %2, take: %3", effect_named(f.id),
                          all_of(effects_named(f.aliases)),
                          Message::listed(effect->info().discriminating_pose)));
  }
  std::vector<const EffectFinding*> unseen;
  for (const EffectFinding& f : findings) {
    if (f.verdict == EffectVerdict::kNotTestable && !f.parameters.empty()) unseen.push_back(&f);
  }
  std::stable_sort(unseen.begin(), unseen.end(),
                   [](const EffectFinding* a, const EffectFinding* b) {
                     return a->extrinsic_move_mm > b->extrinsic_move_mm;
                   });
  for (const EffectFinding* f : unseen) {
    if (out.size() >= kMost) break;
    if (f->extrinsic_move_mm < 1.0) continue;
    out.push_back(Message(
        "To see whether %1 is there (it could move the extrinsic by %2 mm and %3 mrad), take: %4",
        effect_named(f->id), formatted("%.1f", f->extrinsic_move_mm),
        formatted("%.2f", f->extrinsic_move_mrad),
        Message::listed(find_effect(f->id)->info().discriminating_pose)));
  }
  return out;
}

}  // namespace lvcalib
