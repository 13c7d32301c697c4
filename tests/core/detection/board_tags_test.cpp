// SPDX-License-Identifier: GPL-3.0-or-later
#include "detection/board_tags.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "support/rendered_board.h"

namespace lvcalib {
namespace {

class BoardTags : public ::testing::Test {
 protected:
  BoardTags() {
    target_.tag_columns = 3;
    target_.tag_rows = 2;
    target_.tag_spacing = 0.6;
    target_.circle_radius_m = 0.03;
    pose_ = testing::facing_pose(target_, 0.9, 0.1, 0.3, -0.2);
    render_.samples_per_side = 4;
    // A bar across tag 4 up to its border: it has no closed outline any more.
    const Eigen::Vector2d center = target_.tag(4)->center_m;
    render_.cover = [center](const Eigen::Vector2d& p) -> std::optional<double> {
      const bool bar = std::abs(p.x() - center.x() - 0.035) < 0.008 && p.y() > center.y() - 0.1;
      return bar ? std::optional<double>(0.7) : std::nullopt;
    };
  }
  static bool has(const std::vector<BoardTag>& tags, int id) {
    return std::any_of(tags.begin(), tags.end(),
                       [&](const BoardTag& tag) { return tag.id == id && tag.refined; });
  }

  Target target_;
  Camera camera_ = testing::pinhole(400, 300, 400);
  Rigid3 pose_;
  testing::RenderOptions render_;
};

TEST_F(BoardTags, HiddenTagIsFoundWhereThePosePutsIt) {
  const GrayImage image = testing::render_board(target_, camera_, pose_, render_);
  auto tags = find_board_tags(image, target_, camera_, {}, {});
  ASSERT_TRUE(tags.ok());
  ASSERT_EQ(tags->size(), 5U);
  ASSERT_FALSE(has(*tags, 4));
  complete_board_tags(*tags, image, target_, camera_, pose_, {});
  ASSERT_TRUE(has(*tags, 4));
  for (const CornerObservation& corner : to_observations(*tags, target_)) {
    const Eigen::Vector3d point(corner.board_m.x(), corner.board_m.y(), 0);
    EXPECT_LT((*camera_.project(pose_ * point) - corner.pixel).norm(), 0.2) << corner.feature_id;
    EXPECT_GT(corner.sigma_px, 0.0);
  }
}

TEST_F(BoardTags, NothingIsAddedWhereThereIsNoTag) {
  const Eigen::Vector2d center = target_.tag(4)->center_m;
  render_.cover = [center](const Eigen::Vector2d& p) -> std::optional<double> {
    return (p - center).cwiseAbs().maxCoeff() < 0.07 ? std::optional<double>(0.6) : std::nullopt;
  };
  const GrayImage image = testing::render_board(target_, camera_, pose_, render_);
  auto tags = find_board_tags(image, target_, camera_, {}, {});
  ASSERT_TRUE(tags.ok());
  complete_board_tags(*tags, image, target_, camera_, pose_, {});
  EXPECT_EQ(tags->size(), 5U);
}

}  // namespace
}  // namespace lvcalib
