// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/project_file.h"

#include <fstream>
#include <iterator>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/file_io.h"
#include "pipeline/model_discovery.h"
#include "support/pose_matchers.h"
#include "support/simulated_dataset.h"

namespace lvcalib {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
namespace fs = std::filesystem;

Project example(const fs::path& dataset) {
  Project project;
  project.dataset = dataset;
  project.decisions.use_crops = true;
  project.decisions.options.refinement.max_bins = 30;
  project.decisions.options.extrinsic.robust_threshold = 0.1 + 2.7;
  project.decisions.guess =
      Rigid3{Eigen::Quaterniond(0.5, -0.5, 0.5, -0.5), Eigen::Vector3d(0.1, 1.0 / 3.0, -7e-5)};
  project.decisions.scenes["A"].use = false;
  CropBox box;
  box.center_m = {1.1, 2.2, 3.3};
  box.half_size_m = {0.7, 0.8, 1e-3};
  SceneDecision& odd = project.decisions.scenes["a: \"strange\" name"];
  odd = {true, true, box, {}, "a note: \"it rained\"\nall day #3"};
  odd.edits.points_m = {{1.1F, -2.7e-5F, 3.3F}, {0.1F, 0.2F, 0.3F}};
  odd.edits.patches_m = {{{0.1, 0.2}, {0.3, 0.1 + 0.2}, {0.0, 1e-7}}, {{0, 0}, {1, 0}, {1, 1}}};
  odd.edits.tags = {3, 7};
  odd.edits.circles = {0};
  odd.edits.kept_tags = {5};
  odd.edits.kept_circles = {2, 8};
  odd.edits.kept_patches = {{{0.1, 0.2}, {0.1 + 0.2, 1e-7}}, {{0, 0}, {1, 1}}};
  project.decisions.scene_order = {"C", "a: \"strange\" name"};
  project.decisions.added_scenes = {dataset.parent_path() / "more" / "X"};
  project.model = {{ModelChange::kAdd, "range_walk", {}},
                   {ModelChange::kAdd, "formula:range:a*sin(2*\"x\")", {}},
                   {ModelChange::kHold, "range_walk", {0.1 + 0.2, -1e-9}},
                   {ModelChange::kSwitchOff, "range_walk", {}}};
  project.frames = ProjectFrames{"velodyne: \"top\"", "cam0/optical"};
  return project;
}

TEST(ProjectFile, ReadsBackExactlyAsWritten) {
  const test::TemporaryFolder folder;
  const Project written = example(folder.path() / "data set");
  const fs::path path = folder.path() / "sub.lvcalib";
  ASSERT_TRUE(write_project(path, written).ok());
  const auto read = read_project(path);
  ASSERT_TRUE(read.ok()) << read.error().text();
  EXPECT_TRUE(read->warnings.empty());
  const Decisions& d = read->project.decisions;
  EXPECT_EQ(read->project.dataset, written.dataset);
  EXPECT_TRUE(d.use_crops);
  EXPECT_TRUE(same_options(d.options, written.decisions.options));
  EXPECT_EQ(d.guess->translation, written.decisions.guess->translation);
  EXPECT_EQ(d.guess->rotation.coeffs(), written.decisions.guess->rotation.coeffs());
  EXPECT_EQ(d.scenes, written.decisions.scenes);
  EXPECT_EQ(d.added_scenes, written.decisions.added_scenes);
  EXPECT_EQ(d.scene_order, written.decisions.scene_order);
  EXPECT_EQ(read->project.model, written.model);
  EXPECT_EQ(read->project.frames, written.frames);
}

// Projects of before say nothing of them; half of them, or none, is refused with its line.
TEST(ProjectFile, NamesOfFramesAreOptional) {
  const std::string head = "format: lvcalib-project\nversion: 1\ndataset: d\n";
  const auto without = project_from_text(head, "p.lvcalib");
  ASSERT_TRUE(without.ok());
  EXPECT_FALSE(without->project.frames.has_value());
  EXPECT_EQ(project_as_text(without->project, ".").find("frames"), std::string::npos);
  const auto with = project_from_text(head + "frames: {lidar: os1, camera: left}\n", "p.lvcalib");
  ASSERT_TRUE(with.ok()) << with.error().text();
  EXPECT_EQ(with->project.frames, (ProjectFrames{"os1", "left"}));
  for (const char* text : {"frames: os1\n", "frames: {lidar: os1}\n", "frames: {lidar: [a]}\n"})
    EXPECT_FALSE(project_from_text(head + text, "p.lvcalib").ok()) << text;
}

TEST(ProjectFile, AModelThatMakesNoSenseIsRefusedWithItsLine) {
  const std::string head = "format: lvcalib-project\nversion: 1\ndataset: d\n";
  const std::pair<const char*, const char*> cases[] = {
      {"model: 3\n", "list"},
      {"model:\n  - {change: add}\n", "needs"},
      {"model:\n  - {change: grow, effect: range_walk}\n", "grow"},
      {"model:\n  - {change: hold, effect: range_walk, values: [x]}\n", "values"}};
  for (const auto& [text, expected] : cases) {
    const auto read = project_from_text(head + text, "p.lvcalib");
    ASSERT_FALSE(read.ok()) << text;
    EXPECT_THAT(read.error().text(), HasSubstr(expected));
    EXPECT_THAT(read.error().text(), HasSubstr("p.lvcalib:"));
  }
}

TEST(ProjectFile, EditsThatMakeNoSenseAreRefusedWithTheirLine) {
  const std::string head =
      "format: lvcalib-project\nversion: 1\ndataset: d\nscenes:\n  A:\n    edits:\n      ";
  const std::pair<const char*, const char*> cases[] = {
      {"points_m: [1, 2]\n", "3 numbers"},
      {"patches_m: [[1, 2, 3]]\n", "2 numbers"},
      {"kept_patches_m: [[1, 2, 3]]\n", "4 numbers"},
      {"tags: [0.5]\n", "ids"},
      {"circles: x\n", "circles"}};
  for (const auto& [text, expected] : cases) {
    const auto read = project_from_text(head + text, "p.lvcalib");
    ASSERT_FALSE(read.ok()) << text;
    EXPECT_THAT(read.error().text(), HasSubstr(expected));
    EXPECT_THAT(read.error().text(), HasSubstr("p.lvcalib:7"));
  }
}

TEST(ProjectFile, TheGuidesExampleIsAProject) {
  std::ifstream file(LVCALIB_SOURCE_DIR "/resources/guide/files.md");
  const std::string guide{std::istreambuf_iterator<char>(file), {}};
  const std::size_t from = guide.find("```yaml\nformat: lvcalib-project") + 8;
  const auto read =
      project_from_text(guide.substr(from, guide.find("```", from) - from), "files.md");
  ASSERT_TRUE(read.ok()) << read.error().text();
  const SceneEdits& edits = read->project.decisions.scenes.at("C").edits;
  EXPECT_EQ(edits.kept_patches, (std::vector<BoardOutline>{{{0.46, -0.06}, {0.61, 0.51}}}));
  EXPECT_EQ(edits.patches_m.size(), 1U);
  EXPECT_EQ(edits.points_m.size(), 1U);
  EXPECT_EQ(edits.kept_tags, std::vector<int>{7});
  EXPECT_EQ(edits.circles, std::vector<int>{0});
}

TEST(ProjectFile, MovesTogetherWithItsDataset) {
  const test::TemporaryFolder folder;
  fs::create_directories(folder.path() / "old/dataset");
  ASSERT_TRUE(
      write_project(folder.path() / "old/p.lvcalib", example(folder.path() / "old/dataset")).ok());
  fs::rename(folder.path() / "old", folder.path() / "new");
  const auto read = read_project(folder.path() / "new/p.lvcalib");
  ASSERT_TRUE(read.ok());
  EXPECT_EQ(read->project.dataset, folder.path() / "new/dataset");
}

TEST(ProjectFile, ANewerVersionIsRefusedUntouched) {
  const test::TemporaryFolder folder;
  const std::string text = "format: lvcalib-project\nversion: 2\ndataset: d\nfuture: [1, 2]\n";
  const fs::path path = folder.write("p.lvcalib", text);
  const auto read = read_project(path);
  ASSERT_FALSE(read.ok());
  EXPECT_THAT(read.error().text(), HasSubstr("version 2"));
  EXPECT_EQ(*read_text_file(path, 1000), text);
}

TEST(ProjectFile, UnknownKeysAndOptionsAreWarnedAbout) {
  const auto read = project_from_text(
      "format: lvcalib-project\nversion: 1\ndataset: d\ncolour: red\n"
      "options: {refinement.max_bin: 3}\nscenes: {A: {use: true, remark: x}}\n",
      "/tmp/p.lvcalib");
  ASSERT_TRUE(read.ok()) << read.error().text();
  ASSERT_EQ(read->warnings.size(), 3U);
  EXPECT_THAT(read->warnings[0], HasSubstr("refinement.max_bins"));
}

TEST(ProjectFile, NonsenseIsRefusedWithFileAndLine) {
  const std::string head = "format: lvcalib-project\nversion: 1\ndataset: d\n";
  for (const std::string& text :
       {std::string(), std::string("x: 1\n"), std::string("[1, 2"),
        std::string("format: lvcalib-project\nversion: one\ndataset: d\n"),
        std::string("format: lvcalib-project\nversion: 1\n"), head + "use_crops: perhaps\n",
        head + "options: {refinement.max_bins: -4}\n", head + "options: {refinement.max_bins: x}\n",
        head + "options: 3\n", head + "scenes: [A]\n", head + "scenes: {A: 3}\n",
        head + "scenes: {A: {use: 7}}\n", head + "added_scenes: x\n",
        head + "guess: {translation_m: [0, 0], quaternion_xyzw: [0, 0, 0, 1]}\n",
        head + "guess: {translation_m: [0, 0, 0], quaternion_xyzw: [0, 0, 0, 3]}\n",
        head + "scenes: {A: {crop: {center_m: [0, 0, .nan], half_size_m: [1, 1, 1], "
               "quaternion_xyzw: [0, 0, 0, 1]}}}\n",
        head + "scenes: {A: {crop: {center_m: [0, 0, 0], half_size_m: [1, 0, 1], "
               "quaternion_xyzw: [0, 0, 0, 1]}}}\n"}) {
    const auto read = project_from_text(text, "/tmp/p.lvcalib");
    ASSERT_FALSE(read.ok()) << text;
    EXPECT_EQ(read.error().kind, ErrorKind::kInput) << text;
    EXPECT_THAT(read.error().text(), HasSubstr("p.lvcalib")) << text;
  }
}

TEST(ProjectFile, AMovedDatasetIsAskedForAndMissingScenesAreNamed) {
  const test::SimulatedDataset data(test::dataset_options(12, 1));
  Project project;
  project.dataset = data.path() / "nowhere";
  const auto moved = open_project_dataset(project);
  ASSERT_TRUE(moved.ok());
  EXPECT_TRUE(moved->dataset_moved);
  project.dataset = data.path();
  project.decisions.scenes["Z"].use = true;
  project.decisions.scenes["A"].use = false;
  project.decisions.added_scenes = {data.path() / "gone"};
  const auto opened = open_project_dataset(project);
  ASSERT_TRUE(opened.ok()) << opened.error().text();
  EXPECT_FALSE(opened->dataset_moved);
  EXPECT_THAT(opened->missing_scenes, ElementsAre("gone", "Z"));
  EXPECT_EQ(opened->warnings.size(), 1U);
  // A dataset that is there but broken says what is wrong.
  fs::remove(data.path() / "camera.yaml");
  EXPECT_FALSE(open_project_dataset(project).ok());
}

// One dataset for all cases; none changes it.
class CalibrateProject : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    data_ = new test::SimulatedDataset(test::dataset_options(11, 4));
    auto result = calibrate(data_->open(), {}, {});
    ASSERT_TRUE(result.ok()) << result.error().text();
    base_ = std::make_shared<const CalibrationResult>(std::move(*result));
  }
  static void TearDownTestSuite() {
    base_.reset();
    delete data_;
  }
  static Project project() {
    Project out;
    out.dataset = data_->path();
    return out;
  }
  static const Rigid3& pose(const CalibrationResult& result) {
    return result.extrinsic.camera_from_lidar.transform;
  }
  static inline test::SimulatedDataset* data_ = nullptr;
  static inline std::shared_ptr<const CalibrationResult> base_;
};

