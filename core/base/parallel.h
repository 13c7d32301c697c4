// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>

namespace lvcalib {

/// Calls work(i) for i = 0 … count−1 from up to `threads` threads; returns when all are done.
/// Indices are handed out one by one, so uneven work balances. The first exception is rethrown.
void parallel_for(std::size_t count, int threads, const std::function<void(std::size_t)>& work);

/// Calls first(i) and, after it, second(i) for i = 0 … count−1: all first ones are handed out
/// before the second ones, so that with few items all threads stay busy to the end. Where first(i)
/// throws, second(i) is not called. The first exception is rethrown.
void parallel_two_steps(std::size_t count, int threads,
                        const std::function<void(std::size_t)>& first,
                        const std::function<void(std::size_t)>& second);

}  // namespace lvcalib
