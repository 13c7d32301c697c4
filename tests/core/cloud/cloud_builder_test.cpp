// SPDX-License-Identifier: GPL-3.0-or-later
#include "cloud/cloud_builder.h"

#include <cmath>
#include <limits>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace lvcalib {
namespace {

TEST(TimeUnit, FollowsTypeSpanAndEpoch) {
  const struct {
    bool is_integer;
    double first, span, expected;
    const char* what;
  } cases[] = {
      {false, 0.0, 0.1, 1.0, "seconds from the start of the scan"},
      {false, 1642490703.4, 0.1, 1.0, "seconds since 1970"},
      {false, 12.0, 45.0, 1.0, "a long accumulation"},
      {false, 1.7e18, 1e8, 1e-9, "Livox: nanoseconds since 1970 as double"},
      {false, 0.0, 1e8, 1e-9, "nanoseconds as float"},
      {false, 0.0, 100.0, 1e-3, "milliseconds as float"},
      {true, 0.0, 99'900'000.0, 1e-9, "Ouster: 32-bit nanoseconds"},
      {true, 2303.0, 1'304'065.0, 1e-9, "Velodyne: one packet in nanoseconds"},
      {true, 4e12, 1e8, 1e-9, "Ouster without clock: nanoseconds since power-on"},
      {true, 0.0, 100'000.0, 1e-6, "microseconds"},
      {true, 1.7e15, 100'000.0, 1e-6, "microseconds since 1970"},
      {true, 1.7e12, 100.0, 1e-3, "milliseconds since 1970"},
      {true, 0.0, 100.0, 1e-3, "milliseconds"},
      {true, 1.7e18, 3e10, 1e-9, "thirty seconds in nanoseconds since 1970"},
  };
  for (const auto& c : cases) {
    EXPECT_EQ(time_unit_s(c.is_integer, c.first, c.span), c.expected) << c.what;
  }
}

struct Point {
  float x, y, z, intensity;
  double time;
};

BlockLayout layout_of_points() {
  BlockLayout layout;
  for (std::size_t role = kX; role <= kIntensity; ++role) {
    layout.fields[role] = FieldLayout{ScalarType::kF32, 4 * role, sizeof(Point)};
  }
  layout.fields[kTime] = FieldLayout{ScalarType::kF64, 16, sizeof(Point)};
  return layout;
}

Result<Cloud> build(const std::vector<Point>& points) {
  CloudBuilder builder(layout_of_points(), false, points.size());
  builder.append(reinterpret_cast<const char*>(points.data()), points.size());
  return builder.finish("built");
}

TEST(CloudBuilder, KeepsOrderAcrossBlocksWithGaps) {
  std::vector<Point> points;
  for (int i = 0; i < 10'000; ++i) {
    const auto value = static_cast<float>(i);
    points.push_back({i % 7 == 3 ? NAN : value, 1, 2, value, 100.0 + 1e-5 * i});
  }
  const auto cloud = build(points);
  ASSERT_TRUE(cloud.ok());
  EXPECT_EQ(cloud->size() + cloud->dropped, points.size());
  EXPECT_EQ(cloud->dropped, 1429U);  // 3, 10, …, 9999
  ASSERT_EQ(cloud->intensity.size(), cloud->size());
  ASSERT_EQ(cloud->time_s.size(), cloud->size());
  for (std::size_t k = 0; k < cloud->size(); ++k) {
    ASSERT_EQ(cloud->points_m[k].x(), cloud->intensity[k]);
    ASSERT_NEAR(cloud->time_s[k], 1e-5 * static_cast<double>(cloud->intensity[k]), 1e-7);
  }
}

TEST(CloudBuilder, ReturnsThatEndLongBeforeTheFileAreToldOf) {
  const auto points = [](int returns, int missing_between, int tail) {
    std::vector<Point> out;
    for (int i = 0; i < returns; ++i) {
      out.push_back({1, 2, 3, 4, 1e-4 * i});
      if (i > 0 && i <= missing_between) out.push_back({NAN, NAN, NAN, 0, 0});
    }
    for (int i = 0; i < tail; ++i) out.push_back({0, 0, 0, 0, 0});
    return out;
  };
  const auto cut = build(points(5000, 1000, 3000));
  ASSERT_TRUE(cut.ok());
  ASSERT_EQ(cut->warnings.size(), 1U);
  EXPECT_THAT(cut->warnings[0].text(), testing::HasSubstr("from point 6001 of 9000 on"));
  // As the LiDAR misses elsewhere, and too few to matter.
  EXPECT_TRUE(build(points(5000, 1000, 900))->warnings.empty());
  EXPECT_TRUE(build(points(5000, 0, 500))->warnings.empty());
}

TEST(CloudBuilder, WholeLinesWithoutAReturnLookIntoTheSky) {
  // Four lines of 3000 columns, of which the last two see nothing; or the last one and a half.
  const auto warnings = [](std::size_t returns) {
    std::vector<Point> points(12'000, Point{0, 0, 0, 0, 0});
    for (std::size_t i = 0; i < returns; ++i) points[i] = {1, 2, 3, 4, 1e-4};
    CloudBuilder builder(layout_of_points(), false, points.size());
    builder.append(reinterpret_cast<const char*>(points.data()), points.size());
    return builder.finish("built", 4)->warnings.size();
  };
  EXPECT_EQ(warnings(6000), 0U);
  EXPECT_EQ(warnings(7500), 1U);
}

TEST(CloudBuilder, APartOfZeroBytesIsToldOf) {
  const auto warnings = [](std::size_t first, std::size_t count, double time) {
    std::vector<Point> points(20'000, Point{1, 2, 3, 4, 1e-4});
    std::fill_n(points.begin() + static_cast<std::ptrdiff_t>(first), count,
                Point{0, 0, 0, 0, time});
    return build(points)->warnings;
  };
  const auto first_half = warnings(0, 10'000, 0.0);
  ASSERT_EQ(first_half.size(), 1U);
  EXPECT_THAT(first_half[0].text(),
              testing::HasSubstr("points 1 to 8192 of 20000 are nothing but"));
  EXPECT_EQ(warnings(5000, 10'000, 0.0).size(), 1U);
  // Beams that met nothing have their time; few are no loss.
  EXPECT_TRUE(warnings(5000, 10'000, 1e-4).empty());
  EXPECT_TRUE(warnings(5000, 1500, 0.0).empty());
}

TEST(CloudBuilder, TimesStartAtTheEarliestPoint) {
  const auto cloud = build({{1, 0, 0, 1, 5.5}, {2, 0, 0, 2, 5.25}, {3, 0, 0, 3, 6.0}});
  ASSERT_TRUE(cloud.ok());
  EXPECT_THAT(cloud->time_s, testing::ElementsAre(0.25F, 0.0F, 0.75F));
}

TEST(CloudBuilder, DropsPointsWithoutFiniteIntensityOrTime) {
  const auto cloud =
      build({{1, 0, 0, NAN, 1.0}, {2, 0, 0, 2, NAN}, {3, 0, 0, 3, 3.0}, {4, 0, 0, 4, 3.5}});
  ASSERT_TRUE(cloud.ok());
  ASSERT_EQ(cloud->size(), 2U);
  EXPECT_EQ(cloud->dropped, 2U);
  EXPECT_EQ(cloud->points_m[0].x(), 3.0F);
  EXPECT_THAT(cloud->intensity, testing::ElementsAre(3, 4));
  EXPECT_THAT(cloud->time_s, testing::ElementsAre(0.0F, 0.5F));
}

TEST(CloudBuilder, AFieldThatIsNowhereFiniteCountsAsMissing) {
  const auto cloud = build({{1, 0, 0, NAN, NAN}, {2, 0, 0, NAN, INFINITY}});
  ASSERT_TRUE(cloud.ok());
  EXPECT_EQ(cloud->size(), 2U);
  EXPECT_FALSE(cloud->has_intensity());
  EXPECT_FALSE(cloud->has_time());
}

}  // namespace
}  // namespace lvcalib
