// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/model_discovery.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "model/beam_blur.h"
#include "pipeline/ablation.h"
#include "pipeline/forward_stage.h"
#include "pipeline/quality.h"
#include "pipeline/refusals.h"
#include "pipeline/without_effects.h"

namespace lvcalib {
namespace {

// What only images and ranges together said against the intrinsics may have been an effect on the
// ranges: it holds as far as the search, with the model in force, still sees intrinsics off.
void ask_ranges_again(const Discovery& discovery, CalibrationResult& result) {
  auto& contradiction = result.intrinsics.contradiction;
  if (!contradiction || !contradiction->by_ranges || contradiction->modelled ||
      discovery.model.empty())
    return;
  bool asked = false;
  for (const EffectFinding& finding : discovery.effects) {
    const EffectPtr effect = find_effect(finding.id);
    if (effect == nullptr || !effect->info().of_intrinsics || !(finding.p_value < 1.0)) continue;
    if (finding.p_value < result.options.intrinsics.false_alarm) return;
    asked = true;
  }
  if (asked) contradiction.reset();
}

// What spoke against intrinsics and target in the images, asked again without what the model's
// effects do to these.
void ask_again(const Discovery& discovery, CalibrationResult& result) {
  std::vector<EffectInUse> others;
  std::copy_if(discovery.model.begin(), discovery.model.end(), std::back_inserter(others),
               [](const EffectInUse& use) { return !use.effect->info().of_intrinsics; });
  const auto without = [&](const std::vector<EffectInUse>& effects) {
    return [&](const std::vector<CornerObservation>& corners, const Rigid3& camera_from_board) {
      return corners_without(effects, discovery.scales, result, corners, camera_from_board);
    };
  };
  ask_images_again(result, without(others), without(discovery.model));
  ask_ranges_again(discovery, result);
}

// Pose of the LiDAR and of the boards in use.
void put_poses(const Discovery& discovery, CalibrationResult& result) {
  result.extrinsic.camera_from_lidar = {discovery.state.camera_from_lidar, discovery.covariance};
  const auto boards = modelled_boards(discovery, result);
  for (std::size_t k = 0; k < boards.size(); ++k) {
    for (SceneSolution& s : result.extrinsic.scenes) {
      if (s.name == result.scenes[k].name && boards[k]) s.camera_from_board = *boards[k];
    }
  }
}

bool refused(const SceneResult& scene) {
  return scene.contradicts && can_be_insisted_on(scene);
}

// Scenes that contradict the base model may agree once the effect that it lacks is taken out of
// their observations. They are no reason to doubt then, though the model was fitted without them;
// and what the user insisted on is not objected to any more. To agree, the solve that refuses bad
// scenes must keep a scene and fit the others as well as without it.
void ask_scenes_again(std::vector<SceneObservations> observations,
                      const std::vector<std::size_t>& index, const Target& target,
                      const ExtrinsicSolution& without, CalibrationResult& result) {
  const auto insisted = [&](const SceneResult& scene) {
    return scene.used && !scene.objection.empty() &&
           !(target.has_circles() && scene.refinement->nodes.empty());
  };
  bool any = false;
  for (std::size_t k = 0; k < observations.size(); ++k) {
    const SceneResult& scene = result.scenes[index[k]];
    observations[k].use = observations[k].use || refused(scene);
    any = any || refused(scene) || insisted(scene);
  }
  if (!any) return;
  const auto with =
      solve_extrinsic({observations, result.camera, target, result.options.extrinsic});
  if (!with || with->node_scale > std::max(1.0, without.node_scale) ||
      with->plane_scale > std::max(1.0, without.plane_scale))
    return;
  for (std::size_t k = 0; k < observations.size(); ++k) {
    SceneResult& scene = result.scenes[index[k]];
    if (!with->scenes[k].used) continue;
    if (insisted(scene)) scene.objection = {};
    if (!refused(scene)) continue;
    scene.contradicts = false;
    scene.reason = Message(
        "it contradicts the others only without the effects of this model: use it all the same "
        "(--insist) and search again");
  }
}

// The beam as the model measures it.
void tell_beam(const Discovery& discovery, ForwardSolution& forward) {
  forward.state.beam = discovery.state.beam;
  if (!discovery.fit || !forward.uses_intensity) return;
  const Eigen::Index at = blur_place(discovery.model);
  const Eigen::MatrixXd& covariance = discovery.fit->covariance;
  if (covariance.rows() >= at + 3) forward.blur_covariance = covariance.block<3, 3>(at, at);
}

// Everything that is told of the scenes, under the model's effects: residuals, methods, what single
// scenes and halves would give. Where the classical solve does not bear the corrected observations
// the base's stands, with the model's pose.
void report_model(const Discovery& discovery, CalibrationResult& result) {
  std::vector<bool> use;
  for (const SceneResult& scene : result.scenes) use.push_back(scene.used);
  std::vector<std::size_t> index;
  auto observations = observations_of(result, use, index);
  const Target target = target_in_use(result, observations);
  const WithoutEffects without(discovery, result, target, observations, index);
  auto paper = without.observations(with_paper_nodes(observations, result, index));
  observations = without.observations(std::move(observations));
  if (auto response = without.boundary_response(observations))
    result.response = std::move(*response);
  if (result.forward) tell_beam(discovery, *result.forward);
  const FeatureInput in{observations, result.camera, target, result.options.extrinsic};
  const auto again = solve_extrinsic(in);
  if (again) ask_scenes_again(observations, index, target, *again, result);
  const auto& solved = result.extrinsic.scenes;
  const auto boards = static_cast<std::size_t>(
      std::count_if(solved.begin(), solved.end(), [](const SceneSolution& s) { return s.used; }));
  if (!discovery.fit || solved.size() != observations.size() ||
      boards != discovery.state.camera_from_board.size()) {
    // Not made by one solve: what it says of its measurements stays.
    put_poses(discovery, result);
    return;
  }
  ExtrinsicSolution nodes = result.extrinsic;
  const auto same_scenes = [&](const ExtrinsicSolution& other) {
    return std::equal(
        other.scenes.begin(), other.scenes.end(), nodes.scenes.begin(), nodes.scenes.end(),
        [](const SceneSolution& a, const SceneSolution& b) { return a.used == b.used; });
  };
  if (again && same_scenes(*again)) nodes = *again;
  ReportedPose pose{{discovery.state.camera_from_lidar, discovery.covariance},
                    discovery.state.camera_from_board};
  if (result.forward) {
    pose.uses_intensity = result.forward->uses_intensity;
  }
  const SubsetSolver subsets =
      model_subsets(discovery.fit, discovery.state.camera_from_lidar, nodes);
  result.extrinsic = report_forward(pose, subsets, nodes, in);
  result.extrinsic.camera_from_lidar = pose.camera_from_lidar;
  MethodOptions methods;
  methods.paper = JointVariant{"joint_paper", std::move(paper), paper_objective(in.options)};
  methods.other = {"forward_model", discovery.state.camera_from_lidar, subsets};
  result.methods = compare_methods(in, nodes, methods);
  result.ablation.clear();  // Of the base model.
  result.uncertainty = assess_uncertainty(
      in, result.extrinsic, projection_covariance(result, discovery.covariance), subsets);
}

}  // namespace

DiscoveryInput discovery_input(const CalibrationResult& result) {
  DiscoveryInput input;
  input.camera = result.camera;
  input.sigma_px = result.extrinsic.sigma_px;
  input.state.camera_from_lidar = result.extrinsic.camera_from_lidar.transform;
  for (const SceneResult& scene : result.scenes) {
    const SceneSolution* solution = solution_of(result, scene.name);
    if (!takes_part(scene) || solution == nullptr) continue;
    SceneMeasurements m;
    m.name = scene.name;
    for (std::size_t k = 0; k < scene.view->corners.size(); ++k) {
      // Corners that the joint solve left out as outliers stay out.
      if (k < solution->corners.size() && solution->corners[k].used)
        m.corners.push_back(scene.view->corners[k]);
    }
    m.board_points = &scene.board_points;
    m.uncovered = scene.edits.kept_patches;
    input.scenes.push_back(std::move(m));
    input.state.camera_from_board.push_back(solution->camera_from_board);
  }
  if (result.forward && result.forward->state.levels.size() == input.scenes.size()) {
    const ForwardSolution& forward = *result.forward;
    input.print = result.print;
    input.noise = forward.noise;
    input.state = {forward.state.camera_from_lidar, forward.state.camera_from_board,
                   forward.state.levels, forward.state.beam};
  }
  return input;
}

DiscoveryOptions discovery_options(const CalibrationResult& result) {
  DiscoveryOptions out = result.options.discovery;
  const QualityOptions& q = result.options.quality;
  out.tolerance = {{q.tolerance_m, q.tolerance_rad}, q.tolerance_sigmas};
  out.left_out = left_out_sizes(result);
  // The search holds the intrinsics wherever the calibration had estimated them.
  if (result.intrinsics.mode != IntrinsicsMode::kFixed)
    out.left_out.intrinsics = result.intrinsics.sigma;
  return out;
}

Result<Discovery> discover(const CalibrationResult& result, const DiscoveryOptions& options,
                           const RunContext& context) {
  auto out = discover_effects(discovery_input(result), options, context);
  if (!out || !out->model.empty()) return out;
  // With nothing in the model the calibration's own extrinsic stands, and its uncertainty.
  const UncertainRigid3& own = result.extrinsic.camera_from_lidar;
  out->covariance = own.covariance;
  out->covariance_total = result.covariance_total;
  out->covariance_with_budget = covariance_with_budget(out->covariance, out->budget);
  if (!out->history.empty()) out->history.back().camera_from_lidar = own.transform;
  return out;
}

std::vector<Message> explanations(const ExplainedScenes& explained) {
  std::vector<std::string> effects;
  for (const ModelEffect& effect : explained.result.model) effects.push_back(effect.id);
  std::vector<Message> out;
  for (const std::string& scene : explained.scenes) {
    out.push_back(
        Message("scene %1 contradicts the others only without %2: it is used, with that in "
                "the model",
                scene, joined(effects_named(effects), ", ")));
  }
  return out;
}

Result<std::optional<ExplainedScenes>> explain_refused_scenes(const CalibrationResult& result,
                                                              const DiscoveryOptions& options,
                                                              const RunContext& context) {
  const auto may_agree = [](const SceneResult& scene) {
    return refused(scene) && !scene.turned_image && scene.shared_file.empty();
  };
  std::optional<ExplainedScenes> out;
  if (std::none_of(result.scenes.begin(), result.scenes.end(), may_agree)) return out;
  ExplainedScenes explained;
  CalibrationResult with = result;
  std::vector<bool> use;
  for (SceneResult& scene : with.scenes) {
    use.push_back(scene.used || may_agree(scene));
    if (!may_agree(scene)) continue;
    scene.insisted = true;
    explained.scenes.push_back(scene.name);
  }
  const auto given_up = [&](const Error& error) -> Result<std::optional<ExplainedScenes>> {
    if (context.stopped() || error.kind == ErrorKind::kCancelled) return Error::cancelled();
    return out;
  };
  auto base = resolve_calibration(std::move(with), use, result.options, context);
  if (!base) return given_up(base.error());
  auto discovery = discover(*base, options, context);
  if (!discovery) return given_up(discovery.error());
  if (discovery->model.empty()) return out;
  explained.result = with_model(std::move(*base), *discovery);
  for (const std::string& name : explained.scenes) {
    const auto scene = std::find_if(explained.result.scenes.begin(), explained.result.scenes.end(),
                                    [&](const SceneResult& s) { return s.name == name; });
    if (!scene->used || !scene->objection.empty()) return out;
  }
  explained.discovery = std::move(*discovery);
  out = std::move(explained);
  return out;
}

CalibrationResult with_model(CalibrationResult result, const Discovery& discovery) {
  // With nothing selected the calibration's own extrinsic stands: it rests on every return.
  const bool changed = !discovery.model.empty();
  const ModelledMovements movements(discovery, result);
  result.budget = discovery.budget;
  result.covariance_with_budget = discovery.covariance_with_budget;
  // What an effect of the model explains is no longer left out. Before the total is known, what
  // was left out of the base model stands for it.
  if (changed && discovery.covariance_total.isZero(0.0)) {
    result.covariance_total += discovery.covariance - result.extrinsic.camera_from_lidar.covariance;
  } else if (changed) {
    result.covariance_total = discovery.covariance_total;
  }
  result.model_scales = discovery.scales;
  result.model.clear();
  for (const EffectFinding& f : discovery.effects) {
    for (const EffectInUse& use : discovery.model) {
      if (use.effect->info().id != f.id) continue;
      result.model.push_back({f.id, f.parameters, use.shape, f.shape_sigma, f.spec});
    }
  }
  result.model_fit = changed ? discovery.fit : nullptr;
  result.modelled_dark_offset_m = dark_offset_m(movements);
  const ModelledScales looks = modelled_scales(discovery, movements, result);
  result.modelled_print_scale = looks.print;
  for (std::size_t s = 0; s < result.scenes.size(); ++s)
    result.scenes[s].modelled_scale = looks.scenes[s];
  result.modelled_range_misfit = 0.0;
  result.unexplained.clear();
  std::copy_if(discovery.unknown.begin(), discovery.unknown.end(),
               std::back_inserter(result.unexplained),
               [](const StructureScore& s) { return s.matters; });
  result.lacking = discovery.lacking();
  if (!changed) {
    if (!result.unexplained.empty() || !result.lacking.empty())
      judge_quality(result, result.options.quality);
    return result;
  }
  const std::vector<ChannelSummary> none;
  for (const ChannelSummary& c :
       discovery.history.empty() ? none : discovery.history.back().channels) {
    if (c.channel == Channel::kRange && c.noise_floor > 0.0)
      result.modelled_range_misfit = c.rms / c.noise_floor;
  }
  report_model(discovery, result);
  ask_again(discovery, result);
  // What the model explains is no fault of the result any more.
  judge_quality(result, result.options.quality);
  return result;
}

std::shared_ptr<const CalibrationResult> result_at(
    const std::shared_ptr<const CalibrationResult>& base, const std::vector<ModelStepPtr>& steps) {
  if (steps.size() < 2) return base;
  const Discovery discovery = as_discovery(steps, nullptr);
  if (discovery.model.empty()) return base;
  return std::make_shared<const CalibrationResult>(with_model(*base, discovery));
}

}  // namespace lvcalib
