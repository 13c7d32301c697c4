// SPDX-License-Identifier: GPL-3.0-or-later
#include "interrupt.h"

#include <csignal>
#include <cstring>
#include <ctime>

#include <pthread.h>
#include <unistd.h>

namespace lvcalib::cli {
namespace {

constexpr int kInterrupted = 130;
// Commands stop within 0.2 s; a little is left for the system to end the process.
constexpr timespec kGrace{0, 170'000'000};

// The signals waited for; SIGUSR1 ends the watch itself.
sigset_t watched_signals() {
  sigset_t set;
  sigemptyset(&set);
  sigaddset(&set, SIGINT);
  sigaddset(&set, SIGTERM);
  sigaddset(&set, SIGUSR1);
  return set;
}

}  // namespace

InterruptWatch::InterruptWatch() {
  const sigset_t set = watched_signals();
  pthread_sigmask(SIG_BLOCK, &set, nullptr);
  // A reader that closes our pipe early must not kill us in the middle of writing results.
  std::signal(SIGPIPE, SIG_IGN);
  thread_ = std::jthread([this] { watch(); });
}

InterruptWatch::~InterruptWatch() {
  done_ = true;
  pthread_kill(thread_.native_handle(), SIGUSR1);
}

void InterruptWatch::watch() {
  const sigset_t set = watched_signals();
  int signal = 0;
  // SIGUSR1 counts only from the destructor; anyone may send it.
  do {
    if (sigwait(&set, &signal) != 0 || done_) return;
  } while (signal == SIGUSR1);
  source_.request_stop();
  sigtimedwait(&set, nullptr, &kGrace);
  if (done_) return;
  const char message[] = "\nlvcalib: error: stopped by the user\n";
  // The result does not matter: the process ends either way.
  [[maybe_unused]] const ssize_t ignored = ::write(STDERR_FILENO, message, std::strlen(message));
  ::_exit(kInterrupted);
}

}  // namespace lvcalib::cli
