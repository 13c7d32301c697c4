// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/input_hashes.h"

#include <fstream>

#include <gtest/gtest.h>

#include "support/temporary_folder.h"

namespace lvcalib {
namespace {

// FIPS 180-2, example B.1.
TEST(InputHashes, AreSha256) {
  const test::TemporaryFolder folder;
  std::ofstream(folder.path() / "abc") << "abc";
  InputFile file;
  ASSERT_TRUE(hash_file(folder.path() / "abc", {}, file));
  EXPECT_EQ(file.sha256, "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(file.bytes, 3U);
  std::ofstream(folder.path() / "empty");
  ASSERT_TRUE(hash_file(folder.path() / "empty", {}, file));
  EXPECT_EQ(file.sha256, "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(file.bytes, 0U);
}

TEST(InputHashes, NameEveryFileOfADatasetAndMarkTheMissing) {
  const test::TemporaryFolder folder;
  Dataset dataset;
  dataset.path = folder.path();
  std::ofstream(folder.path() / "target.yaml") << "t";
  SceneFiles scene;
  scene.name = "A";
  scene.image = folder.path() / "scenes/A/image.png";
  scene.cloud = folder.path() / "scenes/A/cloud.pcd";
  scene.crop = folder.path() / "scenes/A/board.pcd";
  dataset.scenes.push_back(scene);
  const auto files = hash_inputs(dataset, false, {});
  ASSERT_EQ(files.size(), 4U);
  EXPECT_EQ(files[0].path, "target.yaml");
  EXPECT_EQ(files[0].sha256.size(), 64U);
  EXPECT_EQ(files[3].path, "scenes/A/cloud.pcd");
  EXPECT_TRUE(files[3].sha256.empty());
  EXPECT_EQ(hash_inputs(dataset, true, {})[3].path, "scenes/A/board.pcd");
}

}  // namespace
}  // namespace lvcalib
