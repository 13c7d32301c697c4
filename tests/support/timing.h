// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdlib>

namespace lvcalib::test {

/// Whether marks of time are asserted as they are: by night, with nothing else running.
inline bool timings_count() {
  return std::getenv("LVCALIB_TIMINGS") != nullptr;
}

/// A limit for a time that the machine's other work may stretch: the mark itself where
/// LVCALIB_TIMINGS is set (by night, with nothing else running); else thirty times as much, so that
/// only what hangs fails.
template <class Number>
Number time_limit(Number mark) {
  return timings_count() ? mark : 30 * mark;
}

}  // namespace lvcalib::test
