// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "base/random.h"
#include "cloud/cloud.h"

namespace lvcalib {
namespace {
namespace fs = std::filesystem;

class PcdWriter : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("lvcalib_pcd_writer_" + std::to_string(::getpid()));
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }
  [[nodiscard]] std::size_t files() const {
    return static_cast<std::size_t>(
        std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
  }
  fs::path folder_;
};

Cloud random_cloud(std::size_t size) {
  Random random(7);
  Cloud cloud;
  for (std::size_t i = 0; i < size; ++i) {
    cloud.points_m.push_back(
        Eigen::Vector3d(random.normal(), random.normal(), random.normal()).cast<float>());
    cloud.intensity.push_back(static_cast<float>(random.below(256)));
    cloud.time_s.push_back(1e-6F * static_cast<float>(i));
    cloud.line.push_back(static_cast<std::uint16_t>(i % 6));
  }
  return cloud;
}

TEST_F(PcdWriter, WhatItWritesReadsBackTheSame) {
  const Cloud cloud = random_cloud(100'000);  // several blocks
  const fs::path path = folder_ / "cloud.pcd";
  ASSERT_TRUE(write_pcd(path, cloud).ok());
  const auto back = read_cloud(path);
  ASSERT_TRUE(back.ok()) << back.error().text();
  EXPECT_EQ(back->points_m, cloud.points_m);
  EXPECT_EQ(back->intensity, cloud.intensity);
  EXPECT_EQ(back->time_s, cloud.time_s);
  EXPECT_EQ(back->line, cloud.line);
  EXPECT_EQ(files(), 1U);
}

TEST_F(PcdWriter, HeaderListsOnlyTheFieldsThatAreThere) {
  Cloud cloud = random_cloud(3);
  cloud.time_s.clear();
  const fs::path path = folder_ / "cloud.pcd";
  ASSERT_TRUE(write_pcd(path, cloud).ok());
  std::ifstream stream(path, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  EXPECT_THAT(text, testing::HasSubstr("FIELDS x y z intensity line\nSIZE 4 4 4 4 2\nTYPE F F F F "
                                       "U\nCOUNT 1 1 1 1 1\nWIDTH 3\nHEIGHT 1\n"));
  EXPECT_THAT(text, testing::HasSubstr("POINTS 3\nDATA binary\n"));
  EXPECT_FALSE(read_cloud(path)->has_time());
}

TEST_F(PcdWriter, OrganisedCloudsStayOrganised) {
  Cloud cloud = random_cloud(12);
  cloud.rows = 3;
  cloud.points_m[5].setConstant(std::numeric_limits<float>::quiet_NaN());
  const fs::path path = folder_ / "cloud.pcd";
  ASSERT_TRUE(write_pcd(path, cloud).ok());
  const auto back = read_cloud(path, {}, PointChoice::kAll);
  ASSERT_TRUE(back.ok()) << back.error().text();
  EXPECT_EQ(back->rows, 3U);
  EXPECT_EQ(back->size(), 12U);
  EXPECT_TRUE(std::isnan(back->points_m[5].x()));
  EXPECT_EQ(back->intensity, cloud.intensity);
  // Rows that the points no longer fill are no rows.
  cloud.rows = 5;
  ASSERT_TRUE(write_pcd(path, cloud).ok());
  EXPECT_EQ(read_cloud(path, {}, PointChoice::kAll)->rows, 1U);
}

TEST_F(PcdWriter, FailuresLeaveNothingBehind) {
  const Cloud cloud = random_cloud(10);
  const Status absent = write_pcd(folder_ / "no_such_folder" / "cloud.pcd", cloud);
  ASSERT_FALSE(absent.ok());
  EXPECT_EQ(absent.error().kind, ErrorKind::kOutput);
  fs::create_directories(folder_ / "taken" / "by_a_folder");
  EXPECT_FALSE(write_pcd(folder_ / "taken", cloud).ok());
  Cloud uneven = cloud;
  uneven.line.pop_back();
  EXPECT_FALSE(write_pcd(folder_ / "uneven.pcd", uneven).ok());
  EXPECT_EQ(files(), 1U);  // the folder "taken"
}

}  // namespace
}  // namespace lvcalib
