// SPDX-License-Identifier: BSD-3-Clause
#include "base/yaml_file.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>

#include <yaml-cpp/yaml.h>

#include "base/file_io.h"

namespace lvcalib {
namespace {

constexpr std::size_t kMaxFileBytes = 4U << 20U;
// Aliases can make a small file expand without bound; no configuration needs this many values.
constexpr int kMaxValues = 200'000;
constexpr int kMaxDepth = 64;

bool convert(const YAML::Node& node, YamlValue& out, int depth, int& budget) {
  if (depth > kMaxDepth || --budget < 0) return false;
  out.line = node.Mark().line + 1;
  if (node.IsScalar()) {
    out.kind = YamlValue::Kind::kScalar;
    out.scalar = node.Scalar();
  } else if (node.IsSequence()) {
    out.kind = YamlValue::Kind::kList;
    for (const YAML::Node& item : node) {
      if (!convert(item, out.list.emplace_back(), depth + 1, budget)) return false;
    }
  } else if (node.IsMap()) {
    out.kind = YamlValue::Kind::kMap;
    for (const auto& entry : node) {
      if (!entry.first.IsScalar()) return false;
      auto& [key, value] = out.map.emplace_back(entry.first.Scalar(), YamlValue{});
      if (!convert(entry.second, value, depth + 1, budget)) return false;
      // A missing value is marked at whatever follows it.
      if (value.kind == YamlValue::Kind::kNull) value.line = entry.first.Mark().line + 1;
    }
  }
  return true;
}

// The first key, in any map, that one has twice; and where its map has it first.
struct RepeatedKey {
  std::string key;
  int line = 0;
  int first_line = 0;
};
std::optional<RepeatedKey> repeated_key(const YamlValue& value) {
  std::map<std::string_view, int> lines;
  for (const auto& [key, inner] : value.map) {
    const auto [first, is_new] = lines.try_emplace(key, inner.line);
    if (!is_new) return RepeatedKey{key, inner.line, first->second};
    if (auto found = repeated_key(inner)) return found;
  }
  for (const YamlValue& item : value.list) {
    if (auto found = repeated_key(item)) return found;
  }
  return std::nullopt;
}

Message describe(const YamlValue& value) {
  switch (value.kind) {
    case YamlValue::Kind::kScalar:
      return Message("'%1'", value.scalar.substr(0, 60));
    case YamlValue::Kind::kList:
      return Message("a list of %1", value.list.size());
    case YamlValue::Kind::kMap:
      return Message("a map");
    case YamlValue::Kind::kNull:
      break;
  }
  return Message("nothing");
}

std::string short_number(double value) {
  char buffer[32];
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, value).ptr;
  return {buffer, end};
}

}  // namespace

YamlValue::YamlValue() = default;
YamlValue::YamlValue(const YamlValue&) = default;
YamlValue::YamlValue(YamlValue&&) noexcept = default;
YamlValue& YamlValue::operator=(const YamlValue&) = default;
YamlValue& YamlValue::operator=(YamlValue&&) noexcept = default;
YamlValue::~YamlValue() = default;

const YamlValue* YamlValue::find(std::string_view key) const {
  for (const auto& [name, value] : map) {
    if (name == key) return &value;
  }
  return nullptr;
}

Result<YamlFile> YamlFile::load(const std::filesystem::path& path) {
  auto text = read_text_file(path, kMaxFileBytes);
  if (!text) return text.error();
  return parse(std::move(*text), path.string());
}

Result<YamlFile> YamlFile::parse(std::string text, std::string name) {
  // OpenCV writes "%YAML:1.0", which is not a legal YAML directive.
  if (text.starts_with("%YAML:")) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    text.replace(0, end, "");
  }
  YamlFile file;
  file.name_ = std::move(name);
  try {
    int budget = kMaxValues;
    const YAML::Node root = YAML::Load(text);
    if (!convert(root, file.root_, 0, budget)) {
      return Error::input(Message("YAML is nested too deeply or far too large"), file.name_);
    }
  } catch (const YAML::Exception& e) {
    return Error::input(Message("not valid YAML: %1", e.msg),
                        file.name_ + ":" + std::to_string(e.mark.line + 1));
  }
  if (file.root_.kind != YamlValue::Kind::kMap) {
    return Error::input(
        Message("expected a YAML map of keys and values, found %1", describe(file.root_)),
        file.name_);
  }
  // Which of the two is meant nobody knows: libraries differ in the one that they take.
  if (const auto twice = repeated_key(file.root_)) {
    return Error::input(
        Message("key '%1' is there twice, first in line %2", twice->key, twice->first_line),
        file.name_ + ":" + std::to_string(twice->line), Message("keep the one that is meant"));
  }
  return file;
}

Result<YamlFile> YamlFile::section(std::string_view key) const {
  const YamlValue* value = root_.find(key);
  if (value == nullptr) {
    return missing(key, Message("a map"));
  }
  if (value->kind != YamlValue::Kind::kMap) {
    return error_at(*value, Message("'%1' must be a map, found %2", key, describe(*value)));
  }
  YamlFile out;
  out.name_ = name_;
  out.root_ = *value;
  return out;
}

Error YamlFile::error_at(const YamlValue& value, Message message) const {
  return Error::input(std::move(message), name_ + ":" + std::to_string(value.line));
}

