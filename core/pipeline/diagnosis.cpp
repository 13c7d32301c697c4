// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/diagnosis.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "base/parallel.h"
#include "base/text.h"
#include "cloud/intensity_lag.h"
#include "pipeline/forward_stage.h"
#include "pipeline/scene_loading.h"

namespace lvcalib {
namespace {
namespace fs = std::filesystem;

struct CloudReading {
  Message what;  // Completes "the board is found if …".
  Message advice;
  Eigen::Vector3f by = Eigen::Vector3f::Ones();
  int intensity_lag = 0;
};

Cloud read_as(const Cloud& cloud, const CloudReading& reading) {
  if (reading.intensity_lag != 0) return without_intensity_lag(cloud, reading.intensity_lag);
  Cloud out = cloud;
  for (Eigen::Vector3f& p : out.points_m) p = p.cwiseProduct(reading.by);
  return out;
}

CloudReading mirrored() {
  // Mirrored along one axis is mirrored along any: the search does not care how a cloud is turned.
  return {Message("the clouds are mirrored (their axes make a left-handed frame)"),
          Message("exchange two axes, or the sign of one, in what writes the clouds"),
          Eigen::Vector3f(1.0F, -1.0F, 1.0F)};
}

// Points and intensities that do not belong together, by the shifts that the clouds suggest.
std::vector<CloudReading> shifted_intensities(const std::vector<Cloud>& clouds) {
  std::vector<int> lags;
  for (const Cloud& cloud : clouds) {
    if (lags.empty()) lags = intensity_lags(cloud);
  }
  std::vector<CloudReading> readings;
  for (const int lag : lags) {
    const int count = std::abs(lag);
    CloudReading reading;
    reading.what =
        lag > 0 ? Message("each intensity belongs to the point that stands %1 before it", count)
                : Message("each intensity belongs to the point that stands %1 after it", count);
    reading.advice = Message("write every intensity with its own point");
    reading.intensity_lag = lag;
    readings.push_back(std::move(reading));
  }
  return readings;
}

double middle_distance_m(const BoardView& view, const Target& target) {
  const Eigen::Vector2d c = target.outline().center_m();
  return (view.camera_from_board.transform * Eigen::Vector3d(c.x(), c.y(), 0.0)).norm();
}

}  // namespace

SceneHypotheses seen_by_camera(const BoardView& view, const Target& target, double size) {
  SceneHypotheses h;
  h.camera_from_board = view.camera_from_board;
  h.camera_from_board.transform.translation *= size;
  h.alternative_camera_from_board = view.alternative_pose;
  if (h.alternative_camera_from_board) h.alternative_camera_from_board->translation *= size;
  h.board_middle_m = size * target.outline().center_m();
  return h;
}

std::vector<LengthUnit> other_length_units() {
  return {{Message("in millimetres"), 1e-3},
          {Message("in centimetres"), 1e-2},
          {Message("in feet"), 0.3048},
          {Message("in inches"), 0.0254}};
}

std::optional<Error> diagnose_clouds(const Dataset& dataset, const CalibrationRequest& request,
                                     const CalibrationResult& result, const RunContext& context) {
  std::vector<CloudReading> readings;
  for (const LengthUnit& unit : other_length_units()) {
    readings.push_back({Message("the clouds are %1", unit.what),
                        Message("write the clouds in metres"),
                        Eigen::Vector3f::Constant(static_cast<float>(unit.in_m))});
  }
  readings.push_back(mirrored());
  // Something may look like the board by chance, but hardly twice in the same place of the rig.
  constexpr std::size_t kMostScenes = 3;  // Two that agree, and one that may show nothing.
  std::vector<std::size_t> seen;
  std::vector<Cloud> clouds;
  for (std::size_t s = 0; s < result.scenes.size() && seen.size() < kMostScenes; ++s) {
    if (!result.scenes[s].view || result.scenes[s].unreadable) continue;
    auto cloud = read_scene_cloud(dataset.scenes[s], request, context.stop);
    if (!cloud) return std::nullopt;
    seen.push_back(s);
    clouds.push_back(std::move(*cloud));
  }
  for (CloudReading& reading : shifted_intensities(clouds)) readings.push_back(std::move(reading));
  const PatternPyramid pyramid(dataset.target);
  RunContext quiet = context.silent();
  quiet.threads = 1;
  std::vector<std::vector<BoardCandidate>> found(readings.size() * seen.size());
  const auto look = [&](std::size_t reading, std::size_t k) {
    if (context.stopped()) return;
    const BoardView& view = *result.scenes[seen[k]].view;
    found[reading * seen.size() + k] =
        search_board(read_as(clouds[k], readings[reading]),
                     {dataset.target, pyramid, middle_distance_m(view, dataset.target)},
                     request.options.localization, quiet)
            .candidates;
  };
  for (std::size_t k = 0; k < seen.size(); ++k) {
    // The other scenes are asked about what the first one speaks for.
    std::vector<std::size_t> asked;
    for (std::size_t r = 0; r < readings.size(); ++r) {
      if (k == 0 || !found[r * seen.size()].empty()) asked.push_back(r);
    }
    parallel_for(asked.size(), context.thread_count(), [&](std::size_t i) { look(asked[i], k); });
  }
  std::size_t best = 0;
  int most = 0;
  for (std::size_t r = 0; r < readings.size() && !context.stopped(); ++r) {
    std::vector<SceneHypotheses> scenes;
    for (std::size_t k = 0; k < seen.size(); ++k) {
      scenes.push_back(seen_by_camera(*result.scenes[seen[k]].view, dataset.target));
      scenes.back().candidates = found[r * seen.size() + k];
    }
    const auto consensus = decide_scenes(scenes, std::nullopt, request.options.consensus);
    if (!consensus || consensus->agreeing <= most) continue;
    most = consensus->agreeing;
    best = r;
  }
  if (context.stopped() || most < std::min<int>(2, static_cast<int>(seen.size())) || most == 0)
    return std::nullopt;
  return Error::untrusted(
      Message("the board is not found in any cloud, but it is if %1", readings[best].what),
      dataset.scenes[seen.front()].cloud.string(), readings[best].advice);
}

std::optional<std::pair<std::size_t, std::size_t>> exchanged_images(
    std::vector<SceneHypotheses> scenes, int agreeing, const ConsensusOptions& options) {
  // Every pair of a hundred scenes is five thousand decisions; more than that nobody waits for.
  constexpr std::size_t kMostScenes = 100;
  std::vector<std::size_t> seen;
  for (std::size_t s = 0; s < scenes.size(); ++s) {
    if (!scenes[s].candidates.empty()) seen.push_back(s);
  }
  const int all = static_cast<int>(seen.size());
  if (all < 2 || agreeing >= all || seen.size() > kMostScenes) return std::nullopt;
  const auto exchange = [&](std::size_t a, std::size_t b) {
    std::swap(scenes[a].camera_from_board, scenes[b].camera_from_board);
    std::swap(scenes[a].alternative_camera_from_board, scenes[b].alternative_camera_from_board);
  };
  for (const std::size_t a : seen) {
    for (const std::size_t b : seen) {
      if (b <= a) continue;
      exchange(a, b);
      const auto consensus = decide_scenes(scenes, std::nullopt, options);
      if (consensus && consensus->agreeing == all) return std::pair(a, b);
      exchange(a, b);
    }
  }
  return std::nullopt;
}

std::optional<Error> diagnose_exchanged_clouds(const Dataset& dataset,
                                               const CalibrationRequest& request,
                                               const CalibrationResult& result,
                                               const RunContext& context) {
  // Every pair is two searches, after a failure.
  constexpr std::size_t kMostScenes = 6;  // Fifteen pairs, thirty searches.
  std::vector<std::size_t> seen;
  std::vector<SceneHypotheses> scenes;
  for (std::size_t s = 0; s < result.scenes.size(); ++s) {
    if (!result.scenes[s].view || result.scenes[s].unreadable) continue;
    seen.push_back(s);
    scenes.push_back(hypotheses_of(result.scenes[s], dataset.target));
    if (scenes.back().candidates.empty())
      scenes.back() = seen_by_camera(*result.scenes[s].view, dataset.target);
  }
  // Two scenes agree with anything.
  if (seen.size() < 3 || seen.size() > kMostScenes) return std::nullopt;
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  for (std::size_t b = 0; b < seen.size(); ++b) {
    for (std::size_t a = 0; a < b; ++a) pairs.emplace_back(a, b);
  }
  const PatternPyramid pyramid(dataset.target);
  RunContext quiet = context.silent();
  quiet.threads = 1;
  std::vector<int> agreeing(pairs.size(), 0);
  parallel_for(pairs.size(), context.thread_count(), [&](std::size_t p) {
    const auto [a, b] = pairs[p];
    std::vector<SceneHypotheses> tried = scenes;
    for (const auto& [image, cloud] : {std::pair(a, b), std::pair(b, a)}) {
      const auto points = read_scene_cloud(dataset.scenes[seen[cloud]], request, context.stop);
      if (!points || context.stopped()) return;
      const BoardView& view = *result.scenes[seen[image]].view;
      tried[image] = seen_by_camera(view, dataset.target);
      tried[image].candidates =
          search_board(*points, {dataset.target, pyramid, middle_distance_m(view, dataset.target)},
                       request.options.localization, quiet)
              .candidates;
    }
    const auto consensus = decide_scenes(tried, std::nullopt, request.options.consensus);
    agreeing[p] = consensus ? consensus->agreeing : 0;
  });
  const auto best = static_cast<std::size_t>(std::max_element(agreeing.begin(), agreeing.end()) -
                                             agreeing.begin());
  if (context.stopped() || agreeing[best] < static_cast<int>(seen.size())) return std::nullopt;
  return Error::untrusted(Message("the clouds or the images of scenes %1 and %2 seem to be "
                                  "exchanged: all scenes agree if they are",
                                  result.scenes[seen[pairs[best].first]].name,
                                  result.scenes[seen[pairs[best].second]].name),
                          dataset.path.string(),
                          Message("give each scene its own image and cloud"));
}

int fewest_agreeing(const std::vector<SceneHypotheses>& scenes, const SceneConsensus& consensus) {
  for (std::size_t s = 0; s < std::min(scenes.size(), consensus.chosen.size()); ++s) {
    const auto& chosen = consensus.chosen[s];
    if (chosen && *chosen < scenes[s].candidates.size() &&
        scenes[s].candidates[*chosen].correlation > 0.0)
      return 2;
  }
  return 3;
}

std::optional<Error> diagnose_mirrored(const Dataset& dataset, const CalibrationRequest& request,
                                       const CalibrationResult& result,
                                       std::vector<SceneHypotheses> scenes, int agreeing,
                                       const RunContext& context) {
  const PatternPyramid pyramid(dataset.target);
  const CloudReading reading = mirrored();
  parallel_for(scenes.size(), context.thread_count(), [&](std::size_t s) {
    scenes[s].candidates.clear();
    if (!result.scenes[s].view || context.stopped()) return;
    const auto cloud = read_scene_cloud(dataset.scenes[s], request, context.stop);
    if (!cloud) return;
    RunContext quiet = context.silent();
    quiet.threads = 1;
    scenes[s].candidates = search_board(read_as(*cloud, reading),
                                        {dataset.target, pyramid,
                                         middle_distance_m(*result.scenes[s].view, dataset.target)},
                                        request.options.localization, quiet)
                               .candidates;
  });
  const auto consensus = decide_scenes(scenes, std::nullopt, request.options.consensus);
  if (context.stopped() || !consensus) return std::nullopt;
  if (consensus->agreeing < std::max(fewest_agreeing(scenes, *consensus), agreeing + 1))
    return std::nullopt;
  return Error::untrusted(Message("the scenes do not agree, but %1 of them do if %2",
                                  consensus->agreeing, reading.what),
                          dataset.path.string(), reading.advice);
}

Message diagnose_guess(const Rigid3& guess, const Rigid3& found) {
  // A rough extrinsic is good to some 20°, and to half a metre or its length.
  const auto near = [&](const Rigid3& a) {
    return rotation_distance_rad(a, found) < 0.35 &&
           (a.translation - found.translation).norm() < 0.1 + 0.3 * found.translation.norm();
  };
  if (near(guess.inverse()))
    return Message("it is the inverse: T_lidar_camera instead of T_camera_lidar");
  Rigid3 metres = guess;
  metres.translation *= 1e-3;
  if (guess.translation.norm() > 5.0 && near(metres))
    return Message("its translation is in millimetres");
  metres = guess.inverse();
  metres.translation *= 1e-3;
  if (guess.translation.norm() > 5.0 && near(metres))
    return Message("it is the inverse, with its translation in millimetres");
  if (rotation_distance_rad(guess, Rigid3()) < 1e-6)
    return Message("its rotation is the identity, but the sensors' axes point in other directions");
  return Message("it is off by %1 m and %2°",
                 formatted("%.2f", (guess.translation - found.translation).norm()),
                 formatted("%.0f", rotation_distance_rad(guess, found) * 180.0 / M_PI));
}

Message diagnose_unseen_tags(const CalibrationResult& result) {
  const Target& target = result.target;
  if (target.type != TargetType::kAprilGrid && target.type != TargetType::kAprilGridCircles)
    return {};
  std::set<int> seen;
  int views = 0;
  for (const SceneResult& scene : result.scenes) {
    if (!scene.view) continue;
    ++views;
    for (const CornerObservation& corner : scene.view->corners) seen.insert(corner.feature_id);
  }
  int columns = 0;
  int rows = 0;
  for (const TargetTag& tag : target.tags()) {
    if (!seen.contains(tag.id)) continue;
    columns = std::max(columns, tag.column + 1);
    rows = std::max(rows, tag.row + 1);
  }
  if (views < 2 || seen.empty() || (columns == target.tag_columns && rows == target.tag_rows))
    return {};
  std::vector<std::string> values;
  if (columns < target.tag_columns) values.push_back("tagCols: " + std::to_string(columns));
  if (rows < target.tag_rows) values.push_back("tagRows: " + std::to_string(rows));
  const std::string fields = joined(values, ", ");
  if (columns < target.tag_columns)
    return Message(
        "no image shows the tags of the right columns that target.yaml has: %1 would fit", fields);
  return Message("no image shows the tags of the upper rows that target.yaml has: %1 would fit",
                 fields);
}

Message better_circle_radius(const CalibrationResult& result) {
  // Round and straight edges of one image lie alike to this: what blur and sampling do to their
  // middle level differs by less.
  constexpr double kAgree_px = 0.25;
  double weights = 0.0;
  double radii = 0.0;
  double pixels = 0.0;
  for (const SceneResult& scene : result.scenes) {
    if (!scene.view || !(scene.view->circle_radius.radius_m > 0.0)) continue;
    const MeasuredRadius& seen = scene.view->circle_radius;
    const double weight = 1.0 / (seen.pixel_m * seen.pixel_m);
    weights += weight;
    radii += weight * seen.radius_m;
    pixels += weight * seen.pixel_m;
  }
  if (!(weights > 0.0)) return {};
  const double radius_m = radii / weights;
  // Alike in all images, so that more of them tell no better.
  if (std::abs(radius_m - result.target.circle_radius_m) < kAgree_px * pixels / weights) return {};
  return Message("their circles are of another size: %1 would fit",
                 formatted("circleRadius: %.4f", radius_m));
}

SceneHypotheses hypotheses_of(const SceneResult& scene, const Target& target) {
  if (!scene.view || !scene.search) return {};
  SceneHypotheses h = seen_by_camera(*scene.view, target);
  h.candidates = scene.search->candidates;
  return h;
}

Message describe_bump(const SceneGroup& first, const SceneGroup& second,
                      const std::string& last_before, const std::string& first_after) {
  const auto give = [](const SceneGroup& group) {
    const std::string names = joined(group.names, ", ");
    return group.names.size() > 1 ? Message("scenes %1 give", names)
                                  : Message("scene %1 gives", names);
  };
  const auto translation = [](const SceneGroup& group) {
    const Eigen::Vector3d& t = group.camera_from_lidar.translation;
    return formatted("%.3f %.3f ", t.x(), t.y()) + formatted("%.3f", t.z());
  };
  const Rigid3& a = first.camera_from_lidar;
  const Rigid3& b = second.camera_from_lidar;
  return Message(
      "%1 t = [%2] m, %3 t = [%4] m, %5 mm and %6 mrad apart: did a sensor move between scenes %7 "
      "and %8?",
      give(first), translation(first), give(second), translation(second),
      formatted("%.1f", 1e3 * translation_distance_m(a.inverse(), b.inverse())),
      formatted("%.1f", 1e3 * rotation_distance_rad(a, b)), last_before, first_after);
}

namespace {

// All scenes are in use, but miss each other by far more than an effect does: whether they split at
// a moment into two groups, each of which would be sound.
Message split_apart(const CalibrationResult& result) {
  constexpr double kFar = 10.0;  // Times the noise; and by so much less each group must miss.
  const ExtrinsicSolution& x = result.extrinsic;
  const double together = std::max(x.node_scale, x.plane_scale);
  if (result.model_fit || !(together > kFar)) return {};
  std::vector<bool> use;
  for (const SceneResult& scene : result.scenes) use.push_back(scene.used);
  std::vector<std::size_t> index;
  auto scenes = observations_of(result, use, index);
  // Planes alone do not hold a scene's place.
  std::erase_if(scenes, [](const SceneObservations& o) { return !o.use || o.nodes.empty(); });
  // Two always differ and each agrees with itself.
  if (scenes.size() < 3) return {};
  std::stable_sort(scenes.begin(), scenes.end(),
                   [](const auto& a, const auto& b) { return a.name < b.name; });
  ExtrinsicOptions how = result.options.extrinsic;
  how.reject_bad_scenes = false;
  struct Split {
    std::size_t at = 0;
    double scale = HUGE_VAL;
    Rigid3 before, after;
  } best;
  for (std::size_t at = 1; at < scenes.size(); ++at) {
    const auto group = [&](bool later) {
      for (std::size_t k = 0; k < scenes.size(); ++k) scenes[k].use = (k >= at) == later;
      return solve_extrinsic({scenes, result.camera, result.target, how});
    };
    const auto before = group(false);
    const auto after = group(true);
    if (!before || !after || before->rank < 6 || after->rank < 6) continue;
    const double scale =
        std::max({before->node_scale, before->plane_scale, after->node_scale, after->plane_scale});
    if (scale >= best.scale) continue;
    best = {at, scale, before->camera_from_lidar.transform, after->camera_from_lidar.transform};
  }
  if (!(kFar * best.scale < together)) return {};
  std::vector<std::string> names[2];
  for (std::size_t k = 0; k < scenes.size(); ++k)
    names[k < best.at ? 0 : 1].push_back(scenes[k].name);
  return describe_bump({names[0], best.before}, {names[1], best.after}, scenes[best.at - 1].name,
                       scenes[best.at].name);
}

}  // namespace

Message diagnose_bump(const CalibrationResult& result) {
  // In the order in which scenes are taken, their names. That an image is turned is told as that.
  std::vector<std::size_t> order;
  for (std::size_t s = 0; s < result.scenes.size(); ++s) {
    const SceneResult& scene = result.scenes[s];
    if (scene.used || (scene.contradicts && !scene.turned_image)) order.push_back(s);
  }
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return result.scenes[a].name < result.scenes[b].name;
  });
  const auto used = [&](std::size_t s) { return result.scenes[s].used; };
  const auto middle = std::partition_point(
      order.begin(), order.end(), [&](std::size_t s) { return used(s) == used(order.front()); });
  if (middle == order.end()) return split_apart(result);
  if (order.size() < 2 || std::any_of(middle, order.end(), [&](std::size_t s) {
        return used(s) == used(order.front());
      }))
    return {};
  std::vector<SceneHypotheses> others;
  std::vector<std::string> names[2];
  for (auto at = order.begin(); at != order.end(); ++at) {
    names[used(*at) ? 0 : 1].push_back(result.scenes[*at].name);
    if (!used(*at)) others.push_back(hypotheses_of(result.scenes[*at], result.target));
  }
  const auto agreed = decide_scenes(others, std::nullopt, result.options.consensus);
  if (!agreed || agreed->agreeing != static_cast<int>(others.size())) return {};
  return describe_bump({names[0], result.extrinsic.camera_from_lidar.transform},
                       {names[1], agreed->camera_from_lidar.transform},
                       result.scenes[*(middle - 1)].name, result.scenes[*middle].name);
}

Message search_summary(const SceneResult& scene) {
  if (!scene.search) return Message("not searched");
  if (!(scene.search->best_correlation > 0))
    return Message("%1 flat patches of its size", scene.search->patches);
  return Message("%1 flat patches of its size, best pattern correlation %2", scene.search->patches,
                 std::to_string(scene.search->best_correlation).substr(0, 4));
}

Message missing_board(const SceneResult& scene) {
  const Message search = search_summary(scene);
  switch (scene.place) {
    case BoardPlace::kPast:
      return Message(
          "the board is not found in the cloud (%1); the LiDAR sees past the place where the "
          "image has it: does the image belong to this cloud?",
          search);
    case BoardPlace::kHidden:
      return Message(
          "the board is not found in the cloud (%1); something nearer stands where the image has "
          "it: does the image belong to this cloud, or is the board hidden from the LiDAR?",
          search);
    case BoardPlace::kTaken:
      return Message(
          "the board is not found in the cloud: something stands where the other scenes put it, "
          "with too few lines or points to tell its print");
    case BoardPlace::kOpen:
      break;
  }
  return Message("the board is not found in the cloud (%1)", search);
}

}  // namespace lvcalib
