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

// The second stretch rests from 2.8 s to 4.8 s.
TEST_F(Survey, EdgesMovedByHandAreThoseOfTheScene) {
  ImportOptions options;
  options.target_yaml = "targetCols: 4\n";
  options.moved_edges = {{3.8, 3.15, 4.25}};
  const auto preview = preview_stretches(*recording_, *survey_, options);
  ASSERT_TRUE(preview.ok()) << preview.error().text();
  ASSERT_EQ(preview->size(), 3U);
  const ImportedStretch& moved = (*preview)[1];
  EXPECT_TRUE(moved.by_hand && moved.taken && moved.usable);
  EXPECT_DOUBLE_EQ(moved.first_s, 3.15);
  EXPECT_DOUBLE_EQ(moved.last_s, 4.25);
  EXPECT_LT(moved.found_first_s, 3.0);
  EXPECT_GT(moved.found_last_s, 4.5);
  EXPECT_EQ(moved.images, 11U);  // One each tenth of a second, 3.2 to 4.2.
  EXPECT_GE(moved.image_s, 3.15);
  EXPECT_LE(moved.image_s, 4.25);
  EXPECT_THAT(moved.reason, ::testing::HasSubstr("set by hand: 1.1 s"));
  EXPECT_FALSE((*preview)[0].by_hand);
  // A time within the moved edges asks for it, one within the found edges alone does not.
  options.scene_times_s = {3.2};
  const auto summary =
      import_recording(*recording_, *survey_, options, folder_->path() / "moved", RunContext{});
  ASSERT_TRUE(summary.ok()) << summary.error().text();
  EXPECT_EQ(summary->scene_count(), 1U);
  const ImportedStretch& written = summary->stretches[1];
  EXPECT_TRUE(written.taken);
  const auto whole = import_recording(*recording_, *survey_, {}, folder_->path() / "whole", {});
  ASSERT_TRUE(whole.ok());
  EXPECT_LE(written.sweeps, 11U);
  EXPECT_LT(written.sweeps, whole->stretches[1].sweeps);
  options.scene_times_s = {4.5};
  EXPECT_FALSE(preview_stretches(*recording_, *survey_, options).ok());
}

TEST_F(Survey, EdgesMovedByHandMayNotOverlapNorBeTooShort) {
  ImportOptions options;
  options.moved_edges = {{3.8, 1.0, 4.0}};
  const auto overlapping = preview_stretches(*recording_, *survey_, options);
  ASSERT_FALSE(overlapping.ok());
  EXPECT_THAT(overlapping.error().text(), ::testing::HasSubstr("overlaps"));
  options.moved_edges = {{3.8, 3.5, 3.6}};
  const auto narrow = preview_stretches(*recording_, *survey_, options);
  ASSERT_TRUE(narrow.ok());
  EXPECT_FALSE((*narrow)[1].usable);
  options.moved_edges = {{2.5, 2.1, 2.7}};  // Where nothing was found.
  const auto nothing = preview_stretches(*recording_, *survey_, options);
  ASSERT_TRUE(nothing.ok());
  for (const ImportedStretch& s : *nothing) EXPECT_FALSE(s.by_hand);
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