Error YamlFile::missing(std::string_view key, Message expected) const {
  std::vector<std::string> present;
  for (const auto& [name, value] : root_.map) present.push_back(name);
  const std::string near = nearest_word(key, present);
  return Error::input(Message("key '%1' is missing; expected %2", key, expected), name_,
                      near.empty() ? Message() : Message("is '%1' a misspelling of it?", near));
}

Result<double> YamlFile::number(std::string_view key, double low, double high) const {
  const YamlValue* value = root_.find(key);
  if (value == nullptr) {
    return missing(key, Message("a number"));
  }
  double number = 0;
  if (value->kind != YamlValue::Kind::kScalar || !parse_number(value->scalar, number)) {
    return error_at(*value, Message("'%1' must be a number, found %2", key, describe(*value)));
  }
  if (number < low || number > high) {
    const Message found = describe(*value);
    if (low == std::numeric_limits<double>::lowest()) {
      return error_at(*value,
                      Message("'%1' must be at most %2, found %3", key, short_number(high), found));
    }
    if (high == std::numeric_limits<double>::max()) {
      return error_at(*value,
                      Message("'%1' must be at least %2, found %3", key, short_number(low), found));
    }
    return error_at(*value, Message("'%1' must be between %2 and %3, found %4", key,
                                    short_number(low), short_number(high), found));
  }
  return number;
}

Result<int> YamlFile::integer(std::string_view key, int low, int high) const {
  auto value = number(key, low, high);
  if (!value) return value.error();
  if (*value != std::floor(*value)) {
    return error_at(*root_.find(key), Message("'%1' must be a whole number, found %2", key,
                                              describe(*root_.find(key))));
  }
  return static_cast<int>(*value);
}

Result<std::string> YamlFile::string(std::string_view key) const {
  const YamlValue* value = root_.find(key);
  if (value == nullptr) {
    return missing(key, Message("a word"));
  }
  if (value->kind != YamlValue::Kind::kScalar) {
    return error_at(*value, Message("'%1' must be a word, found %2", key, describe(*value)));
  }
  return value->scalar;
}

Result<std::vector<double>> YamlFile::flatten(const YamlValue& value, std::string_view key) const {
  std::vector<double> out;
  if (value.kind != YamlValue::Kind::kList) {
    return error_at(value,
                    Message("'%1' must be a list of numbers, found %2", key, describe(value)));
  }
  for (const YamlValue& item : value.list) {
    if (item.kind == YamlValue::Kind::kList) {
      auto inner = flatten(item, key);
      if (!inner) return inner.error();
      out.insert(out.end(), inner->begin(), inner->end());
      continue;
    }
    double number = 0;
    if (item.kind != YamlValue::Kind::kScalar || !parse_number(item.scalar, number)) {
      return error_at(item, Message("'%1' must hold numbers, found %2", key, describe(item)));
    }
    out.push_back(number);
  }
  return out;
}

Result<std::vector<double>> YamlFile::numbers(std::string_view key, std::size_t count) const {
  const YamlValue* value = root_.find(key);
  if (value == nullptr) {
    return missing(key, Message("a list of numbers"));
  }
  auto out = flatten(*value, key);
  if (out && count != 0 && out->size() != count) {
    return error_at(*value,
                    Message("'%1' must hold %2 numbers, found %3", key, count, out->size()));
  }
  return out;
}

std::vector<Message> YamlFile::unknown_keys(const std::vector<std::string>& known) const {
  std::vector<Message> warnings;
  for (const auto& [key, value] : root_.map) {
    if (std::find(known.begin(), known.end(), key) != known.end()) continue;
    const std::string place = name_ + ":" + std::to_string(value.line);
    const std::string nearest = nearest_word(key, known);
    warnings.push_back(nearest.empty() ? Message("%1: unknown key '%2' ignored", place, key)
                                       : Message("%1: unknown key '%2' ignored; did you mean '%3'?",
                                                 place, key, nearest));
  }
  return warnings;
}

bool parse_number(std::string_view text, double& value) {
  if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
  return code == std::errc() && end == text.data() + text.size() && std::isfinite(value);
}

std::string nearest_word(std::string_view word, const std::vector<std::string>& candidates) {
  std::string best;
  std::size_t best_distance = word.size();
  for (const std::string& candidate : candidates) {
    // Levenshtein distance, one row at a time, ignoring case.
    std::vector<std::size_t> row(candidate.size() + 1);
    std::iota(row.begin(), row.end(), 0U);
    for (std::size_t i = 0; i < word.size(); ++i) {
      std::size_t diagonal = row[0];
      row[0] = i + 1;
      for (std::size_t j = 0; j < candidate.size(); ++j) {
        const bool same = std::tolower(static_cast<unsigned char>(word[i])) ==
                          std::tolower(static_cast<unsigned char>(candidate[j]));
        const std::size_t replaced = diagonal + (same ? 0 : 1);
        diagonal = row[j + 1];
        row[j + 1] = std::min({row[j] + 1, row[j + 1] + 1, replaced});
      }
    }
    if (row.back() < best_distance) {
      best_distance = row.back();
      best = candidate;
    }
  }
  return best_distance * 3 <= std::max(word.size(), best.size()) ? best : std::string{};
}

}  // namespace lvcalib
