// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/cost_functions.h"

#include <array>
#include <vector>

#include <gtest/gtest.h>

#include "support/pose_matchers.h"
#include "support/synthetic_observations.h"

namespace lvcalib {
namespace {

using Block = std::array<double, 7>;

Block block_of(const Rigid3& pose) {
  Block block;
  rigid_to_block(pose, block.data());
  return block;
}

Eigen::VectorXd residuals_of(const ceres::CostFunction& cost, const std::vector<Block>& blocks) {
  std::vector<const double*> pointers;
  for (const Block& block : blocks) pointers.push_back(block.data());
  Eigen::VectorXd residuals(cost.num_residuals());
  EXPECT_TRUE(cost.Evaluate(pointers.data(), residuals.data(), nullptr));
  return residuals;
}

// Closed-form Jacobians against central differences through the manifold's Plus.
void expect_jacobians_hold(const ceres::CostFunction& cost, const std::vector<Block>& blocks) {
  using Jacobian = Eigen::Matrix<double, Eigen::Dynamic, 7, Eigen::RowMajor>;
  const int rows = cost.num_residuals();
  std::vector<Jacobian> storage(blocks.size(), Jacobian::Constant(rows, 7, 1e9));
  std::vector<double*> jacobians;
  std::vector<const double*> pointers;
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    jacobians.push_back(storage[b].data());
    pointers.push_back(blocks[b].data());
  }
  Eigen::VectorXd residuals(rows);
  ASSERT_TRUE(cost.Evaluate(pointers.data(), residuals.data(), jacobians.data()));
  const RigidManifold manifold;
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    Eigen::Matrix<double, 7, 6, Eigen::RowMajor> plus;
    manifold.PlusJacobian(blocks[b].data(), plus.data());
    const Eigen::MatrixXd closed = storage[b] * plus;
    constexpr double kStep = 1e-5;
    for (int k = 0; k < 6; ++k) {
      const auto moved = [&](double step) {
        Vector6d delta = Vector6d::Zero();
        delta(k) = step;
        std::vector<Block> at = blocks;
        manifold.Plus(blocks[b].data(), delta.data(), at[b].data());
        return residuals_of(cost, at);
      };
      const Eigen::VectorXd numeric = (moved(kStep) - moved(-kStep)) / (2.0 * kStep);
      EXPECT_LT((numeric - closed.col(k)).norm(), 1e-6 * (1.0 + closed.norm()))
          << "block " << b << ", column " << k << ": closed " << closed.col(k).transpose()
          << ", numeric " << numeric.transpose();
    }
  }
}

TEST(RigidManifold, PlusIsTheLeftPerturbationAndMinusItsInverse) {
  const RigidManifold manifold;
  Random random(3);
  for (int i = 0; i < 50; ++i) {
    const Rigid3 pose = test::disturbed({}, random, 2.0, 1.0);
    const Block x = block_of(pose);
    Vector6d delta;
    for (double& v : delta) v = 0.3 * random.normal();
    Block y;
    ASSERT_TRUE(manifold.Plus(x.data(), delta.data(), y.data()));
    EXPECT_THAT(rigid_from_block(y.data()), test::IsNearPose(se3_exp(delta) * pose, 1e-9, 1e-5));
    Vector6d back;
    ASSERT_TRUE(manifold.Minus(y.data(), x.data(), back.data()));
    EXPECT_LT((back - delta).norm(), 1e-9);
  }
}

TEST(RigidManifold, BlocksHoldQuaternionThenTranslation) {
  const Rigid3 pose{so3_exp({0.1, 0.2, 0.3}), {4, 5, 6}};
  const Block block = block_of(pose);
  EXPECT_EQ(block[3], pose.rotation.w());
  EXPECT_EQ(block[0], pose.rotation.x());
  EXPECT_EQ(block[4], 4.0);
  EXPECT_EQ(block[6], 6.0);
  EXPECT_EQ(rigid_from_block(block.data()).matrix(), pose.matrix());
}

TEST(CornerCost, JacobianHoldsForEveryCameraModel) {
  const Target target;
  const Rigid3 pose = test::spread_board(target, 1);
  for (const auto model : {DistortionModel::kPlumbBob, DistortionModel::kRationalPolynomial,
                           DistortionModel::kEquidistant}) {
    Camera camera = test::test_camera();
    camera.model = model;
    camera.distortion << 0.02, -0.01, 3e-4, -2e-4, 0.001, 0.03, 0.004, 0.001;
    for (const Eigen::Vector2d& board : {Eigen::Vector2d(0, 0), Eigen::Vector2d(0.7, 0.3)}) {
      const CornerCost cost(camera, board, {600, 400}, 0.07);
      expect_jacobians_hold(cost, {block_of(pose)});
    }
  }
}

TEST(CornerCost, ResidualIsThePixelErrorInStandardDeviations) {
  const Camera camera = test::test_camera();
  const Rigid3 pose = test::spread_board(Target{}, 0);
  const Eigen::Vector2d seen = *camera.project(pose * Eigen::Vector3d(0.1, 0.2, 0.0));
  const CornerCost cost(camera, Eigen::Vector2d(0.1, 0.2), seen - Eigen::Vector2d(0.3, -0.1), 0.1);
  const Eigen::VectorXd r = residuals_of(cost, {block_of(pose)});
  EXPECT_NEAR(r(0), 3.0, 1e-9);
  EXPECT_NEAR(r(1), -1.0, 1e-9);
}

