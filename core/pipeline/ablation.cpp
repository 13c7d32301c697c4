// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/ablation.h"

#include <algorithm>

#include "base/parallel.h"

namespace lvcalib {
namespace {

// The paper's refinement again, its samples moved along their rays onto the plane.
std::vector<SceneObservations> with_samples_along_rays(std::vector<SceneObservations> observations,
                                                       const CalibrationResult& result,
                                                       const std::vector<std::size_t>& index,
                                                       const RunContext& context) {
  RefinementOptions options = as_in_paper(result.options.refinement);
  options.along_rays = true;
  parallel_for(observations.size(), context.thread_count(), [&](std::size_t k) {
    const SceneResult& scene = result.scenes[index[k]];
    if (observations[k].nodes.empty() || !scene.search || !scene.chosen) return;
    const Rigid3& start = scene.search->candidates[*scene.chosen].lidar_from_board.transform;
    auto refined = refine_board(scene.board_points, result.target, start, options, context);
    if (refined) observations[k].nodes = std::move(refined->nodes);
  });
  return observations;
}

AblationStep step_of(MethodResult method, std::string change, const Rigid3& final) {
  method.translation_mm = 1e3 * translation_distance_m(method.camera_from_lidar, final);
  method.rotation_mrad = 1e3 * rotation_distance_rad(method.camera_from_lidar, final);
  return {std::move(change), std::move(method)};
}

}  // namespace

std::vector<SceneObservations> with_paper_nodes(std::vector<SceneObservations> observations,
                                                const CalibrationResult& result,
                                                const std::vector<std::size_t>& index) {
  for (std::size_t k = 0; k < observations.size(); ++k)
    observations[k].nodes = result.scenes[index[k]].paper_nodes;
  return observations;
}

Result<std::vector<AblationStep>> ablate(const CalibrationResult& result,
                                         const std::vector<SceneObservations>& observations,
                                         const std::vector<std::size_t>& index,
                                         const Target& target, const ExtrinsicSolution& nodes,
                                         const RunContext& context) {
  const Rigid3& final = result.extrinsic.camera_from_lidar.transform;
  std::vector<AblationStep> steps;
  const auto take = [&](const char* name, const char* change) {
    for (const MethodResult& m : result.methods) {
      if (m.name == name) steps.push_back(step_of(m, change, final));
    }
  };
  take("joint_paper", "the method as the paper prints it");
  if (!steps.empty()) {
    const ExtrinsicOptions& ours = result.options.extrinsic;
    const ExtrinsicOptions isotropic = paper_objective(ours);
    ExtrinsicOptions all_axes = isotropic;
    all_axes.node_term = NodeTerm::kAllAxes;
    ExtrinsicOptions planes = isotropic;
    planes.node_term = NodeTerm::kInPlane;
    const std::vector<JointVariant> variants = {
        {"along_rays", with_samples_along_rays(observations, result, index, context), isotropic},
        {"transition", observations, isotropic},
        {"covariance", observations, all_axes},
        {"planes", observations, planes},
        {"robust_loss", observations, ours}};
    if (context.stopped()) return Error::cancelled();
    const char* const changes[] = {
        "samples meet the plane along their rays, not at their feet",
        ("centres and their deviations by the transition's error function, not by medians, linear "
         "midpoints and the layout"),
        "the full covariance of a centre in the plane, not one deviation",
        "a term for the board's plane by its own covariance, not the nodes' third axis",
        "Huber's loss, not squares"};
    const auto measured =
        compare_variants({observations, result.camera, target, ours}, nodes, variants);
    for (std::size_t k = 0; k < variants.size(); ++k) {
      for (const MethodResult& m : measured) {
        if (m.name == variants[k].name) steps.push_back(step_of(m, changes[k], final));
      }
    }
  }
  if (context.stopped()) return Error::cancelled();
  take("joint_refined",
       "deviations of nodes and planes widened by what the residuals say; tags, nodes and scenes "
       "that contradict left out");
  take("forward_model", "every corner, range and intensity on the boards in one model");
  return steps;
}

}  // namespace lvcalib
