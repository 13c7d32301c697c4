// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulation/dataset_writer.h"

#include <algorithm>
#include <fstream>
#include <set>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "base/file_io.h"
#include "camera/camera.h"
#include "cloud/cloud.h"
#include "support/image_files.h"

namespace lvcalib::simulation {
namespace {

namespace fs = std::filesystem;

class DatasetFolder : public testing::Test {
 protected:
  void SetUp() override {
    const auto* info = testing::UnitTest::GetInstance()->current_test_info();
    folder = fs::path(testing::TempDir()) / (std::string("lvcalib-dataset-") + info->name());
    fs::remove_all(folder);
    fs::create_directories(folder);
    options.scenes = 2;
    options.lidar.points = 3'000;
    options.image.width_px = 400;
    options.image.height_px = 300;
  }
  void TearDown() override { fs::remove_all(folder); }

  [[nodiscard]] SimulatedRig rig() const { return *simulate(options, {}); }
  [[nodiscard]] std::vector<std::string> contents() const {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder)) {
      names.push_back(entry.path().filename().string());
    }
    std::sort(names.begin(), names.end());
    return names;
  }
  [[nodiscard]] nlohmann::json truth() const {
    std::ifstream stream(folder / "set-truth.json");
    return nlohmann::json::parse(stream);
  }

  fs::path folder;
  SimulationOptions options;
};

TEST_F(DatasetFolder, HoldsWhatWasSimulated) {
  const SimulatedRig made = rig();
  ASSERT_TRUE(write_dataset(made, folder / "set").ok());
  EXPECT_EQ(contents(), (std::vector<std::string>{"set", "set-truth.json"}));
  const auto camera = read_camera(folder / "set/camera.yaml");
  ASSERT_TRUE(camera.ok());
  EXPECT_EQ(camera->camera.fx, made.camera.fx);
  EXPECT_EQ(camera->camera.distortion, made.camera.distortion);
  const auto target = read_target(folder / "set/target.yaml");
  ASSERT_TRUE(target.ok());
  EXPECT_EQ(target->target.circle_radius_m, made.target.circle_radius_m);
  const SimulatedScene& scene = made.scenes[1];
  const auto cloud = read_cloud(folder / "set/scenes/B/cloud.pcd");
  ASSERT_TRUE(cloud.ok());
  EXPECT_EQ(cloud->points_m, scene.cloud.points_m);
  EXPECT_EQ(cloud->intensity, scene.cloud.intensity);
  EXPECT_EQ(cloud->line, scene.cloud.line);
  EXPECT_TRUE(cloud->has_time());
  const cv::Mat image = test::read_pixels(folder / "set/scenes/B/image.png");
  ASSERT_EQ(image.type(), CV_8U);
  EXPECT_TRUE(std::equal(image.begin<std::uint8_t>(), image.end<std::uint8_t>(),
                         scene.image.pixels.begin(), scene.image.pixels.end()));
}

TEST_F(DatasetFolder, TruthHasTheTransforms) {
  const SimulatedRig made = rig();
  ASSERT_TRUE(write_dataset(made, folder / "set").ok());
  const auto json = truth();
  EXPECT_TRUE(json["effects"].is_object() && json["effects"].empty());
  ASSERT_EQ(json["T_CL"].size(), 3U);
  ASSERT_EQ(json["T_CL"][0].size(), 4U);
  EXPECT_EQ(json["T_CL"][1][3].get<double>(), made.camera_from_lidar.translation.y());
  const auto& scene = json["scenes"]["A"];
  const Eigen::Matrix4d expected = made.scenes[0].lidar_from_board.matrix();
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 4; ++column) {
      EXPECT_EQ(scene["T_LB"][static_cast<std::size_t>(row)][static_cast<std::size_t>(column)]
                    .get<double>(),
                expected(row, column));
    }
  }
  EXPECT_TRUE(scene.contains("T_CB"));
}