TEST(CornerCost, APointBehindTheCameraFailsTheEvaluation) {
  const Camera camera = test::test_camera();
  Rigid3 pose = test::spread_board(Target{}, 0);
  pose.translation.z() = -2.0;
  const CornerCost cost(camera, Eigen::Vector2d(0.1, 0.2), {600, 400}, 0.1);
  const Block block = block_of(pose);
  const double* blocks[] = {block.data()};
  double residuals[2] = {0, 0};
  EXPECT_FALSE(cost.Evaluate(blocks, residuals, nullptr));
}

TEST(NodeCost, JacobiansHold) {
  const Target target;
  const Rigid3 extrinsic = test::test_extrinsic();
  const Rigid3 board = test::spread_board(target, 2);
  PlaneAxes axes = so3_exp({0.3, -0.8, 0.4}).toRotationMatrix();
  Eigen::Matrix2d whitening;
  whitening << 2000, 300, 0, 1500;
  const NodeCost cost({0.39, 0.17}, {2.5, 0.3, -0.2}, axes, whitening);
  expect_jacobians_hold(cost, {block_of(extrinsic), block_of(board)});
}

TEST(NodeCost, SeesInPlaneErrorsOnly) {
  const Target target;
  const Rigid3 extrinsic = test::test_extrinsic();
  const Rigid3 board = test::spread_board(target, 2);
  const Rigid3 lidar_from_board = extrinsic.inverse() * board;
  const PlaneAxes axes = lidar_from_board.rotation.toRotationMatrix().transpose();
  const auto residual = [&](const Eigen::Vector3d& shift_in_board) {
    const NodeCost cost({0.39, 0.17},
                        lidar_from_board * (Eigen::Vector3d(0.39, 0.17, 0) - shift_in_board), axes,
                        1e3 * Eigen::Matrix2d::Identity());
    return residuals_of(cost, {block_of(extrinsic), block_of(board)});
  };
  EXPECT_LT((residual({0, 0, 0.01})).norm(), 1e-9);
  EXPECT_LT((residual({0.002, -0.001, 0.0}) - Eigen::Vector2d(2, -1)).norm(), 1e-9);
}

TEST(PlaneCost, JacobiansHold) {
  const Target target;
  Eigen::Matrix3d points;
  points << 0.0, 0.7, 0.3, 0.0, 0.1, 0.8, 0, 0, 0;
  Eigen::Matrix3d whitening;
  whitening << 3000, 200, -100, 0, 2500, 50, 0, 0, 4000;
  const PlaneCost cost(points, {2.5, 0.1, 0.2}, Eigen::Vector3d(-0.9, 0.3, 0.1).normalized(),
                       whitening);
  expect_jacobians_hold(
      cost, {block_of(test::test_extrinsic()), block_of(test::spread_board(target, 3))});
}

TEST(PlaneCost, SeesHeightsOnly) {
  const Target target;
  const Rigid3 extrinsic = test::test_extrinsic();
  const Rigid3 board = test::spread_board(target, 3);
  const Rigid3 lidar_from_board = extrinsic.inverse() * board;
  const Eigen::Vector3d normal = lidar_from_board.rotation * Eigen::Vector3d::UnitZ();
  Eigen::Matrix3d points;
  points << 0.0, 0.7, 0.3, 0.0, 0.1, 0.8, 0, 0, 0;
  const auto residual = [&](const Eigen::Vector3d& center_in_board) {
    const PlaneCost cost(points, lidar_from_board * center_in_board, normal,
                         1e3 * Eigen::Matrix3d::Identity());
    return residuals_of(cost, {block_of(extrinsic), block_of(board)});
  };
  EXPECT_LT(residual({0.3, -0.4, 0.0}).norm(), 1e-9);
  EXPECT_LT((residual({0.0, 0.0, -0.002}) - Eigen::Vector3d(2, 2, 2)).norm(), 1e-9);
}

TEST(NodePointCost, JacobiansHold) {
  const Target target;
  const PlaneAxes axes = so3_exp({0.3, -0.8, 0.4}).toRotationMatrix();
  Eigen::Matrix3d whitening;
  whitening << 2000, 300, -50, 0, 1500, 80, 0, 0, 900;
  const NodePointCost cost({0.39, 0.17}, {2.5, 0.3, -0.2}, axes, whitening);
  expect_jacobians_hold(
      cost, {block_of(test::test_extrinsic()), block_of(test::spread_board(target, 2))});
}

// The paper's residual is taken in the board frame; with one σ the frame does not matter.
TEST(NodePointCost, WithOneDeviationIsTheDistanceInTheBoardFrame) {
  const Rigid3 extrinsic = test::test_extrinsic();
  const Rigid3 board = test::spread_board(Target{}, 3);
  const Eigen::Vector2d node(0.39, 0.17);
  const Eigen::Vector3d off(0.002, -0.001, 0.003);  // In the board frame.
  const Eigen::Vector3d center =
      extrinsic.inverse() * (board * (Eigen::Vector3d(node.x(), node.y(), 0.0) + off));
  const double sigma = 0.0015;
  const NodePointCost cost(node, center, so3_exp({0.3, -0.8, 0.4}).toRotationMatrix(),
                           Eigen::Matrix3d::Identity() / sigma);
  EXPECT_NEAR(residuals_of(cost, {block_of(extrinsic), block_of(board)}).norm(), off.norm() / sigma,
              1e-9);
}

}  // namespace
}  // namespace lvcalib
