// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/quality.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include "base/statistics.h"
#include "base/text.h"
#include "model/board_prediction.h"
#include "pipeline/diagnosis.h"
#include "pipeline/forward_stage.h"

namespace lvcalib {
namespace {

// Collects warnings and keeps the worst verdict with its first reason.
class Verdict {
 public:
  explicit Verdict(CalibrationResult& result) : result_(result) {
    result_.quality = Quality::kGood;
    result_.quality_reason.clear();
    result_.quality_reasons.clear();
  }
  void note(std::string text) { result_.warnings.push_back(std::move(text)); }
  void doubtful(std::string text) {
    become(Quality::kDoubtful, text);
    note(std::move(text));
  }
  void failed(std::string text) {
    become(Quality::kFailed, text);
    note(std::move(text));
  }

 private:
  void become(Quality quality, const std::string& reason) {
    result_.quality_reasons.push_back(reason);
    if (result_.quality >= quality) return;
    result_.quality = quality;
    result_.quality_reason = reason;
  }
  CalibrationResult& result_;
};

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

// Scenes on which the result rests alone: without one the extrinsic moves by more than three of its
// standard deviations, and by more than the scene's weight explains.
void judge_leverage(const CalibrationResult& result, Verdict& verdict) {
  if (!result.forward) return;
  const UncertainRigid3& all = result.extrinsic.camera_from_lidar;
  const SubsetSolver subset = result.model_fit
                                  ? model_subsets(result.model_fit, all.transform, result.extrinsic)
                                  : forward_subsets(*result.forward, result.extrinsic);
  std::vector<std::size_t> in_use;
  for (std::size_t k = 0; k < result.extrinsic.scenes.size(); ++k) {
    if (result.extrinsic.scenes[k].used) in_use.push_back(k);
  }
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

// Scenes before and after some moment that contradict each other, two at least on either side: one
// alone is what judge_leverage() asks about.
void judge_bump(const CalibrationResult& result, Verdict& verdict) {
  if (!result.forward) return;
  const UncertainRigid3& all = result.extrinsic.camera_from_lidar;
  const SubsetSolver subset = result.model_fit
                                  ? model_subsets(result.model_fit, all.transform, result.extrinsic)
                                  : forward_subsets(*result.forward, result.extrinsic);
  std::vector<std::size_t> order;
  for (std::size_t k = 0; k < result.extrinsic.scenes.size(); ++k) {
    if (result.extrinsic.scenes[k].used) order.push_back(k);
  }
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

// What moved while the scans were taken, or trails along them, where the clouds' times tell.
void judge_scans(const CalibrationResult& result, const QualityOptions& q, Verdict& verdict) {
  if (!result.forward || result.model_fit) return;
  const UncertainRigid3& solved = result.extrinsic.camera_from_lidar;
  const double sigma_m = std::sqrt(solved.covariance.topLeftCorner<3, 3>().trace());
  const double sigma_rad = std::sqrt(solved.covariance.bottomRightCorner<3, 3>().trace());
  std::vector<std::string> names;
  for (const SceneSolution& scene : result.extrinsic.scenes) {
    if (scene.used) names.push_back(scene.name);
  }
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
    std::string where = "in all scenes alike";
    if (fault.scene && *fault.scene < names.size()) where = "in scene " + names[*fault.scene];
    verdict.doubtful("the board moves against the LiDAR while it scans, " + where +
                     formatted(", by %.1f ± %.1f mm/s", 1e3 * fault.size, 1e3 * fault.sigma) +
                     moves + "; let board and rig rest, or find the effect with lvcalib discover");
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

// Halves of the scenes that contradict each other: something depends on what parts them.
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

// Why the intensities of a scene are not used.
enum class PrintState { kSeen, kNoIntensity, kNoContrast, kOtherPrint };

PrintState print_state(const SceneResult& scene, const ForwardSceneResult& solved) {
  if (scene.no_contrast) return PrintState::kNoContrast;
  if (!scene.board_points.has_contrast()) return PrintState::kNoIntensity;
  if (solved.print_correlation > 0.0) return PrintState::kSeen;
  return solved.intensity_structure < kPlainStructure ? PrintState::kNoContrast
                                                      : PrintState::kOtherPrint;
}

std::string print_problem(PrintState state) {
  switch (state) {
    case PrintState::kNoIntensity:
      return "the clouds' intensity is missing or the same everywhere";
    case PrintState::kNoContrast:
      return "the print has no contrast for this LiDAR";
    default:
      return "the clouds' intensities do not follow the target's print";
  }
}

// The field of target.yaml that states a size, and its present value.
std::pair<const char*, double> size_field(const Target& t, int axis) {
  switch (t.type) {
    case TargetType::kCheckerboard:
      return axis == 0 ? std::pair("colSpacingMeters", t.column_spacing_m)
                       : std::pair("rowSpacingMeters", t.row_spacing_m);
    case TargetType::kCharuco:
      return {"squareSize", t.column_spacing_m};
    default:
      return {"tagSize", t.tag_size_m};
  }
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

// A print of another size than the target's, by the intensities.
void judge_print_size(const CalibrationResult& result, const QualityOptions& options,
                      Verdict& verdict) {
  const PrintSize& size = result.forward->print_size;
  if (!size.measured) return;
  // What the model in force says of the print is no contradiction any more.
  const Eigen::Array2d off = size.scale.array() - 1.0 - result.modelled_print_scale.array();
  const bool clear =
      (off.abs() > 4.0 * size.sigma.array() && off.abs() > options.scale_warning).any();
  if (!clear) return;
  std::string fits;
  for (int axis = 0; axis < 2; ++axis) {
    const auto [field, value] = size_field(result.target, axis);
    if (fits.find(field) != std::string::npos) continue;
    fits += (fits.empty() ? "" : ", ") + std::string(field) +
            formatted(": %.5f", value * size.scale(axis));
  }
  // One number where both axes say the same.
  const double apart = std::abs(size.scale.x() - size.scale.y());
  const Eigen::Array2d weight = size.sigma.array().square().inverse();
  const double mean = (weight * off).sum() / weight.sum();
  std::string text = "LiDAR and camera disagree on the board's size: the LiDAR sees the print ";
  if (apart < 3.0 * size.sigma.norm()) {
    text += formatted("%.2f ± %.2f %% ", 100.0 * std::abs(mean), 100.0 / std::sqrt(weight.sum())) +
            (mean > 0 ? "larger" : "smaller") + " than target.yaml says; ";
  } else {
    text += formatted("%.2f ± %.2f %% as wide ", 100.0 * size.scale.x(), 100.0 * size.sigma.x()) +
            formatted("and %.2f ± %.2f %% as high as target.yaml says; ", 100.0 * size.scale.y(),
                      100.0 * size.sigma.y());
  }
  text += fits + " would fit; measure the print";
  if (off.abs().maxCoeff() > options.scale_failure) {
    verdict.failed(text);
  } else {
    verdict.doubtful(text);
  }
}

// Share of the returns on the board that lie on white print, seen through a blur of millimetres.
double white_share(const BlurredPrint& print, const Cloud& points, const Rigid3& lidar_from_board) {
  // A beam of 1.5 mrad at the usual distance; a mean hardly asks.
  constexpr double kBlur_m = 0.004;
  const BoardPredictor predictor(print, lidar_from_board, {}, {});
  const BlurredPrint::Coarse blurred = print.coarse(kBlur_m);
  double white = 0.0;
  double count = 0.0;
  for (const Eigen::Vector3f& point : points.points_m) {
    const auto hit = predictor.hit(point.cast<double>().normalized());
    if (!hit || print.inside_m(hit->board_m) <= 0.0) continue;
    white += blurred.at(hit->board_m);
    count += 1.0;
  }
  return count > 0.0 ? white / count : 1.0;
}

// What the intensities say about the print, and what keeps them from saying it.
void judge_print(const CalibrationResult& result, const QualityOptions& options, Verdict& verdict) {
  const ForwardSolution& forward = *result.forward;
  std::map<PrintState, std::string> unseen;
  std::string saturated;
  std::string clipped;
  std::size_t next = 0;
  std::size_t scenes = 0;
  for (const SceneSolution& solved : result.extrinsic.scenes) {
    if (!solved.used || next >= forward.scenes.size()) continue;
    const auto scene = std::find_if(result.scenes.begin(), result.scenes.end(),
                                    [&](const SceneResult& s) { return s.name == solved.name; });
    const Rigid3 lidar_from_board = forward.state.lidar_from_board(next);
    const ForwardSceneResult& found = forward.scenes[next++];
    if (scene == result.scenes.end()) continue;
    ++scenes;
    const PrintState state = print_state(*scene, found);
    if (state != PrintState::kSeen)
      unseen[state] += (unseen[state].empty() ? "" : ", ") + scene->name;
    // Where the median white return is at the ceiling the level of white is not measured, and an
    // edge's middle is taken for where half of the ceiling is.
    if (found.saturated > 0.0 && result.print &&
        found.saturated > 0.5 * white_share(*result.print, scene->board_points, lidar_from_board)) {
      clipped += (clipped.empty() ? "" : ", ") + scene->name +
                 formatted(" (%.0f %%)", 100.0 * found.saturated);
    } else if (found.saturated > 0.0) {
      saturated += (saturated.empty() ? "" : ", ") + scene->name +
                   formatted(" (%.0f %%)", 100.0 * found.saturated);
    }
    if (found.seen < 0.6) {
      verdict.note("scene " + scene->name +
                   formatted(": the LiDAR sees %.0f %% of the board only: something covers it, or "
                             "it is cut off",
                             100.0 * found.seen));
    }
  }
  for (const auto& [state, names] : unseen) {
    const bool all = !forward.uses_intensity && unseen.size() == 1;
    std::string text = print_problem(state);
    if (!all) text += " in scene " + names;
    text += all ? ": the extrinsic rests on planes and corners, and the print does not hold it "
                  "sideways"
                : ": planes and corners are used there";
    if (state == PrintState::kOtherPrint) {
      verdict.doubtful(text + "; does target.yaml describe this board?");
    } else {
      verdict.note(text);
    }
  }
  if (!saturated.empty()) {
    verdict.note("the intensities are saturated on part of the board: scene " + saturated +
                 "; lower the LiDAR's gain or print the white greyer");
  }
  if (!clipped.empty()) {
    verdict.doubtful(
        "white print is saturated, so that the place of its edges is not measured: "
        "scene " +
        clipped + "; lower the LiDAR's gain or print the white greyer");
  }
  if (!forward.uses_intensity) return;
  if (forward.lattice_margin < options.min_margin) {
    verdict.doubtful(
        formatted("ambiguous: another place of the print on the board fits the intensities of all "
                  "scenes nearly as well (log-likelihood %.1f less)",
                  forward.lattice_margin));
  }
  judge_print_size(result, options, verdict);
}

// Two boards with the same print, in every cloud, are two extrinsics that all scenes agree on.
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

// The joint solve ends where the boards were localized, or it has locked onto something else. What
// localization states holds a systematic part besides its noise, so that nothing but another place
// reaches the gate; added effects may move the extrinsic on purpose.
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

// Which scenes are out of use and why; equal reasons once.
std::string unused_scenes(const CalibrationResult& result) {
  constexpr std::size_t kMost = 6;  // As many as a reader takes in at once.
  std::vector<std::pair<std::string, std::string>> by_reason;
  for (const SceneResult& scene : result.scenes) {
    if (scene.used || scene.reason.empty() || scene.reason == kRejectedByUser) continue;
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
    if (!scene.used && !scene.reason.empty() && scene.reason != kRejectedByUser) {
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
