// SPDX-License-Identifier: GPL-3.0-or-later
#include "docks/scenes_dock.h"

#include <QAction>
#include <QHeaderView>
#include <QLineEdit>
#include <QMimeData>
#include <QScrollBar>
#include <QSignalSpy>
#include <QTest>
#include <QToolButton>
#include <QTreeView>
#include <memory>
#include <set>

#include <gtest/gtest.h>

#include "models/scene_model.h"

namespace lvcalib::widgets::scenes_dock_test {
namespace {

class ScenesDockTest : public ::testing::Test {
 protected:
  ScenesDockTest() {
    Dataset dataset;
    dataset.scenes = {{"A", {}, {}, {}}, {"B", {}, {}, {}}, {"C", {}, {}, {}}};
    model_.set_scenes(dataset, {"Z"});
    dock_.show();
    QCoreApplication::processEvents();
    view_ = dock_.findChild<QTreeView*>("scenes");
  }
  QAction* action(const char* name) { return dock_.findChild<QAction*>(name); }

  SceneModel model_;
  ScenesDock dock_{model_};
  QTreeView* view_ = nullptr;
};

TEST_F(ScenesDockTest, ActionsAreForTheSelectedScenesThatExist) {
  EXPECT_FALSE(action("reject")->isEnabled());
  EXPECT_TRUE(action("add_scenes")->isEnabled());
  view_->selectAll();
  EXPECT_EQ(dock_.selected(), (QStringList{"A", "B", "C"}));
  QSignalSpy use(&dock_, &ScenesDock::use_wanted);
  action("reject")->trigger();
  action("accept")->trigger();
  ASSERT_EQ(use.count(), 2);
  EXPECT_EQ(use.at(0).at(0).toStringList().size(), 3);
  EXPECT_FALSE(use.at(0).at(1).toBool());
  EXPECT_TRUE(use.at(1).at(1).toBool());
}

// Their column would be empty, and the pages need its room.
TEST_F(ScenesDockTest, OnlyABoardWithTagsHasAColumnForThem) {
  const auto open = [&](TargetType type) {
    Dataset dataset;
    dataset.target.type = type;
    dataset.scenes = {{"A", {}, {}, {}}};
    model_.set_scenes(dataset, {});
    QCoreApplication::processEvents();
  };
  EXPECT_FALSE(view_->isColumnHidden(SceneModel::kTags));
  const int with = view_->minimumWidth();
  open(TargetType::kCheckerboard);
  EXPECT_TRUE(view_->isColumnHidden(SceneModel::kTags));
  EXPECT_LT(view_->minimumWidth(), with);
  open(TargetType::kAprilGrid);
  EXPECT_FALSE(view_->isColumnHidden(SceneModel::kTags));
}

// They take more lines where the list is narrow; none hides behind an arrow.
TEST_F(ScenesDockTest, AllToolsAreSeenHoweverNarrowTheListIs) {
  for (const int width : {view_->minimumWidth(), 600}) {
    dock_.resize(width, 300);
    QTest::qWait(20);
    int seen = 0;
    for (const QToolButton* button : dock_.widget()->findChildren<QToolButton*>()) {
      if (!button->isVisible()) continue;
      ++seen;
      EXPECT_GE(button->width(), button->sizeHint().width()) << width;
      const QRect place(button->mapTo(dock_.widget(), QPoint()), button->size());
      EXPECT_TRUE(dock_.widget()->rect().contains(place)) << width;
    }
    EXPECT_EQ(seen, 4) << "without that which overrules a refusal";
  }
}

// No heading has an arrow, and room for one, before the list is sorted.
TEST_F(ScenesDockTest, AClickOnAHeadingSortsAndTheThirdBringsTheOwnOrderBack) {
  dock_.resize(600, 300);
  QTest::qWait(20);
  QHeaderView* header = view_->header();
  EXPECT_FALSE(header->isSortIndicatorShown());
  const int unsorted = header->sectionSizeHint(SceneModel::kTags);
  const auto click = [&] {
    QTest::mouseClick(header->viewport(), Qt::LeftButton, {},
                      {header->sectionViewportPosition(SceneModel::kName) + 8, 6});
  };
  click();
  EXPECT_TRUE(header->isSortIndicatorShown());
  EXPECT_GT(header->sectionSizeHint(SceneModel::kTags), unsorted);
  EXPECT_EQ(header->sortIndicatorSection(), SceneModel::kName);
  click();
  EXPECT_EQ(view_->model()->index(0, 0).data().toString(), "Z");
  click();
  EXPECT_FALSE(header->isSortIndicatorShown());
  EXPECT_EQ(view_->model()->index(0, 0).data().toString(), "A");
}

TEST_F(ScenesDockTest, ANarrowListGivesUpPicturesAndNoColumn) {
  for (const char* name : {"A", "B", "C"}) {
    QImage picture(48, 30, QImage::Format_RGB32);
    picture.fill(Qt::gray);
    model_.set_thumbnail(name, picture);
  }
  auto result = std::make_shared<CalibrationResult>();
  for (const char* name : {"A", "B", "C"}) {
    SceneResult scene;
    scene.name = name;
    scene.used = true;
    scene.view.emplace().tag_count = 16;
    scene.refinement.emplace().board_points = 74642;
    result->scenes.push_back(scene);
    SceneSolution solved;
    solved.name = name;
    solved.rms_px = 0.123;
    solved.rms_mm = 12.3;
    result->extrinsic.scenes.push_back(solved);
    result->extrinsic.leave_one_out.push_back({name, 0.12, 0.1});
  }
  model_.set_result(result);
  dock_.resize(700, 300);
  QTest::qWait(20);
  EXPECT_EQ(model_.thumbnail_width(), 48);
  const auto in_sight = [this] {
    int right = 0;
    for (int column = 0; column < view_->header()->count(); ++column) {
      if (view_->isColumnHidden(column)) continue;
      right = std::max(right, view_->columnViewportPosition(column) + view_->columnWidth(column));
    }
    return right <= view_->viewport()->width();
  };
  EXPECT_TRUE(in_sight());
  int narrow = 700;
  while (narrow > 100 && model_.thumbnail_width() > 0) {
    dock_.resize(narrow -= 10, 300);
    QTest::qWait(5);
    EXPECT_TRUE(in_sight() || model_.thumbnail_width() == 0) << narrow;
    // The usual state is read in full or not said at all.
    const QModelIndex state = view_->model()->index(0, SceneModel::kState);
    const QAbstractItemView& rows = *view_;
    EXPECT_TRUE(state.data().toString().isEmpty() ||
                view_->columnWidth(SceneModel::kState) >= rows.sizeHintForIndex(state).width())
        << narrow;
    EXPECT_FALSE(state.data(Qt::AccessibleTextRole).toString().isEmpty());
  }
  EXPECT_EQ(model_.thumbnail_width(), 0);
  EXPECT_TRUE(in_sight()) << narrow;
  // The heading of the state is whole.
  EXPECT_GE(view_->columnWidth(SceneModel::kState),
            view_->header()->sectionSizeHint(SceneModel::kState));
  dock_.resize(700, 300);
  QTest::qWait(20);
  EXPECT_EQ(model_.thumbnail_width(), 48);
}

// Before a run and beside rejected scenes the words are longer than the usual "used".
TEST_F(ScenesDockTest, NoStateIsCutHoweverNarrowTheListIs) {
  Dataset dataset;
  for (const char* name : {"morning_of_the_third_01", "B", "C"})
    dataset.scenes.push_back({name, {}, {}, {}});
  const auto expect_whole = [this](const char* when) {
    std::set<QString> said;
    for (int width = 700; width > 100; width -= 7) {
      dock_.resize(width, 300);
      QTest::qWait(5);
      const QAbstractItemView& rows = *view_;
      for (int row = 0; row < view_->model()->rowCount(); ++row) {
        const QModelIndex at = view_->model()->index(row, SceneModel::kState);
        said.insert(at.data().toString());
        EXPECT_TRUE(at.data().toString().isEmpty() ||
                    rows.sizeHintForIndex(at).width() <= view_->columnWidth(SceneModel::kState))
            << when << ", " << dock_.width() << " px: " << at.data().toString().toStdString();
      }
    }
    return said;
  };
  model_.set_scenes(dataset, {"Z"});
  EXPECT_EQ(expect_whole("not run"),
            (std::set<QString>{"", "missing", "missing on disk", "not run"}));
  Decisions decisions;
  decisions.scenes["B"].use = false;
  model_.set_decisions(decisions);
  auto result = std::make_shared<CalibrationResult>();
  for (const char* name : {"morning_of_the_third_01", "B", "C"}) {
    SceneResult scene;
    scene.name = name;
    scene.view.emplace().tag_count = 16;
    scene.refinement.emplace().board_points = 74642;
    scene.used = scene.name != "C";
    if (!scene.used) scene.reason = Message("contradicts the other scenes");
    result->scenes.push_back(scene);
  }
  model_.set_result(result);
  EXPECT_EQ(expect_whole("rejected"),
            (std::set<QString>{"", "contradicts the other scenes", "missing", "missing on disk",
                               "refused", "rejected", "used"}));
}

// A bar beside the list leaves room for smaller pictures, whose rows need no bar: the list has to
// settle all the same.
TEST_F(ScenesDockTest, AListAsLongAsItsPlaceSettles) {
  Dataset dataset;
  for (int k = 0; k < 8; ++k) dataset.scenes.push_back({"scene_0" + std::to_string(k), {}, {}, {}});
  model_.set_scenes(dataset, {});
  QImage picture(48, 30, QImage::Format_RGB32);
  picture.fill(Qt::gray);
  for (int k = 0; k < 8; ++k) model_.set_thumbnail(model_.scene_at(k), picture);
  int changes = 0;
  QObject::connect(&model_, &QAbstractItemModel::dataChanged, view_, [&] {
    // Ends what would go on forever.
    if (++changes > 50) view_->setVerticalScrollBarPolicy(Qt::ScrollBarAlwaysOn);
  });
  std::set<bool> barred;
  for (int height = 200; height < 480; height += 20) {
    for (int width = 500; width > 200; width -= 6) {
      changes = 0;
      dock_.resize(width, height);
      QTest::qWait(2);
      ASSERT_LE(changes, 50) << dock_.width() << "×" << dock_.height();
      const bool bar = view_->verticalScrollBar()->isVisible();
      barred.insert(bar);
      EXPECT_FALSE(view_->horizontalScrollBar()->isVisible())
          << dock_.width() << "×" << dock_.height();
    }
  }
  EXPECT_EQ(barred.size(), 2U);
}

// Pages that ask for room push no column out of sight, and a long note asks for none.
TEST_F(ScenesDockTest, AsksForTheRoomOfItsColumns) {
  const auto columns = [this] {
    int width = 0;
    const QAbstractItemView& rows = *view_;
    for (int column = 0; column < view_->header()->count(); ++column) {
      if (view_->isColumnHidden(column) || column == SceneModel::kNote) continue;
      const int heading = view_->header()->sectionSizeHint(column);
      // The state may be said by its sign alone.
      width += column == SceneModel::kState ? heading
                                            : std::max(heading, rows.sizeHintForColumn(column));
    }
    return width;
  };
  dock_.resize(100, 300);
  QTest::qWait(20);
  EXPECT_GE(view_->viewport()->width(), columns());
  Decisions decisions;
  decisions.scenes["A"].note = std::string(400, 'n');
  model_.set_decisions(decisions);
  QTest::qWait(20);
  EXPECT_LT(dock_.minimumSizeHint().width(), 500);
}

TEST_F(ScenesDockTest, SpaceTicksAndArrowsChangeTheSceneLookedAt) {
  dock_.select("A");
  QSignalSpy activated(&dock_, &ScenesDock::scene_activated);
  QSignalSpy use(&dock_, &ScenesDock::use_wanted);
  QTest::keyClick(view_, Qt::Key_Down);
  ASSERT_EQ(activated.count(), 1);
  EXPECT_EQ(activated.last().first().toString(), "B");
  QTest::keyClick(view_, Qt::Key_Space);
  ASSERT_EQ(use.count(), 1);
  EXPECT_EQ(use.first().first().toStringList(), QStringList{"B"});
  EXPECT_FALSE(use.first().last().toBool());
  // A missing scene is not looked at.
  QTest::keyClick(view_, Qt::Key_End);
  EXPECT_NE(activated.last().first().toString(), "Z");
}

// The state stands beside the name, and a click anywhere in a row looks at its scene.
TEST_F(ScenesDockTest, AClickLooksAtAScene) {
  dock_.resize(420, 300);
  dock_.select("A");
  QCoreApplication::processEvents();
  EXPECT_EQ(view_->header()->visualIndex(SceneModel::kState), 1);
  QSignalSpy activated(&dock_, &ScenesDock::scene_activated);
  for (const int column : {SceneModel::kName, SceneModel::kState, SceneModel::kInfluence}) {
    dock_.select("A");
    const QRect cell = view_->visualRect(view_->model()->index(1, column));
    EXPECT_LE(cell.right(), view_->viewport()->width()) << column;
    QTest::mouseClick(view_->viewport(), Qt::LeftButton, {},
                      QPoint(cell.right() - 4, cell.center().y()));
    EXPECT_EQ(activated.last().first().toString(), "B") << column;
  }
}

TEST_F(ScenesDockTest, ARefusedSceneCanBeInsistedOn) {
  auto result = std::make_shared<CalibrationResult>();
  result->scenes.resize(3);
  for (int s = 0; s < 3; ++s) {
    result->scenes[s].name = std::string(1, static_cast<char>('A' + s));
    result->scenes[s].view.emplace();
    result->scenes[s].refinement.emplace();
    result->scenes[s].used = s != 1;
  }
  result->scenes[1].reason = Message("contradicts the others");
  model_.set_result(result);
  dock_.select("A");
  EXPECT_FALSE(action("use_all_the_same")->isVisible());
  dock_.select("B");
  ASSERT_TRUE(action("use_all_the_same")->isVisible());
  QSignalSpy insist(&dock_, &ScenesDock::insist_wanted);
  action("use_all_the_same")->trigger();
  ASSERT_EQ(insist.count(), 1);
  EXPECT_EQ(insist.first().first().toStringList(), QStringList{"B"});
  EXPECT_TRUE(insist.first().last().toBool());
}

// The menu of the list belongs to the row under the pointer.
TEST_F(ScenesDockTest, TheMenuRunsTheClickedSceneAgain) {
  dock_.select("A");
  ASSERT_EQ(view_->contextMenuPolicy(), Qt::ActionsContextMenu);
  for (const char* name : {"accept", "reject", "run_again", "uncrop", "add_scenes"})
    EXPECT_TRUE(view_->actions().contains(action(name))) << name;
  const QModelIndex row =
      view_->model()->match(view_->model()->index(0, 0), Qt::DisplayRole, "B")[0];
  QTest::mouseClick(view_->viewport(), Qt::RightButton, Qt::NoModifier,
                    view_->visualRect(row).center());
  QSignalSpy again(&dock_, &ScenesDock::run_again_wanted);
  ASSERT_TRUE(action("run_again")->isEnabled());
  action("run_again")->trigger();
  ASSERT_EQ(again.count(), 1);
  EXPECT_EQ(again.first().first().toStringList(), QStringList{"B"});
}

TEST_F(ScenesDockTest, SortsByAnyColumn) {
  view_->sortByColumn(SceneModel::kName, Qt::DescendingOrder);
  EXPECT_EQ(view_->model()->index(0, 0).data().toString(), "Z");
  dock_.select("C");
  EXPECT_EQ(dock_.selected(), QStringList{"C"});
}

TEST_F(ScenesDockTest, ScenesAreMovedByKeysAndBroughtInOrder) {
  QSignalSpy order(&dock_, &ScenesDock::order_wanted);
  dock_.select("C");
  action("scene_up")->trigger();
  ASSERT_EQ(order.count(), 1);
  EXPECT_EQ(order[0][0].toStringList(), (QStringList{"A", "C", "B", "Z"}));
  Decisions decisions;
  decisions.scene_order = {"C", "A"};
  model_.set_decisions(decisions);
  EXPECT_EQ(model_.scene_at(0), "C");
  EXPECT_EQ(model_.scene_at(2), "B");
  EXPECT_EQ(model_.scene_at(3), "Z");
  EXPECT_EQ(dock_.selected(), QStringList{"C"});  // The selection goes with its scene.
  action("scene_up")->trigger();
  EXPECT_EQ(order.count(), 1);  // It is the first already.
  action("scene_down")->trigger();
  EXPECT_EQ(order[1][0].toStringList(), (QStringList{"A", "C", "B", "Z"}));
  // Sorted by a column there is no place to move to.
  view_->sortByColumn(SceneModel::kName, Qt::DescendingOrder);
  EXPECT_FALSE(action("scene_up")->isEnabled());
  EXPECT_FALSE(view_->dragEnabled());
}

TEST_F(ScenesDockTest, ADropAsksForTheOrder) {
  QSignalSpy order(&dock_, &ScenesDock::order_wanted);
  const std::unique_ptr<QMimeData> data(model_.mimeData({model_.index(0, 0), model_.index(0, 1)}));
  EXPECT_TRUE(model_.canDropMimeData(data.get(), Qt::MoveAction, 2, 0, {}));
  model_.dropMimeData(data.get(), Qt::MoveAction, 2, 0, {});
  ASSERT_EQ(order.count(), 1);
  EXPECT_EQ(order[0][0].toStringList(), (QStringList{"B", "A", "C", "Z"}));
  QMimeData other;
  other.setText("A");
  model_.dropMimeData(&other, Qt::MoveAction, 2, 0, {});
  EXPECT_EQ(order.count(), 1);
}

TEST_F(ScenesDockTest, ANoteIsWrittenInTheList) {
  QSignalSpy notes(&dock_, &ScenesDock::note_wanted);
  EXPECT_TRUE(view_->isColumnHidden(SceneModel::kNote));
  dock_.select("B");
  action("note")->trigger();
  auto* editor = view_->findChild<QLineEdit*>();
  ASSERT_NE(editor, nullptr);
  QTest::keyClicks(editor, "wind shook it");
  QTest::keyClick(editor, Qt::Key_Return);
  QCoreApplication::processEvents();  // The delegate commits after the key.
  ASSERT_EQ(notes.count(), 1);
  EXPECT_EQ(notes[0], (QVariantList{"B", "wind shook it"}));
  // Notes of an opened project are in sight.
  view_->setColumnHidden(SceneModel::kNote, true);
  Decisions decisions;
  decisions.scenes["B"].note = "wind shook it";
  model_.set_decisions(decisions);
  EXPECT_FALSE(view_->isColumnHidden(SceneModel::kNote));
  EXPECT_EQ(model_.index(1, SceneModel::kNote).data().toString(), "wind shook it");
}

}  // namespace
}  // namespace lvcalib::widgets::scenes_dock_test
