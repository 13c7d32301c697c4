// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Matrices and vectors as JSON. For source files only: nlohmann's header stays out of the API.

#include <Eigen/Core>
#include <nlohmann/json.hpp>

namespace lvcalib {

using nlohmann::ordered_json;

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

}  // namespace lvcalib
