// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "recording/import.h"
#include "support/bag_writer.h"
#include "support/temporary_folder.h"

namespace lvcalib {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

class TopicChoiceTest : public ::testing::Test {
 protected:
  // A recording of empty messages on these topics.
  Recording with(const std::vector<std::pair<std::string, std::string>>& topics,
                 const std::string& encoding = "cdr") {
    std::vector<test::BagMessage> messages;
    for (const auto& [name, type] : topics) {
      messages.push_back({name, type, 1'700'000'000'000'000'000, std::string("\0\1\0\0", 4)});
    }
    const auto path = folder_.path() / "test.mcap";
    test::write_bytes(path, test::mcap_file(messages, {}, encoding));
    auto recording = Recording::open(path, {});
    EXPECT_TRUE(recording.ok());
    return std::move(*recording);
  }
  static std::string name(const Recording& recording, std::size_t i) {
    return recording.topics()[i].name;
  }
  test::TemporaryFolder folder_;
};

TEST_F(TopicChoiceTest, TheOnlyOnesAreTaken) {
  const auto recording = with({{"/cam/image_raw", "sensor_msgs/Image"},
                               {"/cam/image_raw/compressed", "sensor_msgs/CompressedImage"},
                               {"/cam/camera_info", "sensor_msgs/CameraInfo"},
                               {"/points", "sensor_msgs/PointCloud2"}});
  const auto choice = choose_topics(recording, {});
  ASSERT_TRUE(choice.ok()) << choice.error().text();
  EXPECT_EQ(name(recording, choice->image), "/cam/image_raw");
  EXPECT_EQ(name(recording, choice->cloud), "/points");
  ASSERT_TRUE(choice->info.has_value());
  EXPECT_EQ(name(recording, *choice->info), "/cam/camera_info");
  EXPECT_FALSE(choice->rectified);
}

TEST_F(TopicChoiceTest, SeveralNeedAName) {
  const auto recording = with({{"/left/image_rect", "sensor_msgs/Image"},
                               {"/right/image_raw", "sensor_msgs/Image"},
                               {"/left/camera_info", "sensor_msgs/CameraInfo"},
                               {"/right/camera_info", "sensor_msgs/CameraInfo"},
                               {"/points", "sensor_msgs/PointCloud2"}});
  const auto none = choose_topics(recording, {});
  ASSERT_FALSE(none.ok());
  EXPECT_EQ(none.error().kind, ErrorKind::kUsage);
  EXPECT_THAT(none.error().text(), HasSubstr("/left/image_rect, /right/image_raw"));
  EXPECT_THAT(none.error().text(), HasSubstr("--image-topic"));
  const auto left = choose_topics(recording, TopicNames{"/left/image_rect", "", ""});
  ASSERT_TRUE(left.ok());
  EXPECT_EQ(name(recording, *left->info), "/left/camera_info");
  EXPECT_TRUE(left->rectified);
  const auto wrong = choose_topics(recording, TopicNames{"/middle/image", "", ""});
  ASSERT_FALSE(wrong.ok());
  EXPECT_THAT(wrong.error().text(), HasSubstr("was not recorded"));
  const auto type = choose_topics(recording, TopicNames{"/points", "", ""});
  ASSERT_FALSE(type.ok());
  EXPECT_THAT(type.error().text(), HasSubstr("another type"));
  const auto other_info =
      choose_topics(recording, TopicNames{"/right/image_raw", "", "/left/camera_info"});
  ASSERT_TRUE(other_info.ok());
  EXPECT_EQ(name(recording, *other_info->info), "/left/camera_info");
}

TEST_F(TopicChoiceTest, WhatIsMissingIsNamed) {
  const auto no_clouds = choose_topics(with({{"/a/image", "sensor_msgs/Image"}}), {});
  ASSERT_FALSE(no_clouds.ok());
  EXPECT_THAT(no_clouds.error().text(), HasSubstr("no clouds"));
  const auto no_images = choose_topics(with({{"/points", "sensor_msgs/PointCloud2"}}), {});
  ASSERT_FALSE(no_images.ok());
  EXPECT_THAT(no_images.error().text(), HasSubstr("no images"));
  const auto packets = choose_topics(
      with({{"/a/image", "sensor_msgs/Image"}, {"/packets", "velodyne_msgs/VelodyneScan"}}), {});
  ASSERT_FALSE(packets.ok());
  EXPECT_THAT(packets.error().text(), HasSubstr("velodyne_pointcloud"));
  const auto other = choose_topics(
      with({{"/a/image", "sensor_msgs/Image"}, {"/points", "sensor_msgs/PointCloud2"}}, "json"),
      {});
  ASSERT_FALSE(other.ok());
  EXPECT_THAT(other.error().text(), HasSubstr("json"));
  const auto nothing = choose_topics(with({}), {});
  ASSERT_FALSE(nothing.ok());
  EXPECT_THAT(nothing.error().text(), HasSubstr("no messages"));
}

TEST_F(TopicChoiceTest, CheckNamesWhatStandsInTheWay) {
  const auto recording =
      with({{"/a/image", "sensor_msgs/Image"}, {"/points", "sensor_msgs/PointCloud2"}});
  const auto warnings = check_recording(recording, {});
  ASSERT_TRUE(warnings.ok());
  EXPECT_THAT(*warnings, Contains(HasSubstr("no CameraInfo")));
  EXPECT_THAT(*warnings, Contains(HasSubstr("1 message only")));
  EXPECT_THAT(*warnings, Contains(HasSubstr("ends before its data do")));
  EXPECT_THAT(*warnings, Not(Contains(HasSubstr("no images"))));
}

}  // namespace
}  // namespace lvcalib
