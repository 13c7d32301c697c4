// SPDX-License-Identifier: BSD-3-Clause
#include "selection/advice_text.h"

#include <algorithm>
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

std::vector<std::string> advise_unknown(const std::vector<StructureScore>& unknown) {
  std::vector<std::string> out;
  std::set<Channel> said;
  for (const StructureScore& s : unknown) {
    // The strongest covariate of a channel: others mostly see the same.
    if (!said.insert(s.channel).second) continue;
    std::string text =
        std::string("No effect of the catalogue explains what the ") + name_of(s.channel) +
        " channel does over " + s.covariates() +
        formatted(" (%.2g %% of its held-out variance, %.2g ", 100.0 * s.score, s.amplitude) +
        unit_of(s.channel) + "); to take it out anyway: --with " + curve_spec(s);
    if (!s.formula.empty()) text += ", or as a closed form: --with '" + s.formula + "'";
    out.push_back(text);
  }
  return out;
}

std::vector<std::string> advise(const std::vector<EffectFinding>& findings) {
  std::vector<std::string> out;
  constexpr std::size_t kMost = 5;
  // First what is in doubt in the model, then what could spoil the extrinsic most unseen.
  for (const EffectFinding& f : findings) {
    if (f.verdict != EffectVerdict::kAliased || f.aliases.empty() || out.size() >= kMost) continue;
    if (f.parameters.empty()) continue;
    const EffectPtr effect = find_effect(f.id);
    if (effect == nullptr) continue;  // the user's own
    const std::string text = "To tell " + f.id + " from " + joined(f.aliases, " and ") +
                             ", take: " + effect->info().discriminating_pose;
    out.push_back(text);
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
    out.push_back("To see whether " + f->id + " is there (it could move the extrinsic by " +
                  formatted("%.1f mm and %.2f mrad", f->extrinsic_move_mm, f->extrinsic_move_mrad) +
                  "), take: " + find_effect(f->id)->info().discriminating_pose);
  }
  return out;
}

}  // namespace lvcalib
