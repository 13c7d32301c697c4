// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/calibration.h"

#include <algorithm>
#include <cmath>
#include <mutex>

#include "base/parallel.h"
#include "base/text.h"
#include "pipeline/diagnosis.h"
#include "pipeline/quality.h"
#include "pipeline/scene_loading.h"
#include "pipeline/stopwatch.h"

namespace lvcalib {
namespace {

std::vector<SceneHypotheses> hypotheses(const CalibrationResult& result) {
  std::vector<SceneHypotheses> out;
  for (const SceneResult& scene : result.scenes) out.push_back(hypotheses_of(scene, result.target));
  return out;
}

class Calibration {
 public:
  Calibration(const Dataset& dataset, const CalibrationRequest& request, const RunContext& context,
              StageCache* cache, const CalibrationObserver& observer)
      : dataset_(dataset),
        request_(request),
        context_(context),
        cache_(cache),
        observer_(observer) {
    if (cache_ != nullptr) cache_->prepare(dataset);
  }

  Result<CalibrationResult> run() {
    const auto start = Clock::now();
    if (Status s = prepare(); !s) return s.error();
    if (Status s = load_scenes(dataset_, request_, context_, result_, cache_); !s) return s.error();
    take_out_tags();
    if (Status s = some_view(); !s) return s.error();
    if (Status s = load_extra_images(dataset_, request_, context_, result_, cache_); !s)
      return s.error();
    settle_colors();
    free_camera(result_);
    if (Status s = agree(); !s) return s.error();
    if (Status s = refine(); !s) return s.error();
    if (Status s = optimize(); !s) return s.error();
    result_.times.total_ms = ms_since(start);
    context_.report("optimize", 1.0, Message("done"));
    return std::move(result_);
  }

 private:
  Status prepare() {
    result_.dataset = dataset_.path.string();
    result_.target = dataset_.target;
    result_.camera = dataset_.camera;
    result_.intrinsics = start_intrinsics(dataset_, request_.options.intrinsics.kind());
    result_.warnings = dataset_.warnings;
    result_.options = request_.options;
    result_.inputs = hash_inputs(dataset_, request_.use_crops, context_);
    if (context_.stopped()) return Error::cancelled();
    looked_twice_.assign(dataset_.scenes.size(), 0);
    for (const SceneFiles& files : dataset_.scenes) {
      SceneResult scene;
      scene.name = files.name;
      if (std::find(request_.rejected.begin(), request_.rejected.end(), files.name) !=
          request_.rejected.end()) {
        reject(scene);
      } else if (files.problem) {
        scene.reason = files.problem->sentence();
        scene.unreadable = true;
      }
      scene.insisted = std::find(request_.insisted.begin(), request_.insisted.end(), files.name) !=
                       request_.insisted.end();
      if (const auto edits = request_.edits.find(files.name); edits != request_.edits.end())
        scene.edits = edits->second;
      result_.scenes.push_back(std::move(scene));
    }
    note_same_files();
    for (const std::string& name : request_.rejected) {
      const bool known = std::any_of(dataset_.scenes.begin(), dataset_.scenes.end(),
                                     [&](const SceneFiles& f) { return f.name == name; });
      if (!known)
        return Error::usage(Message("there is no scene '%1' to reject", name),
                            dataset_.path.string());
    }
    return Done{};
  }

