// SPDX-License-Identifier: GPL-3.0-or-later
#include "recording/recording.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/recording/containers.h"
#include "support/temporary_folder.h"

namespace lvcalib {
namespace {

using test::BagMessage;
using ::testing::HasSubstr;

constexpr std::int64_t kStart = 1'700'000'000'000'000'000;

// Three topics with messages of many sizes. Neighbours in the file are out of order now and then.
std::vector<BagMessage> some_messages(test::Wire wire) {
  std::vector<BagMessage> out;
  for (int i = 0; i < 60; ++i) {
    const char* topics[] = {"/camera/image_raw", "/points", "/chatter"};
    const char* types[] = {"sensor_msgs/Image", "sensor_msgs/PointCloud2", "std_msgs/String"};
    test::MessageBuilder data(wire);
    data.text(std::string(static_cast<std::size_t>(i * 37 % 500), static_cast<char>('a' + i % 26)));
    // Swapped with the next one every seventh time.
    const int place = i % 7 == 3 ? i + 1 : i % 7 == 4 ? i - 1 : i;
    out.push_back({topics[i % 3], types[i % 3], kStart + place * 10'000'000LL, data.bytes()});
  }
  return out;
}

struct Read {
  std::string topic;
  std::int64_t time_ns;
  std::string data;
  bool operator==(const Read&) const = default;
};

void PrintTo(const Read& r, std::ostream* out) {
  *out << r.topic << " at " << r.time_ns - kStart << " " << r.data.substr(0, 24);
}

Result<std::vector<Read>> read_all(const Recording& recording,
                                   const std::vector<std::size_t>& topics,
                                   const TimeSpan& span = {}) {
  std::vector<Read> out;
  const auto done =
      recording.read(topics, span, {}, "test", [&](const RecordedMessage& m) -> Result<bool> {
        out.push_back({recording.topics()[m.topic].name, m.time_ns, std::string(m.data)});
        return true;
      });
  if (!done) return done.error();
  EXPECT_TRUE(done->empty()) << done->front().text();
  return out;
}

std::vector<Read> sorted(const std::vector<BagMessage>& messages) {
  std::vector<Read> out;
  for (const BagMessage& m : messages) out.push_back({m.topic, m.time_ns, m.data});
  std::stable_sort(out.begin(), out.end(),
                   [](const Read& a, const Read& b) { return a.time_ns < b.time_ns; });
  return out;
}

class EveryContainer : public ::testing::TestWithParam<test::ContainerCase> {
 protected:
  test::TemporaryFolder folder_;
};

TEST_P(EveryContainer, ListsTopicsAndGivesMessagesInOrderOfTime) {
  const auto messages = some_messages(test::wire_of(GetParam()));
  const auto path = test::write_recording(GetParam(), folder_.path(), messages);
  const auto recording = Recording::open(path, {});
  ASSERT_TRUE(recording.ok()) << recording.error().text();
  ASSERT_EQ(recording->topics().size(), 3U);
  EXPECT_EQ(recording->topics()[0].name, "/camera/image_raw");
  EXPECT_EQ(recording->topics()[0].type, "sensor_msgs/Image");
  EXPECT_EQ(recording->topics()[1].name, "/chatter");
  EXPECT_EQ(recording->topics()[2].type, "sensor_msgs/PointCloud2");
  for (const Topic& topic : recording->topics()) EXPECT_EQ(topic.count, 20U);
  EXPECT_EQ(recording->span().first_ns, kStart);
  EXPECT_EQ(recording->span().last_ns, kStart + 600'000'000);
  EXPECT_EQ(recording->topics()[2].first_ns, kStart + 10'000'000);
  const auto all = read_all(*recording, {0, 1, 2});
  ASSERT_TRUE(all.ok()) << all.error().text();
  EXPECT_EQ(*all, sorted(messages));
}

TEST_P(EveryContainer, GivesOneTopicWithinATime) {
  const auto messages = some_messages(test::wire_of(GetParam()));
  const auto path = test::write_recording(GetParam(), folder_.path(), messages);
  const auto recording = Recording::open(path, {});
  ASSERT_TRUE(recording.ok());
  const TimeSpan span{kStart + 100'000'000, kStart + 400'000'000};
  auto expected = sorted(messages);
  std::erase_if(expected,
                [&](const Read& r) { return r.topic != "/points" || !span.contains(r.time_ns); });
  const auto some = read_all(*recording, {2}, span);
  ASSERT_TRUE(some.ok());
  EXPECT_EQ(*some, expected);
  EXPECT_GT(some->size(), 5U);
}

TEST_P(EveryContainer, StopsWhenAsked) {
  const auto path =
      test::write_recording(GetParam(), folder_.path(), some_messages(test::wire_of(GetParam())));
  std::stop_source stop;
  RunContext context;
  context.stop = stop.get_token();
  const auto recording = Recording::open(path, context);
  ASSERT_TRUE(recording.ok());
  int seen = 0;
  const auto done =
      recording->read({0, 1, 2}, {}, context, "test", [&](const RecordedMessage&) -> Result<bool> {
        if (++seen == 5) stop.request_stop();
        return true;
      });
  ASSERT_FALSE(done.ok());
  EXPECT_EQ(done.error().kind, ErrorKind::kCancelled);
  EXPECT_EQ(seen, 5);
}

INSTANTIATE_TEST_SUITE_P(Containers, EveryContainer, ::testing::ValuesIn(test::all_containers()),
                         [](const auto& info) { return info.param.name; });

class ARecording : public ::testing::Test {
 protected:
  [[nodiscard]] std::filesystem::path write(const std::string& name,
                                            const std::string& bytes) const {
    test::write_bytes(folder_.path() / name, bytes);
    return folder_.path() / name;
  }
  void expect_refused(const std::filesystem::path& path, const std::string& why) const {
    const auto recording = Recording::open(path, {});
    ASSERT_FALSE(recording.ok());
    EXPECT_EQ(recording.error().kind, ErrorKind::kInput);
    EXPECT_THAT(recording.error().text(), HasSubstr(why));
    EXPECT_THAT(recording.error().text(), HasSubstr(path.filename().string()));
  }
  // Messages that come out, each as it was written, and at least so many; with a warning.
  void expect_rest(const std::filesystem::path& path, const std::vector<BagMessage>& messages,
                   std::size_t at_least, const std::string& warning) const {
    const auto recording = Recording::open(path, {});
    ASSERT_TRUE(recording.ok()) << recording.error().text();
    std::vector<Message> warnings = recording->warnings();
    std::vector<std::size_t> topics;
    for (std::size_t i = 0; i < recording->topics().size(); ++i) topics.push_back(i);
    const auto expected = sorted(messages);
    std::size_t count = 0;
    const auto more =
        recording->read(topics, {}, {}, "test", [&](const RecordedMessage& m) -> Result<bool> {
          const Read r{recording->topics()[m.topic].name, m.time_ns, std::string(m.data)};
          EXPECT_THAT(expected, ::testing::Contains(r));
          ++count;
          return true;
        });
    ASSERT_TRUE(more.ok());
    warnings.insert(warnings.end(), more->begin(), more->end());
    EXPECT_GE(count, at_least);
    EXPECT_THAT(warnings, ::testing::Contains(HasSubstr(warning)));
  }
  test::TemporaryFolder folder_;
};

TEST_F(ARecording, IsToldByItsContent) {
  const auto bag = test::ros1_bag(some_messages(test::Wire::kRos1));
  const auto named_wrong = Recording::open(write("bag.mcap", bag), {});
  ASSERT_TRUE(named_wrong.ok());
  EXPECT_EQ(named_wrong->kind(), "ROS 1 bag");
  expect_refused(write("image.bag", "\x89PNG\r\n and so on"), "is no recording");
  expect_refused(write("text.bag", "hello"), "is no recording");
  expect_refused(write("empty.bag", ""), "is empty");
  expect_refused(folder_.path() / "missing.bag", "not found");
  expect_refused(write("old.bag", "#ROSBAG V1.2\nxxxx"), "version 1.2");
  expect_refused(write("short.bag", "#ROSBAG V2.0\n"), "ends within its header");
  expect_refused(write("noise.db3", "SQLite format 3" + std::string(5000, '\x7f')),
                 "cannot be read");
}

TEST_F(ARecording, WithoutMessagesIsEmptyAndNoError) {
  for (const auto& path :
       {write("no.bag", test::ros1_bag({})), write("no.mcap", test::mcap_file({}))}) {
    const auto recording = Recording::open(path, {});
    ASSERT_TRUE(recording.ok()) << recording.error().text();
    EXPECT_TRUE(recording->topics().empty());
    EXPECT_GT(recording->span().first_ns, recording->span().last_ns);
  }
}

TEST_F(ARecording, CutOffAnywhereGivesWhatIsWhole) {
  const auto messages = some_messages(test::Wire::kRos1);
  for (const test::Packing packing : {test::Packing::kNone, test::Packing::kLz4}) {
    const std::string bag = test::ros1_bag(messages, {.packing = packing});
    for (const double part : {0.4, 0.6, 0.8}) {
      const auto cut = static_cast<std::size_t>(part * static_cast<double>(bag.size()));
      expect_rest(write("cut.bag", bag.substr(0, cut)), messages, 5, "cut off");
    }
  }
  const auto ros2 = some_messages(test::Wire::kCdrLittle);
  for (const bool chunks : {true, false}) {
    const std::string mcap = test::mcap_file(ros2, {.chunks = chunks});
    for (const double part : {0.3, 0.5, 0.7}) {
      const auto cut = static_cast<std::size_t>(part * static_cast<double>(mcap.size()));
      expect_rest(write("cut.mcap", mcap.substr(0, cut)), ros2, 5, "cut off");
    }
  }
}

TEST_F(ARecording, CutOffAtEveryByteNeverFailsBadly) {
  std::vector<BagMessage> messages = some_messages(test::Wire::kRos1);
  messages.resize(9);
  const std::string bag = test::ros1_bag(messages);
  const std::string mcap = test::mcap_file(messages, {}, "ros1");
  for (const std::string* whole : {&bag, &mcap}) {
    const std::size_t first = whole == &bag ? 4000 : 0;
    for (std::size_t cut = first; cut < whole->size(); cut += 3) {
      const auto recording = Recording::open(write("cut", whole->substr(0, cut)), {});
      if (!recording) {
        EXPECT_EQ(recording.error().kind, ErrorKind::kInput);
        continue;
      }
      for (const Topic& topic : recording->topics()) EXPECT_LE(topic.count, 3U);
    }
  }
}

TEST_F(ARecording, CutOffDatabaseGivesWhatIsWhole) {
  auto messages = some_messages(test::Wire::kCdrLittle);
  for (BagMessage& m : messages) m.data += std::string(3000, 'x');
  test::write_sqlite_bag(folder_.path() / "whole.db3", messages);
  std::filesystem::resize_file(folder_.path() / "whole.db3", 120'000);
  expect_rest(folder_.path() / "whole.db3", messages, 5, "damaged");
}

TEST_F(ARecording, DamagedChunkCostsItsMessagesOnly) {
  const auto messages = some_messages(test::Wire::kRos1);
  std::string bag = test::ros1_bag(messages, {.packing = test::Packing::kLz4});
  const auto chunk = bag.find("compression=lz4", bag.size() / 3);
  ASSERT_NE(chunk, std::string::npos);
  for (std::size_t i = 0; i < 40; ++i) bag[chunk + 60 + i] = static_cast<char>(i * 77);
  expect_rest(write("hurt.bag", bag), messages, 50, "damaged");
}

TEST_F(ARecording, HugeLengthsAreNotBelieved) {
  const auto messages = some_messages(test::Wire::kRos1);
  std::string bag = test::ros1_bag(messages);
  const auto at = bag.find("conn=", bag.size() / 2);
  ASSERT_NE(at, std::string::npos);
  bag.replace(at - 4, 4, "\xff\xff\xff\x7f");
  const auto damaged_bag = Recording::open(write("huge.bag", bag), {});
  EXPECT_TRUE(damaged_bag.ok());
  std::string mcap = test::mcap_file(messages, {}, "ros1");
  mcap.replace(9, 8, std::string(8, '\x7f'));  // The first record's length.
  const auto damaged_mcap = Recording::open(write("huge.mcap", mcap), {});
  EXPECT_TRUE(damaged_mcap.ok());
}

TEST_F(ARecording, OneBadFileOfASplitIsLeftOut) {
  const auto messages = some_messages(test::Wire::kCdrLittle);
  test::write_rosbag2(folder_.path() / "bag", messages, "mcap", 3);
  test::write_bytes(folder_.path() / "bag" / "bag_1.mcap", "nothing");
  const auto recording = Recording::open(folder_.path() / "bag", {});
  ASSERT_TRUE(recording.ok());
  EXPECT_THAT(recording->warnings(), ::testing::Contains(HasSubstr("left out")));
  EXPECT_EQ(recording->topics()[0].count, 13U);
  std::filesystem::remove(folder_.path() / "bag" / "bag_1.mcap");
  const auto missing = Recording::open(folder_.path() / "bag", {});
  ASSERT_TRUE(missing.ok());
  EXPECT_THAT(missing->warnings(), ::testing::Contains(HasSubstr("not there")));
}

TEST_F(ARecording, FolderWithoutMetadata) {
  const auto messages = some_messages(test::Wire::kCdrLittle);
  test::write_rosbag2(folder_.path() / "bag", messages, "mcap", 12);
  std::filesystem::remove(folder_.path() / "bag" / "metadata.yaml");
  const auto recording = Recording::open(folder_.path() / "bag", {});
  ASSERT_TRUE(recording.ok());
  EXPECT_THAT(recording->warnings(), ::testing::Contains(HasSubstr("no metadata.yaml")));
  const auto all = read_all(*recording, {0, 1, 2});
  ASSERT_TRUE(all.ok());
  EXPECT_EQ(*all, sorted(messages));
  std::filesystem::create_directory(folder_.path() / "nothing");
  expect_refused(folder_.path() / "nothing", "without a recording");
  test::write_bytes(folder_.path() / "nothing" / "metadata.yaml", "a: [b\n");
  EXPECT_FALSE(Recording::open(folder_.path() / "nothing", {}).ok());
  test::write_bytes(folder_.path() / "nothing" / "metadata.yaml", "a: b\n");
  EXPECT_FALSE(Recording::open(folder_.path() / "nothing", {}).ok());
}

TEST_F(ARecording, TimesThatGoBackAreTold) {
  auto messages = some_messages(test::Wire::kRos1);
  std::reverse(messages.begin(), messages.end());
  const auto path = write("back.bag", test::ros1_bag(messages));
  const auto recording = Recording::open(path, {});
  ASSERT_TRUE(recording.ok());
  const auto all = read_all(*recording, {0, 1, 2});  // Small enough to be put in order.
  ASSERT_TRUE(all.ok());
  auto expected = sorted(messages);
  EXPECT_EQ(*all, expected);
}

}  // namespace
}  // namespace lvcalib
