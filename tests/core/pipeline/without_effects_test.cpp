// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/without_effects.h"

#include <cmath>

#include <gtest/gtest.h>

#include "pipeline/forward_stage.h"
#include "support/pose_matchers.h"
#include "support/synthetic_observations.h"

namespace lvcalib {
namespace {

// Four scenes of which the third is not used, with returns evenly over the boards.
class Without : public testing::Test {
 protected:
  Without() {
    result_.camera = test::test_camera();
    camera_from_lidar_ = test::test_extrinsic();
    const auto seen =
        test::observed_scenes(4, result_.target, result_.camera, camera_from_lidar_, {}, 1);
    Random random(2);
    for (std::size_t s = 0; s < seen.size(); ++s) {
      SceneResult scene;
      scene.name = seen[s].name;
      scene.used = s != 2;
      scene.view.emplace();
      scene.view->corners = seen[s].corners;
      scene.view->camera_from_board.transform = seen[s].camera_from_board;
      scene.refinement.emplace();
      scene.refinement->nodes = seen[s].nodes;
      for (RefinedNode& node : scene.refinement->nodes) node.raw_lidar_m = node.center_lidar_m;
      scene.refinement->plane = seen[s].plane;
      scene.refinement->lidar_from_board = lidar_from_board(s);
      scene.board_points = returns(lidar_from_board(s), random);
      result_.scenes.push_back(std::move(scene));
    }
    discovery_.state.camera_from_lidar = camera_from_lidar_;
    for (const int s : {0, 1, 3})
      discovery_.state.camera_from_board.push_back(test::spread_board(result_.target, s));
  }

  [[nodiscard]] Rigid3 lidar_from_board(std::size_t s) const {
    return camera_from_lidar_.inverse() * test::spread_board(result_.target, static_cast<int>(s));
  }

  // Range noise of a millimetre.
  [[nodiscard]] Cloud returns(const Rigid3& lidar_from_board, Random& random) const {
    constexpr int kSide = 60;
    const BoardOutline outline = result_.target.outline();
    Cloud cloud;
    for (int k = 0; k < kSide * kSide; ++k) {
      const Eigen::Vector2d at =
          outline.lower_left_m +
          outline.size_m().cwiseProduct(Eigen::Vector2d(k % kSide + 0.5, k / kSide + 0.5)) / kSide;
      const Eigen::Vector3d p = lidar_from_board * Eigen::Vector3d(at.x(), at.y(), 0.0);
      cloud.points_m.push_back((p + 1e-3 * random.normal() * p.normalized()).cast<float>());
    }
    return cloud;
  }

  // Of every scene with a board, whether it is in use or not.
  struct Told {
    std::vector<SceneObservations> observations;
    std::vector<Cloud> clouds;
  };
  [[nodiscard]] Told told(const std::vector<EffectInUse>& model) {
    discovery_.model = model;
    std::vector<std::size_t> index;
    const auto measured = observations_of(result_, {true, true, false, true}, index);
    const WithoutEffects without(discovery_, result_, result_.target, measured, index);
    Told out;
    out.observations = without.observations(measured);
    for (std::size_t k = 0; k < measured.size(); ++k) out.clouds.push_back(without.returns(k));
    return out;
  }

  static std::vector<EffectInUse> model_of(const char* id, const Eigen::VectorXd& values) {
    return {{find_effect(id), 0.0, values}};
  }

  static void expect_same_clouds(const Told& a, const Told& b, double tolerance_m) {
    ASSERT_EQ(a.clouds.size(), b.clouds.size());
    for (std::size_t k = 0; k < a.clouds.size(); ++k) {
      ASSERT_EQ(a.clouds[k].size(), b.clouds[k].size());
      double worst = 0.0;
      for (std::size_t i = 0; i < a.clouds[k].size(); ++i) {
        const Eigen::Vector3f off = a.clouds[k].points_m[i] - b.clouds[k].points_m[i];
        worst = std::max(worst, static_cast<double>(off.norm()));
      }
      EXPECT_LT(worst, tolerance_m) << "scene " << k;
    }
  }
  static void expect_same_planes(const Told& a, const Told& b, double tolerance_m) {
    for (std::size_t k = 0; k < a.observations.size(); ++k) {
      const FittedPlane& p = a.observations[k].plane;
      const FittedPlane& q = b.observations[k].plane;
      EXPECT_NEAR(p.normal.dot(q.center_m - p.center_m), 0.0, tolerance_m) << "scene " << k;
      EXPECT_NEAR(p.normal.cross(q.normal).norm(), 0.0, tolerance_m) << "scene " << k;
    }
  }

