// SPDX-License-Identifier: BSD-3-Clause
// Which boards the scenes agree on, and what would mend it if they do not.
#include "pipeline/board_agreement.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

#include "base/parallel.h"
#include "base/text.h"
#include "pipeline/camera_resection.h"
#include "pipeline/diagnosis.h"
#include "pipeline/scene_loading.h"
#include "pipeline/standing_board.h"
#include "pipeline/turned_images.h"

namespace lvcalib {

std::vector<SceneHypotheses> hypotheses(const CalibrationResult& result) {
  std::vector<SceneHypotheses> out;
  for (const SceneResult& scene : result.scenes) {
    out.push_back(hypotheses_of(scene, result.target));
    // What its image says is of another camera.
    if (scene.turned_image) out.back().candidates.clear();
  }
  return out;
}

namespace {

std::optional<SceneConsensus> decide(const CalibrationInput& in, const CalibrationResult& result) {
  return decide_scenes(hypotheses(result), in.request.guess, in.request.options.consensus);
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
  constexpr double kSame = 0.005;  // Less rounds to no per cent, in which the size is told.
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

}  // namespace

Error board_not_found(const CalibrationInput& in, Calibration& run) {
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

namespace {

bool missing_scenes(const std::vector<SceneResult>& scenes, const SceneConsensus& consensus) {
  for (std::size_t s = 0; s < scenes.size(); ++s) {
    if (scenes[s].view && !consensus.chosen[s]) return true;
  }
  return false;
}

// Scenes side by side. The first one's error, in their order.
Status for_each_scene(const CalibrationInput& in, const std::function<Status(std::size_t)>& look) {
  std::vector<Status> done(in.dataset.scenes.size(), Done{});
  parallel_for(done.size(), in.context.thread_count(), [&](std::size_t s) { done[s] = look(s); });
  for (Status& status : done) {
    if (!status) return std::move(status);
  }
  return Done{};
}

}  // namespace

Status search_again(const CalibrationInput& in, Calibration& run,
                    const std::optional<Rigid3>& camera_from_lidar) {
  const PatternPyramid pyramid(run.result.target);
  const BoardOutline outline = run.result.target.outline();
  const Eigen::Vector2d c = outline.center_m();
  return for_each_scene(in, [&](std::size_t s) -> Status {
    SceneResult& scene = run.result.scenes[s];
    if (!scene.view || !scene.reason.empty()) return Done{};
    if (camera_from_lidar && run.result.consensus.chosen[s]) return Done{};
    BoardSearchRegion region;
    if (camera_from_lidar) {
      const Rigid3 board = camera_from_lidar->inverse() * scene.view->camera_from_board.transform;
      region.center_m = board * Eigen::Vector3d(c.x(), c.y(), 0.0);
      region.radius_m = 0.75 * outline.size_m().norm();
      region.width = board.rotation * Eigen::Vector3d::UnitX();
    }
    const SecondSearch where{in.dataset.scenes[s], in.request, region, run.result.target, pyramid};
    Status status = search_scene_again(where, in.context, scene, in.cache);
    if (status) run.looked_twice[s] = 1;
    return status;
  });
}

namespace {

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
  return for_each_scene(in, [&](std::size_t s) -> Status {
    SceneResult& scene = result.scenes[s];
    if (!scene.view || !scene.reason.empty()) return Done{};
    auto cloud = read_scene_cloud(in.dataset.scenes[s], in.request, in.context.stop);
    if (!cloud) return cloud.error();
    if (!cloud->has_contrast()) return Done{};
    const Cloud full = *cloud;
    cloud->intensity.clear();
    const double distance_m = scene.view->camera_from_board.transform.translation.norm();
    auto found = search_board(*cloud, {result.target, pyramid, distance_m},
                              in.request.options.localization, in.context);
    if (in.context.stopped()) return Error::cancelled();
    std::erase_if(found.candidates, [&](const BoardCandidate& candidate) {
      return !is_plain(full, candidate.lidar_from_board.transform);
    });
    if (!found.candidates.empty()) {
      scene.search = std::move(found);
      scene.no_contrast = true;
    }
    return Done{};
  });
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

}  // namespace

Status agree_on_boards(const CalibrationInput& in, Calibration& run) {
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
  if (!consensus) return board_not_found(in, run);
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

std::optional<Error> explain_too_few_scenes(const CalibrationInput& in, Calibration& run) {
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
  if (!several_views(result)) return std::nullopt;
  if (result.consensus.agreeing < 2) {
    if (const auto error = wrong_clouds(in, run)) return error;
  }
  // Two of three may agree on a board that is a little too small for the third.
  return wrong_size(in, run);
}

}  // namespace lvcalib
