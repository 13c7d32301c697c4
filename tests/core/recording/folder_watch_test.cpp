// SPDX-License-Identifier: GPL-3.0-or-later
#include "recording/folder_watch.h"

#include <chrono>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/file_io.h"
#include "cloud/cloud.h"
#include "support/image_files.h"
#include "support/temporary_folder.h"

namespace lvcalib {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

// Another program's folder: NAME.png and NAME.pcd.
class FolderWatchTest : public ::testing::Test {
 protected:
  [[nodiscard]] fs::path place() const { return folder_.path() / "out"; }
  void SetUp() override { fs::create_directories(place()); }
  void write_image(const std::string& name) const {
    ASSERT_TRUE(
        test::write_png(place() / (name + ".png"), cv::Mat(32, 48, CV_8UC1, cv::Scalar(99))));
  }
  static Cloud cloud(int points) {
    Cloud out;
    for (int i = 0; i < points; ++i)
      out.points_m.emplace_back(2.0F, 0.01F * static_cast<float>(i), 0.5F);
    return out;
  }
  void write_cloud(const std::string& name, int points = 50) const {
    ASSERT_TRUE(write_pcd(place() / (name + ".pcd"), cloud(points)).ok());
  }
  FolderLook look() {
    const auto out = watch_.look({});
    EXPECT_TRUE(out.ok()) << (out.ok() ? "" : out.error().text());
    return out ? *out : FolderLook{};
  }
  static std::vector<std::string> names(const FolderLook& look) {
    std::vector<std::string> out;
    for (const FilePair& pair : look.ready) out.push_back(pair.name);
    return out;
  }

