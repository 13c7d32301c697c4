// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/scene_edits.h"

#include <cmath>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "pipeline/refusals.h"

namespace lvcalib {
namespace {

using ::testing::ElementsAre;

// A board two metres ahead whose x runs to the LiDAR's left and y up, seen head on.
Rigid3 board_ahead() {
  Eigen::Matrix3d axes;
  axes << 0, 0, 1, 1, 0, 0, 0, 1, 0;
  return {Eigen::Quaterniond(axes), Eigen::Vector3d(2.0, 0.0, 0.0)};
}

Cloud cloud_of(const std::vector<Eigen::Vector2d>& places, double range_factor = 1.0) {
  Cloud cloud;
  for (const Eigen::Vector2d& p : places) {
    const Eigen::Vector3d in_lidar = board_ahead() * Eigen::Vector3d(p.x(), p.y(), 0.0);
    cloud.points_m.emplace_back((range_factor * in_lidar).cast<float>());
    cloud.intensity.push_back(static_cast<float>(cloud.intensity.size()));
  }
  return cloud;
}

TEST(SceneEdits, SinglePointsAreKnownByTheirCoordinates) {
  Cloud cloud = cloud_of({{0, 0}, {0.1, 0}, {0.2, 0}});
  SceneEdits edits;
  edits.points_m = {cloud.points_m[1]};
  const Cloud taken = take_out(cloud, edits, Target{}, board_ahead());
  EXPECT_THAT(taken.intensity, ElementsAre(1.0F));
  EXPECT_THAT(cloud.intensity, ElementsAre(0.0F, 2.0F));
}

TEST(SceneEdits, APatchTakesWhateverLiesOnTheRaysThroughIt) {
  SceneEdits edits;
  edits.patches_m = {{{0, 0}, {0.1, 0}, {0.1, 0.1}, {0, 0.1}}};
  // Also what stands before the board there, and nothing behind the LiDAR.
  for (const double factor : {1.0, 0.7, 1.2}) {
    const Cloud cloud = cloud_of({{0.05, 0.05}, {0.15, 0.05}, {0.05, -0.01}, {0.09, 0.02}}, factor);
    EXPECT_THAT(left_out_points(cloud, edits, Target{}, board_ahead()), ElementsAre(0U, 3U));
  }
  EXPECT_THAT(left_out_points(cloud_of({{0.05, 0.05}}, -1.0), edits, Target{}, board_ahead()),
              ElementsAre());
}

TEST(SceneEdits, ACircleTakesTheRingAboutItsEdge) {
  const Target target;
  const TargetNode node = target.nodes()[4];
  SceneEdits edits;
  edits.circles = {node.id};
  const Eigen::Vector2d edge(target.circle_radius_m, 0.0);
  const Cloud cloud = cloud_of({node.center_m, node.center_m + edge, node.center_m - edge,
                                target.nodes()[5].center_m + edge});
  EXPECT_THAT(left_out_points(cloud, edits, target, board_ahead()), ElementsAre(1U, 2U));
}

TEST(SceneEdits, ThePatchAboutPointsHoldsThemAndLittleElse) {
  const std::vector<Eigen::Vector2d> places = {{0, 0}, {0.1, 0}, {0.05, 0.08}, {0.05, 0.03}};
  SceneEdits edits;
  edits.patches_m = {patch_about(cloud_of(places).points_m, board_ahead())};
  EXPECT_THAT(left_out_points(cloud_of(places), edits, Target{}, board_ahead()),
              ElementsAre(0U, 1U, 2U, 3U));
  const Cloud beside = cloud_of({{-0.003, 0}, {0.103, 0}, {0.0, 0.05}, {0.05, 0.083}});
  EXPECT_THAT(left_out_points(beside, edits, Target{}, board_ahead()), ElementsAre());
  // Of one point it is the millimetre about it.
  edits.patches_m = {patch_about({cloud_of({{0.2, 0.2}}).points_m[0]}, board_ahead())};
  EXPECT_THAT(left_out_points(cloud_of({{0.2, 0.2}, {0.2, 0.203}}), edits, Target{}, board_ahead()),
              ElementsAre(0U));
}

TEST(SceneEdits, ARingPatchIsOneBinOfACircle) {
  const Target target;
  const TargetNode node = target.nodes()[0];
  SceneEdits edits;
  edits.patches_m = {ring_patch(target, node.id, 1.75 * std::numbers::pi, 0.25 * std::numbers::pi)};
  const auto on_edge = [&](double angle) {
    return Eigen::Vector2d(node.center_m + target.circle_radius_m *
                                               Eigen::Vector2d(std::cos(angle), std::sin(angle)));
  };
  const Cloud cloud = cloud_of({on_edge(0.0), on_edge(0.7), on_edge(0.9), on_edge(-0.7),
                                on_edge(std::numbers::pi), node.center_m});
  EXPECT_THAT(left_out_points(cloud, edits, target, board_ahead()), ElementsAre(0U, 1U, 3U));
}

TEST(SceneEdits, OnlyWhatTheRefinementSeesIsInItsKey) {
  SceneEdits edits;
  edits.tags = {1};
  edits.kept_circles = {2};
  EXPECT_EQ(refinement_key(edits), "");
  edits.circles = {3};
  EXPECT_NE(refinement_key(edits), "");
}

TEST(SceneEdits, WhatIsRefusedIsKeptByItsKind) {
  using What = Refusal::What;
  SceneEdits edits;
  const Eigen::AlignedBox2d box(Eigen::Vector2d(0.1, 0.2), Eigen::Vector2d(0.3, 0.4));
  keep(edits, {"A", What::kTag, 5, 0, {}, true});
  keep(edits, {"A", What::kTag, 2, 0, {}, true});
  keep(edits, {"A", What::kTag, 5, 0, {}, true});
  keep(edits, {"A", What::kCircle, 7, 0, {}, true});
  keep(edits, {"A", What::kPatch, 0, 40, {}, true, box});
  // What cannot be used is not.
  keep(edits, {"A", What::kCircle, 8, 0, {}, false});
  keep(edits, {"A", What::kScene, -1, 0, {}, true});
  keep(edits, {"A", What::kPoints, -1, 9, {}, false});
  SceneEdits wanted;
  wanted.kept_tags = {2, 5};
  wanted.kept_circles = {7};
  wanted.kept_patches = {{{0.1, 0.2}, {0.3, 0.4}}};
  EXPECT_EQ(edits, wanted);
}

}  // namespace
}  // namespace lvcalib
