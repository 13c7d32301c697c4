// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "base/error.h"
#include "base/progress.h"
#include "camera/camera.h"
#include "pipeline/board_images.h"
#include "pipeline/dataset.h"
#include "pipeline/options.h"
#include "solve/feature_solver.h"
#include "solve/intrinsics_fit.h"
#include "solve/total_uncertainty.h"

namespace lvcalib {

struct CalibrationResult;

/// That corners and returns contradict the given intrinsics, and what mends it.
struct IntrinsicsContradiction {
  Message what;  ///< "the focal length is 10.0 ± 0.1 % too long"
  IntrinsicsContrast contrast;
  /// The extrinsic with what is wrong freed, if it could be solved.
  std::optional<UncertainRigid3> camera_from_lidar;
  double move_mm = 0.0;    ///< Between that and the result: of the LiDAR's position,
  double move_mrad = 0.0;  ///< and of the rotation.
  bool matters = true;     ///< More than the tolerance.
  /// Only images and ranges together say so: it may be an effect on the ranges.
  bool by_ranges = false;
  /// Another distortion model predicts held-out images better: no values of the given one mend
  /// that. `camera_from_lidar` is then solved with it.
  std::optional<DistortionModel> better_model;
  /// RMS of a corner's coordinate with it, in all images.
  double better_px = 0.0;
  /// The images agree with the given intrinsics once all are turned counterclockwise by so much.
  int turned_deg = 0;
  /// The model in force has it, as an effect: the extrinsic is for a camera without it.
  bool modelled = false;
};

/// What is known of the camera, before and after.
struct IntrinsicsReport {
  IntrinsicsMode mode = IntrinsicsMode::kFixed;
  Camera given;
  /// Standard deviations of the given intrinsics: stated in camera.yaml, or typical ones.
  IntrinsicsVector prior_sigma = IntrinsicsVector::Zero();
  bool stated = false;  ///< In camera.yaml.
  /// Of the estimated ones (prior, free); 0 where held.
  IntrinsicsVector sigma = IntrinsicsVector::Zero();
  /// Images of intrinsics/, and what those in use say about the intrinsics (with `fixed`: about the
  /// given camera, for the check).
  std::vector<BoardImage> extra_images;
  std::optional<IntrinsicsEvidence> evidence;
  double replicate_px = 0.0;  ///< Corner noise of replicates; 0 where there are none.
  std::optional<IntrinsicsContradiction> contradiction;
  Message spacing;  ///< See better_spacing(); empty if the tags lie where the target has them.
};

/// The report of a dataset before anything has been looked at.
IntrinsicsReport start_intrinsics(const Dataset& dataset, IntrinsicsMode mode);

/// With `prior` and `free`: puts a camera into the result that fits the corners of all images,
/// those of intrinsics/ included, and the boards' poses under it; what follows starts there. With
/// `fixed` the camera stays. What the images of intrinsics/ say goes into the report's `evidence`,
/// which the joint solve takes as a prior with all its correlations; linearized about a camera that
/// fits all corners, as it holds nearby only.
void free_camera(CalibrationResult& result);

/// Standard deviations with which the joint solve draws the intrinsics to the given ones.
IntrinsicsVector solve_prior(const IntrinsicsReport& report);

/// What corners miss their model by, where that is more than their noise.
struct CornerMisfit {
  double px = 0.0;
  double noise_px = 0.0;
};

/// Corners miss by more than their noise from this ratio on: four times the square, with dozens of
/// them no chance.
inline constexpr double kCornersMiss = 2.0;

/// Boards with corners enough for replicates: what poses of their own leave, if it is more than
/// kCornersMiss times what replicates scatter. Boards without, as a single tag: what the joint
/// solve leaves of their corners, if it is as much more than what poses of their own leave, and
/// more than chance makes it (F-test with the false alarm of IntrinsicsOptions); a pose follows few
/// corners, whatever the camera is. Not under a model with effects.
std::optional<CornerMisfit> corner_misfit(const CalibrationResult& result);

/// Sizes of the faults that the calibration's solve leaves out.
LeftOutSizes left_out_sizes(const CalibrationResult& result);

/// In words that images contradict intrinsics because they are turned.
Message describe_turn(int degrees);

/// If the images' corners alone contradict the given intrinsics: in words what is wrong.
Message contradicted_by_corners(const CalibrationResult& result);

/// Where corners scatter more than twice as much as their replicates, whatever the intrinsics,
/// three quarters of what is left are not noise: then, on a grid of tags, the spacing that fits
/// best, if it leaves less than half of it. "tagSpacing: 0.8333 would fit (…)"; empty if there is
/// none.
Message better_spacing(const std::vector<CornerView>& views, const Target& target,
                       const Camera& given);
/// The same for the scenes' images.
Message better_spacing(const CalibrationResult& result);

/// Sets `verified`: whether the scenes leave intrinsics open that would move the extrinsic by more
/// than three tolerances (95 % limit, to first order about the solution), and which scene would
/// tell.
void verify_intrinsics(CalibrationResult& result);

/// A board's corners without what effects do to their images.
using CornersWithout = std::function<std::vector<CornerObservation>(
    const std::vector<CornerObservation>& corners, const Rigid3& camera_from_board)>;

/// What images say against target and given intrinsics, asked again under a model with effects:
/// `others` takes out those that are not errors of the intrinsics, `all` every one. Nothing is
/// withdrawn where no effect touches the images.
void ask_images_again(CalibrationResult& result, const CornersWithout& others,
                      const CornersWithout& all);

/// With `fixed`: asks whether corners and returns contradict the given intrinsics, by a second
/// solve with them freed wherever a first look leaves it open. With `prior` against what
/// camera.yaml states. `nodes` is the solve that the result started from. Errors: kCancelled.
Status check_intrinsics(CalibrationResult& result,
                        const std::vector<SceneObservations>& observations,
                        const std::vector<std::size_t>& index, const ExtrinsicSolution& nodes,
                        const RunContext& context);

}  // namespace lvcalib
