// SPDX-License-Identifier: BSD-3-Clause
#include "report/stored_model.h"

#include <cmath>
#include <optional>
#include <string>

#include <nlohmann/json.hpp>

#include "base/file_io.h"
#include "base/text.h"
#include "base/yaml_file.h"
#include "model/correction.h"
#include "model/user_effect.h"
#include "report/evidence_json.h"
#include "report/json_values.h"
#include "report/result_file.h"

namespace lvcalib {
namespace {

using nlohmann::ordered_json;

ordered_json scales_json(const ModelScales& scales) {
  return {{"white_level", scales.level[static_cast<std::size_t>(Print::kWhite)]},
          {"black_level", scales.level[static_cast<std::size_t>(Print::kBlack)]},
          {"log_contrast", scales.log_contrast},
          {"darkness", {scales.darkness_low, scales.darkness_high}},
          {"largest_incidence_rad", scales.incidence_high_rad},
          {"lines", scales.lines}};
}

class Reader {
 public:
  Reader(const nlohmann::json& model, std::string file) : model_(model), file_(std::move(file)) {}

  Result<StoredModel> run() {
    const auto effects = model_.find("effects");
    if (effects == model_.end() || !effects->is_array())
      return error("model.effects", Message("is missing or not a list"));
    if (effects->empty()) return out_;
    if (Status s = read_scales(); !s) return s.error();
    for (std::size_t k = 0; k < effects->size(); ++k) {
      if (Status s = read_effect((*effects)[k], "model.effects[" + std::to_string(k) + "]"); !s)
        return s.error();
    }
    return std::move(out_);
  }

 private:
  [[nodiscard]] Error error(const std::string& key, const Message& what) const {
    return Error::input(Message("%1 %2", key, what), file_, Message("run lvcalib discover again"));
  }

  static std::optional<double> number(const nlohmann::json& j, const char* key) {
    const auto at = j.find(key);
    if (at == j.end() || !at->is_number()) return std::nullopt;
    const double value = at->get<double>();
    return std::isfinite(value) ? std::optional(value) : std::nullopt;
  }

  Status read_scales() {
    const auto scales = model_.find("scales");
    if (scales == model_.end() || !scales->is_object())
      return error("model.scales",
                   Message("is missing: the file tells values but not what they refer to"));
    const char* const keys[] = {"white_level", "black_level", "log_contrast",
                                "largest_incidence_rad"};
    double* const values[] = {&out_.scales.level[0], &out_.scales.level[1],
                              &out_.scales.log_contrast, &out_.scales.incidence_high_rad};
    for (std::size_t k = 0; k < std::size(keys); ++k) {
      const auto value = number(*scales, keys[k]);
      if (!value) return error(std::string("model.scales.") + keys[k], Message("is no number"));
      *values[k] = *value;
    }
    const auto darkness = scales->find("darkness");
    if (darkness == scales->end() || !darkness->is_array() || darkness->size() != 2 ||
        !(*darkness)[0].is_number() || !(*darkness)[1].is_number())
      return error("model.scales.darkness", Message("is not two numbers"));
    out_.scales.darkness_low = (*darkness)[0];
    out_.scales.darkness_high = (*darkness)[1];
    if (!(out_.scales.darkness_low <= out_.scales.darkness_high))
      return error("model.scales.darkness", Message("is not in ascending order"));
    return read_lines(*scales);
  }

  Status read_lines(const nlohmann::json& scales) {
    const auto lines = scales.find("lines");
    if (lines == scales.end() || !lines->is_array())
      return error("model.scales.lines", Message("is missing or not a list"));
    for (const nlohmann::json& line : *lines) {
      if (!line.is_number_integer())
        return error("model.scales.lines", Message("is no list of numbers"));
      const int value = line.get<int>();
      if (!out_.scales.lines.empty() && value <= out_.scales.lines.back())
        return error("model.scales.lines", Message("is not in ascending order"));
      out_.scales.lines.push_back(value);
    }
    return Done{};
  }

  Status read_effect(const nlohmann::json& j, const std::string& where) {
    if (!j.is_object() || !j.contains("id") || !j["id"].is_string())
      return error(where + ".id", Message("is missing"));
    const std::string id = j["id"].get<std::string>();
    EffectInUse use;
    if (j.contains("spec") && j["spec"].is_string()) {
      auto own = make_user_effect(j["spec"].get<std::string>());
      if (!own)
        return error(where + ".spec", Message("is no formula or curve: %1", own.error().message));
      use.effect = *own;
    } else {
      use.effect = find_effect(id);
    }
    if (!use.effect) return unknown(id, where);
    use.shape = number(j, "shape").value_or(0.0);
    const auto parameters = use.effect->parameters(empty_table(out_.scales));
    use.values = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(parameters.size()));
    if (!j.contains("parameters") || !j["parameters"].is_array() ||
        j["parameters"].size() != parameters.size())
      return error(where + ".parameters", Message("is not the list of %1 parameters that '%2' has",
                                                  parameters.size(), id));
    for (std::size_t k = 0; k < parameters.size(); ++k) {
      const nlohmann::json& p = j["parameters"][k];
      const EffectParameter& expected = parameters[k];
      const auto value = p.is_object() ? number(p, "value") : std::nullopt;
      if (!value || p.value("name", nlohmann::json()) != expected.name ||
          p.value("unit", nlohmann::json()) != expected.unit) {
        return error(where + ".parameters[" + std::to_string(k) + "]",
                     Message("is not a value of '%1' in %2", expected.name, expected.unit));
      }
      use.values(static_cast<Eigen::Index>(k)) = *value * expected.unit_in_si;
    }
    out_.effects.push_back(std::move(use));
    return Done{};
  }

