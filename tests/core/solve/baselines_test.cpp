// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/baselines.h"

#include <gtest/gtest.h>

#include "support/pose_matchers.h"
#include "support/synthetic_observations.h"

namespace lvcalib {
namespace {

class MethodSolvers : public ::testing::Test {
 protected:
  explicit MethodSolvers(const test::ObservationNoise& noise = {0.0, 0.0, 0.0, 0.0})
      : scenes_(test::observed_scenes(3, target_, camera_, truth_, noise, 1)) {}
  [[nodiscard]] MethodInput input() const {
    MethodInput out{{scenes_, camera_, target_, options_}, {}, {}, {}};
    for (const SceneObservations& scene : scenes_) {
      out.mask.scene.push_back(true);
      out.mask.corner.emplace_back(scene.corners.size(), true);
      out.mask.node.emplace_back(scene.nodes.size(), true);
      out.camera_from_board.push_back(scene.camera_from_board);
    }
    return out;
  }
  Target target_;
  Camera camera_ = test::test_camera();
  Rigid3 truth_ = test::test_extrinsic();
  ExtrinsicOptions options_;
  std::vector<SceneObservations> scenes_;
};

TEST_F(MethodSolvers, FindTheTruthWithoutNoise) {
  EXPECT_THAT(solve_by_alignment(input(), false), test::IsNearPose(truth_, 1e-4, 1e-4));
  EXPECT_THAT(solve_by_alignment(input(), true), test::IsNearPose(truth_, 1e-4, 1e-4));
  EXPECT_THAT(solve_by_reprojection(input()), test::IsNearPose(truth_, 1e-3, 1e-3));
  EXPECT_THAT(solve_by_joint(input(), truth_), test::IsNearPose(truth_, 1e-3, 1e-3));
}

TEST_F(MethodSolvers, MaskedNodesAndScenesDoNotCount) {
  scenes_[0].nodes[2].center_lidar_m.x() += 0.2;
  for (RefinedNode& node : scenes_[1].nodes) node.center_lidar_m.y() += 0.2;
  MethodInput masked = input();
  masked.mask.node[0][2] = false;
  masked.mask.scene[1] = false;
  EXPECT_THAT(solve_by_alignment(masked, false), test::IsNearPose(truth_, 1e-4, 1e-4));
  EXPECT_THAT(solve_by_reprojection(masked), test::IsNearPose(truth_, 1e-3, 1e-3));
  EXPECT_GT(translation_distance_m(solve_by_alignment(input(), false), truth_), 0.005);
}

// A far board's depth is known worst; weighting must let the near one decide.
TEST_F(MethodSolvers, WeightsFavourTheBetterKnownBoard) {
  MethodInput off = input();
  std::size_t far = 0;
  for (std::size_t s = 0; s < 3; ++s) {
    if (scenes_[s].camera_from_board.translation.norm() >
        scenes_[far].camera_from_board.translation.norm())
      far = s;
  }
  off.camera_from_board[far].translation *= 1.01;
  EXPECT_LT(translation_distance_m(solve_by_alignment(off, true), truth_),
            translation_distance_m(solve_by_alignment(off, false), truth_));
}

TEST_F(MethodSolvers, RawNodesAreTheOnesBeforeRefinement) {
  scenes_[0].nodes[0].raw_lidar_m = {1.0, 2.0, 3.0};
  const auto raw = with_raw_nodes(scenes_);
  EXPECT_EQ(raw[0].nodes[0].center_lidar_m, Eigen::Vector3d(1.0, 2.0, 3.0));
  EXPECT_EQ(raw[0].nodes[0].center_uv_m, scenes_[0].plane.to_plane(Eigen::Vector3d(1.0, 2.0, 3.0)));
}

}  // namespace
}  // namespace lvcalib
