// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/camera_resection.h"

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "localization/scene_consensus.h"
#include "pipeline/board_images.h"
#include "pipeline/calibration.h"
#include "pipeline/diagnosis.h"
#include "solve/bundle_adjustment.h"

namespace lvcalib {
namespace {

// A board that its image and its cloud show.
struct BoardPair {
  BoardView view;
  std::vector<BoardCandidate> candidates;
};

std::vector<BoardPair> pairs_of(const CalibrationResult& result) {
  std::vector<BoardPair> out;
  for (const SceneResult& scene : result.scenes) {
    if (!scene.view || !scene.search || scene.search->candidates.empty() || scene.turned_image ||
        scene.rejected)
      continue;
    out.push_back({*scene.view, scene.search->candidates});
  }
  return out;
}

// Resection from a first extrinsic: which candidates are the boards is asked again with what comes
// out, as the first camera may be far off.
std::optional<BundleFit> resect(const std::vector<BoardPair>& pairs, const Camera& start,
                                const Rigid3& camera_from_lidar) {
  constexpr int kRounds = 3;  // The first with the first camera; a wrong choice is seen in one.
  const IntrinsicsVector wide = wide_intrinsics_sigma(start);
  std::optional<BundleFit> fit;
  for (int round = 0; round < kRounds; ++round) {
    const Camera& camera = fit ? fit->camera : start;
    const Rigid3& place = fit ? fit->poses.front() : camera_from_lidar;
    SeenPoints body;
    for (const BoardPair& pair : pairs) {
      const auto miss = [&](const BoardCandidate& c) {
        return corner_rms_px(pair.view.corners, camera, place * c.lidar_from_board.transform);
      };
      const auto best =
          std::min_element(pair.candidates.begin(), pair.candidates.end(),
                           [&](const auto& a, const auto& b) { return miss(a) < miss(b); });
      add_corners(pair.view.corners, best->lidar_from_board.transform, body);
    }
    fit = fit_bundle({body}, {place}, start, wide);
    if (!fit) return std::nullopt;
  }
  return fit;
}

// As given, for an image of half and of twice the size, and with the principal point in the middle:
// what is farther off than a solve finds back from.
std::vector<Camera> cameras_to_start_from(const Camera& given) {
  std::vector<Camera> out = {given};
  for (const double scale : {0.5, 2.0}) {
    Camera& other = out.emplace_back(given);
    other.fx *= scale;
    other.fy *= scale;
    other.cx = (given.cx + 0.5) * scale - 0.5;
    other.cy = (given.cy + 0.5) * scale - 0.5;
  }
  Camera& middle = out.emplace_back(given);
  middle.cx = 0.5 * given.width_px;
  middle.cy = 0.5 * given.height_px;
  middle.distortion.setZero();
  return out;
}

std::optional<BundleFit> best_resection(const std::vector<BoardPair>& pairs, const Camera& given,
                                        const DetectionOptions& detection) {
  // Each scene proposes extrinsics; the best candidates of a few are enough to start near.
  constexpr std::size_t kScenes = 3;
  constexpr std::size_t kCandidates = 2;
  std::optional<BundleFit> best;
  for (const Camera& start : cameras_to_start_from(given)) {
    for (std::size_t s = 0; s < std::min(kScenes, pairs.size()); ++s) {
      BoardView view = pairs[s].view;
      refit_view(view, start, detection);
      for (std::size_t k = 0; k < std::min(kCandidates, pairs[s].candidates.size()); ++k) {
        auto fit = resect(pairs, start,
                          view.camera_from_board.transform *
                              pairs[s].candidates[k].lidar_from_board.transform.inverse());
        if (fit && (!best || fit->sigma_px < best->sigma_px)) best = std::move(fit);
      }
    }
  }
  return best;
}

}  // namespace

Message intrinsics_that_agree(const CalibrationResult& result) {
  constexpr std::size_t kFewest = 3;  // What two boards have a camera agree on is chance.
  if (result.intrinsics.mode != IntrinsicsMode::kFixed) return {};
  const std::vector<BoardPair> pairs = pairs_of(result);
  if (pairs.size() < kFewest) return {};
  const Camera& given = result.intrinsics.given;
  const auto fit = best_resection(pairs, given, result.options.detection);
  if (!fit) return {};
  // The same criterion by which the scenes did not agree under the given camera.
  std::vector<SceneHypotheses> scenes;
  std::vector<BoardView> seen;
  seen.reserve(pairs.size());
  std::vector<CornerView> views;
  for (const BoardPair& pair : pairs) {
    BoardView& view = seen.emplace_back(pair.view);
    refit_view(view, fit->camera, result.options.detection);
    scenes.push_back(seen_by_camera(view, result.target));
    scenes.back().candidates = pair.candidates;
    views.push_back({&view.corners, view.camera_from_board.transform});
  }
  const auto consensus = decide_scenes(scenes, std::nullopt, result.options.consensus);
  if (!consensus || consensus->agreeing < static_cast<int>(pairs.size())) return {};
  const IntrinsicsContrast contrast = contrast_intrinsics(
      intrinsics_of(fit->camera), intrinsics_of(given), fit->covariance,
      wide_intrinsics_sigma(given), fit->freedom, result.options.intrinsics.false_alarm);
  return contrast.contradicts() ? describe(contrast, given, views) : Message();
}

}  // namespace lvcalib
