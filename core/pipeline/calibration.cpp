// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/calibration.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>

#include "base/parallel.h"
#include "base/text.h"
#include "pipeline/camera_resection.h"
#include "pipeline/diagnosis.h"
#include "pipeline/quality.h"
#include "pipeline/scene_copies.h"
#include "pipeline/scene_loading.h"
#include "pipeline/standing_board.h"
#include "pipeline/stopwatch.h"
#include "pipeline/turned_images.h"

namespace lvcalib {
namespace {

std::vector<SceneHypotheses> hypotheses(const CalibrationResult& result) {
  std::vector<SceneHypotheses> out;
  for (const SceneResult& scene : result.scenes) {
    out.push_back(hypotheses_of(scene, result.target));
    // What its image says is of another camera.
    if (scene.turned_image) out.back().candidates.clear();
  }
  return out;
}

// What a calibration is given.
struct CalibrationInput {
  const Dataset& dataset;
  const CalibrationRequest& request;
  const RunContext& context;
  StageCache* cache;  // Null: there is none.
  const CalibrationObserver& observer;
};

// What has become of it so far.
struct Calibration {
  CalibrationResult result;
  std::vector<std::optional<BoardPlane>> planes;  // Per scene, where it was fitted in this run.
  std::vector<char> looked_twice;                 // Per scene; not bool, scenes run in parallel.
  std::vector<SameContent> same;                  // Per scene: what it shares with another.
  bool looked_for_sizes = false;
  bool looked_for_readings = false;
};

std::optional<SceneConsensus> decide(const CalibrationInput& in, const CalibrationResult& result) {
  return decide_scenes(hypotheses(result), in.request.guess, in.request.options.consensus);
}

Status prepare(const CalibrationInput& in, Calibration& run) {
  run.result.dataset = place_of(in.dataset);
  run.result.target = in.dataset.target;
  run.result.camera = in.dataset.camera;
  run.result.intrinsics = start_intrinsics(in.dataset, in.request.options.intrinsics.kind());
  run.result.warnings = in.dataset.warnings;
  run.result.options = in.request.options;
  run.result.inputs = hash_inputs(in.dataset, in.request.use_crops, in.context);
  if (in.context.stopped()) return Error::cancelled();
  run.looked_twice.assign(in.dataset.scenes.size(), 0);
  for (const SceneFiles& files : in.dataset.scenes) {
    SceneResult scene;
    scene.name = files.name;
    if (std::find(in.request.rejected.begin(), in.request.rejected.end(), files.name) !=
        in.request.rejected.end()) {
      reject(scene);
    } else if (files.problem) {
      scene.reason = files.problem->sentence();
      scene.unreadable = true;
    }
    scene.insisted = std::find(in.request.insisted.begin(), in.request.insisted.end(),
                               files.name) != in.request.insisted.end();
    if (const auto edits = in.request.edits.find(files.name); edits != in.request.edits.end())
      scene.edits = edits->second;
    run.result.scenes.push_back(std::move(scene));
  }
  run.same = same_content(in.dataset, in.request.use_crops, run.result.inputs);
  note_same_content(run.result, run.same);
  for (const std::string& name : in.request.rejected) {
    const bool known = std::any_of(in.dataset.scenes.begin(), in.dataset.scenes.end(),
                                   [&](const SceneFiles& f) { return f.name == name; });
    if (!known)
      return Error::usage(Message("there is no scene '%1' to reject", name),
                          in.dataset.path.string());
  }
  return Done{};
}

// What the user left out of the images, before anything is made of it.
void take_out_tags(std::vector<SceneResult>& scenes) {
  for (SceneResult& scene : scenes) {
    if (!scene.view || scene.edits.tags.empty()) continue;
    scene.left_out_corners = take_out(*scene.view, scene.edits);
    constexpr std::size_t kFewest = 4;  // Points that a pose takes.
    if (scene.view->corners.size() >= kFewest) continue;
    scene.view.reset();
    if (scene.reason.empty())
      scene.reason = Message("too few tags: the others are left out by the user");
  }
}

// The board must be seen in at least one image that has a cloud.
Status some_view(const CalibrationResult& result) {
  const SceneResult* unreadable = nullptr;
  for (const SceneResult& scene : result.scenes) {
    if (scene.view && !scene.unreadable) return Done{};
    if (scene.unreadable && unreadable == nullptr) unreadable = &scene;
  }
  if (unreadable != nullptr)
    return Error::input(
        Message("no scene can be used; scene %1: %2", unreadable->name, unreadable->reason));
  for (const SceneResult& scene : result.scenes) {
    if (!scene.reason.empty() && !scene.rejected) {
      return Error::input(
          Message("the board is not found in any image; scene %1: %2", scene.name, scene.reason));
    }
  }
  return Error::input(Message("every scene is rejected"), result.dataset);
}

// Which squares of a checkerboard are black is not in its description; the images say it.
void settle_colors(CalibrationResult& result) {
  int views = 0;
  int other = 0;
  for (const SceneResult& scene : result.scenes) {
    if (!scene.view) continue;
    ++views;
    other += scene.view->other_colors ? 1 : 0;
  }
  const bool most = 2 * other > views;
  if (most) result.target.white_first = !result.target.white_first;
  for (SceneResult& scene : result.scenes) {
    if (!scene.view || scene.view->other_colors == most || !scene.reason.empty()) continue;
    scene.reason = Message(
        "its checkerboard has black and white squares the other way round than in most scenes: "
        "is it another board, or is the image mirrored?");
  }
}

// What the images contradict whatever the clouds say: target.yaml, or the intrinsics. A wrong focal
// length makes every distance, and with it the board's size, wrong.
std::optional<Error> contradicted_by_images(const CalibrationResult& result) {
  if (const Message spacing = better_spacing(result); !spacing.empty()) {
    return Error::untrusted(Message("the images contradict target.yaml: %1", spacing),
                            result.dataset, Message("measure the print and correct target.yaml"));
  }
  if (const Message what = contradicted_by_corners(result); !what.empty()) {
    return Error::untrusted(Message("the images contradict the intrinsics: %1", what),
                            result.dataset,
                            Message("calibrate the camera again, or use --intrinsics free"));
  }
  return std::nullopt;
}

// Files that stand in for others' contradict their scenes in ways that other faults would
// explain, too: what is known for sure comes first.
std::optional<Error> shared_files(const CalibrationResult& result) {
  for (const SceneResult& scene : result.scenes) {
    if (scene.shared_file.empty()) continue;
    return Error::input(scene.shared_file, result.dataset,
                        Message("give each scene its own image and cloud"));
  }
  return std::nullopt;
}

bool several_views(const CalibrationResult& result) {
  return std::count_if(result.scenes.begin(), result.scenes.end(),
                       [](const SceneResult& s) { return s.view && !s.unreadable; }) > 1;
}

// The error to give if the board is there in clouds read or given to scenes another way.
std::optional<Error> wrong_clouds(const CalibrationInput& in, Calibration& run) {
  if (run.looked_for_readings) return std::nullopt;
  run.looked_for_readings = true;
  if (const auto error = shared_files(run.result)) return error;
  if (auto error = diagnose_exchanged_clouds(in.dataset, in.request, run.result, in.context))
    return error;
  auto error = diagnose_clouds(in.dataset, in.request, run.result, in.context);
  if (in.context.stopped()) return Error::cancelled();
  return error;
}

// The error to give if the board is there, but in another size.
std::optional<Error> wrong_size(const CalibrationInput& in, Calibration& run) {
  if (run.looked_for_sizes) return std::nullopt;
  run.looked_for_sizes = true;
  in.context.report("localize", 0.7, Message("other sizes of the board"));
  const auto scale = find_scaled_board(in.dataset, in.request, run.result, in.context);
  if (in.context.stopped()) return Error::cancelled();
  // A board of the right size was found before, and refused for another reason.
  constexpr double kSame = 0.005;
  if (!scale || std::abs(*scale - 1.0) < kSame) return std::nullopt;
  constexpr double kSameUnit = 0.05;  // The size is measured to some per cent, units lie afar.
  for (const LengthUnit& unit : other_length_units()) {
    if (std::abs(*scale / unit.in_m - 1.0) > kSameUnit) continue;
    return Error::untrusted(
        Message("the board is not found in any cloud, but it is if the lengths in target.yaml "
                "are %1",
                unit.what),
        run.result.dataset,
        Message("write them in metres: multiply each by %1", formatted("%g", unit.in_m)));
  }
  const int percent = static_cast<int>(std::lround(100.0 * (*scale - 1.0)));
  // Of its own size it was looked for already: something else is wrong.
  if (percent == 0) return std::nullopt;
  if (const auto error = contradicted_by_images(run.result)) return error;
  return Error::untrusted(
      percent > 0 ? Message("LiDAR and camera disagree on the board's size: the LiDAR sees it "
                            "about %1 % larger than target.yaml says",
                            percent)
                  : Message("LiDAR and camera disagree on the board's size: the LiDAR sees it "
                            "about %1 % smaller than target.yaml says",
                            -percent),
      run.result.dataset, Message("measure the printed tags and correct tagSize"));
}

Error not_found(const CalibrationInput& in, Calibration& run) {
  if (const auto error = shared_files(run.result)) return *error;
  if (const auto error = contradicted_by_images(run.result)) return *error;
  // What two scenes agree on comes before what looks like the board in one of another size.
  if (several_views(run.result)) {
    if (const auto error = wrong_clouds(in, run)) return *error;
  }
  if (const auto error = wrong_size(in, run)) return *error;
  if (const auto error = wrong_clouds(in, run)) return *error;
  std::vector<Message> details;
  for (const SceneResult& scene : run.result.scenes) {
    const bool searched = scene.view && scene.reason.empty();
    details.push_back(
        Message("%1: %2", scene.name, searched ? search_summary(scene) : scene.reason));
  }
  return Error::untrusted(
      Message("the board is not found in any cloud (%1)", joined(details, "; ")),
      run.result.dataset,
      Message("check that the LiDAR sees the whole board and that target.yaml describes it"));
}

bool missing_scenes(const std::vector<SceneResult>& scenes, const SceneConsensus& consensus) {
  for (std::size_t s = 0; s < scenes.size(); ++s) {
    if (scenes[s].view && !consensus.chosen[s]) return true;
  }
  return false;
}

// Second look: where the other scenes put the board, or (without them) on walls everywhere.
Status search_again(const CalibrationInput& in, Calibration& run,
                    const std::optional<Rigid3>& camera_from_lidar) {
  const PatternPyramid pyramid(run.result.target);
  const BoardOutline outline = run.result.target.outline();
  const Eigen::Vector2d c = outline.center_m();
  for (std::size_t s = 0; s < run.result.scenes.size(); ++s) {
    SceneResult& scene = run.result.scenes[s];
    if (!scene.view || !scene.reason.empty()) continue;
    if (camera_from_lidar && run.result.consensus.chosen[s]) continue;
    BoardSearchRegion region;
    if (camera_from_lidar) {
      const Rigid3 board = camera_from_lidar->inverse() * scene.view->camera_from_board.transform;
      region.center_m = board * Eigen::Vector3d(c.x(), c.y(), 0.0);
      region.radius_m = 0.75 * outline.size_m().norm();
      region.width = board.rotation * Eigen::Vector3d::UnitX();
    }
    const SecondSearch where{in.dataset.scenes[s], in.request, region, run.result.target, pyramid};
    if (Status status = search_scene_again(where, in.context, scene, in.cache); !status)
      return status;
    run.looked_twice[s] = 1;
  }
  return Done{};
}

// Third look, by the outline alone, at flat patches on which the intensity is the same but for
// its noise: what is printed there the LiDAR cannot see. A patch with a print of its own is not
// this board.
Status search_plain_boards(const CalibrationInput& in, CalibrationResult& result) {
  if (!result.target.has_tags()) return Done{};
  const PatternPyramid pyramid(result.target);
  const BlurredPrint print(result.target);
  const auto is_plain = [&](const Cloud& cloud, const Rigid3& lidar_from_board) {
    BeamSpread beam;
    beam.blur_rad2 =
        std::pow(in.request.options.forward.first_blur_rad, 2) * Eigen::Matrix2d::Identity();
    constexpr RangeNoise kRange{0.02, 0.02};
    const auto returns = select_returns(cloud, print, lidar_from_board, beam, kRange);
    return returns.has_intensity && intensity_structure(returns) < kPlainStructure;
  };
  for (std::size_t s = 0; s < result.scenes.size(); ++s) {
    SceneResult& scene = result.scenes[s];
    if (!scene.view || !scene.reason.empty()) continue;
    auto cloud = read_scene_cloud(in.dataset.scenes[s], in.request, in.context.stop);
    if (!cloud) return cloud.error();
    if (!cloud->has_contrast()) continue;
    const Cloud full = *cloud;
    cloud->intensity.clear();
    const double distance_m = scene.view->camera_from_board.transform.translation.norm();
    auto found = search_board(*cloud, {result.target, pyramid, distance_m},
                              in.request.options.localization, in.context);
    if (in.context.stopped()) return Error::cancelled();
    std::erase_if(found.candidates, [&](const BoardCandidate& candidate) {
      return !is_plain(full, candidate.lidar_from_board.transform);
    });
    if (found.candidates.empty()) continue;
    scene.search = std::move(found);
    scene.no_contrast = true;
  }
  return Done{};
}

// Where not even half of the scenes agree on the print's place: looks for boards whose print the
// LiDAR does not see, and takes them if more scenes agree on those.
Status consider_plain_boards(const CalibrationInput& in, CalibrationResult& result,
                             std::optional<SceneConsensus>& consensus) {
  int views = 0;
  for (const SceneResult& scene : result.scenes) views += scene.view ? 1 : 0;
  const int agreeing = consensus ? consensus->agreeing : 0;
  if (agreeing > 0 && 2 * agreeing >= views) return Done{};
  const std::vector<SceneResult> before = result.scenes;
  if (Status s = search_plain_boards(in, result); !s) return s;
  auto plain = decide(in, result);
  if (plain && plain->agreeing > agreeing) {
    consensus = std::move(plain);
  } else {
    result.scenes = before;
  }
  return Done{};
}

// Why scenes that have found a board do not agree, by trying what would mend it.
Status explain_disagreement(const CalibrationInput& in, CalibrationResult& result) {
  const int agreeing = result.consensus.agreeing;
  std::size_t found = 0;
  for (const SceneResult& scene : result.scenes)
    found += scene.view && scene.search && !scene.search->candidates.empty() && !scene.turned_image
                 ? 1
                 : 0;
  if (static_cast<std::size_t>(agreeing) >= found) return Done{};
  const auto scenes = hypotheses(result);
  if (const auto pair = exchanged_images(scenes, agreeing, in.request.options.consensus)) {
    const auto [a, b] = *pair;
    for (const auto& [one, other] : {std::pair(a, b), std::pair(b, a)}) {
      SceneResult& scene = result.scenes[one];
      scene.contradicts = true;
      scene.reason = Message(
          "its image and that of scene %1 seem to be exchanged: the scenes agree if they are",
          result.scenes[other].name);
      result.consensus.chosen[one].reset();
    }
    return Done{};
  }
  // Two may agree by chance: a grid of circles looks alike from several sides.
  if (agreeing > 2) return Done{};
  if (agreeing < 2) {
    if (const auto error = shared_files(result)) return *error;
  }
  if (const auto error =
          diagnose_mirrored(in.dataset, in.request, result, scenes, agreeing, in.context))
    return *error;
  return in.context.stopped() ? Status(Error::cancelled()) : Status(Done{});
}

// What was found elsewhere than two other scenes put it is the board if it shows the print as
// clearly as some scene does that agrees with others: panels of a board's size are everywhere.
bool found_elsewhere(const CalibrationResult& result, const BoardSearchResult& search) {
  constexpr double kAbout = 0.5;  // Of the evidence: half as many points.
  if (result.consensus.agreeing < 2) return !search.candidates.empty();
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t s = 0; s < result.scenes.size(); ++s) {
    const auto& chosen = result.consensus.chosen[s];
    if (chosen) least = std::min(least, result.scenes[s].search->candidates[*chosen].gain);
  }
  return std::any_of(
      search.candidates.begin(), search.candidates.end(),
      [&](const BoardCandidate& c) { return c.correlation > 0.0 && c.gain >= kAbout * least; });
}

// Boards that few lines or points show are not told from anything else flat, but where the other
// scenes put them there is nothing else.
Status take_standing_boards(const CalibrationInput& in, Calibration& run) {
  const Rigid3 lidar_from_camera = run.result.consensus.camera_from_lidar.transform.inverse();
  for (std::size_t s = 0; s < run.result.scenes.size(); ++s) {
    SceneResult& scene = run.result.scenes[s];
    if (!scene.view || !scene.reason.empty() || run.result.consensus.chosen[s] ||
        scene.place != BoardPlace::kTaken ||
        (scene.search && found_elsewhere(run.result, *scene.search)))
      continue;
    const auto cloud = read_scene_cloud(in.dataset.scenes[s], in.request, in.context.stop);
    if (!cloud) return cloud.error();
    auto found = find_standing_board(*cloud, run.result.target,
                                     lidar_from_camera * scene.view->camera_from_board.transform);
    if (found) scene.search = std::move(*found);
  }
  return Done{};
}

Status agree(const CalibrationInput& in, Calibration& run) {
  in.context.report("localize", 0.7, Message("comparing scenes"));
  auto consensus = decide(in, run.result);
  // Before anybody looks for boards where turned images put them.
  if (consensus && note_turned_images(run.result, hypotheses(run.result), *consensus,
                                      in.request.guess.has_value()))
    consensus = decide(in, run.result);
  if (!consensus) {
    // What would mend it costs less to look for than walls do, and gets clearer evidence: first
    // what two scenes must agree on.
    if (several_views(run.result)) {
      if (const auto error = wrong_clouds(in, run)) return *error;
    }
    if (const auto error = wrong_size(in, run)) return *error;
    // Perhaps the board hangs flush on a wall: look on larger planes, everywhere.
    if (Status s = search_again(in, run, std::nullopt); !s) return s;
    consensus = decide(in, run.result);
  } else if (consensus->agreeing >= 2 && missing_scenes(run.result.scenes, *consensus)) {
    run.result.consensus = *consensus;
    if (Status s = search_again(in, run, consensus->camera_from_lidar.transform); !s) return s;
    consensus = decide(in, run.result);
    if (consensus && consensus->agreeing >= 2) {
      run.result.consensus = *consensus;
      if (Status s = take_standing_boards(in, run); !s) return s;
      consensus = decide(in, run.result);
    }
  }
  // Or the LiDAR does not see the print, and what a scene took for it is something else.
  if (Status s = consider_plain_boards(in, run.result, consensus); !s) return s;
  if (!consensus) return not_found(in, run);
  run.result.consensus = std::move(*consensus);
  if (Status s = explain_disagreement(in, run.result); !s) return s;
  for (std::size_t s = 0; s < run.result.scenes.size(); ++s) {
    SceneResult& scene = run.result.scenes[s];
    scene.chosen = run.result.consensus.chosen[s];
    if (!scene.reason.empty() || scene.chosen) continue;
    const bool found = scene.search && !scene.search->candidates.empty();
    if (found && scene.insisted) {
      const auto& all = scene.search->candidates;
      const auto best = std::max_element(
          all.begin(), all.end(), [](const auto& a, const auto& b) { return a.gain < b.gain; });
      scene.chosen = static_cast<std::size_t>(best - all.begin());
      scene.objection =
          Message("the board found in the cloud does not agree with the other scenes");
      continue;
    }
    const bool elsewhere = scene.search && found_elsewhere(run.result, *scene.search);
    scene.contradicts =
        elsewhere || scene.place == BoardPlace::kPast || scene.place == BoardPlace::kHidden;
    scene.reason =
        elsewhere ? Message("the board found in the cloud does not agree with the other scenes")
                  : missing_board(scene);
  }
  return Done{};
}

void take_out_circles(SceneResult& scene) {
  for (auto* nodes : {&scene.refinement->nodes, &scene.paper_nodes}) {
    for (RefinedNode& node : *nodes) {
      if (!contains_id(scene.edits.circles, node.id)) continue;
      node.valid = false;
      node.reason = kLeftOutByUser;
    }
  }
}

// The print as a whole and the plane are used instead.
void do_without_circles(SceneResult& scene) {
  scene.refinement->warnings.push_back(Message("its circles cannot be measured: %1", scene.reason));
  scene.without_circles = true;
  scene.refinement->nodes.clear();
  scene.paper_nodes.clear();
  scene.refinement->scale_sigma = 0.0;
  scene.reason = {};
  scene.used = true;
}

// Where most scenes, three at least, agree on the print's place and not half of the circles can be
// measured in some of them (numbers in coarse steps, few lines or points), the print as a whole
// still tells; what edges such circles were given is chance.
void use_without_circles(CalibrationResult& result) {
  int views = 0;
  for (const SceneResult& scene : result.scenes) views += scene.view ? 1 : 0;
  const int agreeing = result.consensus.agreeing;
  if (agreeing < 3 || 2 * agreeing < views) return;
  for (SceneResult& scene : result.scenes) {
    if (!scene.chosen || !scene.refinement) continue;
    const int circles = static_cast<int>(scene.refinement->nodes.size());
    const int valid = scene.refinement->valid_nodes();
    if (scene.used && 2 * valid < circles)
      scene.reason = Message("only %1 of %2 circles usable", valid, circles);
    if (!scene.reason.empty()) do_without_circles(scene);
  }
}

Result<BoardRefinement> refine_scene(const CalibrationInput& in, Calibration& run, std::size_t s) {
  SceneResult& scene = run.result.scenes[s];
  const BoardCandidate& candidate = scene.search->candidates[*scene.chosen];
  scene.board_points = std::move(scene.search->patch_points[candidate.patch]);
  scene.search->patch_points.clear();
  scene.left_out_points = take_out(scene.board_points, scene.edits, run.result.target,
                                   candidate.lidar_from_board.transform);
  std::string key;
  StageCache* const cache = scene.no_contrast ? nullptr : in.cache;
  if (cache != nullptr) {
    const SceneStages& stages = cache->scene(scene.name);
    const std::string& search = run.looked_twice[s] ? stages.second_look.key : stages.search.key;
    key = refinement_key(search, *scene.chosen, in.request.options) + refinement_key(scene.edits);
    if (const auto* kept = stages.refinement.find(key)) return *kept;
  }
  if (in.observer.board_points) in.observer.board_points(s, scene.board_points);
  RefinementObserver each;
  if (in.observer.iteration) each = [&](const auto& so_far) { in.observer.iteration(s, so_far); };
  auto plane =
      fit_board_plane(scene.board_points, run.result.target, candidate.lidar_from_board.transform);
  if (!plane) return plane.error();
  run.planes[s] = std::move(*plane);
  auto refinement = refine_nodes(scene.board_points, run.result.target, *run.planes[s],
                                 in.request.options.refinement, in.context, each);
  if (refinement && cache != nullptr) cache->scene(scene.name).refinement.keep(key, *refinement);
  return refinement;
}

std::vector<RefinedNode> refine_as_in_paper(const CalibrationInput& in, Calibration& run,
                                            std::size_t s) {
  SceneResult& scene = run.result.scenes[s];
  StageCache* const cache = scene.no_contrast ? nullptr : in.cache;
  std::string key;
  if (cache != nullptr) {
    key = cache->scene(scene.name).refinement.key;
    if (const auto* kept = cache->scene(scene.name).paper_nodes.find(key)) return *kept;
  }
  const RefinementOptions options = as_in_paper(in.request.options.refinement);
  // Where ours was kept from before its plane was not.
  auto refined =
      run.planes[s]
          ? refine_nodes(scene.board_points, run.result.target, *run.planes[s], options, in.context)
          : refine_board(scene.board_points, run.result.target,
                         scene.search->candidates[*scene.chosen].lidar_from_board.transform,
                         options, in.context);
  if (!refined) return {};  // Stopped: the same points have been refined before.
  if (cache != nullptr) cache->scene(scene.name).paper_nodes.keep(key, refined->nodes);
  return std::move(refined->nodes);
}

void judge_refinement(const Target& target, SceneResult& scene) {
  if (!can_be_used(scene, target)) {
    const std::vector<RefinedNode>& nodes = scene.refinement->nodes;
    const int usable = scene.refinement->valid_nodes();
    const auto bad = std::find_if(nodes.begin(), nodes.end(),
                                  [](const RefinedNode& node) { return !node.valid; });
    scene.reason = bad == nodes.end()
                       ? Message("only %1 of %2 circles usable", usable, nodes.size())
                       : Message("only %1 of %2 circles usable; node %3: %4", usable, nodes.size(),
                                 bad->id, bad->reason);
    if (scene.insisted) {
      scene.objection = scene.reason;
      do_without_circles(scene);
    }
    return;
  }
  scene.used = true;
}

Status refine(const CalibrationInput& in, Calibration& run) {
  std::mutex mutex;
  std::size_t done = 0;
  run.planes.assign(run.result.scenes.size(), {});
  // The paper's refinement of each scene after ours, on the same plane: a fortieth of a
  // calibration's time, so that it always stands beside ours.
  parallel_two_steps(
      run.result.scenes.size(), in.context.thread_count(),
      [&](std::size_t s) {
        SceneResult& scene = run.result.scenes[s];
        if (!scene.chosen || in.context.stopped()) return;
        const auto start = Clock::now();
        auto refinement = refine_scene(in, run, s);
        const double elapsed = ms_since(start);
        const std::lock_guard lock(mutex);
        run.result.times.refine_ms += elapsed;
        if (refinement) {
          scene.refinement = std::move(*refinement);
        } else {
          scene.reason = refinement.error().sentence();
        }
      },
      [&](std::size_t s) {
        SceneResult& scene = run.result.scenes[s];
        if (!scene.chosen || in.context.stopped()) return;
        const auto start = Clock::now();
        if (scene.refinement && !scene.refinement->nodes.empty())
          scene.paper_nodes = refine_as_in_paper(in, run, s);
        const double elapsed = ms_since(start);
        const std::lock_guard lock(mutex);
        run.result.times.refine_ms += elapsed;
        if (scene.refinement) {
          take_out_circles(scene);
          judge_refinement(run.result.target, scene);
        }
        ++done;
        const double share =
            static_cast<double>(done) / static_cast<double>(run.result.scenes.size());
        in.context.report("refine", 0.7 + 0.2 * share, Message::verbatim(scene.name));
      });
  if (in.context.stopped()) return Error::cancelled();
  use_without_circles(run.result);
  const bool any = std::any_of(run.result.scenes.begin(), run.result.scenes.end(),
                               [](const SceneResult& scene) { return scene.used; });
  if (any) return Done{};
  // What was taken for the board was not: on the board some circles would be found.
  return not_found(in, run);
}

// One scene by itself, with the board where others' extrinsic has it. Nothing is left of it where
// image or cloud do not show the board there.
Status look_where_others_have_it(const CalibrationInput& in, Calibration& run) {
  SceneResult& scene = run.result.scenes.front();
  const Rigid3& place = run.result.consensus.camera_from_lidar.transform;
  if (Status s = load_scenes(in.dataset, in.request, in.context, run.result, in.cache); !s)
    return s;
  take_out_tags(run.result.scenes);
  if (!scene.view || !scene.reason.empty()) return Done{};
  const auto choose = [&] {
    const auto found = decide_scenes(hypotheses(run.result), place, in.request.options.consensus);
    scene.chosen = found ? found->chosen.front() : std::nullopt;
  };
  choose();
  if (!scene.chosen) {
    run.result.consensus.chosen = {std::nullopt};
    if (Status s = search_again(in, run, place); !s) return s;
    choose();
  }
  if (!scene.chosen) return Done{};
  run.planes.assign(1, {});
  auto refinement = refine_scene(in, run, 0);
  if (!refinement)
    return refinement.error().kind == ErrorKind::kCancelled ? Status(refinement.error())
                                                            : Status(Done{});
  scene.refinement = std::move(*refinement);
  if (!scene.refinement->nodes.empty()) scene.paper_nodes = refine_as_in_paper(in, run, 0);
  take_out_circles(scene);
  return Done{};
}

// How the scenes that the user rejected fit what the others give. They are looked at when all is
// decided but the last solve, which they have no part in: nothing may depend on them, nor fail by
// them.
Status look_at_rejected(const CalibrationInput& in, CalibrationResult& result) {
  const CalibrationObserver nobody;
  CalibrationRequest request = in.request;
  request.unusable = UnusableScenes::kLeaveOut;
  RunContext quiet = in.context;
  quiet.progress = {};
  for (std::size_t s = 0; s < result.scenes.size(); ++s) {
    SceneResult& scene = result.scenes[s];
    if (!scene.rejected || in.dataset.scenes[s].problem) continue;
    Dataset one = in.dataset;
    one.scenes = {in.dataset.scenes[s]};
    Calibration run;
    run.result.target = result.target;
    run.result.camera = result.camera;
    run.result.options = result.options;
    run.result.consensus.camera_from_lidar = result.consensus.camera_from_lidar;
    run.looked_twice.assign(1, 0);
    SceneResult looked;
    looked.name = scene.name;
    looked.edits = scene.edits;
    run.result.scenes.push_back(std::move(looked));
    const Status status = look_where_others_have_it({one, request, quiet, in.cache, nobody}, run);
    if (in.context.stopped()) return Error::cancelled();
    if (!status) continue;
    StageTimes& times = result.times;
    times.load_ms += run.result.times.load_ms;
    times.detect_ms += run.result.times.detect_ms;
    times.localize_ms += run.result.times.localize_ms;
    scene = std::move(run.result.scenes.front());
    scene.unreadable = false;  // By the user's wish it is left out, whatever else there is.
    reject(scene);
  }
  return Done{};
}

// Without circles too few scenes are left where some contradict the others: what makes them do so
// may be what the images say themselves, or, where no two agree, how the clouds are read.
std::optional<Error> too_few_for(const CalibrationInput& in, Calibration& run) {
  const CalibrationResult& result = run.result;
  const auto count = [&](const auto& is) {
    return std::count_if(result.scenes.begin(), result.scenes.end(), is);
  };
  const auto used = count([](const SceneResult& scene) { return scene.used; });
  const auto lost =
      count([](const SceneResult& scene) { return scene.view && !scene.used && !scene.rejected; });
  if (result.target.has_circles() || used >= kFewestWithoutCircles || lost == 0)
    return std::nullopt;
  if (const auto error = shared_files(result)) return error;
  if (const auto error = contradicted_by_images(result)) return error;
  if (const Message what = intrinsics_that_agree(result); !what.empty()) {
    return Error::untrusted(
        Message("images and clouds together contradict the intrinsics: %1", what), result.dataset,
        Message("check camera.yaml, or calibrate the camera again"));
  }
  if (result.consensus.agreeing > 1 || !several_views(result)) return std::nullopt;
  if (const auto error = wrong_clouds(in, run)) return error;
  return wrong_size(in, run);
}

Status optimize(const CalibrationInput& in, Calibration& run) {
  CalibrationResult& result = run.result;
  in.context.report("optimize", 0.92, Message("joint solve"));
  const auto start = Clock::now();
  if (const auto error = too_few_for(in, run)) return *error;
  std::vector<bool> use;
  for (const SceneResult& scene : result.scenes) use.push_back(scene.used);
  auto solved = resolve_calibration(std::move(result), use, in.request.options, in.context);
  if (!solved) return solved.error();
  result = std::move(*solved);
  result.times.optimize_ms = ms_since(start) - result.times.response_ms;
  return Done{};
}

Result<CalibrationResult> calibrate_once(const CalibrationInput& in) {
  const auto start = Clock::now();
  if (in.cache != nullptr) in.cache->prepare(in.dataset);
  Calibration run;
  CalibrationResult& result = run.result;
  if (Status s = prepare(in, run); !s) return s.error();
  if (Status s = load_scenes(in.dataset, in.request, in.context, result, in.cache); !s)
    return s.error();
  find_copies(result.scenes, run.same);
  note_same_content(result, run.same);
  take_out_tags(result.scenes);
  if (Status s = some_view(result); !s) return s.error();
  if (Status s = load_extra_images(in.dataset, in.request, in.context, result, in.cache); !s)
    return s.error();
  settle_colors(result);
  free_camera(result);
  if (Status s = agree(in, run); !s) return s.error();
  if (Status s = refine(in, run); !s) return s.error();
  if (Status s = look_at_rejected(in, result); !s) return s.error();
  if (Status s = optimize(in, run); !s) return s.error();
  result.times.total_ms = ms_since(start);
  in.context.report("optimize", 1.0, Message("done"));
  return std::move(result);
}

// After a run with a rough extrinsic has found no board: perhaps that is what is wrong. If the
// scenes agree without it their result stands, and says so.
Result<CalibrationResult> without_guess(Result<CalibrationResult> failed, const Dataset& dataset,
                                        const CalibrationRequest& request,
                                        const RunContext& context) {
  if (failed.error().kind != ErrorKind::kUntrusted || context.stopped()) return failed;
  CalibrationRequest free = request;
  free.guess.reset();
  auto result = calibrate_once({dataset, free, context, nullptr, CalibrationObserver()});
  if (!result) return result.error().kind == ErrorKind::kCancelled ? std::move(result) : failed;
  if (result->extrinsic.used_scenes < 2) return failed;
  result->warnings.insert(
      result->warnings.begin(),
      Message(
          "the rough extrinsic (rig.yaml or --init) contradicts the scenes and was left out: %1",
          diagnose_guess(*request.guess, result->extrinsic.camera_from_lidar.transform)));
  return result;
}

}  // namespace

const SceneSolution* solution_of(const CalibrationResult& result, const std::string& scene) {
  for (const SceneSolution& s : result.extrinsic.scenes) {
    if (s.name == scene) return &s;
  }
  return nullptr;
}

Result<CalibrationResult> calibrate(const Dataset& dataset, const CalibrationRequest& request,
                                    const RunContext& context) {
  auto result = calibrate_once({dataset, request, context, nullptr, CalibrationObserver()});
  return result || !request.guess ? std::move(result)
                                  : without_guess(std::move(result), dataset, request, context);
}

Result<CalibrationResult> calibrate(const Dataset& dataset, const CalibrationRequest& request,
                                    const RunContext& context, StageCache& cache,
                                    const CalibrationObserver& observer) {
  auto result = calibrate_once({dataset, request, context, &cache, observer});
  return result || !request.guess ? std::move(result)
                                  : without_guess(std::move(result), dataset, request, context);
}

}  // namespace lvcalib
