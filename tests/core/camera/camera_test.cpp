// SPDX-License-Identifier: GPL-3.0-or-later
#include "camera/camera.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>
#include <opencv2/calib3d.hpp>

#include "base/random.h"

namespace lvcalib {
namespace {

Camera camera_of(DistortionModel model, std::initializer_list<double> coefficients) {
  Camera camera;
  camera.width_px = 1440;
  camera.height_px = 900;
  camera.fx = 1020;
  camera.fy = 1018.755;
  camera.cx = 731.166;
  camera.cy = 458.48;
  camera.model = model;
  Eigen::Index i = 0;
  for (const double k : coefficients) camera.distortion[i++] = k;
  return camera;
}

std::vector<Camera> cameras() {
  return {camera_of(DistortionModel::kPlumbBob, {}),
          camera_of(DistortionModel::kPlumbBob, {-0.078, 0.0432, -0.0029, -0.0028, 0.011}),
          camera_of(DistortionModel::kRationalPolynomial,
                    {0.35, -0.12, 0.0007, -0.0011, 0.02, 0.61, -0.08, 0.03}),
          camera_of(DistortionModel::kEquidistant, {-0.054, -0.0784, 0.096, -0.0515}),
          camera_of(DistortionModel::kEquidistant, {0.01, 0.002, 0.0003, 0.0001})};
}

cv::Point2d opencv_project(const Camera& c, const Eigen::Vector3d& p) {
  const cv::Mat k = (cv::Mat_<double>(3, 3) << c.fx, 0, c.cx, 0, c.fy, c.cy, 0, 0, 1);
  const int count = c.model == DistortionModel::kPlumbBob ? 5 : c.distortion_count();
  cv::Mat d(1, count, CV_64F);
  for (int i = 0; i < count; ++i) d.at<double>(i) = c.distortion[i];
  const std::vector<cv::Point3d> points{{p.x(), p.y(), p.z()}};
  const cv::Mat zero = cv::Mat::zeros(3, 1, CV_64F);
  std::vector<cv::Point2d> pixels;
  if (c.model == DistortionModel::kEquidistant) {
    cv::fisheye::projectPoints(points, pixels, zero, zero, k, d);
  } else {
    cv::projectPoints(points, zero, zero, k, d, pixels);
  }
  return pixels[0];
}

TEST(Camera, ProjectsAsOpenCvDoes) {
  Random random(1);
  int compared = 0;
  for (const Camera& camera : cameras()) {
    for (int i = 0; i < 200; ++i) {
      const double z = random.uniform(0.3, 20.0);
      const Eigen::Vector3d p(z * random.uniform(-0.8, 0.8), z * random.uniform(-0.6, 0.6), z);
      const auto pixel = camera.project(p);
      if (!pixel) continue;
      const cv::Point2d expected = opencv_project(camera, p);
      EXPECT_NEAR(pixel->x(), expected.x, 1e-9);
      EXPECT_NEAR(pixel->y(), expected.y, 1e-9);
      ++compared;
    }
  }
  EXPECT_GT(compared, 900);
}

// Central differences with the step that balances truncation and rounding.
void expect_derivatives(const Camera& camera, const Eigen::Vector3d& p) {
  Eigen::Matrix<double, 2, 3> by_point;
  Eigen::Matrix<double, 2, 12> by_intrinsics;
  const auto pixel = camera.project(p, &by_point, &by_intrinsics);
  ASSERT_TRUE(pixel);
  const double h = 1e-6 * p.norm();
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d step = h * Eigen::Vector3d::Unit(i);
    const Eigen::Vector2d numeric =
        (*camera.project(p + step) - *camera.project(p - step)) / (2 * h);
    EXPECT_LT((numeric - by_point.col(i)).norm(), 1e-5 * by_point.norm()) << "point " << i;
  }
  for (int i = 0; i < 12; ++i) {
    const auto moved = [&](double delta) {
      Camera c = camera;
      double* fields[] = {&c.fx, &c.fy, &c.cx, &c.cy};
      (i < 4 ? *fields[i] : c.distortion[i - 4]) += delta;
      return *c.project(p);
    };
    const Eigen::Vector2d numeric = (moved(1e-5) - moved(-1e-5)) / 2e-5;
    const bool used = i < 4 || i - 4 < camera.distortion_count();
    const Eigen::Vector2d expected = used ? numeric : Eigen::Vector2d(0, 0);
    EXPECT_LT((expected - by_intrinsics.col(i)).norm(), 1e-4 + 1e-6 * numeric.norm())
        << "intrinsic " << i;
  }
}

TEST(Camera, JacobiansAgreeWithDifferences) {
  Random random(2);
  for (const Camera& camera : cameras()) {
    for (int i = 0; i < 50; ++i) {
      const double z = random.uniform(0.5, 10.0);
      expect_derivatives(camera, {z * random.uniform(-0.5, 0.5), z * random.uniform(-0.4, 0.4), z});
    }
    for (const double r : {0.0, 1e-9, 1e-5, 0.9e-4, 1.1e-4, 1e-2}) {
      expect_derivatives(camera, {2 * r, -1.5 * r, 2.0});
    }
  }
}

TEST(Camera, RoundTripsFromPixelsAndFromPoints) {
  Random random(3);
  int trips = 0;
  for (const Camera& camera : cameras()) {
    for (int i = 0; i < 300; ++i) {
      const Eigen::Vector2d pixel(random.uniform(-0.5, camera.width_px - 0.5),
                                  random.uniform(-0.5, camera.height_px - 0.5));
      const auto ray = camera.unproject(pixel);
      ASSERT_TRUE(ray) << pixel.transpose();
      EXPECT_NEAR(ray->norm(), 1.0, 1e-14);
      const auto back = camera.project(*ray * random.uniform(0.1, 30.0));
      ASSERT_TRUE(back);
      EXPECT_LT((*back - pixel).norm(), 1e-9);
      ++trips;
    }
    // The axis and its surroundings.
    for (const double d : {0.0, 1e-12, 1e-6, 1e-3}) {
      const Eigen::Vector2d pixel(camera.cx + d, camera.cy - d);
      EXPECT_LT((*camera.project(*camera.unproject(pixel)) - pixel).norm(), 1e-9);
    }
  }
  EXPECT_EQ(trips, 1500);
}

TEST(Camera, SeesNothingBehindItself) {
  for (const Camera& camera : cameras()) {
    EXPECT_FALSE(camera.project({0, 0, -1}));
    EXPECT_FALSE(camera.project({0, 0, 0}));
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_FALSE(camera.project({nan, 0, 1}));
    EXPECT_FALSE(camera.project({0, 0, nan}));
    EXPECT_FALSE(camera.project({std::numeric_limits<double>::infinity(), 0, 1}));
    EXPECT_FALSE(camera.unproject({nan, 0}));
  }
  const Camera pinhole = cameras()[0];
  EXPECT_FALSE(pinhole.project({1, 0, 0}));
  EXPECT_FALSE(pinhole.project({1, 0, -1}));
}

// k1 = −0.3: g' = 1 − 0.9 s, so the field ends at r = √(1/0.9); with k2 = 0.1 > 0 at a larger s
// the profile would grow again.
TEST(Camera, FieldEndsAtTheFirstFoldEvenWhereTheProfileGrowsAgain) {
  const Camera once = camera_of(DistortionModel::kPlumbBob, {-0.3});
  const double edge = std::sqrt(1 / 0.9);
  EXPECT_TRUE(once.project({edge - 1e-6, 0, 1}));
  EXPECT_FALSE(once.project({edge + 1e-6, 0, 1}));

  // g' = 1 − 1.5 s + 0.5 s²: zero at s = 1 and s = 2, positive again beyond.
  const Camera again = camera_of(DistortionModel::kPlumbBob, {-0.5, 0.1});
  EXPECT_TRUE(again.project({0, 1 - 1e-6, 1}));
  EXPECT_FALSE(again.project({0, 1 + 1e-6, 1}));
  EXPECT_FALSE(again.project({0, 1.6, 1}));
  EXPECT_FALSE(again.project({0, 50, 1}));
  // Pixels beyond the edge of the image circle have no ray; pixels inside have the near one.
  EXPECT_FALSE(again.unproject({again.cx + again.fx * 0.601, again.cy}));
  const auto ray = again.unproject({again.cx + again.fx * 0.599, again.cy});
  ASSERT_TRUE(ray);
  EXPECT_LT(ray->x() / ray->z(), 1.0);
}

TEST(Camera, RationalFieldEndsAtItsPole) {
  // D = 1 − s: N/D runs to infinity at r = 1 and comes back from below.
  const Camera camera = camera_of(DistortionModel::kRationalPolynomial, {0, 0, 0, 0, 0, -1.0});
  EXPECT_TRUE(camera.project({0.999, 0, 1}));
  EXPECT_FALSE(camera.project({1.001, 0, 1}));
  EXPECT_FALSE(camera.project({3.0, 0, 1}));
  const auto ray = camera.unproject({camera.cx + 100 * camera.fx, camera.cy});
  ASSERT_TRUE(ray);
  EXPECT_LT(
      (*camera.project(*ray) - Eigen::Vector2d(camera.cx + 100 * camera.fx, camera.cy)).norm(),
      1e-7);
}

TEST(Camera, StrongDecentringStillInverts) {
  const Camera camera = camera_of(DistortionModel::kPlumbBob, {-0.35, 0.12, 0.02, -0.015, -0.02});
  int trips = 0;
  for (double x = -1.2; x <= 1.2; x += 0.05) {
    for (double y = -1.2; y <= 1.2; y += 0.05) {
      const auto pixel = camera.project({x, y, 1});
      if (!pixel) continue;
      const auto ray = camera.unproject(*pixel);
      if (!ray) continue;  // Two points may share a pixel near the rim.
      EXPECT_LT((*camera.project(*ray) - *pixel).norm(), 1e-8);
      ++trips;
    }
  }
  EXPECT_GT(trips, 1000);
}

TEST(Camera, EquidistantSeesBeyondNinetyDegrees) {
  Camera camera = camera_of(DistortionModel::kEquidistant, {0.01, 0.002, 0.0003, 0.0001});
  camera.fx = camera.fy = 300;
  for (const double degrees : {89.0, 90.0, 91.0, 120.0, 170.0, 179.0}) {
    const double theta = degrees * M_PI / 180;
    const Eigen::Vector3d p(std::sin(theta) * 0.6, -std::sin(theta) * 0.8, std::cos(theta));
    const auto pixel = camera.project(2.5 * p);
    ASSERT_TRUE(pixel) << degrees;
    const double s = theta * theta;
    const double expected =
        300 * theta * (1 + s * (0.01 + s * (0.002 + s * (0.0003 + s * 0.0001))));
    EXPECT_NEAR((*pixel - Eigen::Vector2d(camera.cx, camera.cy)).norm(), expected, 1e-9);
    const auto ray = camera.unproject(*pixel);
    ASSERT_TRUE(ray) << degrees;
    EXPECT_LT((*ray - p).norm(), 1e-12);
    expect_derivatives(camera, p);
  }
  // Further out than the direction opposite to the view there is nothing.
  EXPECT_FALSE(camera.unproject({camera.cx + 1e5, camera.cy}));
}

TEST(Camera, EquidistantFieldEndsWhereTheProfileFolds) {
  // dθ_d/dθ = 1 − 0.6 θ²: folds at θ = 1.29 rad.
  const Camera camera = camera_of(DistortionModel::kEquidistant, {-0.2});
  const double edge = std::sqrt(1 / 0.6);
  EXPECT_TRUE(camera.project({std::sin(edge - 1e-6), 0, std::cos(edge - 1e-6)}));
  EXPECT_FALSE(camera.project({std::sin(edge + 1e-6), 0, std::cos(edge + 1e-6)}));
  EXPECT_FALSE(camera.project({1, 0, -1}));
}

TEST(Camera, NonsenseIntrinsicsGiveNothingInsteadOfNumbers) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const auto model : {DistortionModel::kPlumbBob, DistortionModel::kRationalPolynomial,
                           DistortionModel::kEquidistant}) {
    Camera camera = camera_of(model, {nan});
    EXPECT_FALSE(camera.project({0.1, 0.1, 1}));
    EXPECT_FALSE(camera.unproject({10, 10}));
    camera = camera_of(model, {1e300, -1e300, 1e300, 1e300});
    const auto pixel = camera.project({0.1, 0.1, 1});
    if (pixel) {
      EXPECT_TRUE(pixel->allFinite());
    }
    camera = camera_of(model, {});
    camera.fx = 0;
    EXPECT_FALSE(camera.unproject({10, 10}));
  }
}

TEST(Camera, CheckRefusesImplausibleIntrinsics) {
  const Camera good = camera_of(DistortionModel::kPlumbBob, {-0.1});
  EXPECT_TRUE(check(good).ok());
  const auto refused = [&](auto change) {
    Camera camera = good;
    change(camera);
    return !check(camera).ok();
  };
  EXPECT_TRUE(refused([](Camera& c) { c.width_px = 0; }));
  EXPECT_TRUE(refused([](Camera& c) { c.height_px = -5; }));
  EXPECT_TRUE(refused([](Camera& c) { c.fx = 0; }));
  EXPECT_TRUE(refused([](Camera& c) { c.fy = -1000; }));
  EXPECT_TRUE(refused([](Camera& c) { c.fx = 1.02; }));  // metres or a normalised focal length
  EXPECT_TRUE(refused([](Camera& c) { c.cx = 1e5; }));
  EXPECT_TRUE(refused([](Camera& c) { c.cy = std::numeric_limits<double>::quiet_NaN(); }));
  EXPECT_TRUE(
      refused([](Camera& c) { c.distortion[4] = std::numeric_limits<double>::infinity(); }));
}

}  // namespace
}  // namespace lvcalib
