// SPDX-License-Identifier: BSD-3-Clause
// The part of the verdict that compares scenes with each other, and returns within a scan.
#include <algorithm>
#include <cmath>
#include <iterator>
#include <vector>

#include <Eigen/Cholesky>

#include "base/statistics.h"
#include "base/text.h"
#include "pipeline/diagnosis.h"
#include "pipeline/forward_stage.h"
#include "pipeline/verdict.h"

namespace lvcalib {
namespace {

// The extrinsic of some of the scenes, under the model in force.
SubsetSolver subsets_of(const CalibrationResult& result) {
  if (!result.model_fit) return forward_subsets(*result.forward, result.extrinsic);
  return model_subsets(result.model_fit, result.extrinsic.camera_from_lidar.transform,
                       result.extrinsic);
}

std::vector<std::size_t> scenes_in_use(const ExtrinsicSolution& extrinsic) {
  std::vector<std::size_t> out;
  for (std::size_t k = 0; k < extrinsic.scenes.size(); ++k) {
    if (extrinsic.scenes[k].used) out.push_back(k);
  }
  return out;
}

}  // namespace

void judge_leverage(const CalibrationResult& result, Verdict& verdict) {
  if (!result.forward) return;
  const UncertainRigid3& all = result.extrinsic.camera_from_lidar;
  const SubsetSolver subset = subsets_of(result);
  const std::vector<std::size_t> in_use = scenes_in_use(result.extrinsic);
  const std::size_t n = in_use.size();
  // As many tests as scenes, one in a hundred together.
  const double gate = chi_square_gate(6, 0.01 / static_cast<double>(std::max<std::size_t>(1, n)));
  for (const std::size_t k : in_use) {
    const SceneSolution& scene = result.extrinsic.scenes[k];
    std::vector<std::size_t> others;
    std::copy_if(in_use.begin(), in_use.end(), std::back_inserter(others),
                 [&](std::size_t other) { return other != k; });
    const auto rest = n > 2 ? subset(others) : std::nullopt;
    if (!rest) continue;
    const Vector6d move = se3_log(rest->transform * all.transform.inverse());
    const Vector6d sigma = all.covariance.diagonal().cwiseSqrt();
    if ((move.cwiseAbs() - 3.0 * sigma).maxCoeff() <= 0.0) continue;
    // Both share the other scenes: the move's covariance is the difference of theirs.
    const Matrix6d spread = rest->covariance - all.covariance;
    const double chi = move.dot(spread.ldlt().solve(move));
    const double move_m =
        translation_distance_m(all.transform.inverse(), rest->transform.inverse());
    const double move_rad = rotation_distance_rad(all.transform, rest->transform);
    const QualityOptions& q = result.options.quality;
    if (!(chi > gate) || (move_m < q.tolerance_m && move_rad < q.tolerance_rad)) continue;
    verdict.doubtful("without scene " + scene.name + " the extrinsic moves by " +
                     formatted("%.1f mm and %.2f mrad, more than three of its standard deviations",
                               1e3 * move_m, 1e3 * move_rad) +
                     ": did something move while that scene was taken?");
  }
}

void judge_bump(const CalibrationResult& result, Verdict& verdict) {
  if (!result.forward) return;
  const SubsetSolver subset = subsets_of(result);
  std::vector<std::size_t> order = scenes_in_use(result.extrinsic);
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return result.extrinsic.scenes[a].name < result.extrinsic.scenes[b].name;
  });
  if (order.size() < 4) return;
  // As many tests as moments, one in a thousand together.
  const double gate = chi_square_gate(6, 0.001 / static_cast<double>(order.size() - 3));
  const QualityOptions& q = result.options.quality;
  double most = gate;
  std::string text;
  for (std::size_t k = 2; k + 2 <= order.size(); ++k) {
    const auto middle = order.begin() + static_cast<std::ptrdiff_t>(k);
    const auto before = subset({order.begin(), middle});
    const auto after = subset({middle, order.end()});
    if (!before || !after) continue;
    const Vector6d move = se3_log(after->transform * before->transform.inverse());
    const Matrix6d spread = before->covariance + after->covariance;
    const double chi = move.dot(spread.ldlt().solve(move));
    const double move_m =
        translation_distance_m(before->transform.inverse(), after->transform.inverse());
    const double move_rad = rotation_distance_rad(before->transform, after->transform);
    if (!(chi > most) || (move_m < q.tolerance_m && move_rad < q.tolerance_rad)) continue;
    most = chi;
    const auto names = [&](auto first, auto last) {
      std::string list;
      for (auto at = first; at != last; ++at)
        list += (list.empty() ? "" : ", ") + result.extrinsic.scenes[*at].name;
      return list;
    };
    text = describe_bump({names(order.begin(), middle), before->transform},
                         {names(middle, order.end()), after->transform},
                         result.extrinsic.scenes[*(middle - 1)].name,
                         result.extrinsic.scenes[*middle].name);
  }
  if (!text.empty()) verdict.doubtful(text);
}

