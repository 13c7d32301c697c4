// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/crop_box.h"

#include <limits>
#include <numbers>

#include <gtest/gtest.h>

namespace lvcalib {
namespace {

CropBox tilted_box() {
  CropBox box;
  box.center_m = {2.0, 1.0, 0.5};
  box.half_size_m = {1.0, 0.1, 0.2};
  box.rotation = Eigen::AngleAxisd(0.5 * std::numbers::pi, Eigen::Vector3d::UnitZ());
  return box;
}

TEST(CropBox, ContainsWhatLiesWithinItsTurnedSides) {
  const CropBox box = tilted_box();  // Its long side now points along y.
  EXPECT_TRUE(box.contains({2.0, 1.9, 0.5}));
  EXPECT_FALSE(box.contains({2.9, 1.0, 0.5}));
  EXPECT_TRUE(box.contains({2.09, 1.0, 0.69}));
  EXPECT_FALSE(box.contains({2.0, 1.0, 0.71}));
}

TEST(CropBox, CroppingKeepsOrderAndEveryField) {
  Cloud cloud;
  cloud.points_m = {{9, 9, 9}, {2.0F, 1.5F, 0.5F}, {2.0F, 0.2F, 0.6F}};
  cloud.intensity = {1, 2, 3};
  cloud.line = {4, 5, 6};
  const Cloud inside = crop(cloud, tilted_box());
  ASSERT_EQ(inside.size(), 2u);
  EXPECT_EQ(inside.intensity, (std::vector<float>{2, 3}));
  EXPECT_EQ(inside.line, (std::vector<std::uint16_t>{5, 6}));
  EXPECT_FALSE(inside.has_time());
}

TEST(CropBox, RefusesNonsense) {
  EXPECT_TRUE(check(tilted_box()).ok());
  CropBox flat = tilted_box();
  flat.half_size_m.y() = 0.0;
  EXPECT_EQ(check(flat).error().kind, ErrorKind::kUsage);
  CropBox nan = tilted_box();
  nan.center_m.x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(check(nan).ok());
  CropBox skewed = tilted_box();
  skewed.rotation.coeffs() *= 1.1;
  EXPECT_FALSE(check(skewed).ok());
}

}  // namespace
}  // namespace lvcalib
