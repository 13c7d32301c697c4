// SPDX-License-Identifier: GPL-3.0-or-later
// Small recordings of other people's tools, where they are at hand.
#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "recording/import.h"
#include "recording/messages.h"
#include "recording/pixels.h"

namespace lvcalib {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;

class RealRecordings : public ::testing::Test {
 protected:
  void SetUp() override {
    const char* data = std::getenv("LVCALIB_SHARED_DATA");
    folder_ = data != nullptr
                  ? std::filesystem::path(data)
                  : std::filesystem::path(LVCALIB_SOURCE_DIR).parent_path() / "shared" / "data";
    folder_ /= "recordings";
    if (!std::filesystem::is_directory(folder_)) GTEST_SKIP() << folder_ << " is not there";
  }
  Recording open(const std::string& name) const {
    auto recording = Recording::open(folder_ / name, {});
    EXPECT_TRUE(recording.ok()) << recording.error().text();
    return std::move(*recording);
  }
  static std::size_t topic(const Recording& recording, const std::string& name) {
    for (std::size_t i = 0; i < recording.topics().size(); ++i) {
      if (recording.topics()[i].name == name) return i;
    }
    ADD_FAILURE() << name;
    return 0;
  }
  // All messages of all topics, in one line each.
  static std::vector<std::string> contents(const Recording& recording) {
    std::vector<std::size_t> all;
    for (std::size_t i = 0; i < recording.topics().size(); ++i) all.push_back(i);
    std::vector<std::string> out;
    const auto done =
        recording.read(all, {}, {}, "", [&](const RecordedMessage& m) -> Result<bool> {
          out.push_back(recording.topics()[m.topic].name + " " + std::to_string(m.time_ns) + " " +
                        std::string(m.data));
          return true;
        });
    EXPECT_TRUE(done.ok());
    EXPECT_TRUE(done->empty());
    return out;
  }
  std::filesystem::path folder_;
};

TEST_F(RealRecordings, Ros1WithAndWithoutBz2HoldTheSame) {
  const auto plain = contents(open("example.bag"));
  EXPECT_EQ(plain.size(), 8647U);
  EXPECT_EQ(plain, contents(open("example-bz2.bag")));
}

TEST_F(RealRecordings, SqliteAndMcapHoldTheSame) {
  const auto database = open("every-type.db3");
  const auto mcap = open("every-type-mcap");
  EXPECT_EQ(database.kind(), "rosbag2 (sqlite3)");
  EXPECT_EQ(mcap.kind(), "MCAP");
  ASSERT_EQ(database.topics().size(), 94U);
  EXPECT_EQ(mcap.topics().size(), 94U);
  EXPECT_EQ(contents(database).size(), 188U);
  EXPECT_EQ(contents(mcap).size(), 188U);
  for (const Recording* recording : {&database, &mcap}) {
    const std::size_t info = topic(*recording, "/test/sensor_msgs/camera_info");
    int seen = 0;
    const auto done =
        recording->read({info}, {}, {}, "", [&](const RecordedMessage& m) -> Result<bool> {
          const auto camera = decode_camera_info(recording->topics()[info], m.data, false);
          EXPECT_TRUE(camera.ok()) << camera.error().text();
          EXPECT_EQ(camera->camera.fx, 525.0);
          EXPECT_EQ(camera->camera.cx, 320.0);
          EXPECT_EQ(camera->camera.height_px, 480);
          EXPECT_EQ(camera->camera.distortion[1], -0.2);
          EXPECT_EQ(camera->frame, "test_frame");
          ++seen;
          return true;
        });
    EXPECT_TRUE(done.ok());
    EXPECT_EQ(seen, 2);
  }
}

TEST_F(RealRecordings, ZstdChunks) {
  const auto recording = open("zstd-chunks.mcap");
  EXPECT_TRUE(recording.warnings().empty());
  std::size_t count = 0;
  for (const Topic& t : recording.topics()) count += t.count;
  EXPECT_EQ(contents(recording).size(), count);
  EXPECT_GT(count, 1000U);
}

TEST_F(RealRecordings, CompressedImageOfARealCamera) {
  const auto recording = open("aruco-compressed-images.bag");
  const std::size_t images = topic(recording, "/raspicam_node/image/compressed");
  bool seen = false;
  const auto done =
      recording.read({images}, {}, {}, "", [&](const RecordedMessage& m) -> Result<bool> {
        const auto image = decode_image(recording.topics()[images], m.data);
        EXPECT_TRUE(image.ok()) << image.error().text();
        const auto look = look_at_image(*image, "");
        EXPECT_TRUE(look.ok());
        EXPECT_GT(look->sharpness, 0.0);
        seen = true;
        return true;
      });
  EXPECT_TRUE(done.ok());
  EXPECT_TRUE(seen);
}

TEST_F(RealRecordings, WithoutMessagesOrWithPacketsOnly) {
  for (const char* name : {"empty.db3", "no-messages.bag"}) {
    const auto warnings = check_recording(open(name), {});
    ASSERT_TRUE(warnings.ok());
    EXPECT_THAT(*warnings, Contains(HasSubstr("no messages")));
  }
  const auto warnings = check_recording(open("raw-velodyne-packets.db3"), {});
  ASSERT_TRUE(warnings.ok());
  EXPECT_THAT(*warnings, Contains(HasSubstr("velodyne_pointcloud")));
}

}  // namespace
}  // namespace lvcalib
