// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/child_process.h"

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <fstream>
#include <sstream>
#include <string_view>
#include <thread>

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

namespace lvcalib::testing {
namespace {

using Clock = std::chrono::steady_clock;
constexpr unsigned kNobody = 65534;

// A file that is gone once it is closed.
class Capture {
 public:
  Capture() : file_(std::tmpfile()) {}
  Capture(const Capture&) = delete;
  Capture& operator=(const Capture&) = delete;
  ~Capture() {
    if (file_ != nullptr) std::fclose(file_);
  }
  [[nodiscard]] int descriptor() const { return ::fileno(file_); }
  [[nodiscard]] std::string content() const {
    std::string text;
    char buffer[4096];
    std::rewind(file_);
    for (std::size_t n = 0; (n = std::fread(buffer, 1, sizeof buffer, file_)) > 0;) {
      text.append(buffer, n);
    }
    return text;
  }

 private:
  std::FILE* file_;
};

// Waits without blocking for ever; true if the child has ended.
bool ended(pid_t child, int& status, Clock::time_point limit) {
  for (;;) {
    const pid_t found = ::waitpid(child, &status, WNOHANG);
    if (found == child) return true;
    if (found < 0 && errno != EINTR) return false;
    if (Clock::now() >= limit) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

// True if the process blocks the signal, which every program does that takes it by sigwait(); the
// kernel's table of processes says so.
bool blocks(pid_t child, int signal) {
  constexpr std::string_view kKey = "SigBlk:";
  std::ifstream table("/proc/" + std::to_string(child) + "/status");
  for (std::string line; std::getline(table, line);) {
    if (line.starts_with(kKey)) {
      return (std::stoull(line.substr(kKey.size()), nullptr, 16) >> (signal - 1) & 1U) != 0;
    }
  }
  return false;
}

[[noreturn]] void become_lvcalib(char** argv, const RunSettings& settings, int out, int err) {
  if (::chdir(settings.folder.c_str()) != 0) ::_exit(99);
  ::dup2(out, STDOUT_FILENO);
  ::dup2(err, STDERR_FILENO);
  if (!settings.print_to.empty()) {
    const int file = ::open(settings.print_to.c_str(), O_WRONLY);
    if (file < 0 || ::dup2(file, STDOUT_FILENO) < 0) ::_exit(96);
  }
  if (settings.unprivileged && ::geteuid() == 0 &&
      (::setgid(kNobody) != 0 || ::setuid(kNobody) != 0)) {
    ::_exit(97);
  }
  ::execv(argv[0], argv);
  ::_exit(98);
}

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

}  // namespace

Outcome run_lvcalib(std::vector<std::string> arguments, const RunSettings& settings) {
  arguments.insert(arguments.begin(), LVCALIB_BINARY);
  std::vector<char*> argv;
  for (std::string& argument : arguments) argv.push_back(argument.data());
  argv.push_back(nullptr);
  const Capture out;
  const Capture err;
  auto start = Clock::now();
  const pid_t child = ::fork();
  if (child == 0) become_lvcalib(argv.data(), settings, out.descriptor(), err.descriptor());

  Outcome outcome;
  int status = 0;
  bool done = false;
  if (settings.signal != 0) {
    while (settings.once_listening && !done && !blocks(child, settings.signal) &&
           Clock::now() < start + settings.limit) {
      done = ended(child, status, Clock::now() + std::chrono::milliseconds(1));
    }
    if (settings.once_listening) start = Clock::now();
    done = done || ended(child, status, start + settings.signal_after);
    start = Clock::now();
    if (!done) ::kill(child, settings.signal);
  }
  if (!done && !ended(child, status, start + settings.limit)) {
    outcome.timed_out = true;
    ::kill(child, SIGKILL);
    ::waitpid(child, &status, 0);
  }
  outcome.seconds = seconds_since(start);
  outcome.status = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  outcome.out = out.content();
  outcome.err = err.content();
  return outcome;
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

std::vector<std::string> lines_with(const std::string& text, const std::string& prefix) {
  std::vector<std::string> lines;
  for (const std::string& line : lines_of(text)) {
    if (line.starts_with(prefix)) lines.push_back(line);
  }
  return lines;
}

void expect_refusal(const Outcome& outcome, int status, const std::string& what,
                    const std::filesystem::path& output) {
  EXPECT_EQ(outcome.status, status) << outcome.err;
  EXPECT_EQ(lines_with(outcome.err, "lvcalib: error: ").size(), 1U) << outcome.err;
  EXPECT_THAT(outcome.err, ::testing::HasSubstr(what));
  EXPECT_EQ(outcome.out, "");
  EXPECT_FALSE(std::filesystem::exists(output));
}

}  // namespace lvcalib::testing
