// SPDX-License-Identifier: GPL-3.0-or-later
#include "recording/unfinished_folder.h"

#include <gtest/gtest.h>

#include "support/bag_writer.h"
#include "support/temporary_folder.h"

namespace lvcalib {
namespace {

namespace fs = std::filesystem;

TEST(UnfinishedFolder, TakesItsNameWhenFinishedAndLeavesNothingOtherwise) {
  const test::TemporaryFolder folder;
  const fs::path place = folder.path() / "rig";
  {
    auto first = UnfinishedFolder::create(place, false);
    auto second = UnfinishedFolder::create(place, false);
    ASSERT_TRUE(first.ok());
    ASSERT_TRUE(second.ok());
    EXPECT_NE(first->path(), second->path()) << "one may still be clearing up";
    test::write_bytes(second->path() / "import.json", "{}");
    ASSERT_TRUE(second->finish().ok());
    EXPECT_TRUE(fs::exists(place / "import.json"));
  }
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), {}), 1);
}

TEST(UnfinishedFolder, ReplacesImportsOnlyAndOnlyIfAsked) {
  const test::TemporaryFolder folder;
  const fs::path place = folder.path() / "rig";
  fs::create_directories(place);
  test::write_bytes(place / "other", "x");
  EXPECT_FALSE(UnfinishedFolder::create(place, true).ok());
  test::write_bytes(place / "import.json", "{}");
  EXPECT_FALSE(UnfinishedFolder::create(place, false).ok());
  auto replacing = UnfinishedFolder::create(place, true);
  ASSERT_TRUE(replacing.ok());
  EXPECT_TRUE(fs::exists(place / "other")) << "until the new one is complete";
  ASSERT_TRUE(replacing->finish().ok());
  EXPECT_FALSE(fs::exists(place / "other"));
  EXPECT_FALSE(UnfinishedFolder::create({}, true).ok());
}

TEST(UnfinishedFolder, ClearsUpAfterProcessesThatWereKilled) {
  const test::TemporaryFolder folder;
  const fs::path place = folder.path() / "rig";
  const fs::path left = folder.path() / ".rig.part1-0";
  const fs::path before = folder.path() / ".rig.part1-0-old";
  fs::create_directories(left / "scenes");
  fs::create_directories(before);
  auto working = UnfinishedFolder::create(place, false);
  ASSERT_TRUE(working.ok());
  EXPECT_FALSE(fs::exists(left));
  EXPECT_TRUE(fs::exists(before)) << "all that is left of the import before";
  auto other = UnfinishedFolder::create(place, false);
  ASSERT_TRUE(other.ok());
  EXPECT_TRUE(fs::exists(working->path())) << "somebody works on it";
  test::write_bytes(working->path() / "import.json", "{}");
  ASSERT_TRUE(working->finish().ok());
  const auto again = UnfinishedFolder::create(place, true);
  EXPECT_FALSE(fs::exists(before));
  EXPECT_TRUE(fs::exists(place / "import.json"));
}

}  // namespace
}  // namespace lvcalib
