// SPDX-License-Identifier: BSD-3-Clause
#include "model/channel.h"

namespace lvcalib {
namespace {

constexpr std::array<const char*, kChannels> kNames{"corner", "range", "boundary", "intensity"};
constexpr std::array<const char*, kChannels> kUnits{"px", "mm", "mm", "1"};
constexpr std::array<double, kChannels> kFactors{1.0, 1e3, 1e3, 1.0};

}  // namespace

const char* name_of(Channel channel) {
  return kNames[static_cast<std::size_t>(channel)];
}

Message word_for(Channel channel) {
  switch (channel) {
    case Channel::kCorner:
      return Message("corner");
    case Channel::kRange:
      return Message("range");
    case Channel::kBoundary:
      return Message("boundary");
    case Channel::kIntensity:
      break;
  }
  return Message("intensity");
}

const char* unit_of(Channel channel) {
  return kUnits[static_cast<std::size_t>(channel)];
}

double display_factor(Channel channel) {
  return kFactors[static_cast<std::size_t>(channel)];
}

}  // namespace lvcalib
