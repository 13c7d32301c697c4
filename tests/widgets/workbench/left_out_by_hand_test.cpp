// SPDX-License-Identifier: GPL-3.0-or-later
// What is left out by hand in any view is solved without at once, is undone and is kept.
#include <QTabWidget>
#include <QToolButton>
#include <QUndoStack>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "modelling/model_page.h"
#include "pages/response_page.h"
#include "pages/scene_page.h"
#include "pages/world_pane.h"
#include "pipeline/project_file.h"
#include "views/cloud_view.h"
#include "widgets/workbench/main_window_fixture.h"
#include "workbench/main_window.h"
#include "workbench/page_stack.h"

namespace lvcalib::left_out_by_hand_test {
namespace {

using test::cell;
using test::find;
using test::MainWindowTest;
using test::trigger;
using test::wait_until;
using widgets::SceneModel;

// One stroke through several boards is one decision, and one to undo.
TEST_F(MainWindowTest, PointsBrushedInAllScenesAreLeftOutAtOnce) {
  run();
  find<QTabWidget>(*window_, "pages")->setCurrentIndex(2);
  auto* world = window_->findChild<widgets::WorldPane*>();
  ASSERT_NE(world, nullptr);
  ASSERT_TRUE(wait_until([&] { return !world->busy() && world->view()->scene(); }));
  const auto& scenes = workspace().result()->scenes;
  const auto first = static_cast<std::uint32_t>(scenes[0].board_points.size());
  const Eigen::Vector3f point = scenes[1].board_points.points_m[4];
  Q_EMIT world->view()->pointsBrushed({0, first + 4}, false);
  world->findChild<QToolButton*>("world-exclude")->click();
  const auto left_out = [&](const char* scene) {
    return decision_of(workspace().decisions(), scene).edits.points_m;
  };
  EXPECT_EQ(left_out("A").size(), 1U);
  EXPECT_EQ(left_out("B"), std::vector<Eigen::Vector3f>{point});
  EXPECT_TRUE(left_out("C").empty());
  ASSERT_TRUE(test::wait_for_result(*window_));
  EXPECT_EQ(workspace().result()->scenes[1].left_out_points.size(), 1U);
  ASSERT_TRUE(trigger(*window_, "undo"));
  EXPECT_TRUE(left_out("A").empty() && left_out("B").empty());
}

TEST_F(MainWindowTest, WhatIsBrushedOnTheModelPageIsLeftOut) {
  run();
  auto* page = window_->findChild<widgets::ModelPage*>();
  ASSERT_NE(page, nullptr);
  const auto& scene = workspace().result()->scenes[1];
  const Eigen::Vector3f point = scene.board_points.points_m[4];
  const CornerObservation& corner = scene.view->corners[5];
  // Its range is another than measured: the beam tells which return it is.
  Q_EMIT page->samplesSelected({{"B", {{1.03 * point.cast<double>()}, {corner.pixel}}}});
  // Once more the calibration, as when the model's budget is known.
  window_->findChild<widgets::PageStack*>()->set_result(workspace().result());
  Q_EMIT page->excludeWanted();
  const auto edits = [&](const char* name) {
    return decision_of(workspace().decisions(), name).edits;
  };
  EXPECT_EQ(edits("B").points_m, std::vector<Eigen::Vector3f>{point});
  EXPECT_EQ(edits("B").tags, std::vector<int>{corner.feature_id});
  EXPECT_TRUE(edits("A").empty() && edits("C").empty());
  ASSERT_TRUE(test::wait_for_result(*window_));
  EXPECT_EQ(workspace().result()->scenes[1].left_out_points.size(), 1U);
  ASSERT_TRUE(trigger(*window_, "undo"));
  EXPECT_TRUE(edits("B").empty());
}

TEST_F(MainWindowTest, APartOfTheBoardIsLeftOutOfOneSceneOrOfAll) {
  run();
  auto* page = window_->findChild<widgets::ResponsePage*>();
  ASSERT_NE(page, nullptr);
  const std::vector<Eigen::Vector2d> patch = {{0.1, 0.1}, {0.2, 0.1}, {0.2, 0.2}, {0.1, 0.2}};
  const auto patches = [&](const char* scene) {
    return decision_of(workspace().decisions(), scene).edits.patches_m.size();
  };
  Q_EMIT page->partExcluded("B", patch);
  EXPECT_EQ(patches("A"), 0U);
  EXPECT_EQ(patches("B"), 1U);
  Q_EMIT page->partExcluded({}, patch);
  EXPECT_EQ(patches("A"), 1U);
  EXPECT_EQ(patches("B"), 2U);
  EXPECT_EQ(patches("C"), 1U);
  ASSERT_TRUE(trigger(*window_, "undo"));
  EXPECT_EQ(patches("A"), 0U);
  SceneEdits back;
  back.patches_m = {patch};
  Q_EMIT page->takenBack("B", back);
  EXPECT_EQ(patches("B"), 0U);
  ASSERT_TRUE(wait_until([&] { return !workspace().busy(); }));
}

// Left out on the Scene page, solved again, undone, done again, saved and opened.
TEST_F(MainWindowTest, WhatIsLeftOutByHandIsUndoneAndKept) {
  run();
  const Eigen::Matrix4d before = pose();
  SceneEdits edits;
  edits.tags = {workspace().result()->scenes[0].view->corners.front().feature_id};
  auto* page = window_->findChild<widgets::ScenePage*>();
  Q_EMIT page->editsChanged(0, edits);
  ASSERT_TRUE(wait_until([&] { return workspace().up_to_date() && !workspace().busy(); }));
  EXPECT_NE(pose(), before);
  EXPECT_EQ(cell(*window_, "A", SceneModel::kTags), "15");
  trigger(*window_, "undo");
  ASSERT_TRUE(wait_until([&] { return workspace().up_to_date() && !workspace().busy(); }));
  EXPECT_EQ(pose(), before);
  trigger(*window_, "redo");
  const QString path = folder_.filePath("edits.lvcalib");
  ASSERT_TRUE(workspace().save(path).ok());
  const auto read = read_project(path.toStdString());
  ASSERT_TRUE(read.ok());
  EXPECT_EQ(decision_of(read->project.decisions, "A").edits, edits);
}

}  // namespace
}  // namespace lvcalib::left_out_by_hand_test
