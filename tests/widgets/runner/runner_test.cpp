// SPDX-License-Identifier: GPL-3.0-or-later
#include "runner/runner.h"

#include <QElapsedTimer>
#include <QSignalSpy>
#include <QTest>
#include <atomic>
#include <chrono>
#include <stdexcept>
#include <thread>
#include <tuple>

#include <gtest/gtest.h>
#include <sys/resource.h>

namespace lvcalib::widgets::runner_test {
namespace {

using namespace std::chrono_literals;
using Deliver = Runner::Deliver;
using Post = Runner::Post;

TEST(Runner, DeliversInTheInterfaceThreadAndReportsProgress) {
  Runner runner;
  QSignalSpy progressed(&runner, &Runner::progressed);
  QSignalSpy finished(&runner, &Runner::finished);
  std::thread::id worked, delivered;
  int posted = 0;
  const auto id = runner.start([&](const RunContext& context, const Post& post) -> Deliver {
    worked = std::this_thread::get_id();
    context.report("load", 0.5, Message("half"));
    post([&] { ++posted; });
    return [&] { delivered = std::this_thread::get_id(); };
  });
  EXPECT_TRUE(runner.running());
  ASSERT_TRUE(finished.wait(5000));
  EXPECT_FALSE(runner.running());
  EXPECT_EQ(finished.first().first().toULongLong(), id);
  EXPECT_EQ(delivered, std::this_thread::get_id());
  EXPECT_NE(worked, delivered);
  EXPECT_EQ(posted, 1);
  ASSERT_EQ(progressed.count(), 1);
  EXPECT_EQ(progressed.first().at(1).toString(), "load");
  EXPECT_EQ(progressed.first().at(2).toDouble(), 0.5);
}

// A job that reports all the time is told of now and then, with what it reported last.
TEST(Runner, TellsTheLatestProgressNowAndThen) {
  Runner runner;
  QSignalSpy progressed(&runner, &Runner::progressed);
  QSignalSpy finished(&runner, &Runner::finished);
  std::atomic<bool> reported = false;
  std::atomic<bool> seen = false;
  QElapsedTimer clock;
  clock.start();
  runner.start([&](const RunContext& context, const Post&) -> Deliver {
    for (int k = 1; k <= 100; ++k) context.report("load", 0.001 * k, Message("point %1", k));
    for (const char* stage : {"detect", "refine", "load"}) context.report(stage, 0.1, {});
    reported = true;
    while (!seen) std::this_thread::sleep_for(1ms);
    for (int k = 101; k <= 500; ++k) {
      context.report("load", 0.001 * k, Message("point %1", k));
      std::this_thread::sleep_for(1ms);
    }
    return {};
  });
  while (!reported) std::this_thread::sleep_for(1ms);
  ASSERT_TRUE(QTest::qWaitFor([&] { return progressed.count() > 0; }, 10'000));
  // Where every stage begins, and then what was reported last.
  ASSERT_TRUE(QTest::qWaitFor([&] { return progressed.count() > 3; }, 10'000));
  for (const auto& [at, stage, fraction] :
       {std::tuple(0, "load", 0.001), {1, "detect", 0.1}, {2, "refine", 0.1}, {3, "load", 0.1}}) {
    EXPECT_EQ(progressed.at(at).at(1).toString(), stage);
    EXPECT_EQ(progressed.at(at).at(2).toDouble(), fraction);
  }
  seen = true;
  ASSERT_TRUE(finished.wait(20'000));
  EXPECT_GE(progressed.count(), 5);
  EXPECT_LE(progressed.count(), 4 + clock.elapsed() / Runner::kTellEveryMs);
}

// The window is drawn first, whatever is computed with as many threads as there are processors.
TEST(Runner, JobsAndTheirThreadsStandBehindTheWindow) {
  const int before = ::getpriority(PRIO_PROCESS, 0);
  Runner runner;
  int job = before;
  int helper = before;
  runner.start([&](const RunContext&, const Runner::Post&) -> Runner::Deliver {
    job = ::getpriority(PRIO_PROCESS, 0);
    std::thread([&] { helper = ::getpriority(PRIO_PROCESS, 0); }).join();
    return {};
  });
  ASSERT_TRUE(QTest::qWaitFor([&] { return !runner.running(); }, 10'000));
  if (before >= 19) GTEST_SKIP() << "there is no place further back";
  EXPECT_GT(job, before);
  EXPECT_GT(helper, before);
  EXPECT_EQ(::getpriority(PRIO_PROCESS, 0), before) << "the window keeps its own";
}

TEST(Runner, ExceptionsBecomeMessages) {
  Runner runner;
  QSignalSpy failed(&runner, &Runner::failed);
  runner.start(
      [](const RunContext&, const Post&) -> Deliver { throw std::runtime_error("broken stage"); });
  ASSERT_TRUE(failed.wait(5000));
  EXPECT_EQ(failed.first().at(1).toString(), "broken stage");
  runner.start([](const RunContext&, const Post&) -> Deliver { throw 7; });
  ASSERT_TRUE(failed.wait(5000));
  EXPECT_FALSE(failed.last().at(1).toString().isEmpty());
  // While the results are handed over as well.
  runner.start([](const RunContext&, const Post&) -> Deliver {
    return [] { throw std::runtime_error("broken delivery"); };
  });
  ASSERT_TRUE(failed.wait(5000));
  EXPECT_EQ(failed.last().at(1).toString(), "broken delivery");
  EXPECT_FALSE(runner.running());
}

TEST(Runner, APoliteJobHandsOverWhatItHasWhenCancelled) {
  Runner runner;
  QSignalSpy cancelled(&runner, &Runner::cancelled);
  bool kept = false;
  runner.start([&](const RunContext& context, const Post&) -> Deliver {
    while (!context.stopped()) std::this_thread::sleep_for(1ms);
    return [&] { kept = true; };
  });
  runner.cancel();
  ASSERT_TRUE(cancelled.wait(5000));
  EXPECT_TRUE(kept);
}

TEST(Runner, WhatWasPostedBeforeACancelIsNotHandedOverAfterIt) {
  Runner runner;
  QSignalSpy cancelled(&runner, &Runner::cancelled);
  bool late = false;
  std::atomic<bool> posted = false;
  runner.start([&](const RunContext& context, const Post& post) -> Deliver {
    post([&] { late = true; });
    posted = true;
    while (!context.stopped()) std::this_thread::sleep_for(1ms);
    return {};
  });
  while (!posted) std::this_thread::sleep_for(1ms);  // Without a look at what is in the queue.
  runner.cancel();
  ASSERT_TRUE(cancelled.wait(5000));
  EXPECT_FALSE(late);
}

TEST(Runner, AnAbandonedJobIsGoneAtOnceWithoutASignal) {
  Runner runner;
  QSignalSpy cancelled(&runner, &Runner::cancelled);
  QSignalSpy finished(&runner, &Runner::finished);
  bool late = false;
  runner.start([&](const RunContext& context, const Post&) -> Deliver {
    while (!context.stopped()) std::this_thread::sleep_for(1ms);
    return [&] { late = true; };
  });
  runner.abandon();
  EXPECT_FALSE(runner.running());
  EXPECT_TRUE(Runner::wait_for_workers(5000));
  QTest::qWait(150);
  EXPECT_FALSE(late);
  EXPECT_EQ(cancelled.count() + finished.count(), 0);
}

TEST(Runner, AJobThatDoesNotStopIsAbandonedInTimeAndItsResultDropped) {
  Runner runner;
  QSignalSpy cancelled(&runner, &Runner::cancelled);
  QSignalSpy finished(&runner, &Runner::finished);
  std::atomic<bool> release = false;
  bool late = false;
  runner.start([&](const RunContext&, const Post& post) -> Deliver {
    while (!release) std::this_thread::sleep_for(1ms);
    post([&] { late = true; });
    return [&] { late = true; };
  });
  runner.cancel();
  ASSERT_TRUE(cancelled.wait(5000));  // While the job still waits to be released.
  EXPECT_FALSE(runner.running());
  bool second = false;
  runner.start([&](const RunContext&, const Post&) -> Deliver { return [&] { second = true; }; });
  release = true;
  ASSERT_TRUE(finished.wait(5000));
  EXPECT_TRUE(Runner::wait_for_workers(5000));
  QTest::qWait(20);
  EXPECT_TRUE(second);
  EXPECT_FALSE(late);
  EXPECT_EQ(cancelled.count(), 1);
}

TEST(Runner, ANewJobTakesThePlaceOfTheRunningOne) {
  Runner runner;
  QSignalSpy cancelled(&runner, &Runner::cancelled);
  QSignalSpy finished(&runner, &Runner::finished);
  int first = 0, second = 0;
  const auto slow = runner.start([&](const RunContext& context, const Post&) -> Deliver {
    while (!context.stopped()) std::this_thread::sleep_for(1ms);
    return [&] { ++first; };
  });
  const auto quick =
      runner.start([&](const RunContext&, const Post&) -> Deliver { return [&] { ++second; }; });
  EXPECT_GT(quick, slow);
  ASSERT_TRUE(finished.wait(5000));
  EXPECT_TRUE(Runner::wait_for_workers(5000));
  QTest::qWait(20);
  EXPECT_EQ(first, 0);
  EXPECT_EQ(second, 1);
  EXPECT_EQ(cancelled.first().first().toULongLong(), slow);
}

TEST(Runner, MayGoAwayWhileItsJobRuns) {
  std::atomic<bool> release = false;
  bool delivered = false;
  {
    Runner runner;
    runner.start([&](const RunContext& context, const Post& post) -> Deliver {
      while (!release) std::this_thread::sleep_for(1ms);
      context.report("load", 1.0, Message("late"));
      post([&] { delivered = true; });
      return [&] { delivered = true; };
    });
  }
  EXPECT_FALSE(Runner::wait_for_workers(20));
  release = true;
  EXPECT_TRUE(Runner::wait_for_workers(5000));
  QTest::qWait(20);
  EXPECT_FALSE(delivered);
}

}  // namespace
}  // namespace lvcalib::widgets::runner_test
