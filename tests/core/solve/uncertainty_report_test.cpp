// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/uncertainty_report.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/random.h"
#include "base/statistics.h"
#include "solve/intrinsics_fit.h"
#include "support/synthetic_observations.h"

namespace lvcalib {
namespace {

using ::testing::HasSubstr;

class Uncertainty : public ::testing::Test {
 protected:
  [[nodiscard]] std::vector<SceneObservations> scenes(int count, std::uint64_t seed) const {
    return test::observed_scenes(count, target_, camera_, truth_, noise_, seed);
  }
  [[nodiscard]] UncertaintyReport assess(const std::vector<SceneObservations>& observations) const {
    const auto joint = solve_extrinsic({observations, camera_, target_, options_});
    if (!joint) {
      ADD_FAILURE() << joint.error().text();
      return {};
    }
    return assess_uncertainty({observations, camera_, target_, options_}, *joint,
                              ProjectionCovariance::held(joint->camera_from_lidar.covariance));
  }
  Target target_;
  Camera camera_ = test::test_camera();
  Rigid3 truth_ = test::test_extrinsic();
  test::ObservationNoise noise_;
  ExtrinsicOptions options_;
};

TEST_F(Uncertainty, HalvesOfGoodScenesDifferAsMuchAsNoiseSays) {
  std::vector<double> chi_squares;
  int contradictions = 0;
  for (std::uint64_t seed = 1; seed <= 15; ++seed) {
    const UncertaintyReport report = assess(scenes(5, seed));
    ASSERT_EQ(report.splits.size(), 3U);
    for (const SplitHalf& split : report.splits) {
      chi_squares.push_back(split.chi_square);
      contradictions += split.agrees() ? 0 : 1;
      EXPECT_EQ(split.first.size() + split.second.size(), 5U);
      EXPECT_GT(split.expected_translation_mm, 0.0);
      EXPECT_GT(split.expected_rotation_mrad, 0.0);
    }
  }
  // χ² of six degrees of freedom: median 5.35. 45 draws that are not quite independent.
  EXPECT_GT(median(chi_squares), 3.0);
  EXPECT_LT(median(chi_squares), 8.5);
  EXPECT_LE(contradictions, 1);
}

// A LiDAR whose ranges are stretched agrees with itself in every scene and not between distances.
TEST_F(Uncertainty, AHiddenEffectShowsBetweenHalves) {
  options_.reject_bad_scenes = false;
  auto observations = scenes(5, 3);
  for (std::size_t s = 0; s < observations.size(); ++s) {
    const double offset = 0.006 * (observations[s].camera_from_board.translation.norm() - 2.5);
    SceneObservations& scene = observations[s];
    const Eigen::Vector3d move = offset * scene.plane.center_m.normalized();
    scene.plane.center_m += move;
    scene.lidar_from_board.translation += move;
    for (RefinedNode& node : scene.nodes) node.center_lidar_m += move;
  }
  const UncertaintyReport report = assess(observations);
  ASSERT_EQ(report.splits.size(), 3U);
  EXPECT_EQ(report.splits[0].name.text(), "near/far");
  EXPECT_FALSE(report.splits[0].agrees()) << report.splits[0].chi_square;
  EXPECT_GT(report.splits[0].translation_mm, report.splits[0].expected_translation_mm);
}

TEST_F(Uncertainty, HalvesAreSortedByWhatTheirNameSays) {
  const auto observations = scenes(5, 4);
  const UncertaintyReport report = assess(observations);
  const auto distance = [&](const std::string& name) {
    for (const SceneObservations& s : observations) {
      if (s.name == name) return s.camera_from_board.translation.norm();
    }
    return 0.0;
  };
  for (const std::string& near : report.splits[0].first) {
    for (const std::string& far : report.splits[0].second)
      EXPECT_LT(distance(near), distance(far) + 0.2);
  }
}

TEST_F(Uncertainty, TooFewScenesSaySo) {
  const UncertaintyReport report = assess(scenes(3, 5));
  EXPECT_TRUE(report.splits.empty());
  EXPECT_THAT(report.splits_reason, HasSubstr("not enough scenes"));
  EXPECT_THAT(report.splits_reason, HasSubstr("3 in use, 4 needed"));
  EXPECT_FALSE(report.by_range.empty());
}

// The map against drawing extrinsics from the covariance and projecting a point.
TEST_F(Uncertainty, PixelCovarianceIsThatOfDrawnExtrinsics) {
  const auto joint = solve_extrinsic({scenes(3, 6), camera_, target_, options_});
  ASSERT_TRUE(joint.ok());
  const Matrix6d& covariance = joint->camera_from_lidar.covariance;
  const Matrix6d root = covariance.llt().matrixL();
  const Eigen::Vector3d point(0.8, -0.5, 5.0);
  const auto held = ProjectionCovariance::held(covariance);
  const auto stated = pixel_covariance(camera_, point, held);
  ASSERT_TRUE(stated.has_value());
  Random random(1);
  Eigen::Matrix2d drawn = Eigen::Matrix2d::Zero();
  constexpr int kDraws = 4000;
  const Eigen::Vector2d center = *camera_.project(point);
  for (int i = 0; i < kDraws; ++i) {
    Vector6d z;
    for (double& v : z) v = random.normal();
    const Eigen::Vector2d d = *camera_.project(se3_exp(root * z) * point) - center;
    drawn += d * d.transpose() / kDraws;
  }
  EXPECT_NEAR(std::sqrt(stated->trace()), std::sqrt(drawn.trace()),
              0.05 * std::sqrt(drawn.trace()));
  EXPECT_FALSE(pixel_covariance(camera_, {0, 0, -1}, held).has_value());
}

// With intrinsics that were estimated together with the extrinsic: drawn from the joint covariance,
// in which a turn takes up most of what the principal point is off.
TEST_F(Uncertainty, PixelCovarianceIsThatOfExtrinsicAndIntrinsicsDrawnTogether) {
  using Matrix18 = Eigen::Matrix<double, 18, 18>;
  Random random(3);
  Matrix18 root = Matrix18::Zero();
  const std::array scale = {2e-3, 2e-3, 4e-3, 1e-3, 1e-3, 5e-4, 1.5, 1.5, 1.0, 1.0, 4e-3, 8e-3};
  for (Eigen::Index i = 0; i < 12; ++i) {
    for (Eigen::Index j = 0; j <= i; ++j)
      root(i, j) = scale[static_cast<std::size_t>(i)] * (i == j ? 1.0 : 0.4 * random.normal());
  }
  // cx moves with a turn about y.
  root.row(8) = -0.95 * camera_.fx * root.row(4);
  root(8, 8) = 0.1;
  const Matrix18 covariance = root * root.transpose();
  ProjectionCovariance both = ProjectionCovariance::held(covariance.topLeftCorner<6, 6>());
  both.cross = covariance.bottomLeftCorner<12, 6>();
  both.intrinsics = covariance.bottomRightCorner<12, 12>();
  constexpr int kDraws = 4000;
  for (const Eigen::Vector3d& point :
       {Eigen::Vector3d(0.8, -0.5, 5.0), Eigen::Vector3d(-1.2, 0.7, 3.0)}) {
    Eigen::Matrix2d drawn = Eigen::Matrix2d::Zero();
    const Eigen::Vector2d center = *camera_.project(point);
    for (int i = 0; i < kDraws; ++i) {
      Eigen::Matrix<double, 18, 1> z;
      for (double& v : z) v = random.normal();
      const Eigen::Matrix<double, 18, 1> off = root * z;
      const Camera other = with_intrinsics(camera_, intrinsics_of(camera_) + off.tail<12>());
      const Eigen::Vector2d d = *other.project(se3_exp(Vector6d(off.head<6>())) * point) - center;
      drawn += d * d.transpose() / kDraws;
    }
    const auto stated = pixel_covariance(camera_, point, both);
    ASSERT_TRUE(stated.has_value());
    // A variance of 4000 draws is known to 2.2 % of itself, its root to half that: four of those.
    for (int axis = 0; axis < 2; ++axis)
      EXPECT_NEAR(std::sqrt((*stated)(axis, axis) / drawn(axis, axis)), 1.0, 0.045) << axis;
    ProjectionCovariance apart = both;
    apart.cross.setZero();
    EXPECT_GT((*pixel_covariance(camera_, point, apart))(0, 0), 1.5 * (*stated)(0, 0));
  }
}

TEST_F(Uncertainty, TheMapCoversTheImageAndGrowsWithRange) {
  const UncertaintyReport report = assess(scenes(3, 7));
  ASSERT_EQ(report.maps.size(), 1U);
  const ProjectedUncertainty& map = report.maps[0];
  EXPECT_EQ(map.pixel.size(), static_cast<std::size_t>(map.columns * map.rows));
  EXPECT_EQ(map.sigma_px.size(), map.pixel.size());
  EXPECT_EQ(map.pixel.front(), Eigen::Vector2d(0, 0));
  EXPECT_EQ(map.pixel.back(), Eigen::Vector2d(camera_.width_px - 1, camera_.height_px - 1));
  for (const double sigma : map.sigma_px) EXPECT_GT(sigma, 0.0);
  for (std::size_t k = 1; k < report.by_range.size(); ++k)
    EXPECT_GT(report.by_range[k].across_mm, report.by_range[k - 1].across_mm);
}

// Against intrinsics that are drawn from the covariance.
TEST_F(Uncertainty, DirectionsScatterOverTheImageAsTheIntrinsicsDo) {
  Random random(11);
  Eigen::Matrix<double, 12, 12> root = Eigen::Matrix<double, 12, 12>::Zero();
  // fx, fy, cx, cy, k1, k2: correlated, so that no entry alone decides.
  const std::array scale = {0.8, 0.7, 0.5, 0.6, 4e-3, 8e-3};
  for (Eigen::Index i = 0; i < 6; ++i) {
    for (Eigen::Index j = 0; j <= i; ++j)
      root(i, j) = scale[static_cast<std::size_t>(i)] * (i == j ? 1.0 : 0.4);
  }
  const ProjectedUncertainty map = project_intrinsics(camera_, root * root.transpose(), 5);
  ASSERT_EQ(map.columns, 5);
  ASSERT_EQ(map.pixel.size(), static_cast<std::size_t>(map.columns * map.rows));
  constexpr int kDraws = 2000;
  std::vector<double> squares(map.pixel.size(), 0.0);
  for (int draw = 0; draw < kDraws; ++draw) {
    Eigen::Matrix<double, 12, 1> normal;
    for (double& n : normal) n = random.normal();
    const Camera other = with_intrinsics(camera_, intrinsics_of(camera_) + root * normal);
    for (std::size_t k = 0; k < squares.size(); ++k)
      squares[k] += (*other.project(*camera_.unproject(map.pixel[k])) - map.pixel[k]).squaredNorm();
  }
  // A variance of 2000 draws of two coordinates is known to 3 % of itself, its root to half that:
  // four of those.
  for (std::size_t k = 0; k < squares.size(); ++k)
    EXPECT_NEAR(std::sqrt(squares[k] / kDraws) / map.sigma_px[k], 1.0, 0.07) << map.pixel[k];
  const auto reach = map.reach_px();
  ASSERT_TRUE(reach.has_value());
  EXPECT_EQ(reach->first, *std::min_element(map.sigma_px.begin(), map.sigma_px.end()));
  EXPECT_EQ(reach->second, *std::max_element(map.sigma_px.begin(), map.sigma_px.end()));
  EXPECT_FALSE(ProjectedUncertainty{}.reach_px().has_value());
}

}  // namespace
}  // namespace lvcalib
