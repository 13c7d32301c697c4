// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdlib>
#include <memory>
#include <vector>

#include "recording/container.h"

namespace lvcalib::test {

/// Whatever the bytes: topics all of whose messages can be read to their last byte, or an input
/// error with a message.
inline void read_fuzzed(const Result<std::unique_ptr<Container>>& opened) {
  if (!opened) {
    if (opened.error().kind != ErrorKind::kInput || opened.error().message.empty()) abort();
    return;
  }
  const Container& container = **opened;
  const auto cursor = container.cursor(std::vector<char>(container.topics.size(), 1), {}, {});
  RecordedMessage message;
  std::size_t bytes = 0;
  while (true) {
    const auto more = cursor->next(message);
    if (!more) abort();
    if (!*more) break;
    if (message.topic >= container.topics.size()) abort();
    for (const char c : message.data) bytes += static_cast<unsigned char>(c);
  }
  static volatile std::size_t sink;
  sink = bytes;
  static_cast<void>(sink);
}

}  // namespace lvcalib::test
