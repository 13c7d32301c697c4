// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/progress.h"
#include "pipeline/crop_box.h"
#include "pipeline/dataset.h"
#include "pipeline/input_hashes.h"
#include "pipeline/intrinsics_stage.h"
#include "pipeline/options.h"
#include "pipeline/scene_edits.h"
#include "pipeline/stage_cache.h"
#include "response/boundary_response.h"
#include "selection/discovery.h"
#include "solve/forward_solver.h"
#include "solve/method_comparison.h"
#include "solve/uncertainty_report.h"

namespace lvcalib {

/// Wall time of each stage in milliseconds. Stages of different scenes run at the same time: load,
/// detect, localize and refine are sums over scenes; total is the clock on the wall.
struct StageTimes {
  double load_ms = 0, detect_ms = 0, localize_ms = 0, refine_ms = 0, optimize_ms = 0,
         response_ms = 0, total_ms = 0;
};

/// Everything found in one scene; what a stage did not reach is empty.
struct SceneResult {
  std::string name;
  bool used = false;
  Message reason;           ///< Why it is not used, in words.
  bool unreadable = false;  ///< Left out because of its files, not of what they show.
  bool rejected = false;    ///< Left out by the user; nothing need speak against it.
  bool insisted = false;    ///< The user wants it used, whatever speaks against it.
  SceneEdits edits;         ///< What the user left out by hand, or wants used.
  /// Insisted on: what spoke against it.
  Message objection;
  /// The sentence that its image or its cloud, and only one of the two, is another scene's.
  Message shared_file;
  std::vector<Message> cloud_warnings;   ///< Why its cloud's file may not be whole.
  bool contradicts = false;              ///< Left out because it disagrees with the other scenes.
  bool turned_image = false;             ///< So because its image is turned; see TurnedImages.
  BoardPlace place = BoardPlace::kOpen;  ///< What is where the other scenes put its board.
  bool without_circles = false;          ///< They cannot be measured; the print as a whole is used.
  /// The LiDAR sees the board but not its print: `search` goes by the outline, and the intensity of
  /// `board_points` is left out.
  bool no_contrast = false;
  std::optional<BoardView> view;                    ///< Without the corners below.
  std::vector<CornerObservation> left_out_corners;  ///< Of tags that the user left out.
  /// Of tags that the program refused for good, since others that it refused are used all the same.
  std::vector<CornerObservation> refused_corners;
  std::optional<BoardSearchResult> search;
  std::optional<std::size_t> chosen;  ///< Candidate that all scenes agree on.
  Cloud board_points;                 ///< Full-density points about the board.
  Cloud left_out_points;              ///< Of them, those that the user left out.
  std::optional<BoardRefinement> refinement;
  /// By which share its board looks larger than the target says by the model with effects.
  double modelled_scale = 0.0;
  /// The circles refined exactly as the paper prints it, for the method joint_paper; empty where
  /// `refinement` has none.
  std::vector<RefinedNode> paper_nodes;
};

enum class Quality { kGood, kDoubtful, kFailed };
std::string name_of(Quality quality);

/// An effect in the model of a calibration.
struct ModelEffect {
  std::string id;
  std::vector<ParameterEstimate> parameters;
  double shape = 0.0;  ///< Its shape number (a period, a decay length); 0 if it has none.
  double shape_sigma = 0.0;
  std::string spec = {};  ///< Of a user's own effect; see make_user_effect().
};

/// One step of the way from the paper's method to the result.
struct AblationStep {
  std::string change;   ///< What is other than in the step before, in words.
  MethodResult method;  ///< Its translation_mm and rotation_mrad are those to the final extrinsic.
};

/// A finished calibration.
struct CalibrationResult {
  std::string dataset;
  CalibrationOptions options;  ///< What it was made with; what follows goes on with them.
  Target target;
  Camera camera;  ///< As used: the given one, or the estimated one (see intrinsics).
  IntrinsicsReport intrinsics;
  std::vector<SceneResult> scenes;
  SceneConsensus consensus;
  std::shared_ptr<const BlurredPrint> print;  ///< Of the target; shared by every solve.
  ExtrinsicSolution extrinsic;                ///< Of the forward model where it could be solved.
  /// The forward model behind it; empty where the nodes and planes alone had to do.
  std::optional<ForwardSolution> forward;
  Message forward_failure;         ///< Why it is empty, in words.
  std::vector<ModelEffect> model;  ///< Effects beyond the base model; see discover().
  std::vector<BudgetItem> budget;  ///< What effects left out could still do; see discover().
  /// The extrinsic's covariance with what faults that are left out could still do to it: errors of
  /// held intrinsics, of ranges, angles and the origin of the beams, all of usual size (see
  /// total_covariance()).
  Matrix6d covariance_total = Matrix6d::Zero();
  /// Whether the scenes would have shown intrinsics that are wrong by what matters.
  bool verified = false;
  Message unverified;  ///< Why not, and what would: a sentence. Empty if verified.
  /// The extrinsic's covariance with the budget; zero before discover().
  Matrix6d covariance_with_budget = Matrix6d::Zero();
  ModelScales model_scales;             ///< What the numbers of the model refer to.
  double modelled_dark_offset_m = 0.0;  ///< How much farther black reads than white by the model.
  /// By which share the print looks larger than the target says by the model, along x and y.
  Eigen::Vector2d modelled_print_scale = Eigen::Vector2d::Zero();
  /// Of the range rows under the model with effects: RMS over noise floor. 0 without effects.
  double modelled_range_misfit = 0.0;
  /// Structure that the model leaves and that matters, once it was looked for.
  std::vector<StructureScore> unexplained;
  /// An effect that scenes held out speak for and the model lacks; empty if there is none, or
  /// nobody has looked.
  std::string lacking;
  /// What the scenes give one by one with the model's effects; null without effects.
  std::shared_ptr<const ModelFit> model_fit;
  std::vector<MethodResult> methods;   ///< The paper's objectives on the scenes in use.
  std::vector<AblationStep> ablation;  ///< If the options ask for it; see ablate().
  UncertaintyReport uncertainty;
  BoundaryResponse response;  ///< Of the scenes in use.
  Quality quality = Quality::kFailed;
  Message quality_reason;                ///< Why the quality is not good, in words.
  std::vector<Message> quality_reasons;  ///< Everything that speaks against "good".
  std::vector<Message> warnings;
  std::vector<Message> verdict_warnings;  ///< Those of them that judge_quality() gave.
  std::vector<InputFile> inputs;          ///< The files read, with their SHA-256.
  StageTimes times;
};

/// What the joint solve says of a scene; null if the scene had no part in it.
const SceneSolution* solution_of(const CalibrationResult& result, const std::string& scene);

/// What to run besides the dataset.
struct CalibrationRequest {
  CalibrationOptions options;
  std::optional<Rigid3> guess;  ///< Rough T_camera_lidar; narrows the search.
  bool use_crops = false;       ///< Take scenes/NAME/board.pcd instead of cloud.pcd where present.
  std::vector<std::string> rejected;  ///< Scenes to leave out.
  /// Scenes to use though they contradict the others or show too few circles. What has no board in
  /// image or cloud cannot be used all the same.
  std::vector<std::string> insisted;
  UnusableScenes unusable = UnusableScenes::kRefuse;
  /// By scene: what the user left out by hand, or wants used.
  std::map<std::string, SceneEdits> edits;
  /// By scene: only the cloud's points inside the box are looked at.
  std::map<std::string, CropBox> crop_boxes;
};

/// The whole calibration: load, detect, localize, refine, optimise.
/// Errors: kInput for unusable files or images (named), kUntrusted if the board is not found or
/// the scenes do not determine an extrinsic, kCancelled.
Result<CalibrationResult> calibrate(const Dataset& dataset, const CalibrationRequest& request,
                                    const RunContext& context);

/// Sees a calibration while it runs. Called from worker threads, for different scenes perhaps at
/// the same time; the references hold during the call only.
struct CalibrationObserver {
  /// Before a scene's refinement: the points it will work on.
  std::function<void(std::size_t scene, const Cloud& board_points)> board_points;
  /// After each iteration of a scene's refinement.
  std::function<void(std::size_t scene, const BoardRefinement& so_far)> iteration;
};

/// The same, taking from `cache` what was made from the same things before and keeping there what
/// is new, also when it is cancelled or fails.
Result<CalibrationResult> calibrate(const Dataset& dataset, const CalibrationRequest& request,
                                    const RunContext& context, StageCache& cache,
                                    const CalibrationObserver& observer = {});

/// True if a scene's features can take part in a solve: a view, a refinement and, on boards with
/// circles, three usable ones.
bool can_be_used(const SceneResult& scene, const Target& target);

/// Leaves a scene out because the user does not want it, and says so as its reason.
void reject(SceneResult& scene);

/// Solves again from kept features with other scenes in use (`use` per scene): extrinsic, methods,
/// uncertainty, boundary response, quality. A fraction of a second.
Result<CalibrationResult> resolve_calibration(CalibrationResult result,
                                              const std::vector<bool>& use,
                                              const CalibrationOptions& options,
                                              const RunContext& context = {});

}  // namespace lvcalib
