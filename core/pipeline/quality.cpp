// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/quality.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "base/statistics.h"
#include "base/symmetric.h"
#include "base/text.h"
#include "cloud/about_cloud.h"
#include "model/row_covariates.h"
#include "pipeline/camera_figures.h"
#include "pipeline/diagnosis.h"
#include "pipeline/verdict.h"

namespace lvcalib {
namespace {

void judge_scale(const CalibrationResult& result, const QualityOptions& options, Verdict& verdict) {
  const MeasuredScale scale = measured_scale(result, options.scale_warning);
  if (scale.sigma <= 0) return;
  const double off = scale.scale - 1.0;
  if (std::abs(off) < 4.0 * scale.sigma || std::abs(off) < options.scale_warning) return;
  const std::string percent = formatted("%.2f ± %.2f", 100.0 * std::abs(off), 100.0 * scale.sigma);
  const Message text =
      off > 0 ? Message(
                    "LiDAR and camera disagree on the board's size: the LiDAR measures it %1 % "
                    "larger than target.yaml says; measure the print and correct tagSize",
                    percent)
              : Message(
                    "LiDAR and camera disagree on the board's size: the LiDAR measures it %1 % "
                    "smaller than target.yaml says; measure the print and correct tagSize",
                    percent);
  if (std::abs(off) > options.scale_failure) {
    verdict.failed(text);
  } else if (result.intrinsics.spacing.empty() && !print_size_contradicts(result, options)) {
    verdict.note(text);  // The print says it better, where it was seen.
  }
}

// A distortion model that another one beats: what that does, and how to have the other one.
void judge_model(const IntrinsicsContradiction& found, Verdict& verdict) {
  if (!found.camera_from_lidar) {
    verdict.doubtful(
        Message("the images contradict the intrinsics: %1; calibrate the camera again with it",
                found.what));
    return;
  }
  const std::string move_mm = formatted("%.1f", found.move_mm);
  const std::string move_mrad = formatted("%.2f", found.move_mrad);
  if (found.matters) {
    verdict.doubtful(
        Message("the images contradict the intrinsics: %1; with it the extrinsic moves by %2 mm "
                "and %3 mrad; calibrate the camera again with it",
                found.what, move_mm, move_mrad));
  } else {
    verdict.note(
        Message("the images contradict the intrinsics: %1; with it the extrinsic moves by %2 mm "
                "and %3 mrad, less than what matters",
                found.what, move_mm, move_mrad));
  }
}

// Whether the images alone say that the camera is another one. What misses its model then does so
// for that reason; what is wrong besides shows once the camera is right.
bool another_camera(const CalibrationResult& result) {
  const auto& found = result.intrinsics.contradiction;
  return found && !found->by_ranges && (found->turned_deg > 0 || found->modelled || found->matters);
}

// Given intrinsics that corners and returns contradict: what is wrong, how large, what it does.
void judge_intrinsics(const CalibrationResult& result, const QualityOptions& options,
                      Verdict& verdict) {
  if (!result.intrinsics.spacing.empty()) {
    verdict.doubtful(Message("the images contradict target.yaml: %1; measure the print",
                             result.intrinsics.spacing));
  }
  if (!result.intrinsics.contradiction) return;
  const IntrinsicsContradiction& found = *result.intrinsics.contradiction;
  // Ranges at which the board seems to be of another size contradict a camera, too.
  if (found.by_ranges && print_is_scaled(result, options)) return;
  if (found.turned_deg > 0) {
    verdict.doubtful(Message(
        "the images contradict the intrinsics: %1; turn them, and switch off what turns images, or "
        "calibrate the camera from images as they are",
        describe_turn(found.turned_deg)));
    return;
  }
  if (found.modelled) {
    verdict.doubtful(
        Message("the images contradict the intrinsics: %1; the model takes that out of the images, "
                "so that the extrinsic is for a camera without it: calibrate the camera again, or "
                "use --intrinsics free",
                found.what));
    return;
  }
  if (found.better_model) {
    judge_model(found, verdict);
    return;
  }
  if (result.intrinsics.mode == IntrinsicsMode::kPrior) {
    verdict.doubtful(
        Message("the images contradict the standard deviations of the intrinsics: %1; calibrate "
                "the camera again, or use --intrinsics free",
                found.what));
    return;
  }
  const bool moves = found.camera_from_lidar.has_value();
  const std::string move_mm = formatted("%.1f", found.move_mm);
  const std::string move_mrad = formatted("%.2f", found.move_mrad);
  if (found.by_ranges && found.matters && moves) {
    verdict.doubtful(
        Message("images and ranges together contradict the intrinsics: %1; with that freed the "
                "extrinsic moves by %2 mm and %3 mrad; calibrate the camera again, or use "
                "--intrinsics free, unless lvcalib discover finds an effect of the LiDAR",
                found.what, move_mm, move_mrad));
    return;
  }
  if (found.matters) {
    verdict.doubtful(
        moves ? Message("the images contradict the intrinsics: %1; with that freed the extrinsic "
                        "moves by %2 mm and %3 mrad; calibrate the camera again, or use "
                        "--intrinsics free",
                        found.what, move_mm, move_mrad)
              : Message("the images contradict the intrinsics: %1; calibrate the camera again, or "
                        "use --intrinsics free",
                        found.what));
  } else {
    verdict.note(
        moves ? Message("the images contradict the intrinsics: %1; with that freed the extrinsic "
                        "moves by %2 mm and %3 mrad, less than what matters",
                        found.what, move_mm, move_mrad)
              : Message("the images contradict the intrinsics: %1, less than what matters",
                        found.what));
  }
}

// Where estimated intrinsics rest on no corner.
void note_unreached(const CalibrationResult& result, Verdict& verdict) {
  if (result.intrinsics.mode == IntrinsicsMode::kFixed) return;
  std::vector<Eigen::Vector2d> pixels;
  const auto add = [&](const BoardView& view) {
    for (const CornerObservation& corner : view.corners) pixels.push_back(corner.pixel);
  };
  for (const SceneResult& scene : result.scenes) {
    if (scene.used && scene.view) add(*scene.view);
  }
  for (const BoardImage& image : result.intrinsics.extra_images) {
    if (image.used()) add(*image.view);
  }
  if (pixels.empty()) return;
  const Message text = describe_unreached(unreached_parts(pixels, result.camera));
  if (!text.empty()) verdict.note(text);
}

// Standard deviations along the worst axis: of the LiDAR's position and of the rotation. Directions
// that only noise keeps from being undetermined come out as decimetres or metres.
void judge_precision(const ExtrinsicSolution& x, const QualityOptions& options, Verdict& verdict) {
  Eigen::Matrix<double, 3, 6> position;
  position << Eigen::Matrix3d::Identity(), -skew(x.camera_from_lidar.transform.translation);
  const Matrix6d& covariance = x.camera_from_lidar.covariance;
  const double sigma_m = largest_sigma(position * covariance * position.transpose());
  const double sigma_rad = largest_sigma(covariance.bottomRightCorner<3, 3>());
  if (sigma_m > options.max_sigma_translation_m || sigma_rad > options.max_sigma_rotation_rad) {
    verdict.failed(
        Message("the scenes leave the extrinsic open: ± %1 mm and ± %2 mrad along the worst axes; "
                "add scenes with the board turned differently",
                formatted("%.0f", 1e3 * sigma_m), formatted("%.1f", 1e3 * sigma_rad)));
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
  // The planes' two groups are told by the middle level and mix what the model keeps apart, as some
  // darker returns see an edge: its own size is the better one, and what it leaves shows in its
  // residuals.
  if (result.modelled_dark_offset_m * offset > 0.0) return;
  if (std::abs(offset) < options.max_dark_offset_m || std::abs(offset) < 5.0 / std::sqrt(weight))
    return;
  const std::string size =
      formatted("%.1f ± %.1f", 1e3 * std::abs(offset), 1e3 / std::sqrt(weight));
  verdict.doubtful(
      offset > 0
          ? Message(
                "darker returns lie %1 mm farther than brighter ones: the LiDAR's range depends "
                "on the reflectivity, an effect is missing in the model",
                size)
          : Message("darker returns lie %1 mm nearer than brighter ones: the LiDAR's range depends "
                    "on the reflectivity, an effect is missing in the model",
                    size));
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
    const std::string percent =
        formatted("%.2f ± %.2f", 100.0 * std::abs(off), 100.0 * relative.sigma);
    verdict.doubtful(
        off > 0 ? Message("scene %1: its board measures %2 % larger than in the other scenes: is "
                          "it another print?",
                          scene.name, percent)
                : Message("scene %1: its board measures %2 % smaller than in the other scenes: is "
                          "it another print?",
                          scene.name, percent));
  }
}

// A scanner of few lines measures circles in no scene: one note instead of one for each. Whether
// it was said.
bool note_missing_circles(const CalibrationResult& result, Verdict& verdict) {
  constexpr std::size_t kMany = 3;  // Two are named one by one, with why.
  std::vector<std::string> names;
  std::size_t used = 0;
  for (const SceneResult& scene : result.scenes) {
    used += scene.used ? 1 : 0;
    if (scene.used && scene.without_circles) names.push_back(scene.name);
  }
  if (names.size() < kMany) return false;
  verdict.note(
      names.size() == used
          ? Message("circles cannot be measured in any scene (too few lines or points, or "
                    "intensities in coarse steps): the prints as a whole, planes and corners are "
                    "used instead")
          : Message("circles cannot be measured in scenes %1 (too few lines or points, or "
                    "intensities in coarse steps): their prints as a whole, planes and corners "
                    "are used instead",
                    joined(names, ", ")));
  return true;
}

// Whether planes that miss the ranges mean something. A footprint across print pulls its range;
// on few lines that does not average out, and a plane that knows nothing of it misses by more than
// its noise. The joint solve knows, and asks of every kind of shared error whether it is there.
bool planes_tell(const CalibrationResult& result) {
  if (!result.forward || !result.forward->converged) return true;
  constexpr std::array kInRanges{SharedError::kRangeShape,  SharedError::kBoardNormal,
                                 SharedError::kBoardTilt,   SharedError::kLineRange,
                                 SharedError::kSensorRange, SharedError::kSensorDark,
                                 SharedError::kSensorLine};
  return std::any_of(kInRanges.begin(), kInRanges.end(), [&](SharedError kind) {
    return result.forward->noise.admitted[static_cast<std::size_t>(kind)];
  });
}

// What nodes and planes miss the model by, and the scene that fits clearly worse than the others,
// if there is one.
Message misfit(const ExtrinsicSolution& x) {
  const std::string planes = formatted("%.1f", x.plane_scale);
  // Boards without circles have planes alone.
  const Message how =
      x.uses_nodes()
          ? Message("LiDAR residuals are %1 times (nodes) and %2 times (planes) their noise",
                    formatted("%.1f", x.node_scale), planes)
          : Message("the boards' planes miss the LiDAR's ranges by %1 times their noise", planes);
  const Message all = Message("%1: an effect is missing in the model", how);
  constexpr double kClearly = 2.0;
  const SceneSolution* worst = nullptr;
  for (const SceneSolution& scene : x.scenes) {
    if (scene.used && (worst == nullptr || scene.rms_mm > worst->rms_mm)) worst = &scene;
  }
  if (worst == nullptr) return all;
  std::vector<double> others;
  for (const SceneSolution& scene : x.scenes) {
    if (scene.used && &scene != worst) others.push_back(scene.rms_mm);
  }
  if (others.empty()) return all;
  const double usual = median(std::move(others));
  if (!(worst->rms_mm > kClearly * usual)) return all;
  // Metres say only that the circles were not found; the number would say nothing.
  constexpr double kMeaningful_mm = 100.0;
  if (worst->rms_mm > kMeaningful_mm) {
    return Message("%1: an effect is missing in the model; scene %2 misses most", how, worst->name);
  }
  // What an effect does differs between scenes by their distances and tilts, a few times at most.
  constexpr double kAlone = 5.0;
  if (worst->rms_mm > kAlone * usual) {
    return Message(
        "%1; scene %2 misses most: %3 mm, the others %4 mm: did the board or a sensor move while "
        "it was taken, or is an effect missing in the model?",
        how, worst->name, formatted("%.1f", worst->rms_mm), formatted("%.1f", usual));
  }
  return Message(
      "%1: an effect is missing in the model; scene %2 misses most: %3 mm, the others %4 mm", how,
      worst->name, formatted("%.1f", worst->rms_mm), formatted("%.1f", usual));
}

// Residuals beyond their noise, of whatever cause.
void judge_residuals(const CalibrationResult& result, const QualityOptions& options,
                     Verdict& verdict) {
  const ExtrinsicSolution& x = result.extrinsic;
  if (result.model_fit) {
    // Planes and circles, one number for many returns, tell less.
    if (!(result.modelled_range_misfit > options.max_noise_scale)) return;
    verdict.doubtful(
        Message("ranges miss the model by %1 times their noise: another effect is missing in the "
                "model",
                formatted("%.1f", result.modelled_range_misfit)));
  } else if (x.node_scale > options.max_noise_scale ||
             (x.plane_scale > options.max_noise_scale && planes_tell(result))) {
    verdict.doubtful(misfit(x));
  }
}

// What a search leaves: an effect that it would add, and structure that moves the extrinsic by more
// than the tolerance.
void judge_missing(const CalibrationResult& result, Verdict& verdict) {
  if (!result.lacking.empty()) {
    verdict.doubtful(
        Message("scenes held out speak for an effect that the model lacks: %1", result.lacking));
  }
  for (const StructureScore& s : result.unexplained) {
    verdict.doubtful(
        Message("the %1 channel shows structure over %2 that no effect of the model explains; it "
                "could move the extrinsic by %3 mm and %4 mrad",
                word_for(s.channel), covariates_named(s.covariates()),
                formatted("%.1f", 1e3 * s.extrinsic_move.translation_m),
                formatted("%.2f", 1e3 * s.extrinsic_move.rotation_rad)));
  }
}

// What corners miss their model by beyond their noise. Were it alike in all scenes, it would turn
// the camera by the angle that it subtends, and move it by as much at the boards' distance.
void judge_corners(const CalibrationResult& result, const QualityOptions& options,
                   Verdict& verdict) {
  const ExtrinsicSolution& x = result.extrinsic;
  const double noise_px = result.intrinsics.replicate_px;
  if (x.sigma_px > options.max_sigma_px && !(noise_px > 0.0)) {
    verdict.doubtful(
        Message("tag corners miss their model by %1 px: check the intrinsics and that the board is "
                "flat",
                formatted("%.2f", x.sigma_px)));
  }
  const auto misfit = corner_misfit(result);
  if (!misfit) return;
  // What another camera, another distortion model or another print mends is told as that.
  if (another_camera(result) || !result.intrinsics.spacing.empty()) return;
  const auto& contradiction = result.intrinsics.contradiction;
  if (contradiction && (noise_px > 0.0 ? contradiction->better_model &&
                                             contradiction->better_px < kCornersMiss * noise_px
                                       : contradiction->matters))
    return;
  std::vector<double> distances;
  for (const SceneSolution& scene : x.scenes) {
    if (scene.used) distances.push_back(scene.camera_from_board.translation.norm());
  }
  if (distances.empty()) return;
  const double turn = std::sqrt(misfit->px * misfit->px - misfit->noise_px * misfit->noise_px) /
                      std::min(result.camera.fx, result.camera.fy);
  const double shift_m = turn * median(std::move(distances));
  if (turn < options.tolerance_rad && shift_m < options.tolerance_m) return;
  verdict.doubtful(Message(
      "tag corners miss their model by %1 px, where their own noise is %2 px: that may move "
      "the extrinsic by up to %3 mm and %4 mrad; check the intrinsics, the sizes in "
      "target.yaml and that the board is flat",
      formatted("%.2f", misfit->px), formatted("%.2f", misfit->noise_px),
      formatted("%.1f", 1e3 * shift_m), formatted("%.2f", 1e3 * turn)));
}

// Scenes that are out of use for one reason.
struct UnusedScenes {
  Message reason;
  std::vector<std::string> names;
  // The image shows the board, and the cloud shows none where the other scenes say: scenes that
  // contradict them are worth more than a note.
  bool contradict = false;
};

// Equal reasons once.
std::vector<UnusedScenes> unused_scenes(const CalibrationResult& result) {
  std::vector<UnusedScenes> by_reason;
  for (const SceneResult& scene : result.scenes) {
    if (scene.used || scene.reason.empty() || scene.rejected) continue;
    auto same = std::find_if(by_reason.begin(), by_reason.end(),
                             [&](const auto& r) { return r.reason == scene.reason; });
    if (same == by_reason.end()) same = by_reason.insert(same, {scene.reason, {}, false});
    same->names.push_back(scene.name);
    same->contradict = same->contradict || scene.contradicts;
  }
  return by_reason;
}

Message in_short(const std::vector<UnusedScenes>& unused) {
  constexpr std::size_t kMost = 6;  // As many reasons as a reader takes in at once.
  std::vector<Message> out;
  for (std::size_t k = 0; k < unused.size() && k < kMost; ++k)
    out.push_back(Message("scene %1: %2", joined(unused[k].names, ", "), unused[k].reason));
  if (unused.size() > kMost) out.push_back(Message("and more"));
  return joined(out, "; ");
}

void judge_unused(const CalibrationResult& result, Verdict& verdict) {
  for (const UnusedScenes& unused : unused_scenes(result)) {
    const std::string names = joined(unused.names, ", ");
    const Message text = unused.names.size() == 1
                             ? Message("scene %1 is not used: %2", names, unused.reason)
                             : Message("scenes %1 are not used: %2", names, unused.reason);
    if (unused.contradict) {
      verdict.doubtful(text);
    } else {
      verdict.note(text);
    }
  }
}

// One scene agrees with itself whatever is wrong.
void judge_count(const CalibrationResult& result, Verdict& verdict) {
  const int used = result.extrinsic.used_scenes;
  if (used == 2) {
    verdict.doubtful(
        Message("two scenes: a mistake in one of them could not be told from one in the other"));
  }
  if (used >= 2) return;
  const Message others = in_short(unused_scenes(result));
  verdict.doubtful(
      others.empty()
          ? Message("only one usable scene: nothing to check the result against; take two or more")
          : Message("only one usable scene: nothing to check the result against; take two or more; "
                    "%1",
                    others));
}

// Image and cloud of one place and time belong together: two scenes cannot share one of them.
void judge_shared_files(const CalibrationResult& result, Verdict& verdict) {
  for (const SceneResult& scene : result.scenes) {
    if (!scene.shared_file.empty()) verdict.doubtful(scene.shared_file);
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
    scales.push_back(s.refinement->scale - s.modelled_scale);
    sigmas.push_back(s.refinement->scale_sigma);
  }
  if (!scene.used || !scene.refinement || scene.refinement->scale_sigma <= 0 || scales.size() < 3)
    return {};
  // A median's variance is π/2 of a mean's.
  const double count = static_cast<double>(scales.size());
  const double of_median = median(std::move(sigmas)) * std::sqrt(std::numbers::pi / 2.0 / count);
  return {(scene.refinement->scale - scene.modelled_scale) / median(std::move(scales)),
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
    sum += w * (scene.refinement->scale - scene.modelled_scale);
  }
  if (weight <= 0) return {};
  return {sum / weight, 1.0 / std::sqrt(weight)};
}

void judge_quality(CalibrationResult& result, const QualityOptions& options) {
  Verdict verdict(result);
  verdict.start();
  const ExtrinsicSolution& x = result.extrinsic;
  judge_intrinsics(result, options, verdict);
  judge_shared_files(result, verdict);
  if (const Message unseen = diagnose_unseen_tags(result); !unseen.empty())
    verdict.doubtful(unseen);
  // Circles are measured through the camera.
  const bool camera = another_camera(result);
  if (const Message radius = better_circle_radius(result); !camera && !radius.empty())
    verdict.doubtful(Message("the images contradict target.yaml: %1; measure the print", radius));
  judge_count(result, verdict);
  const Message bump = diagnose_bump(result);
  if (!bump.empty()) verdict.doubtful(bump);
  if (x.rank < 6)
    verdict.failed(
        Message("the scenes determine only %1 of 6 directions of the extrinsic", x.rank));
  if (!result.forward_failure.empty()) {
    verdict.note(
        Message("the model of every return could not be solved (%1): the extrinsic rests on nodes, "
                "planes and corners",
                result.forward_failure));
  }
  if (result.forward && !result.forward->converged) {
    verdict.note(
        Message("the joint solve has not come to rest after %1 steps", result.forward->iterations));
  }
  if (result.forward) judge_print(result, options, verdict);
  judge_place(result, verdict);
  judge_precision(x, options, verdict);
  judge_scale(result, options, verdict);
  judge_dark_offset(result, options, verdict);
  judge_scene_scales(result, options, verdict);
  // A cause that is named explains what misses because of it; nobody is sent after that as well. A
  // wrong camera or print makes scenes contradict each other by where their boards were.
  const bool by_images = camera || !result.intrinsics.spacing.empty();
  if (!by_images) {
    judge_splits(result, verdict);
    judge_leverage(result, verdict);
    if (bump.empty()) judge_bump(result, verdict);
  }
  // What trails along the scan may look like a small bump, and is told beside it.
  bool named = by_images || !bump.empty();
  if (!named) named = judge_scans(result, options, verdict);
  if (!result.unverified.empty()) verdict.note(result.unverified);
  judge_corners(result, options, verdict);
  judge_missing(result, verdict);
  if (!named) judge_residuals(result, options, verdict);
  if (result.target.has_circles() && x.rms_mm > 1e3 * result.target.circle_radius_m) {
    verdict.doubtful(
        Message("the circles' centres miss the model by more than their radius: the clouds do not "
                "show them"));
  }
  judge_second_board(result, verdict);
  if (x.used_scenes > 1 && result.consensus.margin() < options.min_margin) {
    verdict.doubtful(Message("another assignment of the board is nearly as good (margin %1)",
                             formatted("%.1f", result.consensus.margin())));
  }
  note_unreached(result, verdict);
  const bool told = note_missing_circles(result, verdict);
  // Behind what is wrong, which may be why they are weak.
  for (const Message& direction : x.weak_directions) verdict.doubtful(direction);
  // Of a single scene that is used it was said why the others are not.
  if (x.used_scenes > 1) judge_unused(result, verdict);
  for (const SceneResult& scene : result.scenes) {
    for (const Message& w : scene.cloud_warnings) verdict.note(about_cloud(scene.name, w));
    if (scene.used && scene.view) {
      for (const Message& w : scene.view->warnings)
        verdict.note(Message("scene %1: %2", scene.name, w));
    }
    if (scene.used && !scene.objection.empty())
      verdict.doubtful(Message("scene %1 is used all the same, as you decided, though %2",
                               scene.name, scene.objection));
    if (!scene.refinement || !scene.used || (told && scene.without_circles)) continue;
    for (const Message& w : scene.refinement->warnings)
      verdict.note(Message("scene %1: %2", scene.name, w));
  }
}

}  // namespace lvcalib