  // A scene counts once. With another scene's image or cloud it is not known which of the two is
  // right: the others must tell, and the verdict says so.
  void note_same_files() {
    const auto same = same_content(dataset_, request_.use_crops, result_.inputs);
    for (std::size_t s = 0; s < same.size(); ++s) {
      SceneResult& scene = result_.scenes[s];
      if (!scene.reason.empty()) continue;
      const std::optional<std::size_t>& image = same[s].image;
      const std::optional<std::size_t>& cloud = same[s].cloud;
      const auto first = std::find_if(same.begin(), same.begin() + static_cast<std::ptrdiff_t>(s),
                                      [&](const SameContent& other) {
                                        const auto t = static_cast<std::size_t>(&other - &same[0]);
                                        return image == other.image.value_or(t) &&
                                               cloud == other.cloud.value_or(t);
                                      });
      if (first != same.begin() + static_cast<std::ptrdiff_t>(s)) {
        const SceneResult& one = result_.scenes[static_cast<std::size_t>(first - same.begin())];
        if (one.reason.empty())
          scene.reason = Message("the same files as scene %1, which counts once", one.name);
        continue;
      }
      if (image) {
        scene.shared_file = Message(
            "scene %1 has the same image as scene %2: one of the two is not the scene's own",
            scene.name, result_.scenes[*image].name);
      }
      if (cloud) {
        scene.shared_file = Message(
            "scene %1 has the same cloud as scene %2: one of the two is not the scene's own",
            scene.name, result_.scenes[*cloud].name);
      }
    }
  }

  // What the user left out of the images, before anything is made of it.
  void take_out_tags() {
    for (SceneResult& scene : result_.scenes) {
      if (!scene.view || scene.edits.tags.empty()) continue;
      scene.left_out_corners = take_out(*scene.view, scene.edits);
      constexpr std::size_t kFewest = 4;
      if (scene.view->corners.size() >= kFewest) continue;
      scene.view.reset();
      if (scene.reason.empty())
        scene.reason = Message("too few tags: the others are left out by the user");
    }
  }

  // The board must be seen in at least one image that has a cloud.
  Status some_view() const {
    const SceneResult* unreadable = nullptr;
    for (const SceneResult& scene : result_.scenes) {
      if (scene.view && !scene.unreadable) return Done{};
      if (scene.unreadable && unreadable == nullptr) unreadable = &scene;
    }
    if (unreadable != nullptr)
      return Error::input(
          Message("no scene can be used; scene %1: %2", unreadable->name, unreadable->reason));
    for (const SceneResult& scene : result_.scenes) {
      if (!scene.reason.empty() && !scene.rejected) {
        return Error::input(
            Message("the board is not found in any image; scene %1: %2", scene.name, scene.reason));
      }
    }
    return Error::input(Message("every scene is rejected"), result_.dataset);
  }

  // Which squares of a checkerboard are black is not in its description; the images say it.
  void settle_colors() {
    int views = 0;
    int other = 0;
    for (const SceneResult& scene : result_.scenes) {
      if (!scene.view) continue;
      ++views;
      other += scene.view->other_colors ? 1 : 0;
    }
    const bool most = 2 * other > views;
    if (most) result_.target.white_first = !result_.target.white_first;
    for (SceneResult& scene : result_.scenes) {
      if (!scene.view || scene.view->other_colors == most || !scene.reason.empty()) continue;
      scene.reason = Message(
          "its checkerboard has black and white squares the other way round than in most scenes: "
          "is it another board, or is the image mirrored?");
    }
  }

  Status agree() {
    context_.report("localize", 0.7, Message("comparing scenes"));
    auto consensus = decide_scenes(hypotheses(result_), request_.guess, request_.options.consensus);
    if (!consensus) {
      // What would mend it costs less to look for than walls do, and gets clearer evidence: first
      // what two scenes must agree on.
      if (several_views()) {
        if (const auto error = wrong_clouds()) return *error;
      }
      if (const auto error = wrong_size()) return *error;
      // Perhaps the board hangs flush on a wall: look on larger planes, everywhere.
      if (Status s = search_again(std::nullopt); !s) return s;
      consensus = decide_scenes(hypotheses(result_), request_.guess, request_.options.consensus);
    } else if (consensus->agreeing >= 2 && missing_scenes(*consensus)) {
      result_.consensus = *consensus;
      if (Status s = search_again(consensus->camera_from_lidar.transform); !s) return s;
      consensus = decide_scenes(hypotheses(result_), request_.guess, request_.options.consensus);
    }
    // Or the LiDAR does not see the print, and what a scene took for it is something else.
    if (Status s = consider_plain_boards(consensus); !s) return s;
    if (!consensus) return not_found();
    result_.consensus = std::move(*consensus);
    if (Status s = explain_disagreement(); !s) return s;
    for (std::size_t s = 0; s < result_.scenes.size(); ++s) {
      SceneResult& scene = result_.scenes[s];
      scene.chosen = result_.consensus.chosen[s];
      if (!scene.reason.empty() || scene.chosen) continue;
      const bool elsewhere = scene.search && !scene.search->candidates.empty();
      if (elsewhere && scene.insisted) {
        const auto& all = scene.search->candidates;
        const auto best = std::max_element(
            all.begin(), all.end(), [](const auto& a, const auto& b) { return a.gain < b.gain; });
        scene.chosen = static_cast<std::size_t>(best - all.begin());
        scene.objection =
            Message("the board found in the cloud does not agree with the other scenes");
        continue;
      }
      scene.contradicts = elsewhere || scene.place != BoardPlace::kOpen;
      scene.reason =
          elsewhere ? Message("the board found in the cloud does not agree with the other scenes")
                    : missing_board(scene);
    }
    return Done{};
  }

