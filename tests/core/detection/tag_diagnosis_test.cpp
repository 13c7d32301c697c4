// SPDX-License-Identifier: GPL-3.0-or-later
#include "detection/tag_diagnosis.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "support/rendered_board.h"

namespace lvcalib {
namespace {

Target small_target() {
  Target target;
  target.type = TargetType::kAprilGrid;
  target.tag_columns = target.tag_rows = 2;
  target.tag_spacing = 0.5;
  return target;
}

const Camera kCamera = testing::pinhole(280, 240, 300);

GrayImage picture(const Target& target) {
  testing::RenderOptions render;
  render.samples_per_side = 4;
  return testing::render_board(target, kCamera, testing::facing_pose(target, 0.6, 0.2, 0.1, 0.1),
                               render);
}

// What find_board_in_image says about a picture of `shown` when told to look for `wanted`.
std::string complaint(const GrayImage& image, const Target& wanted) {
  const auto view = find_board_in_image(image, wanted, kCamera, {}, {});
  if (view.ok()) return "found";
  EXPECT_EQ(view.error().kind, ErrorKind::kInput);
  return view.error().text();
}

TEST(TagDiagnosis, NamesTheOtherBorder) {
  Target two_bits = small_target();
  two_bits.tag_border_bits = 2;
  EXPECT_NE(complaint(picture(two_bits), small_target()).find("set tagBorder: 2"),
            std::string::npos);
  EXPECT_NE(complaint(picture(small_target()), two_bits).find("set tagBorder: 1"),
            std::string::npos);
}

TEST(TagDiagnosis, NamesTheOtherIds) {
  Target other = small_target();
  other.first_tag_id = 100;
  const std::string text = complaint(picture(other), small_target());
  EXPECT_NE(text.find("100, 101, 102, 103"), std::string::npos) << text;
  EXPECT_NE(text.find("0 to 3"), std::string::npos) << text;
  EXPECT_NE(text.find("firstTagId: 100"), std::string::npos) << text;
}

TEST(TagDiagnosis, NamesTheOtherFamily) {
  Target other = small_target();
  other.tag_family = "tag25h9";
  EXPECT_NE(complaint(picture(other), small_target()).find("tagFamily: tag25h9"),
            std::string::npos);
}

// Families of few bits are read into other tags: that some are seen is no reason to believe them.
TEST(TagDiagnosis, NamesTheOtherFamilyOverMisreadTags) {
  Target small = small_target();
  small.tag_family = "tag16h5";
  const GrayImage image = picture(small_target());
  const auto other = other_tag_family(image, small, 2, {}, {});
  ASSERT_TRUE(other.has_value());
  EXPECT_NE(other->text().find("tagFamily: tag36h11"), std::string::npos) << other->text();
  // As many as there are of the other family are not fewer than it.
  EXPECT_FALSE(other_tag_family(image, small, 4, {}, {}).has_value());
  EXPECT_FALSE(other_tag_family(image, small_target(), 0, {}, {}).has_value());
}

TEST(TagDiagnosis, RecognisesAMirroredImage) {
  GrayImage image = picture(small_target());
  for (int y = 0; y < image.height_px; ++y) {
    const auto row = image.pixels.begin() + static_cast<std::ptrdiff_t>(y) * image.width_px;
    std::reverse(row, row + image.width_px);
  }
  EXPECT_NE(complaint(image, small_target()).find("is mirrored"), std::string::npos);
}

TEST(TagDiagnosis, SaysWhenThereAreNoTags) {
  GrayImage image = picture(small_target());
  std::fill(image.pixels.begin(), image.pixels.end(), 100.0F);
  EXPECT_NE(complaint(image, small_target()).find("no tags"), std::string::npos);
}

TEST(TagDiagnosis, SaysHowManyAreTooFew) {
  Target lone = small_target();
  lone.tag_columns = lone.tag_rows = 1;
  const std::string text = complaint(picture(lone), small_target());
  EXPECT_NE(text.find("only 1 of the board's 4 tags"), std::string::npos) << text;
}

TEST(TagDiagnosis, CancelledSearchSaysSo) {
  std::stop_source source;
  source.request_stop();
  RunContext context;
  context.stop = source.get_token();
  const GrayImage image{280, 240, std::vector<float>(280 * 240, 100.0F)};
  EXPECT_EQ(explain_missing_tags(image, small_target(), 0, {}, context).kind,
            ErrorKind::kCancelled);
}

}  // namespace
}  // namespace lvcalib
