// SPDX-License-Identifier: GPL-3.0-or-later
// import, as a user runs it: what a recording holds, a dataset of it, and what can be wrong.
#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "cli/child_process.h"
#include "cli/good_dataset.h"
#include "core/recording/walk.h"
#include "simulation/simulator.h"
#include "support/bag_writer.h"

namespace lvcalib::testing {
namespace {
namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;

// A bag of two rests, written once.
const fs::path& bag() {
  static const TemporaryFolder folder("import_bag");
  static const fs::path path = [] {
    simulation::SimulationOptions options;
    options.seed = 3;
    options.scenes = 2;
    options.lidar.points = 30'000;
    options.image.width_px = 800;
    options.image.height_px = 600;
    options.placement.max_distance_m = 2.5;
    const auto rig = simulation::simulate(options, {});
    EXPECT_TRUE(rig.ok());
    test::write_bytes(folder.path() / "walk.bag", test::ros1_bag(test::simulated_walk(*rig, {})));
    return folder.path() / "walk.bag";
  }();
  return path;
}

class ImportCommand : public ::testing::Test {
 protected:
  [[nodiscard]] Outcome import(const fs::path& recording,
                               const std::vector<std::string>& more = {}) const {
    std::vector<std::string> arguments = {"import", recording, "-o", dataset_};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_lvcalib(arguments);
  }
  void expect_refused(const Outcome& outcome, int status, const std::string& what) const {
    expect_refusal(outcome, status, what, dataset_);
    EXPECT_TRUE(unfinished_files(folder_.path()).empty());
  }
  TemporaryFolder folder_{"import"};
  fs::path dataset_ = folder_.path() / "dataset";
};

TEST_F(ImportCommand, ListsTopics) {
  const Outcome outcome = run_lvcalib({"import", bag(), "--list"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("ROS 1 bag, 5.5 s, 3 topics\n"));
  EXPECT_THAT(outcome.out, HasSubstr("topic\n"));
  EXPECT_EQ(std::count(outcome.out.begin(), outcome.out.end(), '\n'), 2 + 3);
  EXPECT_THAT(outcome.out, HasSubstr("sensor_msgs/PointCloud2      /points"));
  EXPECT_THAT(outcome.out, HasSubstr("10.00"));
  EXPECT_THAT(outcome.err, Not(HasSubstr("warning")));
}

TEST_F(ImportCommand, MakesADatasetOfImagesAndCloudsInFolders) {
  const fs::path good = good_dataset();
  const fs::path files = folder_.path() / "files";
  fs::create_directories(files / "images");
  fs::create_directories(files / "clouds");
  int scenes = 0;
  for (const auto& scene : fs::directory_iterator(good / "scenes")) {
    const std::string name = scene.path().filename().string();
    fs::copy_file(scene.path() / "image.png", files / "images" / (name + ".png"));
    fs::copy_file(scene.path() / "cloud.pcd", files / "clouds" / (name + ".pcd"));
    ++scenes;
  }
  fs::copy_file(good / "camera.yaml", files / "camera.yaml");
  fs::copy_file(good / "target.yaml", files / "target.yaml");
  write_file(files / "images" / "alone.png", "x");
  const Outcome listed = run_lvcalib({"import", files, "--list"});
  ASSERT_EQ(listed.status, 0) << listed.err;
  EXPECT_THAT(listed.out, HasSubstr("files of the same name"));
  EXPECT_EQ(std::count(listed.out.begin(), listed.out.end(), '\n'), 1 + scenes);
  const Outcome outcome = import(files);
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr(std::to_string(scenes) + " scenes of"));
  EXPECT_THAT(outcome.err, HasSubstr("alone.png"));
  for (const char* name : {"target.yaml", "camera.yaml", "import.json"})
    EXPECT_TRUE(fs::exists(dataset_ / name)) << name;
}

TEST_F(ImportCommand, FoldersWhoseFilesDoNotBelongTogetherAreRefused) {
  fs::create_directories(folder_.path() / "i");
  fs::create_directories(folder_.path() / "c");
  write_file(folder_.path() / "i" / "front.png", "x");
  write_file(folder_.path() / "c" / "scan.pcd", "x");
  expect_refused(import(folder_.path() / "i", {"--clouds", folder_.path() / "c"}), 3,
                 "no image and cloud belong together");
  expect_refused(import(folder_.path() / "i", {"--clouds", folder_.path() / "none"}), 3,
                 "is no folder");
  expect_refused(
      import(folder_.path() / "i", {"--clouds", folder_.path() / "c", "--match", "guess"}), 2,
      "--match");
}

TEST_F(ImportCommand, WritesADatasetAndSaysWhatBecameOfEachStretch) {
  write_file(folder_.path() / "target.yaml", to_yaml(Target{}));
  const Outcome outcome = import(bag(), {"--target", folder_.path() / "target.yaml"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("2 scenes of 2 still stretches in 5.5 s"));
  EXPECT_EQ(lines_of(outcome.out).size(), 1U);
  EXPECT_THAT(outcome.err, HasSubstr("scene 001, "));
  for (const char* name : {"target.yaml", "camera.yaml", "import.json", "scenes/002/image.png",
                           "scenes/002/cloud.pcd"}) {
    EXPECT_TRUE(fs::exists(dataset_ / name)) << name;
  }
  const auto json = nlohmann::json::parse(read_file(dataset_ / "import.json"));
  EXPECT_EQ(json["stretches"].size(), 2U);
  EXPECT_THAT(json["stretches"][1]["reason"].get<std::string>(), HasSubstr("stand still"));
  EXPECT_EQ(import(bag()).status, 3);
  EXPECT_EQ(import(bag(), {"--force", "--quiet"}).status, 0);
}

TEST_F(ImportCommand, WrongUsage) {
  expect_refused(run_lvcalib({"import", bag()}), 2, "--output is missing");
  expect_refused(import(bag(), {"--image-topic", "/camera"}), 2, "there is /camera/image_raw");
  expect_refused(import(bag(), {"--scenes", "1,x"}), 2, "--scenes");
  expect_refused(import(bag(), {"--min-still", "-1"}), 2, "--min-still");
  expect_refused(import(bag(), {"--scenes", "2.4"}), 3, "nothing stands still at 2.40 s");
}

TEST_F(ImportCommand, UnusableRecordings) {
  expect_refused(import(folder_.path() / "none.bag"), 3, "file not found");
  write_file(folder_.path() / "text.bag", "no bag");
  expect_refused(import(folder_.path() / "text.bag"), 3, "is no recording");
  expect_refused(import(folder_.path()), 3, "text.bag");
  expect_refused(import(bag(), {"--target", folder_.path() / "none.yaml"}), 3, "none.yaml");
  expect_refused(import(bag(), {"--camera", folder_.path() / "none.yaml"}), 3, "none.yaml");
  // The board of this file is nowhere in the images.
  Target other;
  other.first_tag_id = 300;
  write_file(folder_.path() / "other.yaml", to_yaml(other));
  expect_refused(import(bag(), {"--target", folder_.path() / "other.yaml"}), 3,
                 "board is not found");
}

}  // namespace
}  // namespace lvcalib::testing
