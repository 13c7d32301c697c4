// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/scene_lister.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/temporary_folder.h"

namespace lvcalib {
namespace {

namespace fs = std::filesystem;

TEST(SceneLister, ListsScenesAndWhatTheyLack) {
  const test::TemporaryFolder folder;
  for (const char* name : {"B", "A", "C", ".D.part7"}) fs::create_directories(folder.path() / name);
  for (const char* name : {"A/image.png", "A/cloud.ply", "B/image.jpg", "B/cloud.pcd",
                           "B/board.pcd", "C/image.png", ".D.part7/image.png", "loose.png"})
    folder.write(name, "x");
  const auto out = scene_lister(folder.path())();
  ASSERT_TRUE(out.ok()) << out.error().text();
  ASSERT_EQ(out->pairs.size(), 2U);
  EXPECT_EQ(out->pairs[0].name, "A");
  EXPECT_EQ(out->pairs[0].cloud, folder.path() / "A" / "cloud.ply");
  EXPECT_EQ(out->pairs[1].image, folder.path() / "B" / "image.jpg");
  EXPECT_EQ(out->pairs[1].board_points, folder.path() / "B" / "board.pcd");
  ASSERT_EQ(out->incomplete.size(), 1U);
  EXPECT_EQ(out->incomplete[0].name, "C");
  EXPECT_THAT(out->incomplete[0].reason, ::testing::HasSubstr("no cloud in this scene"));
}

TEST(SceneLister, NoFolderIsAnError) {
  const test::TemporaryFolder folder;
  const auto out = scene_lister(folder.path() / "none")();
  ASSERT_FALSE(out.ok());
  EXPECT_EQ(out.error().kind, ErrorKind::kInput);
}

}  // namespace
}  // namespace lvcalib
