// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <limits>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/error.h"

namespace lvcalib {

/// A value of a parsed YAML document, with the line it stands on for messages.
struct YamlValue {
  enum class Kind { kNull, kScalar, kList, kMap };
  Kind kind = Kind::kNull;
  int line = 0;  ///< 1-based.
  std::string scalar;
  std::vector<YamlValue> list;
  std::vector<std::pair<std::string, YamlValue>> map;

  // Defined in the source file: clang cannot while the type within `map` is incomplete.
  YamlValue();
  YamlValue(const YamlValue&);
  YamlValue(YamlValue&&) noexcept;
  YamlValue& operator=(const YamlValue&);
  YamlValue& operator=(YamlValue&&) noexcept;
  ~YamlValue();

  [[nodiscard]] const YamlValue* find(std::string_view key) const;
};

/// A YAML file with typed access; every error names the file, the line, the key, what was
/// expected and what was found.
class YamlFile {
 public:
  /// Reads and parses a file (at most 4 MiB). OpenCV's "%YAML:1.0" first line is accepted.
  static Result<YamlFile> load(const std::filesystem::path& path);
  /// Parses text; `name` stands for the file in messages.
  static Result<YamlFile> parse(std::string text, std::string name);

  [[nodiscard]] const YamlValue& root() const { return root_; }
  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] bool has(std::string_view key) const { return root_.find(key) != nullptr; }

  /// A nested map as a file of its own, for the same typed access to its keys; messages keep
  /// file and line. Error if the key is missing or does not hold a map.
  [[nodiscard]] Result<YamlFile> section(std::string_view key) const;

  /// A finite number in [low, high]; `expected` completes "expected …" in the message.
  [[nodiscard]] Result<double> number(std::string_view key,
                                      double low = std::numeric_limits<double>::lowest(),
                                      double high = std::numeric_limits<double>::max()) const;
  [[nodiscard]] Result<int> integer(std::string_view key, int low, int high) const;
  [[nodiscard]] Result<std::string> string(std::string_view key) const;
  /// All numbers of a list, nested lists flattened row by row. `count` 0 accepts any length.
  [[nodiscard]] Result<std::vector<double>> numbers(std::string_view key,
                                                    std::size_t count = 0) const;

  /// A warning for every top-level key not in `known`, naming the nearest known key.
  [[nodiscard]] std::vector<Message> unknown_keys(const std::vector<std::string>& known) const;

  /// An input error at a value of this file.
  /// The error of a missing key; points to a key that may be a misspelling of it.
  [[nodiscard]] Error missing(std::string_view key, Message expected) const;
  [[nodiscard]] Error error_at(const YamlValue& value, Message message) const;

  /// Flattens a list value (of lists) into numbers.
  [[nodiscard]] Result<std::vector<double>> flatten(const YamlValue& value,
                                                    std::string_view key) const;

 private:
  std::string name_;
  YamlValue root_;
};

/// Parses a finite decimal number that takes up the whole text, independent of locale.
bool parse_number(std::string_view text, double& value);

/// The candidate with the smallest edit distance to `word`; empty if none is near (more than a
/// third of the letters differ).
std::string nearest_word(std::string_view word, const std::vector<std::string>& candidates);

}  // namespace lvcalib
