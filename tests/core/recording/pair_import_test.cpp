// SPDX-License-Identifier: GPL-3.0-or-later
#include "recording/pair_import.h"

#include <cstring>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "base/file_io.h"
#include "cloud/cloud.h"
#include "core/recording/containers.h"
#include "core/recording/walk.h"
#include "pipeline/board_check.h"
#include "pipeline/dataset.h"
#include "simulation/dataset_writer.h"
#include "support/temporary_folder.h"

namespace lvcalib {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

// Three small scenes as a dataset, whose files become those of others.
class PairImport : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    simulation::SimulationOptions options;
    options.seed = 5;
    options.scenes = 3;
    options.lidar.points = 30'000;
    options.image.width_px = 480;
    options.image.height_px = 320;
    options.placement.min_distance_m = 2.0;
    options.placement.max_distance_m = 2.5;
    auto rig = simulation::simulate(options, {});
    ASSERT_TRUE(rig.ok());
    rig_ = new simulation::SimulatedRig(std::move(*rig));
    shared_ = new test::TemporaryFolder;
    ASSERT_TRUE(simulation::write_dataset(*rig_, shared_->path() / "dataset", false).ok());
  }
  static void TearDownTestSuite() {
    delete shared_;
    delete rig_;
  }
  static fs::path file(std::size_t scene, const char* name) {
    return shared_->path() / "dataset" / "scenes" / rig_->scenes[scene].name / name;
  }
  // As files of the same name, in two folders.
  [[nodiscard]] PairedFiles pairs() const {
    fs::create_directories(folder_.path() / "images");
    fs::create_directories(folder_.path() / "clouds");
    for (std::size_t i = 0; i < 3; ++i) {
      const std::string stem = "pose" + std::to_string(i);
      fs::copy_file(file(i, "image.png"), folder_.path() / "images" / (stem + ".png"),
                    fs::copy_options::overwrite_existing);
      fs::copy_file(file(i, "cloud.pcd"), folder_.path() / "clouds" / (stem + ".pcd"),
                    fs::copy_options::overwrite_existing);
    }
    return found();
  }
  [[nodiscard]] PairedFiles found() const {
    PairOptions options;
    options.images = folder_.path();
    auto out = find_pairs(options);
    EXPECT_TRUE(out.ok()) << (out.ok() ? "" : out.error().text());
    return out ? *out : PairedFiles{};
  }
  [[nodiscard]] PairImportOptions options() const {
    PairImportOptions out;
    out.target_yaml = to_yaml(rig_->target);
    out.camera = rig_->camera;
    return out;
  }
  [[nodiscard]] fs::path dataset() const { return folder_.path() / "made"; }
  [[nodiscard]] nlohmann::json json() const {
    std::ifstream in(dataset() / "import.json");
    return nlohmann::json::parse(in);
  }

  static inline simulation::SimulatedRig* rig_ = nullptr;
  static inline test::TemporaryFolder* shared_ = nullptr;
  test::TemporaryFolder folder_;
};

std::string bytes_of(const fs::path& path) {
  return *read_text_file(path, 1U << 30U);
}

TEST_F(PairImport, FilesStayAsTheyAreAndTheDatasetOpens) {
  const auto files = pairs();
  const auto summary = import_pairs(files, options(), dataset(), {});
  ASSERT_TRUE(summary.ok()) << summary.error().text();
  EXPECT_EQ(summary->scene_count(), 3U);
  EXPECT_TRUE(summary->has_camera);
  const auto opened = open_dataset(dataset());
  ASSERT_TRUE(opened.ok()) << opened.error().text();
  ASSERT_EQ(opened->scenes.size(), 3U);
  EXPECT_EQ(opened->scenes[1].name, "pose1");
  EXPECT_EQ(bytes_of(opened->scenes[1].image), bytes_of(file(1, "image.png")));
  EXPECT_EQ(bytes_of(opened->scenes[1].cloud), bytes_of(file(1, "cloud.pcd")));
  EXPECT_EQ(opened->camera.fx, rig_->camera.fx);
  EXPECT_EQ(json()["pairs"][2]["scene"], "pose2");
  EXPECT_TRUE(json()["pairs"][2]["taken"].get<bool>());
  // Once more only if it may be replaced.
  EXPECT_FALSE(import_pairs(files, options(), dataset(), {}).ok());
  PairImportOptions again = options();
  again.force = true;
  EXPECT_TRUE(import_pairs(files, again, dataset(), {}).ok());
}

