// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <vector>

#include "report/report_figures.h"
#include "report/report_sections.h"

namespace lvcalib {
namespace {

using nlohmann::json;
using Rows = std::vector<std::vector<std::string>>;

std::string text_of(const json& j, const char* key) {
  return html_escaped(j.at(key).get<std::string>());
}

std::string number_at(const json& j, const char* key, int digits = 3) {
  const auto at = j.find(key);
  return at != j.end() && at->is_number() ? shown(at->get<double>(), digits) : "–";
}

std::string effects_in_use(const json& effects) {
  if (effects.empty()) return "<p>The base model, without further effects.</p>\n";
  Rows rows = {{"effect", "parameter", "value", "standard deviation", "unit"}};
  for (const json& effect : effects) {
    bool first = true;
    for (const json& p : effect.at("parameters")) {
      rows.push_back({first ? text_of(effect, "id") : "", text_of(p, "name"), number_at(p, "value"),
                      number_at(p, "sigma", 2), text_of(p, "unit")});
      first = false;
    }
  }
  return html_table(rows);
}

// Of a step of the history; null if the channel is not there.
json entry(const json& step, const char* part, const std::string& channel) {
  const auto all = step.find(part);
  if (all == step.end()) return nullptr;
  const auto at = all->find(channel);
  return at == all->end() ? json(nullptr) : *at;
}

std::string number_text(const json& j, int digits = 3) {
  return j.is_number() ? shown(j.get<double>(), digits) : "–";
}

std::string budget(const json& discovery) {
  const json& history = discovery.at("history");
  if (history.empty()) return "";
  const json& first = history.front();
  const json& last = history.back();
  Rows rows = {{"channel", "residuals", "unit", "noise floor", "RMS before", "after",
                "unexplained before", "after", "held out before", "after"}};
  for (const json& c : discovery.at("channels")) {
    const auto name = c.at("name").get<std::string>();
    const auto cell = [&](const json& step, const char* key) {
      const json e = entry(step, "channels", name);
      return e.is_object() ? number_at(e, key) : std::string("–");
    };
    rows.push_back({html_escaped(name), std::to_string(c.at("n").get<long long>()),
                    text_of(c, "unit"), number_at(c, "noise_floor"), cell(first, "rms"),
                    cell(last, "rms"), cell(first, "unexplained"), cell(last, "unexplained"),
                    number_text(entry(first, "heldout_rms", name)),
                    number_text(entry(last, "heldout_rms", name))});
  }
  std::string out = "<h3>Error before and after</h3>\n" + html_table(rows);
  std::string steps;
  for (const json& step : history) {
    if (step.at("added").is_string())
      steps += (steps.empty() ? "" : ", then ") + text_of(step, "added");
  }
  if (!steps.empty()) out += "<p class=\"note\">Added: " + steps + ".</p>\n";
  return out;
}

std::string verdicts(const json& effects) {
  Rows rows = {{"effect", "verdict", "held-out error falls by", "why"}};
  for (const json& e : effects) {
    const double gain = e.at("heldout_gain").is_number() ? e["heldout_gain"].get<double>() : 0.0;
    rows.push_back({text_of(e, "id"), text_of(e, "verdict"),
                    gain > 0.0 ? shown(100.0 * gain, 2) + " %" : "–",
                    "<span style=\"display:block;text-align:left;max-width:32rem\">" +
                        text_of(e, "explanation") + "</span>"});
  }
  return "<h3>Verdicts</h3>\n" + html_table(rows);
}

// What could be there unseen, and what it would do to the extrinsic.
std::string sensitivity(const json& discovery) {
  const json budget = discovery.value("sensitivity_budget", json::array());
  if (budget.empty()) return "";
  const auto kept = [&](const json& item) -> std::string {
    for (const json& e : discovery.at("effects")) {
      if (e.at("id") != item.at("id")) continue;
      const auto share = e.find("kept_share");
      if (share != e.end() && share->is_number())
        return shown(100.0 * share->get<double>(), 2) + " %";
    }
    return "–";
  };
  Rows rows = {{"effect", "may be as large as", "would move the extrinsic by [mm]",
                "and turn it by [mrad]", "share of it left in the residuals"}};
  for (const json& item : budget) {
    rows.push_back(
        {text_of(item, "id"),
         text_of(item, "parameter") + " = " + number_at(item, "size") + " " + text_of(item, "unit"),
         number_at(item, "translation_mm"), number_at(item, "rotation_mrad"), kept(item)});
  }
  return "<h3>What could be there unseen</h3>\n<p class=\"note\">Effects that are not in the "
         "model, "
         "at the upper 95 % limits of their sizes. Poses take over most of some of them: those "
         "hardly show in the residuals and spoil the extrinsic.</p>\n" +
         html_table(rows);
}

}  // namespace

std::string model_section(const json& result, const json& discovery) {
  std::string out = "<h2>Model</h2>\n" + effects_in_use(result.at("model").at("effects"));
  if (!discovery.is_object())
    return out + "<p class=\"note\">Missing effects were not looked for.</p>\n";
  out += budget(discovery) + verdicts(discovery.at("effects")) + sensitivity(discovery);
  const json advice = discovery.value("advice", json::array());
  std::string items;
  for (const json& line : advice) items += "<li>" + html_escaped(line.get<std::string>()) + "</li>";
  if (!items.empty()) out += "<h3>Scenes worth taking</h3>\n<ul>" + items + "</ul>\n";
  return out;
}

}  // namespace lvcalib
