// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/session.h"

#include <algorithm>

namespace lvcalib {
namespace {

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

bool same_guess(const std::optional<Rigid3>& a, const std::optional<Rigid3>& b) {
  if (!a || !b) return a.has_value() == b.has_value();
  return a->translation == b->translation && a->rotation.coeffs() == b->rotation.coeffs();
}

std::vector<std::string> names_of(const Dataset& dataset) {
  std::vector<std::string> names;
  for (const SceneFiles& files : dataset.scenes) names.push_back(files.name);
  return names;
}

// True if target, camera and the images for the camera alone are those of a result.
bool same_basis(const Dataset& dataset, const CalibrationResult& result) {
  const std::vector<BoardImage>& images = result.intrinsics.extra_images;
  const IntrinsicsReport camera = start_intrinsics(dataset, result.intrinsics.mode);
  return result.dataset == place_of(dataset) && to_yaml(result.target) == to_yaml(dataset.target) &&
         to_yaml(result.intrinsics.given) == to_yaml(camera.given) &&
         result.intrinsics.prior_sigma == camera.prior_sigma &&
         std::equal(images.begin(), images.end(), dataset.camera_images.begin(),
                    dataset.camera_images.end(),
                    [](const BoardImage& image, const std::filesystem::path& path) {
                      return image.path == path;
                    });
}

// True if the kept features answer the request: only scenes are left out or taken back in, and
// every wanted scene took part in the last whole run.
bool solving_is_enough(const Dataset& dataset, const CalibrationRequest& request,
                       const SessionState& state) {
  if (!state.whole || state.scene_names != names_of(dataset) || !same_basis(dataset, *state.whole))
    return false;
  const CalibrationRequest& last = state.request;
  if (!same_options(last.options, request.options) || !same_guess(last.guess, request.guess) ||
      last.use_crops != request.use_crops || last.crop_boxes != request.crop_boxes ||
      last.insisted != request.insisted || last.edits != request.edits) {
    return false;
  }
  return std::all_of(last.rejected.begin(), last.rejected.end(),
                     [&](const std::string& name) { return contains(request.rejected, name); });
}

Result<CalibrationResult> solve_again(const CalibrationRequest& request,
                                      const CalibrationResult& whole,
                                      const RunContext& context = {}) {
  CalibrationResult result = whole;
  std::vector<bool> use;
  for (SceneResult& scene : result.scenes) {
    const bool wanted = !contains(request.rejected, scene.name);
    const bool usable = can_be_used(scene, result.target);
    use.push_back(wanted && usable);
    if (!wanted) {
      reject(scene);
    } else if (usable) {
      scene.rejected = false;
      scene.reason = {};  // The solve says anew whether it contradicts the others.
    }
  }
  return resolve_calibration(std::move(result), use, request.options, context);
}

}  // namespace

bool same_options(const CalibrationOptions& a, const CalibrationOptions& b) {
  const auto& all = option_declarations();
  return std::all_of(all.begin(), all.end(),
                     [&](const OptionDeclaration& d) { return d.get(a) == d.get(b); });
}

bool same_calibration(const Decisions& a, const Decisions& b) {
  const auto wordless = [](const Decisions& decisions) {
    auto scenes = decisions.scenes;
    for (auto& entry : scenes) entry.second.note.clear();
    std::erase_if(scenes, [](const auto& entry) { return entry.second == SceneDecision{}; });
    return scenes;
  };
  return wordless(a) == wordless(b) && same_options(a.options, b.options) &&
         same_guess(a.guess, b.guess) && a.use_crops == b.use_crops &&
         a.added_scenes == b.added_scenes;
}

SceneDecision decision_of(const Decisions& decisions, const std::string& scene) {
  const auto found = decisions.scenes.find(scene);
  return found == decisions.scenes.end() ? SceneDecision{} : found->second;
}

Status add_scenes(Dataset& dataset, const std::vector<std::filesystem::path>& folders) {
  std::vector<SceneFiles> scenes = dataset.scenes;
  for (const std::filesystem::path& folder : folders) {
    auto scene = open_scene(folder);
    if (!scene) return scene.error();
    for (const SceneFiles& other : scenes) {
      if (other.name != scene->name) continue;
      return Error::input(Message("there is already a scene '%1' in this dataset", scene->name),
                          folder.string(), Message("rename the folder"));
    }
    scenes.push_back(std::move(*scene));
  }
  std::sort(scenes.begin(), scenes.end(),
            [](const SceneFiles& a, const SceneFiles& b) { return a.name < b.name; });
  dataset.scenes = std::move(scenes);
  return Done{};
}

CalibrationRequest request_of(const Dataset& dataset, const Decisions& decisions) {
  CalibrationRequest request;
  request.options = decisions.options;
  request.use_crops = decisions.use_crops;
  request.unusable = UnusableScenes::kLeaveOut;
  request.guess = decisions.guess ? decisions.guess : dataset.rough_camera_from_lidar;
  for (const SceneFiles& files : dataset.scenes) {
    const SceneDecision decision = decision_of(decisions, files.name);
    if (!decision.use) request.rejected.push_back(files.name);
    if (decision.use && decision.insist) request.insisted.push_back(files.name);
    if (decision.crop) request.crop_boxes[files.name] = *decision.crop;
    if (!decision.edits.empty()) request.edits[files.name] = decision.edits;
  }
  return request;
}

Result<CalibrationResult> preview_session(const Dataset& dataset, const Decisions& decisions,
                                          const SessionState& state, const RunContext& context) {
  if (!state.whole) return Error::usage(Message("there is no calibration yet"));
  return solve_again(request_of(dataset, decisions), *state.whole, context);
}

SessionRun run_session(const Dataset& dataset, const Decisions& decisions, SessionState state,
                       const RunContext& context, const CalibrationObserver& observer) {
  SessionRun run;
  CalibrationRequest request = request_of(dataset, decisions);
  if (solving_is_enough(dataset, request, state)) {
    run.solved_only = true;
    context.report("optimize", 0.5, Message("joint solve"));
    auto solved = solve_again(request, *state.whole);
    run.state = std::move(state);
    if (solved) {
      run.state.latest = std::make_shared<const CalibrationResult>(std::move(*solved));
      context.report("optimize", 1.0, Message("done"));
    } else {
      run.error = solved.error();
    }
    return run;
  }
  auto result = calibrate(dataset, request, context, state.cache, observer);
  run.state = std::move(state);
  if (!result) {
    run.error = result.error();
    return run;
  }
  run.state.request = std::move(request);
  run.state.scene_names = names_of(dataset);
  run.state.whole = std::make_shared<const CalibrationResult>(std::move(*result));
  run.state.latest = run.state.whole;
  return run;
}

}  // namespace lvcalib