  test::TemporaryFolder folder_;
  FolderWatch watch_{pair_lister({place(), {}, PairRule::kAuto, 0.0, 0.0})};
};

TEST_F(FolderWatchTest, APairIsReadyOnceItStandsStill) {
  // Nothing yet is no error.
  FolderLook first = look();
  EXPECT_TRUE(first.ready.empty());
  ASSERT_EQ(first.pending.size(), 1U);
  EXPECT_THAT(first.pending[0].reason, HasSubstr("holds no images"));
  write_image("one");
  EXPECT_THAT(look().pending.front().reason, HasSubstr("holds no clouds"));
  write_cloud("one");
  first = look();
  EXPECT_TRUE(first.ready.empty());
  ASSERT_EQ(first.pending.size(), 1U);
  EXPECT_EQ(first.pending[0].name, "one");
  EXPECT_THAT(first.pending[0].reason, HasSubstr("still being written"));
  const FolderLook second = look();
  ASSERT_EQ(names(second), std::vector<std::string>{"one"});
  EXPECT_EQ(second.ready[0].cloud.filename(), "one.pcd");
  EXPECT_TRUE(second.pending.empty());
  // Told once.
  EXPECT_TRUE(look().ready.empty());
  // The next beside it, whose cloud is late.
  write_image("two");
  const FolderLook waiting = look();
  ASSERT_EQ(waiting.pending.size(), 1U);
  EXPECT_EQ(waiting.pending[0].name, "two.png");
  EXPECT_THAT(waiting.pending[0].reason, HasSubstr("no cloud belongs to it"));
  write_cloud("two");
  look();
  EXPECT_EQ(names(look()), std::vector<std::string>{"two"});
}

TEST_F(FolderWatchTest, AFileThatGrowsIsWaitedFor) {
  write_image("one");
  for (int points = 10; points < 50; points += 10) {
    write_cloud("one", points);
    const FolderLook now = look();
    EXPECT_TRUE(now.ready.empty());
    ASSERT_EQ(now.pending.size(), 1U);
    EXPECT_THAT(now.pending[0].reason, HasSubstr("still being written"));
  }
  EXPECT_EQ(names(look()), std::vector<std::string>{"one"});
}

// The writer paused in the middle: size and time stand still, and it is no whole file yet.
TEST_F(FolderWatchTest, AHalfWrittenFileIsLookedAtAgain) {
  write_image("one");
  write_cloud("one");
  const std::string whole = *read_text_file(place() / "one.pcd", 1U << 20U);
  folder_.write("out/one.pcd", whole.substr(0, whole.size() / 2));
  look();
  for (int i = 0; i < 2; ++i) {
    const FolderLook now = look();
    EXPECT_TRUE(now.ready.empty());
    ASSERT_EQ(now.pending.size(), 1U);
    EXPECT_THAT(now.pending[0].reason, HasSubstr("cannot be read yet"));
  }
  folder_.write("out/one.pcd", whole);
  look();
  EXPECT_EQ(names(look()), std::vector<std::string>{"one"});
  // The same of an image, and of one that is only a name yet.
  write_cloud("two");
  const std::string image = *read_text_file(place() / "one.png", 1U << 20U);
  folder_.write("out/two.png", "");
  look();
  EXPECT_THAT(look().pending.front().reason, HasSubstr("still being written"));
  folder_.write("out/two.png", image.substr(0, image.size() - 20));
  look();
  EXPECT_THAT(look().pending.front().reason, HasSubstr("cannot be read yet"));
  folder_.write("out/two.png", image);
  look();
  EXPECT_EQ(names(look()), std::vector<std::string>{"two"});
}

// Written anew with the same size: the time tells.
TEST_F(FolderWatchTest, TheTimeOfTheLastChangeCounts) {
  write_image("one");
  write_cloud("one");
  look();
  const fs::path path = place() / "one.pcd";
  fs::last_write_time(path, fs::last_write_time(path) + std::chrono::seconds(5));
  EXPECT_TRUE(look().ready.empty());
  EXPECT_EQ(names(look()), std::vector<std::string>{"one"});
}

TEST_F(FolderWatchTest, APairThatDisappearsIsForgotten) {
  write_image("keeps");
  write_cloud("keeps");
  write_image("goes");
  write_cloud("goes");
  EXPECT_EQ(look().pending.size(), 2U);
  fs::remove(place() / "goes.pcd");
  const FolderLook now = look();
  EXPECT_EQ(names(now), std::vector<std::string>{"keeps"});
  ASSERT_EQ(now.pending.size(), 1U);
  EXPECT_EQ(now.pending[0].name, "goes.png");
  fs::remove(place() / "goes.png");
  EXPECT_TRUE(look().pending.empty());
  // Back again: two looks as at first.
  write_image("goes");
  write_cloud("goes");
  EXPECT_TRUE(look().ready.empty());
  EXPECT_EQ(names(look()), std::vector<std::string>{"goes"});
}

TEST_F(FolderWatchTest, WhatIsKnownIsNotTold) {
  write_image("old");
  write_cloud("old");
  write_image("new");
  write_cloud("new");
  write_image("other");
  write_cloud("other");
  FolderWatch watch(pair_lister({place(), {}, PairRule::kAuto, 0.0, 0.0}), {"old"});
  watch.know("other");
  ASSERT_TRUE(watch.look({}).ok());
  const auto second = watch.look({});
  ASSERT_TRUE(second.ok());
  EXPECT_EQ(names(*second), std::vector<std::string>{"new"});
}

TEST_F(FolderWatchTest, AFolderThatCannotBeListedIsAnErrorUntilItCan) {
  fs::rename(place(), folder_.path() / "away");
  auto out = watch_.look({});
  ASSERT_FALSE(out.ok());
  EXPECT_EQ(out.error().kind, ErrorKind::kInput);
  EXPECT_THAT(out.error().text(), HasSubstr("out"));
  folder_.write("out", "a file");
  EXPECT_FALSE(watch_.look({}).ok());
  fs::remove(place());
  fs::rename(folder_.path() / "away", place());
  EXPECT_TRUE(watch_.look({}).ok());
}

TEST_F(FolderWatchTest, StopsWhenAsked) {
  write_image("one");
  write_cloud("one");
  std::stop_source stop;
  stop.request_stop();
  RunContext context;
  context.stop = stop.get_token();
  EXPECT_EQ(watch_.look(context).error().kind, ErrorKind::kCancelled);
}

}  // namespace
}  // namespace lvcalib
