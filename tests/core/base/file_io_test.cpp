// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/file_io.h"

#include <csignal>
#include <fstream>
#include <iterator>

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

namespace lvcalib {
namespace {
namespace fs = std::filesystem;
using ::testing::HasSubstr;

class FileIo : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::temp_directory_path() /
              ("lvcalib_file_" + std::string(info->name()) + std::to_string(::getpid()));
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }
  [[nodiscard]] auto file_count() const {
    return std::distance(fs::directory_iterator(folder_), fs::directory_iterator());
  }
  fs::path folder_;
};

TEST_F(FileIo, ReadsWhatItWrites) {
  std::string text("binary \0 and\r\nlines\n", 20);
  text += std::string(3'000'000, 'x');
  const fs::path path = folder_ / "file";
  ASSERT_TRUE(write_file_atomically(path, text).ok());
  const auto back = read_text_file(path, text.size());
  ASSERT_TRUE(back.ok());
  EXPECT_EQ(*back, text);
  ASSERT_TRUE(write_file_atomically(path, "").ok());
  EXPECT_EQ(*read_text_file(path, 10), "");
  EXPECT_EQ(file_count(), 1);
}

TEST_F(FileIo, ReplacesAFileWholeAndLeavesNothingBeside) {
  const fs::path path = folder_ / "file";
  ASSERT_TRUE(write_file_atomically(path, "old").ok());
  // A reader that has the old file open keeps the old content: the file is replaced, not changed.
  std::ifstream reader(path);
  ASSERT_TRUE(write_file_atomically(path, "new and longer").ok());
  std::string seen;
  std::getline(reader, seen);
  EXPECT_EQ(seen, "old");
  EXPECT_EQ(*read_text_file(path, 100), "new and longer");
  EXPECT_EQ(file_count(), 1);
}

TEST_F(FileIo, LinksStayAndPipesAreWrittenTo) {
  const fs::path real = folder_ / "real";
  const fs::path link = folder_ / "link";
  ASSERT_TRUE(write_file_atomically(real, "old").ok());
  fs::create_symlink("real", link);
  ASSERT_TRUE(write_file_atomically(link, "new").ok());
  EXPECT_TRUE(fs::is_symlink(link));
  EXPECT_EQ(*read_text_file(real, 100), "new");
  const fs::path pipe = folder_ / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  const int reader = ::open(pipe.c_str(), O_RDONLY | O_NONBLOCK);
  ASSERT_GE(reader, 0);
  ASSERT_TRUE(write_file_atomically(pipe, "through").ok());
  EXPECT_TRUE(fs::is_fifo(pipe));
  char text[16] = {};
  EXPECT_EQ(::read(reader, text, sizeof text), 7);
  EXPECT_STREQ(text, "through");
  ::close(reader);
  EXPECT_EQ(file_count(), 3);
}

TEST_F(FileIo, WhatAFullDeviceLosesIsAnError) {
  const Status lost = write_file_atomically("/dev/full", "text");
  ASSERT_FALSE(lost.ok());
  EXPECT_EQ(lost.error().kind, ErrorKind::kOutput);
  EXPECT_TRUE(fs::is_character_file("/dev/full"));
}

TEST_F(FileIo, WritesIntoTheCurrentFolder) {
  const fs::path before = fs::current_path();
  fs::current_path(folder_);
  const Status status = write_file_atomically("plain", "x");
  fs::current_path(before);
  EXPECT_TRUE(status.ok());
  EXPECT_TRUE(fs::exists(folder_ / "plain"));
}

TEST_F(FileIo, FailuresAreOutputErrorsThatLeaveNothing) {
  const auto refused = [](const Status& status, const fs::path& path) {
    ASSERT_FALSE(status.ok());
    EXPECT_EQ(status.error().kind, ErrorKind::kOutput);
    EXPECT_EQ(status.error().where, path.string());
  };
  const fs::path absent = folder_ / "absent" / "file";
  refused(write_file_atomically(absent, "x"), absent);
  const fs::path in_the_way = folder_ / "folder";
  fs::create_directories(in_the_way / "full");
  refused(write_file_atomically(in_the_way, "x"), in_the_way);
  EXPECT_EQ(file_count(), 1);
  const fs::path device = "/dev/full/file";
  refused(write_file_atomically(device, "x"), device);
}

