// SPDX-License-Identifier: BSD-3-Clause
#include "report/result_inputs.h"

#include <algorithm>
#include <filesystem>

#include <nlohmann/json.hpp>

#include "pipeline/input_hashes.h"

namespace lvcalib {

Status check_result_inputs(const nlohmann::json& result, const std::string& where,
                           const std::vector<std::string>& only, const RunContext& context) {
  const auto inputs = result.find("inputs");
  const auto dataset = result.find("dataset");
  if (inputs == result.end() || !inputs->is_array() || dataset == result.end() ||
      !dataset->is_string())
    return Done{};
  for (const nlohmann::json& file : *inputs) {
    if (!file.is_object() || !file.contains("path") || !file["path"].is_string() ||
        !file.contains("sha256") || !file["sha256"].is_string())
      continue;
    const std::string name = file["path"].get<std::string>();
    if (!only.empty() && std::find(only.begin(), only.end(), name) == only.end()) continue;
    const auto path = std::filesystem::path(dataset->get<std::string>()) / name;
    const std::string hash = file["sha256"].get<std::string>();
    InputFile now;
    if (hash.empty() || !hash_file(path, context, now) || now.sha256 == hash) continue;
    return Error::input(
        Message("the file is not the one that the result was made of: its content changed"),
        path.string(), Message("calibrate again (%1 is of the file as it was before)", where));
  }
  return context.stopped() ? Status(Error::cancelled()) : Status(Done{});
}

}  // namespace lvcalib
