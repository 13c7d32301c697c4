// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "base/random.h"

namespace lvcalib::simulation {

/// What a stream of random numbers is for. One stream per scene and purpose, so that neither the
/// order of scenes nor the number of threads nor a change in one part moves another.
enum class Purpose : std::uint64_t {
  kCamera,
  kMount,
  kPlacement,
  kRoom,
  kScan,
  kBeam,
  kImage,
  kEffect
};

/// SplitMix64 (Steele, Lea, Flood 2014): spreads neighbouring numbers over all 64 bits.
inline std::uint64_t spread(std::uint64_t x) {
  x += 0x9E3779B97F4A7C15ULL;
  x = (x ^ (x >> 30U)) * 0xBF58476D1CE4E5B9ULL;
  x = (x ^ (x >> 27U)) * 0x94D049BB133111EBULL;
  return x ^ (x >> 31U);
}

/// The generator of a purpose in a scene; scene −1 stands for the rig itself.
inline Random random_for(std::uint64_t seed, int scene, Purpose purpose) {
  const auto scene_key = static_cast<std::uint64_t>(scene + 1);
  const std::uint64_t key = spread(spread(seed) ^ (scene_key << 8U));
  const std::uint64_t stream = spread(key ^ static_cast<std::uint64_t>(purpose));
  return Random(stream, spread(stream));
}

}  // namespace lvcalib::simulation
