// SPDX-License-Identifier: GPL-3.0-or-later
// Clouds as drivers and tools write them. The expected figures come from a separate script that
// unpacks the files with Python's struct module.
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <numeric>

#include <gtest/gtest.h>

#include "cloud/cloud.h"

namespace lvcalib {
namespace {

std::filesystem::path shared_data() {
  if (const char* folder = std::getenv("LVCALIB_SHARED_DATA")) return folder;
  return std::filesystem::path(LVCALIB_SOURCE_DIR).parent_path() / "shared" / "data";
}

struct Range {
  double low, high;
};

template <class Values>
void expect_range(const Values& values, Range range) {
  ASSERT_FALSE(values.empty());
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  EXPECT_FLOAT_EQ(static_cast<float>(*low), static_cast<float>(range.low));
  EXPECT_FLOAT_EQ(static_cast<float>(*high), static_cast<float>(range.high));
}

void expect_box(const Cloud& cloud, Range x, Range y, Range z) {
  const Range expected[] = {x, y, z};
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<float> values;
    for (const Eigen::Vector3f& point : cloud.points_m) values.push_back(point[axis]);
    expect_range(values, expected[axis]);
  }
}

template <class Values>
double sum(const Values& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

class RealCloud : public testing::Test {
 protected:
  Cloud read(const std::string& name) {
    const auto path = shared_data() / name;
    if (!std::filesystem::exists(path)) return {};
    found_ = true;
    auto cloud = read_cloud(path);
    EXPECT_TRUE(cloud.ok()) << cloud.error().text();
    if (cloud.ok()) {
      EXPECT_TRUE(cloud->warnings.empty()) << cloud->warnings.front().text();
    }
    return cloud.ok() ? *cloud : Cloud{};
  }
  bool found_ = false;
};

#define SKIP_IF_ABSENT(name) \
  if (!found_) GTEST_SKIP() << name << " not found; set LVCALIB_SHARED_DATA to the data folder"

TEST_F(RealCloud, SixtyFourRingsCompressed) {
  const Cloud cloud = read("real/clouds/64ring-binary-compressed.pcd");
  SKIP_IF_ABSENT("64ring-binary-compressed.pcd");
  EXPECT_EQ(cloud.size(), 114535U);
  EXPECT_EQ(cloud.dropped, 0U);
  expect_box(cloud, {-85.130898, 12.153924}, {-6.2769966, 16.174917}, {-5.1832085, 4.602002});
  expect_range(cloud.intensity, {0, 254});
  EXPECT_EQ(sum(cloud.intensity), 12516813.0);
  expect_range(cloud.line, {0, 63});
  EXPECT_EQ(sum(cloud.line), 3614669.0);
  EXPECT_EQ(cloud.time_s.front(), 0.0F);
  EXPECT_NEAR(cloud.time_s.back(), 1642490703.49976 - 1642490703.400143, 1e-6);
  EXPECT_TRUE(std::is_sorted(cloud.time_s.begin(), cloud.time_s.end()));
}

TEST_F(RealCloud, MixedIntegerTypes) {
  const Cloud cloud = read("real/clouds/velodyne-vlp16-mixed-types.pcd");
  SKIP_IF_ABSENT("velodyne-vlp16-mixed-types.pcd");
  EXPECT_EQ(cloud.size(), 14831U);
  expect_box(cloud, {-8.1111813, 2.4826860}, {-12.551226, 8.1163368}, {-0.7078172, 2.2009974});
  expect_range(cloud.intensity, {0, 119});
  EXPECT_EQ(sum(cloud.intensity), 612296.0);
  expect_range(cloud.line, {1, 15});
  EXPECT_EQ(sum(cloud.line), 149166.0);
  // Nanoseconds within a packet of 24 firings of 55.296 µs.
  expect_range(cloud.time_s, {0.0, (1306368 - 2303) * 1e-9});
  EXPECT_NEAR(cloud.time_s.front(), (2384 - 2303) * 1e-9, 1e-12);
}

TEST_F(RealCloud, OrganizedWithPadding) {
  const Cloud cloud = read("real/clouds/ouster-organized-padded.pcd");
  SKIP_IF_ABSENT("ouster-organized-padded.pcd");
  EXPECT_EQ(cloud.size(), 63606U);
  EXPECT_EQ(cloud.dropped, 1930U);
  expect_box(cloud, {-6.7735238, 14.542048}, {-23.563328, 12.266248}, {-2.4282818, 4.0361133});
  expect_range(cloud.intensity, {11, 4657});
  EXPECT_EQ(sum(cloud.intensity), 51363292.0);
  expect_range(cloud.line, {0, 63});
  EXPECT_EQ(sum(cloud.line), 1997198.0);
  EXPECT_FALSE(cloud.has_time());
}

TEST_F(RealCloud, CloudComparePly) {
  const Cloud cloud = read("real/clouds/cloudcompare-scalar-intensity.ply");
  SKIP_IF_ABSENT("cloudcompare-scalar-intensity.ply");
  EXPECT_EQ(cloud.size(), 64685U);
  EXPECT_EQ(cloud.dropped, 5107U);
  expect_box(cloud, {-23.759020, 18.479933}, {-52.001141, 6.5078692}, {-3.0212898, 9.1728048});
  expect_range(cloud.intensity, {0, 128});
  EXPECT_EQ(sum(cloud.intensity), 1969335.0);
}

TEST_F(RealCloud, AsciiSweep) {
  const Cloud cloud = read("real/vlp16-checkerboard/scenes/pose01/cloud.pcd");
  SKIP_IF_ABSENT("pose01/cloud.pcd");
  EXPECT_EQ(cloud.size(), 23969U);
  expect_box(cloud, {-32.083687, 26.071846}, {-11.683913, 5.475043}, {-3.9263854, 4.7761612});
  EXPECT_EQ(sum(cloud.intensity), 860295.0);
  EXPECT_EQ(sum(cloud.line), 195310.0);
}

TEST_F(RealCloud, SimulatedScan) {
  const Cloud cloud = read("simulated/clean-avia/scenes/A/cloud.pcd");
  SKIP_IF_ABSENT("clean-avia/A/cloud.pcd");
  EXPECT_EQ(cloud.size(), 240000U);
  expect_box(cloud, {1.9131105, 5.5356965}, {-3.4115100, 3.4128489}, {-1.2230499, 2.0160527});
  EXPECT_EQ(sum(cloud.intensity), 19290961.0);
  EXPECT_EQ(sum(cloud.line), 600000.0);
  expect_range(cloud.time_s, {0.0, 0.9999958276748657});
}

}  // namespace
}  // namespace lvcalib