  // Why scenes that have found a board do not agree, by trying what would mend it.
  Status explain_disagreement() {
    const int agreeing = result_.consensus.agreeing;
    std::size_t found = 0;
    for (const SceneResult& scene : result_.scenes)
      found += scene.view && scene.search && !scene.search->candidates.empty() ? 1 : 0;
    if (static_cast<std::size_t>(agreeing) >= found) return Done{};
    const auto scenes = hypotheses(result_);
    if (const auto pair = exchanged_images(scenes, agreeing, request_.options.consensus)) {
      const auto [a, b] = *pair;
      for (const auto& [one, other] : {std::pair(a, b), std::pair(b, a)}) {
        SceneResult& scene = result_.scenes[one];
        scene.contradicts = true;
        scene.reason = Message(
            "its image and that of scene %1 seem to be exchanged: the scenes agree if they are",
            result_.scenes[other].name);
        result_.consensus.chosen[one].reset();
      }
      return Done{};
    }
    // Two may agree by chance: a grid of circles looks alike from several sides.
    if (agreeing > 2) return Done{};
    if (agreeing < 2) {
      if (const auto error = shared_files()) return *error;
    }
    if (const auto error =
            diagnose_mirrored(dataset_, request_, result_, scenes, agreeing, context_))
      return *error;
    return context_.stopped() ? Status(Error::cancelled()) : Status(Done{});
  }

  [[nodiscard]] bool missing_scenes(const SceneConsensus& consensus) const {
    for (std::size_t s = 0; s < result_.scenes.size(); ++s) {
      if (result_.scenes[s].view && !consensus.chosen[s]) return true;
    }
    return false;
  }

  // Second look: where the other scenes put the board, or (without them) on walls everywhere.
  Status search_again(const std::optional<Rigid3>& camera_from_lidar) {
    const PatternPyramid pyramid(result_.target);
    const BoardOutline outline = result_.target.outline();
    const Eigen::Vector2d c = outline.center_m();
    for (std::size_t s = 0; s < result_.scenes.size(); ++s) {
      SceneResult& scene = result_.scenes[s];
      if (!scene.view || !scene.reason.empty()) continue;
      if (camera_from_lidar && result_.consensus.chosen[s]) continue;
      BoardSearchRegion region;
      if (camera_from_lidar) {
        region.center_m = camera_from_lidar->inverse() * (scene.view->camera_from_board.transform *
                                                          Eigen::Vector3d(c.x(), c.y(), 0.0));
        region.radius_m = 0.75 * outline.size_m().norm();
      }
      if (Status status = search_scene_again(dataset_.scenes[s], request_, region, context_,
                                             pyramid, result_, s, cache_);
          !status)
        return status;
      looked_twice_[s] = 1;
    }
    return Done{};
  }