void judge_scans(const CalibrationResult& result, const QualityOptions& q, Verdict& verdict) {
  if (!result.forward || result.model_fit) return;
  const UncertainRigid3& solved = result.extrinsic.camera_from_lidar;
  const double sigma_m = std::sqrt(solved.covariance.topLeftCorner<3, 3>().trace());
  const double sigma_rad = std::sqrt(solved.covariance.bottomRightCorner<3, 3>().trace());
  const std::vector<std::size_t> in_use = scenes_in_use(result.extrinsic);
  for (const ScanFault& fault : result.forward->scan_faults) {
    const Rigid3 moved = se3_exp(fault.move) * solved.transform;
    const double move_m = translation_distance_m(moved.inverse(), solved.transform.inverse());
    const double move_rad = rotation_distance_rad(moved, solved.transform);
    const bool matters = move_m > std::max(q.tolerance_m, q.tolerance_sigmas * sigma_m) ||
                         move_rad > std::max(q.tolerance_rad, q.tolerance_sigmas * sigma_rad);
    if (!fault.is_there() || !matters) continue;
    const std::string moves = formatted("; with that the extrinsic moves by %.1f mm and %.2f mrad",
                                        1e3 * move_m, 1e3 * move_rad);
    if (fault.kind == ScanFault::Kind::kLag) {
      verdict.doubtful(
          "the print lies displaced along the scan" +
          formatted(", by %.1f ± %.1f µs of it", 1e6 * std::abs(fault.size), 1e6 * fault.sigma) +
          moves +
          ": intensity or angle is read too late; find the effect with "
          "lvcalib discover");
      continue;
    }
    if (fault.kind == ScanFault::Kind::kAngles) {
      verdict.doubtful(
          "the LiDAR's angles do not fit the boards (scale, eccentric encoder or tilted axis)" +
          moves + ": find the effect with lvcalib discover");
      continue;
    }
    if (fault.kind == ScanFault::Kind::kOrigin) {
      verdict.doubtful("the LiDAR's beams start beside the origin of its frame" +
                       formatted(", by %.1f ± %.1f mm", 1e3 * fault.size, 1e3 * fault.sigma) +
                       moves + ": find the effect with lvcalib discover");
      continue;
    }
    std::string where = "in all scenes alike";
    if (fault.scene && *fault.scene < in_use.size())
      where = "in scene " + result.extrinsic.scenes[in_use[*fault.scene]].name;
    verdict.doubtful("the board moves against the LiDAR while it scans, " + where +
                     formatted(", by %.1f ± %.1f mm/s", 1e3 * fault.size, 1e3 * fault.sigma) +
                     moves + "; let board and rig rest, or find the effect with lvcalib discover");
  }
}

void judge_splits(const CalibrationResult& result, Verdict& verdict) {
  for (const SplitHalf& split : result.uncertainty.splits) {
    if (split.agrees()) continue;
    verdict.doubtful(
        "the halves of the scenes (" + split.name + ") differ by " +
        formatted("%.1f mm and %.1f mrad, ", split.translation_mm, split.rotation_mrad) +
        formatted("more than noise explains (χ² %.0f, at most %.0f): an effect is missing "
                  "in the model, or one scene is off",
                  split.chi_square, split.gate));
  }
}

// Without a second one the best extrinsic by other places has the evidence of one scene, of two
// scenes half of all; with one it has nearly all. Outlines alone have likenesses of their own.
void judge_second_board(const CalibrationResult& result, Verdict& verdict) {
  constexpr double kMostOfIt = 0.75;  // Half way between the two.
  const auto by_print = [](const SceneResult& scene) {
    return scene.chosen && scene.search && *scene.chosen < scene.search->candidates.size() &&
           scene.search->candidates[*scene.chosen].correlation > 0.0;
  };
  const SceneConsensus& consensus = result.consensus;
  if (consensus.agreeing < 2 || !(consensus.score > 0.0) ||
      std::none_of(result.scenes.begin(), result.scenes.end(), by_print))
    return;
  const double share = consensus.elsewhere / consensus.score;
  if (share < kMostOfIt) return;
  verdict.doubtful(
      formatted("the clouds hold a second board with this print: another extrinsic has "
                "%.0f %% of the evidence of this one",
                100.0 * share) +
      "; take one of the boards away, or give a rough extrinsic with --init");
}

// What localization states holds a systematic part besides its noise, so that nothing but another
// place reaches the gate; added effects may move the extrinsic on purpose.
void judge_place(const CalibrationResult& result, Verdict& verdict) {
  const UncertainRigid3& localized = result.consensus.camera_from_lidar;
  if (!result.model.empty() || !(localized.covariance.diagonal().minCoeff() > 0.0)) return;
  const UncertainRigid3& solved = result.extrinsic.camera_from_lidar;
  const Vector6d move = se3_log(solved.transform * localized.transform.inverse());
  const Matrix6d spread = localized.covariance + solved.covariance;
  // One in ten thousand, as where scenes are compared.
  if (!(move.dot(spread.ldlt().solve(move)) > chi_square_gate(6, 1e-4))) return;
  verdict.doubtful(
      formatted(
          "the joint solve puts the LiDAR %.0f mm and %.1f mrad from where the localized "
          "boards put it",
          1e3 * translation_distance_m(solved.transform.inverse(), localized.transform.inverse()),
          1e3 * rotation_distance_rad(solved.transform, localized.transform)) +
      ", more than both leave open: it may have locked onto another place of the print; add scenes "
      "with the board turned differently");
}

}  // namespace lvcalib
