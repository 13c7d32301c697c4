// SPDX-License-Identifier: BSD-3-Clause
#include "detection/board_view.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "detection/board_pose.h"
#include "detection/board_tags.h"
#include "detection/checkerboard_detector.h"
#include "detection/tag_diagnosis.h"

namespace lvcalib {
namespace {

std::string size_text(int width, int height) {
  return std::to_string(width) + " × " + std::to_string(height);
}

Status check_input(const GrayImage& image, const Target& target, const Camera& camera,
                   const DetectionOptions& options) {
  if (image.width_px != camera.width_px || image.height_px != camera.height_px) {
    return Error::input("the image has " + size_text(image.width_px, image.height_px) +
                            " pixels, the intrinsics are for " +
                            size_text(camera.width_px, camera.height_px),
                        {}, "use the intrinsics of this camera at this resolution");
  }
  if (image.width_px < 1 || image.height_px < 1 ||
      image.pixels.size() !=
          static_cast<std::size_t>(image.width_px) * static_cast<std::size_t>(image.height_px)) {
    return Error::input("the image has no pixels");
  }
  if (const Status status = check(camera); !status) return status;
  if (!(options.max_reprojection_px > 0.0) || !(options.quad_decimate >= 1.0)) {
    return Error::usage(
        "the largest reprojection error must be positive and the image reduction "
        "at least 1");
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
    view.warnings.push_back("corners miss the board by " + std::to_string(pose.rms_px) +
                            " px RMS: check the intrinsics and the target's measures");
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
    return !ids.empty() && static_cast<int>(ids.size()) >= options.min_tags;
  };
  if (!enough()) {
    return explain_missing_tags(image, target, static_cast<int>(tags.size()), options, context);
  }
  const std::size_t seen = tags.size();
  auto pose = estimate_board_pose(to_observations(unambiguous(tags, options.min_tags), target),
                                  camera, options);
  if (!pose) return pose.error();
  std::set<int> dropped = drop_outliers(tags, target, camera, pose->camera_from_board.transform,
                                        options.max_reprojection_px);
  if (enough()) {
    complete_board_tags(tags, image, target, camera, pose->camera_from_board.transform, context);
    drop_outliers(tags, target, camera, pose->camera_from_board.transform,
                  options.max_reprojection_px);
    if (context.stopped()) return Error::cancelled();
  }
  if (!enough()) {
    return Error::input("only " + std::to_string(tags.size()) + " of the " + std::to_string(seen) +
                            " tags seen lie where the target has them",
                        {}, "check tagCols, tagRows, tagSpacing and the intrinsics");
  }
  std::vector<CornerObservation> corners = to_observations(tags, target);
  pose = estimate_board_pose(corners, camera, options);
  if (!pose) return pose.error();
  BoardView view = make_view(std::move(corners), *pose);
  view.tag_count = static_cast<int>(tags.size());
  for (const BoardTag& tag : tags) dropped.erase(tag.id);
  if (!dropped.empty()) {
    view.warnings.push_back("tags that miss the board's pose were dropped: " + id_list(dropped));
  }
  return view;
}

Result<BoardView> view_checkerboard(const GrayImage& image, const Target& target,
                                    const Camera& camera, const DetectionOptions& options,
                                    const RunContext& context) {
  auto corners = find_checkerboard(image, target, context);
  if (!corners) return corners.error();
  const auto pose = estimate_board_pose(*corners, camera, options);
  if (!pose) return pose.error();
  return make_view(std::move(corners).value(), *pose);
}

}  // namespace

Result<BoardView> find_board_in_image(const GrayImage& image, const Target& target,
                                      const Camera& camera, const DetectionOptions& options,
                                      const RunContext& context) {
  if (const Status status = check_input(image, target, camera, options); !status) {
    return status.error();
  }
  if (context.stopped()) return Error::cancelled();
  return target.has_tags() ? view_tags(image, target, camera, options, context)
                           : view_checkerboard(image, target, camera, options, context);
}

}  // namespace lvcalib
