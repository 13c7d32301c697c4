// SPDX-License-Identifier: BSD-3-Clause
// The part of the calibration that is done again when scenes are ticked or unticked.
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "pipeline/ablation.h"
#include "pipeline/calibration.h"
#include "pipeline/forward_stage.h"
#include "pipeline/quality.h"
#include "pipeline/refusals.h"
#include "pipeline/stopwatch.h"
#include "pipeline/verdict.h"

namespace lvcalib {
namespace {

// The boundary response of the scenes in use.
Status respond(CalibrationResult& result, const Target& target, const CalibrationOptions& options,
               const RunContext& context) {
  const auto start = Clock::now();
  std::vector<ResponseInput> inputs;
  for (const SceneResult& scene : result.scenes) {
    if (scene.used && scene.refinement && !scene.refinement->nodes.empty())
      inputs.push_back(
          {scene.name, &scene.board_points, &*scene.refinement, covered_parts(result, scene.name)});
  }
  auto response = calibrate_boundary_response(inputs, target, options.response, context);
  if (!response) return response.error();
  result.response = std::move(*response);
  result.times.response_ms = ms_since(start);
  return Done{};
}

ForwardOptions forward_options(const CalibrationResult& result) {
  ForwardOptions how = result.options.forward;
  how.intrinsics_sigma = solve_prior(result.intrinsics);
  how.intrinsics_evidence = result.intrinsics.evidence;
  how.first_camera = result.camera;
  return how;
}

// Every corner and return in one model; where that fails, what nodes and planes say stands. With
// the intrinsics freed, `nodes` is solved again under the camera that comes out.
Status solve_forward_model(CalibrationResult& result, const FeatureInput& in,
                           const std::vector<std::size_t>& index, ExtrinsicSolution& nodes,
                           const RunContext& context) {
  ForwardOptions how = forward_options(result);
  auto forward = solve_every_return(result, in.scenes, index, nodes, how, context);
  if (forward && result.intrinsics.mode != IntrinsicsMode::kFixed) {
    // The start rested on a camera that the corners alone had given. With the better one scenes may
    // come back, and nodes and planes are judged by it.
    result.camera = forward->state.camera;
    how.first_camera = result.camera;
    auto again = solve_extrinsic(in);
    if (again) {
      if (again->used_scenes != nodes.used_scenes)
        forward = solve_every_return(result, in.scenes, index, *again, how, context);
      nodes = std::move(*again);
    }
  }
  result.forward.reset();
  result.forward_failure = {};
  result.extrinsic = nodes;
  result.covariance_total = nodes.camera_from_lidar.covariance;
  if (!forward) {
    if (forward.error().kind == ErrorKind::kCancelled) return forward.error();
    // Where nothing is to be had from the returns the nodes' solution stands, and says so.
    result.forward_failure = forward.error().message;
    return Done{};
  }
  result.forward = std::move(*forward);
  result.camera = result.forward->state.camera;
  result.intrinsics.sigma = result.forward->globals_covariance.diagonal()
                                .segment<kIntrinsics>(kFirstIntrinsic)
                                .cwiseMax(0.0)
                                .cwiseSqrt();
  result.extrinsic =
      report_forward(pose_of(*result.forward), forward_subsets(*result.forward, nodes), nodes, in);
  result.covariance_total = total_covariance(*result.forward, left_out_sizes(result));
  return Done{};
}

bool corners_before(const CornerObservation& a, const CornerObservation& b) {
  return a.feature_id != b.feature_id ? a.feature_id < b.feature_id : a.corner < b.corner;
}

// Corners that were set aside for the sake of others are judged anew.
void take_back_refused(CalibrationResult& result) {
  for (SceneResult& scene : result.scenes) {
    if (!scene.view || scene.refused_corners.empty()) continue;
    auto& corners = scene.view->corners;
    corners.insert(corners.end(), scene.refused_corners.begin(), scene.refused_corners.end());
    std::stable_sort(corners.begin(), corners.end(), corners_before);
    scene.refused_corners.clear();
  }
}

// True if a solution refuses a tag or circle that the user wants used all the same. A circle whose
// centre could not be measured cannot be.
bool refuses_kept(const SceneEdits& edits, const SceneObservations& observed,
                  const SceneSolution& solved) {
  for (const CornerResidual& corner : solved.corners) {
    if (!corner.used && contains_id(edits.kept_tags, corner.feature_id)) return true;
  }
  for (std::size_t k = 0; k < solved.nodes.size(); ++k) {
    if (!solved.nodes[k].used && observed.nodes[k].valid &&
        contains_id(edits.kept_circles, solved.nodes[k].id))
      return true;
  }
  return false;
}

// Takes what a solution refused, but for what the user wants used, out for good.
void set_refused_aside(SceneResult& scene, SceneObservations& observed,
                       const SceneSolution& solved) {
  std::vector<CornerObservation> rest;
  for (std::size_t k = 0; k < solved.corners.size(); ++k) {
    const CornerObservation& corner = observed.corners[k];
    const bool stays =
        solved.corners[k].used || contains_id(scene.edits.kept_tags, corner.feature_id);
    (stays ? rest : scene.refused_corners).push_back(corner);
  }
  scene.view->corners = rest;
  observed.corners = std::move(rest);
  for (std::size_t k = 0; k < solved.nodes.size(); ++k) {
    if (!solved.nodes[k].used && !contains_id(scene.edits.kept_circles, solved.nodes[k].id))
      observed.nodes[k].valid = false;
  }
}

// The extrinsic by nodes and planes. Scenes, tags and circles that the user insists on stay in,
// whatever it says against them; then those that it refused otherwise are out for good, and nothing
// more of their kind is refused: `observations` and `options` become what was solved.
Result<ExtrinsicSolution> solve_with_insisted(CalibrationResult& result, const Target& target,
                                              const std::vector<std::size_t>& index,
                                              std::vector<SceneObservations>& observations,
                                              ExtrinsicOptions& options) {
  auto solution = solve_extrinsic({observations, result.camera, target, options});
  if (!solution) return solution;
  bool kept = false;
  for (std::size_t k = 0; k < index.size(); ++k) {
    kept = kept || (solution->scenes[k].used && refuses_kept(result.scenes[index[k]].edits,
                                                             observations[k], solution->scenes[k]));
  }
  if (kept) {
    for (std::size_t k = 0; k < index.size(); ++k) {
      if (solution->scenes[k].used)
        set_refused_aside(result.scenes[index[k]], observations[k], solution->scenes[k]);
    }
    options.rejection_gate = std::numeric_limits<double>::infinity();
  }
  bool any = false;
  for (std::size_t k = 0; k < index.size(); ++k) {
    SceneResult& scene = result.scenes[index[k]];
    if (!observations[k].use || solution->scenes[k].used || !scene.insisted) continue;
    scene.objection = solution->scenes[k].reason;
    any = true;
  }
  if (!any && !kept) return solution;
  for (std::size_t k = 0; k < index.size(); ++k) {
    SceneResult& scene = result.scenes[index[k]];
    if (!observations[k].use || solution->scenes[k].used || scene.insisted) continue;
    observations[k].use = false;
    scene.used = false;
    scene.reason = solution->scenes[k].reason;
    scene.contradicts = true;
  }
  options.reject_bad_scenes = false;
  return solve_extrinsic({observations, result.camera, target, options});
}

// What nodes and planes were solved from, how, and what came out.
struct NodesSolved {
  std::vector<SceneObservations>& observations;
  ExtrinsicOptions& options;
  ExtrinsicSolution& nodes;
};

// Circles that few lines cross are found beside their places, and put the whole extrinsic so far
// off that sound scenes contradict it. What nodes and planes have against scenes is therefore asked
// of every corner and return, with these scenes in: those that agree stay, and `solved` becomes
// what was solved then. Without returns that tell, the nodes' verdict stands.
Status reconsider_scenes(CalibrationResult& result, const Target& target,
                         const std::vector<std::size_t>& index, const NodesSolved& solved,
                         const RunContext& context) {
  auto& [observations, options, nodes] = solved;
  std::vector<std::size_t> suspects;
  for (std::size_t k = 0; k < observations.size(); ++k) {
    if (observations[k].use && !nodes.scenes[k].used) suspects.push_back(k);
  }
  if (suspects.empty()) return Done{};
  ExtrinsicOptions together = options;
  together.reject_bad_scenes = false;
  std::vector<SceneObservations> asked = observations;
  while (!suspects.empty()) {
    auto all = solve_extrinsic({asked, result.camera, target, together});
    if (!all) return Done{};
    const auto forward =
        solve_every_return(result, asked, index, *all, forward_options(result), context);
    if (context.stopped()) return Error::cancelled();
    if (!forward || !forward->uses_intensity) return Done{};
    std::vector<std::size_t> place(asked.size(), 0);
    for (std::size_t k = 0, next = 0; k < asked.size(); ++k) place[k] = asked[k].use ? next++ : 0;
    const auto bad = std::find_if(suspects.begin(), suspects.end(), [&](std::size_t k) {
      return !agrees_with_others(*forward, place[k], result.options.quality);
    });
    if (bad != suspects.end()) {
      asked[*bad].use = false;
      suspects.erase(bad);
      continue;
    }
    for (std::size_t k = 0; k < asked.size(); ++k) {
      if (asked[k].use || !observations[k].use) continue;
      SceneResult& scene = result.scenes[index[k]];
      scene.used = false;
      scene.reason = nodes.scenes[k].reason;
      scene.contradicts = true;
    }
    observations = std::move(asked);
    options = together;
    nodes = std::move(*all);
    return Done{};
  }
  return Done{};
}

// A panel beside the board may have been taken for it. True if a scene is out by that.
bool refuse_unseen(CalibrationResult& result, const std::vector<std::size_t>& index,
                   const ExtrinsicSolution& nodes, std::vector<SceneObservations>& observations) {
  if (!result.forward || nodes.used_scenes < 2) return false;
  bool any = false;
  for (std::size_t k = 0, next = 0; k < index.size(); ++k) {
    if (!nodes.scenes[k].used) continue;
    SceneResult& scene = result.scenes[index[k]];
    if (result.forward->scenes[next++].seen > 0.0 || scene.insisted) continue;
    observations[k].use = false;
    scene.used = false;
    scene.reason = Message(
        "the board is not found in the cloud: no return lies on it where the other scenes put it");
    any = true;
  }
  return any;
}

Error not_solvable(Error error, const CalibrationResult& result) {
  error.where = result.dataset;
  for (const SceneResult& scene : result.scenes) {
    if (scene.reason.empty()) continue;
    error.message += Message::verbatim("; ") + Message("scene %1: %2", scene.name, scene.reason);
    break;
  }
  return error;
}

}  // namespace

void reject(SceneResult& scene) {
  scene.rejected = true;
  scene.reason = Message("rejected by the user");
}

bool can_be_used(const SceneResult& scene, const Target& target) {
  return scene.view && scene.refinement &&
         (!target.has_circles() || scene.refinement->nodes.empty() ||
          scene.refinement->valid_nodes() >= 3);
}

Result<CalibrationResult> resolve_calibration(CalibrationResult result,
                                              const std::vector<bool>& use,
                                              const CalibrationOptions& options,
                                              const RunContext& context) {
  result.options = options;
  result.model.clear();
  result.model_fit.reset();
  result.modelled_dark_offset_m = 0.0;
  result.modelled_print_scale.setZero();
  for (SceneResult& scene : result.scenes) scene.modelled_scale = 0.0;
  result.modelled_range_misfit = 0.0;
  result.unexplained.clear();
  result.lacking.clear();
  take_back_refused(result);
  if (!result.print) result.print = std::make_shared<const BlurredPrint>(result.target);
  std::vector<std::size_t> index;
  auto observations = observations_of(result, use, index);
  const Target target = target_in_use(result, observations);
  ExtrinsicOptions extrinsic = options.extrinsic;
  ExtrinsicSolution nodes;
  do {
    auto solution = solve_with_insisted(result, target, index, observations, extrinsic);
    if (!solution) return not_solvable(std::move(solution).error(), result);
    nodes = std::move(*solution);
    if (Status s =
            reconsider_scenes(result, target, index, {observations, extrinsic, nodes}, context);
        !s)
      return s.error();
    if (Status s = solve_forward_model(result, {observations, result.camera, target, extrinsic},
                                       index, nodes, context);
        !s)
      return s.error();
  } while (refuse_unseen(result, index, nodes, observations));
  const FeatureInput in{observations, result.camera, target, extrinsic};
  if (Status s = check_intrinsics(result, observations, index, nodes, context); !s)
    return s.error();
  verify_intrinsics(result);
  for (std::size_t k = 0; k < index.size(); ++k) {
    SceneResult& scene = result.scenes[index[k]];
    const bool wanted = observations[k].use;
    scene.used = result.extrinsic.scenes[k].used;
    if (!wanted) continue;
    scene.reason = result.extrinsic.scenes[k].reason;
    scene.contradicts = !scene.used && !scene.reason.empty();
  }
  if (context.stopped()) return Error::cancelled();
  MethodOptions methods;
  methods.threads = context.thread_count();
  SubsetSolver subsets;
  if (result.forward) {
    subsets = forward_subsets(*result.forward, nodes);
    methods.other = {"forward_model", result.extrinsic.camera_from_lidar.transform, subsets};
  }
  methods.paper = JointVariant{"joint_paper", with_paper_nodes(observations, result, index),
                               paper_objective(extrinsic)};
  result.methods = compare_methods(in, nodes, methods);
  if (context.stopped()) return Error::cancelled();
  result.ablation.clear();
  if (options.ablation) {
    auto steps = ablate(result, observations, index, target, nodes, context);
    if (!steps) return steps.error();
    result.ablation = std::move(*steps);
  }
  result.uncertainty = assess_uncertainty(
      in, result.extrinsic,
      projection_covariance(result, result.extrinsic.camera_from_lidar.covariance), subsets);
  if (Status status = respond(result, target, options, context); !status) return status.error();
  judge_quality(result, options.quality);
  return result;
}

}  // namespace lvcalib
