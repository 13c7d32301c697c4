// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/scene_loading.h"

#include <algorithm>
#include <cmath>
#include <mutex>

#include "base/parallel.h"
#include "pipeline/board_images.h"
#include "pipeline/stopwatch.h"

namespace lvcalib {
namespace {

// Distance from the camera to the middle of the board.
double board_distance(const BoardView& view, const Target& target) {
  const Eigen::Vector2d c = target.outline().center_m();
  return (view.camera_from_board.transform * Eigen::Vector3d(c.x(), c.y(), 0.0)).norm();
}

// Looks at images and clouds of scenes in several threads at once; what they share is guarded.
class SceneLoader {
 public:
  SceneLoader(const Dataset& dataset, const CalibrationRequest& request, const RunContext& context,
              CalibrationResult& result, StageCache* cache)
      : dataset_(dataset), request_(request), context_(context), result_(result), cache_(cache) {}

  [[nodiscard]] bool wants(std::size_t s) {
    if (context_.stopped()) return false;
    const std::lock_guard lock(mutex_);
    return !failure_ && result_.scenes[s].reason.empty();
  }

  void look_at_image(std::size_t s) {
    const SceneFiles& files = dataset_.scenes[s];
    const std::string key = cache_ ? detection_key(dataset_, files, request_.options) : "";
    if (const SeenBoard* seen = cache_ ? cache_->scene(files.name).seen.find(key) : nullptr) {
      const std::lock_guard lock(mutex_);
      result_.scenes[s].view = seen->view;
      result_.scenes[s].reason = seen->reason;
      return;
    }
    auto start = Clock::now();
    auto image = read_image(files.image);
    const double load = ms_since(start);
    if (!image) return fail(s, image.error());
    start = Clock::now();
    RunContext quiet = context_.silent();
    // One thread per image where there are enough images.
    quiet.threads = std::max(1, context_.thread_count() / static_cast<int>(dataset_.scenes.size()));
    auto view = find_board_in_image(*image, dataset_.target, dataset_.camera,
                                    request_.options.detection, quiet);
    const double detect = ms_since(start);
    const std::lock_guard lock(mutex_);
    result_.times.load_ms += load;
    result_.times.detect_ms += detect;
    if (view) {
      if (cache_) cache_->scene(files.name).seen.keep(key, {*view, {}});
      result_.scenes[s].view = std::move(*view);
      return;
    }
    if (view.error().kind == ErrorKind::kCancelled) return;
    Error error = view.error();
    if (error.where.empty()) error.where = files.image.string();
    result_.scenes[s].reason = error.sentence();
    // A size that contradicts the intrinsics spoils every scene alike.
    if (size_differs(*image)) {
      if (request_.unusable == UnusableScenes::kRefuse) failure_ = error;
      result_.scenes[s].unreadable = true;
    } else if (cache_) {
      cache_->scene(files.name).seen.keep(key, {{}, error.sentence()});
    }
  }

  void look_at_cloud(std::size_t s) {
    const SceneFiles& files = dataset_.scenes[s];
    const std::string key = cache_ ? search_key(dataset_, files, request_) : "";
    if (const BoardSearchResult* kept =
            cache_ ? cache_->scene(files.name).search.find(key) : nullptr) {
      const auto* warnings = cache_->scene(files.name).cloud_warnings.find(key);
      const std::lock_guard lock(mutex_);
      result_.scenes[s].search = *kept;
      if (warnings != nullptr) result_.scenes[s].cloud_warnings = *warnings;
      return;
    }
    auto start = Clock::now();
    auto cloud = read_scene_cloud(files, request_, context_.stop);
    const double load = ms_since(start);
    if (!cloud) return fail(s, cloud.error());
    if (!cloud->warnings.empty()) {
      const std::lock_guard lock(mutex_);
      result_.scenes[s].cloud_warnings = cloud->warnings;
    }
    if (cloud->size() == 0 && request_.crop_boxes.contains(files.name)) {
      const std::lock_guard lock(mutex_);
      result_.scenes[s].reason = Message("the crop box holds no points");
      return;
    }
    constexpr std::size_t kFewest = 10;  // A plane takes as many.
    if (cloud->size() < kFewest) {
      const std::lock_guard lock(mutex_);
      result_.scenes[s].reason =
          Message("the board is not found in the cloud, which holds %1 points only", cloud->size());
      return;
    }
    start = Clock::now();
    const RunContext quiet = context_.silent();
    std::optional<BoardSearchRegion> region;
    if (request_.guess) region = predicted_region(s, *request_.guess, true);
    auto search = search_board(*cloud,
                               {dataset_.target, pyramid(),
                                board_distance(*result_.scenes[s].view, dataset_.target), region},
                               request_.options.localization, quiet);
    if (context_.stopped()) return;  // Half a search is not to be kept.
    const double localize = ms_since(start);
    const std::lock_guard lock(mutex_);
    result_.times.load_ms += load;
    result_.times.localize_ms += localize;
    if (cache_) {
      cache_->scene(files.name).search.keep(key, search);
      cache_->scene(files.name).cloud_warnings.keep(key, cloud->warnings);
    }
    result_.scenes[s].search = std::move(search);
  }