  [[nodiscard]] Error unknown(const std::string& id, const std::string& where) const {
    std::vector<std::string> known;
    for (const EffectPtr& effect : effect_catalogue()) known.push_back(effect->info().id);
    const std::string nearest = nearest_word(id, known);
    return Error::input(
        nearest.empty()
            ? Message("%1.id is '%2', which is no effect that this version knows", where, id)
            : Message(
                  "%1.id is '%2', which is no effect that this version knows; did you mean '%3'?",
                  where, id, nearest),
        file_, Message("use the version that wrote the file, or run lvcalib discover again"));
  }

  const nlohmann::json& model_;
  std::string file_;
  StoredModel out_;
};

}  // namespace

nlohmann::ordered_json model_json(const CalibrationResult& result) {
  ordered_json effects = ordered_json::array();
  for (const ModelEffect& effect : result.model) {
    ordered_json parameters = ordered_json::array();
    for (const ParameterEstimate& p : effect.parameters) {
      parameters.push_back({{"name", p.name},
                            {"value", p.value / p.unit_in_si},
                            {"sigma", p.sigma / p.unit_in_si},
                            {"unit", p.unit}});
    }
    ordered_json e = {{"id", effect.id}, {"parameters", std::move(parameters)}};
    if (effect.shape != 0.0) e["shape"] = effect.shape;
    if (effect.shape_sigma > 0.0) e["shape_sigma"] = effect.shape_sigma;
    if (!effect.spec.empty()) e["spec"] = effect.spec;
    effects.push_back(std::move(e));
  }
  ordered_json model = {{"effects", std::move(effects)}};
  if (!result.model.empty()) model["scales"] = scales_json(result.model_scales);
  return model;
}

Result<StoredModel> model_of(const CalibrationResult& result) {
  const nlohmann::json model = model_json(result);
  return Reader(model, "model").run();
}

Result<StoredModel> model_in(const std::string& result_json, const std::string& where) {
  const auto j = parse_json(result_json);
  if (j.is_discarded() || !j.is_object())
    return Error::input(Message("not a JSON object"), where,
                        Message("give the result.json of a calibration"));
  const auto model = j.find("model");
  if (model == j.end() || !model->is_object()) {
    return Error::input(Message("holds no model"), where,
                        Message("give the result.json that lvcalib discover wrote"));
  }
  return Reader(*model, where).run();
}

Result<StoredModel> read_model(const std::filesystem::path& path) {
  auto text = read_text_file(path, kMaxResultBytes);
  if (!text) return text.error();
  return model_in(*text, path.string());
}

PoseUse pose_use(const StoredModel& model) {
  PoseUse out;
  out.model = Message("Base model");
  std::optional<Message> taken_out;
  const MeasurementTable table = empty_table(model.scales);
  for (const EffectInUse& use : model.effects) {
    const Message title = Message::listed(use.effect->info().title);
    out.model = Message("%1 + %2", out.model, title);
    std::string values;
    const auto parameters = use.effect->parameters(table);
    for (std::size_t k = 0; k < parameters.size(); ++k) {
      const EffectParameter& p = parameters[k];
      const double value = use.values(static_cast<Eigen::Index>(k)) / p.unit_in_si;
      values +=
          (k == 0 ? "" : ", ") + p.name + " = " + formatted("%.4g", value) + behind_number(p.unit);
    }
    out.effects.push_back(Message("%1: %2", title, values));
    if (!correction_reads(use, model.scales).moves_points) continue;
    taken_out = taken_out ? Message("%1, %2", *taken_out, title) : title;
  }
  out.corrected = taken_out.has_value();
  out.clouds = taken_out
                   ? Message(
                         "The pose is for clouds with this taken out: %1 (lvcalib correct). Clouds "
                         "as the LiDAR gives them are still off by it.",
                         *taken_out)
                   : Message("The pose is for clouds as the LiDAR gives them.");
  return out;
}

PoseUse pose_use(const CalibrationResult& result) {
  if (const auto model = model_of(result)) return pose_use(*model);
  // A model that no file could hold: named as far as it can be, and nothing promised of raw clouds.
  PoseUse out = pose_use(StoredModel());
  for (const ModelEffect& effect : result.model)
    out.model = Message("%1 + %2", out.model, effect.id);
  out.corrected = true;
  out.clouds = Message("It cannot be told which clouds the pose is for: its model is not whole.");
  return out;
}

Message total_uncertainty_note() {
  return Message("In total: with what usual faults could still do that these scenes do not show.");
}

}  // namespace lvcalib
