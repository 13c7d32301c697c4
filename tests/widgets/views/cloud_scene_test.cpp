// SPDX-License-Identifier: GPL-3.0-or-later
#include "views/cloud_scene.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include <gtest/gtest.h>

#include "base/random.h"
#include "support/synthetic_observations.h"

namespace lvcalib::widgets::cloud_scene_test {
namespace {

std::shared_ptr<Cloud> make_cloud(std::size_t points) {
  Random random(1);
  auto cloud = std::make_shared<Cloud>();
  for (std::size_t i = 0; i < points; ++i) {
    const auto x = static_cast<float>(random.uniform(2.0, 6.0));
    const auto y = static_cast<float>(random.uniform(-2.0, 2.0));
    const auto z = static_cast<float>(random.uniform(-1.0, 2.0));
    cloud->points_m.push_back({x, y, z});
    cloud->intensity.push_back(static_cast<float>(i % 150));
  }
  return cloud;
}

TEST(CloudScene, EveryPointOnceAndEveryBeginningIsFair) {
  CloudSceneInput input;
  const std::size_t n = 10'007;
  auto cloud = make_cloud(n);
  input.full = cloud;
  const auto scene = build_cloud_scene(input, {});
  ASSERT_EQ(scene->size(), n);
  EXPECT_EQ(std::set<std::uint32_t>(scene->order.begin(), scene->order.end()).size(), n);
  // A tenth of the order covers each tenth of the scan with about a tenth of its points.
  std::array<int, 10> counts{};
  for (std::size_t k = 0; k < n / 10; ++k) ++counts[10 * scene->order[k] / n];
  for (const int count : counts) EXPECT_NEAR(count, 100, 6);
  for (std::size_t k = 0; k < n; ++k) {
    EXPECT_EQ(scene->xyz_m[3 * k], cloud->points_m[scene->order[k]].x());
  }
}

TEST(CloudScene, LineTimeAndAChosenRange) {
  CloudSceneInput input;
  auto cloud = make_cloud(1000);
  input.full = cloud;
  input.color = CloudColor::kLine;
  EXPECT_TRUE(build_cloud_scene(input, {})->notice.contains("no line numbers"));
  input.color = CloudColor::kTime;
  EXPECT_TRUE(build_cloud_scene(input, {})->notice.contains("no times"));
  for (std::size_t i = 0; i < 1000; ++i) {
    cloud->line.push_back(static_cast<decltype(cloud->line)::value_type>(i % 16));
    cloud->time_s.push_back(1e-4F * static_cast<float>(i));
  }
  auto scene = build_cloud_scene(input, {});
  EXPECT_TRUE(scene->notice.isEmpty());
  EXPECT_NEAR(scene->scale.high, 98.0, 1.5) << "milliseconds";
  input.color = CloudColor::kLine;
  input.range = {3.0, 5.0};
  scene = build_cloud_scene(input, {});
  EXPECT_EQ(scene->scale.low, 3.0);
  EXPECT_EQ(scene->scale.high, 5.0);
  EXPECT_NEAR(scene->whole.high, 15.0, 0.5);
  EXPECT_EQ(std::accumulate(scene->histogram.begin(), scene->histogram.end(), 0), 1000);
}

TEST(CloudScene, ColoursFollowTheQuantity) {
  CloudSceneInput input;
  auto cloud = make_cloud(5000);
  input.full = cloud;
  for (const CloudColor color : {CloudColor::kIntensity, CloudColor::kHeight, CloudColor::kRange}) {
    input.color = color;
    const auto scene = build_cloud_scene(input, {});
    ASSERT_TRUE(scene->notice.isEmpty());
    for (std::size_t k = 0; k < scene->size(); k += 97) {
      const std::uint32_t i = scene->order[k];
      const double value = color == CloudColor::kIntensity ? cloud->intensity[i]
                           : color == CloudColor::kHeight  ? cloud->points_m[i].z()
                                                           : cloud->points_m[i].norm();
      const QRgb wanted = scene->scale.color(value);
      EXPECT_EQ(qRed(wanted), scene->rgb[3 * k]);
      EXPECT_EQ(qBlue(wanted), scene->rgb[3 * k + 2]);
    }
  }
}

TEST(CloudScene, CropShowsWhatIsInTheBox) {
  CloudSceneInput input;
  auto cloud = make_cloud(5000);
  input.full = cloud;
  input.filter = CloudFilter::kCrop;
  CropBox box;
  box.center_m = {4, 0, 0};
  box.half_size_m = {0.5, 0.4, 0.3};
  input.crop = box;
  const auto scene = build_cloud_scene(input, {});
  const auto inside =
      std::count_if(cloud->points_m.begin(), cloud->points_m.end(),
                    [&](const auto& p) { return box.contains(p.template cast<double>()); });
  EXPECT_EQ(static_cast<long>(scene->size()), inside);
  EXPECT_GT(inside, 10);
  EXPECT_TRUE((scene->high_m - scene->low_m).x() <= 1.0);
}

TEST(CloudScene, CameraColoursAreThoseOfThePixels) {
  CloudSceneInput input;
  auto cloud = make_cloud(20'000);
  input.full = cloud;
  input.camera = lvcalib::test::test_camera();
  input.camera_from_lidar = lvcalib::test::test_extrinsic();
  input.color = CloudColor::kCameraColor;
  input.image = QImage(input.camera.width_px, input.camera.height_px, QImage::Format_RGB32);
  input.image.fill(qRgb(200, 10, 10));
  for (int y = 0; y < input.image.height(); ++y) {
    for (int x = input.image.width() / 2; x < input.image.width(); ++x) {
      input.image.setPixel(x, y, qRgb(10, 200, 10));
    }
  }
  const auto scene = build_cloud_scene(input, {});
  EXPECT_FALSE(scene->has_scale);
  int red = 0;
  int green = 0;
  for (std::size_t k = 0; k < scene->size(); ++k) {
    const auto pixel = scene->pixels[scene->order[k]];
    if (!std::isfinite(pixel.x())) continue;
    const bool right = std::lround(pixel.x()) >= input.image.width() / 2;
    (right ? green : red) += 1;
    ASSERT_EQ(scene->rgb[3 * k], right ? 10 : 200);
  }
  EXPECT_GT(red, 100);
  EXPECT_GT(green, 100);
}

// A board across the x axis, of whose returns those on its left half lie 4 mm too far, all
// scattered by far more.
TEST(CloudScene, ResidualsAreMeansOverTheBoard) {
  Rigid3 pose;
  pose.translation = Eigen::Vector3d(3.0, 0.0, 0.0);
  // The print faces the sensor.
  pose.rotation =
      Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), -Eigen::Vector3d::UnitX());
  Target target;
  const BoardOutline outline = target.outline();
  Random random(3);
  auto cloud = std::make_shared<Cloud>();
  std::vector<SurfaceSample> samples;
  for (int k = 0; k < 40'000; ++k) {
    const Eigen::Vector2d at =
        outline.lower_left_m +
        outline.size_m().cwiseProduct(Eigen::Vector2d(random.uniform(0, 1), random.uniform(0, 1)));
    const double off = (at.x() < outline.center_m().x() ? 4e-3 : 0.0) + 0.02 * random.normal();
    const Eigen::Vector3d p = pose * Eigen::Vector3d(at.x(), at.y(), 0.0);
    cloud->points_m.push_back(((1.0 + off / p.norm()) * p).cast<float>());
    samples.push_back({at, off});
  }
  cloud->points_m.push_back({5.0F, 0.0F, 0.0F});  // The wall behind it.
  CloudSceneInput input;
  input.full = cloud;
  input.target = target;
  input.color = CloudColor::kResidual;
  input.surface = [&] {
    return BoardSurface{BoardSurface::Against::kBase, pose, {outline, samples, 0.05}};
  };
  const auto scene = build_cloud_scene(input, {});
  EXPECT_TRUE(scene->notice.isEmpty());
  EXPECT_TRUE(scene->quantity.contains("base model")) << scene->quantity.toStdString();
  EXPECT_TRUE(scene->quantity.contains("50 mm"));
  // Single returns reach 60 mm; what is shown are millimetres.
  EXPECT_LT(scene->whole.high, 10.0);
  EXPECT_EQ(scene->scale.map, ColorMap::kDiverging);
  const BoardSurface surface = *input.surface();
  int left_red = 0;
  int left = 0;
  for (std::size_t k = 0; k < scene->size(); ++k) {
    const std::uint32_t i = scene->order[k];
    const QRgb shown = qRgb(scene->rgb[3 * k], scene->rgb[3 * k + 1], scene->rgb[3 * k + 2]);
    if (i == cloud->size() - 1) {
      EXPECT_EQ(shown, scene->scale.color(NAN)) << "not of the board";
      continue;
    }
    // Not the point's own residual: that of its place.
    const auto mean = surface.residuals.mean_m(samples[i].board_m);
    ASSERT_TRUE(mean);
    if (std::abs(samples[i].residual_m - *mean) > 0.02 && *mean > 2e-3) {
      EXPECT_GT(qRed(shown), qBlue(shown));
    }
    if (samples[i].board_m.x() > outline.center_m().x() - 0.05) continue;
    ++left;
    left_red += qRed(shown) > qBlue(shown) ? 1 : 0;
  }
  EXPECT_GT(left, 10'000);
  EXPECT_GT(left_red, 0.95 * left);
}

TEST(CloudScene, SaysWhatIsMissing) {
  CloudSceneInput input;
  EXPECT_FALSE(build_cloud_scene(input, {})->notice.isEmpty());
  auto cloud = make_cloud(100);
  cloud->intensity.clear();
  input.full = cloud;
  const auto scene = build_cloud_scene(input, {});
  EXPECT_FALSE(scene->notice.isEmpty());
  EXPECT_EQ(scene->size(), 100U);
  input.color = CloudColor::kResidual;
  EXPECT_FALSE(build_cloud_scene(input, {})->notice.isEmpty());
  input.color = CloudColor::kCameraColor;
  EXPECT_FALSE(build_cloud_scene(input, {})->notice.isEmpty());
  input.filter = CloudFilter::kBoundary;
  EXPECT_FALSE(build_cloud_scene(input, {})->notice.isEmpty());
}

TEST(CloudScene, AStoppedBuildGivesNothing) {
  std::stop_source source;
  source.request_stop();
  CloudSceneInput input;
  input.full = make_cloud(100);
  EXPECT_EQ(build_cloud_scene(input, source.get_token()), nullptr);
}

}  // namespace
}  // namespace lvcalib::widgets::cloud_scene_test
