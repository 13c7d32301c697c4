// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/session.h"

#include <algorithm>
#include <atomic>
#include <mutex>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "pipeline/refusals.h"
#include "support/pose_matchers.h"
#include "support/simulated_dataset.h"
#include "support/temporary_folder.h"

namespace lvcalib {
namespace {

using ::testing::HasSubstr;

// One dataset for all cases; none changes it.
class Session : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    data_ = new test::SimulatedDataset(test::dataset_options(11, 3));
    dataset_ = data_->open();
    first_ = run_session(dataset_, {}, {}, {});
    ASSERT_FALSE(first_.error) << first_.error->text();
  }
  static void TearDownTestSuite() { delete data_; }

  // Which scenes were refined anew, and what the run left.
  struct Watched {
    SessionRun run;
    std::set<std::size_t> refined;
  };
  static Watched watch(const Decisions& decisions, const SessionState& state) {
    Watched out;
    std::mutex mutex;
    CalibrationObserver observer;
    observer.iteration = [&](std::size_t scene, const BoardRefinement& so_far) {
      const std::lock_guard lock(mutex);
      EXPECT_FALSE(so_far.history.empty());
      out.refined.insert(scene);
    };
    out.run = run_session(dataset_, decisions, state, {}, observer);
    return out;
  }
  static Eigen::Matrix4d pose(const SessionRun& run) {
    return run.state.latest->extrinsic.camera_from_lidar.transform.matrix();
  }

  static inline test::SimulatedDataset* data_ = nullptr;
  static inline Dataset dataset_;
  static inline SessionRun first_;
};

TEST_F(Session, FromNothingItIsTheSameAsCalibrate) {
  const auto result = calibrate(dataset_, {}, {});
  ASSERT_TRUE(result.ok());
  EXPECT_EQ(pose(first_), result->extrinsic.camera_from_lidar.transform.matrix());
  EXPECT_EQ(first_.state.latest->warnings, result->warnings);
  EXPECT_EQ(first_.state.latest->extrinsic.camera_from_lidar.covariance,
            result->extrinsic.camera_from_lidar.covariance);
}

TEST_F(Session, TakingOutAndBackInOnlySolves) {
  Decisions decisions;
  decisions.scenes["B"].use = false;
  const Watched out = watch(decisions, first_.state);
  ASSERT_FALSE(out.run.error);
  EXPECT_TRUE(out.run.solved_only);
  EXPECT_TRUE(out.refined.empty());
  const CalibrationResult& result = *out.run.state.latest;
  EXPECT_FALSE(result.scenes[1].used);
  EXPECT_TRUE(result.scenes[1].rejected);
  EXPECT_EQ(result.scenes[1].reason.text(), "rejected by the user");
  EXPECT_EQ(result.extrinsic.used_scenes, 2);
  CalibrationRequest request;
  request.rejected = {"B"};
  const auto whole = calibrate(dataset_, request, {});
  ASSERT_TRUE(whole.ok());
  EXPECT_THAT(result.extrinsic.camera_from_lidar.transform,
              test::IsNearPose(whole->extrinsic.camera_from_lidar.transform, 0.01, 0.01));
  const Watched back = watch({}, out.run.state);
  EXPECT_TRUE(back.run.solved_only);
  EXPECT_EQ(pose(back.run), pose(first_));
}

TEST_F(Session, WithoutAnySceneThereIsAnErrorAndTheStateIsKept) {
  Decisions decisions;
  for (const char* name : {"A", "B", "C"}) decisions.scenes[name].use = false;
  const Watched none = watch(decisions, first_.state);
  ASSERT_TRUE(none.run.error);
  EXPECT_EQ(none.run.error->kind, ErrorKind::kUntrusted);
  EXPECT_EQ(none.run.state.latest, first_.state.latest);
  const Watched back = watch({}, none.run.state);
  EXPECT_TRUE(back.run.solved_only);
  EXPECT_FALSE(back.run.error);
}

TEST_F(Session, AChangedOptionRunsItsStageAndLaterOnesAsCalibrateWould) {
  for (const auto& [key, value, refined] :
       {std::tuple{"refinement.max_bins", 20.0, 3U}, {"extrinsic.robust_threshold", 3.0, 0U}}) {
    Decisions decisions;
    ASSERT_TRUE(set_option(decisions.options, key, value).ok());
    const Watched out = watch(decisions, first_.state);
    ASSERT_FALSE(out.run.error);
    EXPECT_FALSE(out.run.solved_only);
    EXPECT_EQ(out.refined.size(), refined) << key;
    EXPECT_EQ(out.run.state.latest->times.detect_ms, 0.0) << "detected again";
    EXPECT_EQ(out.run.state.latest->times.localize_ms, 0.0) << "searched again";
    const auto whole = calibrate(dataset_, request_of(dataset_, decisions), {});
    ASSERT_TRUE(whole.ok());
    EXPECT_EQ(pose(out.run), whole->extrinsic.camera_from_lidar.transform.matrix()) << key;
  }
}

