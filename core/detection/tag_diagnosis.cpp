// SPDX-License-Identifier: BSD-3-Clause
#include "detection/tag_diagnosis.h"

#include <algorithm>
#include <optional>
#include <set>
#include <string>

#include "detection/board_tags.h"
#include "detection/tag_detector.h"

namespace lvcalib {
namespace {

GrayImage mirrored(const GrayImage& image) {
  GrayImage out = image;
  for (int y = 0; y < image.height_px; ++y) {
    const auto row = out.pixels.begin() + static_cast<std::ptrdiff_t>(y) * image.width_px;
    std::reverse(row, row + image.width_px);
  }
  return out;
}

// Distinct ids seen. A lone tag with corrected bits may be chance among so many attempts, and the
// smallest family reads tags into any texture: two faultless ones are asked for.
std::set<int> ids_seen(const GrayImage& image, const std::string& family, int border_bits,
                       double decimate, const RunContext& context, std::size_t fewest) {
  TagSearchOptions search;
  search.decimate = decimate;
  search.max_hamming = 0;
  const auto tags = find_tags(image, family, border_bits, search, context);
  std::set<int> ids;
  if (tags) {
    for (const TagDetection& tag : *tags) ids.insert(tag.id);
  }
  const std::size_t enough = family == "tag16h5" || family.starts_with("DICT_4X4") ? 4 : fewest;
  return ids.size() >= enough ? ids : std::set<int>{};
}

std::string listed(const std::set<int>& ids) {
  constexpr std::size_t kShown = 8;
  std::string out;
  std::size_t count = 0;
  for (const int id : ids) {
    if (count == kShown) return out + ", …";
    out += (count++ > 0 ? ", " : "") + std::to_string(id);
  }
  return out;
}

Message border_name(int bits) {
  return Message("%1-bit border", bits);
}

Message expected_ids(const Target& target) {
  if (target.tag_count() == 1) return Message::verbatim(std::to_string(target.first_tag_id));
  return Message("%1 to %2", target.first_tag_id, target.first_tag_id + target.tag_count() - 1);
}

Message ids_against_target(const std::set<int>& ids, const Target& target) {
  return Message("the image shows tags %1 of %2; the target has %3", listed(ids), target.tag_family,
                 expected_ids(target));
}

Message checked_fields(const std::set<int>& ids, const Target& target) {
  if (target.type == TargetType::kAprilTag && ids.size() == 1)
    return Message("tagId: %1 would fit; or use the right board", *ids.begin());
  switch (target.type) {
    case TargetType::kCharuco:
      return Message("check firstMarkerId, targetCols and targetRows, or use the right board");
    case TargetType::kAprilTag:
      return Message("check tagId, or use the right board");
    default:
      return Message("check firstTagId, tagCols and tagRows, or use the right board");
  }
}

// Of each size of OpenCV's markers the largest dictionary; the smaller ones are its beginnings.
std::vector<std::string> distinct_dictionaries() {
  return {"DICT_5X5_1000",       "DICT_6X6_1000",      "DICT_7X7_1000", "DICT_ARUCO_ORIGINAL",
          "DICT_APRILTAG_36h11", "DICT_APRILTAG_25h9", "DICT_4X4_1000"};
}

bool shares_markers(const std::string& a, const std::string& b) {
  // "DICT_5X5".
  return a.substr(0, 8) == b.substr(0, 8) && (a == b || !a.starts_with("DICT_A"));
}

std::optional<Error> other_dictionary(const GrayImage& image, const Target& target,
                                      const DetectionOptions& options, const RunContext& context) {
  for (const std::string& dictionary : distinct_dictionaries()) {
    if (context.stopped()) return std::nullopt;
    if (shares_markers(dictionary, target.tag_family) ||
        ids_seen(image, dictionary, 1, options.quad_decimate, context, 3).empty())
      continue;
    return Error::input(
        Message("markers of %1 found; the target says %2", dictionary, target.tag_family), {},
        target.type == TargetType::kCharuco
            ? Message("set dictionary: %1", dictionary)
            : Message("describe the board with target_type: charuco"));
  }
  return std::nullopt;
}

std::optional<Error> other_family(const GrayImage& image, const Target& target,
                                  const DetectionOptions& options, const RunContext& context,
                                  std::size_t fewest) {
  for (const char* family : {"tag36h11", "tag36h10", "tag25h9", "tag16h5"}) {
    for (const int bits : {1, 2}) {
      if (family == target.tag_family) continue;
      if (context.stopped()) return std::nullopt;
      if (ids_seen(image, family, bits, options.quad_decimate, context, fewest).empty()) continue;
      return Error::input(
          Message("tags of family %1 with a %2 found; the target says %3", family,
                  border_name(bits), target.tag_family),
          {},
          target.type == TargetType::kCharuco
              ? Message("describe the board with target_type: aprilgrid or apriltag")
              : Message("set tagFamily: %1 and tagBorder: %2", family, bits));
    }
  }
  return std::nullopt;
}

}  // namespace

std::optional<Error> tags_instead_of_checkerboard(const GrayImage& image,
                                                  const DetectionOptions& options,
                                                  const RunContext& context) {
  constexpr std::size_t kFewest = 3;  // Squares are read as a tag now and then.
  for (const char* family : {"tag36h11", "tag36h10", "tag25h9", "tag16h5"}) {
    for (const int bits : {1, 2}) {
      if (context.stopped()) return std::nullopt;
      if (ids_seen(image, family, bits, options.quad_decimate, context, kFewest).empty()) continue;
      return Error::input(Message("tags of family %1 with a %2 found; the target is a checkerboard",
                                  family, border_name(bits)),
                          {},
                          Message("describe the board with target_type: aprilgrid or apriltag"));
    }
  }
  for (const std::string& dictionary : distinct_dictionaries()) {
    if (context.stopped()) return std::nullopt;
    if (ids_seen(image, dictionary, 1, options.quad_decimate, context, kFewest).empty()) continue;
    return Error::input(Message("markers of %1 found; the target is a checkerboard", dictionary),
                        {}, Message("describe the board with target_type: charuco"));
  }
  return std::nullopt;
}

std::size_t tags_in_mirror(const GrayImage& image, const Target& target,
                           const DetectionOptions& options, const RunContext& context) {
  const std::set<int> ids = ids_seen(mirrored(image), target.tag_family, target.tag_border_bits,
                                     options.quad_decimate, context, 2);
  return static_cast<std::size_t>(
      std::count_if(ids.begin(), ids.end(), [&](int id) { return target.tag(id).has_value(); }));
}

Message tags_that_fit_with(const Message& fields, const std::vector<BoardTag>& seen,
                           const Target& target) {
  std::set<int> ids;
  for (const BoardTag& tag : seen) ids.insert(tag.id);
  return Message("the image shows tags %1 of %2; the target has %3; all of them fit with %4",
                 listed(ids), target.tag_family, expected_ids(target), fields);
}

std::vector<BoardTag> all_tags_of_family(const GrayImage& image, const Target& target,
                                         const DetectionOptions& options,
                                         const RunContext& context) {
  TagSearchOptions search;
  search.decimate = options.quad_decimate;
  search.max_hamming = 0;
  const auto found = find_tags(image, target.tag_family, target.tag_border_bits, search, context);
  std::vector<BoardTag> tags;
  if (!found) return tags;
  for (const TagDetection& detection : *found) {
    BoardTag tag{detection.id, detection.corners, {}, false, 0.0};
    tag.sigma_px.fill(options.unrefined_sigma_px);
    tags.push_back(tag);
  }
  return tags;
}

std::optional<Error> other_tag_family(const GrayImage& image, const Target& target,
                                      std::size_t found, const DetectionOptions& options,
                                      const RunContext& context) {
  // Of the families of 36 bits none was ever read into another's tags.
  constexpr int kSafeWidth = 6;  // 36 bits, ten or more of which tell two tags apart.
  const TagPattern* tag = tag_pattern(target.tag_family, 0);
  if (target.type == TargetType::kCharuco || tag == nullptr || tag->width >= kSafeWidth)
    return std::nullopt;
  return other_family(image, target, options, context, found + 1);
}

Error explain_mirrored() {
  return Error::input(
      Message("the image (or the print) is mirrored: its tags can be read in a mirror"), {},
      Message("turn off flipping in the camera driver, or print the board again"));
}

Error explain_missing_tags(const GrayImage& image, const Target& target, int found,
                           const DetectionOptions& options, const RunContext& context) {
  const int border = target.tag_border_bits;
  // A board of one tag shows no second one.
  const std::size_t fewest = target.tag_count() == 1 ? 1 : 2;
  const int other_border = 3 - border;
  const std::set<int> same =
      ids_seen(image, target.tag_family, border, options.quad_decimate, context, fewest);
  const bool foreign =
      std::any_of(same.begin(), same.end(), [&](int id) { return !target.tag(id).has_value(); });
  if (foreign) {
    return Error::input(ids_against_target(same, target), {}, checked_fields(same, target));
  }
  if (found > 0) {
    if (const auto other =
            other_tag_family(image, target, static_cast<std::size_t>(found), options, context))
      return *other;
    return Error::input(Message("only %1 of the board's %2 tags found, expected at least %3", found,
                                target.tag_count(), fewest_tags(target, options)),
                        {}, Message("show more of the board, nearer, sharper or better lit"));
  }
  if (context.stopped()) return Error::cancelled();
  if (target.type != TargetType::kCharuco &&
      !ids_seen(image, target.tag_family, other_border, options.quad_decimate, context, fewest)
           .empty()) {
    return Error::input(Message("the tags in the image have a %1; the target says %2",
                                border_name(other_border), border_name(border)),
                        {}, Message("set tagBorder: %1", other_border));
  }
  if (context.stopped()) return Error::cancelled();
  const GrayImage mirror = mirrored(image);
  if (!ids_seen(mirror, target.tag_family, border, options.quad_decimate, context, fewest)
           .empty() ||
      !ids_seen(mirror, target.tag_family, other_border, options.quad_decimate, context, fewest)
           .empty()) {
    return explain_mirrored();
  }
  // AprilTags are in OpenCV's dictionaries as well: what the target is decides whose word comes
  // first.
  const bool charuco = target.type == TargetType::kCharuco;
  for (const bool markers : {charuco, !charuco}) {
    const auto other = markers ? other_dictionary(image, target, options, context)
                               : other_family(image, target, options, context, fewest);
    if (context.stopped()) return Error::cancelled();
    if (other) return *other;
  }
  return Error::input(
      Message("no tags in the image"), {},
      Message("the board must be in view, sharp, and neither dark nor overexposed"));
}

}  // namespace lvcalib
