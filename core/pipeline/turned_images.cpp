// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/turned_images.h"

#include "pipeline/calibration.h"

namespace lvcalib {

std::vector<int> possible_turns_deg(const Camera& camera) {
  if (camera.width_px == camera.height_px) return {180, 90, 270};
  return {180};
}

std::vector<CornerObservation> turned_corners(std::vector<CornerObservation> corners,
                                              const Camera& camera, int degrees) {
  const double right = camera.width_px - 1.0;
  for (int turned = 0; turned < degrees; turned += 180) {
    // Two quarters are one half, of images of any shape.
    const bool half = degrees - turned >= 180;
    for (CornerObservation& c : corners) {
      const Eigen::Vector2d p = c.pixel;
      c.pixel = half ? Eigen::Vector2d(right - p.x(), camera.height_px - 1.0 - p.y())
                     : Eigen::Vector2d(p.y(), right - p.x());
    }
  }
  return corners;
}

std::optional<TurnedImages> turned_images(const std::vector<SceneResult>& scenes,
                                          std::vector<SceneHypotheses> hypotheses,
                                          const std::vector<std::optional<std::size_t>>& chosen,
                                          const Camera& camera, const DetectionOptions& detection,
                                          const ConsensusOptions& options) {
  TurnedImages out;
  int all = 0;
  for (std::size_t s = 0; s < scenes.size(); ++s) {
    if (!scenes[s].view || hypotheses[s].candidates.empty()) continue;
    ++all;
    if (!chosen[s]) out.scenes.push_back(s);
  }
  // One scene agrees with itself, turned or not.
  if (all < 2 || out.scenes.empty()) return std::nullopt;
  for (const int degrees : possible_turns_deg(camera)) {
    for (const std::size_t s : out.scenes) {
      BoardView view = *scenes[s].view;
      view.corners = turned_corners(std::move(view.corners), camera, degrees);
      refit_view(view, camera, detection);
      hypotheses[s].camera_from_board = view.camera_from_board;
      hypotheses[s].alternative_camera_from_board = view.alternative_pose;
    }
    const auto consensus = decide_scenes(hypotheses, std::nullopt, options);
    if (!consensus || consensus->agreeing < all) continue;
    out.degrees = degrees;
    return out;
  }
  return std::nullopt;
}

void note_turned_images(CalibrationResult& result, const std::vector<SceneHypotheses>& hypotheses,
                        const SceneConsensus& consensus) {
  const auto turned = turned_images(result.scenes, hypotheses, consensus.chosen, result.camera,
                                    result.options.detection, result.options.consensus);
  if (!turned) return;
  for (const std::size_t s : turned->scenes) {
    SceneResult& scene = result.scenes[s];
    scene.contradicts = true;
    scene.turned_image = true;
    scene.reason = Message(
        "its image is turned against those of the other scenes: all agree once it is turned "
        "counterclockwise by %1°; turn it, and switch off what turns images",
        turned->degrees);
  }
}

}  // namespace lvcalib
