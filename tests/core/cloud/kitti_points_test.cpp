// SPDX-License-Identifier: GPL-3.0-or-later
#include "cloud/kitti_points.h"

#include <cstring>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/file_io.h"
#include "support/temporary_folder.h"

namespace lvcalib {
namespace {

std::string bytes_of(const std::vector<float>& values) {
  std::string out(values.size() * sizeof(float), '\0');
  std::memcpy(out.data(), values.data(), out.size());
  return out;
}

TEST(KittiPoints, ReadsPointsWithReflectance) {
  const test::TemporaryFolder folder;
  const auto path = folder.path() / "0000000000.bin";
  ASSERT_TRUE(write_file_atomically(
                  path, bytes_of({1.5F, -2.0F, 0.25F, 0.5F, 0, 0, 0, 0, 30.0F, 4.0F, -1.0F, 0.9F}))
                  .ok());
  const auto cloud = read_kitti_points(path);
  ASSERT_TRUE(cloud.ok()) << cloud.error().text();
  ASSERT_EQ(cloud->size(), 2U) << "a point at the origin is no return";
  EXPECT_EQ(cloud->dropped, 1U);
  EXPECT_EQ(cloud->points_m[1], Eigen::Vector3f(30.0F, 4.0F, -1.0F));
  EXPECT_EQ(cloud->intensity, (std::vector<float>{0.5F, 0.9F}));
  EXPECT_FALSE(cloud->has_time());
}

TEST(KittiPoints, RefusesWhatIsNoWholeNumberOfPoints) {
  const test::TemporaryFolder folder;
  const auto path = folder.path() / "cut.bin";
  for (const std::string& content : {std::string(), std::string(17, 'x')}) {
    ASSERT_TRUE(write_file_atomically(path, content).ok());
    const auto cloud = read_kitti_points(path);
    ASSERT_FALSE(cloud.ok());
    EXPECT_THAT(cloud.error().text(), ::testing::HasSubstr("16 for each point"));
    EXPECT_THAT(cloud.error().text(), ::testing::HasSubstr("cut.bin"));
  }
  EXPECT_FALSE(read_kitti_points(folder.path() / "nothing.bin").ok());
}

}  // namespace
}  // namespace lvcalib
