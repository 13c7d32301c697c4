// SPDX-License-Identifier: GPL-3.0-or-later
#include "model/scene_geometry.h"

#include <cmath>

#include <gtest/gtest.h>

#include "support/synthetic_observations.h"

namespace lvcalib {
namespace {

class Geometry : public ::testing::Test {
 protected:
  Target target_;
  Rigid3 camera_from_lidar_ = test::test_extrinsic();
  Rigid3 camera_from_board_ = test::spread_board(target_, 1);
  SceneGeometry geometry_{camera_from_lidar_, camera_from_board_};
  [[nodiscard]] Eigen::Vector3d lidar_point(double x, double y) const {
    return geometry_.lidar_from_board() * Eigen::Vector3d(x, y, 0.0);
  }
};

TEST_F(Geometry, RangeAndBoardPointInvertEachOther) {
  const Eigen::Vector3d p = lidar_point(0.3, 0.1);
  EXPECT_NEAR(geometry_.range_m(p.normalized()).value(), p.norm(), 1e-12);
  EXPECT_LT((geometry_.board_m(p) - Eigen::Vector2d(0.3, 0.1)).norm(), 1e-12);
}

TEST_F(Geometry, RaysAwayFromOrAlongTheBoardMeetNothing) {
  EXPECT_FALSE(geometry_.range_m(-lidar_point(0.3, 0.1).normalized()).has_value());
  const Eigen::Vector3d along = geometry_.lidar_from_board().rotation * Eigen::Vector3d::UnitX();
  EXPECT_FALSE(geometry_.range_m(along).has_value());
}

TEST_F(Geometry, BeamDescribesIncidenceAndTheDirectionOfGrowingRange) {
  BeamPoint beam;
  const Eigen::Vector3d p = lidar_point(0.3, 0.2);
  ASSERT_TRUE(geometry_.describe(p.normalized(), beam));
  EXPECT_NEAR(std::cos(beam.incidence_rad), std::abs(geometry_.normal().dot(p.normalized())),
              1e-12);
  const Eigen::Vector2d further =
      beam.board_m + 0.01 * Eigen::Vector2d(std::cos(beam.slope_rad), std::sin(beam.slope_rad));
  // One centimetre along α lengthens the range by about sin θ centimetres.
  EXPECT_NEAR(lidar_point(further.x(), further.y()).norm() - beam.range_m,
              0.01 * std::sin(beam.incidence_rad), 1e-4);
}

// A row's product with a displacement is what really happens to the measurement.
TEST_F(Geometry, RangeRowIsTheChangeOfMeasuredMinusPredicted) {
  const Eigen::Vector3d p = lidar_point(0.25, 0.4);
  const Eigen::Vector3d moved(2e-5, -1e-5, 3e-5);
  const Eigen::Vector3d q = p + moved;
  const double change = q.norm() - geometry_.range_m(q.normalized()).value();
  EXPECT_NEAR(geometry_.range_row(p.normalized()).dot(moved), change, 1e-9);
}

TEST_F(Geometry, EdgeRowIsTheMoveAlongTheOutwardDirectionOfTheRaysBoardPoint) {
  const Eigen::Vector3d p = lidar_point(0.25, 0.4);
  const Eigen::Vector2d outward(0.6, 0.8);
  const Eigen::Vector3d outward_lidar =
      geometry_.lidar_from_board().rotation * Eigen::Vector3d(0.6, 0.8, 0.0);
  const Eigen::Vector3d moved(2e-5, -1e-5, 3e-5);
  const Eigen::Vector3d direction = (p + moved).normalized();
  const Eigen::Vector2d at = geometry_.board_m(geometry_.range_m(direction).value() * direction);
  const Eigen::Vector3d row = geometry_.edge_row(p.normalized(), outward_lidar);
  EXPECT_NEAR(row.dot(moved), outward.dot(at - Eigen::Vector2d(0.25, 0.4)), 1e-9);
  EXPECT_NEAR(row.dot(p.normalized()), 0.0, 1e-12);
}

TEST_F(Geometry, PoseDerivativesHold) {
  const Eigen::Vector3d direction = lidar_point(0.25, 0.4).normalized();
  const double range = geometry_.range_m(direction).value();
  const Eigen::Vector3d row = geometry_.range_row(direction);
  Vector6d by_lidar_pose;
  by_lidar_pose << row, range * direction.cross(row);
  const Vector6d by_pose = geometry_.by_camera_pose(by_lidar_pose);
  for (int k = 0; k < 6; ++k) {
    Vector6d xi = Vector6d::Zero();
    xi(k) = 1e-6;
    const SceneGeometry board(camera_from_lidar_, se3_exp(xi) * camera_from_board_);
    EXPECT_NEAR((board.range_m(direction).value() - range) / 1e-6, by_pose(k), 1e-4) << k;
    const SceneGeometry extrinsic(se3_exp(xi) * camera_from_lidar_, camera_from_board_);
    EXPECT_NEAR((extrinsic.range_m(direction).value() - range) / 1e-6, -by_pose(k), 1e-4) << k;
  }
}

}  // namespace
}  // namespace lvcalib