TEST_F(PairImport, PairsAreAddedToAnImportWithoutPartsOfScenes) {
  const PairedFiles all = pairs();
  PairedFiles first = all;
  first.pairs.resize(1);
  ASSERT_TRUE(import_pairs(first, options(), dataset(), {}).ok());
  folder_.write("clouds/pose2.pcd", "# .PCD v0.7\nnothing");
  const auto added = add_pairs(all.pairs, options(), dataset(), {});
  ASSERT_TRUE(added.ok()) << added.error().text();
  ASSERT_EQ(added->pairs.size(), 3U);
  EXPECT_EQ(added->scene_count(), 1U);
  EXPECT_THAT(added->pairs[0].reason, HasSubstr("already a scene"));
  EXPECT_TRUE(added->pairs[1].taken);
  EXPECT_FALSE(added->pairs[2].reason.empty());
  const auto opened = open_dataset(dataset());
  ASSERT_TRUE(opened.ok()) << opened.error().text();
  ASSERT_EQ(opened->scenes.size(), 2U);
  EXPECT_EQ(bytes_of(opened->scenes[1].image), bytes_of(file(1, "image.png")));
  EXPECT_EQ(bytes_of(opened->scenes[1].cloud), bytes_of(file(1, "cloud.pcd")));
  // Nothing else, hidden or not.
  EXPECT_EQ(std::distance(fs::directory_iterator(dataset() / "scenes"), {}), 2);
  ASSERT_EQ(json()["pairs"].size(), 4U);
  EXPECT_EQ(json()["pairs"][2]["scene"], "pose1");
  EXPECT_TRUE(json()["pairs"][2]["taken"].get<bool>());
  EXPECT_FALSE(json()["pairs"][3]["taken"].get<bool>());
}

// Files that stay as they are may be cut or too long: said when they are read, and kept.
TEST_F(PairImport, CloudsThatMayNotBeWholeAreTold) {
  EXPECT_EQ(pairs().pairs.size(), 3U);
  const auto lengthen = [&](const std::string& name) {
    folder_.write("clouds/" + name, bytes_of(folder_.path() / "clouds" / name) + "twelve bytes");
  };
  lengthen("pose1.pcd");
  const PairedFiles all = found();
  PairedFiles first = all;
  first.pairs.resize(2);
  const auto summary = import_pairs(first, options(), dataset(), {});
  ASSERT_TRUE(summary.ok()) << summary.error().text();
  ASSERT_EQ(summary->warnings.size(), 1U);
  EXPECT_THAT(summary->warnings[0].text(), HasSubstr("scene pose1: its cloud: 12 bytes follow"));
  EXPECT_EQ(json()["warnings"][0], summary->warnings[0].text());
  lengthen("pose2.pcd");
  const auto added = add_pairs({all.pairs[2]}, options(), dataset(), {});
  ASSERT_TRUE(added.ok()) << added.error().text();
  ASSERT_EQ(added->warnings.size(), 1U);
  EXPECT_THAT(json()["warnings"][1], HasSubstr("scene pose2: its cloud: 12 bytes follow"));
}

TEST_F(PairImport, AddingWatchesTheCameraTheBoardAndTheStop) {
  const PairedFiles all = pairs();
  PairedFiles first = all;
  first.pairs.resize(1);
  ASSERT_TRUE(import_pairs(first, options(), dataset(), {}).ok());
  PairImportOptions unlike = options();
  unlike.camera->width_px += 2;
  auto added = add_pairs({all.pairs[1]}, unlike, dataset(), {});
  ASSERT_TRUE(added.ok());
  EXPECT_THAT(added->pairs[0].reason, HasSubstr("the camera's have"));
  PairImportOptions checked = options();
  checked.board_check = [](const fs::path&, const Camera&) { return Message("too dark"); };
  added = add_pairs({all.pairs[1]}, checked, dataset(), {});
  ASSERT_TRUE(added.ok());
  EXPECT_THAT(added->pairs[0].reason, HasSubstr("too dark"));
  std::stop_source stop;
  stop.request_stop();
  RunContext context;
  context.stop = stop.get_token();
  EXPECT_EQ(add_pairs({all.pairs[1]}, options(), dataset(), context).error().kind,
            ErrorKind::kCancelled);
  EXPECT_FALSE(add_pairs(all.pairs, options(), folder_.path() / "none", {}).ok());
  EXPECT_EQ(std::distance(fs::directory_iterator(dataset() / "scenes"), {}), 1);
}

// A dataset that nobody imported must not become one that may be replaced.
TEST_F(PairImport, ADatasetMadeByHandStaysOne) {
  const PairedFiles all = pairs();
  const fs::path made = folder_.path() / "by-hand";
  fs::create_directories(made / "scenes");
  const auto added = add_pairs({all.pairs[2]}, options(), made, {});
  ASSERT_TRUE(added.ok()) << added.error().text();
  EXPECT_EQ(added->scene_count(), 1U);
  EXPECT_FALSE(fs::exists(made / "import.json"));
  EXPECT_TRUE(fs::exists(made / "scenes" / "pose2" / "cloud.pcd"));
}

TEST_F(PairImport, WhatCannotBeUsedIsLeftWithItsReason) {
  auto files = pairs();
  folder_.write("clouds/pose0.pcd", "# .PCD v0.7\nnothing");
  folder_.write("images/pose2.png", "no image");
  const auto summary = import_pairs(files, options(), dataset(), {});
  ASSERT_TRUE(summary.ok()) << summary.error().text();
  EXPECT_EQ(summary->scene_count(), 1U);
  EXPECT_FALSE(summary->pairs[0].taken);
  EXPECT_FALSE(summary->pairs[0].reason.empty());
  EXPECT_FALSE(summary->pairs[2].reason.empty());
  EXPECT_FALSE(fs::exists(dataset() / "scenes" / "pose0"));
  // Of another camera.
  PairImportOptions other = options();
  other.camera->width_px = 1000;
  const auto none = import_pairs(files, other, folder_.path() / "none", {});
  ASSERT_FALSE(none.ok());
  EXPECT_THAT(none.error().text(), HasSubstr("480 × 320 px, the camera's have 1000 × 320"));
  EXPECT_FALSE(fs::exists(folder_.path() / "none"));
}

