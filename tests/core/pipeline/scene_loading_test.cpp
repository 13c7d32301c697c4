// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/scene_loading.h"

#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "pipeline/quality.h"
#include "support/simulated_dataset.h"

namespace lvcalib {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;

CalibrationResult prepared(const Dataset& dataset) {
  CalibrationResult result;
  result.target = dataset.target;
  result.camera = dataset.camera;
  for (const SceneFiles& files : dataset.scenes) {
    SceneResult scene;
    scene.name = files.name;
    result.scenes.push_back(scene);
  }
  return result;
}

TEST(LoadScenes, GivesViewAndCandidatesOfEverySceneNotRejected) {
  const test::SimulatedDataset data(test::dataset_options(11, 3));
  const Dataset dataset = data.open();
  CalibrationResult result = prepared(dataset);
  reject(result.scenes[1]);
  const Status status = load_scenes(dataset, {}, {}, result);
  ASSERT_TRUE(status.ok()) << status.error().text();
  for (const std::size_t s : {0U, 2U}) {
    ASSERT_TRUE(result.scenes[s].view && result.scenes[s].search);
    EXPECT_FALSE(result.scenes[s].search->candidates.empty());
    EXPECT_GE(result.scenes[s].view->tag_count, 12);
  }
  EXPECT_FALSE(result.scenes[1].view.has_value());
  EXPECT_FALSE(result.scenes[1].search.has_value());
  EXPECT_GT(result.times.localize_ms, 0.0);
}

TEST(LoadScenes, ACropStandsForTheCloudOnlyWhenAskedFor) {
  const test::SimulatedDataset data(test::dataset_options(12, 1));
  // An empty room as the crop: used, it hides the board.
  Cloud few;
  for (int i = 0; i < 100; ++i) {
    few.points_m.emplace_back(2.0F, 0.01F * static_cast<float>(i), 0.0F);
    few.intensity.push_back(10.0F);
  }
  ASSERT_TRUE(write_pcd(data.path() / "scenes/A/board.pcd", few).ok());
  const Dataset dataset = data.open();
  CalibrationRequest request;
  CalibrationResult result = prepared(dataset);
  ASSERT_TRUE(load_scenes(dataset, request, {}, result).ok());
  EXPECT_FALSE(result.scenes[0].search->candidates.empty());
  request.use_crops = true;
  result = prepared(dataset);
  ASSERT_TRUE(load_scenes(dataset, request, {}, result).ok());
  EXPECT_TRUE(result.scenes[0].search->candidates.empty());
}

TEST(LoadScenes, ACloudWithoutIntensityIsSearchedByItsOutline) {
  const test::SimulatedDataset data(test::dataset_options(13, 1));
  Cloud cloud = data.rig().scenes[0].cloud;
  cloud.intensity.clear();
  ASSERT_TRUE(write_pcd(data.path() / "scenes/A/cloud.pcd", cloud).ok());
  const Dataset dataset = data.open();
  CalibrationResult result = prepared(dataset);
  ASSERT_TRUE(load_scenes(dataset, {}, {}, result).ok());
  ASSERT_TRUE(result.scenes[0].search);
  ASSERT_FALSE(result.scenes[0].search->candidates.empty());
  EXPECT_EQ(result.scenes[0].search->candidates.front().correlation, 0.0);
}

TEST(ReadSceneCloud, IntensitiesAreLeftOutWhenTheyAreNotWanted) {
  const test::SimulatedDataset data(test::dataset_options(13, 1));
  const SceneFiles files = data.open().scenes.front();
  CalibrationRequest request;
  const auto with = read_scene_cloud(files, request, {});
  request.options.clouds.use_intensity = false;
  const auto without = read_scene_cloud(files, request, {});
  ASSERT_TRUE(with.ok() && without.ok());
  EXPECT_TRUE(with->has_intensity());
  EXPECT_FALSE(without->has_intensity());
  EXPECT_EQ(without->points_m, with->points_m);
}

TEST(LoadScenes, ACloudThatIsNotWholeIsToldOfAlsoWhenItsSearchIsKept) {
  const test::SimulatedDataset data(test::dataset_options(13, 1));
  std::ofstream(data.path() / "scenes/A/cloud.pcd", std::ios::app | std::ios::binary)
      << "another file";
  const Dataset dataset = data.open();
  StageCache cache;
  cache.prepare(dataset);
  for (int run = 0; run < 2; ++run) {
    CalibrationResult result = prepared(dataset);
    ASSERT_TRUE(load_scenes(dataset, {}, {}, result, &cache).ok());
    ASSERT_EQ(result.scenes[0].cloud_warnings.size(), 1U) << run;
    EXPECT_THAT(result.scenes[0].cloud_warnings[0].text(), HasSubstr("12 bytes follow"));
    judge_quality(result, {});
    EXPECT_THAT(result.warnings, Contains(HasSubstr("scene A: its cloud: 12 bytes")));
  }
}

TEST(LoadScenes, AnImageOfAnotherSizeSpoilsAll) {
  const test::SimulatedDataset data(test::dataset_options(14, 1));
  Dataset dataset = data.open();
  dataset.camera.width_px += 2;
  CalibrationResult result = prepared(dataset);
  const Status status = load_scenes(dataset, {}, {}, result);
  ASSERT_FALSE(status.ok());
  EXPECT_EQ(status.error().kind, ErrorKind::kInput);
  EXPECT_THAT(status.error().where, HasSubstr("image.png"));
}

TEST(SearchSceneAgain, LooksInTheRegion) {
  const test::SimulatedDataset data(test::dataset_options(15, 1));
  const Dataset dataset = data.open();
  CalibrationResult result = prepared(dataset);
  ASSERT_TRUE(load_scenes(dataset, {}, {}, result).ok());
  result.scenes[0].search.reset();
  const PatternPyramid pyramid(dataset.target);
  const Eigen::Vector2d c = dataset.target.outline().center_m();
  BoardSearchRegion region;
  region.center_m = data.rig().scenes[0].lidar_from_board * Eigen::Vector3d(c.x(), c.y(), 0.0);
  region.radius_m = 1.0;
  const CalibrationRequest request;
  const SecondSearch where{dataset.scenes[0], request, region, dataset.target, pyramid};
  ASSERT_TRUE(search_scene_again(where, {}, result.scenes[0]).ok());
  ASSERT_TRUE(result.scenes[0].search.has_value());
  EXPECT_FALSE(result.scenes[0].search->candidates.empty());
  std::stop_source stop;
  stop.request_stop();
  RunContext context;
  context.stop = stop.get_token();
  const Status stopped = search_scene_again(where, context, result.scenes[0]);
  ASSERT_FALSE(stopped.ok());
  EXPECT_EQ(stopped.error().kind, ErrorKind::kCancelled);
}

// An image of another scene sends the second look to a wrong place; the board that the first look
// found is still the cloud's.
TEST(SearchSceneAgain, KeepsWhatTheFirstLookFoundElsewhere) {
  const test::SimulatedDataset data(test::dataset_options(15, 1));
  const Dataset dataset = data.open();
  CalibrationResult result = prepared(dataset);
  StageCache cache;
  cache.prepare(dataset);
  ASSERT_TRUE(load_scenes(dataset, {}, {}, result, &cache).ok());
  const std::size_t found = result.scenes[0].search->candidates.size();
  ASSERT_GT(found, 0U);
  const PatternPyramid pyramid(dataset.target);
  BoardSearchRegion region;
  region.center_m = 0.3 * (data.rig().scenes[0].lidar_from_board * Eigen::Vector3d::Zero());
  region.radius_m = 0.2;
  const CalibrationRequest request;
  const SecondSearch where{dataset.scenes[0], request, region, dataset.target, pyramid};
  for (int time = 0; time < 2; ++time) {  // Searched, then kept.
    result.scenes[0].place = BoardPlace::kOpen;
    ASSERT_TRUE(search_scene_again(where, {}, result.scenes[0], &cache).ok());
    EXPECT_EQ(result.scenes[0].search->candidates.size(), found);
    EXPECT_EQ(result.scenes[0].place, BoardPlace::kPast);
  }
}

TEST(LookAtPlace, TellsWhereRaysEnd) {
  const Target target;
  const Eigen::Vector3d center(3.0, 0.5, 0.2);
  const auto wall_at = [&](double range_m) {
    Cloud cloud;
    for (int i = -20; i <= 20; ++i) {
      for (int j = -20; j <= 20; ++j) {
        const Eigen::Vector3d sight =
            (center.normalized() + Eigen::Vector3d(0.0, 0.005 * i, 0.005 * j)).normalized();
        cloud.points_m.push_back((range_m * sight).cast<float>());
      }
    }
    return cloud;
  };
  EXPECT_EQ(look_at_place(wall_at(5.0), center, target), BoardPlace::kPast);
  EXPECT_EQ(look_at_place(wall_at(1.5), center, target), BoardPlace::kHidden);
  EXPECT_EQ(look_at_place(wall_at(center.norm()), center, target), BoardPlace::kTaken);
  EXPECT_EQ(look_at_place({}, center, target), BoardPlace::kOpen);
  EXPECT_EQ(look_at_place(wall_at(5.0), -center, target), BoardPlace::kOpen);
}

}  // namespace
}  // namespace lvcalib
