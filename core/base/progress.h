// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <stop_token>
#include <string>

#include "base/message.h"

namespace lvcalib {

/// One progress report of a running stage.
struct Progress {
  std::string stage;      ///< "load", "detect", "localize", "refine", "optimize", …
  double fraction = 0.0;  ///< 0…1 of the whole run.
  Message text;           ///< One line for people.
};

/// Receives progress; may be called from worker threads, one call at a time.
using ProgressSink = std::function<void(const Progress&)>;

/// What every long-running function takes: where to report, when to stop, how many threads.
struct RunContext {
  ProgressSink progress;
  std::stop_token stop;
  int threads = 0;  ///< 0: as many as the machine has.

  void report(std::string stage, double fraction, Message text) const {
    if (progress) progress({std::move(stage), fraction, std::move(text)});
  }
  [[nodiscard]] bool stopped() const { return stop.stop_requested(); }
  /// For a part of a longer work: its own progress 0…1 runs from `from` to `to` of the whole.
  [[nodiscard]] RunContext part(double from, double to) const;
  /// For work whose progress nobody is to hear of.
  [[nodiscard]] RunContext silent() const;
  [[nodiscard]] int thread_count() const;
};

}  // namespace lvcalib
