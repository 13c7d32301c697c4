// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulation/disturbances/camera.h"

#include <numbers>

#include <gtest/gtest.h>

#include "planted.h"
#include "simulation/image_renderer.h"

namespace lvcalib::simulation {
namespace {

class TrueCamera : public testing::Test {
 protected:
  // Seen − predicted: a pixel shows what the file's camera puts elsewhere.
  [[nodiscard]] Eigen::Vector2d error_px(const PlantedEffects& planted,
                                         const Eigen::Vector2d& seen) const {
    return seen - *camera.project(*planted.camera.unproject(seen));
  }
  SimulationOptions options;
  Camera camera = random_camera(options.image, Random(1));
  Eigen::Vector2d middle{camera.cx, camera.cy};
};

TEST_F(TrueCamera, IntrinsicsMagnifyAndShift) {
  const PlantedEffects planted = plant({{"intrinsics_error", 1000}});
  const auto& noted = planted.details.at("intrinsics_error").at("principal_point_px");
  const Eigen::Vector2d shift(noted[0], noted[1]);
  EXPECT_NEAR(shift.norm(), 1e-3 * camera.fx, 1e-9);
  for (const double x : {-400.0, 0.0, 400.0}) {
    const Eigen::Vector2d seen = middle + Eigen::Vector2d(x, 0.3 * x);
    // One part in a thousand of the distance from the middle, and the shift (times 1.000 to 1.01
    // by the lens).
    const Eigen::Vector2d expected = shift + 1e-3 * (seen - middle);
    EXPECT_LT((error_px(planted, seen) - expected).norm(), 0.12) << x;
  }
}

TEST_F(TrueCamera, ResidualDistortionHasItsValueInTheCorner) {
  const PlantedEffects planted = plant({{"distortion_residual", 1}});
  const auto& noted = planted.details.at("distortion_residual").at("decentring_px");
  const Eigen::Vector2d decentring(noted[0], noted[1]);
  EXPECT_NEAR(decentring.norm(), 0.3, 1e-9);
  const double corner = 0.5 * std::hypot(camera.width_px, camera.height_px);
  const Eigen::Vector2d outwards = Eigen::Vector2d(0.8, 0.6);
  for (const double rho : {0.2, 0.5, 0.8}) {
    const double radial = 0.8 * rho * rho * rho + 0.2 * std::pow(rho, 5);
    const Eigen::Vector2d tangential =
        rho * rho * (decentring + 2.0 * decentring.dot(outwards) * outwards) / 3.0;
    const Eigen::Vector2d predicted = middle + rho * corner * outwards;
    const Eigen::Vector2d expected = radial * outwards + tangential;
    EXPECT_LT((error_px(planted, predicted + expected) - expected).norm(), 1e-3) << rho;
  }
}

TEST_F(TrueCamera, LensFlawIsLocal) {
  const PlantedEffects planted = plant({{"x_lens_flaw", 1}});
  const auto& noted = planted.details.at("x_lens_flaw");
  const Eigen::Vector2d center(noted.at("center_px")[0], noted.at("center_px")[1]);
  const Eigen::Vector2d shift(noted.at("displacement_px")[0], noted.at("displacement_px")[1]);
  EXPECT_NEAR(shift.norm(), 1.0, 1e-9);
  EXPECT_LT((error_px(planted, center + shift) - shift).norm(), 1e-3);
  EXPECT_LT(error_px(planted, center + Eigen::Vector2d(400, 0)).norm(), 0.01);
}

TEST_F(TrueCamera, RollingShutterShiftsLowerRowsToTheRight) {
  const PlantedEffects planted = plant({{"rolling_shutter", 2}});
  const double height = camera.height_px;
  EXPECT_LT(error_px(planted, {camera.cx, 0.0}).norm(), 1e-6);
  EXPECT_NEAR(error_px(planted, middle).x(), 2.0 * camera.cy / height, 0.02);
  EXPECT_NEAR(error_px(planted, {camera.cx, 0.9 * height}).x(), 1.8, 0.15);
  EXPECT_NEAR(error_px(planted, middle).y(), 0.0, 0.02);
}

// A photograph without noise of a board that faces the camera 2 m ahead.
std::vector<double> shoot(const Effects& effects, int& width) {
  SimulationOptions options;
  options.image.width_px = 720;
  options.image.height_px = 450;
  options.image.full_well_e = 1e9;
  options.image.read_noise = 0.0;
  options.effects = effects;
  Camera camera;
  camera.width_px = 720;
  camera.height_px = 450;
  camera.fx = camera.fy = 500.0;
  camera.cx = 359.5;
  camera.cy = 224.5;
  const PlantedEffects planted = plant_effects(options, camera);
  const PrintedBoard board(options.target, planted.board);
  const Room room{{facing_board(2.0, board)}, -Eigen::Vector3d::UnitX()};
  Eigen::Matrix3d swap;
  swap << 0, -1, 0, 0, 0, -1, 1, 0, 0;
  const Rigid3 camera_from_lidar{Eigen::Quaterniond(swap), Eigen::Vector3d::Zero()};
  const SimulatedImage image =
      photograph(options.image, {camera, camera_from_lidar, planted.camera}, room, Random(1), {});
  width = image.width_px;
  return {image.pixels.begin(), image.pixels.end()};
}

// Change of the dark area around the board's middle node, px².
double darkening_px2(const Effects& effects) {
  int width = 0;
  const auto before = shoot({}, width);
  const auto after = shoot(effects, width);
  double sum = 0.0;
  for (int y = 225 - 15; y < 225 + 15; ++y) {
    for (int x = 360 - 15; x < 360 + 15; ++x) {
      // The nearest tag corners are 17.7 px away.
      if (std::hypot(x - 359.5, y - 224.5) > 14.5) continue;
      const auto i = static_cast<std::size_t>(y * width + x);
      sum += before[i] - after[i];
    }
  }
  // White is exposed to 205, black has 7/85 of it.
  return sum / (205.0 * (1.0 - 7.0 / 85.0));
}

// Centroid of the darkness of the board's middle node.
Eigen::Vector2d disc_px(const Effects& effects) {
  int width = 0;
  const auto grey = shoot(effects, width);
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  double weight = 0.0;
  for (int y = 225 - 16; y < 225 + 16; ++y) {
    for (int x = 360 - 16; x < 360 + 16; ++x) {
      if (std::hypot(x - 359.5, y - 224.5) > 15.0) continue;
      const double dark = 205.0 - grey[static_cast<std::size_t>(y * width + x)];
      sum += dark * Eigen::Vector2d(x, y);
      weight += dark;
    }
  }
  return sum / weight;
}

TEST(CameraDisturbance, PhotographsShowIt) {
  EXPECT_LT((disc_px({}) - Eigen::Vector2d(359.5, 224.5)).norm(), 0.01);
  // Half way down the image, half of the shutter's shift.
  EXPECT_LT((disc_px({{"rolling_shutter", 2}}) - Eigen::Vector2d(360.5, 224.5)).norm(), 0.02);
  Camera camera;
  camera.width_px = 720;
  camera.height_px = 450;
  camera.fx = camera.fy = 500.0;
  SimulationOptions options;
  options.effects = {{"intrinsics_error", 2000}};
  const auto details = plant_effects(options, camera).details;
  const auto& shift = details.at("intrinsics_error").at("principal_point_px");
  const Eigen::Vector2d expected(359.5 + shift[0], 224.5 + shift[1]);
  EXPECT_LT((disc_px(options.effects) - expected).norm(), 0.02);
}

TEST(CameraDisturbance, CameraSeesInkGain) {
  // 2 mm are 0.5 px at 2 m: π(11.75² − 11.25²) = 36.13 px²; eight rim points give 95 % of it.
  EXPECT_NEAR(darkening_px2({{"ink_gain", 2.0}}), 35.2, 1.2);
}

}  // namespace
}  // namespace lvcalib::simulation
