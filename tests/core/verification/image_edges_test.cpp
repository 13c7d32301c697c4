// SPDX-License-Identifier: GPL-3.0-or-later
#include "verification/image_edges.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "base/random.h"

namespace lvcalib {
namespace {

// Dark left of a line through (x0, 60) with an angle, bright right of it, blurred, with noise.
GrayImage step_image(double x0, double angle, double noise) {
  GrayImage image{160, 120, {}};
  Random random(1);
  for (int y = 0; y < image.height_px; ++y) {
    for (int x = 0; x < image.width_px; ++x) {
      const double d = std::cos(angle) * (x - x0) + std::sin(angle) * (y - 60.0);
      image.pixels.push_back(static_cast<float>(
          60.0 + 50.0 * (1.0 + std::erf(d / std::numbers::sqrt2)) + random.normal(0.0, noise)));
    }
  }
  return image;
}

TEST(ImageEdges, StandWhereTheStepIsToFractionsOfAPixel) {
  for (const double angle : {0.0, 0.3, 0.8, 1.5}) {
    const ImageEdges edges(step_image(80.37, angle, 1.0));
    ASSERT_GT(edges.edges().size(), 80U);
    double sum = 0.0;
    for (const ImageEdges::Edge& e : edges.edges()) {
      const double d =
          std::cos(angle) * (e.pixel.x() - 80.37) + std::sin(angle) * (e.pixel.y() - 60.0);
      EXPECT_LT(std::abs(d), 0.8) << angle;
      EXPECT_GT(std::cos(angle) * e.normal.x() + std::sin(angle) * e.normal.y(), 0.9);
      sum += d;
    }
    EXPECT_LT(std::abs(sum / static_cast<double>(edges.edges().size())), 0.1) << angle;
  }
}

TEST(ImageEdges, TheNearestIsOneThatTheScanWouldCross) {
  const ImageEdges edges(step_image(80.0, 0.0, 0.5));
  const auto* across = edges.nearest({60.2, 40.7}, {1.0, 0.0});
  ASSERT_NE(across, nullptr);
  EXPECT_NEAR(across->pixel.x(), 80.0, 0.5);
  EXPECT_NEAR(across->pixel.y(), 40.7, 2.0);
  // Either way counts, and up to some 67°; along the edge nothing is crossed.
  EXPECT_NE(edges.nearest({60.2, 40.7}, {-1.0, 0.4}), nullptr);
  EXPECT_EQ(edges.nearest({60.2, 40.7}, {0.0, 1.0}), nullptr);
  EXPECT_EQ(edges.nearest({-3.0, 40.0}, {1.0, 0.0}), nullptr);
  EXPECT_EQ(edges.nearest({160.0, 40.0}, {1.0, 0.0}), nullptr);
}

TEST(ImageEdges, NoiseAloneHasNextToNone) {
  GrayImage image{160, 120, {}};
  Random random(2);
  for (int i = 0; i < 160 * 120; ++i)
    image.pixels.push_back(static_cast<float>(random.normal(100.0, 5.0)));
  EXPECT_LT(ImageEdges(image).edges().size(), 60U);  // 0.3 % of the pixels.
  EXPECT_TRUE(ImageEdges(GrayImage{160, 120, std::vector<float>(160 * 120, 7.0F)}).edges().empty());
  EXPECT_TRUE(ImageEdges(GrayImage{}).edges().empty());
}

}  // namespace
}  // namespace lvcalib