TEST_F(PairImport, PairsWithoutTheBoardAreLeftUnlessTheBoardIsAGuess) {
  auto files = pairs();
  PairImportOptions certain = options();
  certain.board_check = make_board_check(rig_->target, {});
  const auto summary = import_pairs(files, certain, dataset(), {});
  ASSERT_TRUE(summary.ok()) << summary.error().text();
  EXPECT_EQ(summary->scene_count(), 3U);
  Target other = rig_->target;
  other.first_tag_id = 200;
  PairImportOptions wrong = options();
  wrong.board_check = make_board_check(other, {});
  const auto refused = import_pairs(files, wrong, folder_.path() / "none", {});
  ASSERT_FALSE(refused.ok());
  EXPECT_THAT(refused.error().text(), HasSubstr("the board is not found"));
  wrong.board_is_certain = false;
  const auto guessed = import_pairs(files, wrong, folder_.path() / "guessed", {});
  ASSERT_TRUE(guessed.ok()) << guessed.error().text();
  EXPECT_EQ(guessed->scene_count(), 3U);
  EXPECT_THAT(guessed->warnings,
              ::testing::Contains(HasSubstr("no scene shows the default board")));
}

TEST_F(PairImport, KittiPointsBecomePcd) {
  const std::string drive = "2011_09_26_drive_0001_extract/";
  const Cloud& cloud = rig_->scenes[0].cloud;
  std::string bytes;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const float row[4] = {cloud.points_m[i].x(), cloud.points_m[i].y(), cloud.points_m[i].z(),
                          cloud.intensity[i]};
    bytes.append(reinterpret_cast<const char*>(row), sizeof row);
  }
  folder_.write(drive + "velodyne_points/data/0000000007.bin", bytes);
  fs::create_directories(folder_.path() / drive / "image_02" / "data");
  fs::copy_file(file(0, "image.png"),
                folder_.path() / drive / "image_02" / "data" / "0000000007.png");
  PairOptions where;
  where.images = folder_.path() / "2011_09_26_drive_0001_extract";
  const auto files = find_pairs(where);
  ASSERT_TRUE(files.ok()) << files.error().text();
  const auto summary = import_pairs(*files, options(), dataset(), {});
  ASSERT_TRUE(summary.ok()) << summary.error().text();
  const auto read = read_cloud(dataset() / "scenes" / "0000000007" / "cloud.pcd");
  ASSERT_TRUE(read.ok());
  EXPECT_EQ(read->points_m, cloud.points_m);
  EXPECT_EQ(read->intensity, cloud.intensity);
}

TEST_F(PairImport, ARecordingOfOnePoseIsOneCloud) {
  simulation::SimulatedRig one = *rig_;
  one.scenes.resize(1);
  test::WalkOptions walk;
  walk.moving_ticks = 0;
  auto messages = test::simulated_walk(one, walk);
  std::erase_if(messages, [](const test::BagMessage& m) { return m.topic != "/points"; });
  test::write_bytes(folder_.path() / "11.bag", test::ros1_bag(messages, {}));
  fs::copy_file(file(0, "image.png"), folder_.path() / "11.png");
  const auto files = found();
  EXPECT_EQ(files.layout, FileLayout::kFastCalib);
  const auto summary = import_pairs(files, options(), dataset(), {});
  ASSERT_TRUE(summary.ok()) << summary.error().text();
  const auto read = read_cloud(dataset() / "scenes" / "11" / "cloud.pcd");
  ASSERT_TRUE(read.ok());
  EXPECT_EQ(read->size(), rig_->scenes[0].cloud.size());
  EXPECT_TRUE(read->has_intensity() && read->has_time() && read->has_line());
  EXPECT_NEAR(*std::max_element(read->time_s.begin(), read->time_s.end()), 2.0, 0.01);
}

TEST_F(PairImport, AStopLeavesNothing) {
  const auto files = pairs();
  std::stop_source stop;
  RunContext context;
  context.stop = stop.get_token();
  context.progress = [&](const Progress& p) {
    if (p.fraction > 0.5) stop.request_stop();
  };
  const auto summary = import_pairs(files, options(), dataset(), context);
  ASSERT_FALSE(summary.ok());
  EXPECT_EQ(summary.error().kind, ErrorKind::kCancelled);
  EXPECT_FALSE(fs::exists(dataset()));
  for (const auto& entry : fs::directory_iterator(folder_.path()))
    EXPECT_EQ(entry.path().string().find(".part"), std::string::npos);
}

}  // namespace
}  // namespace lvcalib