// As when images are added for the camera, or camera.yaml is replaced, while the dataset is open.
TEST_F(Session, AnotherCameraOrMoreImagesOfItAreNoSolveAlone) {
  const auto runs_whole = [](const Dataset& dataset) {
    const SessionRun run = run_session(dataset, {}, first_.state, {});
    EXPECT_FALSE(run.error) << run.error->text();
    return !run.solved_only;
  };
  EXPECT_FALSE(runs_whole(dataset_));
  Dataset other = dataset_;
  other.camera_images.push_back(dataset_.scenes[0].image);
  EXPECT_TRUE(runs_whole(other));
  other = dataset_;
  other.camera.cx += 0.1;
  EXPECT_TRUE(runs_whole(other));
  other = dataset_;
  other.camera_deviations = CameraDeviations::Constant(0.01);
  EXPECT_TRUE(runs_whole(other));
}

TEST_F(Session, ACropBoxRunsThatSceneAlone) {
  const RefinedNode& node = first_.state.latest->scenes[2].refinement->nodes[4];
  Decisions decisions;
  CropBox box;
  box.center_m = node.center_lidar_m;
  box.half_size_m = {1.0, 1.0, 1.0};
  decisions.scenes["C"].crop = box;
  const Watched out = watch(decisions, first_.state);
  ASSERT_FALSE(out.run.error) << out.run.error->text();
  EXPECT_EQ(out.refined, std::set<std::size_t>{2});
  EXPECT_THAT(out.run.state.latest->extrinsic.camera_from_lidar.transform,
              test::IsNearPose(data_->rig().camera_from_lidar, 5.0, 2.0));
  // A box beside the board loses the scene and says so; the others still give a result.
  decisions.scenes["C"].crop->center_m += Eigen::Vector3d(0, 0, 500.0);
  const Watched lost = watch(decisions, out.run.state);
  ASSERT_FALSE(lost.run.error) << lost.run.error->text();
  EXPECT_FALSE(lost.run.state.latest->scenes[2].used);
  EXPECT_THAT(lost.run.state.latest->scenes[2].reason, HasSubstr("crop box holds no points"));
}

TEST_F(Session, WhatIsLeftOutByHandTakesNoPart) {
  const SceneResult& before = first_.state.latest->scenes[1];
  const RefinedNode& circle = before.refinement->nodes[4];
  const int tag = before.view->corners.front().feature_id;
  Decisions decisions;
  SceneEdits& edits = decisions.scenes["B"].edits;
  edits.tags = {tag};
  edits.circles = {circle.id};
  edits.points_m = {before.board_points.points_m[10], before.board_points.points_m[20]};
  const Watched out = watch(decisions, first_.state);
  ASSERT_FALSE(out.run.error) << out.run.error->text();
  EXPECT_EQ(out.refined, std::set<std::size_t>{1});
  const CalibrationResult& result = *out.run.state.latest;
  const SceneResult& scene = result.scenes[1];
  EXPECT_EQ(scene.view->tag_count, before.view->tag_count - 1);
  EXPECT_EQ(scene.left_out_corners.size(), 4U);
  EXPECT_EQ(scene.view->corners.size() + 4, before.view->corners.size());
  EXPECT_GT(scene.left_out_points.size(), 30U);
  EXPECT_EQ(scene.board_points.size() + scene.left_out_points.size(), before.board_points.size());
  for (const RefinedNode& node : scene.refinement->nodes)
    EXPECT_EQ(node.reason == kLeftOutByUser, node.id == circle.id) << node.id << node.reason.text();
  // It is the user's decision, not the program's.
  for (const Refusal& refusal : refusals(result)) {
    EXPECT_FALSE(refusal.scene == "B" && refusal.id == circle.id &&
                 refusal.what != Refusal::What::kTag)
        << refusal.reason.text();
  }
  EXPECT_NE(pose(out.run), pose(first_));
  EXPECT_THAT(result.extrinsic.camera_from_lidar.transform,
              test::IsNearPose(first_.state.latest->extrinsic.camera_from_lidar.transform, 5, 2));
  const Watched back = watch({}, out.run.state);
  EXPECT_EQ(pose(back.run), pose(first_));
}

