// SPDX-License-Identifier: GPL-3.0-or-later
// The window answers at once, whatever it is doing.
#include <QElapsedTimer>
#include <iostream>

#include <gtest/gtest.h>

#include "support/timing.h"
#include "widgets/workbench/main_window_fixture.h"

namespace lvcalib::window_speed_test {
namespace {

using test::MainWindowTest;
using test::small_demo;
using test::trigger;
using test::wait_until;
using widgets::MainWindow;

TEST_F(MainWindowTest, TheWindowIsUpWithinASecond) {
  window_.reset();
  QElapsedTimer clock;
  clock.start();
  window_ = std::make_unique<MainWindow>(*settings_, answers_);
  window_->show();
  ASSERT_TRUE(QTest::qWaitForWindowExposed(window_.get()));
  QCoreApplication::processEvents();
  std::cout << "start to a usable window: " << clock.elapsed() << " ms\n";
  RecordProperty("start_ms", static_cast<int>(clock.elapsed()));
  EXPECT_LT(clock.elapsed(), test::time_limit(1000));
}

// Reading, running and cancelling three scenes of half a million points each.
TEST_F(MainWindowTest, TheWindowNeverFreezes) {
  auto options = small_demo();
  options.lidar.points = 500'000;
  window_->set_demo(options);
  test::Watchdog watchdog;
  const auto report = [&](const char* what) {
    const auto gap = watchdog.take_largest_ms();
    std::cout << "largest gap while " << what << ": " << gap << " ms\n";
    RecordProperty(std::string("gap_ms_") + what, static_cast<int>(gap));
    EXPECT_LT(gap, test::time_limit(1000)) << what;
  };
  watchdog.take_largest_ms();
  trigger(*window_, "demo");
  ASSERT_TRUE(wait_until([&] { return workspace().is_open() && !workspace().busy(); }));
  QTest::qWait(1500);
  report("opening");
  trigger(*window_, "run");
  QTest::qWait(700);
  trigger(*window_, "cancel");
  ASSERT_TRUE(wait_until([&] { return !workspace().busy(); }));
  report("cancelling");
  trigger(*window_, "run");
  ASSERT_TRUE(test::wait_for_result(*window_));
  QTest::qWait(500);
  report("running");
  for (const char* scene : {"B", "C", "A"}) {
    test::click_scene(*window_, scene, false);
    QTest::qWait(700);
  }
  report("looking");
}

}  // namespace
}  // namespace lvcalib::window_speed_test
