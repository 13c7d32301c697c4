// SPDX-License-Identifier: GPL-3.0-or-later
// What a camera sees of boards, as corners alone.
#pragma once

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "base/random.h"
#include "pipeline/board_images.h"
#include "support/synthetic_observations.h"

namespace lvcalib::test {

inline constexpr double kNoise_px = 0.05;

struct Views {
  double noise_px = kNoise_px;
  int count = 8;
  double tilt_rad = 0.6;
  double nearest_widths = 1.0;  ///< Distance of the nearest board: it covers the image about once.
};

// Boards turned about two axes and spread over the image, as corners with white noise.
inline std::vector<BoardImage> images_of(const Camera& camera, const Views& views,
                                         std::uint64_t seed) {
  Random random(seed);
  const Target target;
  std::vector<BoardImage> out;
  const double view = camera.fx / camera.width_px;
  for (int v = 0; v < views.count; ++v) {
    const double turn = 2.0 * M_PI * v / views.count;
    const double depth = views.nearest_widths * (1.0 + 0.8 * v / views.count) * 1.1 * view;
    const Eigen::Vector3d place(0.3 * depth / view * std::cos(turn),
                                0.15 * depth / view * std::sin(turn), depth);
    const Rigid3 pose = facing_board(
        target, place,
        {views.tilt_rad * std::cos(1.7 * turn), views.tilt_rad * std::sin(1.7 * turn), 0.0});
    BoardImage image;
    image.path = "image" + std::to_string(v) + ".png";
    image.width_px = camera.width_px;
    image.height_px = camera.height_px;
    image.view.emplace();
    for (const TargetTag& tag : target.tags()) {
      const auto at = target.tag_corners_m(tag);
      for (std::size_t k = 0; k < at.size(); ++k) {
        const auto p = camera.project(pose * Eigen::Vector3d(at[k].x(), at[k].y(), 0));
        if (!p || !camera.in_image(*p)) continue;
        const Eigen::Vector2d e(random.normal(), random.normal());
        image.view->corners.push_back(
            {tag.id, static_cast<int>(k), at[k], *p + views.noise_px * e, 0.0});
      }
    }
    EXPECT_GT(image.view->corners.size(), 16U) << v;
    out.push_back(std::move(image));
  }
  return out;
}

inline Camera camera_of(DistortionModel model) {
  Camera camera = test_camera();
  camera.model = model;
  if (model == DistortionModel::kEquidistant) {
    camera.fx = 620.0;
    camera.fy = 618.0;
    camera.distortion << -0.02, 0.008, -0.003, 0.0005, 0, 0, 0, 0;
  }
  return camera;
}

}  // namespace lvcalib::test
