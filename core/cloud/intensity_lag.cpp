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

// What the intensities of such a pair differ by at every shift, over what those of two pairs do: a
// shift to places that are white all over makes neither alike.
std::vector<double> differences(const Cloud& cloud,
                                const std::vector<std::array<std::size_t, 2>>& pairs) {
  std::vector<double> within(2 * kMostLag + 1, 0.0);
  std::vector<double> between(within.size(), 0.0);
  for (std::size_t p = 0; p < pairs.size(); ++p) {
    const auto from = [&](std::size_t k) { return cloud.intensity.data() + k - kMostLag; };
    const float* first = from(pairs[p][0]);
    const float* second = from(pairs[p][1]);
    const float* other = from(pairs[(p + pairs.size() / 2) % pairs.size()][1]);
    // Absolute ones: a few reflectors are as bright as everything else together.
    for (std::size_t k = 0; k < within.size(); ++k) {
      within[k] += static_cast<double>(std::abs(first[k] - second[k]));
      between[k] += static_cast<double>(std::abs(first[k] - other[k]));
    }
  }
  for (std::size_t k = 0; k < within.size(); ++k)
    within[k] = between[k] > 0.0 ? within[k] / between[k] : 1.0;
  return within;
}

}  // namespace

std::vector<int> intensity_lags(const Cloud& cloud) {
  if (!cloud.has_contrast() || cloud.intensity.size() != cloud.size()) return {};
  const auto pairs = passed_twice(cloud);
  if (pairs.size() < 2) return {};
  std::vector<double> unlike = differences(cloud, pairs);
  // The right one, and those half a petal of a rosette before and after it, with one to spare.
  constexpr std::size_t kMost = 4;
  // Returns of one sweep across a print look alike at the next shifts, too.
  constexpr std::int64_t kOneSweep = 50;
  const double limit = 0.5 * unlike[kMostLag];
  std::vector<int> lags;
  while (lags.size() < kMost) {
    const auto best = std::min_element(unlike.begin(), unlike.end());
    if (!(*best < limit)) break;  // Nor where intensities are no numbers.
    const std::int64_t lag = best - unlike.begin() - kMostLag;
    lags.push_back(static_cast<int>(lag));
    for (std::int64_t near = std::max(lag - kOneSweep, -kMostLag);
         near <= std::min(lag + kOneSweep, kMostLag); ++near)
      unlike[static_cast<std::size_t>(near + kMostLag)] = limit;
  }
  return lags;
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
