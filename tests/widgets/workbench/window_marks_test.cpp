// SPDX-License-Identifier: GPL-3.0-or-later
// What the window has to reach with six scenes of a quarter million points each: memory, and how
// long it lets a click wait. The marks are 600 MB and 100 ms of its own work; both are told always
// and asserted under LVCALIB_TIMINGS, as other machines have other clocks and libraries.
#include <QComboBox>
#include <QDialog>
#include <QElapsedTimer>
#include <QPushButton>
#include <QTabWidget>
#include <QTemporaryDir>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <string>

#include <gtest/gtest.h>
#include <malloc.h>

#include "runner/demo.h"
#include "runner/memory.h"
#include "support/timing.h"
#include "views/cloud_scene_builder.h"
#include "widgets/support/driver.h"

namespace lvcalib::window_marks_test {
namespace {

using widgets::MainWindow;

constexpr double kMemoryMark_mb = 600.0;
constexpr double kAnswerMark_ms = 100.0;

// A number of /proc/self/status, in MB.
double process_mb(const std::string& name) {
  std::ifstream status("/proc/self/status");
  std::string word;
  while (status >> word) {
    double kb = 0.0;
    if (word == name + ":" && status >> kb) return kb / 1024.0;
  }
  return 0.0;
}

// From here on VmHWM tells the largest size since now.
void forget_peak() {
  malloc_trim(0);
  std::ofstream("/proc/self/clear_refs") << 5;
}

class WindowMarksTest : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    widgets::give_memory_back();
    data_ = new QTemporaryDir;
    simulation::SimulationOptions options;
    options.seed = 3;
    options.scenes = 6;
    options.lidar.points = 250'000;
    options.effects["range_walk"] = 10.0;  // mm: so that there is something to add.
    ASSERT_TRUE(widgets::make_demo(dataset().toStdString(), options, {}).ok());
  }
  static void TearDownTestSuite() {
    delete data_;
    EXPECT_TRUE(widgets::Runner::wait_for_workers(60'000));
  }
  static QString dataset() { return data_->filePath(QStringLiteral("dataset")); }

  void SetUp() override {
    forget_peak();
    before_mb_ = process_mb("VmRSS");
    settings_ = std::make_unique<widgets::AppSettings>(folder_.path());
    window_ = std::make_unique<MainWindow>(*settings_, answers_);
    window_->resize(1500, 900);
    window_->show();
    window_->open(dataset());
    ASSERT_TRUE(test::wait_until(
        [&] { return window_->workspace().is_open() && !window_->workspace().busy(); }));
    ASSERT_TRUE(test::trigger(*window_, "run"));
    ASSERT_TRUE(test::wait_for_result(*window_));
  }
  static void tell(const std::string& after) {
    std::printf("  %.0f MB after %s\n", process_mb("VmRSS"), after.c_str());
  }
  // Every page, every scene.
  void look_at_everything() {
    auto* tabs = test::find<QTabWidget>(*window_, "pages");
    tell("the run");
    for (int tab = 0; tab < tabs->count(); ++tab) {
      tabs->setCurrentIndex(tab);
      QTest::qWait(500);
      tell("page " + tabs->tabText(tab).toStdString());
    }
    ASSERT_TRUE(test::wait_until(
        [&] { return window_->model_work().step() && !window_->model_work().busy(); }, 300'000));
    tell("the model");
    tabs->setCurrentIndex(0);
    for (const char* scene : {"B", "C", "D", "E", "F", "A"}) {
      test::click_scene(*window_, scene, false);
      QTest::qWait(800);
    }
    tell("every scene");
  }

  // The effect of the dataset into the model; false if nothing was offered or nothing came of it.
  bool add() {
    auto* button = test::find<QPushButton>(*window_, "add_proposal");
    if (!button->isEnabled()) return false;
    button->click();
    const widgets::ModelWork& model = window_->model_work();
    return test::wait_until(
        [&] { return model.current() == 1 && model.result() && !model.behind(); }, 300'000);
  }
  bool wait_for_model() {
    return test::wait_until(
        [&] { return window_->model_work().ranking() && !window_->model_work().busy(); }, 300'000);
  }

  static inline QTemporaryDir* data_ = nullptr;
  QTemporaryDir folder_;
  test::Answers answers_;
  std::unique_ptr<widgets::AppSettings> settings_;
  std::unique_ptr<MainWindow> window_;
  // Told whatever they are.
  static void expect_below_mark(const char* what, double mb) {
    std::printf("  %s: %.0f MB of %.0f\n", what, mb, kMemoryMark_mb);
    if (test::timings_count()) EXPECT_LT(mb, kMemoryMark_mb) << what;
  }
  double before_mb_ = 0.0;
};

TEST_F(WindowMarksTest, SixScenesFitIntoMemory) {
  look_at_everything();
  ASSERT_TRUE(wait_for_model());
  const double peak_mb = process_mb("VmHWM");
  malloc_trim(0);
  const double now_mb = process_mb("VmRSS");
  std::printf("six scenes of 250 000 points: %.0f MB, %.0f MB at most (%.0f before the window)\n",
              now_mb, peak_mb, before_mb_);
  RecordProperty("window_mb", static_cast<int>(now_mb));
  RecordProperty("window_peak_mb", static_cast<int>(peak_mb));
  expect_below_mark("after looking at everything", now_mb);
  expect_below_mark("at most", peak_mb);
  // The measurements as an added effect sorts them are a second table of 55 MB.
  auto* tabs = test::find<QTabWidget>(*window_, "pages");
  tabs->setCurrentIndex(4);
  QTest::qWait(500);
  forget_peak();
  ASSERT_TRUE(add());
  ASSERT_TRUE(wait_for_model());
  for (int page = 0; page < tabs->count(); ++page) {
    tabs->setCurrentIndex(page);
    QTest::qWait(500);
    tell("page " + tabs->tabText(page).toStdString());
  }
  const double peak_added_mb = process_mb("VmHWM");
  malloc_trim(0);
  const double added_mb = process_mb("VmRSS");
  std::printf("after adding an effect: %.0f MB, %.0f MB at most\n", added_mb, peak_added_mb);
  RecordProperty("added_mb", static_cast<int>(added_mb));
  RecordProperty("peak_added_mb", static_cast<int>(peak_added_mb));
  expect_below_mark("after adding an effect", added_mb);
  expect_below_mark("at most, then", peak_added_mb);
}

// How long an added effect takes until every page has it, and what the window does not answer
// meanwhile: told, as other machines have other clocks.
TEST_F(WindowMarksTest, AnAddedEffectIsOnEveryPageSoon) {
  ASSERT_TRUE(wait_for_model());
  auto* tabs = test::find<QTabWidget>(*window_, "pages");
  for (int page = 0; page < tabs->count(); ++page) {
    tabs->setCurrentIndex(page);
    QTest::qWait(500);
  }
  tabs->setCurrentIndex(4);
  QTest::qWait(1000);
  test::Watchdog watchdog;
  QElapsedTimer clock;
  const auto tell_gap = [&](const std::string& what) {
    std::printf("  %lld ms: %s; largest gap %lld ms, of work %.0f ms\n", clock.elapsed(),
                what.c_str(), watchdog.take_largest_ms(), watchdog.take_busiest_ms());
  };
  watchdog.take_largest_ms();
  watchdog.take_busiest_ms();
  clock.start();
  ASSERT_TRUE(add());
  tell_gap("the calibration with it is there");
  // A page has it once nothing waits to be drawn any more.
  for (int page = 0; page < tabs->count(); ++page) {
    tabs->setCurrentIndex(page);
    for (QElapsedTimer turn; turn.start(), QTest::qWait(10), turn.elapsed() > 20;) continue;
    ASSERT_TRUE(test::wait_until([&] {
      const auto builders = window_->findChildren<widgets::CloudSceneBuilder*>();
      return std::none_of(builders.begin(), builders.end(),
                          [](const auto* builder) { return builder->busy(); });
    }));
    tell_gap("page " + tabs->tabText(page).toStdString());
  }
  ASSERT_TRUE(wait_for_model());
  QTest::qWait(500);
  tell_gap("searched again for what is missing");
}

TEST_F(WindowMarksTest, EveryClickIsAnswered) {
  look_at_everything();
  test::Watchdog watchdog;
  double worst_ms = 0.0;
  double busiest_ms = 0.0;
  std::string busiest;
  const auto answered = [&](const std::string& what, const std::function<void()>& click) {
    QTest::qWait(60);
    watchdog.take_largest_ms();
    watchdog.take_busiest_ms();
    click();
    QCoreApplication::processEvents();
    QTest::qWait(150);
    const auto gap = static_cast<double>(watchdog.take_largest_ms());
    const double work = watchdog.take_busiest_ms();
    if (gap > 60.0 || work > 60.0)
      std::cout << "  " << gap << " ms after " << what << ", " << std::lround(work)
                << " ms of them its own work\n";
    worst_ms = std::max(worst_ms, gap);
    if (work > busiest_ms) busiest = what;
    busiest_ms = std::max(busiest_ms, work);
  };
  auto* tabs = test::find<QTabWidget>(*window_, "pages");
  for (int k = 0; k < tabs->count(); ++k)
    answered("tab " + std::to_string(k), [&] { tabs->setCurrentIndex(k); });
  tabs->setCurrentIndex(0);
  for (const char* scene : {"B", "C", "D", "A"})
    answered(std::string("scene ") + scene, [&] { test::click_scene(*window_, scene, false); });
  for (const char* box : {"cloud-color", "cloud-filter"}) {
    auto* choice = test::find<QComboBox>(*window_, box);
    for (int k = choice->count() - 1; k >= 0; --k)
      answered(std::string(box) + " " + std::to_string(k), [&] { choice->setCurrentIndex(k); });
  }
  for (const char* name :
       {"results", "compare_results", "check_fresh_data", "plan_scenes", "target_camera",
        "camera_alone", "print_board", "correct_clouds", "guide", "about"}) {
    answered(name, [&] { test::trigger(*window_, name); });
    for (QDialog* dialog : window_->findChildren<QDialog*>()) dialog->close();
  }
  for (const char* what : {"theme", "language"}) {
    for (QAction* action : window_->findChildren<QAction*>(QString::fromLatin1(what)))
      answered(what + (" " + action->data().toString().toStdString()), [&] { action->trigger(); });
  }
  answered("unticking a scene", [&] { test::click_scene(*window_, "B", true); });
  answered("undoing that", [&] { test::trigger(*window_, "undo"); });
  ASSERT_TRUE(test::wait_for_result(*window_));
  std::printf("slowest answer to a click: %.0f ms, of work: %.0f ms\n", worst_ms, busiest_ms);
  RecordProperty("slowest_answer_ms", static_cast<int>(worst_ms));
  RecordProperty("busiest_answer_ms", static_cast<int>(busiest_ms));
  EXPECT_LE(busiest_ms, test::time_limit(kAnswerMark_ms)) << busiest << " keeps the window busy";
}

}  // namespace
}  // namespace lvcalib::window_marks_test
