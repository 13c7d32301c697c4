// SPDX-License-Identifier: GPL-3.0-or-later
#include "models/scene_model.h"

#include <QAbstractItemModelTester>
#include <QSignalSpy>

#include <gtest/gtest.h>

namespace lvcalib::widgets::scene_model_test {
namespace {

class SceneModelTest : public ::testing::Test {
 protected:
  void SetUp() override {
    Dataset dataset;
    dataset.scenes = {{"A", {}, {}, {}}, {"B", {}, {}, {}}, {"C", {}, {}, {}}};
    model_.set_scenes(dataset, {"Z"});
  }
  QString text(int row, SceneModel::Column column) const {
    return model_.index(row, column).data().toString();
  }
  static std::shared_ptr<const CalibrationResult> result() {
    auto r = std::make_shared<CalibrationResult>();
    r->scenes.resize(3);
    for (int s = 0; s < 3; ++s) r->scenes[s].name = std::string(1, static_cast<char>('A' + s));
    for (int s : {0, 1}) {
      r->scenes[s].view.emplace().tag_count = 16 - s;
      r->scenes[s].refinement.emplace().board_points = 900 + 200 * s;
    }
    r->scenes[0].used = true;
    r->scenes[1].reason = Message("contradicts the other scenes");
    r->scenes[2].reason = Message("no tags");
    SceneSolution solved;
    solved.name = "A";
    solved.used = true;
    solved.rms_px = 0.1234;
    solved.rms_mm = 0.5678;
    r->extrinsic.scenes = {solved};
    r->extrinsic.leave_one_out = {{"A", 1.25, 0.5}};
    return r;
  }
  SceneModel model_;
  QAbstractItemModelTester tester_{&model_, QAbstractItemModelTester::FailureReportingMode::Fatal};
};

TEST_F(SceneModelTest, SaysWhatIsKnownOfEachScene) {
  EXPECT_EQ(model_.rowCount(), 4);
  EXPECT_EQ(text(0, SceneModel::kState), "not run");
  EXPECT_EQ(text(3, SceneModel::kState), "missing on disk");
  EXPECT_EQ(text(0, SceneModel::kTags), "");
  model_.set_result(result());
  EXPECT_EQ(text(0, SceneModel::kTags), "16");
  EXPECT_EQ(text(0, SceneModel::kPoints), "900");
  EXPECT_EQ(text(0, SceneModel::kPixels), "0.123");
  EXPECT_EQ(text(0, SceneModel::kMillimetres), "0.57");
  EXPECT_EQ(text(0, SceneModel::kInfluence), "1.25");
  EXPECT_EQ(text(0, SceneModel::kState), "used");
  EXPECT_EQ(text(1, SceneModel::kState), "contradicts the other scenes");
  EXPECT_EQ(text(1, SceneModel::kPixels), "");
  EXPECT_EQ(text(2, SceneModel::kState), "no tags");
  // Points sort by number: 900 before 1100.
  EXPECT_LT(model_.index(0, SceneModel::kPoints).data(SceneModel::kSortRole).toInt(),
            model_.index(1, SceneModel::kPoints).data(SceneModel::kSortRole).toInt());
  EXPECT_FALSE(model_.index(0, SceneModel::kState).data(Qt::DecorationRole).isNull());
  model_.set_result(nullptr);
  EXPECT_EQ(text(0, SceneModel::kState), "not run");
}

// The list has little room: the file at fault by its name, where it lies in the tool tip.
TEST_F(SceneModelTest, AFileThatCannotBeReadIsNamedWithoutItsFolder) {
  const Message problem =
      Error::input(Message("is truncated"), "/data/rig/scenes/B/cloud.pcd").sentence();
  model_.set_problem("B", problem);
  EXPECT_EQ(text(1, SceneModel::kState), "cloud.pcd: is truncated");
  EXPECT_TRUE(model_.index(1, SceneModel::kState)
                  .data(Qt::ToolTipRole)
                  .toString()
                  .contains("/data/rig/scenes/B/cloud.pcd"));
  auto changed = std::make_shared<CalibrationResult>(*result());
  changed->scenes[1].reason = problem;
  model_.set_result(changed);
  EXPECT_EQ(text(1, SceneModel::kState), "cloud.pcd: is truncated");
  EXPECT_EQ(text(2, SceneModel::kState), "no tags") << "reasons are told as they are";
}

// How a scene that is left out fits what the others give: in the colour of what does not count.
TEST_F(SceneModelTest, ARefusedSceneKeepsItsFigures) {
  auto changed = std::make_shared<CalibrationResult>(*result());
  SceneSolution refused;
  refused.name = "B";
  refused.rms_px = 0.4;
  refused.rms_mm = 12.0;
  changed->extrinsic.scenes.push_back(refused);
  changed->scenes[1].edits.tags = {3};
  model_.set_result(changed);
  EXPECT_EQ(text(1, SceneModel::kMillimetres), "12.00");
  EXPECT_FALSE(model_.index(1, SceneModel::kMillimetres).data(Qt::ForegroundRole).isNull());
  EXPECT_TRUE(model_.index(0, SceneModel::kMillimetres).data(Qt::ForegroundRole).isNull());
  EXPECT_TRUE(model_.index(1, SceneModel::kMillimetres)
                  .data(Qt::ToolTipRole)
                  .toString()
                  .contains("Left out: how it fits"));
  EXPECT_TRUE(model_.index(1, SceneModel::kState)
                  .data(Qt::ToolTipRole)
                  .toString()
                  .contains("Left out by hand: tag no. 3."));
}

TEST_F(SceneModelTest, WhatTheProgramRefusedOfASceneIsSaid) {
  auto changed = std::make_shared<CalibrationResult>(*result());
  SceneSolution& solved = changed->extrinsic.scenes[0];
  NodeResidual circle;
  circle.id = 4;
  circle.used = false;
  solved.nodes = {circle};
  CornerResidual corner;
  corner.feature_id = 7;
  corner.used = false;
  solved.corners = {corner};
  model_.set_result(changed);
  for (const int column : {SceneModel::kState, SceneModel::kTags, SceneModel::kPoints}) {
    const QString tip = model_.index(0, column).data(Qt::ToolTipRole).toString();
    EXPECT_TRUE(tip.contains("Left out by the program: tag no. 7, circle no. 4."))
        << tip.toStdString();
  }
  EXPECT_FALSE(
      model_.index(1, SceneModel::kState).data(Qt::ToolTipRole).toString().contains("program"));
}

// A row with tags refused does not look like one that is used whole.
TEST_F(SceneModelTest, OfTagsThatWereRefusedItIsSaidHowManyAreUsed) {
  auto changed = std::make_shared<CalibrationResult>(*result());
  for (const int tag : {2, 6, 10}) {
    for (int k = 0; k < 4; ++k) {
      CornerResidual corner;
      corner.feature_id = tag;
      corner.used = k != 0;
      changed->extrinsic.scenes[0].corners.push_back(corner);
    }
  }
  model_.set_result(changed);
  EXPECT_EQ(text(0, SceneModel::kTags), "13/16");
  EXPECT_EQ(text(1, SceneModel::kTags), "15") << "of another scene";
  EXPECT_EQ(model_.index(0, SceneModel::kTags).data(SceneModel::kSortRole).toInt(), 16);
  EXPECT_TRUE(model_.index(0, SceneModel::kTags)
                  .data(Qt::ToolTipRole)
                  .toString()
                  .contains("Left out by the program: tag no. 2, 6, 10."));
}

// In full where there is room, by a word where there is less, by the sign alone where there is
// none.
TEST_F(SceneModelTest, TheStateIsSaidWholeOrNotAtAll) {
  model_.set_result(result());
  const QFontMetrics metrics{QFont()};
  const QString words = "contradicts the other scenes";
  for (int room = -10; room < 400; ++room) {
    model_.set_state_room(metrics, room);
    const QString said = text(1, SceneModel::kState);
    EXPECT_TRUE(said.isEmpty() || metrics.horizontalAdvance(said) <= room) << room;
    EXPECT_TRUE(said == words || said == "refused" || said.isEmpty()) << said.toStdString();
    EXPECT_EQ(said.isEmpty(), metrics.horizontalAdvance("refused") > room) << room;
    EXPECT_EQ(said == words, metrics.horizontalAdvance(words) <= room) << room;
    EXPECT_EQ(model_.index(1, SceneModel::kState).data(Qt::AccessibleTextRole).toString(), words);
  }
}

TEST_F(SceneModelTest, DecisionsShowAndTicksOnlyAsk) {
  Decisions decisions;
  decisions.scenes["B"].use = false;
  decisions.scenes["A"].crop = CropBox{};
  model_.set_decisions(decisions);
  model_.set_result(result());
  EXPECT_EQ(text(1, SceneModel::kState), "rejected");
  EXPECT_EQ(text(0, SceneModel::kState), "used (cropped)");
  QSignalSpy wanted(&model_, &SceneModel::use_wanted);
  EXPECT_TRUE(model_.setData(model_.index(1, 0), Qt::Checked, Qt::CheckStateRole));
  ASSERT_EQ(wanted.count(), 1);
  EXPECT_EQ(wanted.first().first().toString(), "B");
  EXPECT_TRUE(wanted.first().last().toBool());
  EXPECT_EQ(model_.index(1, 0).data(Qt::CheckStateRole).toInt(), Qt::Unchecked);
  EXPECT_FALSE(model_.setData(model_.index(3, 0), Qt::Checked, Qt::CheckStateRole)) << "missing";
  EXPECT_TRUE(model_.index(3, 0).data(Qt::CheckStateRole).isNull());
}

TEST_F(SceneModelTest, ThumbnailsStayWithTheirScenes) {
  QSignalSpy changed(&model_, &QAbstractItemModel::dataChanged);
  model_.set_thumbnail("B", QImage(4, 4, QImage::Format_RGB32));
  ASSERT_EQ(changed.count(), 1);
  EXPECT_FALSE(model_.index(1, 0).data(Qt::DecorationRole).value<QPixmap>().isNull());
  EXPECT_TRUE(model_.index(0, 0).data(Qt::DecorationRole).value<QPixmap>().isNull());
  // Scenes of another dataset by the same names have pictures of their own.
  Dataset other;
  other.path = "/elsewhere";
  other.scenes = {{"A", {}, {}, {}}, {"B", {}, {}, {}}};
  model_.set_scenes(other, {});
  EXPECT_TRUE(model_.index(1, 0).data(Qt::DecorationRole).value<QPixmap>().isNull());
  EXPECT_EQ(model_.row_of("B"), 1);
  EXPECT_EQ(model_.row_of("nobody"), -1);
  EXPECT_EQ(model_.scene_at(9), "");
}

}  // namespace
}  // namespace lvcalib::widgets::scene_model_test
