// SPDX-License-Identifier: GPL-3.0-or-later
#include "detection/tag_detector.h"

#include <fstream>
#include <set>

#include <gtest/gtest.h>

#include "support/rendered_board.h"

namespace lvcalib {
namespace {

Target small_target(int border_bits) {
  Target target;
  target.type = TargetType::kAprilGrid;
  target.tag_columns = 3;
  target.tag_rows = 2;
  target.tag_border_bits = border_bits;
  target.tag_spacing = 0.5;
  target.first_tag_id = 40;
  return target;
}

std::vector<TagDetection> search(const GrayImage& image, int border,
                                 TagSearchOptions options = {}) {
  const auto tags = find_tags(image, "tag36h11", border, options, {});
  EXPECT_TRUE(tags.ok());
  return tags.ok() ? *tags : std::vector<TagDetection>{};
}

TEST(TagDetector, FindsBothBorderWidthsWithCornersOfTheUprightTag) {
  for (const int border : {1, 2}) {
    const Target target = small_target(border);
    const Camera camera = testing::pinhole(320, 240, 300);
    const Rigid3 pose = testing::facing_pose(target, 0.75, 0.3, 0.2, -0.2);
    testing::RenderOptions render;
    render.samples_per_side = 4;
    const GrayImage image = testing::render_board(target, camera, pose, render);
    const auto tags = search(image, border);
    ASSERT_EQ(tags.size(), 6U) << "border " << border;
    EXPECT_TRUE(search(image, 3 - border).empty());
    for (const TagDetection& tag : tags) {
      ASSERT_TRUE(target.tag(tag.id).has_value());
      const auto board = target.tag_corners_m(*target.tag(tag.id));
      for (std::size_t k = 0; k < 4; ++k) {
        const auto pixel = camera.project(pose * Eigen::Vector3d(board[k].x(), board[k].y(), 0));
        EXPECT_LT((tag.corners[k] - *pixel).norm(), 0.6);
      }
    }
  }
}

TEST(TagDetector, RestrictedIdsAreTheSameTags) {
  const Target target = small_target(1);
  const GrayImage image = testing::render_board(target, testing::pinhole(320, 240, 300),
                                                testing::facing_pose(target, 0.75, 0.1, 0, 0), {});
  TagSearchOptions options;
  options.first_id = 41;
  options.id_count = 3;
  std::set<int> ids;
  for (const TagDetection& tag : search(image, 1, options)) ids.insert(tag.id);
  EXPECT_EQ(ids, (std::set<int>{41, 42, 43}));
  // The library's tables are as before.
  EXPECT_EQ(search(image, 1).size(), 6U);
}

TEST(TagDetector, RefusesWrongOptions) {
  const GrayImage image{64, 64, std::vector<float>(64 * 64, 100.0F)};
  EXPECT_EQ(find_tags(image, "tag99h9", 1, {}, {}).error().kind, ErrorKind::kUsage);
  EXPECT_FALSE(find_tags(image, "tag36h11", 3, {}, {}).ok());
  TagSearchOptions options;
  options.first_id = 580;
  options.id_count = 20;
  EXPECT_FALSE(find_tags(image, "tag36h11", 1, options, {}).ok());
}

TEST(TagDetector, TinyEmptyAndUniformImagesHaveNoTags) {
  for (const int side : {0, 1, 7, 16, 40}) {
    const GrayImage image{side, side, std::vector<float>(static_cast<std::size_t>(side * side), 9)};
    TagSearchOptions options;
    options.thorough = true;
    EXPECT_TRUE(search(image, 1, options).empty()) << side;
  }
}

struct Expected {
  int id;
  TagCorners corners;
};

std::vector<Expected> expected_tags(const std::filesystem::path& file) {
  std::vector<Expected> out;
  std::ifstream stream(file);
  for (std::string line; std::getline(stream, line);) {
    Expected tag{};
    double c[8];
    if (std::sscanf(line.c_str(), "%d, (%lf %lf), (%lf %lf), (%lf %lf), (%lf %lf)", &tag.id, &c[0],
                    &c[1], &c[2], &c[3], &c[4], &c[5], &c[6], &c[7]) != 9) {
      continue;
    }
    // Listed in the library's pixels, whose centres are at half-integers.
    for (std::size_t k = 0; k < 4; ++k) {
      tag.corners[k] = Eigen::Vector2d(c[2 * k] - 0.5, c[2 * k + 1] - 0.5);
    }
    out.push_back(tag);
  }
  return out;
}

TEST(TagPhotos, GiveEveryExpectedTagAndNoFalseId) {
  const auto data = testing::shared_data();
  if (!data) GTEST_SKIP() << "shared data not found";
  const std::filesystem::path folder = *data / "real/tag-photos";
  for (const char* name :
       {"33369213973_9d9bb4cc96_c", "34085369442_304b6bafd9_c", "34139872896_defdb2f8d9_c"}) {
    const auto image = read_image(folder / (std::string(name) + ".jpg"));
    ASSERT_TRUE(image.ok()) << image.error().text();
    TagSearchOptions options;
    options.thorough = true;
    const auto tags = search(*image, 1, options);
    for (const Expected& want : expected_tags(folder / (std::string(name) + ".txt"))) {
      const bool found = std::any_of(tags.begin(), tags.end(), [&](const TagDetection& tag) {
        double worst = 0.0;
        for (std::size_t k = 0; k < 4; ++k) {
          worst = std::max(worst, (tag.corners[k] - want.corners[k]).norm());
        }
        return tag.id == want.id && worst < 3.0;
      });
      EXPECT_TRUE(found) << name << " near " << want.corners[0].transpose();
    }
    for (const TagDetection& tag : tags) EXPECT_EQ(tag.id, 0) << name;  // all cubes show tag 0
  }
}

TEST(TagPhotos, TwoBitGridsAreFoundComplete) {
  const auto data = testing::shared_data();
  if (!data) GTEST_SKIP() << "shared data not found";
  const auto count = [&](const char* name, bool thorough) {
    TagSearchOptions options;
    options.thorough = thorough;
    std::set<int> ids;
    const auto image = read_image(*data / "real/tag-photos" / name);
    EXPECT_TRUE(image.ok());
    for (const TagDetection& tag : search(*image, 2, options)) ids.insert(tag.id);
    return ids.size();
  };
  EXPECT_GE(count("aprilgrid-2bit-iphone.png", false), 66U);
  // Kalibr's squares touch the tags' corners here: the plain search finds hardly any.
  EXPECT_EQ(count("aprilgrid-2bit-fisheye-16bit.png", true), 36U);
}

}  // namespace
}  // namespace lvcalib
