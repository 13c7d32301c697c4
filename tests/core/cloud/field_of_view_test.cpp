// SPDX-License-Identifier: GPL-3.0-or-later
#include "cloud/field_of_view.h"

#include <cmath>
#include <numbers>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "base/random.h"

namespace lvcalib {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

// Returns at random ranges within limits of azimuth and elevation, the sensor turned.
Cloud scan(double half_azimuth_deg, double half_elevation_deg, const Eigen::Quaterniond& turned) {
  Random random(7);
  Cloud cloud;
  for (int i = 0; i < 20'000; ++i) {
    const double a = kDegree * random.uniform(-half_azimuth_deg, half_azimuth_deg);
    const double e = kDegree * random.uniform(-half_elevation_deg, half_elevation_deg);
    const Eigen::Vector3d d(std::cos(e) * std::cos(a), std::cos(e) * std::sin(a), std::sin(e));
    cloud.points_m.push_back((random.uniform(1.0, 30.0) * (turned * d)).cast<float>());
  }
  return cloud;
}

const Eigen::Quaterniond kTurned(Eigen::AngleAxisd(1.1,
                                                   Eigen::Vector3d(0.3, -1.0, 0.7).normalized()));

TEST(FieldOfView, OfANarrowViewIsItsBorder) {
  const FieldOfView view = field_of_view(scan(35.0, 12.0, kTurned));
  ASSERT_EQ(view.outlines.size(), 1U);
  EXPECT_EQ(view.edges.size(), 4U);
  double widest = 0.0;
  double highest = 0.0;
  for (const Eigen::Vector3d& d : view.outlines[0]) {
    EXPECT_NEAR(d.norm(), 1.0, 1e-6);
    const Eigen::Vector3d seen = kTurned.inverse() * d;
    widest = std::max(widest, std::abs(std::atan2(seen.y(), seen.x())) / kDegree);
    highest = std::max(highest, std::abs(std::asin(seen.z())) / kDegree);
  }
  EXPECT_NEAR(widest, 35.0, 1.0);
  EXPECT_NEAR(highest, 12.0, 0.5);
}

TEST(FieldOfView, AllAroundLiesBetweenTwoCirclesAboutTheAxis) {
  const FieldOfView view = field_of_view(scan(180.0, 15.0, kTurned));
  ASSERT_EQ(view.outlines.size(), 2U);
  EXPECT_EQ(view.edges.size(), 8U);
  const double side = (kTurned.inverse() * view.outlines[0].front()).z() < 0.0 ? -1.0 : 1.0;
  for (const auto& [border, angle] :
       {std::pair(view.outlines[0], side * 15.0), std::pair(view.outlines[1], -side * 15.0)}) {
    for (const Eigen::Vector3d& d : border)
      EXPECT_NEAR(std::asin((kTurned.inverse() * d).z()) / kDegree, angle, 1.0);
  }
}

TEST(FieldOfView, OfNothingIsNothing) {
  EXPECT_TRUE(field_of_view({}).outlines.empty());
  Cloud origin;
  origin.points_m = {Eigen::Vector3f::Zero()};
  EXPECT_TRUE(field_of_view(origin).edges.empty());
}

}  // namespace
}  // namespace lvcalib
