// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/parallel.h"

#include <atomic>
#include <chrono>
#include <set>
#include <stdexcept>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "base/progress.h"

namespace lvcalib {
namespace {

TEST(ParallelFor, DoesEveryIndexOnce) {
  for (const int threads : {-1, 0, 1, 2, 7}) {
    for (const std::size_t count : {std::size_t{0}, std::size_t{1}, std::size_t{1000}}) {
      std::vector<std::atomic<int>> seen(count);
      parallel_for(count, threads, [&](std::size_t i) { ++seen[i]; });
      for (const auto& n : seen) EXPECT_EQ(n, 1);
    }
  }
}

TEST(ParallelFor, WorksOnSeveralThreadsAtOnce) {
  // Two calls that wait for each other end only if they run side by side.
  std::atomic<int> arrived{0};
  parallel_for(2, 2, [&](std::size_t) {
    ++arrived;
    while (arrived < 2) std::this_thread::yield();
  });
  EXPECT_EQ(arrived, 2);
}

TEST(ParallelFor, HandsOnTheFirstExceptionAndStops) {
  for (const int threads : {1, 4}) {
    std::atomic<int> calls{0};
    // The others take their time: a busy machine may put the third call's thread aside.
    EXPECT_THROW(parallel_for(10'000, threads,
                              [&](std::size_t i) {
                                ++calls;
                                if (i == 3) throw std::runtime_error("three");
                                if (i > 3)
                                  std::this_thread::sleep_for(std::chrono::milliseconds(1));
                              }),
                 std::runtime_error);
    EXPECT_LT(calls, 10'000);
  }
}

TEST(ParallelTwoSteps, TheSecondFollowsTheFirst) {
  for (const int threads : {1, 2, 5}) {
    std::vector<int> steps(7, 0);
    std::atomic<int> wrong{0};
    parallel_two_steps(
        steps.size(), threads, [&](std::size_t i) { steps[i] = 1; },
        [&](std::size_t i) {
          if (steps[i] != 1) ++wrong;
          steps[i] = 2;
        });
    EXPECT_EQ(wrong, 0) << threads;
    for (const int step : steps) EXPECT_EQ(step, 2) << threads;
  }
}

TEST(ParallelTwoSteps, AFailureOfTheFirstIsHandedOnAndNobodyWaitsForIt) {
  for (const int threads : {1, 2, 5}) {
    std::atomic<bool> followed{false};
    EXPECT_THROW(parallel_two_steps(
                     4, threads,
                     [](std::size_t i) {
                       if (i == 2) throw std::runtime_error("third");
                     },
                     [&](std::size_t i) {
                       if (i == 2) followed = true;
                     }),
                 std::runtime_error);
    EXPECT_FALSE(followed) << threads;
  }
}

TEST(RunContext, ReportsStopsAndCountsThreads) {
  std::stop_source stop;
  std::vector<std::string> stages;
  RunContext context;
  context.stop = stop.get_token();
  context.report("load", 0.1, Message("nobody listens"));
  context.progress = [&](const Progress& p) { stages.push_back(p.stage + " " + p.text.text()); };
  context.report("load", 0.5, Message("half"));
  EXPECT_EQ(stages, std::vector<std::string>{"load half"});
  EXPECT_FALSE(context.stopped());
  stop.request_stop();
  EXPECT_TRUE(context.stopped());
  EXPECT_GE(context.thread_count(), 1);
  context.threads = 5;
  EXPECT_EQ(context.thread_count(), 5);
}

TEST(RunContext, APartReportsAsAPartOfTheWhole) {
  std::vector<double> fractions;
  RunContext context;
  context.progress = [&](const Progress& p) { fractions.push_back(p.fraction); };
  context.threads = 3;
  const RunContext part = context.part(0.2, 0.6);
  part.report("load", 0.0, Message("begun"));
  part.report("load", 0.5, Message("half"));
  part.part(0.5, 1.0).report("load", 0.5, Message("a part of the part"));
  part.report("load", 7.0, Message("never beyond its end"));
  ASSERT_EQ(fractions.size(), 4u);
  const double expected[] = {0.2, 0.4, 0.5, 0.6};
  for (std::size_t k = 0; k < 4; ++k) EXPECT_DOUBLE_EQ(fractions[k], expected[k]) << k;
  EXPECT_EQ(part.thread_count(), 3);
  context.silent().report("load", 0.5, Message("nobody hears"));
  EXPECT_EQ(fractions.size(), 4u);
  EXPECT_EQ(context.silent().thread_count(), 3);
}

}  // namespace
}  // namespace lvcalib
