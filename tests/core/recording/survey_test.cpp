// SPDX-License-Identifier: GPL-3.0-or-later
#include "recording/survey.h"

#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/recording/containers.h"
#include "core/recording/walk.h"
#include "support/temporary_folder.h"

namespace lvcalib {
namespace {

class Survey : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    simulation::SimulationOptions options;
    options.seed = 5;
    options.scenes = 3;
    options.lidar.points = 30'000;
    options.image.width_px = 480;
    options.image.height_px = 320;
    auto rig = simulation::simulate(options, {});
    ASSERT_TRUE(rig.ok());
    folder_ = new test::TemporaryFolder;
    const auto path = test::write_recording({}, folder_->path(), test::simulated_walk(*rig, {}));
    auto recording = Recording::open(path, {});
    ASSERT_TRUE(recording.ok()) << recording.error().text();
    recording_ = new Recording(std::move(*recording));
    auto survey = survey_recording(*recording_, {}, {});
    ASSERT_TRUE(survey.ok()) << survey.error().text();
    survey_ = new RecordingSurvey(std::move(*survey));
  }
  static void TearDownTestSuite() {
    delete survey_;
    delete recording_;
    delete folder_;
  }
  static inline test::TemporaryFolder* folder_ = nullptr;
  static inline Recording* recording_ = nullptr;
  static inline RecordingSurvey* survey_ = nullptr;
};

// The walk rests for 2 s and moves for 0.8 s, three times.
TEST_F(Survey, MotionIsBelowOneAtRestAndAboveBetween) {
  const RecordedMotion motion = motion_over_time(*recording_, *survey_, {});
  ASSERT_GT(motion.image.size(), 70U);
  ASSERT_GT(motion.cloud.size(), 70U);
  for (const auto* sensor : {&motion.image, &motion.cloud}) {
    double largest_at_rest = 0.0;
    double largest_between = 0.0;
    for (const MotionSample& s : *sensor) {
      const double phase = std::fmod(s.time_s, 2.8);
      if (phase > 0.15 && phase < 1.85) largest_at_rest = std::max(largest_at_rest, s.motion);
      if (phase > 2.2 && phase < 2.7) largest_between = std::max(largest_between, s.motion);
    }
    EXPECT_LT(largest_at_rest, 1.0);
    EXPECT_GT(largest_between, 2.0);
  }
}

TEST_F(Survey, PreviewIsWhatTheImportDoes) {
  const auto preview = preview_stretches(*recording_, *survey_, {});
  ASSERT_TRUE(preview.ok());
  ImportOptions options;
  options.target_yaml = "targetCols: 4\n";
  const auto direct =
      import_recording(*recording_, options, folder_->path() / "direct", RunContext{});
  const auto second =
      import_recording(*recording_, *survey_, options, folder_->path() / "second", RunContext{});
  ASSERT_TRUE(direct.ok()) << direct.error().text();
  ASSERT_TRUE(second.ok()) << second.error().text();
  ASSERT_EQ(preview->size(), direct->stretches.size());
  ASSERT_EQ(preview->size(), second->stretches.size());
  EXPECT_TRUE(second->has_camera);
  for (std::size_t i = 0; i < preview->size(); ++i) {
    EXPECT_TRUE((*preview)[i].usable);
    for (const ImportSummary* summary : {&*direct, &*second}) {
      EXPECT_EQ((*preview)[i].taken, summary->stretches[i].taken);
      EXPECT_EQ((*preview)[i].first_s, summary->stretches[i].first_s);
      EXPECT_EQ((*preview)[i].image_ns, summary->stretches[i].image_ns);
      EXPECT_EQ((*preview)[i].reason, summary->stretches[i].reason);
    }
  }
}

TEST_F(Survey, StretchesThatAreNotAskedForStayUsable) {
  ImportOptions options;
  options.scene_times_s = {1.0, 6.6};
  const auto preview = preview_stretches(*recording_, *survey_, options);
  ASSERT_TRUE(preview.ok());
  ASSERT_EQ(preview->size(), 3U);
  EXPECT_TRUE((*preview)[0].taken);
  EXPECT_FALSE((*preview)[1].taken);
  EXPECT_TRUE((*preview)[1].usable);
  EXPECT_TRUE((*preview)[2].taken);
  // A longer least rest changes the stretches without another pass.
  options = {};
  options.still.min_still_s = 3.0;
  const auto none = preview_stretches(*recording_, *survey_, options);
  ASSERT_TRUE(none.ok());
  for (const ImportedStretch& s : *none) {
    EXPECT_FALSE(s.usable);
    EXPECT_THAT(s.reason, ::testing::HasSubstr("3.0 s are needed"));
  }
}

TEST_F(Survey, ThumbnailsAreSmallAndOfTheStretch) {
  const auto preview = preview_stretches(*recording_, *survey_, {});
  ASSERT_TRUE(preview.ok());
  const auto picture = picture_of(*recording_, *survey_, preview->front(), 96, {});
  ASSERT_TRUE(picture.ok()) << picture.error().text();
  EXPECT_EQ(picture->file.extension, ".png");
  const Thumbnail* thumbnail = &picture->thumbnail;
  EXPECT_EQ(thumbnail->width_px, 96);
  EXPECT_EQ(thumbnail->height_px, 64);
  EXPECT_EQ(thumbnail->rgb.size(), 3U * 96 * 64);
  const auto [darkest, brightest] =
      std::minmax_element(thumbnail->rgb.begin(), thumbnail->rgb.end());
  EXPECT_GT(*brightest - *darkest, 60);
  ImportedStretch nowhere = preview->front();
  nowhere.image_ns = 1;
  EXPECT_FALSE(picture_of(*recording_, *survey_, nowhere, 96, {}).ok());
}

TEST_F(Survey, StopsWhenAsked) {
  std::stop_source stop;
  stop.request_stop();
  RunContext context;
  context.stop = stop.get_token();
  const auto survey = survey_recording(*recording_, {}, context);
  ASSERT_FALSE(survey.ok());
  EXPECT_EQ(survey.error().kind, ErrorKind::kCancelled);
}

TEST_F(Survey, WhatLooksLikeARecording) {
  EXPECT_TRUE(looks_like_recording(recording_->path()));
  EXPECT_TRUE(looks_like_recording(recording_->path().parent_path()));
  const auto text = folder_->path() / "text" / "notes.bag";
  std::filesystem::create_directories(text.parent_path());
  test::write_bytes(text, "no recording");
  EXPECT_FALSE(looks_like_recording(text));
  EXPECT_FALSE(looks_like_recording(text.parent_path()));
  EXPECT_FALSE(looks_like_recording(folder_->path() / "nowhere"));
}

TEST_F(Survey, CandidatesAreOfTheirKind) {
  const TopicCandidates candidates = list_candidates(*recording_);
  const auto name = [&](std::size_t i) { return recording_->topics()[i].name; };
  ASSERT_EQ(candidates.images.size(), 1U);
  ASSERT_EQ(candidates.clouds.size(), 1U);
  ASSERT_EQ(candidates.infos.size(), 1U);
  EXPECT_EQ(name(candidates.images[0]), "/camera/image_raw");
  EXPECT_EQ(name(candidates.clouds[0]), "/points");
  EXPECT_EQ(name(candidates.infos[0]), "/camera/camera_info");
}

}  // namespace
}  // namespace lvcalib
