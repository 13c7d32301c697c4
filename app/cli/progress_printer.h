// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <chrono>
#include <mutex>
#include <string>

#include "base/progress.h"

namespace lvcalib::cli {

/// Text that came from files, made fit for a terminal: line ends become spaces, other control
/// characters (which could move the cursor, change the title or worse) question marks.
std::string printable(std::string text);

/// Shows progress on standard error: a bar that is redrawn on a terminal, one line per stage
/// otherwise. Warnings and errors go through it too, so that they never mix with the bar.
class ProgressPrinter {
 public:
  ProgressPrinter();
  ~ProgressPrinter();
  ProgressPrinter(const ProgressPrinter&) = delete;
  ProgressPrinter& operator=(const ProgressPrinter&) = delete;

  void show(const Progress& progress);
  /// One line, with the bar out of the way.
  void line(const std::string& text);
  /// Takes the bar away.
  void finish();

 private:
  void clear_bar();
  std::mutex mutex_;
  bool terminal_ = false;
  bool bar_shown_ = false;
  std::string stage_;
  std::chrono::steady_clock::time_point last_;
};

}  // namespace lvcalib::cli
