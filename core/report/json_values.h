// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Matrices, vectors and messages as JSON. For source files only: nlohmann's header stays out of the
// API.

#include <cstddef>
#include <string>

#include <Eigen/Core>
#include <nlohmann/json.hpp>

#include "base/memory.h"
#include "base/message.h"

namespace lvcalib {

using nlohmann::ordered_json;

/// JSON from text; discarded (see is_discarded()) if it is none, or nested deeper than any file of
/// ours: copying and writing such values goes as deep as they do, on the stack.
inline nlohmann::json parse_json(const std::string& text) {
  constexpr int kDeepest = 100;
  int depth = 0;
  bool quoted = false;
  for (std::size_t k = 0; k < text.size(); ++k) {
    const char c = text[k];
    if (quoted) {
      if (c == '\\') ++k;
      quoted = c != '"';
    } else if (c == '"') {
      quoted = true;
    } else if (c == '[' || c == '{') {
      if (++depth > kDeepest) return nlohmann::json(nlohmann::json::value_t::discarded);
    } else if (c == ']' || c == '}') {
      --depth;
    }
  }
  // Its destructor asks for memory, and must not fail: what the values take, a dozen bytes for one
  // of a text of numbers, and as much again.
  constexpr std::size_t kPerByte = 24;
  require_memory(kPerByte * text.size() + (std::size_t{1} << 20U));
  return nlohmann::json::parse(text, nullptr, false);
}

/// Files are English.
template <class Json>
void to_json(Json& j, const Message& message) {
  j = message.text();
}

/// Rows of numbers.
template <class Matrix>
ordered_json rows_of(const Matrix& matrix) {
  ordered_json rows = ordered_json::array();
  for (Eigen::Index r = 0; r < matrix.rows(); ++r) {
    ordered_json row = ordered_json::array();
    for (Eigen::Index c = 0; c < matrix.cols(); ++c) row.push_back(matrix(r, c));
    rows.push_back(std::move(row));
  }
  return rows;
}

inline ordered_json list_of(const Eigen::Vector3d& v) {
  return {v.x(), v.y(), v.z()};
}

/// Rows of numbers as a matrix of the given size; false if they are not.
inline bool read_rows(const nlohmann::json& j, Eigen::Index rows, Eigen::Index columns,
                      Eigen::MatrixXd& out) {
  if (!j.is_array() || static_cast<Eigen::Index>(j.size()) != rows) return false;
  out.resize(rows, columns);
  for (Eigen::Index r = 0; r < rows; ++r) {
    const auto& row = j[static_cast<std::size_t>(r)];
    if (!row.is_array() || static_cast<Eigen::Index>(row.size()) != columns) return false;
    for (Eigen::Index c = 0; c < columns; ++c) {
      const auto& value = row[static_cast<std::size_t>(c)];
      if (!value.is_number()) return false;
      out(r, c) = value.get<double>();
    }
  }
  return out.allFinite();
}

}  // namespace lvcalib
