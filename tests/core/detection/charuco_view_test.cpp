// SPDX-License-Identifier: GPL-3.0-or-later
// ChArUco boards and single tags in rendered images.
#include <algorithm>
#include <cmath>

#include <Eigen/LU>
#include <gtest/gtest.h>

#include "base/statistics.h"
#include "detection/board_view.h"
#include "detection/tag_diagnosis.h"
#include "support/ordinary_boards.h"
#include "support/rendered_board.h"

namespace lvcalib {
namespace {

const Camera kCharucoCamera = testing::pinhole(800, 640, 900);

GrayImage picture(const Target& target, const Rigid3& pose,
                  const testing::RenderOptions& options = {}) {
  testing::RenderOptions render = options;
  if (render.samples_per_side == 5) render.samples_per_side = 4;  // Faster; the default is 5.
  return testing::render_board(target, kCharucoCamera, pose, render);
}

double corner_rms_px(const BoardView& view, const Rigid3& pose) {
  std::vector<double> errors;
  for (const CornerObservation& c : view.corners) {
    const auto p =
        kCharucoCamera.project(pose * Eigen::Vector3d(c.board_m.x(), c.board_m.y(), 0.0));
    for (const double e : (c.pixel - *p).eval()) errors.push_back(e);
  }
  return rms(errors);
}

TEST(CharucoView, CornersAreFoundToHundredthsOfAPixel) {
  for (const Target& target : {test::charuco_target(), test::legacy_charuco_target()}) {
    const Rigid3 pose = testing::facing_pose(target, 1.7, 0.15, 0.35, -0.3);
    // A hundred corners tell the pose so well that the rendering must be fine.
    testing::RenderOptions fine;
    fine.samples_per_side = 8;
    const auto view =
        find_board_in_image(picture(target, pose, fine), target, kCharucoCamera, {}, {});
    ASSERT_TRUE(view.ok()) << view.error().text();
    EXPECT_EQ(view->tag_count, target.tag_count());
    EXPECT_EQ(static_cast<int>(view->corners.size()), 4 * target.tag_count());
    EXPECT_LT(corner_rms_px(*view, pose), 0.05);
    const Vector6d error = se3_log(pose * view->camera_from_board.transform.inverse());
    EXPECT_LT(error.dot(view->camera_from_board.covariance.inverse() * error), 22.5);  // 99.9 %
    EXPECT_LT(error.head<3>().norm(), 1e-3);
  }
}

TEST(CharucoView, APartOfTheBoardIsEnough) {
  const Target target = test::charuco_target();
  const Rigid3 pose = testing::facing_pose(target, 1.5, 0.3, 0.2, 0.3);
  testing::RenderOptions render;
  // Two thirds are hidden.
  render.cover = [](const Eigen::Vector2d& p) {
    return p.x() > 0.2 ? std::optional<double>(0.3) : std::nullopt;
  };
  const auto view =
      find_board_in_image(picture(target, pose, render), target, kCharucoCamera, {}, {});
  ASSERT_TRUE(view.ok()) << view.error().text();
  EXPECT_GE(view->tag_count, 6);
  EXPECT_LT(view->tag_count, 14);
  EXPECT_LT(corner_rms_px(*view, pose), 0.08);
  EXPECT_LT(translation_distance_m(view->camera_from_board.transform, pose), 3e-3);
  // And cut off by the image's edge.
  Rigid3 aside = pose;
  aside.translation.x() += 0.7;
  const auto cut = find_board_in_image(picture(target, aside), target, kCharucoCamera, {}, {});
  ASSERT_TRUE(cut.ok()) << cut.error().text();
  EXPECT_LT(cut->tag_count, target.tag_count());
  EXPECT_LT(translation_distance_m(cut->camera_from_board.transform, aside), 3e-3);
}

TEST(CharucoView, SmallMarkersAreFilledInFromThePose) {
  const Target target = test::charuco_target();
  const Rigid3 pose = testing::facing_pose(target, 4.0, 0.1, 0.5, 0.2);  // Markers of 18 px.
  const auto view = find_board_in_image(picture(target, pose), target, kCharucoCamera, {}, {});
  ASSERT_TRUE(view.ok()) << view.error().text();
  EXPECT_GE(view->tag_count, 24);
  EXPECT_LT(corner_rms_px(*view, pose), 0.12);
}

std::string charuco_complaint(const GrayImage& image, const Target& wanted) {
  const auto view = find_board_in_image(image, wanted, kCharucoCamera, {}, {});
  if (view.ok()) return "found";
  EXPECT_EQ(view.error().kind, ErrorKind::kInput);
  return view.error().text();
}

TEST(CharucoView, SaysWhatTheImageShowsInstead) {
  const Target target = test::legacy_charuco_target();
  const Rigid3 pose = testing::facing_pose(target, 1.7, 0.1, 0.2, -0.2);
  const GrayImage image = picture(target, pose);
  Target other = target;
  other.legacy_pattern = false;
  EXPECT_NE(charuco_complaint(image, other).find("set legacyPattern: true"), std::string::npos);
  other = target;
  other.tag_family = "DICT_6X6_50";
  EXPECT_NE(charuco_complaint(image, other).find("markers of DICT_4X4"), std::string::npos);
  other = target;
  other.first_tag_id = 26;
  EXPECT_NE(charuco_complaint(image, other).find("the target has 26 to 49"), std::string::npos);
  // Counts that the markers contradict; with ids from two rows later all of those fit, off by two.
  other = target;
  --other.corner_columns;
  EXPECT_NE(charuco_complaint(image, other).find("targetCols: 6"), std::string::npos)
      << charuco_complaint(image, other);
  for (const int later : {1, 6}) {
    other = target;
    other.first_tag_id += later;
    const std::string text = charuco_complaint(image, other);
    EXPECT_NE(text.find("fit with firstMarkerId: 3"), std::string::npos) << text;
  }
  GrayImage mirror = image;
  for (int y = 0; y < mirror.height_px; ++y) {
    const auto row = mirror.pixels.begin() + static_cast<std::ptrdiff_t>(y) * mirror.width_px;
    std::reverse(row, row + mirror.width_px);
  }
  const std::string mirrored = charuco_complaint(mirror, target);
  EXPECT_NE(mirrored.find("mirrored"), std::string::npos) << mirrored;
  EXPECT_NE(charuco_complaint(image, Target{}).find("target_type: charuco"), std::string::npos);
}

TEST(CheckerboardView, TagsInItsPlaceAreNamed) {
  Target grid;
  grid.type = TargetType::kAprilGrid;
  grid.tag_columns = grid.tag_rows = 2;
  const std::string tags = charuco_complaint(
      picture(grid, testing::facing_pose(grid, 1.4, 0.1, 0.2, -0.2)), test::checkerboard_target());
  EXPECT_NE(tags.find("tags of family tag36h11 with a 1-bit border found"), std::string::npos)
      << tags;
  // The search for a checkerboard itself takes long on one of other size.
  const Target charuco = test::charuco_target();
  const auto error = tags_instead_of_checkerboard(
      picture(charuco, testing::facing_pose(charuco, 1.7, 0.1, 0.2, -0.2)), {}, {});
  ASSERT_TRUE(error.has_value());
  EXPECT_NE(error->text().find("markers of DICT_5X5"), std::string::npos) << error->text();
}

TEST(SingleTagView, PoseAgreesWithTheTruth) {
  const Target target = test::single_tag_target();
  const Rigid3 pose = testing::facing_pose(target, 1.6, 0.15, 0.4, -0.35);
  const auto view = find_board_in_image(picture(target, pose), target, kCharucoCamera, {}, {});
  ASSERT_TRUE(view.ok()) << view.error().text();
  EXPECT_EQ(view->tag_count, 1);
  EXPECT_EQ(view->corners.size(), 4U);
  EXPECT_LT(corner_rms_px(*view, pose), 0.05);
  EXPECT_LT(translation_distance_m(view->camera_from_board.transform, pose), 3e-3);
}

TEST(SingleTagView, AnotherTagOrTwoOfThemAreRefused) {
  const Target target = test::single_tag_target();
  const Rigid3 pose = testing::facing_pose(target, 2.2, 0.1, 0.2, 0.2);
  Rigid3 left = pose;
  left.translation.x() -= 0.45;
  Rigid3 right = pose;
  right.translation.x() += 0.45;
  GrayImage both = picture(target, left);
  const GrayImage second = picture(target, right);
  for (int y = 0; y < both.height_px; ++y) {
    for (int x = both.width_px / 2; x < both.width_px; ++x) {
      const auto i = static_cast<std::size_t>(y * both.width_px + x);
      both.pixels[i] = second.pixels[i];
    }
  }
  EXPECT_NE(charuco_complaint(both, target).find("twice"), std::string::npos);
  Target other = target;
  other.first_tag_id = 9;
  const std::string text = charuco_complaint(picture(target, pose), other);
  EXPECT_NE(text.find("the target has 9"), std::string::npos) << text;
  EXPECT_NE(text.find("tagId: 7 would fit"), std::string::npos) << text;
}

// Intrinsics of images of half the size: far from their principal point a lens bends much.
TEST(SingleTagView, IntrinsicsOfAnotherImageAreNotTakenForBlur) {
  const Target target = test::single_tag_target();
  const Rigid3 pose = testing::facing_pose(target, 1.6, 0.15, 0.4, -0.35);
  Camera half = kCharucoCamera;
  for (double* value : {&half.fx, &half.fy, &half.cx, &half.cy}) *value *= 0.5;
  half.distortion(0) = 0.15;
  const auto view = find_board_in_image(picture(target, pose), target, half, {}, {});
  ASSERT_FALSE(view.ok());
  EXPECT_NE(view.error().text().find("as it would with these intrinsics"), std::string::npos)
      << view.error().text();
}

// Boards of programs that draw AprilTags upside down, or count from elsewhere.
TEST(TagArrangement, SaysHowTheTagsLie) {
  Target target;
  target.type = TargetType::kAprilGrid;
  target.tag_columns = 4;
  target.tag_rows = 3;
  const Rigid3 pose = testing::facing_pose(target, 1.4, 0.1, 0.2, 0.2);
  const std::vector<TargetTag> tags = target.tags();
  const auto complaint_about = [&](bool turned, bool from_right, bool from_top) {
    testing::RenderOptions render;
    render.cover = [&](const Eigen::Vector2d& p) -> std::optional<double> {
      for (const TargetTag& tag : tags) {
        Eigen::Vector2d d = p - tag.center_m;
        if (d.cwiseAbs().maxCoeff() > 0.5 * target.tag_size_m) continue;
        if (turned) d = -d;
        const int column = from_right ? target.tag_columns - 1 - tag.column : tag.column;
        const int row = from_top ? target.tag_rows - 1 - tag.row : tag.row;
        const auto shown = static_cast<std::size_t>(row * target.tag_columns + column);
        return target.albedo(tags[shown].center_m + d);
      }
      return std::nullopt;
    };
    return charuco_complaint(picture(target, pose, render), target);
  };
  EXPECT_EQ(complaint_about(false, false, false), "found");
  EXPECT_EQ(complaint_about(true, true, true), "found");  // The board itself is turned.
  // Each tag upside down is the board upside down with ids from the other corner.
  const std::string turned = complaint_about(true, false, false);
  EXPECT_NE(turned.find("ids grow from the top right"), std::string::npos) << turned;
  EXPECT_NE(turned.find("upside down and whose tags are each turned by 180°"), std::string::npos)
      << turned;
  EXPECT_NE(complaint_about(false, true, false).find("from the bottom right"), std::string::npos);
  EXPECT_NE(complaint_about(false, false, true).find("from the top left"), std::string::npos);
}

TEST(TwoBoards, WithTheSameTagsAreRefused) {
  Target target;
  target.tag_columns = target.tag_rows = 2;
  target.type = TargetType::kAprilGrid;
  const Rigid3 pose = testing::facing_pose(target, 1.2, 0.1, 0.2, 0.2);
  Rigid3 left = pose;
  left.translation.x() -= 0.25;
  Rigid3 right = pose;
  right.translation.x() += 0.25;
  GrayImage both = picture(target, left);
  const GrayImage second = picture(target, right);
  for (int y = 0; y < both.height_px; ++y) {
    for (int x = both.width_px / 2; x < both.width_px; ++x) {
      const auto i = static_cast<std::size_t>(y * both.width_px + x);
      both.pixels[i] = second.pixels[i];
    }
  }
  EXPECT_NE(charuco_complaint(both, target).find("twice"), std::string::npos);
}

}  // namespace
}  // namespace lvcalib
