// SPDX-License-Identifier: GPL-3.0-or-later
#include "pages/refinement_page.h"

#include <QLabel>
#include <QSignalSpy>
#include <QSlider>
#include <QTableWidget>
#include <QTest>
#include <QToolButton>
#include <algorithm>
#include <numbers>

#include <gtest/gtest.h>

#include "support/timing.h"
#include "views/angle_distance_plot.h"
#include "views/board_map_plot.h"
#include "views/convergence_plot.h"
#include "widgets/support/calibrated_demo.h"

namespace lvcalib::widgets::refinement_page_test {
namespace {

class RefinementPageTest : public ::testing::Test {
 protected:
  void SetUp() override {
    page_.resize(1280, 760);
    page_.show();
  }
  void load() {
    page_.setResult(demo_.result);
    page_.setScene(0);
  }
  [[nodiscard]] const BoardRefinement& refinement() const {
    return *demo_.result->scenes[0].refinement;
  }
  [[nodiscard]] AngleDistancePlot* plot(int id) const {
    return page_.findChild<AngleDistancePlot*>(QString("node-%1").arg(id));
  }
  [[nodiscard]] QTableWidget* bins() const { return page_.findChild<QTableWidget*>("bins"); }

  const test::CalibratedDemo& demo_ = test::calibrated_demo();
  RefinementPage page_;
};

TEST_F(RefinementPageTest, OnePlotForEveryNodeAsOnTheBoard) {
  load();
  const NodeRecord& last = refinement().history.back().nodes[4];
  for (int id = 0; id < 9; ++id) {
    ASSERT_NE(plot(id), nullptr);
    EXPECT_GT(plot(id)->data().samples.size(), 50U);
    EXPECT_FALSE(plot(id)->data().record.bins.empty());
  }
  EXPECT_EQ(plot(4)->data().record.wave_m, last.wave_m);
  // Row 0 of the board is the lowest, column 0 the leftmost.
  QTest::qWait(50);
  EXPECT_GT(plot(0)->y(), plot(6)->y());
  EXPECT_LT(plot(0)->x(), plot(2)->x());
}

TEST_F(RefinementPageTest, AClickEnlargesANodeAndListsItsBins) {
  load();
  QTest::mouseClick(plot(7), Qt::LeftButton, {}, plot(7)->rect().center());
  EXPECT_EQ(page_.chosenNode(), 7);
  auto* large = page_.findChild<AngleDistancePlot*>("large-plot");
  EXPECT_EQ(large->data().record.id, 7);
  const auto& record = refinement().history.back().nodes[7];
  ASSERT_EQ(bins()->rowCount(), static_cast<int>(record.bins.size()));
  for (int row = 0; row < bins()->rowCount(); ++row) {
    const BinRecord& bin = record.bins[static_cast<std::size_t>(row)];
    EXPECT_EQ(bins()->item(row, 4)->text().toStdString(), describe(bin.state).text());
    EXPECT_EQ(bins()->item(row, 3)->text().toInt(), bin.samples);
  }
  EXPECT_TRUE(page_.findChild<QLabel*>("node-verdict")->text().contains("bins used"));
}

TEST_F(RefinementPageTest, CirclesThatTheSolveRefusedAreStruckThroughAndCanBeUsed) {
  auto changed = std::make_shared<CalibrationResult>(*demo_.result);
  NodeResidual& node = changed->extrinsic.scenes[0].nodes[4];
  node.used = false;
  node.residual_m = Eigen::Vector3d(0.008, 0.0, 0.0);
  changed->scenes[0].edits.circles = {7};
  page_.setResult(changed);
  page_.setScene(0);
  for (int id = 0; id < 9; ++id) EXPECT_EQ(plot(id)->isRefused(), id == node.id || id == 7) << id;
  page_.chooseNode(node.id);
  auto* verdict = page_.findChild<QLabel*>("node-verdict");
  EXPECT_TRUE(verdict->text().contains("Left out: misses the board's pose by 8.0 mm") ||
              verdict->text().contains("Left out: misses the board&#39;s pose by 8.0 mm"))
      << verdict->text().toStdString();
  QSignalSpy wanted(&page_, &RefinementPage::keepWanted);
  Q_EMIT verdict->linkActivated("keep");
  ASSERT_EQ(wanted.count(), 1);
  EXPECT_EQ(wanted[0][0].toString(), "A");
  EXPECT_FALSE(wanted[0][1].toBool());
  EXPECT_EQ(wanted[0][2].toInt(), node.id);
  page_.chooseNode(7);
  EXPECT_TRUE(verdict->text().contains("left out by hand"));
  EXPECT_FALSE(verdict->text().contains("href"));
  load();
  EXPECT_FALSE(plot(node.id)->isRefused());
}

TEST_F(RefinementPageTest, BinsAndCirclesAreExcludedAndTakenBack) {
  load();
  page_.chooseNode(3);
  const auto button = [&](const char* name) { return page_.findChild<QToolButton*>(name); };
  EXPECT_FALSE(button("exclude-bins")->isEnabled()) << "none is selected";
  EXPECT_FALSE(button("take-back-circle")->isEnabled());
  QSignalSpy wanted(&page_, &RefinementPage::editsWanted);
  const auto click = [&](const char* name) {
    QTest::mouseClick(button(name), Qt::LeftButton);
    return wanted.isEmpty() ? SceneEdits() : wanted.takeLast()[1].value<SceneEdits>();
  };
  const auto cell = [&](int row) { return bins()->visualItemRect(bins()->item(row, 0)).center(); };
  bins()->scrollToTop();
  QTest::mouseClick(bins()->viewport(), Qt::LeftButton, {}, cell(0));
  QTest::mouseClick(bins()->viewport(), Qt::LeftButton, Qt::ControlModifier, cell(1));
  const SceneEdits two = click("exclude-bins");
  ASSERT_EQ(two.patches_m.size(), 2U);
  // What goes are the returns of these bins and no others.
  const BoardRefinement& found = refinement();
  const Cloud& board = demo_.result->scenes[0].board_points;
  const auto gone = left_out_points(board, two, demo_.result->target, found.lidar_from_board);
  const auto& records = found.history.back().nodes[3].bins;
  EXPECT_NEAR(static_cast<double>(gone.size()), records[0].samples + records[1].samples,
              0.2 * (records[0].samples + records[1].samples) + 10);
  page_.setEdits(two);
  const SceneEdits none = click("take-back-circle");
  EXPECT_TRUE(none.empty());
  page_.setEdits(none);
  const SceneEdits circle = click("exclude-circle");
  EXPECT_EQ(circle.circles, std::vector<int>{3});
  page_.setEdits(circle);
  EXPECT_FALSE(button("exclude-circle")->isEnabled());
  EXPECT_TRUE(click("take-back-circle").empty());
  // Of another circle nothing is taken back.
  page_.chooseNode(4);
  EXPECT_FALSE(button("take-back-circle")->isEnabled());
  EXPECT_TRUE(button("exclude-circle")->isEnabled());
}

TEST_F(RefinementPageTest, BinsAreBrushedInTheFigure) {
  load();
  page_.chooseNode(3);
  QTest::qWait(50);
  auto* large = page_.findChild<AngleDistancePlot*>("large-plot");
  auto* brush = page_.findChild<QToolButton*>("refinement-brush");
  const auto& records = refinement().history.back().nodes[3].bins;
  const double width_deg = 360.0 / static_cast<double>(records.size());
  const auto drag = [&](double from_bin, double to_bin, Qt::KeyboardModifiers modifiers) {
    const auto at = [&](double bin, double share) {
      const QRect box = large->axisRect()->rect();
      return QPoint(static_cast<int>(large->xAxis->coordToPixel(-180.0 + bin * width_deg)),
                    box.top() + static_cast<int>(share * box.height()));
    };
    QTest::mousePress(large, Qt::LeftButton, modifiers, at(from_bin, 0.02));
    QTest::mouseMove(large, at(0.5 * (from_bin + to_bin), 0.5));
    QTest::mouseMove(large, at(to_bin, 0.98));
    QTest::mouseRelease(large, Qt::LeftButton, modifiers, at(to_bin, 0.98));
  };
  const auto chosen = [&] {
    std::vector<int> rows;
    for (const QModelIndex& index : bins()->selectionModel()->selectedRows())
      rows.push_back(index.row());
    std::sort(rows.begin(), rows.end());
    return rows;
  };
  drag(4.2, 6.8, {});
  EXPECT_TRUE(chosen().empty()) << "without the brush the figure is moved";
  page_.setIteration(page_.iteration());
  large->resetView();
  brush->setChecked(true);
  drag(4.2, 6.8, {});
  EXPECT_EQ(chosen(), (std::vector<int>{4, 5, 6}));
  drag(9.2, 9.8, Qt::ShiftModifier);
  EXPECT_EQ(chosen(), (std::vector<int>{4, 5, 6, 9}));
  drag(1.2, 1.8, {});
  EXPECT_EQ(chosen(), std::vector<int>{1});
  QSignalSpy wanted(&page_, &RefinementPage::editsWanted);
  QTest::mouseClick(page_.findChild<QToolButton*>("exclude-bins"), Qt::LeftButton);
  ASSERT_EQ(wanted.count(), 1);
  EXPECT_EQ(wanted[0][1].value<SceneEdits>().patches_m.size(), 1U);
}

// Nobody but the user refused them, whatever the refinement finds in their place.
TEST_F(RefinementPageTest, BinsLeftOutByHandAreNotCalledRefused) {
  auto changed = std::make_shared<CalibrationResult>(*demo_.result);
  SceneResult& scene = changed->scenes[0];
  NodeRecord& node = scene.refinement->history.back().nodes[2];
  const double width_rad = 2.0 * std::numbers::pi / static_cast<double>(node.bins.size());
  for (const int bin : {1, 2, 4}) {
    if (bin != 4)
      scene.edits.patches_m.push_back(ring_patch(changed->target, node.id,
                                                 -std::numbers::pi + bin * width_rad,
                                                 -std::numbers::pi + (bin + 1) * width_rad));
    node.bins[static_cast<std::size_t>(bin)].state = BinState::kTooFewSamples;
  }
  page_.setResult(changed);
  page_.setScene(0);
  page_.chooseNode(node.id);
  const AngleDistancePlot* large = page_.findChild<AngleDistancePlot*>("large-plot");
  std::vector<bool> by_hand(node.bins.size(), false);
  by_hand[1] = by_hand[2] = true;
  EXPECT_EQ(large->data().by_hand, by_hand);
  EXPECT_EQ(plot(node.id)->data().by_hand, by_hand);
  EXPECT_EQ(std::count(plot(3)->data().by_hand.begin(), plot(3)->data().by_hand.end(), true), 0);
  for (const int bin : {1, 2}) EXPECT_EQ(bins()->item(bin, 4)->text(), "left out by hand");
  EXPECT_EQ(bins()->item(4, 4)->text().toStdString(), describe(BinState::kTooFewSamples).text());
  EXPECT_NE(bins()->item(1, 4)->foreground().color(), bins()->item(4, 4)->foreground().color());
  EXPECT_TRUE(large->csv().contains("left out by hand"));
  EXPECT_TRUE(page_.findChild<QLabel*>("node-verdict")->text().contains("left out by hand: 2"));
  // Violet ground and a hatch on it, where a refused bin has its ground alone.
  int violet = 0;
  int red = 0;
  for (const auto* band :
       page_.findChild<AngleDistancePlot*>("large-plot")->findChildren<QCPItemRect*>()) {
    QColor color = band->brush().color();
    color.setAlpha(255);
    violet += color == large->colors().left_out;
    red += color == large->colors().refused;
  }
  EXPECT_EQ(violet, 2);
  EXPECT_EQ(red, 1);
}

// A circle that has lost returns is divided into fewer bins. One that reaches into what was left
// out and has too few returns of its own lacks them for that.
TEST_F(RefinementPageTest, ABinThatIsLeftOutInPartIsNotCalledRefused) {
  auto changed = std::make_shared<CalibrationResult>(*demo_.result);
  SceneResult& scene = changed->scenes[0];
  NodeRecord& node = scene.refinement->history.back().nodes[2];
  const double width_rad = 2.0 * std::numbers::pi / static_cast<double>(node.bins.size());
  scene.edits.patches_m.push_back(ring_patch(changed->target, node.id,
                                             -std::numbers::pi + 2.0 * width_rad,
                                             -std::numbers::pi + 4.3 * width_rad));
  for (const int bin : {2, 3, 4, 5})
    node.bins[static_cast<std::size_t>(bin)].state = BinState::kTooFewSamples;
  page_.setResult(changed);
  page_.setScene(0);
  page_.chooseNode(node.id);
  std::vector<bool> by_hand(node.bins.size(), false);
  by_hand[2] = by_hand[3] = by_hand[4] = true;
  EXPECT_EQ(page_.findChild<AngleDistancePlot*>("large-plot")->data().by_hand, by_hand);
  // One that has enough all the same is in use.
  node.bins[4].state = BinState::kUsed;
  by_hand[4] = false;
  page_.setResult(std::make_shared<CalibrationResult>(*changed));
  EXPECT_EQ(page_.findChild<AngleDistancePlot*>("large-plot")->data().by_hand, by_hand);
}

// As a run leaves it: without its returns the circle cannot be used either.
TEST_F(RefinementPageTest, ACircleLeftOutByHandIsNotCalledUnusable) {
  auto changed = std::make_shared<CalibrationResult>(*demo_.result);
  SceneResult& scene = changed->scenes[0];
  scene.edits.circles = {4};
  NodeRecord& node = scene.refinement->history.back().nodes[4];
  node.valid = false;
  node.reason = Message("too few usable bins around the circle");
  for (BinRecord& bin : node.bins) bin.state = BinState::kTooFewSamples;
  page_.setResult(changed);
  page_.setScene(0);
  page_.chooseNode(4);
  EXPECT_TRUE(plot(4)->isRefused());
  const QString verdict = page_.findChild<QLabel*>("node-verdict")->text();
  EXPECT_TRUE(verdict.contains("left out by hand")) << verdict.toStdString();
  EXPECT_FALSE(verdict.contains("not usable")) << verdict.toStdString();
  EXPECT_EQ(bins()->item(0, 4)->text(), "left out by hand");
}

TEST_F(RefinementPageTest, RefusedBinsTellWhy) {
  auto changed = std::make_shared<CalibrationResult>(*demo_.result);
  NodeRecord& node = changed->scenes[0].refinement->history.back().nodes[2];
  node.bins[1].state = BinState::kOneSided;
  node.valid = false;
  node.reason = Message("too few usable bins around the circle");
  page_.setResult(changed);
  page_.setScene(0);
  page_.chooseNode(2);
  EXPECT_EQ(bins()->item(1, 4)->text(), "samples on one side of the edge only");
  EXPECT_TRUE(page_.findChild<QLabel*>("node-verdict")->text().contains("too few usable bins"));
}

TEST_F(RefinementPageTest, TheSliderReplays) {
  load();
  auto* slider = page_.findChild<QSlider*>("iteration");
  const int last = static_cast<int>(refinement().history.size()) - 1;
  ASSERT_GT(last, 0);
  EXPECT_EQ(page_.iteration(), last);
  slider->setFocus();
  QTest::keyClick(slider, Qt::Key_Home);
  EXPECT_EQ(page_.iteration(), 0);
  EXPECT_EQ(plot(3)->data().record.wave_m, refinement().history[0].nodes[3].wave_m);
  QTest::mouseClick(page_.findChild<QToolButton*>("play"), Qt::LeftButton);
  EXPECT_EQ(page_.iteration(), 0);
  EXPECT_TRUE(QTest::qWaitFor([&] { return page_.iteration() == last; }, 500 * (last + 2)));
}

// As during a run: records arrive one by one, before there is a result.
TEST_F(RefinementPageTest, LiveIterationsAreShown) {
  page_.setScene(0);
  page_.setTarget(demo_.result->target);
  page_.setLivePoints(0, {demo_.result, &demo_.result->scenes[0].board_points});
  for (std::size_t k = 1; k <= refinement().history.size(); ++k) {
    auto partial = std::make_shared<BoardRefinement>(refinement());
    partial->history.resize(k);
    page_.showIteration(0, partial);
    EXPECT_EQ(page_.iteration(), static_cast<int>(k) - 1);
    EXPECT_EQ(plot(5)->data().record.wave_m, refinement().history[k - 1].nodes[5].wave_m);
    EXPECT_GT(plot(5)->data().samples.size(), 50U);
  }
  // Another scene's are not.
  auto other = std::make_shared<BoardRefinement>(refinement());
  other->history.resize(1);
  page_.showIteration(1, other);
  EXPECT_EQ(page_.iteration(), static_cast<int>(refinement().history.size()) - 1);
}

// In a list beside the page the letter chooses an entry.
TEST_F(RefinementPageTest, TheKeyReplaysOnlyOnThePage) {
  load();
  const int last = page_.iteration();
  ASSERT_GT(last, 0);
  page_.activateWindow();
  ASSERT_TRUE(QTest::qWaitForWindowActive(&page_));
  plot(4)->setFocus();
  QTest::keyClick(plot(4), Qt::Key_P);
  EXPECT_EQ(page_.iteration(), 0);
  for (const auto* button : page_.findChildren<QToolButton*>())
    EXPECT_TRUE(button->shortcut().isEmpty()) << button->objectName().toStdString();
}

// A partial refinement may have no final nodes yet.
TEST_F(RefinementPageTest, LiveWithoutPointsAndNodes) {
  page_.setScene(0);
  page_.setTarget(demo_.result->target);
  auto partial = std::make_shared<BoardRefinement>(refinement());
  partial->nodes.clear();
  page_.showIteration(0, partial);
  EXPECT_FALSE(plot(5)->data().record.bins.empty());
  EXPECT_TRUE(plot(5)->data().samples.empty());
  auto empty = std::make_shared<BoardRefinement>();
  page_.showIteration(0, empty);
  EXPECT_TRUE(plot(5)->data().record.bins.empty());
}

TEST_F(RefinementPageTest, SaysWhyThereIsNothing) {
  auto changed = std::make_shared<CalibrationResult>(*demo_.result);
  changed->scenes[0].refinement.reset();
  changed->scenes[0].reason = Message("the board is not found in the cloud");
  page_.setResult(changed);
  page_.setScene(0);
  EXPECT_TRUE(page_.findChild<QLabel*>("node-verdict")->text().contains("not found in the cloud"));
  EXPECT_EQ(bins()->rowCount(), 0);
}

TEST_F(RefinementPageTest, UpdatesFastEnoughToBeLive) {
  load();
  QElapsedTimer clock;
  clock.start();
  constexpr int kTimes = 10;
  for (int k = 0; k < kTimes; ++k) {
    page_.setIteration(k % 2);
    QApplication::processEvents();
  }
  const double each_ms = static_cast<double>(clock.elapsed()) / kTimes;
  RecordProperty("iteration_ms", static_cast<int>(each_ms));
  std::printf("an iteration is shown in %.0f ms\n", each_ms);
  EXPECT_LT(each_ms, test::time_limit(500.0));
}

}  // namespace
}  // namespace lvcalib::widgets::refinement_page_test
