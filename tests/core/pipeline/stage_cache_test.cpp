// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/stage_cache.h"

#include <gtest/gtest.h>

#include "pipeline/calibration.h"
#include "support/temporary_folder.h"

namespace lvcalib {
namespace {

TEST(StageCache, KeepsOnlyTheScenesOfTheDataset) {
  Dataset dataset;
  dataset.scenes = {{"A", {}, {}, {}}, {"B", {}, {}, {}}};
  StageCache cache;
  cache.prepare(dataset);
  cache.scene("A").seen.keep("key", {{}, Message("no tags")});
  cache.scene("B").seen.keep("key", {{}, Message("no tags")});
  dataset.scenes.erase(dataset.scenes.begin() + 1);
  cache.prepare(dataset);
  ASSERT_NE(cache.scene("A").seen.find("key"), nullptr);
  EXPECT_EQ(cache.scene("A").seen.find("key")->reason.text(), "no tags");
  EXPECT_EQ(cache.scene("A").seen.find("other"), nullptr);
  EXPECT_THROW(cache.scene("B"), std::out_of_range);
  cache.forget("A");
  EXPECT_TRUE(cache.empty());
}

TEST(StageCache, KeysChangeWithWhatAStageIsMadeFrom) {
  const test::TemporaryFolder folder;
  Dataset dataset;
  SceneFiles files{"A", folder.write("image.png", "1"), folder.write("cloud.pcd", "2"),
                   folder.write("board.pcd", "3")};
  const CalibrationRequest base;
  const std::string seen = detection_key(dataset, files, base.options);
  const std::string searched = search_key(dataset, files, base);

  CalibrationRequest other = base;
  other.options.refinement.max_bins = 30;
  EXPECT_EQ(search_key(dataset, files, other), searched);
  EXPECT_NE(refinement_key(searched, 0, other.options), refinement_key(searched, 0, base.options));
  EXPECT_NE(refinement_key(searched, 0, base.options), refinement_key(searched, 1, base.options));
  other = base;
  other.options.localization.max_patches = 9;
  EXPECT_EQ(detection_key(dataset, files, other.options), seen);
  EXPECT_NE(search_key(dataset, files, other), searched);
  other = base;
  other.options.detection.min_tags = 3;
  EXPECT_NE(detection_key(dataset, files, other.options), seen);
  EXPECT_NE(search_key(dataset, files, other), searched);
  other = base;
  other.use_crops = true;
  EXPECT_NE(search_key(dataset, files, other), searched);
  other = base;
  other.guess = Rigid3{};
  EXPECT_NE(search_key(dataset, files, other), searched);
  other = base;
  other.crop_boxes["A"] = CropBox{};
  EXPECT_NE(search_key(dataset, files, other), searched);
  EXPECT_NE(second_look_key(searched, {{1, 2, 3}, 1}), second_look_key(searched, {{1, 2, 3}, 2}));

  folder.write("cloud.pcd", "another length");
  EXPECT_EQ(detection_key(dataset, files, base.options), seen);
  EXPECT_NE(search_key(dataset, files, base), searched);
  dataset.target.tag_size_m *= 1.01;
  EXPECT_NE(detection_key(dataset, files, base.options), seen);
}

}  // namespace
}  // namespace lvcalib
