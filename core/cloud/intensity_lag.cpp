// SPDX-License-Identifier: BSD-3-Clause
#include "cloud/intensity_lag.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <utility>

namespace lvcalib {
namespace {

// A packet of any scanner holds fewer returns.
constexpr std::int64_t kMostLag = 1000;
// Returns so near each other are of one surface, mostly of one part of a print.
constexpr float kNear_m = 0.02F;
// The mean of so many differences is known to a hundredth of what they scatter.
constexpr std::size_t kMostPairs = 10'000;

// Points near each other in space and so far apart in the order of the scan that no shift brings
// the intensity of one to the other.
std::vector<std::array<std::size_t, 2>> passed_twice(const Cloud& cloud) {
  std::vector<std::array<std::size_t, 2>> pairs;
  std::unordered_map<std::uint64_t, std::size_t> last;
  const auto lag = static_cast<std::size_t>(kMostLag);
  for (std::size_t k = lag; k + lag < cloud.size() && pairs.size() < kMostPairs; ++k) {
    std::uint64_t key = 0;
    bool finite = true;
    for (int axis = 0; axis < 3; ++axis) {
      const float cell = std::floor(cloud.points_m[k][axis] / kNear_m);
      constexpr float kLimit = 1 << 20;  // Three numbers of 21 bits, 20 km either way.
      finite = finite && std::abs(cell) < kLimit;
      key = (key << 21U) | static_cast<std::uint64_t>(finite ? cell + kLimit : 0.0F);
    }
    if (!finite) continue;
    const auto [place, fresh] = last.try_emplace(key, k);
    if (fresh || k - place->second <= 2 * lag) continue;
    pairs.push_back({place->second, k});
    place->second = k;
  }
  return pairs;
}

}  // namespace

int intensity_lag(const Cloud& cloud) {
  if (!cloud.has_contrast() || cloud.intensity.size() != cloud.size()) return 0;
  const auto pairs = passed_twice(cloud);
  if (pairs.empty()) return 0;
  // Absolute differences: a few reflectors are as bright as everything else together.
  std::vector<double> unlike(2 * kMostLag + 1, 0.0);
  for (const auto& [first, second] : pairs) {
    const float* a = cloud.intensity.data() + first - kMostLag;
    const float* b = cloud.intensity.data() + second - kMostLag;
    for (std::size_t k = 0; k < unlike.size(); ++k)
      unlike[k] += static_cast<double>(std::abs(a[k] - b[k]));
  }
  const auto best = std::min_element(unlike.begin(), unlike.end());
  // Also where an intensity is no number: nothing is less than that.
  if (!(*best < unlike[kMostLag])) return 0;
  return static_cast<int>(best - unlike.begin() - kMostLag);
}

Cloud without_intensity_lag(Cloud cloud, int lag) {
  if (cloud.intensity.empty()) return cloud;
  const std::vector<float> as_read = cloud.intensity;
  const auto last = static_cast<std::int64_t>(as_read.size()) - 1;
  for (std::int64_t k = 0; k <= last; ++k) {
    cloud.intensity[static_cast<std::size_t>(k)] =
        as_read[static_cast<std::size_t>(std::clamp<std::int64_t>(k + lag, 0, last))];
  }
  return cloud;
}

}  // namespace lvcalib
