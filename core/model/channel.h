// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>

#include "base/message.h"

namespace lvcalib {

/// Kinds of measurement that the model predicts.
enum class Channel { kCorner = 0, kRange = 1, kBoundary = 2, kIntensity = 3 };
constexpr std::size_t kChannels = 4;
constexpr std::array<Channel, kChannels> kAllChannels{Channel::kCorner, Channel::kRange,
                                                      Channel::kBoundary, Channel::kIntensity};

/// "corner", "range", "boundary", "intensity".
const char* name_of(Channel channel);
/// The same word within a sentence.
Message word_for(Channel channel);
/// Unit in which people read its residuals: "px", "mm", "mm", "1" (of the logarithm).
const char* unit_of(Channel channel);
/// From the internal unit (px, m, m, 1) to that one.
double display_factor(Channel channel);

}  // namespace lvcalib
