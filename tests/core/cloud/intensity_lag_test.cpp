// SPDX-License-Identifier: GPL-3.0-or-later
#include "cloud/intensity_lag.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace lvcalib {
namespace {

using ::testing::Contains;
using ::testing::IsEmpty;

// A wall with stripes 0.3 m wide, passed over by a scan that never repeats itself, with noise.
Cloud striped_wall(int count) {
  Cloud cloud;
  for (int k = 0; k < count; ++k) {
    const float y = std::sin(0.0131F * static_cast<float>(k));
    const float z = std::sin(0.0071F * static_cast<float>(k));
    cloud.points_m.emplace_back(3.0F, y, z);
    const bool white = std::fmod(y + z + 3.0F, 0.6F) < 0.3F;
    cloud.intensity.push_back((white ? 90.0F : 20.0F) + static_cast<float>(k * 7919 % 13));
  }
  return cloud;
}

TEST(IntensityLag, OfIntensitiesThatComeLateOrEarlyIsFound) {
  Cloud cloud = striped_wall(40'000);
  EXPECT_THAT(intensity_lags(cloud), IsEmpty());
  const std::vector<float> right = cloud.intensity;
  std::rotate(cloud.intensity.begin(), cloud.intensity.end() - 300, cloud.intensity.end());
  EXPECT_THAT(intensity_lags(cloud), Contains(300));
  cloud.intensity = right;
  std::rotate(cloud.intensity.begin(), cloud.intensity.begin() + 96, cloud.intensity.end());
  EXPECT_THAT(intensity_lags(cloud), Contains(-96));
}

TEST(IntensityLag, IsTakenBack) {
  Cloud cloud = striped_wall(5'000);
  const std::vector<float> right = cloud.intensity;
  std::rotate(cloud.intensity.begin(), cloud.intensity.end() - 300, cloud.intensity.end());
  const Cloud back = without_intensity_lag(cloud, 300);
  EXPECT_TRUE(std::equal(right.begin(), right.end() - 300, back.intensity.begin()));
  EXPECT_EQ(back.intensity.back(), cloud.intensity.back());
  EXPECT_EQ(without_intensity_lag(cloud, -10).intensity.front(), cloud.intensity.front());
}

TEST(IntensityLag, IsNotSoughtWhereNothingTells) {
  EXPECT_THAT(intensity_lags({}), IsEmpty());
  Cloud cloud = striped_wall(1'500);  // No two shifts of it are a thousand points apart.
  EXPECT_THAT(intensity_lags(cloud), IsEmpty());
  cloud = striped_wall(40'000);
  cloud.points_m.assign(cloud.size(),
                        Eigen::Vector3f::Constant(std::numeric_limits<float>::quiet_NaN()));
  EXPECT_THAT(intensity_lags(cloud), IsEmpty());
  cloud = striped_wall(40'000);
  cloud.intensity.assign(cloud.size(), std::numeric_limits<float>::quiet_NaN());
  EXPECT_THAT(intensity_lags(cloud), IsEmpty());
  cloud.intensity.assign(cloud.size(), 7.0F);
  EXPECT_THAT(intensity_lags(cloud), IsEmpty());
  cloud.intensity.clear();
  EXPECT_THAT(intensity_lags(cloud), IsEmpty());
  EXPECT_TRUE(without_intensity_lag(cloud, 3).intensity.empty());
}

}  // namespace
}  // namespace lvcalib
