// SPDX-License-Identifier: GPL-3.0-or-later
#include "progress_printer.h"

#include <algorithm>
#include <cstdio>

#include <sys/ioctl.h>
#include <unistd.h>

namespace lvcalib::cli {
namespace {

constexpr std::size_t kBarWidth = 24;
// Redrawing faster than the eye follows costs time and helps nobody.
constexpr std::chrono::milliseconds kRedraw{50};

std::size_t terminal_width() {
  winsize size{};
  return ::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80U;
}

}  // namespace

std::string printable(std::string text) {
  for (std::size_t k = 0; k < text.size(); ++k) {
    const auto c = static_cast<unsigned char>(text[k]);
    if (c == '\n' || c == '\r' || c == '\t') {
      text[k] = ' ';
    } else if (c < 0x20 || c == 0x7f) {
      text[k] = '?';
    } else if (c == 0xc2 && k + 1 < text.size() && static_cast<unsigned char>(text[k + 1]) < 0xa0) {
      // U+0080 to U+009F are control characters too, written in two bytes.
      text[k] = text[k + 1] = '?';
    }
  }
  return text;
}

ProgressPrinter::ProgressPrinter() : terminal_(::isatty(STDERR_FILENO) == 1) {}

ProgressPrinter::~ProgressPrinter() {
  finish();
}

void ProgressPrinter::show(const Progress& progress) {
  const std::lock_guard lock(mutex_);
  const bool new_stage = progress.stage != stage_;
  stage_ = progress.stage;
  if (!terminal_) {
    if (new_stage)
      std::fprintf(stderr, "%s: %s\n", stage_.c_str(), printable(progress.text.text()).c_str());
    return;
  }
  const auto now = std::chrono::steady_clock::now();
  if (!new_stage && bar_shown_ && now - last_ < kRedraw) return;
  last_ = now;
  const double fraction = std::clamp(progress.fraction, 0.0, 1.0);
  const auto filled = static_cast<std::size_t>(fraction * kBarWidth);
  std::string bar = "[" + std::string(filled, '#') + std::string(kBarWidth - filled, ' ') + "] " +
                    std::to_string(static_cast<int>(100 * fraction)) + " % " + stage_ + ": " +
                    printable(progress.text.text());
  // A line that wraps could not be redrawn in place.
  bar.resize(std::min(bar.size(), terminal_width() - 1));
  std::fprintf(stderr, "\r\033[K%s", bar.c_str());
  std::fflush(stderr);
  bar_shown_ = true;
}

void ProgressPrinter::line(const std::string& text) {
  const std::lock_guard lock(mutex_);
  clear_bar();
  std::fprintf(stderr, "%s\n", printable(text).c_str());
}

void ProgressPrinter::finish() {
  const std::lock_guard lock(mutex_);
  clear_bar();
}

void ProgressPrinter::clear_bar() {
  if (!bar_shown_) return;
  std::fputs("\r\033[K", stderr);
  std::fflush(stderr);
  bar_shown_ = false;
}

}  // namespace lvcalib::cli