TEST(Decisions, NotesAndTheOrderOfTheListAreNoCalibration) {
  Decisions a;
  a.scenes["A"].crop = CropBox{};
  Decisions b = a;
  b.scenes["A"].note = "windy";
  b.scenes["B"].note = "calm";
  b.scene_order = {"B", "A"};
  EXPECT_TRUE(same_calibration(a, b));
  b.scenes["B"].edits.tags = {1};
  EXPECT_FALSE(same_calibration(a, b));
}

TEST_F(Session, WithoutTagsASceneSaysSo) {
  Decisions decisions;
  for (const CornerObservation& corner : first_.state.latest->scenes[1].view->corners)
    decisions.scenes["B"].edits.tags.push_back(corner.feature_id);
  const Watched out = watch(decisions, first_.state);
  ASSERT_FALSE(out.run.error) << out.run.error->text();
  EXPECT_FALSE(out.run.state.latest->scenes[1].used);
  EXPECT_THAT(out.run.state.latest->scenes[1].reason, HasSubstr("left out by the user"));
}

// A gate that refuses about every tag; what the user keeps stays in, and nothing else.
TEST_F(Session, WhatIsKeptByHandIsUsedAllTheSame) {
  Decisions decisions;
  decisions.options.extrinsic.rejection_gate = 2.0;
  const Watched strict = watch(decisions, first_.state);
  ASSERT_FALSE(strict.run.error) << strict.run.error->text();
  const auto refused = refusals(*strict.run.state.latest);
  const auto tag = std::find_if(refused.begin(), refused.end(), [](const Refusal& r) {
    return r.what == Refusal::What::kTag && r.can_be_used;
  });
  ASSERT_NE(tag, refused.end());
  decisions.scenes[tag->scene].edits.kept_tags = {tag->id};
  const Watched kept = watch(decisions, strict.run.state);
  ASSERT_FALSE(kept.run.error) << kept.run.error->text();
  const auto still = refusals(*kept.run.state.latest);
  const auto tags = [](const std::vector<Refusal>& all) {
    std::set<std::pair<std::string, int>> out;
    for (const Refusal& r : all) {
      if (r.what == Refusal::What::kTag) out.insert({r.scene, r.id});
    }
    return out;
  };
  auto expected = tags(refused);
  expected.erase({tag->scene, tag->id});
  EXPECT_EQ(tags(still), expected);
  // Going back judges all of them anew.
  decisions.scenes.clear();
  const Watched back = watch(decisions, kept.run.state);
  EXPECT_EQ(tags(refusals(*back.run.state.latest)), tags(refused));
}

TEST_F(Session, APreviewIsWhatARunWouldGive) {
  Decisions decisions;
  decisions.options.extrinsic.rejection_gate = 2.0;
  const auto preview = preview_session(dataset_, decisions, first_.state, {});
  ASSERT_TRUE(preview.ok());
  EXPECT_EQ(preview->extrinsic.camera_from_lidar.transform.matrix(),
            pose(watch(decisions, first_.state).run));
  EXPECT_FALSE(preview_session(dataset_, decisions, {}, {}).ok());
  std::stop_source stop;
  stop.request_stop();
  RunContext context;
  context.stop = stop.get_token();
  EXPECT_EQ(preview_session(dataset_, decisions, first_.state, context).error().kind,
            ErrorKind::kCancelled);
}

TEST_F(Session, ACancelledRunKeepsWhatItFinished) {
  std::stop_source stop;
  RunContext context;
  context.stop = stop.get_token();
  context.progress = [&](const Progress& p) {
    if (p.stage == "refine") stop.request_stop();
  };
  const SessionRun cancelled = run_session(dataset_, {}, {}, context);
  ASSERT_TRUE(cancelled.error);
  EXPECT_EQ(cancelled.error->kind, ErrorKind::kCancelled);
  EXPECT_EQ(cancelled.state.latest, nullptr);
  const SessionRun again = run_session(dataset_, {}, cancelled.state, {});
  ASSERT_FALSE(again.error);
  EXPECT_EQ(again.state.latest->times.detect_ms, 0.0);
  EXPECT_EQ(again.state.latest->times.localize_ms, 0.0);
  EXPECT_EQ(pose(again), pose(first_));
}

