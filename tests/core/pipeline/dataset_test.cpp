// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/dataset.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/file_io.h"
#include "support/pose_matchers.h"
#include "support/synthetic_observations.h"
#include "support/temporary_folder.h"

namespace lvcalib {
namespace {

using ::testing::HasSubstr;
namespace fs = std::filesystem;

// Files that open_dataset only lists may be empty.
class DatasetTest : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_.write("d/target.yaml", to_yaml(Target{}));
    folder_.write("d/camera.yaml", to_yaml(test::test_camera()));
    folder_.write("d/scenes/B/image.png", "");
    folder_.write("d/scenes/B/cloud.pcd", "");
    folder_.write("d/scenes/A/image.jpg", "");
    folder_.write("d/scenes/A/cloud.ply", "");
    folder_.write("d/scenes/A/board.pcd", "");
  }
  [[nodiscard]] fs::path path() const { return folder_.path() / "d"; }
  // The error when one file or folder is taken away.
  [[nodiscard]] Error without(const std::string& name) const {
    fs::remove_all(path() / name);
    const auto dataset = open_dataset(path());
    EXPECT_FALSE(dataset.ok()) << "without " << name;
    return dataset.ok() ? Error{} : dataset.error();
  }
  test::TemporaryFolder folder_;
};

TEST_F(DatasetTest, ListsItsScenesSortedByName) {
  const auto dataset = open_dataset(path());
  ASSERT_TRUE(dataset.ok()) << dataset.error().text();
  ASSERT_EQ(dataset->scenes.size(), 2U);
  EXPECT_EQ(dataset->scenes[0].name, "A");
  EXPECT_EQ(dataset->scenes[0].image.filename(), "image.jpg");
  EXPECT_EQ(dataset->scenes[0].cloud.filename(), "cloud.ply");
  EXPECT_EQ(dataset->scenes[0].crop.filename(), "board.pcd");
  EXPECT_EQ(dataset->scenes[1].name, "B");
  EXPECT_TRUE(dataset->scenes[1].crop.empty());
  EXPECT_FALSE(dataset->rough_camera_from_lidar.has_value());
  EXPECT_TRUE(dataset->warnings.empty());
  EXPECT_EQ(dataset->camera.fx, test::test_camera().fx);
}

TEST_F(DatasetTest, ListsImagesForTheCameraAlone) {
  EXPECT_TRUE(open_dataset(path())->camera_images.empty());
  for (const char* name : {"b.JPG", "a.png", "c.tiff", "d.bmp", "notes.txt", ".hidden.png"})
    folder_.write(std::string("d/intrinsics/") + name, "");
  const auto dataset = open_dataset(path());
  ASSERT_TRUE(dataset.ok()) << dataset.error().text();
  ASSERT_EQ(dataset->camera_images.size(), 4U);
  EXPECT_EQ(dataset->camera_images[0].filename(), "a.png");
  EXPECT_EQ(dataset->camera_images[1].filename(), "b.JPG");
  // With the scenes' own; clouds and camera.yaml need not be there.
  fs::remove(path() / "camera.yaml");
  fs::remove(path() / "scenes/A/cloud.ply");
  const auto images = find_camera_images(path());
  ASSERT_TRUE(images.ok()) << images.error().text();
  EXPECT_EQ(images->images.size(), 6U);
  EXPECT_EQ(images->target, path() / "target.yaml");
  const auto folder = find_camera_images(path() / "intrinsics");
  ASSERT_TRUE(folder.ok());
  EXPECT_EQ(folder->images.size(), 4U);
  EXPECT_THAT(find_camera_images(path() / "scenes/B/cloud.pcd").error().text(),
              HasSubstr("folder not found"));
}

