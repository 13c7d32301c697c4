// SPDX-License-Identifier: BSD-3-Clause
#include "discovery/wanted_effects.h"

#include <algorithm>

#include "base/yaml_file.h"
#include "discovery/candidate.h"

namespace lvcalib {
namespace {

// Less of an effect than this is left by rounding alone.
constexpr double kSingular = 1e-6;

class Adder {
 public:
  Adder(EffectSearch& search, const DiscoveryOptions& options)
      : search_(search), options_(options) {}

  Status add(const std::string& text) {
    if (Status s = check_wanted({text}); !s) return s;
    std::string id = text;
    EffectPtr effect = find_effect(text);
    const bool own = effect == nullptr;
    if (own) {
      id = parse_user_effect(text)->id;
      auto made = make_user_effect(text, search_.table(), options_.user);
      if (!made && made.error().kind == ErrorKind::kUsage) return made.error();
      if (!made) {
        refuse(id, made.error().text(), true);
        return Done{};
      }
      effect = *made;
    }
    const auto& added = out_.added;
    if (std::find(added.begin(), added.end(), id) != added.end()) {
      out_.warnings.push_back("the effect '" + id + "' was asked for twice; it is taken once");
      return Done{};
    }
    if (const std::string why = why_not_testable(*effect, search_.table()); !why.empty()) {
      refuse(id, "the effect '" + id + "' cannot be used: " + why, own);
      return Done{};
    }
    take(effect, id, own);
    return Done{};
  }

  WantedEffects result() { return std::move(out_); }

 private:
  void refuse(const std::string& id, const std::string& why, bool own) {
    out_.warnings.push_back(why + "; it is left out");
    if (!own) return;  // the catalogue's verdict says so anyway
    EffectFinding f;
    f.id = id;
    f.verdict = EffectVerdict::kNotTestable;
    f.explanation = "Not testable: " + why + ".";
    out_.refused.push_back(std::move(f));
  }

  void take(const EffectPtr& effect, const std::string& id, bool own) {
    search_.add(effect, search_.preferred_shape(effect));
    const auto& in_use = search_.in_use();
    const Eigen::Index count = in_use.back().values.size();
    const ModelFit& fit = search_.reference().fit;
    Eigen::Index first = 6;
    for (std::size_t k = 0; k + 1 < in_use.size(); ++k) first += in_use[k].values.size();
    if (fit.solution.size() < first + count) return;  // stopped
    if (determined_share(fit, first, count) >= kSingular) {
      out_.added.push_back(id);
      return;
    }
    std::string others = "the extrinsic and the board poses";
    for (std::size_t k = 0; k + 1 < in_use.size(); ++k)
      others += (k + 2 == in_use.size() ? " and " : ", ") + in_use[k].effect->info().id;
    search_.remove(in_use.size() - 1);
    refuse(id,
           "the effect '" + id + "' cannot be used: it acts just as " + others +
               " do, which makes the solve singular",
           own);
  }

  EffectSearch& search_;
  const DiscoveryOptions& options_;
  WantedEffects out_;
};

}  // namespace

Status check_wanted(const std::vector<std::string>& with) {
  std::vector<std::string> known;
  for (const EffectPtr& effect : effect_catalogue()) known.push_back(effect->info().id);
  for (const std::string& id : with) {
    if (is_user_effect(id)) {
      if (auto spec = parse_user_effect(id); !spec) return spec.error();
      continue;
    }
    if (find_effect(id) != nullptr) continue;
    const std::string near = nearest_word(id, known);
    return Error::usage(
        "there is no effect '" + id + "'" + (near.empty() ? "" : "; did you mean '" + near + "'?"),
        {}, "your own: formula:CHANNEL:EXPRESSION or curve:CHANNEL:COVARIATE");
  }
  return Done{};
}

Result<WantedEffects> add_wanted_effects(EffectSearch& search, const DiscoveryOptions& options) {
  Adder adder(search, options);
  for (const std::string& text : options.with) {
    if (Status s = adder.add(text); !s) return s.error();
  }
  return adder.result();
}

}  // namespace lvcalib