TEST_F(Session, AForgottenOrChangedSceneRunsAgain) {
  SessionState state = first_.state;
  state.cache.forget("A");
  state.whole = nullptr;
  const Watched out = watch({}, state);
  EXPECT_EQ(out.refined, std::set<std::size_t>{0});
  EXPECT_EQ(pose(out.run), pose(first_));
}

TEST_F(Session, AddedScenesMustBeWholeAndHaveNamesOfTheirOwn) {
  const test::TemporaryFolder folder;
  namespace fs = std::filesystem;
  fs::copy(data_->path() / "scenes/A", folder.path() / "X");
  Dataset dataset = dataset_;
  ASSERT_TRUE(add_scenes(dataset, {folder.path() / "X"}).ok());
  EXPECT_EQ(dataset.scenes.size(), 4U);
  EXPECT_EQ(dataset.scenes.back().name, "X");
  const Status twice = add_scenes(dataset, {folder.path() / "X"});
  ASSERT_FALSE(twice.ok());
  EXPECT_THAT(twice.error().text(), HasSubstr("already a scene 'X'"));
  fs::create_directory(folder.path() / "Y");
  const Status empty = add_scenes(dataset, {folder.path() / "Y"});
  ASSERT_FALSE(empty.ok());
  EXPECT_EQ(empty.error().kind, ErrorKind::kInput);
  EXPECT_EQ(dataset.scenes.size(), 4U);
}

TEST_F(Session, OneBadFileCostsOneScene) {
  const test::TemporaryFolder folder;
  Dataset dataset = dataset_;
  SceneFiles cut = dataset.scenes[0];
  cut.name = "cut";
  cut.cloud = folder.write("cut.pcd",
                           "VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\n"
                           "WIDTH 100\nHEIGHT 1\nPOINTS 100\nDATA binary\n1234");
  SceneFiles empty = dataset.scenes[1];
  empty.name = "empty";
  empty.image = folder.write("empty.png", "");
  SceneFiles gone;
  gone.name = "gone";
  gone.problem = Error::input(Message("no cloud in this scene"), "scenes/gone");
  dataset.scenes.insert(dataset.scenes.end(), {cut, empty, gone});
  const SessionRun run = run_session(dataset, {}, {}, {});
  ASSERT_FALSE(run.error) << run.error->text();
  const CalibrationResult& result = *run.state.latest;
  EXPECT_EQ(result.extrinsic.used_scenes, 3);
  EXPECT_EQ(pose(run), pose(first_));
  const char* const reasons[] = {"cut.pcd", "empty.png", "no cloud"};
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_TRUE(result.scenes[3 + k].unreadable);
    EXPECT_THAT(result.scenes[3 + k].reason, HasSubstr(reasons[k]));
    EXPECT_THAT(result.warnings, ::testing::Contains(HasSubstr(reasons[k])));
  }
  // Asked directly, nothing is left out unasked; and with no scene left there is no result.
  EXPECT_EQ(calibrate(dataset, {}, {}).error().kind, ErrorKind::kInput);
  dataset.scenes.erase(dataset.scenes.begin(), dataset.scenes.begin() + 3);
  const SessionRun none = run_session(dataset, {}, {}, {});
  ASSERT_TRUE(none.error);
  EXPECT_EQ(none.error->kind, ErrorKind::kInput);
}

TEST_F(Session, ARefusedSceneIsUsedAllTheSameIfTheUserInsists) {
  Dataset dataset = dataset_;
  dataset.scenes[2].image = dataset.scenes[0].image;
  const SessionRun refused = run_session(dataset, {}, {}, {});
  ASSERT_FALSE(refused.error) << refused.error->text();
  ASSERT_FALSE(refused.state.latest->scenes[2].used);
  Decisions decisions;
  decisions.scenes["C"].insist = true;
  const SessionRun run = run_session(dataset, decisions, refused.state, {});
  ASSERT_FALSE(run.error) << run.error->text();
  const SceneResult& scene = run.state.latest->scenes[2];
  EXPECT_TRUE(scene.used) << scene.reason.text();
  EXPECT_THAT(scene.objection, HasSubstr("contradicts the other scenes"));
  EXPECT_NE(run.state.latest->quality, Quality::kGood);
  EXPECT_THAT(run.state.latest->quality_reasons,
              ::testing::Contains(HasSubstr("used all the same")));
  const SessionRun back = run_session(dataset, {}, run.state, {});
  EXPECT_EQ(pose(back), pose(refused));
}

}  // namespace
}  // namespace lvcalib