  // Where not even half of the scenes agree on the print's place: looks for boards whose print the
  // LiDAR does not see, and takes them if more scenes agree on those.
  Status consider_plain_boards(std::optional<SceneConsensus>& consensus) {
    int views = 0;
    for (const SceneResult& scene : result_.scenes) views += scene.view ? 1 : 0;
    const int agreeing = consensus ? consensus->agreeing : 0;
    if (agreeing > 0 && 2 * agreeing >= views) return Done{};
    const std::vector<SceneResult> before = result_.scenes;
    if (Status s = search_plain_boards(); !s) return s;
    auto plain = decide_scenes(hypotheses(result_), request_.guess, request_.options.consensus);
    if (plain && plain->agreeing > agreeing) {
      consensus = std::move(plain);
    } else {
      result_.scenes = before;
    }
    return Done{};
  }

  // Third look, by the outline alone, at flat patches on which the intensity is the same but for
  // its noise: what is printed there the LiDAR cannot see. A patch with a print of its own is not
  // this board.
  Status search_plain_boards() {
    if (!result_.target.has_tags()) return Done{};
    const PatternPyramid pyramid(result_.target);
    const BlurredPrint print(result_.target);
    const auto is_plain = [&](const Cloud& cloud, const Rigid3& lidar_from_board) {
      BeamSpread beam;
      beam.blur_rad2 =
          std::pow(request_.options.forward.first_blur_rad, 2) * Eigen::Matrix2d::Identity();
      constexpr RangeNoise kRange{0.02, 0.02};
      const auto returns = select_returns(cloud, print, lidar_from_board, beam, kRange);
      return returns.has_intensity && intensity_structure(returns) < kPlainStructure;
    };
    for (std::size_t s = 0; s < result_.scenes.size(); ++s) {
      SceneResult& scene = result_.scenes[s];
      if (!scene.view || !scene.reason.empty()) continue;
      auto cloud = read_scene_cloud(dataset_.scenes[s], request_, context_.stop);
      if (!cloud) return cloud.error();
      if (!cloud->has_contrast()) continue;
      const Cloud full = *cloud;
      cloud->intensity.clear();
      const double distance_m = scene.view->camera_from_board.transform.translation.norm();
      auto found = search_board(*cloud, result_.target, pyramid, distance_m, std::nullopt,
                                request_.options.localization, context_);
      if (context_.stopped()) return Error::cancelled();
      std::erase_if(found.candidates, [&](const BoardCandidate& candidate) {
        return !is_plain(full, candidate.lidar_from_board.transform);
      });
      if (found.candidates.empty()) continue;
      scene.search = std::move(found);
      scene.no_contrast = true;
    }
    return Done{};
  }

  static Message search_summary(const SceneResult& scene) {
    if (!scene.search) return Message("not searched");
    if (!(scene.search->best_correlation > 0))
      return Message("%1 flat patches of its size", scene.search->patches);
    return Message("%1 flat patches of its size, best pattern correlation %2",
                   scene.search->patches,
                   std::to_string(scene.search->best_correlation).substr(0, 4));
  }

  static Message missing_board(const SceneResult& scene) {
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
      case BoardPlace::kOpen:
        break;
    }
    return Message("the board is not found in the cloud (%1)", search);
  }

  [[nodiscard]] bool several_views() const {
    return std::count_if(result_.scenes.begin(), result_.scenes.end(),
                         [](const SceneResult& s) { return s.view && !s.unreadable; }) > 1;
  }

  // The error to give if the board is there in clouds read or given to scenes another way.
  std::optional<Error> wrong_clouds() {
    if (looked_for_readings_) return std::nullopt;
    looked_for_readings_ = true;
    if (const auto error = shared_files()) return error;
    if (auto error = diagnose_exchanged_clouds(dataset_, request_, result_, context_)) return error;
    auto error = diagnose_clouds(dataset_, request_, result_, context_);
    if (context_.stopped()) return Error::cancelled();
    return error;
  }

