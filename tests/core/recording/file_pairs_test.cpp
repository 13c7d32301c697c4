// SPDX-License-Identifier: GPL-3.0-or-later
#include "recording/file_pairs.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/temporary_folder.h"

namespace lvcalib {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

class FilePairs : public ::testing::Test {
 protected:
  void touch(const std::vector<std::string>& names) const {
    for (const std::string& name : names) folder_.write(name, "x");
  }
  [[nodiscard]] Result<PairedFiles> find(PairRule rule = PairRule::kAuto,
                                         double most_apart_s = 0.0) const {
    PairOptions options;
    options.images = folder_.path();
    options.rule = rule;
    options.most_apart_s = most_apart_s;
    return find_pairs(options);
  }
  // "image cloud" of each pair.
  static std::vector<std::string> names_of(const Result<PairedFiles>& found) {
    EXPECT_TRUE(found.ok()) << (found.ok() ? "" : found.error().text());
    std::vector<std::string> out;
    if (!found) return out;
    for (const FilePair& pair : found->pairs)
      out.push_back(pair.image.filename().string() + " " + pair.cloud.filename().string());
    return out;
  }
  test::TemporaryFolder folder_;
};

TEST_F(FilePairs, OfTheSameNameInOneFolder) {
  touch({"b.png", "a.jpg", "a.pcd", "b.ply", "alone.png", "notes.txt", ".hidden.png"});
  const auto found = find();
  EXPECT_THAT(names_of(found), ElementsAre("a.jpg a.pcd", "b.png b.ply"));
  EXPECT_EQ(found->layout, FileLayout::kSameName);
  ASSERT_EQ(found->unmatched.size(), 1U);
  EXPECT_EQ(found->unmatched[0].name, "alone.png");
  EXPECT_TRUE(looks_like_file_pairs(folder_.path()));
}

TEST_F(FilePairs, OfTheSameNameOrNumberInTwoFolders) {
  touch({"cam/0001.png", "cam/0002.png", "lidar/0002.pcd", "lidar/0003.pcd"});
  EXPECT_THAT(names_of(find()), ElementsAre("0002.png 0002.pcd"));
  EXPECT_TRUE(looks_like_file_pairs(folder_.path()));
  PairOptions options;
  options.images = folder_.path() / "cam";
  options.clouds = folder_.path() / "lidar";
  EXPECT_THAT(names_of(find_pairs(options)), ElementsAre("0002.png 0002.pcd"));
  fs::remove_all(folder_.path() / "lidar");
  touch({"lidar/scan-1.pcd", "lidar/scan-12.pcd"});
  const auto by_number = find();
  EXPECT_THAT(names_of(by_number), ElementsAre("0001.png scan-1.pcd"));
  EXPECT_EQ(by_number->layout, FileLayout::kSameNumber);
}

TEST_F(FilePairs, NumbersThatSeveralFilesHaveMatchNothing) {
  touch({"front-1.png", "rear-1.png", "scan1.pcd"});
  const auto found = find();
  ASSERT_FALSE(found.ok());
  EXPECT_THAT(found.error().text(), HasSubstr("front-1.png, rear-1.png"));
}

TEST_F(FilePairs, ByTheTimesThatAreTheirNames) {
  // 10 Hz against 2 Hz, in different units; the third image comes 0.3 s after any cloud.
  touch({"c/1650000000.000.pcd", "c/1650000000.500.pcd", "c/1650000001.000.pcd"});
  touch({"i/1650000000040000000.png", "i/1650000000140000000.png", "i/1650000000470000000.png",
         "i/1650000001300000000.png"});
  const auto found = find();
  EXPECT_EQ(found->layout, FileLayout::kNearestTime);
  EXPECT_THAT(names_of(found), ElementsAre("1650000000040000000.png 1650000000.000.pcd",
                                           "1650000000470000000.png 1650000000.500.pcd"));
  ASSERT_TRUE(found->pairs[0].apart_s.has_value());
  EXPECT_NEAR(*found->pairs[0].apart_s, -0.04, 1e-5);
  EXPECT_THAT(names_of(find(PairRule::kTime, 0.035)),
              ElementsAre("1650000000470000000.png 1650000000.500.pcd"));
  PairOptions shifted;
  shifted.images = folder_.path();
  shifted.image_time_offset_s = -0.3;
  EXPECT_THAT(names_of(find_pairs(shifted)).back(), "1650000001300000000.png 1650000001.000.pcd");
}

TEST_F(FilePairs, TheRuleThatIsAskedForIsTheOnlyOne) {
  touch({"1650000000.png", "1650000000.pcd", "1650000010.png", "1650000011.pcd"});
  EXPECT_THAT(names_of(find(PairRule::kName)), ElementsAre("1650000000.png 1650000000.pcd"));
  EXPECT_EQ(names_of(find(PairRule::kTime)).size(), 2U);
  touch({"photo.png"});
  const auto found = find(PairRule::kTime);
  ASSERT_FALSE(found.ok());
  EXPECT_THAT(found.error().text(), HasSubstr("are no times"));
}

TEST_F(FilePairs, TimesOfNames) {
  EXPECT_DOUBLE_EQ(time_of_name("1650000000").value_or(0), 1650000000.0);
  EXPECT_DOUBLE_EQ(time_of_name("1650000000250").value_or(0), 1650000000.25);
  EXPECT_DOUBLE_EQ(time_of_name("1650000000.5").value_or(0), 1650000000.5);
  EXPECT_DOUBLE_EQ(time_of_name("12.5").value_or(0), 12.5);
  EXPECT_DOUBLE_EQ(time_of_name("1650000000_500000000").value_or(0), 1650000000.5);
  EXPECT_NEAR(time_of_name("1650000000250000000").value_or(0), 1650000000.25, 1e-6);
  for (const char* name : {"", "0001", "img_5", "1650000000a", "1.2.3", "99999999999999999999"})
    EXPECT_FALSE(time_of_name(name).has_value()) << name;
}

constexpr const char* kKittiCalibration =
    "S_rect_02: 1242 375\nP_rect_02: 721.5 0 609.5 44 0 721.5 172.8 0.2 0 0 1 0\n"
    "S_02: 1392 512\nK_02: 959 0 696 0 956 224 0 0 1\nD_02: -0.3 0.2 0 0 0\n";

TEST_F(FilePairs, KittiRawDrives) {
  const std::string drive = "2011_09_26/2011_09_26_drive_0002_sync/";
  folder_.write("2011_09_26/calib_cam_to_cam.txt", kKittiCalibration);
  touch({drive + "image_00/data/0000000000.png", drive + "image_02/data/0000000000.png",
         drive + "image_02/data/0000000001.png", drive + "image_02/data/0000000002.png",
         drive + "velodyne_points/data/0000000000.bin",
         drive + "velodyne_points/data/0000000002.bin"});
  folder_.write(drive + "image_02/timestamps.txt",
                "2011-09-26 13:02:25.95\n2011-09-26 13:02:26.05\n2011-09-26 23:59:59.99\n");
  folder_.write(drive + "velodyne_points/timestamps.txt",
                "2011-09-26 13:02:25.97\n2011-09-26 13:02:26.07\n2011-09-27 00:00:00.01\n");
  for (const std::string inside : {"", "image_02", "image_02/data"}) {
    PairOptions options;
    options.images = folder_.path() / drive / inside;
    const auto found = find_pairs(options);
    EXPECT_THAT(names_of(found),
                ElementsAre("0000000000.png 0000000000.bin", "0000000002.png 0000000002.bin"));
    EXPECT_EQ(found->layout, FileLayout::kKittiRaw);
    EXPECT_NE(found->pairs[0].image.string().find("image_02"), std::string::npos);
    EXPECT_NEAR(found->pairs[0].apart_s.value_or(9), 0.02, 1e-6);
    EXPECT_NEAR(found->pairs[1].apart_s.value_or(9), 0.02, 1e-6) << "across midnight";
    ASSERT_TRUE(found->camera.has_value());
    EXPECT_EQ(found->camera->width_px, 1242) << "images of sync drives are rectified";
  }
}

TEST_F(FilePairs, SamplesOfCamLidarCalibration) {
  const std::string sample = "data/2022-10-20/";
  touch({sample + "images/pose1.png", sample + "images/pose2.png", sample + "pcd/pose1_full.pcd",
         sample + "pcd/pose1_target.pcd", sample + "pcd/pose2_target.pcd"});
  Camera camera;
  camera.width_px = 640;
  camera.height_px = 480;
  camera.fx = camera.fy = 500.0;
  folder_.write("cfg/camera_info.yaml", to_yaml(camera));
  PairOptions options;
  options.images = folder_.path() / sample;
  options.images = options.images.parent_path();
  const auto found = find_pairs(options);
  EXPECT_THAT(names_of(found), ElementsAre("pose1.png pose1_full.pcd"));
  EXPECT_EQ(found->layout, FileLayout::kCamLidarCalibration);
  EXPECT_EQ(found->pairs[0].board_points.filename(), "pose1_target.pcd");
  ASSERT_TRUE(found->camera.has_value());
  EXPECT_EQ(found->camera->fx, 500.0);
}

TEST_F(FilePairs, BrokenIntrinsicsOfOthersAreAWarning) {
  touch({"a.png", "a.ply", "a_lidar_intensities.png", "a_lidar_indices.png"});
  folder_.write("calib.json", "{}");
  const auto found = find();
  EXPECT_THAT(names_of(found), ElementsAre("a.png a.ply"));
  EXPECT_EQ(found->layout, FileLayout::kDirectVisual);
  EXPECT_FALSE(found->camera.has_value()) << "the image has no size that could be read";
  folder_.write("camera.yaml", "fx: [");
  fs::remove(folder_.path() / "calib.json");
  fs::remove(folder_.path() / "a_lidar_intensities.png");
  fs::remove(folder_.path() / "a_lidar_indices.png");
  const auto plain = find();
  ASSERT_TRUE(plain.ok());
  EXPECT_EQ(plain->warnings.size(), 1U);
}

TEST_F(FilePairs, ImagesWithRecordingsOfFastCalib) {
  touch({"11.jpg", "11.bag", "22.jpg", "22.bag", "33.bag"});
  const auto found = find();
  EXPECT_THAT(names_of(found), ElementsAre("11.jpg 11.bag", "22.jpg 22.bag"));
  EXPECT_EQ(found->layout, FileLayout::kFastCalib);
  EXPECT_TRUE(looks_like_file_pairs(folder_.path()));
}

TEST_F(FilePairs, SaysWhatIsMissing) {
  PairOptions options;
  options.images = folder_.path() / "nothing";
  EXPECT_THAT(find_pairs(options).error().text(), HasSubstr("is no folder"));
  EXPECT_THAT(find().error().text(), HasSubstr("holds no images"));
  touch({"a.png"});
  EXPECT_THAT(find().error().text(), HasSubstr("holds no clouds"));
  EXPECT_FALSE(looks_like_file_pairs(folder_.path()));
  touch({"scenes/01/image.png", "scenes/01/cloud.pcd"});
  EXPECT_FALSE(looks_like_file_pairs(folder_.path())) << "that is a dataset";
}

}  // namespace
}  // namespace lvcalib