TEST_F(CalibrateProject, WithoutDecisionsItIsTheCalibration) {
  const auto result = calibrate_project(project(), {});
  ASSERT_TRUE(result.ok()) << result.error().text();
  EXPECT_EQ(pose(**result).matrix(), pose(*base_).matrix());
}

TEST_F(CalibrateProject, DecisionsAboutScenesAndTheModelCount) {
  Project with = project();
  with.decisions.scenes["D"].use = false;
  with.model = {{ModelChange::kAdd, "range_offset", {}}};
  const auto result = calibrate_project(with, {});
  ASSERT_TRUE(result.ok()) << result.error().text();
  ASSERT_EQ((*result)->model.size(), 1U);
  EXPECT_EQ((*result)->model[0].id, "range_offset");
  EXPECT_FALSE((*result)->scenes[3].used);
  // The same, step by step.
  CalibrationRequest request;
  request.rejected = {"D"};
  auto three = calibrate(data_->open(), request, {});
  ASSERT_TRUE(three.ok()) << three.error().text();
  const auto base = std::make_shared<const CalibrationResult>(std::move(*three));
  const auto start = start_model(discovery_input(*base), discovery_options(*base), {});
  ASSERT_TRUE(start.ok()) << start.error().text();
  const auto next = apply_decision(*start, with.model[0], {});
  ASSERT_TRUE(next.ok()) << next.error().text();
  EXPECT_EQ(result_at(base, {*start}), base);
  const auto expected = result_at(base, {*start, *next});
  EXPECT_THAT(pose(**result), test::IsNearPose(pose(*expected), 1e-6, 1e-6));
  EXPECT_GT(translation_distance_m(pose(**result), pose(*base)), 0.0);
}

TEST_F(CalibrateProject, ADatasetThatMovedAndAStopAreErrors) {
  Project moved = project();
  moved.dataset = data_->path().parent_path() / "gone";
  const auto nowhere = calibrate_project(moved, {});
  ASSERT_FALSE(nowhere.ok());
  EXPECT_THAT(nowhere.error().text(), ::testing::HasSubstr("gone"));
  std::stop_source stop;
  stop.request_stop();
  RunContext context;
  context.stop = stop.get_token();
  const auto stopped = calibrate_project(project(), context);
  ASSERT_FALSE(stopped.ok());
  EXPECT_EQ(stopped.error().kind, ErrorKind::kCancelled);
}

}  // namespace
}  // namespace lvcalib
