// SPDX-License-Identifier: BSD-3-Clause
#include "report/result_comparison.h"

#include <cmath>
#include <string>

#include <Eigen/Cholesky>
#include <nlohmann/json.hpp>

#include "base/file_io.h"
#include "report/json_values.h"
#include "report/result_file.h"

namespace lvcalib {
namespace {

using Json = nlohmann::json;

// Six rows of six numbers under a key; zero if there is no such thing.
Matrix6d covariance_in(const Json& j, const char* key) {
  const auto at = j.find(key);
  if (at == j.end() || !at->is_array() || at->size() != 6) return Matrix6d::Zero();
  Matrix6d out;
  for (std::size_t r = 0; r < 6; ++r) {
    const Json& row = (*at)[r];
    if (!row.is_array() || row.size() != 6) return Matrix6d::Zero();
    for (std::size_t c = 0; c < 6; ++c) {
      if (!row[c].is_number()) return Matrix6d::Zero();
      out(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(c)) = row[c].get<double>();
    }
  }
  return out;
}

// P(χ² ≥ x) with six degrees of freedom: a polynomial times an exponential.
double chance_of(double chi2) {
  const double h = 0.5 * chi2;
  return std::exp(-h) * (1.0 + h + 0.5 * h * h);
}

}  // namespace

Result<StatedExtrinsic> read_stated_extrinsic(const std::filesystem::path& path) {
  const auto text = read_text_file(path, kMaxResultBytes);
  if (!text) return text.error();
  const Json j = parse_json(*text);
  StatedExtrinsic out;
  if (j.is_object() && j.contains("T_CL")) {
    const auto truth = read_truth(path);
    if (!truth) return truth.error();
    out.camera_from_lidar = *truth;
    out.is_truth = true;
    return out;
  }
  if (!j.is_object() || !j.contains("T_camera_lidar")) {
    return Error::input("holds no extrinsic; expected T_camera_lidar (a result) or T_CL (a truth)",
                        path.string(), "give the result.json of a calibration");
  }
  const auto result = read_result(path);
  if (!result) return result.error();
  out.camera_from_lidar = result->camera_from_lidar;
  out.covariance = result->covariance;
  out.covariance_total = covariance_in(j, "covariance_total");
  if (out.covariance_total.isZero()) out.covariance_total = out.covariance;
  return out;
}

ExtrinsicDifference difference_of(const StatedExtrinsic& first, const StatedExtrinsic& second) {
  ExtrinsicDifference out;
  const Rigid3& a = first.camera_from_lidar;
  const Rigid3& b = second.camera_from_lidar;
  out.translation_mm = 1e3 * translation_distance_m(a, b);
  out.rotation_mrad = 1e3 * rotation_distance_rad(a, b);
  out.by_axis = se3_log(b * a.inverse());
  // Both perturb the same pose from the left: b·a⁻¹ = Exp(−x_b)·Exp(x_a), to first order x_a − x_b.
  const Matrix6d sum = first.covariance_total + second.covariance_total;
  out.sigma_first = first.covariance_total.diagonal().cwiseMax(0.0).cwiseSqrt();
  out.sigma_second = second.covariance_total.diagonal().cwiseMax(0.0).cwiseSqrt();
  if (!first.states_errors() || !second.states_errors()) return out;
  out.sigma = sum.diagonal().cwiseMax(0.0).cwiseSqrt();
  const Eigen::LDLT<Matrix6d> factor(sum);
  if (factor.info() != Eigen::Success || !factor.isPositive() || sum.isZero()) return out;
  const double chi2 = out.by_axis.dot(factor.solve(out.by_axis));
  if (!std::isfinite(chi2)) return out;
  out.chi2 = chi2;
  out.probability = chance_of(chi2);
  return out;
}

}  // namespace lvcalib
