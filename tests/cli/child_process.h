// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

namespace lvcalib::testing {

/// How a run of the program ended and what it said.
struct Outcome {
  int status = -1;         ///< As a shell reports it: 128 + the signal if one ended it.
  bool timed_out = false;  ///< It was killed for taking too long.
  std::string out;
  std::string err;
  double seconds = 0.0;  ///< Wall time; from the signal on, if one was sent.
};

/// How to run it.
struct RunSettings {
  std::filesystem::path folder = ".";  ///< Where it runs.
  std::chrono::milliseconds limit{60'000};
  int signal = 0;  ///< Sent once after a while, if not 0.
  std::chrono::milliseconds signal_after{};
  /// The time counts from when the program has blocked the signal to listen for it itself; on a
  /// busy machine it may be loading for seconds.
  bool once_listening = false;
  /// Run without the super-user's right to read and write everything.
  bool unprivileged = false;
  /// Where standard output goes; empty: into the outcome.
  std::filesystem::path print_to = {};
};

/// Runs lvcalib in a process of its own and waits for it.
Outcome run_lvcalib(std::vector<std::string> arguments, const RunSettings& settings = {});

/// The lines of a text, without their ends.
std::vector<std::string> lines_of(const std::string& text);

/// The lines of `text` that start with `prefix`.
std::vector<std::string> lines_with(const std::string& text, const std::string& prefix);

/// Checks how a run must end that was refused before it made anything: the status, one error line
/// that says `what`, silence on standard output, and no `output`.
void expect_refusal(const Outcome& outcome, int status, const std::string& what,
                    const std::filesystem::path& output);

}  // namespace lvcalib::testing
