// SPDX-License-Identifier: GPL-3.0-or-later
// The Model page driven as its user does.
#include <QComboBox>
#include <QLabel>
#include <QPushButton>
#include <QTabWidget>
#include <QTemporaryDir>
#include <QTextBrowser>
#include <QTimer>
#include <QTreeWidget>
#include <set>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <qcustomplot.h>

#include "base/file_io.h"
#include "modelling/budget_plot.h"
#include "modelling/residual_plot.h"
#include "runner/demo.h"
#include "simulation/dataset_writer.h"
#include "simulation/simulator.h"
#include "start/coach_marks.h"
#include "widgets/support/driver.h"

namespace lvcalib::widgets::model_flow_test {
namespace {

using ::testing::HasSubstr;

simulation::SimulationOptions small_rig(int scenes, std::map<std::string, double> effects) {
  simulation::SimulationOptions options = demo_options();
  options.seed = 1;  // Small as it is here, the effect shows well in it.
  options.scenes = scenes;
  options.effects = std::move(effects);
  options.lidar.points = 60'000;
  options.image.width_px = 1000;
  options.image.height_px = 640;
  options.placement.max_distance_m = 2.8;
  return options;
}

class Flow : public ::testing::Test {
 protected:
  Flow() : settings_(folder_.path()), window_(settings_, answers_) {
    window_.resize(1500, 940);
    window_.show();
    QObject::connect(&verdicts_, &QTimer::timeout, &window_, [this] { compare_verdicts(); });
    verdicts_.start(5);
  }
  ~Flow() override {
    verdicts_.stop();
    for (const std::string& one : contradictions_) ADD_FAILURE() << one;
    window_.close();
    Runner::wait_for_workers(30'000);
  }

  bool open_and_run(const simulation::SimulationOptions& options, bool as_demo) {
    if (as_demo) {
      window_.set_demo(options);
      test::trigger(window_, "demo");
    } else {
      const QString path = folder_.filePath("rig");
      if (!make_demo(path.toStdString(), options, {})) return false;
      window_.open(path);
    }
    if (!test::wait_until([&] { return window_.workspace().is_open(); })) return false;
    if (!test::wait_until([&] { return !window_.workspace().busy(); })) return false;
    test::trigger(window_, "run");
    if (!test::wait_for_result(window_)) return false;
    test::find<QTabWidget>(window_, "pages")->setCurrentIndex(4);
    return wait_idle();
  }
  bool wait_idle() {
    return test::wait_until([&] { return !work().busy() && work().step(); }, 240'000);
  }
  ModelWork& work() { return window_.model_work(); }
  QTreeWidgetItem* top() { return test::find<QTreeWidget>(window_, "proposals")->topLevelItem(0); }
  double unexplained(Channel channel) { return summary(channel).unexplained; }
  double rms(Channel channel) { return summary(channel).rms; }
  ChannelSummary summary(Channel channel) {
    for (const ChannelSummary& c : work().step()->channels) {
      if (c.channel == channel) return c;
    }
    ADD_FAILURE() << "no such channel";
    return {};
  }

  // At every moment of every case: the verdict on the result, the list of what is missing and the
  // bars of what is unexplained tell one story.
  void compare_verdicts() {
    const auto* quality = test::find<QLabel>(window_, "quality");
    const auto* missing = test::find<QLabel>(window_, "missing_verdict");
    const auto ranking = work().ranking();
    const std::string beside =
        quality->text().toStdString() + " | " + missing->text().toStdString();
    if (quality->isVisible() && quality->text().endsWith(": good")) {
      if (work().busy() || !ranking) contradictions_.insert("good and nobody knows yet: " + beside);
      if (ranking && ranking->speaks_against_good())
        contradictions_.insert("good beside what is missing: " + beside);
    }
    // The page of the pose says the same as the status line.
    const QString pose = test::find<QTextBrowser>(window_, "pose")->toPlainText();
    const bool called_good = pose.startsWith("Quality: good") && !pose.contains("good so far") &&
                             !pose.contains("out of date");
    if (test::find<QTextBrowser>(window_, "pose")->isVisible() && called_good &&
        (work().busy() || !ranking || ranking->speaks_against_good()))
      contradictions_.insert("the pose is good and nobody knows yet: " + beside);
    const auto* bars = test::find<BudgetPlot>(window_, "budget_plot");
    for (int k = 0; !ranking && work().steps().size() == 1 && k < bars->itemCount(); ++k) {
      const auto* bar = qobject_cast<QCPItemRect*>(bars->item(k));
      if (bar != nullptr && bar->brush().color() == bars->colors().refused)
        contradictions_.insert("red bars and nobody knows yet: " + beside);
    }
  }

  QTemporaryDir folder_;
  AppSettings settings_;
  test::Answers answers_;
  MainWindow window_;
  QTimer verdicts_;
  std::set<std::string> contradictions_;
};

TEST_F(Flow, TheDemosHiddenEffectIsFoundAddedTakenBackAndExported) {
  test::Watchdog watchdog;
  ASSERT_TRUE(open_and_run(small_rig(4, {{"range_walk", 10.0}}), true));
  ASSERT_NE(top(), nullptr);
  EXPECT_EQ(top()->text(0), "Range walk");
  EXPECT_THAT(test::find<QLabel>(window_, "missing_verdict")->text().toStdString(),
              HasSubstr("Range walk"));
  // Its pattern is drawn over what is measured.
  auto* plot = test::find<ResidualPlot>(window_, "residual_plot");
  const auto along = [&] { return plot->figure() ? plot->figure()->along().name : std::string(); };
  ASSERT_TRUE(test::wait_until([&] { return along() == "darkness"; }, 30'000));
  const double before = unexplained(Channel::kRange);
  QTest::mouseClick(test::find<QPushButton>(window_, "add_proposal"), Qt::LeftButton);
  ASSERT_TRUE(test::wait_until([&] { return work().current() == 1; }));
  ASSERT_TRUE(wait_idle());
  EXPECT_LT(unexplained(Channel::kRange), 0.45 * before);
  // Its own curve, which was looked at before, is seen to fall.
  QTest::qWait(500);
  ASSERT_TRUE(test::wait_until([&] { return plot->figure() != nullptr; }));
  EXPECT_EQ(plot->figure()->view->columns.channel, Channel::kRange);
  EXPECT_EQ(along(), "darkness");
  // The four channels, and the distance to the demo's truth in mm and in mrad.
  EXPECT_EQ(test::find<BudgetPlot>(window_, "budget_plot")->csv().count("\n1,"), 4 + 2);
  // The export holds the effect.
  ASSERT_TRUE(test::wait_until([&] { return work().result() != nullptr; }));
  EXPECT_EQ(work().result()->model.at(0).id, "range_walk");
  answers_.export_to = folder_.filePath("report.html");
  ASSERT_TRUE(test::trigger(window_, "report"));
  ASSERT_TRUE(test::wait_until([&] { return QFile::exists(answers_.export_to); }));
  const auto html = read_text_file(answers_.export_to.toStdString(), 64U << 20U);
  ASSERT_TRUE(html.ok());
  EXPECT_THAT(*html, HasSubstr("<h2>Model</h2>"));
  EXPECT_THAT(*html, HasSubstr("Added: range_walk"));
  ASSERT_TRUE(test::trigger(window_, "undo"));
  EXPECT_TRUE(work().step()->terms.empty());
  ASSERT_TRUE(test::trigger(window_, "redo"));
  EXPECT_EQ(work().step()->terms.size(), 1U);
  RecordProperty("largest_gap_ms", static_cast<int>(watchdog.take_largest_ms()));
}

TEST_F(Flow, AValueThatIsHeldIsTheUsersUntilItIsLetGo) {
  ASSERT_TRUE(open_and_run(small_rig(4, {{"range_walk", 10.0}}), false));
  QTest::mouseClick(test::find<QPushButton>(window_, "add_proposal"), Qt::LeftButton);
  ASSERT_TRUE(test::wait_until([&] { return work().current() == 1; }));
  ASSERT_TRUE(wait_idle());
  const auto term = [&] { return work().step()->terms.at(0).use; };
  const double fitted_m = term().values(0);
  const double fitted_rms = rms(Channel::kRange);
  auto* terms = test::find<QTreeWidget>(window_, "terms");
  const auto row = [&] { return terms->topLevelItem(1); };
  ASSERT_TRUE(row()->text(1).contains(QString::fromUtf8("±"))) << row()->text(1).toStdString();
  row()->setText(1, "3");
  ASSERT_TRUE(test::wait_until([&] { return !work().busy() && term().held; }));
  EXPECT_DOUBLE_EQ(term().values(0), 0.003);
  ASSERT_TRUE(test::wait_until([&] { return row()->checkState(2) == Qt::Checked; }, 5000));
  EXPECT_FALSE(row()->text(1).contains(QString::fromUtf8("±"))) << row()->text(1).toStdString();
  EXPECT_GT(rms(Channel::kRange), fitted_rms) << "3 mm are not what is hidden";
  ASSERT_TRUE(wait_idle());
  ASSERT_TRUE(
      test::wait_until([&] { return row()->flags().testFlag(Qt::ItemIsUserCheckable); }, 5000));
  row()->setCheckState(2, Qt::Unchecked);
  ASSERT_TRUE(test::wait_until([&] { return !work().busy() && !term().held; }));
  EXPECT_NEAR(term().values(0), fitted_m, 2e-4);
}

TEST_F(Flow, TheTourLeadsFromTheFirstLookToTheFallenError) {
  window_.set_demo(small_rig(4, {{"range_walk", 10.0}}));
  test::trigger(window_, "demo");
  ASSERT_TRUE(test::wait_until([&] { return window_.workspace().is_open(); }));
  ASSERT_TRUE(test::wait_until([&] { return !window_.workspace().busy(); }));
  auto* coach = test::find<CoachMarks>(window_, "coach_marks");
  ASSERT_NE(coach, nullptr);
  EXPECT_TRUE(coach->isVisible());
  EXPECT_EQ(coach->current(), 0);
  test::trigger(window_, "run");
  // What it asks for is done: it speaks of what is going on, until that is over.
  ASSERT_TRUE(test::wait_until([&] { return coach->current() == 1; }, 2000));
  EXPECT_TRUE(window_.workspace().busy());
  ASSERT_TRUE(test::wait_until([&] { return coach->current() == 2; }));
  EXPECT_FALSE(window_.workspace().busy());
  test::find<QTabWidget>(window_, "pages")->setCurrentIndex(4);
  ASSERT_TRUE(test::wait_until([&] { return coach->current() == 3; }, 240'000));
  // The bubble lies over nothing that it speaks of.
  const auto covers = [&](const char* name) {
    const auto* widget = test::find<QWidget>(window_, name);
    return widget != nullptr && widget->isVisible() &&
           QRect(widget->mapTo(&window_, QPoint(0, 0)), widget->size())
               .intersects(coach->geometry());
  };
  for (const char* name : {"proposals", "proposal_text", "missing_verdict"})
    EXPECT_TRUE(test::wait_until([&] { return !covers(name); }, 2000)) << name;
  // What is computed meanwhile does not turn the page for the reader.
  auto* next = test::find<QPushButton>(*coach, "coach_next");
  ASSERT_TRUE(test::wait_until([&] { return next->isEnabled(); }, 240'000));
  EXPECT_EQ(coach->current(), 3);
  QTest::mouseClick(next, Qt::LeftButton);
  EXPECT_EQ(coach->current(), 4);
  for (const char* name : {"residual_plot", "proposals"})
    EXPECT_TRUE(test::wait_until([&] { return !covers(name); }, 2000)) << name;
  QTest::mouseClick(test::find<QPushButton>(*coach, "coach_next"), Qt::LeftButton);
  EXPECT_EQ(coach->current(), 5);
  ASSERT_TRUE(wait_idle());
  QTest::mouseClick(test::find<QPushButton>(window_, "add_proposal"), Qt::LeftButton);
  ASSERT_TRUE(test::wait_until([&] { return coach->current() == 6; }, 240'000));
  for (const char* name : {"budget_plot", "model_legend", "terms"})
    EXPECT_TRUE(test::wait_until([&] { return !covers(name); }, 2000)) << name;
  QTest::mouseClick(test::find<QPushButton>(*coach, "coach_next"), Qt::LeftButton);
  EXPECT_FALSE(coach->isVisible());
}

TEST_F(Flow, TwoHiddenEffectsAreFoundOneAfterTheOther) {
  ASSERT_TRUE(open_and_run(small_rig(5, {{"range_walk", 10.0}, {"board_bow", 4.0}}), false));
  std::set<std::string> found;
  for (std::size_t k = 1; k <= 2; ++k) {
    ASSERT_NE(work().ranking(), nullptr);
    ASSERT_TRUE(work().ranking()->proposals.front().suggested);
    found.insert(work().ranking()->proposals.front().finding.id);
    QTest::mouseClick(test::find<QPushButton>(window_, "add_proposal"), Qt::LeftButton);
    ASSERT_TRUE(test::wait_until([&] { return work().current() == k; }));
    ASSERT_TRUE(wait_idle());
  }
  EXPECT_THAT(found, ::testing::UnorderedElementsAre("range_walk", "board_bow"));
  const double mended = unexplained(Channel::kRange);
  ASSERT_TRUE(test::trigger(window_, "undo"));
  ASSERT_TRUE(test::trigger(window_, "undo"));
  EXPECT_TRUE(work().step()->terms.empty());
  EXPECT_LT(mended, 0.5 * unexplained(Channel::kRange));
}

// From the end of the calibration to the end of the search, on the page of the pose; and a dialog
// of the result that is open meanwhile.
TEST_F(Flow, ThePoseIsCalledGoodOnceNothingIsMissing) {
  const QString path = folder_.filePath("rig");
  ASSERT_TRUE(make_demo(path.toStdString(), small_rig(4, {}), {}));
  window_.open(path);
  ASSERT_TRUE(test::wait_until([&] { return window_.workspace().is_open(); }));
  ASSERT_TRUE(test::wait_until([&] { return !window_.workspace().busy(); }));
  test::find<QTabWidget>(window_, "pages")->setCurrentIndex(2);
  test::trigger(window_, "run");
  ASSERT_TRUE(test::wait_for_result(window_));
  ASSERT_TRUE(work().busy());
  const auto* pose = test::find<QTextBrowser>(window_, "pose");
  EXPECT_THAT(pose->toPlainText().toStdString(), HasSubstr("good so far; still looking"));
  ASSERT_TRUE(test::trigger(window_, "results"));
  const auto* results = test::find<QTextBrowser>(window_, "results");
  ASSERT_NE(results, nullptr);
  EXPECT_THAT(results->toPlainText().toStdString(), HasSubstr("good so far; still looking"));
  ASSERT_TRUE(wait_idle());
  EXPECT_THAT(pose->toPlainText().toStdString(), ::testing::StartsWith("Quality: good\n"));
  EXPECT_THAT(results->toPlainText().toStdString(), ::testing::StartsWith("Quality: good\n"));
}

// A fit that was cancelled can be taken up again where it is missed.
TEST_F(Flow, ACancelledFitCanBeTakenUpAgain) {
  ASSERT_TRUE(open_and_run(small_rig(4, {}), false));
  test::click_scene(window_, "C", true);
  if (!window_.workspace().up_to_date()) test::trigger(window_, "run");
  ASSERT_TRUE(test::wait_for_result(window_));
  ASSERT_TRUE(test::wait_until([&] { return work().busy() && !work().step(); }, 60'000));
  test::trigger(window_, "cancel");
  ASSERT_TRUE(test::wait_until([&] { return !work().busy(); }, 60'000));
  ASSERT_FALSE(work().step());
  EXPECT_EQ(test::find<QLabel>(window_, "missing_verdict")->text(), "Nobody has looked yet.");
  EXPECT_THAT(test::find<QLabel>(window_, "model_message")->text().toStdString(),
              HasSubstr("press Look again"));
  auto* look = test::find<QPushButton>(window_, "look_missing");
  ASSERT_TRUE(look->isEnabled());
  QTest::mouseClick(look, Qt::LeftButton);
  ASSERT_TRUE(wait_idle());
  EXPECT_NE(work().ranking(), nullptr);
}

// With too few scenes for a model the whole page says so, and nothing asks for what is done.
TEST_F(Flow, TooFewScenesAreSaidTheSameEverywhere) {
  ASSERT_TRUE(open_and_run(small_rig(3, {}), false));
  const auto* message = test::find<QLabel>(window_, "model_message");
  const auto* missing = test::find<QLabel>(window_, "missing_verdict");
  const auto* quality = test::find<QLabel>(window_, "quality");
  test::click_scene(window_, "C", true);
  if (!window_.workspace().up_to_date()) test::trigger(window_, "run");
  ASSERT_TRUE(test::wait_for_result(window_));
  ASSERT_TRUE(test::wait_until([&] { return !work().busy() && !work().step(); }, 60'000));
  ASSERT_TRUE(message->isVisible());
  EXPECT_THAT(message->text().toStdString(), HasSubstr("scenes"));
  EXPECT_EQ(missing->text(), message->text());
  EXPECT_THAT(missing->text().toStdString(), ::testing::Not(HasSubstr("Run the calibration")));
  EXPECT_FALSE(quality->text().endsWith(": good")) << quality->text().toStdString();
}

TEST_F(Flow, WhereNothingIsHiddenThePageSaysSo) {
  test::Watchdog watchdog;
  ASSERT_TRUE(open_and_run(small_rig(4, {}), false));
  ASSERT_NE(work().ranking(), nullptr);
  for (const EffectProposal& p : work().ranking()->proposals)
    EXPECT_FALSE(p.suggested) << p.finding.id;
  EXPECT_THAT(test::find<QLabel>(window_, "quality")->text().toStdString(),
              ::testing::EndsWith(": good"));
  // Switching the covariate answers at once: the residuals are there.
  auto* plot = test::find<ResidualPlot>(window_, "residual_plot");
  auto* covariates = test::find<QComboBox>(window_, "covariate");
  ASSERT_TRUE(test::wait_until([&] { return plot->figure() != nullptr; }));
  int slowest = 0;
  for (int k = 1; k < covariates->count(); ++k) {
    QElapsedTimer clock;
    clock.start();
    covariates->setCurrentIndex(k);
    const std::string wanted = covariates->currentData().toString().toStdString();
    ASSERT_TRUE(
        test::wait_until([&] { return plot->figure() && plot->figure()->along().name == wanted; }));
    slowest = std::max(slowest, static_cast<int>(clock.elapsed()));
  }
  RecordProperty("slowest_switch_ms", slowest);
  RecordProperty("largest_gap_ms", static_cast<int>(watchdog.take_largest_ms()));
}

}  // namespace
}  // namespace lvcalib::widgets::model_flow_test
