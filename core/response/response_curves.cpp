// SPDX-License-Identifier: BSD-3-Clause
#include "response/response_curves.h"

#include <cmath>
#include <limits>
#include <map>

namespace lvcalib {
namespace {

// Sums about the first value, so that equal large values leave no variance.
struct Sums {
  double first = 0.0;
  double sum = 0.0;
  double squares = 0.0;
  int n = 0;
  void add(double value) {
    if (n++ == 0) first = value;
    sum += value - first;
    squares += (value - first) * (value - first);
  }
};

TransitionBin bin_of(double distance_m, const Sums& sums) {
  const double n = sums.n;
  TransitionBin bin;
  bin.distance_m = distance_m;
  bin.n = sums.n;
  bin.mean = sums.first + sums.sum / n;
  const double variance = (sums.squares - sums.sum * sums.sum / n) / (n - 1.0);
  bin.mean_sigma = sums.n > 1 ? std::sqrt(std::max(0.0, variance) / n)
                              : std::numeric_limits<double>::quiet_NaN();
  return bin;
}

}  // namespace

std::vector<TransitionBin> transition_curve(const SceneResponse& scene, double width_m) {
  std::map<int, Sums> classes;
  for (const BoundarySample& s : scene.samples) {
    if (scene.nodes[static_cast<std::size_t>(s.node)].state != NodeResponseState::kUsed) continue;
    const double at = std::floor(static_cast<double>(s.distance_m) / width_m);
    classes[static_cast<int>(at)].add(static_cast<double>(s.intensity));
  }
  std::vector<TransitionBin> out;
  for (const auto& [at, sums] : classes) out.push_back(bin_of((at + 0.5) * width_m, sums));
  return out;
}

std::vector<RangeBin> range_histogram(std::span<const SceneResponse* const> scenes,
                                      double width_m) {
  std::map<int, int> classes;
  for (const SceneResponse* scene : scenes) {
    for (const BoundarySample& s : scene->samples) {
      if (!s.overlap) continue;
      ++classes[static_cast<int>(std::floor(static_cast<double>(s.range_residual_m) / width_m))];
    }
  }
  std::vector<RangeBin> out;
  for (const auto& [at, n] : classes) out.push_back({at * width_m, n});
  return out;
}

}  // namespace lvcalib