TEST_F(DatasetTest, ImagesForTheCameraAreCopiedAllOrNone) {
  auto dataset = open_dataset(path());
  ASSERT_TRUE(dataset.ok()) << dataset.error().text();
  const fs::path a = folder_.write("pictures/a.png", "first");
  const fs::path b = folder_.write("pictures/b.jpg", "second");
  ASSERT_TRUE(add_camera_images(*dataset, {a, b}).ok());
  ASSERT_EQ(dataset->camera_images.size(), 2U);
  EXPECT_EQ(dataset->camera_images, open_dataset(path())->camera_images);
  EXPECT_EQ(*read_text_file(path() / "intrinsics/b.jpg", 100), "second");
  // The same once more is no error, and changes nothing.
  const auto before = fs::last_write_time(path() / "intrinsics/a.png");
  ASSERT_TRUE(add_camera_images(*dataset, {a}).ok());
  EXPECT_EQ(dataset->camera_images.size(), 2U);
  EXPECT_EQ(fs::last_write_time(path() / "intrinsics/a.png"), before);
  // What cannot be taken leaves all as it is.
  const fs::path c = folder_.write("pictures/c.png", "third");
  const fs::path other = folder_.write("elsewhere/a.png", "another");
  const auto refused = [&](const std::vector<fs::path>& images, const char* why) {
    const Status s = add_camera_images(*dataset, images);
    ASSERT_FALSE(s.ok()) << why;
    EXPECT_THAT(s.error().text(), HasSubstr(why));
    EXPECT_FALSE(fs::exists(path() / "intrinsics/c.png")) << why;
    EXPECT_EQ(*read_text_file(path() / "intrinsics/a.png", 100), "first");
    EXPECT_EQ(dataset->camera_images.size(), 2U);
  };
  refused({c, other}, "another image of this name");
  refused({c, folder_.write("elsewhere/c.png", "no copy of it")}, "another image of this name");
  refused({c, folder_.write("pictures/notes.txt", "")}, "not an image");
  refused({c, folder_.path() / "pictures/none.png"}, "none.png");
}

TEST_F(DatasetTest, MissingTarget) {
  EXPECT_THAT(without("target.yaml").text(), HasSubstr("target.yaml"));
}

TEST_F(DatasetTest, MissingCamera) {
  EXPECT_THAT(without("camera.yaml").text(), HasSubstr("camera.yaml"));
}

TEST_F(DatasetTest, MissingScenesFolder) {
  const Error error = without("scenes");
  EXPECT_EQ(error.kind, ErrorKind::kInput);
  EXPECT_THAT(error.text(), HasSubstr("scenes"));
  EXPECT_THAT(error.text(), HasSubstr("one folder per scene"));
}

TEST_F(DatasetTest, MissingImage) {
  const Error error = without("scenes/B/image.png");
  EXPECT_THAT(error.text(), HasSubstr("no image"));
  EXPECT_THAT(error.where, HasSubstr("B"));
}

TEST_F(DatasetTest, MissingCloud) {
  const Error error = without("scenes/B/cloud.pcd");
  EXPECT_THAT(error.text(), HasSubstr("no cloud"));
  EXPECT_THAT(error.where, HasSubstr("B"));
}

TEST_F(DatasetTest, NoScenesAndNoFolder) {
  fs::remove_all(path() / "scenes/A");
  EXPECT_THAT(without("scenes/B").text(), HasSubstr("no scenes"));
  EXPECT_THAT(open_dataset(path() / "nowhere").error().text(), HasSubstr("nowhere"));
  EXPECT_FALSE(open_dataset(folder_.write("file", "")).ok());
}

TEST_F(DatasetTest, SaysWhatADatasetIsOfAnyOtherFolder) {
  const Error error = open_dataset(folder_.write("holiday/beach.jpg", "").parent_path()).error();
  EXPECT_EQ(error.kind, ErrorKind::kInput);
  for (const char* part : {"no dataset", "target.yaml", "camera.yaml", "scenes/NAME/"})
    EXPECT_THAT(error.message, HasSubstr(part));
}

TEST_F(DatasetTest, AnIncompleteSceneIsLeftOutIfWanted) {
  fs::remove(path() / "scenes/B/cloud.pcd");
  EXPECT_FALSE(open_dataset(path()).ok());
  const auto dataset = open_dataset(path(), UnusableScenes::kLeaveOut);
  ASSERT_TRUE(dataset.ok());
  ASSERT_EQ(dataset->scenes.size(), 2U);
  EXPECT_FALSE(dataset->scenes[0].problem);
  ASSERT_TRUE(dataset->scenes[1].problem);
  EXPECT_THAT(dataset->scenes[1].problem->text(), HasSubstr("no cloud"));
}

TEST_F(DatasetTest, HiddenFoldersAndLooseFilesAreNoScenes) {
  folder_.write("d/scenes/.cache/x", "");
  folder_.write("d/scenes/notes.txt", "");
  const auto dataset = open_dataset(path());
  ASSERT_TRUE(dataset.ok());
  EXPECT_EQ(dataset->scenes.size(), 2U);
}

