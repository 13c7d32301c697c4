// SPDX-License-Identifier: BSD-3-Clause
#include "response/boundary_response.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>

#include "base/parallel.h"
#include "base/statistics.h"
#include "response/angular_width.h"
#include "response/edge_samples.h"
#include "response/response_statistics.h"

namespace lvcalib {
namespace {

// A fit needs no more points than this; every n-th is taken beyond.
constexpr std::size_t kMostFitPoints = 20'000;
constexpr std::size_t kFirstFitPoints = 4'000;

std::vector<TransitionPoint> points_of(const SceneResponse& scene, const Target& target,
                                       double mu_in, double contrast) {
  std::vector<TransitionPoint> points;
  points.reserve(scene.samples.size());
  for (const BoundarySample& s : scene.samples) {
    if (scene.nodes[static_cast<std::size_t>(s.node)].state != NodeResponseState::kUsed ||
        !clear_of_tags(s, target))
      continue;
    points.push_back(
        {static_cast<double>(s.distance_m), (static_cast<double>(s.intensity) - mu_in) / contrast});
  }
  return points;
}

template <class Point>
std::vector<Point> thinned(const std::vector<Point>& points, std::size_t most) {
  const std::size_t step = 1 + points.size() / most;
  std::vector<Point> out;
  out.reserve(points.size() / step + 1);
  for (std::size_t k = 0; k < points.size(); k += step) out.push_back(points[k]);
  return out;
}

Message no_node_reason(const SceneResponse& scene) {
  if (scene.nodes.empty()) return Message("no circle gives boundary samples");
  std::map<NodeResponseState, int, std::greater<>> counts;
  for (const NodeResponse& node : scene.nodes) ++counts[node.state];
  std::vector<Message> words;
  for (const auto& [why, count] : counts) words.push_back(Message("%1 × %2", count, describe(why)));
  return Message("no circle gives boundary samples: %1 (the first: %2)", joined(words, ", "),
                 scene.nodes.front().reason);
}

// Gives every sample the width that the transition has in its direction.
bool widen(SceneResponse& scene, const Target& target) {
  std::vector<const BoundarySample*> used;
  for (const BoundarySample& s : scene.samples) {
    if (scene.nodes[static_cast<std::size_t>(s.node)].state == NodeResponseState::kUsed &&
        clear_of_tags(s, target))
      used.push_back(&s);
  }
  const auto width = fit_angular_width(thinned(used, kMostFitPoints));
  if (!width) return false;
  for (BoundarySample& s : scene.samples) {
    const Eigen::Vector2d b = s.across_m.cast<double>();
    s.width_m = static_cast<float>(std::sqrt(b.dot(width->covariance_rad2 * b)));
  }
  scene.relative_width_sigma = width->relative_sigma;
  return true;
}

// A first width for judging the nodes: of the transitions about all nodes that the refinement took,
// or where they show none, the refinement's footprint.
void find_first_widths(SceneResponse& scene, const BoardRefinement& refinement,
                       const Target& target) {
  constexpr double kStart = 0.15;  // of the radius
  std::vector<TransitionPoint> points;
  for (const BoundarySample& s : scene.samples) {
    if (refinement.nodes[static_cast<std::size_t>(s.node)].valid)
      points.push_back({static_cast<double>(s.distance_m), static_cast<double>(s.intensity)});
  }
  const auto fit =
      fit_transition(thinned(points, kFirstFitPoints), kStart * target.circle_radius_m);
  if (!fit) return;
  for (BoundarySample& s : scene.samples) s.width_m = static_cast<float>(fit->sigma_m);
}

// Samples, nodes and transition of one scene; its statistics wait for all scenes.
SceneResponse respond(const ResponseInput& input, const Target& target,
                      const ResponseOptions& options) {
  SceneResponse scene;
  scene.name = input.name;
  if (!input.board_points->has_intensity()) {
    scene.reason = Message("the cloud has no intensity");
    return scene;
  }
  scene.samples = collect_edge_samples(input, target);
  find_first_widths(scene, *input.refinement, target);
  scene.nodes = judge_nodes(*input.refinement, scene.samples, 0.0, target, options);
  const bool any = std::any_of(scene.nodes.begin(), scene.nodes.end(), [](const NodeResponse& n) {
    return n.state == NodeResponseState::kUsed;
  });
  if (!any) {
    scene.reason = no_node_reason(scene);
    return scene;
  }
  std::vector<double> widths;
  for (const BoundarySample& s : scene.samples) widths.push_back(static_cast<double>(s.width_m));
  scene.transition = fit_transition(thinned(points_of(scene, target, 0.0, 1.0), kMostFitPoints),
                                    median(std::move(widths)));
  if (!scene.transition) {
    scene.reason =
        Message("the intensities about the circles show no transition from black to white");
    return scene;
  }
  if (!widen(scene, target)) {
    scene.transition.reset();
    scene.reason = Message("the transitions about the circles have no common width");
    return scene;
  }
  scene.nodes =
      judge_nodes(*input.refinement, scene.samples, scene.transition->delta_m, target, options);
  return scene;
}

OverlapSet overlap_of(const SceneResponse& scene, const Target& target,
                      const ResponseOptions& options) {
  OverlapSet set;
  if (!scene.transition) return set;
  for (const BoundarySample& s : scene.samples) {
    if (!s.overlap) continue;
    set.samples.push_back(&s);
    set.half_width_m.push_back(overlap_half_width_m(s, target, options));
    set.shift_m.push_back(scene.transition->delta_m);
  }
  set.relative_width_sigma = scene.relative_width_sigma;
  return set;
}

Message too_few(std::size_t n, int needed) {
  return Message(
      "not enough samples for statistics: %1 in the overlap region, needed %2 around the circles",
      n, needed);
}

// Levels differ from scene to scene: the common fit is of levels scaled to each scene's own.
std::optional<TransitionFit> fit_together(const std::vector<SceneResponse>& scenes,
                                          const Target& target) {
  std::vector<TransitionPoint> points;
  double weight = 0.0;
  TransitionFit mean;
  const TransitionFit* first = nullptr;
  for (const SceneResponse& scene : scenes) {
    if (!scene.transition) continue;
    const TransitionFit& t = *scene.transition;
    if (first == nullptr) first = &t;
    const auto own = points_of(scene, target, t.mu_in, t.mu_out - t.mu_in);
    points.insert(points.end(), own.begin(), own.end());
    const double w = static_cast<double>(t.samples);
    mean.mu_in += w * t.mu_in;
    mean.mu_out += w * t.mu_out;
    mean.noise += w * t.noise;
    weight += w;
  }
  if (first == nullptr) return std::nullopt;
  auto fit = fit_transition(thinned(points, kMostFitPoints), first->sigma_m);
  if (!fit) return std::nullopt;
  const double low = mean.mu_in / weight;
  const double contrast = mean.mu_out / weight - low;
  fit->mu_out = low + contrast * fit->mu_out;
  fit->mu_in = low + contrast * fit->mu_in;
  fit->mu_in_sigma *= contrast;
  fit->mu_out_sigma *= contrast;
  fit->noise = mean.noise / weight;
  return fit;
}

// Parts the overlap samples into classes; a class that is not asked about spans everything.
std::vector<ResponseCell> classify(const OverlapSet& all, const JitterShare& jitter,
                                   const ResponseOptions& options, bool by_range,
                                   bool by_incidence) {
  std::map<std::pair<int, int>, OverlapSet> cells;
  for (std::size_t k = 0; k < all.samples.size(); ++k) {
    const BoundarySample& s = *all.samples[k];
    const double incidence =
        180.0 / std::numbers::pi * std::acos(std::min(1.0, static_cast<double>(s.cos_incidence)));
    const int r =
        by_range ? static_cast<int>(static_cast<double>(s.range_m) / options.range_bin_m) : 0;
    const int i = by_incidence ? static_cast<int>(incidence / options.incidence_bin_deg) : 0;
    OverlapSet& cell = cells[{r, i}];
    cell.samples.push_back(all.samples[k]);
    cell.half_width_m.push_back(all.half_width_m[k]);
    cell.shift_m.push_back(all.shift_m[k]);
    cell.relative_width_sigma = all.relative_width_sigma;
  }
  double farthest = 0.0;
  for (const BoundarySample* s : all.samples)
    farthest = std::max(farthest, static_cast<double>(s->range_m));
  std::vector<ResponseCell> out;
  for (const auto& [at, set] : cells) {
    ResponseCell cell;
    cell.range_low_m = by_range ? at.first * options.range_bin_m : 0.0;
    cell.range_high_m = by_range ? cell.range_low_m + options.range_bin_m : farthest;
    cell.incidence_low_deg = by_incidence ? at.second * options.incidence_bin_deg : 0.0;
    cell.incidence_high_deg =
        by_incidence ? std::min(90.0, cell.incidence_low_deg + options.incidence_bin_deg) : 90.0;
    cell.n = static_cast<int>(set.samples.size());
    cell.statistics = summarize_response(set, jitter, options.min_samples);
    out.push_back(std::move(cell));
  }
  return out;
}

void summarize(BoundaryResponse& response, const Target& target, const ResponseOptions& options) {
  std::vector<OverlapSet> sets;
  OverlapSet all;
  for (const SceneResponse& scene : response.scenes) {
    sets.push_back(overlap_of(scene, target, options));
    all.append(sets.back());
  }
  JitterShare jitter;
  if (!all.samples.empty()) {
    std::vector<const BoundarySample*> samples;
    for (const SceneResponse& scene : response.scenes) {
      if (!scene.transition) continue;
      for (const BoundarySample& s : scene.samples) samples.push_back(&s);
    }
    jitter = measure_jitter_share(samples, angular_covariance(all));
  }
  response.jitter_share = jitter.share;
  response.jitter_share_sigma = jitter.sigma;
  for (std::size_t s = 0; s < response.scenes.size(); ++s) {
    SceneResponse& scene = response.scenes[s];
    scene.statistics = summarize_response(sets[s], jitter, options.min_samples);
    if (!scene.statistics && scene.reason.empty())
      scene.reason = too_few(sets[s].samples.size(), options.min_samples);
  }
  response.transition = fit_together(response.scenes, target);
  response.all = summarize_response(all, jitter, options.min_samples);
  if (!response.all) {
    response.reason = too_few(all.samples.size(), options.min_samples);
    for (const SceneResponse& scene : response.scenes) {
      if (!scene.reason.empty())
        response.reason +=
            Message::verbatim("; ") + Message("scene %1: %2", scene.name, scene.reason);
    }
    return;
  }
  response.by_range = classify(all, jitter, options, true, false);
  response.by_incidence = classify(all, jitter, options, false, true);
  response.by_both = classify(all, jitter, options, true, true);
}

}  // namespace

Message describe(NodeResponseState state) {
  switch (state) {
    case NodeResponseState::kUsed:
      return Message("used");
    case NodeResponseState::kNotRefined:
      return Message("not refined");
    case NodeResponseState::kTooFewSamples:
      return Message("not enough samples");
    case NodeResponseState::kNoContrast:
      return Message("no contrast");
    case NodeResponseState::kClipped:
      return Message("intensity clipped");
  }
  return {};
}

Result<BoundaryResponse> calibrate_boundary_response(const std::vector<ResponseInput>& scenes,
                                                     const Target& target,
                                                     const ResponseOptions& options,
                                                     const RunContext& context) {
  BoundaryResponse response;
  if (!target.has_circles()) {
    response.reason = Message("this board has no circles");
    return response;
  }
  if (scenes.empty()) {
    response.reason = Message("not enough scenes for a boundary response: none is in use");
    return response;
  }
  response.scenes.resize(scenes.size());
  parallel_for(scenes.size(), context.thread_count(), [&](std::size_t s) {
    if (!context.stopped()) response.scenes[s] = respond(scenes[s], target, options);
  });
  if (context.stopped()) return Error::cancelled();
  summarize(response, target, options);
  return response;
}

}  // namespace lvcalib
