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

Error unusable(const std::string& file, const std::string& key, const Message& what) {
  return Error::input(Message("%1 %2", key, what), file, Message("run lvcalib discover again"));
}

Error unknown_effect(const std::string& file, const std::string& id, const std::string& where) {
  std::vector<std::string> known;
  for (const EffectPtr& effect : effect_catalogue()) known.push_back(effect->info().id);
  const std::string nearest = nearest_word(id, known);
  return Error::input(
      nearest.empty()
          ? Message("%1.id is '%2', which is no effect that this version knows", where, id)
          : Message("%1.id is '%2', which is no effect that this version knows; did you mean '%3'?",
                    where, id, nearest),
      file, Message("use the version that wrote the file, or run lvcalib discover again"));
}

std::optional<double> number(const nlohmann::json& j, const char* key) {
  const auto at = j.find(key);
  if (at == j.end() || !at->is_number()) return std::nullopt;
  const double value = at->get<double>();
  return std::isfinite(value) ? std::optional(value) : std::nullopt;
}

Result<std::vector<int>> read_lines(const nlohmann::json& scales, const std::string& file) {
  std::vector<int> out;
  const auto lines = scales.find("lines");
  if (lines == scales.end() || !lines->is_array())
    return unusable(file, "model.scales.lines", Message("is missing or not a list"));
  for (const nlohmann::json& line : *lines) {
    if (!line.is_number_integer())
      return unusable(file, "model.scales.lines", Message("is no list of numbers"));
    const int value = line.get<int>();
    if (!out.empty() && value <= out.back())
      return unusable(file, "model.scales.lines", Message("is not in ascending order"));
    out.push_back(value);
  }
  return out;
}

Result<ModelScales> read_scales(const nlohmann::json& model, const std::string& file) {
  ModelScales out;
  const auto scales = model.find("scales");
  if (scales == model.end() || !scales->is_object())
    return unusable(file, "model.scales",
                    Message("is missing: the file tells values but not what they refer to"));
  const char* const keys[] = {"white_level", "black_level", "log_contrast",
                              "largest_incidence_rad"};
  double* const values[] = {&out.level[0], &out.level[1], &out.log_contrast,
                            &out.incidence_high_rad};
  for (std::size_t k = 0; k < std::size(keys); ++k) {
    const auto value = number(*scales, keys[k]);
    if (!value)
      return unusable(file, std::string("model.scales.") + keys[k], Message("is no number"));
    *values[k] = *value;
  }
  const auto darkness = scales->find("darkness");
  if (darkness == scales->end() || !darkness->is_array() || darkness->size() != 2 ||
      !(*darkness)[0].is_number() || !(*darkness)[1].is_number())
    return unusable(file, "model.scales.darkness", Message("is not two numbers"));
  out.darkness_low = (*darkness)[0];
  out.darkness_high = (*darkness)[1];
  if (!(out.darkness_low <= out.darkness_high))
    return unusable(file, "model.scales.darkness", Message("is not in ascending order"));
  auto lines = read_lines(*scales, file);
  if (!lines) return lines.error();
  out.lines = std::move(*lines);
  return out;
}

Result<EffectInUse> read_effect(const nlohmann::json& j, const ModelScales& scales,
                                const std::string& file, const std::string& where) {
  if (!j.is_object() || !j.contains("id") || !j["id"].is_string())
    return unusable(file, where + ".id", Message("is missing"));
  const std::string id = j["id"].get<std::string>();
  EffectInUse use;
  if (j.contains("spec") && j["spec"].is_string()) {
    auto own = make_user_effect(j["spec"].get<std::string>());
    if (!own)
      return unusable(file, where + ".spec",
                      Message("is no formula or curve: %1", own.error().message));
    use.effect = *own;
  } else {
    use.effect = find_effect(id);
  }
  if (!use.effect) return unknown_effect(file, id, where);
  use.shape = number(j, "shape").value_or(0.0);
  const auto parameters = use.effect->parameters(empty_table(scales));
  use.values = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(parameters.size()));
  if (!j.contains("parameters") || !j["parameters"].is_array() ||
      j["parameters"].size() != parameters.size())
    return unusable(
        file, where + ".parameters",
        Message("is not the list of %1 parameters that '%2' has", parameters.size(), id));
  for (std::size_t k = 0; k < parameters.size(); ++k) {
    const nlohmann::json& p = j["parameters"][k];
    const EffectParameter& expected = parameters[k];
    const auto value = p.is_object() ? number(p, "value") : std::nullopt;
    if (!value || p.value("name", nlohmann::json()) != expected.name ||
        p.value("unit", nlohmann::json()) != expected.unit) {
      return unusable(file, where + ".parameters[" + std::to_string(k) + "]",
                      Message("is not a value of '%1' in %2", expected.name, expected.unit));
    }
    use.values(static_cast<Eigen::Index>(k)) = *value * expected.unit_in_si;
  }
  return use;
}

Result<StoredModel> read_stored(const nlohmann::json& model, const std::string& file) {
  StoredModel out;
  const auto effects = model.find("effects");
  if (effects == model.end() || !effects->is_array())
    return unusable(file, "model.effects", Message("is missing or not a list"));
  if (effects->empty()) return out;
  auto scales = read_scales(model, file);
  if (!scales) return scales.error();
  out.scales = std::move(*scales);
  for (std::size_t k = 0; k < effects->size(); ++k) {
    const std::string where = "model.effects[" + std::to_string(k) + "]";
    auto effect = read_effect((*effects)[k], out.scales, file, where);
    if (!effect) return effect.error();
    out.effects.push_back(std::move(*effect));
  }
  return out;
}

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
  return read_stored(model_json(result), "model");
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
  return read_stored(*model, where);
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
    std::vector<Message> values;
    const auto parameters = use.effect->parameters(table);
    for (std::size_t k = 0; k < parameters.size(); ++k) {
      const EffectParameter& p = parameters[k];
      const double value = use.values(static_cast<Eigen::Index>(k)) / p.unit_in_si;
      values.push_back(parameter_is(use.effect->info().id, p.name,
                                    formatted("%.4g", value) + behind_number(p.unit)));
    }
    if (use.shape != 0.0 && !use.effect->shape_name().empty())
      values.push_back(Message("%1 = %2", Message::listed(use.effect->shape_name()),
                               formatted("%.4g", use.shape)));
    out.effects.push_back(Message("%1: %2", title, joined(values, ", ")));
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
    out.model = Message("%1 + %2", out.model, effect_named(effect.id));
  out.corrected = true;
  out.clouds = Message("It cannot be told which clouds the pose is for: its model is not whole.");
  return out;
}

Message total_uncertainty_note() {
  return Message("In total: with what usual faults could still do that these scenes do not show.");
}

}  // namespace lvcalib
