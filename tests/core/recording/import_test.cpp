// SPDX-License-Identifier: GPL-3.0-or-later
#include "recording/import.h"

#include <fstream>
#include <iterator>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/recording/containers.h"
#include "core/recording/walk.h"
#include "pipeline/calibration.h"
#include "pipeline/dataset.h"
#include "simulation/dataset_writer.h"
#include "support/temporary_folder.h"

namespace lvcalib {
namespace {

namespace fs = std::filesystem;
using ::testing::Contains;
using ::testing::HasSubstr;

simulation::SimulatedRig simulated_rig(int scenes, int points, int width_px, int height_px) {
  simulation::SimulationOptions options;
  options.seed = 5;
  options.scenes = scenes;
  options.lidar.points = points;
  options.image.width_px = width_px;
  options.image.height_px = height_px;
  options.placement.min_distance_m = 2.0;
  options.placement.max_distance_m = 2.5;
  auto rig = simulation::simulate(options, {});
  EXPECT_TRUE(rig.ok());
  return std::move(*rig);
}

const simulation::SimulatedRig& small_rig() {
  static const simulation::SimulatedRig rig = simulated_rig(3, 30'000, 480, 320);
  return rig;
}

ImportOptions import_options(const std::string& target_yaml, bool force = false,
                             std::vector<double> scene_times_s = {}) {
  ImportOptions out;
  out.target_yaml = target_yaml;
  out.force = force;
  out.scene_times_s = std::move(scene_times_s);
  return out;
}

nlohmann::json json_of(const fs::path& path) {
  std::ifstream in(path);
  return nlohmann::json::parse(in);
}

class Import : public ::testing::Test {
 protected:
  Recording open(const fs::path& path) const {
    auto recording = Recording::open(path, {});
    EXPECT_TRUE(recording.ok()) << recording.error().text();
    return std::move(*recording);
  }
  Recording record(const std::vector<test::BagMessage>& messages,
                   const test::ContainerCase& container = {}) const {
    return open(test::write_recording(container, folder_.path(), messages));
  }
  [[nodiscard]] Result<ImportSummary> import(const Recording& recording,
                                             const ImportOptions& options = {}) const {
    return import_recording(recording, options, dataset_, {});
  }
  void expect_refused(const Recording& recording, const std::string& why,
                      const ImportOptions& options = {}) const {
    const auto summary = import(recording, options);
    ASSERT_FALSE(summary.ok());
    EXPECT_THAT(summary.error().text(), HasSubstr(why));
    EXPECT_FALSE(fs::exists(dataset_));
    for (const auto& entry : fs::directory_iterator(folder_.path())) {
      EXPECT_EQ(entry.path().string().find(".part"), std::string::npos) << entry.path();
    }
  }
  test::TemporaryFolder folder_;
  fs::path dataset_ = folder_.path() / "dataset";
};

TEST_F(Import, FindsAllStretchesAndOnlyThem) {
  using C = test::ContainerCase;
  const C containers[] = {{"ros1_lz4", C::kRos1, {.packing = test::Packing::kLz4}, 1},
                          {"mcap_zstd", C::kMcap, {.packing = test::Packing::kZstd}, 1},
                          {"sqlite_split", C::kSqliteFolder, {}, 3}};
  for (const C& container : containers) {
    test::WalkOptions walk;
    walk.wire = test::wire_of(container);
    const Recording recording = record(test::simulated_walk(small_rig(), walk), container);
    const auto summary = import(recording, import_options(to_yaml(Target{}), true));
    ASSERT_TRUE(summary.ok()) << summary.error().text();
    ASSERT_EQ(summary->stretches.size(), 3U) << container.name;
    EXPECT_EQ(summary->scene_count(), 3U);
    for (std::size_t i = 0; i < 3; ++i) {
      const ImportedStretch& s = summary->stretches[i];
      const double begin_s = 2.8 * static_cast<double>(i);
      // The sweeps at either end are not used: they may have seen motion.
      EXPECT_NEAR(s.first_s, begin_s, 0.11);
      EXPECT_NEAR(s.last_s, begin_s + 1.9, 0.11);
      EXPECT_GE(s.sweeps, 17U);
      EXPECT_LE(s.sweeps, 20U);
      EXPECT_GE(s.image_s, s.first_s);
      EXPECT_LE(s.image_s, s.last_s);
      const fs::path scene = dataset_ / "scenes" / s.scene;
      const auto cloud = read_cloud(scene / "cloud.pcd");
      ASSERT_TRUE(cloud.ok());
      EXPECT_EQ(cloud->size(), s.points);
      EXPECT_TRUE(cloud->has_intensity());
      EXPECT_TRUE(cloud->has_line());
      ASSERT_TRUE(cloud->has_time());
      EXPECT_NEAR(cloud->time_s.back(), 0.1 * static_cast<double>(s.sweeps), 0.02);
      EXPECT_TRUE(fs::exists(scene / "image.png"));
    }
    const auto json = json_of(dataset_ / "import.json");
    EXPECT_EQ(json["stretches"].size(), 3U);
    EXPECT_EQ(json["stretches"][0]["taken"], true);
    EXPECT_EQ(json["stretches"][0]["scene"], "001");
    EXPECT_EQ(json["image_topic"], "/camera/image_raw");
    const auto dataset = open_dataset(dataset_);
    ASSERT_TRUE(dataset.ok()) << dataset.error().text();
    EXPECT_EQ(dataset->scenes.size(), 3U);
    EXPECT_EQ(dataset->camera.fx, small_rig().camera.fx);
    EXPECT_EQ(dataset->camera.distortion, small_rig().camera.distortion);
  }
}

TEST_F(Import, CalibratesLikeTheFolderOfItsScenes) {
  const auto rig = simulated_rig(3, 120'000, 1024, 768);
  ASSERT_TRUE(simulation::write_dataset(rig, folder_.path() / "scenes").ok());
  const Recording recording = record(test::simulated_walk(rig, {}));
  const auto summary = import(recording, import_options(to_yaml(rig.target)));
  ASSERT_TRUE(summary.ok()) << summary.error().text();
  ASSERT_EQ(summary->scene_count(), 3U);
  const auto calibrated = [](const fs::path& path) {
    const auto dataset = open_dataset(path);
    EXPECT_TRUE(dataset.ok()) << dataset.error().text();
    auto result = calibrate(*dataset, {}, {});
    EXPECT_TRUE(result.ok()) << result.error().text();
    return result->extrinsic.camera_from_lidar;
  };
  const UncertainRigid3 from_scenes = calibrated(folder_.path() / "scenes");
  const UncertainRigid3 imported = calibrated(dataset_);
  const Vector6d difference = se3_log(imported.transform * from_scenes.transform.inverse());
  const Vector6d error = se3_log(imported.transform * rig.camera_from_lidar.inverse());
  for (int i = 0; i < 6; ++i) {
    const double sigma = std::sqrt(imported.covariance(i, i));
    // Nine tenths of the points are the same ones, and the images differ by added noise: what
    // remains is part of either's standard deviation.
    EXPECT_LT(std::abs(difference[i]), 2.0 * sigma) << i;
    EXPECT_LT(std::abs(error[i]), 4.0 * sigma) << i;
  }
}

TEST_F(Import, TimesOfScenesCanBeGiven) {
  const Recording recording = record(test::simulated_walk(small_rig(), {}));
  const auto summary = import(recording, import_options({}, false, {3.5}));
  ASSERT_TRUE(summary.ok()) << summary.error().text();
  EXPECT_EQ(summary->scene_count(), 1U);
  ASSERT_EQ(summary->stretches.size(), 3U);
  EXPECT_TRUE(summary->stretches[1].taken);
  EXPECT_THAT(summary->stretches[0].reason, HasSubstr("left out by its time"));
  EXPECT_TRUE(fs::exists(dataset_ / "scenes" / "001" / "cloud.pcd"));
  fs::remove_all(dataset_);
  expect_refused(recording, "nothing stands still at 2.40 s",
                 import_options({}, false, {0.5, 2.4}));
}

TEST_F(Import, RepeatsAndBoardsThatAreNotSeenAreLeft) {
  auto rig = small_rig();
  rig.scenes.push_back(rig.scenes[0]);
  const Recording recording = record(test::simulated_walk(rig, {}));
  ImportOptions options;
  int asked = 0;
  options.board_check = [&](const fs::path& image, const Camera& camera) -> Message {
    EXPECT_TRUE(fs::exists(image));
    EXPECT_EQ(camera.width_px, 480);
    return ++asked == 2 ? Message("no tags") : Message();
  };
  const auto summary = import(recording, options);
  ASSERT_TRUE(summary.ok()) << summary.error().text();
  ASSERT_EQ(summary->stretches.size(), 4U);
  EXPECT_EQ(summary->scene_count(), 2U);
  EXPECT_EQ(asked, 3);
  int repeats = 0;
  for (const ImportedStretch& s : summary->stretches) {
    repeats += s.reason.text().find("the same pose") != std::string::npos ? 1 : 0;
  }
  EXPECT_EQ(repeats, 1);
  EXPECT_FALSE(summary->stretches[1].taken);
  EXPECT_THAT(summary->stretches[1].reason, HasSubstr("no tags"));
  EXPECT_FALSE(fs::exists(dataset_ / "scenes" / "003"));
}

TEST_F(Import, GuessedBoardDecidesOnlyWhereItIsSeen) {
  const Recording recording = record(test::simulated_walk(small_rig(), {}));
  ImportOptions options;
  options.force = true;
  options.board_is_certain = false;
  int asked = 0;
  options.board_check = [&](const fs::path&, const Camera&) -> Message {
    return ++asked == 1 ? Message() : Message("no tags");
  };
  const auto one = import(recording, options);
  ASSERT_TRUE(one.ok()) << one.error().text();
  EXPECT_EQ(one->scene_count(), 1U);
  EXPECT_THAT(one->stretches[2].reason, HasSubstr("no tags"));
  EXPECT_FALSE(fs::exists(dataset_ / "scenes" / "002"));
  options.board_check = [](const fs::path&, const Camera&) -> Message {
    return Message("no tags");
  };
  const auto none = import(recording, options);
  ASSERT_TRUE(none.ok());
  EXPECT_EQ(none->scene_count(), 3U);
  EXPECT_THAT(none->warnings, Contains(HasSubstr("default board")));
}

TEST_F(Import, MissingFieldsAreTold) {
  test::WalkOptions walk;
  walk.intensity = false;
  walk.camera_info = false;
  const auto summary = import(record(test::simulated_walk(small_rig(), walk)));
  ASSERT_TRUE(summary.ok()) << summary.error().text();
  EXPECT_THAT(summary->warnings, Contains(HasSubstr("no intensity")));
  EXPECT_THAT(summary->warnings, Contains(HasSubstr("no CameraInfo")));
  EXPECT_FALSE(fs::exists(dataset_ / "camera.yaml"));
  const auto cloud = read_cloud(dataset_ / "scenes" / "001" / "cloud.pcd");
  ASSERT_TRUE(cloud.ok());
  EXPECT_FALSE(cloud->has_intensity());
}

TEST_F(Import, WhatCannotBeImportedLeavesNothing) {
  const auto messages = test::simulated_walk(small_rig(), {});
  auto only = messages;
  std::erase_if(only, [](const auto& m) { return m.topic == "/points"; });
  expect_refused(record(only), "no clouds");
  only = messages;
  std::erase_if(only, [](const auto& m) { return m.topic == "/camera/image_raw"; });
  expect_refused(record(only), "no images");
  test::WalkOptions restless;
  restless.still_ticks = 2;
  restless.moving_ticks = 10;
  expect_refused(record(test::simulated_walk(small_rig(), restless)), "never stand still");
  only = messages;
  for (auto& m : only) m.data.resize(m.data.size() / 2);
  expect_refused(record(only), "can be read");
  ImportOptions none;
  none.board_check = [](const fs::path&, const Camera&) { return Message("no tags"); };
  expect_refused(record(messages), "no tags", none);
}

TEST_F(Import, ExistingFoldersAreSafe) {
  const Recording recording = record(test::simulated_walk(small_rig(), {}));
  fs::create_directory(dataset_);
  test::write_bytes(dataset_ / "thesis.tex", "ten years");
  for (const bool force : {false, true}) {
    const auto summary = import(recording, import_options({}, force));
    ASSERT_FALSE(summary.ok());
    EXPECT_THAT(summary.error().text(), HasSubstr("exists already"));
  }
  EXPECT_TRUE(fs::exists(dataset_ / "thesis.tex"));
  fs::remove_all(dataset_);
  ASSERT_TRUE(import(recording).ok());
  EXPECT_FALSE(import(recording).ok());
  EXPECT_TRUE(import(recording, import_options({}, true)).ok());
}

TEST_F(Import, StopLeavesNothing) {
  const Recording recording = record(test::simulated_walk(small_rig(), {}));
  for (const double at : {0.1, 0.6, 0.8}) {
    std::stop_source stop;
    RunContext context;
    context.stop = stop.get_token();
    context.progress = [&](const Progress& p) {
      if (p.fraction >= at) stop.request_stop();
    };
    const auto summary = import_recording(recording, {}, dataset_, context);
    ASSERT_FALSE(summary.ok());
    EXPECT_EQ(summary.error().kind, ErrorKind::kCancelled);
    EXPECT_FALSE(fs::exists(dataset_));
  }
}

}  // namespace
}  // namespace lvcalib
