// SPDX-License-Identifier: BSD-3-Clause
#include "solve/feature_solver.h"

#include <algorithm>

#include "solve/alignment.h"
#include "solve/robust_fit.h"
#include "solve/solution_report.h"

namespace lvcalib {
namespace {

Status enough_scenes(const std::vector<SceneObservations>& scenes, const Target& target) {
  const auto used =
      std::count_if(scenes.begin(), scenes.end(), [](const SceneObservations& s) { return s.use; });
  if (used == 0) return Error::untrusted(Message("no usable scene is left"));
  if (!target.has_circles() && used < kFewestWithoutCircles) {
    return Error::untrusted(
        used == 1
            ? Message("one usable scene; a target without circles needs three or more, differently "
                      "turned")
            : Message("%1 usable scenes; a target without circles needs three or more, differently "
                      "turned",
                      used),
        {}, Message("take scenes with the board tilted left, right, up and down"));
  }
  return Done{};
}

// A start that puts corners where the camera cannot see them leaves nothing to descend from.
Status corners_in_view(const std::vector<SceneObservations>& scenes, const Camera& camera) {
  for (const SceneObservations& scene : scenes) {
    if (!scene.use) continue;
    for (const CornerObservation& c : scene.corners) {
      if (camera.project(scene.camera_from_board *
                         Eigen::Vector3d(c.board_m.x(), c.board_m.y(), 0.0)))
        continue;
      return Error::untrusted(
          Message(
              "the board's start pose puts some of its corners where the camera cannot see them"),
          scene.name, Message("leave this scene out"));
    }
  }
  return Done{};
}

}  // namespace

Rigid3 closed_form_extrinsic(const std::vector<SceneObservations>& scenes, const Target& target) {
  // Corresponding points: the outline's corners and a point above the middle, by each sensor's own
  // board pose.
  const BoardOutline outline = target.outline();
  const Eigen::Vector2d a = outline.lower_left_m;
  const Eigen::Vector2d b = outline.upper_right_m;
  const Eigen::Vector2d c = outline.center_m();
  const std::vector<Eigen::Vector3d> points{{a.x(), a.y(), 0},
                                            {b.x(), a.y(), 0},
                                            {b.x(), b.y(), 0},
                                            {a.x(), b.y(), 0},
                                            {c.x(), c.y(), outline.size_m().maxCoeff()}};
  std::vector<PointPair> pairs;
  for (const SceneObservations& scene : scenes) {
    if (!scene.use) continue;
    for (const Eigen::Vector3d& p : points)
      pairs.push_back({scene.camera_from_board * p, scene.lidar_from_board * p, 1.0});
  }
  return align_points(pairs);
}

Result<ExtrinsicSolution> solve_extrinsic(const FeatureInput& in) {
  if (Status status = enough_scenes(in.scenes, in.target); !status) return status.error();
  if (Status status = corners_in_view(in.scenes, in.camera); !status) return status.error();
  auto fit = fit_robustly(in);
  if (!fit) return fit.error();
  return report_solution(*fit, in);
}

}  // namespace lvcalib
