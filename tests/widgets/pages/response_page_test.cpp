// SPDX-License-Identifier: GPL-3.0-or-later
#include "pages/response_page.h"

#include <QElapsedTimer>
#include <QLabel>
#include <QSignalSpy>
#include <QTableWidget>
#include <QTest>
#include <QTextBrowser>
#include <QToolButton>

#include <gtest/gtest.h>

#include "support/timing.h"
#include "views/sample_map_plot.h"
#include "widgets/support/calibrated_demo.h"

namespace lvcalib::widgets::response_page_test {
namespace {

class ResponsePageTest : public ::testing::Test {
 protected:
  void SetUp() override {
    page_.resize(1280, 760);
    page_.show();
  }
  [[nodiscard]] QTableWidget* table() const {
    return page_.findChild<QTableWidget*>("response-scenes");
  }
  template <class Plot>
  [[nodiscard]] QByteArray csv() const {
    return page_.findChild<Plot*>()->csv();
  }
  const test::CalibratedDemo& demo_ = test::calibrated_demo();
  ResponsePage page_;
};

TEST_F(ResponsePageTest, TheTableCarriesTheResultsNumbers) {
  page_.setResult(demo_.result);
  const BoundaryResponse& response = demo_.result->response;
  ASSERT_TRUE(response.all) << response.reason.text();
  ASSERT_EQ(table()->rowCount(), 4);
  EXPECT_EQ(table()->item(0, 1)->text().toInt(), response.all->n);
  const double sigma_range_mm = 1e3 * response.all->std_dev().z();
  EXPECT_NEAR(table()->item(0, 7)->text().section(QChar(0xa0), 0, 0).toDouble(), sigma_range_mm,
              0.006);
  for (int s = 0; s < 3; ++s) {
    const SceneResponse& scene = response.scenes[static_cast<std::size_t>(s)];
    EXPECT_EQ(table()->item(s + 1, 0)->text().toStdString(), scene.name);
    if (scene.statistics) {
      EXPECT_EQ(table()->item(s + 1, 1)->text().toInt(), scene.statistics->n);
    }
  }
}

TEST_F(ResponsePageTest, ARowChoosesWhatTheFiguresShow) {
  page_.setResult(demo_.result);
  const QByteArray all = csv<TransitionPlot>();
  QSignalSpy activated(&page_, &ResponsePage::sceneActivated);
  table()->setCurrentCell(2, 0);
  ASSERT_EQ(activated.size(), 1);
  EXPECT_EQ(activated[0][0].toInt(), 1);
  const std::string name = demo_.result->scenes[1].name;
  for (const QByteArray& line : csv<TransitionPlot>().trimmed().split('\n').mid(1))
    EXPECT_TRUE(line.startsWith(QByteArray::fromStdString(name) + ","));
  table()->setCurrentCell(0, 0);
  EXPECT_EQ(csv<TransitionPlot>(), all);
  EXPECT_EQ(activated.size(), 1);
}

TEST_F(ResponsePageTest, ARejectedSceneLeavesAtOnceAndTheChoiceStays) {
  page_.setResult(demo_.result);
  table()->setCurrentCell(3, 0);
  const auto less = resolve_calibration(*demo_.result, {true, false, true}, {}, {});
  ASSERT_TRUE(less.ok()) << less.error().text();
  QElapsedTimer clock;
  clock.start();
  page_.setResult(std::make_shared<CalibrationResult>(*less));
  const auto took_ms = clock.elapsed();
  EXPECT_EQ(table()->rowCount(), 3);
  EXPECT_EQ(table()->currentRow(), 2);  // Still the third scene.
  EXPECT_EQ(table()->item(2, 0)->text().toStdString(), demo_.result->scenes[2].name);
  // Its share of the 100 ms between a tick and the new picture, with room for a loaded machine.
  EXPECT_LT(took_ms, test::time_limit(400));
}

TEST_F(ResponsePageTest, HiddenItWaitsUntilItIsSeen) {
  page_.hide();
  page_.setResult(demo_.result);
  EXPECT_TRUE(csv<RangePlot>().isEmpty());
  page_.show();
  EXPECT_FALSE(csv<RangePlot>().isEmpty());
}

TEST_F(ResponsePageTest, WhatThereIsNotIsSaid) {
  auto changed = std::make_shared<CalibrationResult>(*demo_.result);
  BoundaryResponse& response = changed->response;
  response.all.reset();
  response.reason = Message("not enough samples: 12 of <200>");
  response.scenes[0].statistics.reset();
  response.scenes[0].reason = Message("3 circles in use");
  response.scenes[0].nodes[0].state = NodeResponseState::kClipped;
  response.scenes[0].nodes[0].reason = Message("40 % of its white is at the end of the scale");
  page_.setResult(changed);
  EXPECT_EQ(table()->item(0, 2)->text(), "not enough samples: 12 of <200>");
  EXPECT_EQ(page_.findChild<QLabel*>("response-message")->text(),
            "not enough samples: 12 of <200>");
  const QString reasons = page_.findChild<QTextBrowser*>("response-reasons")->toPlainText();
  EXPECT_TRUE(reasons.contains("3 circles in use"));
  EXPECT_TRUE(reasons.contains("at the end of the scale"));
  // What the solve refused stands there too, and a refused scene can be taken back.
  changed = std::make_shared<CalibrationResult>(*changed);
  changed->extrinsic.scenes[1].nodes[2].used = false;
  changed->scenes[2].used = false;
  changed->scenes[2].reason = Message("contradicts the others");
  page_.setResult(changed);
  auto* list = page_.findChild<QTextBrowser*>("response-reasons");
  EXPECT_TRUE(list->toPlainText().contains("Scene B, circle 2: misses"));
  EXPECT_TRUE(list->toPlainText().contains("contradicts the others Use it all the same"));
  QSignalSpy insist(&page_, &ResponsePage::insistWanted);
  QSignalSpy keep(&page_, &ResponsePage::keepWanted);
  for (const int link : {1, 2})
    Q_EMIT list->anchorClicked(QUrl(list->toHtml().section("href=\"", link).section('"', 0, 0)));
  ASSERT_EQ(keep.count(), 1);
  EXPECT_EQ(keep.first(), (QVariantList{QString("B"), false, 2}));
  ASSERT_EQ(insist.count(), 1);
  EXPECT_EQ(insist.first().first().toString(), "C");
  // And a part of the board that something seems to cover.
  changed = std::make_shared<CalibrationResult>(*demo_.result);
  Eigen::AlignedBox2d box(Eigen::Vector2d(0.1, 0.1), Eigen::Vector2d(0.2, 0.2));
  changed->forward->scenes[1].covered = {{box, 40}};
  changed->forward->scenes[1].refused = 40;
  page_.setResult(changed);
  QSignalSpy patch(&page_, &ResponsePage::keepPatchWanted);
  const QString text = list->toHtml();
  ASSERT_TRUE(text.contains("href=\"patch:0/B\"")) << text.toStdString();
  Q_EMIT list->anchorClicked(QUrl("patch:0/B"));
  ASSERT_EQ(patch.count(), 1);
  EXPECT_EQ(patch.first(), (QVariantList{QString("B"), 0}));
  page_.setResult(nullptr);
  EXPECT_EQ(table()->rowCount(), 0);
  EXPECT_TRUE(csv<SampleMapPlot>().isEmpty());
  EXPECT_TRUE(page_.findChild<QLabel*>("response-message")->text().contains("Run the calibration"));
}

// What the user left out stands on the map and in the list with its reason, and comes back from
// there.
TEST_F(ResponsePageTest, WhatIsLeftOutByHandIsShownAndTakenBack) {
  auto changed = std::make_shared<CalibrationResult>(*demo_.result);
  SceneEdits& edits = changed->scenes[1].edits;
  const Eigen::Vector2d middle = changed->target.outline().center_m();
  edits.patches_m = {
      {middle, middle + Eigen::Vector2d(0.1, 0.0), middle + Eigen::Vector2d(0.0, 0.1)}};
  edits.circles = {4};
  page_.setResult(changed);
  auto* map = page_.findChild<SampleMapPlot*>();
  const auto violet = [&] {
    int out = 0;
    for (int k = 0; k < map->plottableCount(); ++k) {
      const auto* curve = qobject_cast<QCPCurve*>(map->plottable(k));
      out += curve != nullptr && curve->pen().color() == map->colors().left_out;
    }
    return out;
  };
  EXPECT_EQ(violet(), 1);
  table()->setCurrentCell(1, 0);
  EXPECT_EQ(violet(), 0) << "of another scene";
  table()->setCurrentCell(2, 0);
  EXPECT_EQ(violet(), 1);
  auto* list = page_.findChild<QTextBrowser*>("response-reasons");
  EXPECT_TRUE(list->toPlainText().contains("Scene B, circle 4: left out by hand Take back"))
      << list->toPlainText().toStdString();
  QSignalSpy back(&page_, &ResponsePage::takenBack);
  for (const char* link : {"handpatch:0/B", "handcircle:4/B"}) {
    ASSERT_TRUE(list->toHtml().contains(QString("href=\"%1\"").arg(link)));
    Q_EMIT list->anchorClicked(QUrl(link));
  }
  ASSERT_EQ(back.count(), 2);
  EXPECT_EQ(back[0][0].toString(), "B");
  EXPECT_EQ(back[0][1].value<SceneEdits>().patches_m, edits.patches_m);
  EXPECT_EQ(back[1][1].value<SceneEdits>().circles, edits.circles);
}

// Samples that look wrong on the map are left out with their part of the board, of the scene chosen
// in the table or of all.
TEST_F(ResponsePageTest, APartOfTheBoardIsBrushedAndLeftOut) {
  page_.setResult(demo_.result);
  QTest::qWait(20);
  auto* exclude = page_.findChild<QToolButton*>("response-exclude");
  auto* brush = page_.findChild<QToolButton*>("response-brush");
  auto* map = page_.findChild<SampleMapPlot*>();
  EXPECT_FALSE(exclude->isVisible());
  brush->setChecked(true);
  QSignalSpy excluded(&page_, &ResponsePage::partExcluded);
  QSignalSpy brushed(map, &SampleMapPlot::brushed);
  // About the middle of the board.
  const Eigen::Vector2d middle = 1e3 * demo_.result->target.outline().center_m();
  const QPoint center(static_cast<int>(map->xAxis->coordToPixel(middle.x())),
                      static_cast<int>(map->yAxis->coordToPixel(middle.y())));
  QTest::mousePress(map, Qt::LeftButton, {}, center - QPoint(20, 15));
  QTest::mouseMove(map, center);
  QTest::mouseMove(map, center + QPoint(20, 15));
  QTest::mouseRelease(map, Qt::LeftButton, {}, center + QPoint(20, 15));
  ASSERT_EQ(brushed.count(), 1);
  const auto part = brushed[0][0].value<BoardOutline>();
  EXPECT_TRUE(part.contains(1e-3 * middle));
  EXPECT_GT(part.size_m().minCoeff(), 0.0);
  ASSERT_TRUE(exclude->isVisible());
  EXPECT_TRUE(exclude->text().contains("every scene"));
  table()->setCurrentCell(2, 0);
  EXPECT_TRUE(exclude->text().contains("scene B"));
  exclude->click();
  ASSERT_EQ(excluded.count(), 1);
  EXPECT_EQ(excluded[0][0].toString(), "B");
  const auto patch = excluded[0][1].value<std::vector<Eigen::Vector2d>>();
  ASSERT_EQ(patch.size(), 4U);
  EXPECT_EQ(patch[0], part.lower_left_m);
  EXPECT_EQ(patch[2], part.upper_right_m);
  EXPECT_FALSE(exclude->isVisible());
}

}  // namespace
}  // namespace lvcalib::widgets::response_page_test