  // The error to give if the board is there, but in another size.
  std::optional<Error> wrong_size() {
    if (looked_for_sizes_) return std::nullopt;
    looked_for_sizes_ = true;
    context_.report("localize", 0.7, Message("other sizes of the board"));
    const auto scale = find_scaled_board(dataset_, request_, result_, context_);
    if (context_.stopped()) return Error::cancelled();
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
          result_.dataset,
          Message("write them in metres: multiply each by %1", formatted("%g", unit.in_m)));
    }
    const int percent = static_cast<int>(std::lround(100.0 * (*scale - 1.0)));
    // Of its own size it was looked for already: something else is wrong.
    if (percent == 0) return std::nullopt;
    if (const Message spacing = better_spacing(result_); !spacing.empty())
      return wrong_target(spacing);
    if (const Message what = contradicted_by_corners(result_); !what.empty())
      return wrong_camera(what);
    return Error::untrusted(
        percent > 0 ? Message("LiDAR and camera disagree on the board's size: the LiDAR sees it "
                              "about %1 % larger than target.yaml says",
                              percent)
                    : Message("LiDAR and camera disagree on the board's size: the LiDAR sees it "
                              "about %1 % smaller than target.yaml says",
                              -percent),
        result_.dataset, Message("measure the printed tags and correct tagSize"));
  }

  [[nodiscard]] Error wrong_target(const Message& what) const {
    return Error::untrusted(Message("the images contradict target.yaml: %1", what), result_.dataset,
                            Message("measure the print and correct target.yaml"));
  }

  // A wrong focal length makes every distance, and with it the board's size, wrong.
  [[nodiscard]] Error wrong_camera(const Message& what) const {
    return Error::untrusted(Message("the images contradict the intrinsics: %1", what),
                            result_.dataset,
                            Message("calibrate the camera again, or use --intrinsics free"));
  }

  // Files that stand in for others' contradict their scenes in ways that other faults would
  // explain, too: what is known for sure comes first.
  [[nodiscard]] std::optional<Error> shared_files() const {
    for (const SceneResult& scene : result_.scenes) {
      if (scene.shared_file.empty()) continue;
      return Error::input(scene.shared_file, result_.dataset,
                          Message("give each scene its own image and cloud"));
    }
    return std::nullopt;
  }

  Status not_found() {
    if (const auto error = shared_files()) return *error;
    if (const Message spacing = better_spacing(result_); !spacing.empty())
      return wrong_target(spacing);
    if (const Message what = contradicted_by_corners(result_); !what.empty())
      return wrong_camera(what);
    // What two scenes agree on comes before what looks like the board in one of another size.
    if (several_views()) {
      if (const auto error = wrong_clouds()) return *error;
    }
    if (const auto error = wrong_size()) return *error;
    if (const auto error = wrong_clouds()) return *error;
    std::vector<Message> details;
    for (const SceneResult& scene : result_.scenes) {
      const bool searched = scene.view && scene.reason.empty();
      details.push_back(
          Message("%1: %2", scene.name, searched ? search_summary(scene) : scene.reason));
    }
    return Error::untrusted(
        Message("the board is not found in any cloud (%1)", joined(details, "; ")), result_.dataset,
        Message("check that the LiDAR sees the whole board and that target.yaml describes it"));
  }

  Status refine() {
    std::mutex mutex;
    std::size_t done = 0;
    planes_.assign(result_.scenes.size(), {});
    // The paper's refinement of each scene after ours, on the same plane: a fortieth of a
    // calibration's time, so that it always stands beside ours.
    parallel_two_steps(
        result_.scenes.size(), context_.thread_count(),
        [&](std::size_t s) {
          SceneResult& scene = result_.scenes[s];
          if (!scene.chosen || context_.stopped()) return;
          const auto start = Clock::now();
          auto refinement = refine_scene(s);
          const double elapsed = ms_since(start);
          const std::lock_guard lock(mutex);
          result_.times.refine_ms += elapsed;
          if (refinement) {
            scene.refinement = std::move(*refinement);
          } else {
            scene.reason = refinement.error().sentence();
          }
        },
        [&](std::size_t s) {
          SceneResult& scene = result_.scenes[s];
          if (!scene.chosen || context_.stopped()) return;
          const auto start = Clock::now();
          if (scene.refinement && !scene.refinement->nodes.empty())
            scene.paper_nodes = refine_as_in_paper(s);
          const double elapsed = ms_since(start);
          const std::lock_guard lock(mutex);
          result_.times.refine_ms += elapsed;
          if (scene.refinement) {
            take_out_circles(scene);
            judge_refinement(scene);
          }
          ++done;
          const double share =
              static_cast<double>(done) / static_cast<double>(result_.scenes.size());
          context_.report("refine", 0.7 + 0.2 * share, Message::verbatim(scene.name));
        });
    if (context_.stopped()) return Error::cancelled();
    use_without_circles();
    const bool any = std::any_of(result_.scenes.begin(), result_.scenes.end(),
                                 [](const SceneResult& scene) { return scene.used; });
    if (any) return Done{};
    // What was taken for the board was not: on the board some circles would be found.
    return not_found();
  }

  static void take_out_circles(SceneResult& scene) {
    for (auto* nodes : {&scene.refinement->nodes, &scene.paper_nodes}) {
      for (RefinedNode& node : *nodes) {
        if (!contains_id(scene.edits.circles, node.id)) continue;
        node.valid = false;
        node.reason = kLeftOutByUser;
      }
    }
  }

  // Where most scenes, three at least, agree on the print's place and too few circles can be
  // measured in some of them (numbers in coarse steps, few lines or points), the print as a whole
  // still tells.
  void use_without_circles() {
    int views = 0;
    for (const SceneResult& scene : result_.scenes) views += scene.view ? 1 : 0;
    const int agreeing = result_.consensus.agreeing;
    if (agreeing < 3 || 2 * agreeing < views) return;
    for (SceneResult& scene : result_.scenes) {
      if (scene.chosen && scene.refinement && !scene.used && !scene.reason.empty())
        do_without_circles(scene);
    }
  }

  // The print as a whole and the plane are used instead.
  static void do_without_circles(SceneResult& scene) {
    scene.refinement->warnings.push_back(
        Message("its circles cannot be measured: %1", scene.reason));
    scene.refinement->nodes.clear();
    scene.paper_nodes.clear();
    scene.refinement->scale_sigma = 0.0;
    scene.reason = {};
    scene.used = true;
  }

  Result<BoardRefinement> refine_scene(std::size_t s) {
    SceneResult& scene = result_.scenes[s];
    const BoardCandidate& candidate = scene.search->candidates[*scene.chosen];
    scene.board_points = std::move(scene.search->patch_points[candidate.patch]);
    scene.search->patch_points.clear();
    scene.left_out_points = take_out(scene.board_points, scene.edits, result_.target,
                                     candidate.lidar_from_board.transform);
    std::string key;
    StageCache* const cache = scene.no_contrast ? nullptr : cache_;
    if (cache != nullptr) {
      const SceneStages& stages = cache_->scene(scene.name);
      const std::string& search = looked_twice_[s] ? stages.second_look.key : stages.search.key;
      key = refinement_key(search, *scene.chosen, request_.options) + refinement_key(scene.edits);
      if (const auto* kept = stages.refinement.find(key)) return *kept;
    }
    if (observer_.board_points) observer_.board_points(s, scene.board_points);
    RefinementObserver each;
    if (observer_.iteration) each = [&](const auto& so_far) { observer_.iteration(s, so_far); };
    auto plane =
        fit_board_plane(scene.board_points, result_.target, candidate.lidar_from_board.transform);
    if (!plane) return plane.error();
    planes_[s] = std::move(*plane);
    auto refinement = refine_nodes(scene.board_points, result_.target, *planes_[s],
                                   request_.options.refinement, context_, each);
    if (refinement && cache != nullptr) cache_->scene(scene.name).refinement.keep(key, *refinement);
    return refinement;
  }

  std::vector<RefinedNode> refine_as_in_paper(std::size_t s) {
    SceneResult& scene = result_.scenes[s];
    StageCache* const cache = scene.no_contrast ? nullptr : cache_;
    std::string key;
    if (cache != nullptr) {
      key = cache->scene(scene.name).refinement.key;
      if (const auto* kept = cache->scene(scene.name).paper_nodes.find(key)) return *kept;
    }
    const RefinementOptions options = as_in_paper(request_.options.refinement);
    // Where ours was kept from before its plane was not.
    auto refined =
        planes_[s]
            ? refine_nodes(scene.board_points, result_.target, *planes_[s], options, context_)
            : refine_board(scene.board_points, result_.target,
                           scene.search->candidates[*scene.chosen].lidar_from_board.transform,
                           options, context_);
    if (!refined) return {};  // Stopped: the same points have been refined before.
    if (cache != nullptr) cache->scene(scene.name).paper_nodes.keep(key, refined->nodes);
    return std::move(refined->nodes);
  }

  void judge_refinement(SceneResult& scene) const {
    if (!can_be_used(scene, result_.target)) {
      const std::vector<RefinedNode>& nodes = scene.refinement->nodes;
      const int usable = scene.refinement->valid_nodes();
      const auto bad = std::find_if(nodes.begin(), nodes.end(),
                                    [](const RefinedNode& node) { return !node.valid; });
      scene.reason = bad == nodes.end()
                         ? Message("only %1 of %2 circles usable", usable, nodes.size())
                         : Message("only %1 of %2 circles usable; node %3: %4", usable,
                                   nodes.size(), bad->id, bad->reason);
      if (scene.insisted) {
        scene.objection = scene.reason;
        do_without_circles(scene);
      }
      return;
    }
    scene.used = true;
  }

  Status optimize() {
    context_.report("optimize", 0.92, Message("joint solve"));
    const auto start = Clock::now();
    std::vector<bool> use;
    for (const SceneResult& scene : result_.scenes) use.push_back(scene.used);
    auto solved = resolve_calibration(std::move(result_), use, request_.options, context_);
    if (!solved) return solved.error();
    result_ = std::move(*solved);
    result_.times.optimize_ms = ms_since(start) - result_.times.response_ms;
    return Done{};
  }

  const Dataset& dataset_;
  const CalibrationRequest& request_;
  const RunContext& context_;
  StageCache* cache_;
  CalibrationObserver observer_;
  CalibrationResult result_;
  std::vector<std::optional<BoardPlane>> planes_;  ///< Per scene, where it was fitted in this run.
  std::vector<char> looked_twice_;                 ///< Per scene; not bool, scenes run in parallel.
  bool looked_for_sizes_ = false;
  bool looked_for_readings_ = false;
};