  CalibrationResult result_;
  Rigid3 camera_from_lidar_;
  Discovery discovery_;
};

TEST_F(Without, BoardsOfTheModelAreThoseOfTheScenesInUse) {
  const auto boards = modelled_boards(discovery_, result_);
  ASSERT_EQ(boards.size(), 4U);
  EXPECT_FALSE(boards[2].has_value());
  for (const std::size_t s : {0U, 1U, 3U}) {
    ASSERT_TRUE(boards[s].has_value());
    EXPECT_THAT(*boards[s],
                test::IsNearPose(test::spread_board(result_.target, static_cast<int>(s)), 0, 0));
  }
}

TEST_F(Without, ARangeOffsetLeavesReturnsPlanesAndCircles) {
  constexpr double kOffset_m = 0.02;
  const Told clean = told({});
  for (SceneResult& scene : result_.scenes) {
    for (Eigen::Vector3f& p : scene.board_points.points_m)
      p += static_cast<float>(kOffset_m) * p.normalized();
    for (RefinedNode& node : scene.refinement->nodes) {
      node.center_lidar_m += kOffset_m * node.center_lidar_m.normalized();
      node.raw_lidar_m = node.center_lidar_m;
    }
  }
  const Told told_without = told(model_of("range_offset", Eigen::VectorXd::Constant(1, kOffset_m)));
  expect_same_clouds(clean, told_without, 1e-5);
  expect_same_planes(clean, told_without, 1e-5);
  // A circle is moved like the mean of the returns at its edge. Some sixty rays that point up to
  // 50 mrad off its centre's have a mean that is off by about 5 mrad, of the offset 0.1 mm.
  constexpr double kMean_m = 5e-3 * kOffset_m;
  for (std::size_t k = 0; k < clean.observations.size(); ++k) {
    const auto& nodes = clean.observations[k].nodes;
    ASSERT_FALSE(nodes.empty());
    for (std::size_t n = 0; n < nodes.size(); ++n) {
      const RefinedNode& without = told_without.observations[k].nodes[n];
      EXPECT_LT((without.center_lidar_m - nodes[n].center_lidar_m).norm(), kMean_m);
      EXPECT_LT((without.raw_lidar_m - nodes[n].raw_lidar_m).norm(), kMean_m);
    }
  }
}

// A return of a bent board lies where its ray meets it.
TEST_F(Without, ABowLeavesReturnsAndPlanes) {
  const Eigen::Vector3d bow(5e-3, -3e-3, 2e-3);
  const Told clean = told({});
  const BoardOutline outline = result_.target.outline();
  for (std::size_t s = 0; s < result_.scenes.size(); ++s) {
    const Rigid3 board_from_lidar = lidar_from_board(s).inverse();
    for (Eigen::Vector3f& point : result_.scenes[s].board_points.points_m) {
      const Eigen::Vector3d ray = point.cast<double>().normalized();
      const Eigen::Vector3d up = board_from_lidar.rotation * ray;
      const Eigen::Vector3d flat = board_from_lidar * point.cast<double>();
      const Eigen::Vector2d at =
          (flat.head<2>() - outline.center_m()).cwiseQuotient(0.5 * outline.size_m());
      const double height = bow.x() * (1.0 - at.x() * at.x()) + bow.y() * (1.0 - at.y() * at.y()) +
                            bow.z() * at.x() * at.y();
      point += (height / up.z() * ray).cast<float>();
    }
  }
  const Told told_without = told(model_of("board_bow", bow));
  // Where the ray met the bow differs from where it meets the plane by millimetres: to first order.
  expect_same_clouds(clean, told_without, 1e-4);
  expect_same_planes(clean, told_without, 1e-4);
}

TEST_F(Without, ACornerBiasLeavesTheCorners) {
  constexpr double kBias_px = 0.3;
  const Told clean = told({});
  for (std::size_t s = 0; s < result_.scenes.size(); ++s) {
    const Rigid3 camera_from_board = test::spread_board(result_.target, static_cast<int>(s));
    for (CornerObservation& c : result_.scenes[s].view->corners) {
      for (const TargetTag& tag : result_.target.tags()) {
        if (tag.id != c.feature_id) continue;
        Eigen::Vector2d middle = Eigen::Vector2d::Zero();
        for (const Eigen::Vector2d& p : result_.target.tag_corners_m(tag)) middle += 0.25 * p;
        const auto at = result_.camera.project(camera_from_board *
                                               Eigen::Vector3d(middle.x(), middle.y(), 0.0));
        ASSERT_TRUE(at.has_value());
        c.pixel += kBias_px * (c.pixel - *at).normalized();
      }
    }
  }
  const Told told_without = told(model_of("corner_bias", Eigen::VectorXd::Constant(1, kBias_px)));
  for (std::size_t k = 0; k < clean.observations.size(); ++k) {
    const auto& corners = clean.observations[k].corners;
    ASSERT_EQ(corners.size(), told_without.observations[k].corners.size());
    for (std::size_t i = 0; i < corners.size(); ++i) {
      EXPECT_LT((corners[i].pixel - told_without.observations[k].corners[i].pixel).norm(),
                0.01 * kBias_px);
    }
  }
}

TEST_F(Without, CornersThatNoCameraSeesStayAsTheyAre) {
  const auto model = model_of("corner_bias", Eigen::VectorXd::Constant(1, 0.3));
  const auto& corners = result_.scenes[0].view->corners;
  Rigid3 behind = test::spread_board(result_.target, 0);
  behind.translation.z() = -3.0;
  const auto out = corners_without(model, {}, result_, corners, behind);
  ASSERT_EQ(out.size(), corners.size());
  for (std::size_t i = 0; i < out.size(); ++i) EXPECT_EQ(out[i].pixel, corners[i].pixel);
}

TEST_F(Without, DarkPrintReadsFartherByTheRangeWalk) {
  discovery_.model = model_of("range_walk", Eigen::VectorXd::Constant(1, 0.008));
  EXPECT_NEAR(dark_offset_m(ModelledMovements(discovery_, result_)), 0.008, 1e-9);
  discovery_.model = model_of("range_offset", Eigen::VectorXd::Constant(1, 0.008));
  EXPECT_NEAR(dark_offset_m(ModelledMovements(discovery_, result_)), 0.0, 1e-12);
}

}  // namespace
}  // namespace lvcalib
