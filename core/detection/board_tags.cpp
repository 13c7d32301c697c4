// SPDX-License-Identifier: BSD-3-Clause
#include "detection/board_tags.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "base/parallel.h"
#include "base/statistics.h"
#include "detection/tag_refinement.h"

namespace lvcalib {
namespace {

// Refines one tag in place; what cannot be refined keeps its corners.
void refine(BoardTag& tag, const GrayImage& image, const Target& target, const Camera& camera,
            TagRefinementOptions options) {
  const TagPattern* pattern = tag_pattern(target.tag_family, tag.id);
  if (pattern == nullptr) return;
  // What is black beyond the gap must not be taken for the surround, nor its blur.
  constexpr double kGapShare = 0.6;
  options.surround_bits =
      std::min(options.surround_bits, kGapShare * target.tag_gap_m() / target.tag_bit_m());
  const auto fit =
      refine_tag(image, *pattern, target.tag_border_bits, tag.corners, &camera, options);
  if (!fit) return;
  tag.corners = fit->corners;
  tag.refined = true;
  tag.contrast = fit->contrast;
  for (std::size_t k = 0; k < 4; ++k) {
    tag.sigma_px[k] = std::sqrt(0.5 * fit->covariance_px2[k].trace());
  }
}

std::size_t distinct(const std::vector<TagDetection>& tags) {
  std::set<int> ids;
  for (const TagDetection& tag : tags) ids.insert(tag.id);
  return ids.size();
}

// Where the pose puts a tag's corners; nothing if any is outside the image.
std::optional<TagCorners> predict(const Target& target, const TargetTag& tag, const Camera& camera,
                                  const Rigid3& camera_from_board) {
  TagCorners out;
  const std::vector<Eigen::Vector2d> board = target.tag_corners_m(tag);
  for (std::size_t k = 0; k < 4; ++k) {
    const auto pixel =
        camera.project(camera_from_board * Eigen::Vector3d(board[k].x(), board[k].y(), 0.0));
    if (!pixel || !camera.in_image(*pixel)) return std::nullopt;
    out[k] = *pixel;
  }
  return out;
}

}  // namespace

int fewest_tags(const Target& target, const DetectionOptions& options) {
  return std::max(1, std::min(options.min_tags, target.tag_count()));
}

Result<std::vector<BoardTag>> find_board_tags(const GrayImage& image, const Target& target,
                                              const Camera& camera, const DetectionOptions& options,
                                              const RunContext& context) {
  TagSearchOptions search;
  search.decimate = options.quad_decimate;
  search.first_id = target.first_tag_id;
  search.id_count = target.tag_count();
  auto found = find_tags(image, target.tag_family, target.tag_border_bits, search, context);
  if (!found) return found.error();
  if (distinct(*found) < static_cast<std::size_t>(fewest_tags(target, options))) {
    search.thorough = true;
    found = find_tags(image, target.tag_family, target.tag_border_bits, search, context);
    if (!found) return found.error();
  }
  std::vector<BoardTag> tags;
  for (const TagDetection& detection : *found) {
    BoardTag tag{detection.id, detection.corners, {}, false, 0.0};
    tag.sigma_px.fill(options.unrefined_sigma_px);
    tags.push_back(tag);
  }
  parallel_for(tags.size(), context.thread_count(), [&](std::size_t i) {
    if (!context.stopped()) refine(tags[i], image, target, camera, {});
  });
  if (context.stopped()) return Error::cancelled();
  return tags;
}

void complete_board_tags(std::vector<BoardTag>& tags, const GrayImage& image, const Target& target,
                         const Camera& camera, const Rigid3& camera_from_board,
                         const RunContext& context) {
  std::vector<double> contrasts;
  std::set<int> good;
  for (const BoardTag& tag : tags) {
    if (!tag.refined) continue;
    contrasts.push_back(tag.contrast);
    good.insert(tag.id);
  }
  if (contrasts.empty()) return;
  const double usual = median(std::move(contrasts));
  std::vector<BoardTag> wanted;
  for (const TargetTag& tag : target.tags()) {
    if (good.contains(tag.id)) continue;
    const auto corners = predict(target, tag, camera, camera_from_board);
    if (corners) wanted.push_back({tag.id, *corners, {}, false, 0.0});
  }
  // Nothing but the pose speaks for these tags, so that the image must be clearer than usual.
  TagRefinementOptions strict;
  strict.min_correlation = 0.65;
  parallel_for(wanted.size(), context.thread_count(), [&](std::size_t i) {
    if (!context.stopped()) refine(wanted[i], image, target, camera, strict);
  });
  for (const BoardTag& tag : wanted) {
    const bool alike = tag.contrast > 0.5 * usual && tag.contrast < 2.0 * usual;
    if (!tag.refined || !alike) continue;
    std::erase_if(tags, [&](const BoardTag& other) { return other.id == tag.id; });
    tags.push_back(tag);
  }
}

std::vector<CornerObservation> to_observations(const std::vector<BoardTag>& tags,
                                               const Target& target) {
  std::vector<CornerObservation> out;
  for (const BoardTag& tag : tags) {
    const auto entry = target.tag(tag.id);
    if (!entry) continue;
    const std::vector<Eigen::Vector2d> board = target.tag_corners_m(*entry);
    for (std::size_t k = 0; k < 4; ++k) {
      out.push_back({tag.id, static_cast<int>(k), board[k], tag.corners[k], tag.sigma_px[k]});
    }
  }
  return out;
}

}  // namespace lvcalib
