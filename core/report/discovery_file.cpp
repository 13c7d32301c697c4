// SPDX-License-Identifier: BSD-3-Clause
#include "report/discovery_file.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include <nlohmann/json.hpp>

#include "base/file_io.h"
#include "base/text.h"
#include "model/row_covariates.h"
#include "report/evidence_json.h"
#include "report/json_values.h"
#include "report/result_file.h"

namespace lvcalib {
namespace {

using nlohmann::ordered_json;

ordered_json channel_json(const ChannelSummary& c) {
  return {{"name", name_of(c.channel)},
          {"unit", unit_of(c.channel)},
          {"n", c.n},
          {"rms", c.rms},
          {"noise_floor", c.noise_floor},
          {"unexplained", c.unexplained},
          {"heldout_rms", c.heldout_rms}};
}

ordered_json curve_json(const FoundCurve& curve) {
  const double factor = display_factor(curve.channel);
  ordered_json points = ordered_json::array();
  for (const CurvePoint& p : curve.points) {
    ordered_json point = {{"x", p.x}};
    if (curve.covariates.size() > 1) point["y"] = p.y;
    point["value"] = factor * p.value;
    point["sigma"] = factor * p.sigma;
    points.push_back(std::move(point));
  }
  return {{"covariates", curve.covariates},
          {"covariate_units", curve.units},
          {"unit", unit_of(curve.channel)},
          {"points", std::move(points)}};
}

ordered_json criteria_json(const std::vector<Criterion>& criteria) {
  // What is divided by next to nothing has no use for its digits.
  constexpr double kMost = 1e9;
  ordered_json out = ordered_json::array();
  for (const Criterion& c : criteria) {
    out.push_back({{"name", c.name},
                   {"value", std::clamp(c.value, -kMost, kMost)},
                   {"threshold", c.threshold},
                   {"at_most", c.at_most},
                   {"holds", c.holds()},
                   {"reason", reason_of(c)}});
  }
  return out;
}

ordered_json effect_json(const EffectFinding& f) {
  ordered_json parameters = ordered_json::array();
  for (const ParameterEstimate& p : f.parameters) {
    parameters.push_back({{"name", p.name},
                          {"value", p.value / p.unit_in_si},
                          {"sigma", p.sigma / p.unit_in_si},
                          {"unit", p.unit}});
  }
  ordered_json j = {{"id", f.id},
                    {"rank", f.rank},
                    {"verdict", name_of(f.verdict)},
                    {"parameters", std::move(parameters)},
                    {"heldout_gain", f.heldout_gain},
                    {"log_density_gain", f.log_density_gain},
                    {"p_value", f.p_value},
                    {"aliases", f.aliases},
                    {"extrinsic_move_mm", f.extrinsic_move_mm},
                    {"extrinsic_move_mrad", f.extrinsic_move_mrad},
                    {"matters", f.matters},
                    {"criteria", criteria_json(f.criteria)},
                    {"kept_share", f.unabsorbed_share ? ordered_json(*f.unabsorbed_share)
                                                      : ordered_json(nullptr)},
                    {"explanation", f.explanation}};
  if (f.shape != 0.0) j["shape"] = f.shape;
  if (f.shape_sigma > 0.0) j["shape_sigma"] = f.shape_sigma;
  if (!f.shape_name.empty()) j["shape_name"] = f.shape_name;
  if (!f.spec.empty()) j["spec"] = f.spec;
  if (!f.curve.points.empty()) j["curve"] = curve_json(f.curve);
  return j;
}

ordered_json unknown_json(const StructureScore& s) {
  ordered_json j = {{"channel", name_of(s.channel)},
                    {"covariates", s.covariates()},
                    {"score", s.score},
                    {"amplitude", s.amplitude},
                    {"extrinsic_move_mm", 1e3 * s.extrinsic_move.translation_m},
                    {"extrinsic_move_mrad", 1e3 * s.extrinsic_move.rotation_rad},
                    {"matters", s.matters}};
  if (!s.formula.empty()) j["closed_form"] = {{"with", s.formula}, {"score", s.formula_score}};
  return j;
}

ordered_json step_json(const HistoryStep& step, int number) {
  ordered_json channels = ordered_json::object();
  ordered_json heldout = ordered_json::object();
  for (const ChannelSummary& c : step.channels) {
    channels[name_of(c.channel)] = {{"rms", c.rms}, {"unexplained", c.unexplained}};
    heldout[name_of(c.channel)] = c.heldout_rms;
  }
  const Eigen::Vector3d& t = step.camera_from_lidar.translation;
  return {{"step", number},
          {"added", step.added.empty() ? ordered_json(nullptr) : ordered_json(step.added)},
          {"channels", std::move(channels)},
          {"heldout_rms", std::move(heldout)},
          {"translation_m", {t.x(), t.y(), t.z()}}};
}

std::string line(const char* format, double a, double b, double c, double d) {
  char text[160];
  std::snprintf(text, sizeof text, format, a, b, c, d);
  return text;
}

std::string channel_lines(const std::vector<ChannelSummary>& channels) {
  std::string out;
  for (const ChannelSummary& c : channels) {
    char text[200];
    std::snprintf(text, sizeof text, "  %-10s %10.4g %12.4g %12.4g %12.4g%s\n", name_of(c.channel),
                  c.rms, c.noise_floor, c.unexplained, c.heldout_rms,
                  behind_number(unit_of(c.channel)).c_str());
    out += text;
  }
  return out;
}

std::string budget_lines(const Discovery& d) {
  constexpr std::size_t kShown = 6;
  const auto sigma_mm = [](const Matrix6d& m) {
    return 1e3 * std::sqrt(m.diagonal().head<3>().sum());
  };
  const auto sigma_mrad = [](const Matrix6d& m) {
    return 1e3 * std::sqrt(m.diagonal().tail<3>().sum());
  };
  char text[320];
  std::snprintf(text, sizeof text,
                "\nUncertainty of the extrinsic (one standard deviation)\n"
                "  of the model          %8.2f mm %8.3f mrad\n"
                "  in total              %8.2f mm %8.3f mrad\n"
                "  with the budget below %8.2f mm %8.3f mrad\n",
                sigma_mm(d.covariance), sigma_mrad(d.covariance), sigma_mm(d.covariance_total),
                sigma_mrad(d.covariance_total), sigma_mm(d.covariance_with_budget),
                sigma_mrad(d.covariance_with_budget));
  std::string out = text;
  if (d.budget.empty()) return out;
  out += "\nWhat effects that are not in the model could still do (upper 95 % limits)\n";
  for (std::size_t k = 0; k < std::min(kShown, d.budget.size()); ++k) {
    const BudgetItem& item = d.budget[k];
    std::snprintf(text, sizeof text, "  %-22s %8.3g %-5s %8.2f mm %8.3f mrad\n", item.id.c_str(),
                  item.size, item.unit.c_str(), item.translation_mm, item.rotation_mrad);
    out += text;
  }
  return out;
}

}  // namespace

std::string discovery_as_json(const Discovery& d) {
  ordered_json j;
  j["channels"] = ordered_json::array();
  for (const ChannelSummary& c : d.channels) j["channels"].push_back(channel_json(c));
  j["structure"] = ordered_json::array();
  for (const StructureScore& s : d.structure) {
    j["structure"].push_back({{"channel", name_of(s.channel)},
                              {"covariate", joined(s.covariates(), " and ")},
                              {"score", s.score},
                              {"amplitude", s.amplitude}});
  }
  j["effects"] = ordered_json::array();
  for (const EffectFinding& f : d.effects) j["effects"].push_back(effect_json(f));
  j["selected"] = d.selected;
  j["unknown"] = ordered_json::array();
  for (const StructureScore& s : d.unknown) j["unknown"].push_back(unknown_json(s));
  j["history"] = ordered_json::array();
  for (std::size_t k = 0; k < d.history.size(); ++k)
    j["history"].push_back(step_json(d.history[k], static_cast<int>(k)));
  j["advice"] = d.advice;
  j["warnings"] = d.warnings;
  j["sensitivity_budget"] = budget_json(d.budget);
  j["covariance"] = rows_of(d.covariance);
  j["covariance_with_budget"] = rows_of(d.covariance_with_budget);
  return j.dump(2) + "\n";
}

std::string discovery_summary(const Discovery& d) {
  const std::string head = "  channel           RMS  noise floor  unexplained     held out\n";
  std::string out = "Base model\n" + head + channel_lines(d.channels) + "\n";
  const std::string lacking = d.lacking();
  if (!lacking.empty()) {
    out += "Missing, and not added: " + lacking + " (below).\n";
  } else if (d.selected.empty()) {
    const std::string further = d.model.empty() ? "" : "further ";
    out += "No " + further + "effect of the catalogue predicts held-out scenes better";
    out += d.unknown.empty() ? ".\n" : ", but structure is left (below).\n";
  }
  for (const EffectFinding& f : d.effects) {
    if (d.holds(f.id)) out += f.id + ": " + f.explanation.text() + "\n";
  }
  if (!d.model.empty() && !d.history.empty())
    out += "\nWith them\n" + head + channel_lines(d.history.back().channels);
  for (const Message& w : d.warnings) out += "\nWarning: " + w.text() + "\n";
  if (!d.unknown.empty()) {
    out += "\nStructure that no effect of the catalogue explains\n";
    for (const StructureScore& s : d.unknown) {
      out += std::string("  ") + name_of(s.channel) + " against " +
             covariates_named(s.covariates()).text() +
             line(": %.1f %% of the held-out variance, %.3g", 100.0 * s.score, s.amplitude, 0, 0) +
             behind_number(unit_of(s.channel)) +
             (s.matters ? line(", would move the extrinsic by %.1f mm and %.2f mrad",
                               1e3 * s.extrinsic_move.translation_m,
                               1e3 * s.extrinsic_move.rotation_rad, 0, 0)
                        : "") +
             "\n";
    }
  }
  out += "\nThe rest of the catalogue\n";
  for (const EffectFinding& f : d.effects) {
    if (!d.holds(f.id)) out += "  " + f.id + ": " + f.explanation.text() + "\n";
  }
  out += budget_lines(d);
  if (!d.advice.empty()) out += "\nAdvice\n";
  for (const Message& a : d.advice) out += "  " + a.text() + "\n";
  return out;
}

Status write_discovery(const Discovery& discovery, const CalibrationResult& result,
                       const std::filesystem::path& folder, const FrameNames& frames) {
  if (Status s = create_folder(folder); !s) return s.error();
  return write_files_together(folder, {{"discovery.json", discovery_as_json(discovery)},
                                       {"discovery.txt", discovery_summary(discovery)},
                                       {"result.yaml", result_as_yaml(result, frames)},
                                       {"result.json", result_as_json(result, frames)}});
}

}  // namespace lvcalib