  void report(const char* stage, std::size_t s) {
    const std::lock_guard lock(mutex_);
    ++done_;
    const double tasks = 2.0 * static_cast<double>(dataset_.scenes.size());
    context_.report(stage, 0.7 * static_cast<double>(done_) / tasks,
                    Message::verbatim(dataset_.scenes[s].name));
  }

  // The error that stops the loading, if there is one.
  [[nodiscard]] Status outcome() const { return failure_ ? Status(*failure_) : Status(Done{}); }

 private:
  [[nodiscard]] bool size_differs(const GrayImage& image) const {
    return image.width_px != dataset_.camera.width_px ||
           image.height_px != dataset_.camera.height_px;
  }

  // Made by the first cloud's thread, while others are still busy with images.
  const PatternPyramid& pyramid() {
    std::call_once(pyramid_made_, [this] { pyramid_.emplace(dataset_.target); });
    return *pyramid_;
  }

  [[nodiscard]] BoardSearchRegion predicted_region(std::size_t s, const Rigid3& guess,
                                                   bool rough) const {
    const BoardOutline outline = dataset_.target.outline();
    const Eigen::Vector2d c = outline.center_m();
    const Rigid3& board = result_.scenes[s].view->camera_from_board.transform;
    const Eigen::Vector3d center = board * Eigen::Vector3d(c.x(), c.y(), 0.0);
    const auto& o = request_.options.consensus;
    const double slack = rough ? o.guess_translation_m + o.guess_rotation_rad * center.norm() : 0.1;
    return {guess.inverse() * center, 0.6 * outline.size_m().norm() + slack,
            guess.rotation.inverse() * (board.rotation * Eigen::Vector3d::UnitX())};
  }

  void fail(std::size_t s, Error error) {
    if (error.kind == ErrorKind::kCancelled) return;
    const std::lock_guard lock(mutex_);
    if (request_.unusable == UnusableScenes::kLeaveOut) {
      result_.scenes[s].reason = error.sentence();
      result_.scenes[s].unreadable = true;
      return;
    }
    if (!failure_) failure_ = std::move(error);
  }

