// SPDX-License-Identifier: GPL-3.0-or-later
#include "pages/scene_page.h"

#include <QAbstractItemView>
#include <QAction>
#include <QComboBox>
#include <QLabel>
#include <QPushButton>
#include <QSignalSpy>
#include <QTest>
#include <QToolButton>
#include <numeric>

#include <gtest/gtest.h>

#include "pages/cloud_pane.h"
#include "pages/image_pane.h"
#include "pages/scene_overlay.h"
#include "views/cloud_view.h"
#include "views/image_view.h"
#include "views/lasso.h"
#include "widgets/support/calibrated_demo.h"

namespace lvcalib::widgets::scene_page_test {
namespace {

class ScenePageTest : public ::testing::Test {
 protected:
  void SetUp() override {
    page_.resize(1280, 760);
    page_.show();
    ASSERT_TRUE(QTest::qWaitForWindowExposed(&page_));
  }
  void load() {
    page_.setResult(demo_.result);
    page_.setScene(1);
    page_.setSceneData(demo_.clouds[1], demo_.images[1]);
    ASSERT_TRUE(settle());
  }
  bool settle() {
    return QTest::qWaitFor(
        [&] {
          const CloudView* view = page_.cloudPane()->view();
          return !page_.cloudPane()->busy() && (!view->hasOpenGl() || view->canvas()->complete());
        },
        20'000);
  }
  [[nodiscard]] QString selection() const { return page_.findChild<QLabel*>("selection")->text(); }
  [[nodiscard]] ImageView& image() { return *page_.imagePane()->view(); }
  [[nodiscard]] const CloudScene& cloud() { return *page_.cloudPane()->view()->scene(); }
  // Chooses an entry as a user does: focus and keys.
  void choose(const char* name, int index) {
    auto* box = page_.findChild<QComboBox*>(name);
    box->setFocus();
    QTest::keyClick(box, Qt::Key_Home);
    for (int k = 0; k < index; ++k) QTest::keyClick(box, Qt::Key_Down);
    ASSERT_EQ(box->currentIndex(), index);
    ASSERT_TRUE(settle());
  }

  const test::CalibratedDemo& demo_ = test::calibrated_demo();
  ScenePage page_;
};

TEST_F(ScenePageTest, ShowsCloudImageAndFindings) {
  load();
  EXPECT_EQ(cloud().size(), demo_.clouds[1]->size());
  EXPECT_EQ(image().image().size(), demo_.images[1].size());
  const ImageOverlay& overlay = image().overlay().overlay();
  EXPECT_EQ(overlay.tags.size(), 16U);
  EXPECT_EQ(overlay.circles.size(), 9U);
  EXPECT_GT(overlay.points.size(), 1000U);
}

TEST_F(ScenePageTest, MeasurementsSelectedElsewhereAreFoundInCloudAndImage) {
  load();
  const Cloud& board = demo_.result->scenes[1].board_points;
  std::vector<Eigen::Vector3d> points;
  for (std::size_t k = 0; k < board.size(); k += board.size() / 50)
    points.push_back(1.02 * board.points_m[k].cast<double>());  // Same beams, other ranges.
  page_.selectSamples(points, {});
  EXPECT_GT(image().overlay().highlights().size(), 30U);
  EXPECT_TRUE(selection().contains("selected on the Model page"));
  page_.selectSamples({}, {Eigen::Vector2d(100.0, 50.0)});
  ASSERT_EQ(image().overlay().highlights().size(), 1U);
  EXPECT_EQ(image().overlay().highlights().front(), QPointF(100.0, 50.0));
}

TEST_F(ScenePageTest, FilterAndColourAreChosen) {
  load();
  choose("cloud-filter", 2);
  EXPECT_EQ(cloud().size(), demo_.result->scenes[1].board_points.size());
  choose("cloud-color", 3);
  EXPECT_TRUE(cloud().quantity.contains("base model")) << cloud().quantity.toStdString();
  EXPECT_LT(cloud().whole.high, 10.0) << "means, not single returns";
  EXPECT_EQ(cloud().scale.map, ColorMap::kDiverging);
  choose("cloud-filter", 3);
  EXPECT_GT(cloud().size(), 100U);
  EXPECT_LT(cloud().size(), demo_.result->scenes[1].board_points.size());
  choose("cloud-color", 4);
  EXPECT_FALSE(cloud().has_scale);
  EXPECT_TRUE(cloud().notice.isEmpty());
}

// The tag in the image and the points on it in the cloud.
TEST_F(ScenePageTest, ATagInTheImageFindsItsPoints) {
  load();
  const ImageOverlay::Tag& tag = image().overlay().overlay().tags[6];
  QTest::mouseClick(image().viewport(), Qt::LeftButton, {},
                    image().mapFromScene(tag.corners.boundingRect().center()));
  EXPECT_EQ(image().overlay().highlightedTag(), tag.id);
  EXPECT_TRUE(selection().contains(QString("Tag %1").arg(tag.id)));
  EXPECT_TRUE(selection().contains("LiDAR points on it"));
}

TEST_F(ScenePageTest, APixelFindsTheNearestPoint) {
  load();
  // Somewhere in the image where the LiDAR measured.
  const ImageOverlay& overlay = image().overlay().overlay();
  QPointF place;
  for (const QPointF& p : overlay.points) {
    bool on_tag = false;
    for (const auto& tag : overlay.tags) on_tag |= tag.corners.containsPoint(p, Qt::OddEvenFill);
    if (!on_tag && QRectF(200, 150, 600, 350).contains(p)) place = p;
  }
  ASSERT_FALSE(place.isNull());
  QTest::mouseClick(image().viewport(), Qt::LeftButton, {}, image().mapFromScene(place));
  EXPECT_TRUE(selection().contains("Nearest: Point")) << selection().toStdString();
  EXPECT_TRUE(selection().contains("range"));
  EXPECT_GE(image().overlay().highlights().size(), 2U);
}

TEST_F(ScenePageTest, APointInTheCloudFindsItsPixel) {
  load();
  CloudView* view = page_.cloudPane()->view();
  if (!view->hasOpenGl()) GTEST_SKIP() << "no OpenGL 3.2 here (run under xvfb-run)";
  view->look(CloudViewpoint::kSensor);
  ASSERT_TRUE(settle());
  QTest::mouseClick(view->canvas(), Qt::LeftButton, {}, view->canvas()->rect().center());
  ASSERT_TRUE(selection().startsWith("Point")) << selection().toStdString();
  ASSERT_EQ(image().overlay().highlights().size(), 1U);
  const QPointF pixel = image().overlay().highlights()[0];
  EXPECT_TRUE(selection().contains(QString("pixel (%1").arg(pixel.x(), 0, 'f', 1)));
}

// The letter that looks at the cloud from elsewhere chooses an entry where a list has the focus.
TEST_F(ScenePageTest, LettersInAListAreTheLists) {
  load();
  auto* crop = page_.findChild<QAction*>("crop-action");
  auto* colors = page_.findChild<QComboBox*>("cloud-color");
  colors->setFocus();
  QTest::keyClick(colors, Qt::Key_C);
  EXPECT_FALSE(crop->isChecked());
  EXPECT_EQ(colors->currentText(), "Camera colour");
  // Nor while it is open.
  auto* brush = page_.findChild<QAction*>("cloud-brush");
  colors->showPopup();
  for (const Qt::Key key : {Qt::Key_C, Qt::Key_L, Qt::Key_T}) QTest::keyClick(colors->view(), key);
  colors->hidePopup();
  EXPECT_FALSE(crop->isChecked());
  EXPECT_FALSE(brush->isChecked());
}

TEST_F(ScenePageTest, TheBoardIsKnownToTheViewAndDistancesAreMeasured) {
  load();
  EXPECT_GT(cloud().board_radius_m, 0.3);
  const CloudView* view = page_.cloudPane()->view();
  Q_EMIT page_.cloudPane()->view()->pointPicked(10);
  EXPECT_FALSE(selection().contains("picked before"));
  Q_EMIT page_.cloudPane()->view()->pointPicked(500);
  const auto& points = view->scene()->cloud->points_m;
  const double distance = (points[500] - points[10]).norm();
  EXPECT_TRUE(selection().contains(QString("%1 m from point 10").arg(distance, 0, 'f', 4)))
      << selection().toStdString();
}

TEST_F(ScenePageTest, ARefusedSceneSaysSoAndCanBeUsedAllTheSame) {
  load();
  auto* label = page_.findChild<QLabel*>("scene-refusal");
  EXPECT_FALSE(label->isVisible());
  auto refused = std::make_shared<CalibrationResult>(*demo_.result);
  refused->scenes[1].used = false;
  refused->scenes[1].reason = Message("contradicts the others");
  page_.setResult(refused);
  EXPECT_TRUE(label->isVisible());
  EXPECT_TRUE(label->text().contains("contradicts the others"));
  QSignalSpy insist(&page_, &ScenePage::insistWanted);
  Q_EMIT label->linkActivated("insist");
  ASSERT_EQ(insist.count(), 1);
  EXPECT_EQ(insist.first().first().toInt(), 1);
}

// What a line about the image holds is selected as it is shown, and can be left out.
TEST_F(ScenePageTest, TagsAreBrushedInTheImageAndLeftOut) {
  load();
  auto* exclude = page_.findChild<QToolButton*>("exclude");
  EXPECT_FALSE(exclude->isVisible());
  page_.findChild<QAction*>("show-circles")->setChecked(false);
  page_.findChild<QAction*>("image-brush")->setChecked(true);
  const ImageOverlay::Tag tag = image().overlay().overlay().tags[6];
  const QRectF box = tag.corners.boundingRect().adjusted(-4, -4, 4, 4);
  auto* lasso = image().findChild<Lasso*>();
  const auto at = [&](const QPointF& p) { return image().mapFromScene(p); };
  QTest::mousePress(lasso, Qt::LeftButton, {}, at(box.topLeft()));
  for (const QPointF& p : {box.topRight(), box.bottomRight(), box.bottomLeft()})
    QTest::mouseMove(lasso, at(p));
  QTest::mouseRelease(lasso, Qt::LeftButton, {}, at(box.topLeft()));
  EXPECT_TRUE(selection().contains(QString("Selected: tag no. %1").arg(tag.id)))
      << selection().toStdString();
  ASSERT_TRUE(exclude->isVisible());
  QSignalSpy edits(&page_, &ScenePage::editsChanged);
  QTest::mouseClick(exclude, Qt::LeftButton, {}, {8, exclude->height() / 2});
  ASSERT_EQ(edits.count(), 1);
  EXPECT_EQ(edits[0][0].toInt(), 1);
  EXPECT_EQ(edits[0][1].value<SceneEdits>().tags, std::vector<int>{tag.id});
}

// As a result has it that was made with them: struck through, named, and taken back.
TEST_F(ScenePageTest, WhatIsLeftOutIsShownAndTakenBack) {
  load();
  auto changed = std::make_shared<CalibrationResult>(*demo_.result);
  SceneResult& scene = changed->scenes[1];
  const int tag = scene.view->corners.front().feature_id;
  scene.edits.tags = {tag};
  scene.edits.points_m = {scene.board_points.points_m[100], scene.board_points.points_m[200]};
  scene.left_out_corners = take_out(*scene.view, scene.edits);
  scene.left_out_points = take_out(scene.board_points, scene.edits, changed->target,
                                   scene.refinement->lidar_from_board);
  page_.setResult(changed);
  page_.setEdits(scene.edits);
  ASSERT_TRUE(settle());
  auto* label = page_.findChild<QLabel*>("scene-edits");
  EXPECT_TRUE(label->isVisible());
  EXPECT_TRUE(label->text().contains(QString("2 points, tag no. %1").arg(tag)))
      << label->text().toStdString();
  const auto& overlay = image().overlay().overlay();
  EXPECT_EQ(overlay.left_out_points.size(), 2U);
  int struck = 0;
  for (const auto& t : overlay.tags) struck += t.left_out ? 1 : 0;
  EXPECT_EQ(struck, 1);
  // One of the points is selected again, and the tag.
  std::uint32_t place = 0;
  while (cloud().cloud->points_m[place] != scene.edits.points_m[0]) ++place;
  Q_EMIT page_.cloudPane()->view()->pointPicked(place);
  auto* back = page_.findChild<QToolButton*>("take-back");
  ASSERT_TRUE(back->isVisible());
  EXPECT_FALSE(page_.findChild<QToolButton*>("exclude")->isVisible());
  QSignalSpy edits(&page_, &ScenePage::editsChanged);
  QTest::mouseClick(back, Qt::LeftButton);
  ASSERT_EQ(edits.count(), 1);
  EXPECT_EQ(edits[0][1].value<SceneEdits>().points_m,
            std::vector<Eigen::Vector3f>{scene.edits.points_m[1]});
  EXPECT_EQ(edits[0][1].value<SceneEdits>().tags, scene.edits.tags);
  Q_EMIT label->linkActivated("undo");
  EXPECT_TRUE(edits[1][1].value<SceneEdits>().empty());
}

// As a tag is: a click on the hatched part says why, and takes it back.
TEST_F(ScenePageTest, APartLeftOutByHandIsTakenBackInTheImage) {
  load();
  auto changed = std::make_shared<CalibrationResult>(*demo_.result);
  SceneResult& scene = changed->scenes[1];
  const Eigen::Vector2d middle = changed->target.outline().center_m();
  const BoardOutline part{middle - Eigen::Vector2d(0.06, 0.02),
                          middle + Eigen::Vector2d(0.06, 0.02)};
  scene.edits.patches_m = {part.corners_m()};
  scene.left_out_points = take_out(scene.board_points, scene.edits, changed->target,
                                   scene.refinement->lidar_from_board);
  ASSERT_GT(scene.left_out_points.size(), 10U);
  page_.setResult(changed);
  page_.setEdits(scene.edits);
  ASSERT_TRUE(settle());
  for (const char* name : {"show-tags", "show-circles"}) {
    if (auto* action = page_.findChild<QAction*>(name)) action->setChecked(false);
  }
  const auto& parts = image().overlay().overlay().parts;
  ASSERT_EQ(parts.size(), 1U);
  QTest::mouseClick(image().viewport(), Qt::LeftButton, {},
                    image().mapFromScene(parts[0].edge.boundingRect().center()));
  EXPECT_TRUE(selection().contains("left out by hand")) << selection().toStdString();
  auto* back = page_.findChild<QToolButton*>("take-back");
  ASSERT_TRUE(back->isVisible());
  QSignalSpy edits(&page_, &ScenePage::editsChanged);
  QTest::mouseClick(back, Qt::LeftButton);
  ASSERT_EQ(edits.count(), 1);
  EXPECT_TRUE(edits[0][1].value<SceneEdits>().empty());
}

TEST_F(ScenePageTest, PointsBrushedInTheCloudAreThoseAboutTheBoard) {
  load();
  const SceneResult& scene = demo_.result->scenes[1];
  std::vector<std::uint32_t> all(cloud().cloud->size());
  std::iota(all.begin(), all.end(), 0U);
  CloudView* view = page_.cloudPane()->view();
  Q_EMIT view->pointsBrushed({0, 1}, false);
  Q_EMIT view->pointsBrushed(all, false);
  EXPECT_TRUE(selection().contains(QString("%1 points").arg(scene.board_points.size())))
      << selection().toStdString();
  // The patch that holds them all is the board, for every scene.
  QSignalSpy patches(&page_, &ScenePage::patchExcluded);
  page_.findChild<QAction*>("exclude-patch-everywhere")->trigger();
  ASSERT_EQ(patches.count(), 1);
  SceneEdits edits;
  edits.patches_m = {patches[0][0].value<std::vector<Eigen::Vector2d>>()};
  EXPECT_EQ(left_out_points(scene.board_points, edits, demo_.result->target,
                            scene.refinement->lidar_from_board)
                .size(),
            scene.board_points.size());
}

TEST_F(ScenePageTest, ARefusedTagIsUsedAllTheSame) {
  load();
  auto refused = std::make_shared<CalibrationResult>(*demo_.result);
  const int tag = image().overlay().overlay().tags[6].id;
  for (CornerResidual& corner : refused->extrinsic.scenes[1].corners)
    corner.used = corner.used && corner.feature_id != tag;
  page_.setResult(refused);
  auto* keep = page_.findChild<QToolButton*>("keep");
  EXPECT_FALSE(keep->isVisible());
  QTest::mouseClick(
      image().viewport(), Qt::LeftButton, {},
      image().mapFromScene(image().overlay().overlay().tags[6].corners.boundingRect().center()));
  EXPECT_TRUE(selection().contains("left out: misses")) << selection().toStdString();
  ASSERT_TRUE(keep->isVisible());
  EXPECT_FALSE(keep->isChecked());
  QSignalSpy edits(&page_, &ScenePage::editsChanged);
  QTest::mouseClick(keep, Qt::LeftButton);
  ASSERT_EQ(edits.count(), 1);
  EXPECT_EQ(edits[0][1].value<SceneEdits>().kept_tags, std::vector<int>{tag});
}

// Points in a part of the board that something seems to cover bring it back, and out again.
TEST_F(ScenePageTest, ARefusedPartOfTheBoardIsUsedAllTheSame) {
  auto refused = std::make_shared<CalibrationResult>(*demo_.result);
  const SceneResult& scene = refused->scenes[1];
  const Eigen::Vector2d middle = refused->target.outline().center_m();
  const Eigen::AlignedBox2d box(middle - Eigen::Vector2d(0.1, 0.05),
                                middle + Eigen::Vector2d(0.1, 0.05));
  refused->forward->scenes[1].covered = {{box, 40}};
  refused->forward->scenes[1].refused = 40;
  page_.setResult(refused);
  load();
  page_.setResult(refused);
  auto* keep = page_.findChild<QToolButton*>("keep");
  const auto brush = [&](bool inside) {
    std::vector<std::uint32_t> points;
    const Cloud& cloud = *page_.cloudPane()->view()->scene()->cloud;
    const Rigid3 board_from_lidar = scene.refinement->lidar_from_board.inverse();
    for (std::uint32_t i = 0; i < cloud.size(); ++i) {
      const Eigen::Vector3d p = board_from_lidar * cloud.points_m[i].cast<double>();
      const Eigen::Vector2d off = (p.head<2>() - middle).cwiseAbs();
      const bool in = off.x() < 0.04 && off.y() < 0.04;
      const bool out = off.x() < 0.04 && off.y() > 0.12 && off.y() < 0.16;
      if (std::abs(p.z()) < 0.05 && (inside ? in : out)) points.push_back(i);
    }
    EXPECT_GT(points.size(), 10U);
    Q_EMIT page_.cloudPane()->view()->pointsBrushed(points, false);
  };
  brush(false);
  EXPECT_FALSE(keep->isVisible());
  brush(true);
  ASSERT_TRUE(keep->isVisible());
  EXPECT_FALSE(keep->isChecked());
  QSignalSpy edits(&page_, &ScenePage::editsChanged);
  QTest::mouseClick(keep, Qt::LeftButton);
  ASSERT_EQ(edits.count(), 1);
  const auto wanted = edits[0][1].value<SceneEdits>();
  EXPECT_EQ(wanted.kept_patches, (std::vector<BoardOutline>{{box.min(), box.max()}}));
  page_.setEdits(wanted);
  ASSERT_TRUE(keep->isVisible());
  EXPECT_TRUE(keep->isChecked());
  QTest::mouseClick(keep, Qt::LeftButton);
  ASSERT_EQ(edits.count(), 2);
  EXPECT_TRUE(edits[1][1].value<SceneEdits>().empty());
}

// In a narrow window tools take more lines; none goes away.
TEST_F(ScenePageTest, ToolsWrapWhereThereIsNoRoom) {
  page_.resize(520, 700);
  load();
  for (const char* name : {"cloud-color", "cloud-point-size", "show-points", "residual-factor"}) {
    for (const QObject* tool : page_.findChildren<QObject*>(QString::fromLatin1(name))) {
      const auto* widget = qobject_cast<const QWidget*>(tool);
      if (widget == nullptr) continue;
      const QWidget* row = widget->parentWidget();
      EXPECT_TRUE(row->rect().contains(widget->geometry())) << name;
      EXPECT_FALSE(widget->visibleRegion().isEmpty()) << name;
    }
  }
}

TEST_F(ScenePageTest, CropIsMadeUsedAndCleared) {
  load();
  QSignalSpy changed(&page_, &ScenePage::cropChanged);
  QSignalSpy cleared(&page_, &ScenePage::cropCleared);
  page_.cloudPane()->setFocus();
  page_.findChild<QAction*>("crop-action")->trigger();
  auto* use = page_.findChild<QPushButton*>("crop-use");
  ASSERT_TRUE(use->isVisible());
  QTest::mouseClick(use, Qt::LeftButton);
  ASSERT_EQ(changed.size(), 1);
  EXPECT_EQ(changed[0][0].toInt(), 1);
  const auto box = changed[0][1].value<CropBox>();
  EXPECT_TRUE(check(box).ok());
  const auto& refinement = *demo_.result->scenes[1].refinement;
  for (const RefinedNode& node : refinement.nodes) EXPECT_TRUE(box.contains(node.center_lidar_m));
  choose("cloud-filter", 1);
  EXPECT_GT(cloud().size(), 1000U);
  EXPECT_LT(cloud().size(), demo_.clouds[1]->size() / 2);
  QTest::mouseClick(page_.findChild<QPushButton*>("crop-clear"), Qt::LeftButton);
  EXPECT_EQ(cleared.size(), 1);
  EXPECT_FALSE(use->isVisible());
}

TEST_F(ScenePageTest, AnotherSceneLetsGoOfTheOldData) {
  load();
  page_.setScene(2);
  ASSERT_TRUE(settle());
  EXPECT_TRUE(image().image().isNull());
  EXPECT_NE(cloud().cloud.get(), demo_.clouds[1].get());
  page_.setScene(-1);
  page_.setResult(nullptr);
  ASSERT_TRUE(settle());
  EXPECT_TRUE(image().overlay().overlay().tags.empty());
}

TEST_F(ScenePageTest, LoadedButNotYetSolved) {
  page_.setScene(0);
  page_.setSceneData(demo_.clouds[0], demo_.images[0]);
  ASSERT_TRUE(settle());
  EXPECT_EQ(cloud().size(), demo_.clouds[0]->size());
  QTest::mouseClick(image().viewport(), Qt::LeftButton, {}, image().viewport()->rect().center());
  EXPECT_TRUE(selection().contains("once there is an extrinsic"));
}

// The target says what to look for; a result knows better.
TEST_F(ScenePageTest, TheBoardComesIntoSightBeforeARun) {
  std::vector<double> radius;
  QObject::connect(page_.cloudPane(), &CloudPane::sceneShown, &page_,
                   [&] { radius.push_back(cloud().board_radius_m); });
  page_.setTarget(demo_.result->target);
  page_.setScene(1);
  page_.setSceneData(demo_.clouds[1], demo_.images[1]);
  ASSERT_TRUE(settle());
  ASSERT_GE(radius.size(), 2U);
  EXPECT_EQ(*(radius.end() - 2), 0.0) << "the cloud does not wait for it";
  EXPECT_GT(radius.back(), 0.3);
  EXPECT_TRUE(cloud().board_is_likely);
  const Eigen::Vector3d likely = cloud().board_center_m;
  // It is not looked for again when the same cloud gets other colours.
  const std::size_t before = radius.size();
  choose("cloud-color", 1);
  EXPECT_EQ(radius.size(), before + 1);
  EXPECT_TRUE(cloud().board_is_likely);
  page_.setResult(demo_.result);
  ASSERT_TRUE(settle());
  EXPECT_FALSE(cloud().board_is_likely);
  EXPECT_LT((cloud().board_center_m - likely).norm(), 0.02);
}

// Everything can be reached with the keyboard, and says what it is.
TEST_F(ScenePageTest, ControlsAreReachableAndExplained) {
  load();
  for (const QWidget* widget : page_.findChildren<QComboBox*>()) {
    EXPECT_NE(widget->focusPolicy() & Qt::TabFocus, 0);
    EXPECT_FALSE(widget->toolTip().isEmpty());
    EXPECT_FALSE(widget->accessibleName().isEmpty());
  }
  EXPECT_NE(image().focusPolicy() & Qt::TabFocus, 0);
}

}  // namespace
}  // namespace lvcalib::widgets::scene_page_test
