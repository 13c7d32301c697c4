// SPDX-License-Identifier: BSD-3-Clause
#include "base/parallel.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

#include "base/progress.h"

namespace lvcalib {

int RunContext::thread_count() const {
  if (threads > 0) return threads;
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

RunContext RunContext::silent() const {
  RunContext out = *this;
  out.progress = nullptr;
  return out;
}

RunContext RunContext::part(double from, double to) const {
  RunContext out = *this;
  if (!progress) return out;
  out.progress = [whole = progress, from, to](const Progress& p) {
    whole({p.stage, from + (to - from) * std::clamp(p.fraction, 0.0, 1.0), p.text});
  };
  return out;
}

void parallel_for(std::size_t count, int threads, const std::function<void(std::size_t)>& work) {
  const std::size_t workers =
      std::min<std::size_t>(count, static_cast<std::size_t>(std::max(1, threads)));
  if (workers <= 1) {
    for (std::size_t i = 0; i < count; ++i) work(i);
    return;
  }
  std::atomic<std::size_t> next{0};
  std::exception_ptr failure;
  std::mutex failure_mutex;
  auto run = [&] {
    for (std::size_t i = next++; i < count; i = next++) {
      try {
        work(i);
      } catch (...) {
        const std::lock_guard lock(failure_mutex);
        if (!failure) failure = std::current_exception();
        next = count;
      }
    }
  };
  {
    std::vector<std::jthread> pool;
    pool.reserve(workers);
    try {
      for (std::size_t t = 1; t < workers; ++t) pool.emplace_back(run);
    } catch (const std::system_error&) {
      // No more threads to be had: those that there are do the work.
    }
    run();
  }
  if (failure) std::rethrow_exception(failure);
}

void parallel_two_steps(std::size_t count, int threads,
                        const std::function<void(std::size_t)>& first,
                        const std::function<void(std::size_t)>& second) {
  enum State : int { kOpen, kDone, kFailed };
  std::vector<std::atomic<int>> states(count);
  const auto set = [&](std::size_t i, State state) {
    states[i] = state;
    states[i].notify_all();
  };
  parallel_for(2 * count, threads, [&](std::size_t task) {
    const std::size_t i = task % count;
    if (task >= count) {
      // Handed out before, so that another thread is at it if it is not done.
      states[i].wait(kOpen);
      if (states[i] == kDone) second(i);
      return;
    }
    try {
      first(i);
    } catch (...) {
      set(i, kFailed);
      throw;
    }
    set(i, kDone);
  });
}

}  // namespace lvcalib
