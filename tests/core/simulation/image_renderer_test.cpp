// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulation/image_renderer.h"

#include <cmath>

#include <gtest/gtest.h>

#include "base/statistics.h"
#include "simulation/board_placement.h"
#include "simulation/rig.h"
#include "simulation/room_builder.h"

namespace lvcalib::simulation {
namespace {

class Photograph : public testing::Test {
 protected:
  Photograph() {
    options.image.width_px = 720;
    options.image.height_px = 450;
    options.image.full_well_e = 1e9;
    options.image.read_noise = 0.0;
    options.placement.max_distance_m = 2.3;
  }

  void take(std::uint64_t seed) {
    camera = random_camera(options.image, Random(seed));
    const Rigid3 camera_from_lidar = random_mount(Random(seed, 2));
    const ScanPattern pattern(options.lidar, Random(seed));
    const Rigid3 lidar_from_board =
        *place_board(options, camera, camera_from_lidar, pattern, 1, Random(seed, 5));
    camera_from_board = camera_from_lidar * lidar_from_board;
    const Room room = build_room(options, board, lidar_from_board,
                                 camera_from_lidar.inverse().translation, Random(seed, 6));
    image = photograph(options.image, {camera, camera_from_lidar}, room, Random(seed, 7), {});
    ASSERT_EQ(image.pixels.size(), 720U * 450U);
  }

  [[nodiscard]] Eigen::Vector2d pixel_of(const Eigen::Vector2d& on_board) const {
    return *camera.project(camera_from_board * Eigen::Vector3d(on_board.x(), on_board.y(), 0.0));
  }
  [[nodiscard]] Eigen::Vector2d board_point(const Eigen::Vector2d& pixel) const {
    const Rigid3 board_from_camera = camera_from_board.inverse();
    const Eigen::Vector3d ray = board_from_camera.rotation * *camera.unproject(pixel);
    const Eigen::Vector3d& eye = board_from_camera.translation;
    return (eye - eye.z() / ray.z() * ray).head<2>();
  }
  [[nodiscard]] double grey(int x, int y) const {
    return image.pixels[static_cast<std::size_t>(y * image.width_px + x)];
  }
  [[nodiscard]] double grey(const Eigen::Vector2d& pixel) const {
    return grey(static_cast<int>(std::lround(pixel.x())), static_cast<int>(std::lround(pixel.y())));
  }
  // Loss of light towards the corners, at most 15 %.
  [[nodiscard]] double vignetting(const Eigen::Vector2d& pixel) const {
    const double dx = pixel.x() - camera.cx;
    const double dy = pixel.y() - camera.cy;
    return 1.0 - 0.15 * (dx * dx + dy * dy) / (0.25 * (720.0 * 720.0 + 450.0 * 450.0));
  }

  SimulationOptions options;
  PrintedBoard board{options.target};
  Camera camera;
  Rigid3 camera_from_board;
  SimulatedImage image;
};

TEST_F(Photograph, DiscsAreBlackAndGapsWhiteWhereTheTruthSays) {
  take(1);
  const double black = 205.0 * PrintedBoard::kBlack / PrintedBoard::kWhite;
  for (const TargetNode& node : options.target.nodes()) {
    const Eigen::Vector2d center = pixel_of(node.center_m);
    EXPECT_NEAR(grey(center), black * vignetting(center), 1.0);
    const Eigen::Vector2d beside = pixel_of(node.center_m + Eigen::Vector2d(0.0, 0.085));
    EXPECT_NEAR(grey(beside), 205.0 * vignetting(beside), 1.0);
  }
}

TEST_F(Photograph, DiscsLieWhereTheyProjectToASmallPartOfAPixel) {
  for (std::uint64_t seed = 2; seed < 5; ++seed) {
    take(seed);
    for (const TargetNode& node : options.target.nodes()) {
      // Centroid of the projected disc: its points, weighted with the local magnification.
      Eigen::Vector2d expected = Eigen::Vector2d::Zero();
      double weight_sum = 0.0;
      const double r = options.target.circle_radius_m;
      for (double x = -r; x <= r; x += r / 40) {
        for (double y = -r; y <= r; y += r / 40) {
          if (x * x + y * y > r * r) continue;
          const Eigen::Vector2d p = node.center_m + Eigen::Vector2d(x, y);
          const Eigen::Vector2d pixel = pixel_of(p);
          const Eigen::Vector2d dx = pixel_of(p + Eigen::Vector2d(1e-4, 0)) - pixel;
          const Eigen::Vector2d dy = pixel_of(p + Eigen::Vector2d(0, 1e-4)) - pixel;
          const double weight = std::abs(dx.x() * dy.y() - dx.y() * dy.x());
          expected += weight * pixel;
          weight_sum += weight;
        }
      }
      expected /= weight_sum;
      // Centroid of the darkness up to the white gap between the disc and the tags.
      const double reach =
          0.07 * camera.fx / (camera_from_board * Eigen::Vector3d(0, 0, 0)).z() + 5;
      Eigen::Vector2d found = Eigen::Vector2d::Zero();
      double dark_sum = 0.0;
      for (int y = static_cast<int>(expected.y() - reach); y <= expected.y() + reach; ++y) {
        for (int x = static_cast<int>(expected.x() - reach); x <= expected.x() + reach; ++x) {
          const Eigen::Vector2d pixel(x, y);
          if ((board_point(pixel) - node.center_m).norm() > 0.058) continue;
          const double dark = 1.0 - grey(x, y) / (205.0 * vignetting(pixel));
          if (dark < 0.01) continue;
          found += dark * pixel;
          dark_sum += dark;
        }
      }
      found /= dark_sum;
      EXPECT_LT((found - expected).norm(), 0.02) << "seed " << seed << " node " << node.id;
    }
  }
}

TEST_F(Photograph, TagsAreUprightWithTheirIds) {
  take(6);
  const double bit = options.target.tag_bit_m();
  for (const TargetTag& tag : options.target.tags()) {
    const TagPattern* pattern = tag_pattern("tag36h11", tag.id);
    int wrong = 0;
    for (int row = 0; row < 6; ++row) {
      for (int column = 0; column < 6; ++column) {
        const Eigen::Vector2d p = tag.center_m + bit * Eigen::Vector2d(column - 2.5, 2.5 - row);
        if ((grey(pixel_of(p)) > 100.0) != pattern->at(row, column)) ++wrong;
      }
    }
    EXPECT_EQ(wrong, 0) << tag.id;
  }
}

TEST_F(Photograph, NoiseIsShotAndReadNoise) {
  take(7);
  const SimulatedImage clean = image;
  options.image.full_well_e = 2000.0;
  options.image.read_noise = 1.0;
  take(7);
  std::vector<double> bright;
  for (std::size_t i = 0; i < clean.pixels.size(); ++i) {
    if (clean.pixels[i] < 180 || clean.pixels[i] > 200) continue;
    bright.push_back(static_cast<double>(image.pixels[i]) - clean.pixels[i]);
  }
  ASSERT_GT(bright.size(), 1000U);
  EXPECT_NEAR(rms(bright), std::sqrt(190.0 * 255.0 / 2000.0 + 1.0), 0.2);
}

TEST_F(Photograph, StopsWhenAsked) {
  std::stop_source stop;
  stop.request_stop();
  const Room room;
  EXPECT_TRUE(photograph(options.image, {random_camera(options.image, Random(1)), Rigid3{}}, room,
                         Random(1), stop.get_token())
                  .pixels.empty());
}

}  // namespace
}  // namespace lvcalib::simulation
