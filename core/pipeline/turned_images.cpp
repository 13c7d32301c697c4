// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/turned_images.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "base/text.h"
#include "pipeline/board_images.h"
#include "pipeline/calibration.h"
#include "solve/intrinsics_fit.h"

namespace lvcalib {
namespace {

// Σe² of all corners under the camera, each board's pose fitted, with some images turned.
struct CornerSquares {
  double sum = 0.0;
  double dof = 0.0;
};
CornerSquares corner_squares(const std::vector<SceneResult>& scenes,
                             const std::vector<std::size_t>& as_they_are,
                             const std::vector<std::size_t>& turned, int degrees,
                             const Camera& camera, const DetectionOptions& detection) {
  CornerSquares out;
  const auto add = [&](std::size_t s, int by) {
    BoardView view = *scenes[s].view;
    view.corners = turned_corners(std::move(view.corners), camera, by);
    refit_view(view, camera, detection);
    const auto fit = fit_intrinsics({{&view.corners, view.camera_from_board.transform}}, camera,
                                    IntrinsicsVector::Zero());
    const Rigid3& pose = fit ? fit->camera_from_board.front() : view.camera_from_board.transform;
    const auto rows = 2.0 * static_cast<double>(view.corners.size());
    out.sum += rows * std::pow(corner_rms_px(view.corners, camera, pose), 2);
    out.dof += rows - 6.0;
  };
  for (const std::size_t s : as_they_are) add(s, 0);
  for (const std::size_t s : turned) add(s, degrees);
  return out;
}

std::string names_of(const std::vector<SceneResult>& all, const std::vector<std::size_t>& scenes) {
  std::vector<std::string> names;
  for (const std::size_t s : scenes) names.push_back(all[s].name);
  return joined(names, ", ");
}

}  // namespace

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
    (chosen[s] ? out.others : out.scenes).push_back(s);
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
    const auto these = corner_squares(scenes, out.others, out.scenes, degrees, camera, detection);
    const auto those =
        corner_squares(scenes, out.scenes, out.others, 360 - degrees, camera, detection);
    const double variance =
        std::min(these.sum, those.sum) / std::max(1.0, these.dof);  // Of a coordinate.
    out.for_others = variance > 0.0 ? (those.sum - these.sum) / variance : 0.0;
    return out;
  }
  return std::nullopt;
}

bool note_turned_images(CalibrationResult& result, const std::vector<SceneHypotheses>& hypotheses,
                        const SceneConsensus& consensus, bool has_guess) {
  auto turned = turned_images(result.scenes, hypotheses, consensus.chosen, result.camera,
                              result.options.detection, result.options.consensus);
  if (!turned) return false;
  // As unlikely as what else is called a contradiction of the intrinsics.
  const double sure = -2.0 * std::log(result.options.intrinsics.false_alarm);
  const bool told = has_guess || std::abs(turned->for_others) > sure;
  if (!has_guess && turned->for_others < -sure) {
    std::swap(turned->scenes, turned->others);
    turned->degrees = 360 - turned->degrees;
  }
  // Of two, of four: what the consensus goes by is chance.
  const bool halves = !told && turned->scenes.size() == turned->others.size();
  for (const std::size_t s : turned->scenes) {
    SceneResult& scene = result.scenes[s];
    scene.contradicts = true;
    scene.turned_image = true;
    scene.reason =
        halves
            ? Message(
                  "the images of scenes %1 and those of scenes %2 are turned against each "
                  "other: all agree once the former are turned counterclockwise by %3°, or "
                  "the latter by %4°; nothing tells which are as the camera gives them: turn "
                  "those that are not, and switch off what turns images",
                  names_of(result.scenes, turned->scenes), names_of(result.scenes, turned->others),
                  turned->degrees, 360 - turned->degrees)
            : Message(
                  "its image is turned against those of the other scenes: all agree once it "
                  "is turned counterclockwise by %1°; turn it, and switch off what turns "
                  "images",
                  turned->degrees);
  }
  return true;
}

}  // namespace lvcalib