TEST_F(FileIo, FilesThatBelongTogetherAreOfOneCallHoweverItEnds) {
  const auto write = [&](int run) {
    const std::string text = std::to_string(run) + std::string(20'000, 'x');
    return write_files_together(folder_, {{"a", text}, {"b", text}});
  };
  ASSERT_TRUE(write(0).ok());
  EXPECT_EQ(file_count(), 2);
  for (int round = 0; round < 20; ++round) {
    const pid_t child = ::fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
      for (int run = 1;; ++run) static_cast<void>(write(run));
    }
    ::usleep(static_cast<useconds_t>(2000 + 700 * round));
    ASSERT_EQ(::kill(child, SIGKILL), 0);
    ASSERT_EQ(::waitpid(child, nullptr, 0), child);
    const auto a = read_text_file(folder_ / "a", 100'000);
    const auto b = read_text_file(folder_ / "b", 100'000);
    if (a && b) {
      EXPECT_EQ(*a, *b);
    }
  }
}

TEST_F(FileIo, WithoutRoomForAllOfThemTheEarlierOnesStay) {
  ASSERT_TRUE(write_files_together(folder_, {{"a", "old"}, {"b", "old"}}).ok());
  // A limit on a file's size stands for a disk that is full.
  rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
  const rlimit small{1000, before.rlim_max};
  auto* const handler = std::signal(SIGXFSZ, SIG_IGN);
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
  const Status status =
      write_files_together(folder_, {{"a", "new"}, {"b", std::string(5000, 'x')}});
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &before), 0);
  std::signal(SIGXFSZ, handler);
  ASSERT_FALSE(status.ok());
  EXPECT_EQ(status.error().kind, ErrorKind::kOutput);
  EXPECT_EQ(status.error().where, (folder_ / "b").string());
  EXPECT_EQ(*read_text_file(folder_ / "a", 100), "old");
  EXPECT_EQ(*read_text_file(folder_ / "b", 100), "old");
  EXPECT_EQ(file_count(), 2);
}

TEST_F(FileIo, ReadErrorsSayWhy) {
  const auto message = [](const Result<std::string>& result) {
    EXPECT_FALSE(result.ok());
    EXPECT_EQ(result.error().kind, ErrorKind::kInput);
    return result.error().text();
  };
  EXPECT_THAT(message(read_text_file(folder_ / "none", 10)), HasSubstr("not found"));
  EXPECT_THAT(message(read_text_file(folder_, 10)), HasSubstr("not a regular file"));
  EXPECT_THAT(message(read_text_file("/dev/zero", 10)), HasSubstr("not a regular file"));
  ASSERT_TRUE(write_file_atomically(folder_ / "big", "0123456789A").ok());
  EXPECT_THAT(message(read_text_file(folder_ / "big", 10)), HasSubstr("11 bytes"));
}

TEST_F(FileIo, TellsBeforehandWhetherAFolderCanBeUsed) {
  const auto root = folder_;
  EXPECT_TRUE(check_folder_usable(root).ok());
  EXPECT_TRUE(check_folder_usable(root / "a" / "b").ok());
  EXPECT_FALSE(std::filesystem::exists(root / "a"));
  ASSERT_TRUE(write_file_atomically(root / "file", "x").ok());
  const Status status = check_folder_usable(root / "file" / "b");
  ASSERT_FALSE(status.ok());
  EXPECT_EQ(status.error().kind, ErrorKind::kOutput);
  EXPECT_NE(status.error().text().find("in the way"), std::string::npos);
}

TEST_F(FileIo, CreatesFoldersWithTheirParents) {
  EXPECT_TRUE(create_folder(folder_ / "a" / "b").ok());
  EXPECT_TRUE(fs::is_directory(folder_ / "a" / "b"));
  EXPECT_TRUE(create_folder(folder_ / "a" / "b").ok());
  std::ofstream(folder_ / "file") << "x";
  const Status status = create_folder(folder_ / "file");
  ASSERT_FALSE(status.ok());
  EXPECT_EQ(status.error().kind, ErrorKind::kOutput);
  EXPECT_FALSE(create_folder(folder_ / "file" / "below").ok());
}

}  // namespace
}  // namespace lvcalib
