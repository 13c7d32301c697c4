// SPDX-License-Identifier: GPL-3.0-or-later
// What PCL writes, our reader reads; what we write, PCL reads.
#include <cmath>
#include <filesystem>
#include <limits>

#include <gtest/gtest.h>
#include <pcl/io/pcd_io.h>
#include <pcl/io/ply_io.h>
#include <pcl/point_types.h>
#include <unistd.h>

#include "base/random.h"
#include "cloud/cloud.h"

namespace lvcalib {
namespace {
namespace fs = std::filesystem;

using PclCloud = pcl::PointCloud<pcl::PointXYZI>;

PclCloud organized_cloud() {
  Random random(3);
  PclCloud cloud(40, 25);
  for (auto& point : cloud) {
    point.x = static_cast<float>(random.normal(0, 10));
    point.y = static_cast<float>(random.normal(0, 10));
    point.z = static_cast<float>(random.normal(0, 10));
    point.intensity = static_cast<float>(random.uniform(0, 255));
  }
  for (const std::size_t i : {0U, 17U, 999U}) {
    cloud[i].x = cloud[i].y = cloud[i].z = std::numeric_limits<float>::quiet_NaN();
  }
  cloud.is_dense = false;
  return cloud;
}

class PclInterop : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("lvcalib_pcl_interop_" + std::to_string(::getpid()));
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  void expect_same(const fs::path& path, const PclCloud& expected, std::size_t dropped = 3,
                   double relative = 0.0) {
    const auto expect_near = [relative](float found, float wanted) {
      EXPECT_NEAR(found, wanted, relative * std::abs(wanted));
    };
    const auto cloud = read_cloud(path);
    ASSERT_TRUE(cloud.ok()) << cloud.error().text();
    EXPECT_EQ(cloud->dropped, dropped);
    ASSERT_EQ(cloud->size() + 3, expected.size());
    ASSERT_EQ(cloud->intensity.size(), cloud->size());
    std::size_t k = 0;
    for (const auto& point : expected) {
      if (!std::isfinite(point.x)) continue;
      expect_near(cloud->points_m[k].x(), point.x);
      expect_near(cloud->points_m[k].y(), point.y);
      expect_near(cloud->points_m[k].z(), point.z);
      expect_near(cloud->intensity[k], point.intensity);
      ++k;
    }
  }
  fs::path folder_;
};

TEST_F(PclInterop, AllPcdFormats) {
  const PclCloud cloud = organized_cloud();
  pcl::PCDWriter writer;
  const std::string ascii = folder_ / "ascii.pcd";
  const std::string binary = folder_ / "binary.pcd";
  const std::string compressed = folder_ / "compressed.pcd";
  ASSERT_EQ(writer.writeASCII(ascii, cloud, 9), 0);
  ASSERT_EQ(writer.writeBinary(binary, cloud), 0);
  ASSERT_EQ(writer.writeBinaryCompressed(compressed, cloud), 0);
  expect_same(ascii, cloud);
  expect_same(binary, cloud);
  expect_same(compressed, cloud);
}

TEST_F(PclInterop, PcdFromTheMessageTypeWithItsPaddingFields) {
  const PclCloud cloud = organized_cloud();
  pcl::PCLPointCloud2 blob;
  pcl::toPCLPointCloud2(cloud, blob);
  pcl::PCDWriter writer;
  const Eigen::Vector4f origin = Eigen::Vector4f::Zero();
  const std::string binary = folder_ / "binary.pcd";
  const std::string compressed = folder_ / "compressed.pcd";
  ASSERT_EQ(writer.writeBinary(binary, blob, origin, Eigen::Quaternionf::Identity()), 0);
  ASSERT_EQ(writer.writeBinaryCompressed(compressed, blob, origin, Eigen::Quaternionf::Identity()),
            0);
  expect_same(binary, cloud);
  expect_same(compressed, cloud);
}

TEST_F(PclInterop, PlyInBothFormats) {
  const PclCloud cloud = organized_cloud();
  const std::string ascii = folder_ / "ascii.ply";
  const std::string binary = folder_ / "binary.ply";
  pcl::PLYWriter writer;
  ASSERT_EQ(writer.write(ascii, cloud, false, false), 0);
  ASSERT_EQ(writer.write(binary, cloud, true, false), 0);
  // PCL writes only the valid points, and a range grid after them.
  // Its text has six digits.
  expect_same(ascii, cloud, 0, 1e-5);
  expect_same(binary, cloud, 0);
}

TEST_F(PclInterop, PclReadsWhatWeWrite) {
  Cloud cloud;
  for (int i = 1; i < 100; ++i) {
    const auto v = static_cast<float>(i);
    cloud.points_m.emplace_back(v, -v, 0.5F * v);
    cloud.intensity.push_back(2 * v);
    cloud.time_s.push_back(v * 1e-3F);
    cloud.line.push_back(static_cast<std::uint16_t>(i % 6));
  }
  const std::string path = folder_ / "ours.pcd";
  ASSERT_TRUE(write_pcd(path, cloud).ok());
  PclCloud back;
  ASSERT_EQ(pcl::io::loadPCDFile(path, back), 0);
  ASSERT_EQ(back.size(), cloud.size());
  for (std::size_t i = 0; i < back.size(); ++i) {
    EXPECT_EQ(back[i].getVector3fMap(), cloud.points_m[i]);
    EXPECT_EQ(back[i].intensity, cloud.intensity[i]);
  }
}

}  // namespace
}  // namespace lvcalib