TEST_F(DatasetTest, UnknownKeysWarn) {
  folder_.write("d/target.yaml", to_yaml(Target{}) + "tagSpacin: 3\n");
  const auto dataset = open_dataset(path());
  ASSERT_TRUE(dataset.ok());
  ASSERT_EQ(dataset->warnings.size(), 1U);
  EXPECT_THAT(dataset->warnings[0], HasSubstr("tagSpacin"));
}

TEST_F(DatasetTest, FilesThatCouldBeASceneSImageOrCloudAsWellWarn) {
  folder_.write("d/scenes/B/image.jpg", "");
  folder_.write("d/scenes/B/cloud.ply", "");
  const auto dataset = open_dataset(path());
  ASSERT_TRUE(dataset.ok());
  ASSERT_EQ(dataset->warnings.size(), 2U);
  EXPECT_EQ(dataset->warnings[0].text(),
            "scene B has image.png and image.jpg: image.png is used; delete the other");
  EXPECT_EQ(dataset->warnings[1].text(),
            "scene B has cloud.pcd and cloud.ply: cloud.pcd is used; delete the other");
}

TEST_F(DatasetTest, ReadsTheRoughExtrinsicBesideIt) {
  folder_.write("d/rig.yaml", "T_camera_lidar: [0, -1, 0, 0.1, 0, 0, -1, 0.2, 1, 0, 0, 0.3]\n");
  const auto dataset = open_dataset(path());
  ASSERT_TRUE(dataset.ok());
  ASSERT_TRUE(dataset->rough_camera_from_lidar.has_value());
  EXPECT_EQ(dataset->rough_camera_from_lidar->translation, Eigen::Vector3d(0.1, 0.2, 0.3));
  folder_.write("d/rig.yaml", "T_camera_lidar: [1, 2]\n");
  EXPECT_FALSE(open_dataset(path()).ok());
}

TEST(RoughExtrinsic, AllFormsMeanTheSame) {
  const test::TemporaryFolder folder;
  const Rigid3 truth{Eigen::Quaterniond(0.5, 0.5, -0.5, 0.5), {0.1, 0.2, 0.3}};
  const std::string rows = "[[0, -1, 0, 0.1], [0, 0, -1, 0.2], [1, 0, 0, 0.3]";
  for (const std::string& text :
       {"T_camera_lidar: " + rows + "]\n", "T_camera_lidar: " + rows + ", [0, 0, 0, 1]]\n",
        "T_camera_lidar:\n  matrix: " + rows + "]\n",
        std::string("T_camera_lidar: {translation_m: [0.1, 0.2, 0.3], quaternion_xyzw: [0.5, -0.5, "
                    "0.5, 0.5]}\n")}) {
    const auto rough = read_rough_extrinsic(folder.write("rig.yaml", text));
    ASSERT_TRUE(rough.ok()) << text << rough.error().text();
    EXPECT_THAT(*rough, test::IsNearPose(truth, 1e-9, 1e-5)) << text;
  }
}

TEST(RoughExtrinsic, RefusesWhatIsNoRigidTransform) {
  const test::TemporaryFolder folder;
  for (const std::string text :
       {"T_camera_lidar: [[2, 0, 0, 0], [0, 2, 0, 0], [0, 0, 2, 0]]\n",   // a scale
        "T_camera_lidar: [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, -1, 0]]\n",  // a mirror
        "T_camera_lidar: [1, 2, 3]\n", "T_camera_lidar: text\n", "T_camera_lidar:\n",
        "T_lidar_camera: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0]\n",
        "T_camera_lidar: [.nan, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0]\n",
        "T_camera_lidar: {translation_m: [0, 0, 0]}\n",
        "T_camera_lidar: {translation_m: [0, 0, 0], quaternion_xyzw: [0, 0, 0, 0]}\n",
        "T_camera_lidar: {translation_m: [0, 0], quaternion_xyzw: [0, 0, 0, 1]}\n"}) {
    const auto rough = read_rough_extrinsic(folder.write("rig.yaml", text));
    ASSERT_FALSE(rough.ok()) << text;
    EXPECT_EQ(rough.error().kind, ErrorKind::kInput);
    EXPECT_THAT(rough.error().text(), HasSubstr("rig.yaml")) << text;
  }
  EXPECT_FALSE(read_rough_extrinsic(folder.path() / "none.yaml").ok());
}

}  // namespace
}  // namespace lvcalib
