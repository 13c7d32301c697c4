// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <stop_token>
#include <thread>

namespace lvcalib::cli {

/// Turns SIGINT and SIGTERM into a stop request. Must be created before any other thread, so that
/// all threads inherit the blocked signals; a thread of its own then waits for them, where every
/// call is allowed (a signal handler may do next to nothing).
///
/// A command that has not come to an end `kGrace` after the first signal, or sees a second one, is
/// ended on the spot with exit status 130: results appear only as complete files, so nothing
/// half-written can be left under a result's name.
class InterruptWatch {
 public:
  InterruptWatch();
  ~InterruptWatch();
  InterruptWatch(const InterruptWatch&) = delete;
  InterruptWatch& operator=(const InterruptWatch&) = delete;

  [[nodiscard]] std::stop_token token() const { return source_.get_token(); }

 private:
  void watch();
  std::stop_source source_;
  std::atomic<bool> done_{false};
  std::jthread thread_;
};

}  // namespace lvcalib::cli
