// SPDX-License-Identifier: GPL-3.0-or-later
// Runs the real program: exit status, streams, interruption.
#include <algorithm>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "cli/child_process.h"
#include "cli/good_dataset.h"
#include "support/timing.h"

namespace lvcalib::testing {
namespace {
namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::StartsWith;

class CommandLine : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::temp_directory_path() /
              ("lvcalib_cli_" + std::string(info->name()) + std::to_string(::getpid()));
    fs::create_directories(folder_ / "work");
  }
  void TearDown() override { fs::remove_all(folder_); }

  // Runs the program in folder "work"; sends a signal some time after it listens, if asked to.
  Outcome run(std::vector<std::string> arguments, int signal = 0,
              std::chrono::milliseconds after = {}) {
    RunSettings settings;
    settings.folder = folder_ / "work";
    settings.signal = signal;
    settings.signal_after = after;
    settings.once_listening = true;
    return run_lvcalib(std::move(arguments), settings);
  }
  [[nodiscard]] bool work_is_empty() const { return fs::is_empty(folder_ / "work"); }

  fs::path folder_;
};

TEST_F(CommandLine, HelpAndVersionGoToStandardOutput) {
  for (const std::vector<std::string>& arguments : {std::vector<std::string>{"--help"},
                                                    {"--version"},
                                                    {"target", "--help"},
                                                    {"target", "--version"}}) {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.status, 0);
    EXPECT_THAT(outcome.out, HasSubstr("lvcalib"));
    EXPECT_EQ(outcome.err, "");
  }
}

TEST_F(CommandLine, WrongUsageExitsWithTwoAndOneLine) {
  for (const std::vector<std::string>& arguments : {std::vector<std::string>{},
                                                    {"frobnicate"},
                                                    {"target"},
                                                    {"target", "-o"},
                                                    {"target", "-o", "x.pdf", "--bad"},
                                                    {"target", "-o", "x.pdf", "--threads", "-1"},
                                                    {"target", "-o", "x.pdf", "--threads", "many"},
                                                    {"target", "-o", "x.pdf", "--dpi", "z"},
                                                    {"target", "-o", "x.doc"},
                                                    {"target", "-o", "x"},
                                                    {"target", "-o", "x.pdf", "--paper", "B7"},
                                                    {"target", "-o", "x.png", "--dpi", "1e9"},
                                                    {"target", "-o", "x.svg", "--paper", "A4"}}) {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.status, 2) << outcome.err;
    EXPECT_EQ(outcome.out, "");
    EXPECT_THAT(outcome.err, StartsWith("lvcalib: error: "));
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    EXPECT_TRUE(work_is_empty());
  }
}

TEST_F(CommandLine, BadInputExitsWithThreeAndNamesThePlace) {
  const Outcome absent = run({"target", "absent.yaml", "-o", "x.pdf"});
  EXPECT_EQ(absent.status, 3);
  EXPECT_EQ(absent.err, "lvcalib: error: absent.yaml: file not found\n");
  std::ofstream(folder_ / "bad.yaml") << "target_type: aprilgrid\ntagCols: four\n";
  const Outcome bad = run({"target", folder_ / "bad.yaml", "-o", "x.pdf"});
  EXPECT_EQ(bad.status, 3);
  EXPECT_THAT(bad.err, HasSubstr("bad.yaml:2: 'tagCols' must be a number, found 'four'"));
  const Outcome nowhere = run({"target", "-o", "no/such/folder/x.pdf", "--quiet"});
  EXPECT_EQ(nowhere.status, 3);
  EXPECT_THAT(nowhere.err, StartsWith("lvcalib: error: no/such/folder/x.pdf: cannot be written"));
  EXPECT_TRUE(work_is_empty());
}

TEST_F(CommandLine, TargetWritesTheSheetAndOneLine) {
  const Outcome loud = run({"target", "-o", "x.pdf"});
  EXPECT_EQ(loud.status, 0);
  EXPECT_EQ(std::count(loud.out.begin(), loud.out.end(), '\n'), 1);
  EXPECT_THAT(loud.err, HasSubstr("draw"));
  EXPECT_THAT(read_file(folder_ / "work" / "x.pdf"), StartsWith("%PDF"));
  std::ofstream(folder_ / "t.yaml") << "target_type: aprilgrid\ntagCols: 3\ntagRows: 2\n"
                                       "tagSize: 0.05\ntagSpacing: 0.3\ntagSizes: 1\n";
  const Outcome quiet = run({"target", folder_ / "t.yaml", "-o", "y.SVG", "--quiet"});
  EXPECT_EQ(quiet.status, 0);
  EXPECT_THAT(quiet.err, StartsWith("lvcalib: warning: "));  // and no progress
  EXPECT_THAT(quiet.err, HasSubstr("did you mean 'tagSize'?"));
  EXPECT_EQ(std::count(quiet.err.begin(), quiet.err.end(), '\n'), 1);
}

TEST_F(CommandLine, InterruptsStopItSoonAndLeaveNothing) {
  // An image that takes seconds to encode.
  for (const int signal : {SIGINT, SIGTERM}) {
    for (const int after_ms : {100, 300, 700}) {
      const Outcome outcome = run({"target", "-o", "big.png", "--dpi", "800"}, signal,
                                  std::chrono::milliseconds(after_ms));
      EXPECT_EQ(outcome.status, 130) << outcome.err;
      EXPECT_THAT(outcome.err, HasSubstr("lvcalib: error: stopped by the user"));
      EXPECT_EQ(outcome.out, "");
      // 0.2 s are promised; the rest is for a machine busy with other tests.
      EXPECT_LT(outcome.seconds, test::time_limit(3.0));
      EXPECT_TRUE(work_is_empty());
    }
  }
}

TEST_F(CommandLine, StartedInTheBackgroundItStillListensToInterrupts) {
  // A shell without job control starts background programs with SIGINT ignored.
  struct sigaction before {};
  struct sigaction ignore {};
  ignore.sa_handler = SIG_IGN;
  ::sigaction(SIGINT, &ignore, &before);
  const Outcome outcome =
      run({"target", "-o", "big.png", "--dpi", "800"}, SIGINT, std::chrono::milliseconds(300));
  ::sigaction(SIGINT, &before, nullptr);
  EXPECT_EQ(outcome.status, 130);
}

}  // namespace
}  // namespace lvcalib::testing
