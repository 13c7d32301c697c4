// SPDX-License-Identifier: GPL-3.0-or-later
#include "runner/workspace.h"

#include <QDir>
#include <QSignalSpy>
#include <QTemporaryDir>
#include <QTest>

#include <gtest/gtest.h>

#include "runner/demo.h"

namespace lvcalib::widgets::workspace_test {
namespace {

// Decisions about a tiny dataset that is not run.
class WorkspaceTest : public ::testing::Test {
 protected:
  void SetUp() override {
    simulation::SimulationOptions options;
    options.scenes = 2;
    options.lidar.points = 2000;
    options.image.width_px = 320;
    options.image.height_px = 240;
    ASSERT_TRUE(make_demo(folder_.filePath("d").toStdString(), options, {}).ok());
    workspace_ = std::make_unique<Workspace>(folder_.filePath("data"));
    QSignalSpy opened(workspace_.get(), &Workspace::opened);
    workspace_->open_dataset(folder_.filePath("d"));
    ASSERT_TRUE(opened.wait(5000));
  }
  void TearDown() override { workspace_.reset(); }
  const Decisions& decisions() const { return workspace_->decisions(); }

  QTemporaryDir folder_;
  std::unique_ptr<Workspace> workspace_;
};

TEST_F(WorkspaceTest, EveryDecisionCanBeUndoneAndRedone) {
  QUndoStack& undo = workspace_->undo_stack();
  workspace_->set_use({"A", "B"}, false);
  CropBox box;
  workspace_->set_crop("A", box);
  const OptionDeclaration& option = option_declarations().front();
  workspace_->set_option(option, 3.0);
  workspace_->set_use_crops(true);
  EXPECT_EQ(undo.count(), 4);
  EXPECT_TRUE(workspace_->dirty());
  workspace_->reset_options();
  EXPECT_EQ(option.get(decisions().options), option.default_value());
  undo.undo();
  EXPECT_EQ(option.get(decisions().options), 3.0);
  undo.undo();
  EXPECT_FALSE(decisions().use_crops);
  undo.undo();
  EXPECT_EQ(option.get(decisions().options), option.default_value());
  undo.undo();
  EXPECT_FALSE(decision_of(decisions(), "A").crop.has_value());
  EXPECT_FALSE(decision_of(decisions(), "A").use);
  undo.undo();
  EXPECT_TRUE(decision_of(decisions(), "A").use);
  EXPECT_FALSE(workspace_->dirty());
  undo.setIndex(4);
  EXPECT_TRUE(decisions().use_crops);
  EXPECT_EQ(decision_of(decisions(), "A").crop, box);
}

TEST_F(WorkspaceTest, WhatChangesNothingIsNoStepAndNonsenseIsRefused) {
  QSignalSpy failed(workspace_.get(), &Workspace::failed);
  workspace_->set_use_crops(false);
  workspace_->reset_options();
  workspace_->set_crop("A", std::nullopt);
  CropBox flat;
  flat.half_size_m.setZero();
  workspace_->set_crop("A", flat);
  workspace_->set_option(option_declarations().front(), -5.0);
  EXPECT_EQ(failed.count(), 2);
  EXPECT_FALSE(workspace_->add_scene_folders({"/nowhere"}).ok());
  EXPECT_EQ(workspace_->undo_stack().count(), 0);
  EXPECT_FALSE(decision_of(decisions(), "A").crop.has_value());
}

TEST_F(WorkspaceTest, TheFirstDecisionIsAutosavedAndTakingItBackRemovesIt) {
  const auto files = [this] {
    return QDir(folder_.filePath("data")).entryList({"autosave-*"}).size();
  };
  workspace_->set_use({"A"}, false);
  EXPECT_TRUE(QTest::qWaitFor([&] { return files() == 1; }, 5000));
  workspace_->undo_stack().undo();
  EXPECT_EQ(files(), 0);
}

TEST_F(WorkspaceTest, SavingMakesCleanAndUndoingThenMakesDirty) {
  QSignalSpy dirty(workspace_.get(), &Workspace::dirty_changed);
  workspace_->set_use({"A"}, false);
  ASSERT_TRUE(workspace_->save(folder_.filePath("p.lvcalib")).ok());
  EXPECT_FALSE(workspace_->dirty());
  workspace_->undo_stack().undo();
  EXPECT_TRUE(workspace_->dirty());
  EXPECT_EQ(dirty.count(), 3);
  const Status failed = workspace_->save(folder_.filePath("no/folder/p.lvcalib"));
  ASSERT_FALSE(failed.ok());
  EXPECT_EQ(failed.error().kind, ErrorKind::kOutput);
  EXPECT_TRUE(workspace_->dirty());
}

TEST_F(WorkspaceTest, WhatHasChangedOnDiskIsReadAgain) {
  workspace_->set_use({"A"}, false);
  const QString path = folder_.filePath("d");
  ASSERT_TRUE(QDir(path).mkdir("intrinsics"));
  ASSERT_TRUE(QFile::copy(path + "/scenes/A/image.png", path + "/intrinsics/more.png"));
  ASSERT_TRUE(workspace_->reread().ok());
  EXPECT_EQ(workspace_->dataset().camera_images.size(), 1U);
  EXPECT_FALSE(decision_of(decisions(), "A").use) << "decisions stay";
  EXPECT_FALSE(workspace_->up_to_date());
  // What cannot be read leaves all as it was.
  ASSERT_TRUE(QFile::remove(path + "/camera.yaml"));
  const Status failed = workspace_->reread();
  ASSERT_FALSE(failed.ok());
  EXPECT_EQ(workspace_->dataset().camera_images.size(), 1U);
}

}  // namespace
}  // namespace lvcalib::widgets::workspace_test
