// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/calibration.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>

#include "base/parallel.h"
#include "base/text.h"
#include "pipeline/board_agreement.h"
#include "pipeline/diagnosis.h"
#include "pipeline/quality.h"
#include "pipeline/scene_copies.h"
#include "pipeline/scene_loading.h"
#include "pipeline/stopwatch.h"

namespace lvcalib {
namespace {

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
  return board_not_found(in, run);
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
  const RunContext quiet = in.context.silent();
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

Status optimize(const CalibrationInput& in, Calibration& run) {
  CalibrationResult& result = run.result;
  in.context.report("optimize", 0.92, Message("joint solve"));
  const auto start = Clock::now();
  if (const auto error = explain_too_few_scenes(in, run)) return *error;
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
  if (Status s = agree_on_boards(in, run); !s) return s.error();
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
