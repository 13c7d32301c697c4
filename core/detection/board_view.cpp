// SPDX-License-Identifier: BSD-3-Clause
#include "detection/board_view.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "base/text.h"
#include "detection/board_pose.h"
#include "detection/board_tags.h"
#include "detection/checkerboard_detector.h"
#include "detection/circle_radius.h"
#include "detection/tag_arrangement.h"
#include "detection/tag_diagnosis.h"

namespace lvcalib {
namespace {

std::string size_text(int width, int height) {
  return std::to_string(width) + " × " + std::to_string(height);
}

Status check_input(const GrayImage& image, const Target& target, const Camera& camera,
                   const DetectionOptions& options) {
  if (image.width_px != camera.width_px || image.height_px != camera.height_px) {
    const bool turned = image.width_px == camera.height_px && image.height_px == camera.width_px;
    return Error::input(
        Message("the image has %1 pixels, the intrinsics are for %2",
                size_text(image.width_px, image.height_px),
                size_text(camera.width_px, camera.height_px)),
        {},
        turned ? Message("it is turned by a quarter: turn it back, and switch off what turns "
                         "images, or use intrinsics of the turned ones")
               : Message("use the intrinsics of this camera at this resolution"));
  }
  if (image.width_px < 1 || image.height_px < 1 ||
      image.pixels.size() !=
          static_cast<std::size_t>(image.width_px) * static_cast<std::size_t>(image.height_px)) {
    return Error::input(Message("the image has no pixels"));
  }
  if (const Status status = check(camera); !status) return status;
  if (!(options.max_reprojection_px > 0.0) || !(options.quad_decimate >= 1.0)) {
    return Error::usage(Message(
        "the largest reprojection error must be positive and the image reduction at least 1"));
  }
  return check(target);
}

// Largest distance of a tag's corners from the pose, in the order of the tags.
std::vector<double> tag_errors(const std::vector<BoardTag>& tags, const Target& target,
                               const Camera& camera, const Rigid3& camera_from_board) {
  std::vector<double> out;
  const std::vector<CornerObservation> corners = to_observations(tags, target);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    if (i % 4 == 0) out.push_back(0.0);
    const Eigen::Vector3d point(corners[i].board_m.x(), corners[i].board_m.y(), 0.0);
    const auto pixel = camera.project(camera_from_board * point);
    const double error = pixel ? (*pixel - corners[i].pixel).norm() : HUGE_VAL;
    out.back() = std::max(out.back(), error);
  }
  return out;
}

// Drops tags that miss the pose, and of several with one id all but the nearest to it.
std::set<int> drop_outliers(std::vector<BoardTag>& tags, const Target& target, const Camera& camera,
                            const Rigid3& camera_from_board, double max_error_px) {
  const std::vector<double> errors = tag_errors(tags, target, camera, camera_from_board);
  std::map<int, std::size_t> best;
  std::set<int> dropped;
  for (std::size_t i = 0; i < tags.size(); ++i) {
    if (errors[i] > max_error_px) dropped.insert(tags[i].id);
    const auto [entry, fresh] = best.emplace(tags[i].id, i);
    if (!fresh && errors[i] < errors[entry->second]) entry->second = i;
  }
  std::vector<BoardTag> kept;
  for (const auto& [id, i] : best) {
    if (errors[i] <= max_error_px) kept.push_back(tags[i]);
  }
  tags = std::move(kept);
  return dropped;
}

// First pose from tags that appear once, as long as there are enough of them.
std::vector<BoardTag> unambiguous(const std::vector<BoardTag>& tags, int min_tags) {
  std::map<int, int> counts;
  for (const BoardTag& tag : tags) ++counts[tag.id];
  std::vector<BoardTag> out;
  for (const BoardTag& tag : tags) {
    if (counts[tag.id] == 1) out.push_back(tag);
  }
  return out.size() >= static_cast<std::size_t>(std::max(min_tags, 1)) ? out : tags;
}

// A second copy of the board: tags with ids that are also on the first one, but lie elsewhere and
// fit a pose of their own. Of a single tag one copy is enough.
bool shows_another(const std::vector<BoardTag>& all, const std::vector<BoardTag>& kept,
                   const Target& target, const Camera& camera, const DetectionOptions& options) {
  const auto center = [](const BoardTag& tag) -> Eigen::Vector2d {
    return 0.25 * (tag.corners[0] + tag.corners[1] + tag.corners[2] + tag.corners[3]);
  };
  std::vector<BoardTag> other;
  for (const BoardTag& tag : all) {
    if (!tag.refined) continue;
    const auto twin =
        std::find_if(kept.begin(), kept.end(), [&](const BoardTag& k) { return k.id == tag.id; });
    if (twin == kept.end()) continue;
    const double size_px = (twin->corners[0] - twin->corners[2]).norm();
    if ((center(*twin) - center(tag)).norm() > 0.5 * size_px) other.push_back(tag);
  }
  if (other.empty()) return false;
  if (target.tag_count() == 1) return true;
  if (other.size() < 2) return false;
  const auto pose = estimate_board_pose(to_observations(other, target), camera, options);
  if (!pose) return false;
  drop_outliers(other, target, camera, pose->camera_from_board.transform,
                options.max_reprojection_px);
  return other.size() >= 2;
}

// Half of the ids, two at least, seen more than once: no pose need be found to know it.
bool seen_twice(const std::vector<BoardTag>& tags, const Target& target) {
  std::map<int, int> counts;
  for (const BoardTag& tag : tags) counts[tag.id] += tag.refined ? 1 : 0;
  const auto several =
      std::count_if(counts.begin(), counts.end(), [](const auto& c) { return c.second > 1; });
  return several >= std::min(2, target.tag_count()) &&
         2 * several >= static_cast<std::ptrdiff_t>(counts.size());
}

Error twice_in_image() {
  return Error::input(Message("the board, or one with the same tags, is in the image twice"), {},
                      Message("cover one of them, or leave this scene out"));
}

// A lone tag whose bits are not found again where its corners and the intrinsics put them: whether
// they are under a pinhole that knows nothing of this camera.
Error unconfirmed_tag(const GrayImage& image, const Target& target, const Camera& given,
                      const DetectionOptions& options, const RunContext& context) {
  Camera pinhole;
  pinhole.width_px = given.width_px;
  pinhole.height_px = given.height_px;
  pinhole.fx = pinhole.fy = given.width_px;
  pinhole.cx = 0.5 * (given.width_px - 1);
  pinhole.cy = 0.5 * (given.height_px - 1);
  const auto tags = find_board_tags(image, target, pinhole, options, context);
  if (tags &&
      std::any_of(tags->begin(), tags->end(), [](const BoardTag& t) { return t.refined; })) {
    return Error::input(
        Message("the tag does not look in the image as it would with these intrinsics"), {},
        Message("check camera.yaml: is it of this camera, and of images of this size?"));
  }
  return Error::input(Message("the tag in the image is too small or too blurred"), {},
                      Message("show it nearer or sharper"));
}

// How many of the tags lie where a target has them.
std::size_t fitting_tags(std::vector<BoardTag> tags, const Target& target, const Camera& camera,
                         const DetectionOptions& options) {
  const auto pose = estimate_board_pose(to_observations(tags, target), camera, options);
  if (!pose) return 0;
  drop_outliers(tags, target, camera, pose->camera_from_board.transform,
                options.max_reprojection_px);
  return tags.size();
}

// Too few tags lie where the target has them: says so, and what would fit.
Error misplaced_tags(std::size_t fitting, const std::vector<BoardTag>& seen, const Target& target,
                     const Camera& camera, const DetectionOptions& options) {
  if (const auto grid = other_grid(seen, target, camera, options)) {
    return Error::input(
        Message("the tags do not lie where the target has them; they do with %1", *grid), {},
        Message("correct target.yaml, or use the right board"));
  }
  if (const auto other = other_arrangement(seen, target, camera, options)) {
    return Error::input(
        Message("the tags lie as on a board %1", *other), {},
        Message("use a board as lvcalib target draws it: tags upright, ids from the bottom left"));
  }
  return Error::input(
      Message("only %1 of the %2 tags seen lie where the target has them", fitting, seen.size()),
      {},
      target.type == TargetType::kCharuco
          ? Message("check targetCols, targetRows, firstMarkerId, legacyPattern and the intrinsics")
          : Message("check tagCols, tagRows, tagSpacing and the intrinsics"));
}

// ChArUco boards come in two layouts with the same markers; half of them lie alike in both, one
// square off.
std::optional<Error> other_layout(std::size_t fitting, const std::vector<BoardTag>& seen,
                                  const Target& target, const Camera& camera,
                                  const DetectionOptions& options) {
  if (target.type != TargetType::kCharuco || fitting == seen.size()) return std::nullopt;
  Target other = target;
  other.legacy_pattern = !target.legacy_pattern;
  if (fitting_tags(seen, other, camera, options) <= fitting) return std::nullopt;
  const std::string value = other.legacy_pattern ? "true" : "false";
  return Error::input(Message("the markers lie as on a board with legacyPattern: %1", value), {},
                      Message("set legacyPattern: %1", value));
}

// Tags that the target does not have are in the image, and all of them fit with other numbers in
// target.yaml: says which.
std::optional<Error> other_count(const GrayImage& image, const Target& target, const Camera& camera,
                                 const DetectionOptions& options, const RunContext& context) {
  const auto all = all_tags_of_family(image, target, options, context);
  if (std::all_of(all.begin(), all.end(),
                  [&](const BoardTag& tag) { return target.tag(tag.id).has_value(); }))
    return std::nullopt;
  const auto grid = other_grid(all, target, camera, options);
  if (!grid) return std::nullopt;
  return Error::input(tags_that_fit_with(*grid, all, target), {},
                      Message("correct target.yaml, or use the right board"));
}

// Where a quarter of the board should be in the image and shows no tag of the target's: with ids
// counted from another number the tags seen fit as well, whole rows off. Then other tags are there.
bool may_be_miscounted(const std::vector<BoardTag>& tags, const Target& target,
                       const Camera& camera, const Rigid3& camera_from_board) {
  if (target.tag_count() < 2) return false;
  std::size_t visible = 0;
  for (const TargetTag& tag : target.tags()) {
    const auto pixel = camera.project(camera_from_board *
                                      Eigen::Vector3d(tag.center_m.x(), tag.center_m.y(), 0.0));
    visible += pixel && camera.in_image(*pixel) ? 1 : 0;
  }
  return 4 * tags.size() <= 3 * visible;
}

std::string id_list(const std::set<int>& ids) {
  std::string out;
  for (const int id : ids) out += (out.empty() ? "" : ", ") + std::to_string(id);
  return out;
}

BoardView make_view(std::vector<CornerObservation> corners, const BoardPose& pose) {
  BoardView view;
  view.corners = std::move(corners);
  view.camera_from_board = pose.camera_from_board;
  view.alternative_pose = pose.alternative_pose;
  view.sigma_px = pose.sigma_px;
  view.rms_px = pose.rms_px;
  // Refined corners reach a few hundredths of a pixel; the rest is the model.
  if (pose.rms_px > 1.0) {
    view.warnings.push_back(Message(
        "corners miss the board by %1 px RMS: check the intrinsics and the target's measures",
        formatted("%.2f", pose.rms_px)));
  }
  return view;
}

Result<BoardView> view_tags(const GrayImage& image, const Target& target, const Camera& camera,
                            const DetectionOptions& options, const RunContext& context) {
  auto found = find_board_tags(image, target, camera, options, context);
  if (!found) return found.error();
  std::vector<BoardTag> tags = std::move(found).value();
  const auto enough = [&] {
    std::set<int> ids;
    for (const BoardTag& tag : tags) ids.insert(tag.id);
    return static_cast<int>(ids.size()) >= fewest_tags(target, options);
  };
  if (!enough()) {
    if (const auto error = other_count(image, target, camera, options, context)) return *error;
    return explain_missing_tags(image, target, static_cast<int>(tags.size()), options, context);
  }
  // Nothing else confirms a lone tag: its bits must be found in the image again.
  if (target.tag_count() == 1) {
    std::erase_if(tags, [](const BoardTag& tag) { return !tag.refined; });
    if (tags.empty()) return unconfirmed_tag(image, target, camera, options, context);
  }
  if (seen_twice(tags, target)) return twice_in_image();
  const std::vector<BoardTag> seen = tags;
  // Small dictionaries read a few markers into a mirrored image as well.
  const auto misplaced = [&]() -> Error {
    if (tags_in_mirror(image, target, options, context) > seen.size()) return explain_mirrored();
    if (const auto error = other_tag_family(image, target, seen.size(), options, context))
      return *error;
    if (const auto error = other_count(image, target, camera, options, context)) return *error;
    return misplaced_tags(tags.size(), seen, target, camera, options);
  };
  auto pose = estimate_board_pose(
      to_observations(unambiguous(tags, fewest_tags(target, options)), target), camera, options);
  if (!pose) return pose.error();
  std::set<int> dropped = drop_outliers(tags, target, camera, pose->camera_from_board.transform,
                                        options.max_reprojection_px);
  if (const auto error = other_layout(tags.size(), seen, target, camera, options)) return *error;
  if (shows_another(seen, tags, target, camera, options)) {
    return twice_in_image();
  }
  // Few of the tags fit many a wrong description.
  if (2 * tags.size() < seen.size() && seen.size() > 2) return misplaced();
  if (enough()) {
    complete_board_tags(tags, image, target, camera, pose->camera_from_board.transform, context);
    drop_outliers(tags, target, camera, pose->camera_from_board.transform,
                  options.max_reprojection_px);
    if (context.stopped()) return Error::cancelled();
  }
  if (!enough()) return misplaced();
  if (may_be_miscounted(tags, target, camera, pose->camera_from_board.transform)) {
    if (const auto error = other_count(image, target, camera, options, context)) return *error;
  }
  std::vector<CornerObservation> corners = to_observations(tags, target);
  pose = estimate_board_pose(corners, camera, options);
  if (!pose) return pose.error();
  BoardView view = make_view(std::move(corners), *pose);
  view.tag_count = static_cast<int>(tags.size());
  for (const BoardTag& tag : tags) dropped.erase(tag.id);
  if (!dropped.empty()) {
    view.warnings.push_back(
        Message("tags that miss the board's pose were dropped: %1", id_list(dropped)));
  }
  return view;
}

Result<BoardView> view_checkerboard(const GrayImage& image, const Target& target,
                                    const Camera& camera, const DetectionOptions& options,
                                    const RunContext& context) {
  auto found = find_checkerboard(image, target, context);
  if (!found && found.error().kind == ErrorKind::kInput) {
    if (const auto error = tags_instead_of_checkerboard(image, options, context)) return *error;
    if (context.stopped()) return Error::cancelled();
  }
  if (!found) return found.error();
  const auto pose = estimate_board_pose(found->corners, camera, options);
  if (!pose) return pose.error();
  BoardView view = make_view(std::move(found->corners), *pose);
  view.other_colors = found->other_colors;
  return view;
}

}  // namespace

Result<BoardView> find_board_in_image(const GrayImage& image, const Target& target,
                                      const Camera& camera, const DetectionOptions& options,
                                      const RunContext& context) {
  if (const Status status = check_input(image, target, camera, options); !status) {
    return status.error();
  }
  if (context.stopped()) return Error::cancelled();
  auto view = target.has_tags() ? view_tags(image, target, camera, options, context)
                                : view_checkerboard(image, target, camera, options, context);
  if (view) {
    view->circle_radius =
        measure_circle_radius(image, target, camera, view->camera_from_board.transform);
  }
  return view;
}

void refit_view(BoardView& view, const Camera& camera, const DetectionOptions& options) {
  const auto pose = estimate_board_pose(view.corners, camera, options);
  if (!pose) return;
  view.camera_from_board = pose->camera_from_board;
  view.alternative_pose = pose->alternative_pose;
  view.sigma_px = pose->sigma_px;
  view.rms_px = pose->rms_px;
}

}  // namespace lvcalib