TEST_F(DatasetFolder, TruthHasTheEffectsAndTheFilesDoNot) {
  ASSERT_TRUE(write_dataset(rig(), folder / "plain").ok());
  options.effects = {{"range_walk", 12.5}, {"print_scale", 3000.0}, {"intrinsics_error", 1000.0}};
  ASSERT_TRUE(write_dataset(rig(), folder / "set").ok());
  const auto json = truth();
  EXPECT_EQ(json["effects"].size(), 3U);
  EXPECT_EQ(json["effects"]["range_walk"], 12.5);
  EXPECT_EQ(json["effects"]["print_scale"], 3000.0);
  const auto& details = json["effect_details"];
  EXPECT_TRUE(details["range_walk"]["pulse_width_mm"].is_number());
  EXPECT_EQ(details["intrinsics_error"]["principal_point_px"].size(), 2U);
  for (const char* name : {"camera.yaml", "target.yaml"}) {
    EXPECT_EQ(*read_text_file(folder / "set" / name, 1U << 20U),
              *read_text_file(folder / "plain" / name, 1U << 20U));
  }
}

TEST_F(DatasetFolder, CloudsOfSeveralLinesCarryLineAndTime) {
  options.scenes = 1;
  for (const LidarKind kind : {LidarKind::kAvia, LidarKind::kSpinning}) {
    options.lidar.kind = kind;
    ASSERT_TRUE(write_dataset(rig(), folder / "set", true).ok());
    const auto cloud = read_cloud(folder / "set/scenes/A/cloud.pcd");
    ASSERT_TRUE(cloud.ok());
    ASSERT_TRUE(cloud->has_time() && cloud->has_line());
    const std::set<std::uint16_t> lines(cloud->line.begin(), cloud->line.end());
    EXPECT_EQ(lines.size(), kind == LidarKind::kAvia ? 6U : 128U);
    EXPECT_TRUE(std::is_sorted(cloud->time_s.begin(), cloud->time_s.end()));
    EXPECT_GT(cloud->time_s.back(), cloud->time_s.front());
  }
}

TEST_F(DatasetFolder, AbsentBoardHasNoPose) {
  options.placement.board = false;
  ASSERT_TRUE(write_dataset(rig(), folder / "set").ok());
  EXPECT_FALSE(truth()["scenes"]["A"].contains("T_CB"));
}

TEST_F(DatasetFolder, OverwritesSimulatedDatasetsOnlyAndOnlyIfForced) {
  ASSERT_TRUE(write_dataset(rig(), folder / "set").ok());
  const Status again = write_dataset(rig(), folder / "set");
  ASSERT_FALSE(again.ok());
  EXPECT_EQ(again.error().kind, ErrorKind::kOutput);
  options.seed = 9;
  ASSERT_TRUE(write_dataset(rig(), folder / "set/", true).ok());
  EXPECT_EQ(truth()["seed"], 9);
  // Somebody's own file in it: hands off, even if forced.
  std::ofstream(folder / "set/notes.txt") << "mine";
  EXPECT_FALSE(write_dataset(rig(), folder / "set", true).ok());
  EXPECT_TRUE(fs::exists(folder / "set/notes.txt"));
  std::ofstream(folder / "file") << "x";
  EXPECT_FALSE(write_dataset(rig(), folder / "file", true).ok());
  EXPECT_EQ(contents(), (std::vector<std::string>{"file", "set", "set-truth.json"}));
}

TEST_F(DatasetFolder, UnfinishedWriterLeavesNothing) {
  const SimulatedRig made = rig();
  {
    auto writer = DatasetWriter::create(made, folder / "set", false);
    ASSERT_TRUE(writer.ok());
    ASSERT_TRUE(writer->add(made.scenes[0]).ok());
    EXPECT_FALSE(contents().empty());
    EXPECT_FALSE(fs::exists(folder / "set"));
  }
  EXPECT_TRUE(contents().empty());
}

TEST_F(DatasetFolder, EmptyImageIsNoPng) {
  EXPECT_FALSE(encode_png({10, 10, {}}).ok());
}

}  // namespace
}  // namespace lvcalib::simulation
