// SPDX-License-Identifier: GPL-3.0-or-later
#include "effect_records.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include <nlohmann/json.hpp>

#include "base/statistics.h"
#include "evidence_rigs.h"
#include "support/effect_rigs.h"

namespace lvcalib::study {
namespace {

using namespace lvcalib::test;
using nlohmann::json;

bool contains(const std::vector<std::string>& all, const std::string& one) {
  return std::find(all.begin(), all.end(), one) != all.end();
}

// The selected effect that stands for a planted one; empty if none does.
std::string stand_in(const json& record, const std::string& id) {
  for (const json& f : record.at("findings")) {
    if (f.at("id") == id) return id;
  }
  for (const json& f : record.at("findings")) {
    if (contains(f.at("aliases"), id)) return f.at("id");
  }
  return {};
}

const json* planted_finding(const json& record, const std::string& id) {
  for (const json& f : record.at("planted_findings")) {
    if (f.at("id") == id) return &f;
  }
  return nullptr;
}

void judge_parameters(const json& record, const std::string& id, bool selected, EffectRecord& out) {
  const json* finding = planted_finding(record, id);
  if (finding == nullptr) return;
  out.verdict[id] = finding->at("verdict");
  const json& truth = record.at("truth").at(id);
  for (const json& p : finding->at("parameters")) {
    const double sigma = p.at("sigma");
    if (!(sigma > 0.0)) continue;
    const auto at = truth.find(p.at("name").get<std::string>());
    if (at == truth.end()) continue;
    out.attainable[id] = std::max(out.attainable[id], std::abs(at->get<double>()) / sigma);
    if (!selected) continue;
    ++out.parameters;
    out.inside += std::abs(p.at("value").get<double>() - at->get<double>()) < 1.96 * sigma;
  }
}

void judge_planted(const json& record, EffectRecord& out) {
  std::vector<std::string> accounted;
  for (const auto& [id, value] : out.planted) {
    if (id.starts_with("x_")) continue;
    const std::string in_place = stand_in(record, id);
    accounted.push_back(in_place);
    judge_parameters(record, id, in_place == id, out);
    out.found[id] = in_place == id ? Found::kRight : Found::kAlias;
    if (!in_place.empty()) continue;
    const bool doubted = out.verdict[id] == "not_testable" || out.verdict[id] == "aliased";
    out.found[id] = doubted ? Found::kDoubted : Found::kMissed;
  }
  for (const std::string& id : out.selected) {
    if (!contains(accounted, id) && !contains(always_simulated(), id)) out.extra.push_back(id);
  }
  for (auto& [id, found] : out.found) {
    const bool elsewhere = !out.extra.empty();
    if (elsewhere && (found == Found::kDoubted || found == Found::kMissed)) found = Found::kWrong;
  }
}

void judge_signature(const json& record, EffectRecord& out) {
  for (const auto& [id, value] : out.planted) {
    const auto signature = signature_of(id);
    if (!signature) continue;
    const auto named = [&](const json& list) {
      return std::any_of(list.begin(), list.end(), [&](const json& s) {
        if (s.at("channel") != name_of(signature->channel)) return false;
        // Of a surface both covariates: "board x and board y".
        const std::string covariates = s.at("covariate");
        const auto at = covariates.find(" and ");
        if (at == std::string::npos) return contains(signature->covariates, covariates);
        return contains(signature->covariates, covariates.substr(0, at)) &&
               contains(signature->covariates, covariates.substr(at + 5));
      });
    };
    out.signature = named(record.at("unknown"));
  }
}

void judge_channel(const json& record, EffectRecord& out) {
  const std::string channel = name_of(main_channel(out.planted.begin()->first));
  if (!record.at("before").contains(channel) || !record.at("after").contains(channel)) return;
  const json& before = record.at("before").at(channel);
  const json& after = record.at("after").at(channel);
  const double unexplained = before.at("unexplained");
  const double floor = before.at("floor");
  out.had_unexplained = unexplained > 0.5 * floor;
  if (unexplained > 0.0) out.removed = 1.0 - after.at("unexplained").get<double>() / unexplained;
  // Edges measured again have a floor of their own.
  out.heldout_over_floor =
      after.at("heldout").get<double>() / std::max(1e-12, after.at("floor").get<double>());
}

std::string median_text(const std::vector<double>& values, const char* format) {
  if (values.empty()) return "–";
  char text[40];
  std::snprintf(text, sizeof text, format, median(values));
  return text;
}

struct Tally {
  int rigs = 0, right = 0, alias = 0, doubted = 0, missed = 0, wrong = 0, extra = 0;
  int inside = 0, parameters = 0, pose_inside = 0, pose_components = 0, not_worse = 0;
  int calm = 0, signature = 0, never_absent = 0;
  int judged = 0, absent_and_off = 0, absent_and_moves = 0, claimed = 0, mended = 0, at_floor = 0;
  std::vector<double> removed, heldout, before_mm, after_mm, before_mrad, after_mrad;