// After a run with a rough extrinsic has found no board: perhaps that is what is wrong. If the
// scenes agree without it their result stands, and says so.
Result<CalibrationResult> without_guess(Result<CalibrationResult> failed, const Dataset& dataset,
                                        const CalibrationRequest& request,
                                        const RunContext& context) {
  if (failed.error().kind != ErrorKind::kUntrusted || context.stopped()) return failed;
  CalibrationRequest free = request;
  free.guess.reset();
  auto result = Calibration(dataset, free, context, nullptr, CalibrationObserver()).run();
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

Result<CalibrationResult> calibrate(const Dataset& dataset, const CalibrationRequest& request,
                                    const RunContext& context) {
  auto result = Calibration(dataset, request, context, nullptr, CalibrationObserver()).run();
  return result || !request.guess ? std::move(result)
                                  : without_guess(std::move(result), dataset, request, context);
}

Result<CalibrationResult> calibrate(const Dataset& dataset, const CalibrationRequest& request,
                                    const RunContext& context, StageCache& cache,
                                    const CalibrationObserver& observer) {
  auto result = Calibration(dataset, request, context, &cache, observer).run();
  return result || !request.guess ? std::move(result)
                                  : without_guess(std::move(result), dataset, request, context);
}

}  // namespace lvcalib