  const Dataset& dataset_;
  const CalibrationRequest& request_;
  const RunContext& context_;
  CalibrationResult& result_;
  StageCache* cache_;
  std::once_flag pyramid_made_;
  std::optional<PatternPyramid> pyramid_;
  std::mutex mutex_;
  std::optional<Error> failure_;
  std::size_t done_ = 0;
};

}  // namespace

Result<Cloud> read_scene_cloud(const SceneFiles& files, const CalibrationRequest& request,
                               std::stop_token stop) {
  const auto& path = request.use_crops && !files.crop.empty() ? files.crop : files.cloud;
  auto cloud = read_cloud(path, std::move(stop), PointChoice::kReturns,
                          request.options.clouds.max_unpacked_bytes());
  if (!cloud) return cloud.error();
  // Here and nowhere else, so that all that follows meets a cloud that never had any.
  if (!request.options.clouds.use_intensity) cloud->intensity.clear();
  const auto box = request.crop_boxes.find(files.name);
  if (box == request.crop_boxes.end()) return cloud;
  if (Status s = check(box->second); !s) return s.error();
  return crop(*cloud, box->second);
}

Status load_scenes(const Dataset& dataset, const CalibrationRequest& request,
                   const RunContext& context, CalibrationResult& result, StageCache* cache) {
  SceneLoader loader(dataset, request, context, result, cache);
  // Images first, then clouds: with few scenes both cores stay busy to the end.
  parallel_two_steps(
      dataset.scenes.size(), context.thread_count(),
      [&](std::size_t s) {
        if (loader.wants(s)) loader.look_at_image(s);
        loader.report("detect", s);
      },
      [&](std::size_t s) {
        if (loader.wants(s) && result.scenes[s].view) loader.look_at_cloud(s);
        loader.report("localize", s);
      });
  return context.stopped() ? Status(Error::cancelled()) : loader.outcome();
}

Status load_extra_images(const Dataset& dataset, const CalibrationRequest& request,
                         const RunContext& context, CalibrationResult& result, StageCache* cache) {
  std::vector<BoardImage>& images = result.intrinsics.extra_images;
  images.assign(dataset.camera_images.size(), {});
  std::mutex mutex;
  RunContext quiet = context.silent();
  quiet.threads = 1;
  parallel_for(images.size(), context.thread_count(), [&](std::size_t k) {
    if (context.stopped()) return;
    const std::filesystem::path& path = dataset.camera_images[k];
    SceneFiles files;
    files.image = path;
    const std::string key = cache ? detection_key(dataset, files, request.options) : "";
    Kept<SeenBoard>* kept = cache ? &cache->scene(extra_image_name(path)).seen : nullptr;
    if (const SeenBoard* seen = kept ? kept->find(key) : nullptr) {
      images[k] = {path, dataset.camera.width_px, dataset.camera.height_px, seen->view,
                   seen->reason};
      return;
    }
    const auto start = Clock::now();
    images[k] = look_at_image(
        path, dataset.target, [&](int, int) { return dataset.camera; }, request.options.detection,
        quiet);
    if (kept && !context.stopped()) kept->keep(key, {images[k].view, images[k].reason});
    const std::lock_guard lock(mutex);
    result.times.detect_ms += ms_since(start);
  });
  if (context.stopped()) return Error::cancelled();
  const auto repeats = [&](const BoardImage& image, std::size_t k) {
    for (const SceneResult& scene : result.scenes) {
      if (scene.view && same_corners(*scene.view, *image.view)) return true;
    }
    for (std::size_t other = 0; other < k; ++other) {
      if (images[other].view && same_corners(*images[other].view, *image.view)) return true;
    }
    return false;
  };
  for (std::size_t k = 0; k < images.size(); ++k) {
    BoardImage& image = images[k];
    if (image.view && repeats(image, k))
      image.reason = Message("it is there already, and counts once");
    if (!image.reason.empty())
      result.warnings.push_back(
          Message("%1: %2; left out", extra_image_name(image.path), image.reason));
  }
  return Done{};
}

Status search_scene_again(const SecondSearch& where, const RunContext& context, SceneResult& scene,
                          StageCache* cache) {
  const BoardSearchRegion& region = where.region;
  // A board that the first look found is still somewhere if the second does not see it here.
  const auto take = [&scene](const SecondLook& look) {
    scene.place = look.place;
    if (!scene.search || !look.search.candidates.empty()) scene.search = look.search;
  };
  std::string key;
  if (cache != nullptr) {
    // The first look came before, so its key stands for files and options.
    key = second_look_key(cache->scene(where.files.name).search.key, region);
    if (const auto* kept = cache->scene(where.files.name).second_look.find(key)) {
      take(*kept);
      return Done{};
    }
  }
  auto cloud = read_scene_cloud(where.files, where.request, context.stop);
  if (!cloud) return cloud.error();
  BoardSearchOptions options = where.request.options.localization;
  options.search_walls = true;
  SecondLook look;
  look.search =
      search_board(*cloud,
                   {where.target, where.pyramid, board_distance(*scene.view, where.target),
                    region.radius_m > 0 ? std::optional(region) : std::nullopt},
                   options, context);
  if (context.stopped()) return Error::cancelled();
  if (region.radius_m > 0) look.place = look_at_place(*cloud, region.center_m, where.target);
  take(look);
  if (cache != nullptr) cache->scene(where.files.name).second_look.keep(key, std::move(look));
  return Done{};
}

BoardPlace look_at_place(const Cloud& cloud, const Eigen::Vector3d& center_m,
                         const Target& target) {
  constexpr int kFewest = 20;      // Rays that a conclusion needs.
  constexpr double kShare = 0.8;   // Of them, how many end elsewhere.
  constexpr double kMiddle = 0.3;  // Of the board's side: certainly inside, however it is turned.
  constexpr double kMargin_m = 0.1;
  const double radius = kMiddle * target.outline().size_m().minCoeff();
  const double range = center_m.norm();
  if (!(range > radius)) return BoardPlace::kOpen;
  const Eigen::Vector3d sight = center_m / range;
  const double cosine = std::cos(std::asin(radius / range));
  int past = 0;
  int before = 0;
  int all = 0;
  for (const Eigen::Vector3f& point : cloud.points_m) {
    const Eigen::Vector3d p = point.cast<double>();
    const double distance = p.norm();
    if (p.dot(sight) < cosine * distance) continue;
    ++all;
    // On a turned board ranges differ by no more than the radius at any believable angle.
    past += distance > range + radius + kMargin_m ? 1 : 0;
    before += distance < range - radius - kMargin_m ? 1 : 0;
  }
  if (all >= kFewest && past + before < (1.0 - kShare) * all) return BoardPlace::kTaken;
  if (past + before < kFewest || past + before <= kShare * all) return BoardPlace::kOpen;
  return past >= before ? BoardPlace::kPast : BoardPlace::kHidden;
}

}  // namespace lvcalib
