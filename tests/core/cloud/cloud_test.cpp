// SPDX-License-Identifier: GPL-3.0-or-later
#include "cloud/cloud.h"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/cloud/cloud_text.h"

namespace lvcalib {
namespace {

using testing::HasSubstr;

class CloudFile : public testing::Test {
 protected:
  void SetUp() override {
    const auto* info = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::temp_directory_path() /
              ("lvcalib_cloud_" + std::string(info->name()) + std::to_string(::getpid()));
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::filesystem::path write(const std::string& name, const std::string& content) const {
    std::ofstream(folder_ / name, std::ios::binary) << content;
    return folder_ / name;
  }
  std::filesystem::path folder_;
};

TEST_F(CloudFile, TellsFormatsApartByContentNotByName) {
  const auto pcd = write("a.ply", test::ascii_header(1) + "1 2 3 4\n");
  const auto ply = write("b.pcd",
                         "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\n"
                         "property float y\nproperty float z\nend_header\n1 2 3\n");
  ASSERT_TRUE(read_cloud(pcd).ok());
  EXPECT_TRUE(read_cloud(pcd)->has_intensity());
  ASSERT_TRUE(read_cloud(ply).ok());
  EXPECT_FALSE(read_cloud(ply)->has_intensity());
}

TEST_F(CloudFile, UnusableFilesAreInputErrorsThatNameTheFile) {
  const struct {
    std::filesystem::path path;
    std::string expected;
  } cases[] = {
      {folder_ / "absent.pcd", "not found"},
      {folder_, "folder"},
      {write("empty.pcd", ""), "is empty"},
      {write("short.pcd", "#"), "ends without a DATA line"},
      {write("image.pcd", "\x89PNG\r\n\x1a\n...."), "neither a PCD nor a PLY"},
      {write("none.pcd", test::ascii_header(0)), "no points"},
      {write("nan.pcd", test::ascii_header(3) + "nan nan nan 1\ninf 0 0 1\n0 0 0 7\n"),
       "none of its 3 points"},
      {"/dev/null", "not a regular file"},
  };
  for (const auto& [path, expected] : cases) {
    const auto cloud = read_cloud(path);
    ASSERT_FALSE(cloud.ok()) << path;
    EXPECT_EQ(cloud.error().kind, ErrorKind::kInput) << path;
    EXPECT_THAT(cloud.error().text(), HasSubstr(expected)) << path;
    EXPECT_EQ(cloud.error().where, path.string());
  }
}

TEST_F(CloudFile, StopTokenCancels) {
  const auto path = write("a.pcd", test::ascii_header(1) + "1 2 3 4\n");
  std::stop_source source;
  ASSERT_TRUE(read_cloud(path, source.get_token()).ok());
  source.request_stop();
  const auto cloud = read_cloud(path, source.get_token());
  ASSERT_FALSE(cloud.ok());
  EXPECT_EQ(cloud.error().kind, ErrorKind::kCancelled);
}

TEST(Cloud, LeavesOutPointsThatAreNoReturns) {
  const auto cloud = read_cloud_from_memory(
      test::ascii_header(6) + "1 2 3 4\nnan 1 1 9\n0 0 0 9\n1 -inf 1 9\n0 0 -5 6\n1e99 0 1 9\n",
      "m");
  ASSERT_TRUE(cloud.ok()) << cloud.error().text();
  ASSERT_EQ(cloud->size(), 2U);
  EXPECT_EQ(cloud->dropped, 4U);
  EXPECT_EQ(cloud->points_m[0], Eigen::Vector3f(1, 2, 3));
  EXPECT_EQ(cloud->points_m[1], Eigen::Vector3f(0, 0, -5));
  EXPECT_THAT(cloud->intensity, testing::ElementsAre(4, 6));
}

TEST(Cloud, EveryPointStaysInItsPlaceWhenAllAreWanted) {
  // Two rows of three; unset points carry times of zero, returns times since 1970.
  std::string header =
      test::pcd_header("x y z intensity time", "4 4 4 4 8", "F F F F F", "1 1 1 1 1", 6, "ascii");
  header.replace(header.find("WIDTH 6\nHEIGHT 1"), 16, "WIDTH 3\nHEIGHT 2");
  const std::string rows =
      "1 2 3 4 1700000000.5\nnan nan nan nan 0\n0 0 0 0 0\n4 5 6 nan 1700000000.25\n"
      "1 -inf 1 9 0\n7 8 9 1 1700000001.25\n";
  const auto cloud = read_cloud_from_memory(header + rows, "m", PointChoice::kAll);
  ASSERT_TRUE(cloud.ok()) << cloud.error().text();
  ASSERT_EQ(cloud->size(), 6U);
  EXPECT_EQ(cloud->rows, 2U);
  EXPECT_EQ(cloud->dropped, 0U);
  EXPECT_TRUE(std::isnan(cloud->points_m[1].x()));
  EXPECT_TRUE(cloud->points_m[2].isZero());
  EXPECT_EQ(cloud->points_m[5], Eigen::Vector3f(7, 8, 9));
  EXPECT_TRUE(std::isnan(cloud->intensity[3]));
  EXPECT_FLOAT_EQ(cloud->time_s[0], 0.25F);
  EXPECT_FLOAT_EQ(cloud->time_s[3], 0.0F);
  EXPECT_FLOAT_EQ(cloud->time_s[5], 1.0F);
  EXPECT_EQ(read_cloud_from_memory(header + rows, "m")->rows, 1U);
}

TEST(Cloud, WithoutAnyReturnIsNoUseEvenWhenAllAreWanted) {
  const auto cloud = read_cloud_from_memory(test::ascii_header(2) + "nan 2 3 4\n0 0 0 9\n", "m",
                                            PointChoice::kAll);
  ASSERT_FALSE(cloud.ok());
  EXPECT_THAT(cloud.error().text(), HasSubstr("none of its 2 points"));
}

TEST(Cloud, MissingFieldsStayEmpty) {
  const auto cloud = read_cloud_from_memory(
      test::pcd_header("x y z", "4 4 4", "F F F", "1 1 1", 1, "ascii") + "1 2 3\n", "m");
  ASSERT_TRUE(cloud.ok());
  EXPECT_FALSE(cloud->has_intensity());
  EXPECT_FALSE(cloud->has_time());
  EXPECT_FALSE(cloud->has_line());
}

}  // namespace
}  // namespace lvcalib