  void add(const EffectRecord& r) {
    ++rigs;
    bool all = true;
    for (const auto& [id, found] : r.found) {
      all = all && (found == Found::kRight || found == Found::kAlias);
    }
    const bool exact = std::all_of(r.found.begin(), r.found.end(),
                                   [](const auto& f) { return f.second == Found::kRight; });
    const auto any = [&](Found which) {
      return std::any_of(r.found.begin(), r.found.end(),
                         [&](const auto& f) { return f.second == which; });
    };
    right += exact && !r.found.empty();
    alias += all && !exact;
    doubted += !all && any(Found::kDoubted);
    missed += !all && !any(Found::kDoubted) && any(Found::kMissed);
    wrong += any(Found::kWrong);
    extra += !r.extra.empty();
    calm += r.selected.empty();
    signature += r.signature;
    never_absent += std::none_of(r.verdict.begin(), r.verdict.end(),
                                 [](const auto& v) { return v.second == "absent"; });
    inside += r.inside;
    parameters += r.parameters;
    pose_inside += r.pose_inside;
    pose_components += 6;
    not_worse += r.after_mm <= r.before_mm + 0.1;
    if (r.had_unexplained) removed.push_back(r.removed);
    mended += r.had_unexplained && r.removed >= 0.9;
    if (r.heldout_over_floor > 0.0) heldout.push_back(r.heldout_over_floor);
    at_floor += r.heldout_over_floor > 0.0 && r.heldout_over_floor <= 1.05;
    judged += static_cast<int>(r.verdict.size());
    for (const auto& [id, moves] : r.absent_but_moves) {
      absent_and_off += r.off;
      absent_and_moves += moves;
    }
    claimed += r.claims_structure;
    before_mm.push_back(r.before_mm);
    after_mm.push_back(r.after_mm);
    before_mrad.push_back(r.before_mrad);
    after_mrad.push_back(r.after_mrad);
  }
};

template <class Chosen>
Tally tally_of(const std::vector<EffectRecord>& records, const Chosen& chosen) {
  Tally out;
  for (const EffectRecord& r : records) {
    if (r.error.empty() && chosen(r)) out.add(r);
  }
  return out;
}

double attainable(const EffectRecord& r) {
  double most = 0.0;
  for (const auto& [id, sigmas] : r.attainable) most = std::max(most, sigmas);
  return most;
}

// Every simulated scan has a footprint, and every model: planted, it is another size of the same.
bool is_footprint(const EffectRecord& r) {
  return std::any_of(r.planted.begin(), r.planted.end(),
                     [](const auto& p) { return contains(always_simulated(), p.first); });
}

void row(const std::string& what, int hits, int count, const char* mark) {
  if (count > 0)
    std::printf("| %s | %s | %s |\n", what.c_str(), share_text(hits, count).c_str(), mark);
}

}  // namespace

// The tolerance of model and verdict.
bool is_off(const json& distance) {
  return distance.at("mm") > 0.5 || distance.at("mrad") > 0.2;
}

EffectRecord read_record(const json& record) {
  EffectRecord out;
  out.set = record.at("set");
  out.seed = record.at("seed");
  out.planted = record.at("planted").get<std::map<std::string, double>>();
  out.error = record.value("error", "");
  if (!out.error.empty()) return out;
  out.selected = record.at("selected").get<std::vector<std::string>>();
  judge_planted(record, out);
  judge_signature(record, out);
  out.claims_structure = !record.at("unknown").empty();
  if (!out.planted.empty()) judge_channel(record, out);
  out.off = is_off(record.at("extrinsic_after"));
  const json moves = record.value("moves_of_absent", json::object());
  for (const auto& [id, verdict] : out.verdict) {
    if (verdict == "absent")
      out.absent_but_moves[id] = moves.contains(id) ? is_off(moves.at(id)) : out.off;
  }
  out.before_mm = record.at("extrinsic_before").at("mm");
  out.after_mm = record.at("extrinsic_after").at("mm");
  out.before_mrad = record.at("extrinsic_before").at("mrad");
  out.after_mrad = record.at("extrinsic_after").at("mrad");
  for (const json& z : record.at("extrinsic_after").at("normalized"))
    out.pose_inside += z.is_number() && std::abs(z.get<double>()) < 1.96;
  return out;
}

void print_set_table(const std::vector<EffectRecord>& records) {
  const auto in = [](const char* set) {
    return [set](const EffectRecord& r) { return r.set == set; };
  };
  const Tally nothing = tally_of(records, in("nothing"));
  const Tally everything = tally_of(records, [](const EffectRecord&) { return true; });
  const Tally strong = tally_of(records, [](const EffectRecord& r) {
    return r.set == "single" && !is_footprint(r) && (r.attainable.empty() || attainable(r) >= 5.0);
  });
  const Tally single = tally_of(records, in("single"));
  const Tally weak = tally_of(records, [](const EffectRecord& r) {
    return (r.set == "single" || r.set == "weak") && attainable(r) >= 2.0 && attainable(r) <= 4.0;
  });
  const Tally quarter = tally_of(records, in("weak"));
  const Tally pair = tally_of(records, in("pair"));
  const Tally others =
      tally_of(records, [](const EffectRecord& r) { return r.set == "pair" && !is_footprint(r); });
  const Tally outside = tally_of(records, in("outside"));
  const Tally absorbed = tally_of(records, in("absorbed"));
  std::printf("| set | share (95 %% interval) | mark |\n| --- | --- | --- |\n");
  row("nothing hidden: an effect selected that is not in every simulated scan", nothing.extra,
      nothing.rigs, "≤ 5 %");
  row("nothing hidden: structure claimed that no effect explains", nothing.claimed, nothing.rigs,
      "≤ 3 %");
  row("planted and called absent while it moves the extrinsic by more than the tolerance",
      everything.absent_and_moves, everything.judged, "0 of ≥ 300");
  row("planted and called absent while the extrinsic is off by more than the tolerance",
      everything.absent_and_off, everything.judged, "–");
  row("one effect, ≥ 5σ, footprints aside: right effect or its alias group",
      strong.right + strong.alias, strong.rigs, "≥ 95 %");
  row("one effect: another selected instead", single.wrong, single.rigs, "≤ 5 %");
  row("one effect: an extra one selected", single.extra, single.rigs, "≤ 5 %");
  row("one effect, 2–4σ: another selected instead", weak.wrong, weak.rigs, "≤ 5 %");
  row("one effect at a quarter of its size: another selected instead", quarter.wrong, quarter.rigs,
      "≤ 5 %");
  row("parameter of the right effect in its 95 % interval", single.inside, single.parameters,
      "92–98 %");
  row("extrinsic with the model in its 95 % interval (components, one effect)", single.pose_inside,
      single.pose_components, "92–98 %");
  row("two effects, footprints aside: both", others.right + others.alias, others.rigs, "≥ 90 %");
  row("two effects, one a footprint: both", pair.right + pair.alias - others.right - others.alias,
      pair.rigs - others.rigs, "–");
  row("two effects: an extra one", pair.extra, pair.rigs, "≤ 5 %");
  row("not in the catalogue: channel and covariate named", outside.signature, outside.rigs,
      "≥ 90 %");
  row("not in the catalogue: an effect of the catalogue selected instead", outside.extra,
      outside.rigs, "≤ 5 %");
  row("absorbed: never called absent", absorbed.never_absent, absorbed.rigs, "100 %");
  const auto count = [](const std::vector<double>& values) {
    return static_cast<int>(values.size());
  };
  row("one effect, its channel unexplained by half its floor or more: 90 % of that removed",
      single.mended, count(single.removed), "–");
  row("one effect: held-out RMS of its channel within 5 % of the floor", single.at_floor,
      count(single.heldout), "–");
  row("one effect: extrinsic not worse (0.1 mm)", single.not_worse, single.rigs, "≥ 95 %");
  std::printf("\n");
}

void print_effect_table(const std::vector<EffectRecord>& records) {
  std::vector<std::string> ids;
  for (const EffectRecord& r : records) {
    if (r.set == "single" && !contains(ids, r.planted.begin()->first))
      ids.push_back(r.planted.begin()->first);
  }
  std::sort(ids.begin(), ids.end());
  std::printf(
      "| planted | rigs | right | alias | cannot tell | missed | other instead | extra | in 95 %% "
      "interval | unexplained removed | held-out / floor | extrinsic before → after |\n"
      "| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |\n");
  for (const std::string& id : ids) {
    const Tally t = tally_of(records, [&](const EffectRecord& r) {
      return r.set == "single" && r.planted.begin()->first == id;
    });
    std::vector<double> removed = t.removed;
    for (double& v : removed) v *= 100.0;
    std::printf("| `%s` | %d | %d | %d | %d | %d | %d | %d | %s | %s | %s | %s → %s mm |\n",
                id.c_str(), t.rigs, t.right, t.alias, t.doubted, t.missed, t.wrong, t.extra,
                t.parameters > 0
                    ? (std::to_string(t.inside) + " of " + std::to_string(t.parameters)).c_str()
                    : "–",
                removed.empty() ? "–" : (median_text(removed, "%.0f") + " %").c_str(),
                median_text(t.heldout, "%.2f").c_str(), median_text(t.before_mm, "%.2f").c_str(),
                median_text(t.after_mm, "%.2f").c_str());
  }
  std::printf("\n");
}

void print_misses(const std::vector<EffectRecord>& records) {
  for (const EffectRecord& r : records) {
    const bool good = std::all_of(r.found.begin(), r.found.end(), [](const auto& f) {
      return f.second == Found::kRight || f.second == Found::kAlias;
    });
    if (r.error.empty() && good && r.extra.empty()) continue;
    std::printf("- %s %llu:", r.set.c_str(), r.seed);
    for (const auto& [id, value] : r.planted) {
      const auto verdict = r.verdict.find(id);
      const auto sigmas = r.attainable.find(id);
      std::printf(" %s=%g (%s, %.1fσ)", id.c_str(), value,
                  verdict == r.verdict.end() ? "–" : verdict->second.c_str(),
                  sigmas == r.attainable.end() ? 0.0 : sigmas->second);
    }
    std::printf("; selected:");
    for (const std::string& id : r.selected) std::printf(" %s", id.c_str());
    std::printf(" %s\n", r.error.c_str());
  }
}

}  // namespace lvcalib::study
