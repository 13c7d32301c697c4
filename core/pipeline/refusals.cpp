// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/refusals.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <set>

#include "base/symmetric.h"
#include "base/text.h"
#include "solve/board_returns.h"

namespace lvcalib {
namespace {

using What = Refusal::What;

// What the solve left out of one scene that takes part.
void refuse_features(const SceneSolution& solved, const SceneResult* found,
                     std::vector<Refusal>& out) {
  for (const NodeResidual& node : solved.nodes) {
    if (node.used || (found != nullptr && contains_id(found->edits.circles, node.id))) continue;
    bool measured = true;
    Message reason = misses_the_pose(node);
    if (found != nullptr && found->refinement) {
      for (const RefinedNode& refined : found->refinement->nodes) {
        if (refined.id != node.id || refined.valid) continue;
        measured = false;
        if (!refined.reason.empty()) reason = refined.reason;
      }
    }
    out.push_back({solved.name, What::kCircle, node.id, 0, reason, measured});
  }
  std::set<int> tags;
  for (const CornerResidual& corner : solved.corners) {
    if (!corner.used) tags.insert(corner.feature_id);
  }
  for (std::size_t k = 0; found != nullptr && k < found->refused_corners.size(); ++k)
    tags.insert(found->refused_corners[k].feature_id);
  for (const int id : tags) {
    out.push_back({solved.name, What::kTag, id, 0,
                   Message("misses the board's pose by more than the gate"), true});
  }
}

bool contains_circle(const std::vector<Refusal>& all, const std::string& scene, int id) {
  return std::any_of(all.begin(), all.end(), [&](const Refusal& r) {
    return r.scene == scene && r.what == What::kCircle && r.id == id;
  });
}

}  // namespace

Message misses_the_pose(const NodeResidual& node) {
  return Message("misses the board's pose by %1 mm, more than the gate",
                 formatted("%.1f", 1e3 * node.residual_m.norm()));
}

bool can_be_insisted_on(const SceneResult& scene) {
  const bool board = scene.refinement || (scene.search && !scene.search->candidates.empty());
  return !scene.used && scene.view && board && !scene.unreadable && !scene.reason.empty() &&
         !scene.rejected;
}

void keep(SceneEdits& edits, const Refusal& refusal) {
  const auto add = [&](std::vector<int>& ids) {
    if (!contains_id(ids, refusal.id)) ids.push_back(refusal.id);
    std::sort(ids.begin(), ids.end());
  };
  if (!refusal.can_be_used) return;
  if (refusal.what == What::kTag) add(edits.kept_tags);
  if (refusal.what == What::kCircle) add(edits.kept_circles);
  if (refusal.what == What::kPatch)
    edits.kept_patches.push_back({refusal.board_m.min(), refusal.board_m.max()});
}

std::vector<Refusal> refusals(const CalibrationResult& result) {
  std::vector<Refusal> out;
  std::size_t forward = 0;
  for (const SceneSolution& solved : result.extrinsic.scenes) {
    if (!solved.used) continue;
    if (result.forward && forward < result.forward->scenes.size()) {
      const ForwardSceneResult& returns = result.forward->scenes[forward++];
      std::size_t off_plane = returns.refused;
      for (std::size_t k = 0; k < returns.covered.size(); ++k) {
        const CoveredPatch& patch = returns.covered[k];
        off_plane -= std::min(off_plane, patch.returns);
        out.push_back({solved.name, What::kPatch, static_cast<int>(k), patch.returns,
                       Message("something stands before the board there or lies on it"), true,
                       patch.board_m});
      }
      if (off_plane > 0)
        out.push_back(
            {solved.name, What::kPoints, -1, off_plane, Message("off the board's plane")});
    }
    const auto found = std::find_if(result.scenes.begin(), result.scenes.end(),
                                    [&](const SceneResult& s) { return s.name == solved.name; });
    refuse_features(solved, found == result.scenes.end() ? nullptr : &*found, out);
  }
  for (const SceneResult& scene : result.scenes) {
    if (scene.used || scene.reason.empty() || scene.rejected) continue;
    out.push_back({scene.name, What::kScene, -1, 0, scene.reason, can_be_insisted_on(scene)});
  }
  const auto refused_whole = [&](const std::string& name) {
    return std::any_of(out.begin(), out.end(),
                       [&](const Refusal& r) { return r.scene == name && r.what == What::kScene; });
  };
  for (const SceneResponse& scene : result.response.scenes) {
    if (refused_whole(scene.name)) continue;
    const auto found = std::find_if(result.scenes.begin(), result.scenes.end(),
                                    [&](const SceneResult& s) { return s.name == scene.name; });
    if (!scene.reason.empty()) out.push_back({scene.name, What::kResponse, -1, 0, scene.reason});
    for (const NodeResponse& node : scene.nodes) {
      if (node.state == NodeResponseState::kUsed || contains_circle(out, scene.name, node.id))
        continue;
      if (found != result.scenes.end() && contains_id(found->edits.circles, node.id)) continue;
      out.push_back({scene.name, What::kResponse, node.id, 0, node.reason});
    }
  }
  std::stable_sort(out.begin(), out.end(),
                   [](const Refusal& a, const Refusal& b) { return a.scene < b.scene; });
  return out;
}

std::vector<GateDistance> gate_distances(const CalibrationResult& result) {
  std::vector<GateDistance> out;
  const ExtrinsicSolution& x = result.extrinsic;
  const double floor_m = result.options.extrinsic.node_sigma_floor_m;
  for (const SceneSolution& solved : x.scenes) {
    const auto scene = std::find_if(result.scenes.begin(), result.scenes.end(),
                                    [&](const SceneResult& s) { return s.name == solved.name; });
    if (!solved.used || scene == result.scenes.end() || !scene->refinement) continue;
    std::map<int, GateDistance> tags;
    for (const CornerResidual& corner : solved.corners) {
      GateDistance& tag = tags[corner.feature_id];
      const double sigmas = corner.residual_px.norm() / std::max(x.sigma_px, 1e-12);
      tag = {What::kTag, std::max(tag.sigmas, sigmas), corner.used};
    }
    for (const auto& [id, tag] : tags) out.push_back(tag);
    const BoardRefinement& refined = *scene->refinement;
    for (std::size_t k = 0; k < solved.nodes.size() && k < refined.nodes.size(); ++k) {
      if (!refined.nodes[k].valid) continue;
      const Eigen::Vector3d in_lidar =
          refined.lidar_from_board.rotation * solved.nodes[k].residual_m;
      const Eigen::Vector2d in_plane(refined.plane.axis_u.dot(in_lidar),
                                     refined.plane.axis_v.dot(in_lidar));
      const Eigen::Matrix2d covariance =
          x.node_scale * x.node_scale *
          (refined.nodes[k].covariance_m2 + floor_m * floor_m * Eigen::Matrix2d::Identity());
      const double chi2 = squared_mahalanobis(in_plane, covariance);
      out.push_back({What::kCircle, std::sqrt(std::max(0.0, chi2)), solved.nodes[k].used});
    }
  }
  return out;
}

std::vector<Eigen::AlignedBox2d> covered_parts(const CalibrationResult& result,
                                               const std::string& scene) {
  std::vector<Eigen::AlignedBox2d> out;
  for (const Refusal& refusal : refusals(result)) {
    if (refusal.scene == scene && refusal.what == What::kPatch) out.push_back(refusal.board_m);
  }
  return out;
}

std::vector<std::uint32_t> refused_returns(const CalibrationResult& result, std::size_t scene) {
  if (!result.forward || !result.print || scene >= result.scenes.size()) return {};
  const SceneResult& from = result.scenes[scene];
  const ForwardState& state = result.forward->state;
  std::size_t place = 0;
  for (const SceneSolution& solved : result.extrinsic.scenes) {
    if (!solved.used) continue;
    if (solved.name != from.name) {
      ++place;
      continue;
    }
    if (place >= result.forward->noise.scenes.size()) return {};
    const SceneNoise& noise = result.forward->noise.scenes[place];
    const RangeNoise range{noise.range_white_m, noise.range_black_m};
    ReturnSelection usual = result.options.forward.selection;
    usual.uncovered = from.edits.kept_patches;
    ReturnSelection open = usual;
    open.range_gate = std::numeric_limits<double>::infinity();
    open.covers = false;
    const auto select = [&](const ReturnSelection& selection) {
      return select_returns(from.board_points, *result.print, state.lidar_from_board(place),
                            state.beam, range, selection)
          .index;
    };
    const auto kept = select(usual);
    const auto all = select(open);
    std::vector<std::uint32_t> out;
    std::set_difference(all.begin(), all.end(), kept.begin(), kept.end(), std::back_inserter(out));
    return out;
  }
  return {};
}

}  // namespace lvcalib
