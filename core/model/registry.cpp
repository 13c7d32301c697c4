// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "model/effect.h"
#include "model/effects/catalogue.h"

namespace lvcalib {

#define LVCALIB_DECLARE(name) EffectPtr make_##name();
LVCALIB_EFFECTS(LVCALIB_DECLARE)
#undef LVCALIB_DECLARE

const std::vector<EffectPtr>& effect_catalogue() {
#define LVCALIB_MAKE(name) make_##name(),
  static const std::vector<EffectPtr> catalogue{LVCALIB_EFFECTS(LVCALIB_MAKE)};
#undef LVCALIB_MAKE
  return catalogue;
}

EffectPtr find_effect(const std::string& id) {
  const auto& all = effect_catalogue();
  const auto at = std::find_if(all.begin(), all.end(),
                               [&](const EffectPtr& effect) { return effect->info().id == id; });
  return at == all.end() ? nullptr : *at;
}

Message effect_named(const std::string& id) {
  return find_effect(id) != nullptr ? Message::listed(id) : Message::verbatim(id);
}

std::vector<Message> effects_named(const std::vector<std::string>& ids) {
  std::vector<Message> out(ids.size());
  std::transform(ids.begin(), ids.end(), out.begin(), effect_named);
  return out;
}

Message parameter_is(const std::string& id, const std::string& name, const std::string& value) {
  return (find_effect(id) != nullptr ? Message::listed(name) : Message::verbatim(name)) +
         Message::verbatim(" = " + value);
}

Message why_not_testable(const Effect& effect, const MeasurementTable& table) {
  const EffectNeeds& needs = effect.info().needs;
  if (needs.time && !table.has_time) return Message("the time is not in every cloud");
  if (needs.line && table.lines.size() < 2)
    return Message("the laser line is not in every cloud, or there is one only");
  if (needs.intensity && !table.has_intensity)
    return Message("the intensity is not in every cloud, or the same on all points");
  if (needs.circles && table.boundary.empty())
    return Message("no edges of the print in the returns");
  if (needs.tags && !table.target.has_tags()) return Message("no tags on this board");
  if (effect.is_in_base_model()) return Message("measured with the base model, as the beam's blur");
  if (effect.is_gauge())
    return Message(
        "not defined: the same as a turn of the LiDAR frame, which is part of the extrinsic");
  return {};
}

}  // namespace lvcalib
