// SPDX-License-Identifier: GPL-3.0-or-later
// Ctrl-C while calibrating: the program stops at once and leaves nothing half-written.
#include <algorithm>
#include <chrono>
#include <csignal>
#include <iostream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cli/child_process.h"
#include "cli/good_dataset.h"
#include "support/timing.h"

namespace lvcalib::testing {
namespace {
namespace fs = std::filesystem;

// Many copies of each scene, so that a run lasts long enough to be interrupted in every stage. The
// same files count once; so each copy's last point has a time of its own.
void make_long_dataset(const fs::path& path) {
  constexpr int kCopies = 12;
  copy_dataset(good_dataset(), path);
  for (const std::string& scene : scene_names(good_dataset())) {
    for (int copy = 0; copy < kCopies; ++copy) {
      const fs::path folder = path / "scenes" / (scene + std::to_string(100 + copy));
      fs::copy(path / "scenes" / scene, folder,
               fs::copy_options::recursive | fs::copy_options::copy_symlinks);
      std::string cloud = read_file(folder / "cloud.pcd");
      // A point ends with its time (float) and its line (two bytes).
      cloud[cloud.size() - 6] = static_cast<char>(cloud[cloud.size() - 6] ^ (copy + 1));
      write_file(folder / "cloud.pcd", cloud);
    }
  }
}

class Interrupt : public ::testing::Test {
 protected:
  // The signal's effect on a run, from the time at which it is sent.
  void interrupt_after(std::chrono::milliseconds delay) {
    RunSettings settings;
    settings.folder = folder_.path();
    settings.signal = SIGINT;
    settings.signal_after = delay;
    const Outcome outcome =
        run_lvcalib({"calibrate", "dataset", "-o", "out", "--threads", "2"}, settings);
    SCOPED_TRACE("after " + std::to_string(delay.count()) + " ms");
    // A signal that comes before main() finds the system's own handling: the same status.
    EXPECT_EQ(outcome.status, 128 + SIGINT) << outcome.err;
    EXPECT_EQ(outcome.out, "");
    EXPECT_LE(lines_with(outcome.err, "lvcalib: error: ").size(), 1U);
    if (!outcome.err.empty()) {
      EXPECT_THAT(outcome.err, ::testing::EndsWith("lvcalib: error: stopped by the user\n"));
    }
    EXPECT_FALSE(fs::exists(folder_.path() / "out"));
    EXPECT_THAT(unfinished_files(folder_.path()), ::testing::IsEmpty());
    // 0.2 s are promised; the rest is for a machine busy with other tests.
    EXPECT_LT(outcome.seconds, test::time_limit(1.0));
    slowest_s_ = std::max(slowest_s_, outcome.seconds);
  }

  TemporaryFolder folder_{"interrupt"};
  double slowest_s_ = 0.0;
};

TEST_F(Interrupt, StopsCalibrationAtAnyMoment) {
  make_long_dataset(folder_.path() / "dataset");
  for (const int delay_ms : {10, 30, 60, 100, 200, 400, 700, 1000, 1500, 2000}) {
    interrupt_after(std::chrono::milliseconds(delay_ms));
  }
  std::cout << "slowest stop: " << slowest_s_ << " s\n";
}

TEST_F(Interrupt, StopsTheSearchForABoardOfAnotherSize) {
  make_long_dataset(folder_.path() / "dataset");
  // Of this size the board is nowhere, and it is looked for in many.
  for (const auto& [from, to] : {std::pair{"tagSize: 0.12", "tagSize: 0.36"},
                                 {"circleRadius: 0.045", "circleRadius: 0.135"},
                                 {"margin: 0.06", "margin: 0.18"}}) {
    replace_text(folder_.path() / "dataset" / "target.yaml", from, to);
  }
  for (const int delay_ms : {500, 2000}) {
    interrupt_after(std::chrono::milliseconds(delay_ms));
  }
  std::cout << "slowest stop: " << slowest_s_ << " s\n";
}

}  // namespace
}  // namespace lvcalib::testing
