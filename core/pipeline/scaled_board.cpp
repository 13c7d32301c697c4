// SPDX-License-Identifier: BSD-3-Clause
// The board is there, but of another size than target.yaml says.
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "base/parallel.h"
#include "localization/board_search.h"
#include "localization/scene_consensus.h"
#include "pipeline/diagnosis.h"
#include "pipeline/scene_loading.h"

namespace lvcalib {
namespace {

Target scaled(Target t, double s) {
  for (double* length : {&t.tag_size_m, &t.circle_radius_m, &t.margin_m, &t.column_spacing_m,
                         &t.row_spacing_m, &t.board_width_m, &t.board_height_m}) {
    *length *= s;
  }
  t.board_offset_m *= s;
  return t;
}

// Wrong readings of a rule, half or double squares: from half to double in steps that the search
// bridges.
constexpr std::array kSizes = {0.5, 0.55, 0.6,  0.64, 0.68, 0.74, 0.8, 0.85, 0.9,  0.95, 1.05,
                               1.1, 1.16, 1.22, 1.3,  1.4,  1.5,  1.6, 1.72, 1.86, 2.0};

// Sizes worth a look: those and units that no board of this target would be absurd in.
std::vector<double> sizes_of(const Target& target) {
  constexpr double kSmallest_m = 0.1;  // A LiDAR's spots lie some centimetres apart.
  constexpr double kLargest_m = 10.0;  // Nobody prints or carries more.
  std::vector<double> sizes(kSizes.begin(), kSizes.end());
  const double side = target.outline().size_m().maxCoeff();
  for (const LengthUnit& unit : other_length_units()) {
    if (unit.in_m * side > kSmallest_m && unit.in_m * side < kLargest_m) sizes.push_back(unit.in_m);
  }
  return sizes;
}

// Where the board may be if it were `size` times as large as in target.yaml.
std::vector<BoardCandidate> at_size(const Cloud& cloud, const CalibrationResult& result,
                                    const BoardView& view, double size,
                                    const BoardSearchOptions& options, const RunContext& context) {
  const Target target = scaled(result.target, size);
  const double distance_m = size * view.camera_from_board.transform.translation.norm();
  return search_board(cloud, {target, PatternPyramid(target), distance_m}, options, context)
      .candidates;
}

// The one of most evidence; gain 0: none.
BoardCandidate best_of(const std::vector<BoardCandidate>& candidates) {
  BoardCandidate best;
  for (const BoardCandidate& candidate : candidates) {
    if (candidate.gain > best.gain) best = candidate;
  }
  return best;
}

}  // namespace

std::optional<double> find_scaled_board(const Dataset& dataset, const CalibrationRequest& request,
                                        const CalibrationResult& result,
                                        const RunContext& context) {
  constexpr double kSameSize = 0.03;  // Less than the steps of the sizes tried.
  // A board turned by as much as its size is off fits nearly as well.
  ConsensusOptions loose = request.options.consensus;
  loose.systematic_rotation_rad = std::max(loose.systematic_rotation_rad, kSameSize);
  RunContext quiet = context.silent();
  quiet.threads = 1;
  std::optional<double> measured;
  SceneHypotheses first_scene;
  for (std::size_t k = 0; k < result.scenes.size() && !context.stopped(); ++k) {
    if (!result.scenes[k].view || result.scenes[k].unreadable) continue;
    const SceneFiles& files = dataset.scenes[k];
    const auto cloud = read_scene_cloud(files, request, context.stop);
    if (!cloud || !matches_by_pattern(dataset.target, *cloud)) return std::nullopt;
    const BoardView& view = *result.scenes[k].view;
    const auto look = [&](double size) {
      return at_size(*cloud, result, view, size, request.options.localization, quiet);
    };
    const auto hypotheses = [&](std::vector<BoardCandidate> candidates) {
      SceneHypotheses out = seen_by_camera(view, result.target, *measured);
      out.candidates = std::move(candidates);
      return out;
    };
    if (measured) {
      // Among so many sizes something may look like the board by chance, but not in two scenes at
      // places that agree. Their distances are known as well as the size is.
      auto again = look(*measured);
      const BoardCandidate best = best_of(again);
      if (!(best.gain > 0) || std::abs(best.scale - 1.0) >= kSameSize) continue;
      const SceneHypotheses here = hypotheses(std::move(again));
      loose.systematic_translation_m =
          kSameSize * std::max(first_scene.camera_from_board.transform.translation.norm(),
                               here.camera_from_board.transform.translation.norm());
      const auto both = decide_scenes({first_scene, here}, request.guess, loose);
      if (both && both->agreeing == 2) return measured;
      continue;
    }
    // The size of the strongest evidence, and the candidate there.
    const auto best_size = [&](const std::vector<double>& sizes) {
      std::vector<BoardCandidate> found(sizes.size());
      parallel_for(sizes.size(), context.thread_count(), [&](std::size_t i) {
        if (!context.stopped()) found[i] = best_of(look(sizes[i]));
      });
      const auto best = std::max_element(
          found.begin(), found.end(), [](const auto& a, const auto& b) { return a.gain < b.gain; });
      return std::pair(sizes[static_cast<std::size_t>(best - found.begin())], *best);
    };
    const auto [coarse, first] = best_size(sizes_of(result.target));
    if (first.gain <= 0) return std::nullopt;
    // Some per cent off, a board set slightly askew fits nearly as well, and measures a wrong
    // scale: only next to the true size can the measured scale be trusted.
    std::vector<double> finer;
    for (int percent = -5; percent <= 5; ++percent)
      finer.push_back(coarse * (1.0 + 0.01 * percent));
    const auto [size, candidate] = best_size(finer);
    if (candidate.gain <= 0) return std::nullopt;
    measured = size * candidate.scale;
    first_scene = hypotheses(look(*measured));
  }
  const auto views = std::count_if(result.scenes.begin(), result.scenes.end(),
                                   [](const SceneResult& scene) { return scene.view.has_value(); });
  return views == 1 ? measured : std::nullopt;
}

}  // namespace lvcalib
