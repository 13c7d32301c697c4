// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/quality.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include <Eigen/Eigenvalues>

#include "base/statistics.h"
#include "base/text.h"
#include "pipeline/diagnosis.h"
#include "pipeline/verdict.h"

namespace lvcalib {
namespace {

void judge_scale(const CalibrationResult& result, const QualityOptions& options, Verdict& verdict) {
  const MeasuredScale scale = measured_scale(result, options.scale_warning);
  if (scale.sigma <= 0) return;
  const double off = scale.scale - 1.0;
  if (std::abs(off) < 4.0 * scale.sigma || std::abs(off) < options.scale_warning) return;
  const std::string text =
      "LiDAR and camera disagree on the board's size: the LiDAR measures it " +
      formatted("%.2f ± %.2f %% ", 100.0 * std::abs(off), 100.0 * scale.sigma) +
      (off > 0 ? "larger" : "smaller") +
      " than target.yaml says; measure the print and correct tagSize";
  if (std::abs(off) > options.scale_failure) {
    verdict.failed(text);
  } else {
    verdict.note(text);
  }
}

// Given intrinsics that corners and returns contradict: what is wrong, how large, what it does.
void judge_intrinsics(const CalibrationResult& result, Verdict& verdict) {
  if (!result.intrinsics.spacing.empty()) {
    verdict.doubtful("the images contradict target.yaml: " + result.intrinsics.spacing +
                     "; measure the print");
  }
  if (!result.intrinsics.contradiction) return;
  const IntrinsicsContradiction& found = *result.intrinsics.contradiction;
  if (result.intrinsics.mode == IntrinsicsMode::kPrior) {
    verdict.doubtful("the images contradict the standard deviations of the intrinsics: " +
                     found.what + "; calibrate the camera again, or use --intrinsics free");
    return;
  }
  std::string text = "the images contradict the intrinsics: " + found.what;
  if (found.camera_from_lidar) {
    text += formatted("; with that freed the extrinsic moves by %.1f mm and %.2f mrad",
                      found.move_mm, found.move_mrad);
  }
  if (found.matters) {
    verdict.doubtful(text + "; calibrate the camera again, or use --intrinsics free");
  } else {
    verdict.note(text + ", less than what matters");
  }
}

// Standard deviations along the worst axis: of the LiDAR's position and of the rotation. Directions
// that only noise keeps from being undetermined come out as decimetres or metres.
void judge_precision(const ExtrinsicSolution& x, const QualityOptions& options, Verdict& verdict) {
  Eigen::Matrix<double, 3, 6> position;
  position << Eigen::Matrix3d::Identity(), -skew(x.camera_from_lidar.transform.translation);
  const Matrix6d& covariance = x.camera_from_lidar.covariance;
  const auto worst = [](const Eigen::Matrix3d& m) {
    return std::sqrt(
        std::max(0.0, Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(m, Eigen::EigenvaluesOnly)
                          .eigenvalues()(2)));
  };
  const double sigma_m = worst(position * covariance * position.transpose());
  const double sigma_rad = worst(covariance.bottomRightCorner<3, 3>());
  if (sigma_m > options.max_sigma_translation_m || sigma_rad > options.max_sigma_rotation_rad) {
    verdict.failed(
        formatted("the scenes leave the extrinsic open: ± %.0f mm and ± %.1f mrad along "
                  "the worst axes; add scenes with the board turned differently",
                  1e3 * sigma_m, 1e3 * sigma_rad));
  }
}

// Dark print that reads nearer or farther than white one pulls every plane, and the extrinsic with
// it, without showing in the residuals of nodes and planes. What the model in use knows of it
// counts no more.
void judge_dark_offset(const CalibrationResult& result, const QualityOptions& options,
                       Verdict& verdict) {
  double weight = 0.0;
  double sum = 0.0;
  for (const SceneResult& scene : result.scenes) {
    if (!scene.used || !scene.refinement) continue;
    const FittedPlane& plane = scene.refinement->plane;
    const double variance =
        std::pow(plane.group_offset_sigma_m[0], 2) + std::pow(plane.group_offset_sigma_m[1], 2);
    if (plane.group_offset_sigma_m[0] <= 0 || plane.group_offset_sigma_m[1] <= 0) continue;
    sum += (plane.group_offset_m[1] - plane.group_offset_m[0]) / variance;
    weight += 1.0 / variance;
  }
  if (weight <= 0) return;
  const double offset = sum / weight;
  // The planes' two groups are told by the middle level and mix what the model keeps apart: its own
  // size is the better one, and what it leaves shows in its residuals.
  if (result.modelled_dark_offset_m * offset > 0.0) return;
  if (std::abs(offset) < options.max_dark_offset_m || std::abs(offset) < 5.0 / std::sqrt(weight))
    return;
  verdict.doubtful(formatted("black print reads %.1f ± %.1f mm ", 1e3 * std::abs(offset),
                             1e3 / std::sqrt(weight)) +
                   (offset > 0 ? "farther" : "nearer") +
                   " than white: the LiDAR's range depends on the reflectivity, an effect is "
                   "missing in the model");
}

bool is_deviating(const MeasuredScale& relative, double outlier) {
  const double off = std::abs(relative.scale - 1.0);
  return relative.sigma > 0.0 && off > 5.0 * relative.sigma && off > outlier;
}

// One scene whose board is of another size than in all the others.
void judge_scene_scales(const CalibrationResult& result, const QualityOptions& options,
                        Verdict& verdict) {
  for (const SceneResult& scene : result.scenes) {
    const MeasuredScale relative = relative_scale(result, scene);
    if (!is_deviating(relative, options.scale_warning)) continue;
    const double off = relative.scale - 1.0;
    verdict.doubtful("scene " + scene.name + ": its board measures " +
                     formatted("%.2f ± %.2f %% ", 100.0 * std::abs(off), 100.0 * relative.sigma) +
                     (off > 0 ? "larger" : "smaller") +
                     " than in the other scenes: is it another print?");
  }
}

// Names the scene that fits clearly worse than the others, if there is one.
std::string worst_scene(const ExtrinsicSolution& x) {
  constexpr double kClearly = 2.0;
  const SceneSolution* worst = nullptr;
  for (const SceneSolution& scene : x.scenes) {
    if (scene.used && (worst == nullptr || scene.rms_mm > worst->rms_mm)) worst = &scene;
  }
  if (worst == nullptr) return {};
  std::vector<double> others;
  for (const SceneSolution& scene : x.scenes) {
    if (scene.used && &scene != worst) others.push_back(scene.rms_mm);
  }
  if (others.empty()) return {};
  const double usual = median(std::move(others));
  if (!(worst->rms_mm > kClearly * usual)) return {};
  // Metres say only that the circles were not found; the number would say nothing.
  constexpr double kMeaningful_mm = 100.0;
  if (worst->rms_mm > kMeaningful_mm) return "; scene " + worst->name + " misses most";
  return "; scene " + worst->name +
         formatted(" misses most: %.1f mm, the others %.1f mm", worst->rms_mm, usual);
}

// What a model with effects leaves: its ranges against their noise, and structure that moves the
// extrinsic by more than the tolerance. Planes and circles, one number for many returns, tell less.
void judge_model(const CalibrationResult& result, const QualityOptions& options, Verdict& verdict) {
  if (result.modelled_range_misfit > options.max_noise_scale) {
    verdict.doubtful(
        formatted("ranges miss the model by %.1f times their noise: another effect is "
                  "missing in the model",
                  result.modelled_range_misfit));
  }
  for (const StructureScore& s : result.unexplained) {
    verdict.doubtful(std::string("the ") + name_of(s.channel) + " channel shows structure over " +
                     s.covariates() +
                     formatted(" that no effect of the model explains; it could move the extrinsic "
                               "by %.1f mm and %.2f mrad",
                               1e3 * s.extrinsic_move.translation_m,
                               1e3 * s.extrinsic_move.rotation_rad));
  }
}

// Which scenes are out of use and why; equal reasons once.
std::string unused_scenes(const CalibrationResult& result) {
  constexpr std::size_t kMost = 6;  // As many as a reader takes in at once.
  std::vector<std::pair<std::string, std::string>> by_reason;
  for (const SceneResult& scene : result.scenes) {
    if (scene.used || scene.reason.empty() || scene.rejected) continue;
    const auto same = std::find_if(by_reason.begin(), by_reason.end(),
                                   [&](const auto& r) { return r.first == scene.reason; });
    if (same != by_reason.end()) {
      same->second += ", " + scene.name;
    } else {
      by_reason.emplace_back(scene.reason, scene.name);
    }
  }
  std::string text;
  for (std::size_t k = 0; k < by_reason.size() && k < kMost; ++k)
    text += "; scene " + by_reason[k].second + ": " + by_reason[k].first;
  if (by_reason.size() > kMost) text += "; and more";
  return text;
}

// One scene agrees with itself whatever is wrong.
void judge_count(const CalibrationResult& result, Verdict& verdict) {
  const int used = result.extrinsic.used_scenes;
  if (used == 2) {
    verdict.doubtful(
        "two scenes: a mistake in one of them could not be told from one in the other");
  }
  if (used >= 2) return;
  const std::string others = unused_scenes(result);
  verdict.doubtful("only one usable scene: nothing to check the result against; take two or more" +
                   others);
}

// Image and cloud of one place and time belong together: two scenes cannot share one of them.
void judge_shared_files(const CalibrationResult& result, Verdict& verdict) {
  for (const SceneResult& scene : result.scenes) {
    if (scene.shared_file.empty()) continue;
    verdict.doubtful("scene " + scene.name + " has " + scene.shared_file +
                     ": one of the two is not the scene's own");
  }
}

}  // namespace

std::string name_of(Quality quality) {
  switch (quality) {
    case Quality::kGood:
      return "good";
    case Quality::kDoubtful:
      return "doubtful";
    case Quality::kFailed:
      break;
  }
  return "failed";
}

MeasuredScale relative_scale(const CalibrationResult& result, const SceneResult& scene) {
  std::vector<double> scales;
  std::vector<double> sigmas;
  for (const SceneResult& s : result.scenes) {
    if (!s.used || !s.refinement || s.refinement->scale_sigma <= 0) continue;
    scales.push_back(s.refinement->scale);
    sigmas.push_back(s.refinement->scale_sigma);
  }
  if (!scene.used || !scene.refinement || scene.refinement->scale_sigma <= 0 || scales.size() < 3)
    return {};
  // A median's variance is π/2 of a mean's.
  const double count = static_cast<double>(scales.size());
  const double of_median = median(std::move(sigmas)) * std::sqrt(std::numbers::pi / 2.0 / count);
  return {scene.refinement->scale / median(std::move(scales)),
          std::hypot(scene.refinement->scale_sigma, of_median)};
}

MeasuredScale measured_scale(const CalibrationResult& result, double outlier) {
  double weight = 0.0;
  double sum = 0.0;
  for (const SceneResult& scene : result.scenes) {
    if (!scene.used || !scene.refinement || scene.refinement->scale_sigma <= 0 ||
        is_deviating(relative_scale(result, scene), outlier))
      continue;
    const double w = 1.0 / (scene.refinement->scale_sigma * scene.refinement->scale_sigma);
    weight += w;
    sum += w * scene.refinement->scale;
  }
  if (weight <= 0) return {};
  return {sum / weight, 1.0 / std::sqrt(weight)};
}

void judge_quality(CalibrationResult& result, const QualityOptions& options) {
  // Solving again starts from a clean list.
  std::erase_if(result.warnings, [](const std::string& w) { return w.starts_with("result: "); });
  const std::size_t before = result.warnings.size();
  Verdict verdict(result);
  const ExtrinsicSolution& x = result.extrinsic;
  judge_intrinsics(result, verdict);
  judge_shared_files(result, verdict);
  if (const std::string unseen = diagnose_unseen_tags(result); !unseen.empty())
    verdict.doubtful(unseen);
  judge_count(result, verdict);
  if (const std::string bump = diagnose_bump(result); !bump.empty()) verdict.doubtful(bump);
  if (x.rank < 6)
    verdict.failed("the scenes determine only " + std::to_string(x.rank) +
                   " of 6 directions of the extrinsic");
  if (!result.forward_failure.empty()) {
    verdict.note("the model of every return could not be solved (" + result.forward_failure +
                 "): the extrinsic rests on nodes, planes and corners");
  }
  if (result.forward) judge_print(result, options, verdict);
  judge_place(result, verdict);
  judge_precision(x, options, verdict);
  for (const std::string& direction : x.weak_directions) verdict.doubtful(direction);
  judge_scale(result, options, verdict);
  judge_dark_offset(result, options, verdict);
  judge_scene_scales(result, options, verdict);
  judge_splits(result, verdict);
  judge_leverage(result, verdict);
  judge_bump(result, verdict);
  judge_scans(result, options, verdict);
  if (!result.unverified.empty()) verdict.note(result.unverified);
  if (x.sigma_px > options.max_sigma_px) {
    verdict.doubtful(formatted(
        "tag corners miss their model by %.2f px: check the intrinsics and that the board is flat",
        x.sigma_px));
  }
  if (result.model_fit) {
    judge_model(result, options, verdict);
  } else if (x.node_scale > options.max_noise_scale || x.plane_scale > options.max_noise_scale) {
    verdict.doubtful(
        formatted("LiDAR residuals are %.1f times (nodes) and %.1f times (planes) their noise: an "
                  "effect is missing in the model",
                  x.node_scale, x.plane_scale) +
        worst_scene(x));
  }
  if (result.target.has_circles() && x.rms_mm > 1e3 * result.target.circle_radius_m) {
    verdict.doubtful(
        "the circles' centres miss the model by more than their radius: the clouds do not show "
        "them");
  }
  judge_second_board(result, verdict);
  if (x.used_scenes > 1 && result.consensus.margin() < options.min_margin) {
    verdict.doubtful(formatted("another assignment of the board is nearly as good (margin %.1f)",
                               result.consensus.margin()));
  }
  for (const SceneResult& scene : result.scenes) {
    if (!scene.used && !scene.reason.empty() && !scene.rejected) {
      // The image shows the board, and the cloud shows none where the other scenes say: a scene
      // that contradicts them is worth more than a note.
      const std::string text = "scene " + scene.name + " is not used: " + scene.reason;
      if (scene.contradicts) {
        verdict.doubtful(text);
      } else {
        verdict.note(text);
      }
    }
    if (scene.used && !scene.objection.empty())
      verdict.doubtful("scene " + scene.name + " is used all the same, as you decided, though " +
                       scene.objection);
    if (!scene.refinement || !scene.used) continue;
    for (const std::string& w : scene.refinement->warnings)
      verdict.note("scene " + scene.name + ": " + w);
  }
  for (std::size_t k = before; k < result.warnings.size(); ++k)
    result.warnings[k].insert(0, "result: ");
}

}  // namespace lvcalib
