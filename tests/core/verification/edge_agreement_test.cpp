// SPDX-License-Identifier: GPL-3.0-or-later
#include "verification/edge_agreement.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "simulation/simulator.h"
#include "support/boardless_rooms.h"

namespace lvcalib {
namespace {
using ::testing::HasSubstr;

// Rooms without a board, seen by a scanner; photographed once for all tests.
struct Place {
  Camera camera;
  Rigid3 camera_from_lidar;
  std::vector<EdgeView> views;
};

const Place& place() {
  static const Place made = [] {
    const auto rig = simulation::simulate(test::boardless_rooms(), {});
    EXPECT_TRUE(rig.ok());
    Place out{rig->camera, rig->camera_from_lidar, {}};
    for (const simulation::SimulatedScene& scene : rig->scenes) {
      GrayImage image{scene.image.width_px, scene.image.height_px, {}};
      image.pixels.assign(scene.image.pixels.begin(), scene.image.pixels.end());
      auto view = edge_view(scene.name, image, scene.cloud, rig->camera, rig->camera_from_lidar);
      EXPECT_TRUE(view.ok());
      out.views.push_back(std::move(*view));
    }
    return out;
  }();
  return made;
}

Rigid3 turned(double x_mrad, double y_mrad, double z_mrad) {
  Vector6d offset = Vector6d::Zero();
  offset.tail<3>() = 1e-3 * Eigen::Vector3d(x_mrad, y_mrad, z_mrad);
  return se3_exp(offset) * place().camera_from_lidar;
}

EdgeCheck check(const Rigid3& pose) {
  const auto out = check_edges(place().views, place().camera, pose, {}, {});
  EXPECT_TRUE(out.ok());
  return *out;
}

TEST(EdgeAgreement, IsBestAtTheTruePoseAndChanceFarAway) {
  const EdgeScore right = edge_score(place().views, place().camera, place().camera_from_lidar);
  EXPECT_GT(right.edges, 300U);
  EXPECT_GT(right.score, 0.4);
  EXPECT_LT(right.sigma, 0.1);
  for (const double turn : {-8.0, 8.0}) {
    EXPECT_LT(edge_score(place().views, place().camera, turned(0.0, turn, 0.0)).score,
              right.score - 0.1);
  }
  const EdgeScore far = edge_score(place().views, place().camera, turned(70.0, 90.0, 40.0));
  EXPECT_LT(std::abs(far.score), 0.15);
}

TEST(EdgeAgreement, ATruePoseIsNotAccused) {
  const EdgeCheck right = check(place().camera_from_lidar);
  EXPECT_EQ(right.verdict, EdgeVerdict::kAgrees) << reason_of(right).text();
  EXPECT_LT(right.offset_px, 3.5 * right.offset_sigma_px);
  EXPECT_THAT(reason_of(right), HasSubstr("edges agree to"));
  // Two rooms tell a turn by a degree about any axis.
  EXPECT_LT(right.noticed_turn_rad.maxCoeff(), 0.02);
}

TEST(EdgeAgreement, ATurnedPoseIsFoundOutAndMended) {
  for (const Rigid3& pose : {turned(10.0, 0.0, 0.0), turned(0.0, -12.0, 0.0)}) {
    const EdgeCheck wrong = check(pose);
    EXPECT_EQ(wrong.verdict, EdgeVerdict::kContradicts) << reason_of(wrong).text();
    EXPECT_GT(wrong.best.score, wrong.given.score + 0.1);
    EXPECT_GT(wrong.gain, wrong.gain_that_matters);
    // Most of it is taken back; what is left is within what is stated.
    const Vector6d left = se3_log(place().camera_from_lidar * wrong.best_pose.inverse());
    for (int k = 3; k < 6; ++k)
      EXPECT_LT(std::abs(left(k)), 4.0 * std::sqrt(wrong.covariance(k, k))) << k;
    EXPECT_LT(left.tail<3>().norm(), 0.005);
  }
}

TEST(EdgeAgreement, APoseThatIsElsewhereCannotBeJudged) {
  const EdgeCheck lost = check(turned(300.0, 400.0, 100.0));
  EXPECT_EQ(name_of(lost.verdict), "cannot tell") << reason_of(lost).text();
  const EdgeCheck behind = check(turned(0.0, 3141.0, 0.0));
  EXPECT_EQ(behind.verdict, EdgeVerdict::kFewEdges) << reason_of(behind).text();
  EXPECT_THAT(reason_of(behind), HasSubstr("too few edges"));
}

TEST(EdgeAgreement, TheCalibrationsOwnUncertaintyCounts) {
  EdgeCheckOptions options;
  options.covariance = Matrix6d(1e-4 * Matrix6d::Identity());  // 10 mm, 10 mrad.
  const auto vague =
      check_edges(place().views, place().camera, place().camera_from_lidar, options, {});
  ASSERT_TRUE(vague.ok());
  const EdgeCheck exact = check(place().camera_from_lidar);
  EXPECT_GT(vague->offset_sigma_px, exact.offset_sigma_px + 5.0);
  EXPECT_GT(vague->noticed_turn_rad.minCoeff(), 0.04);
}

TEST(EdgeAgreement, SaysWhatCannotBeUsed) {
  const GrayImage small{10, 10, std::vector<float>(100, 1.0F)};
  const auto size = edge_view("a", small, {}, place().camera, place().camera_from_lidar);
  ASSERT_FALSE(size.ok());
  EXPECT_THAT(size.error().text(),
              HasSubstr("its image has 10 × 10 px, the camera's have 960 × 600"));
  const GrayImage black{960, 600, std::vector<float>(960 * 600, 0.0F)};
  const auto empty = edge_view("a", black, {}, place().camera, place().camera_from_lidar);
  ASSERT_FALSE(empty.ok());
  EXPECT_THAT(empty.error().text(), HasSubstr("the cloud shows no edge"));
  const auto none = check_edges({}, place().camera, place().camera_from_lidar, {}, {});
  ASSERT_FALSE(none.ok());
  EXPECT_EQ(none.error().kind, ErrorKind::kUsage);
  std::stop_source stop;
  stop.request_stop();
  RunContext context;
  context.stop = stop.get_token();
  const auto stopped =
      check_edges(place().views, place().camera, place().camera_from_lidar, {}, context);
  ASSERT_FALSE(stopped.ok());
  EXPECT_EQ(stopped.error().kind, ErrorKind::kCancelled);
}

}  // namespace
}  // namespace lvcalib
