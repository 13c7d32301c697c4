// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/texture.h"

#include <algorithm>
#include <cmath>

#include "simulation/whole_below.h"

namespace lvcalib::simulation {
namespace {

// A number in [−1, 1) that depends on the lattice point only.
double lattice(int i, int j, std::uint32_t seed) {
  std::uint32_t x = static_cast<std::uint32_t>(i) * 0x8DA6B343U ^
                    static_cast<std::uint32_t>(j) * 0xD8163841U ^ seed * 0xCB1AB31FU;
  x = (x ^ (x >> 16U)) * 0x7FEB352DU;
  x = (x ^ (x >> 15U)) * 0x846CA68BU;
  x ^= x >> 16U;
  return static_cast<double>(x) / 2147483648.0 - 1.0;
}

double smooth_noise(double x, double y, std::uint32_t seed) {
  const int i = whole_below(x);
  const int j = whole_below(y);
  const double fx = x - i;
  const double fy = y - j;
  const double sx = fx * fx * (3.0 - 2.0 * fx);
  const double sy = fy * fy * (3.0 - 2.0 * fy);
  const double low = std::lerp(lattice(i, j, seed), lattice(i + 1, j, seed), sx);
  const double high = std::lerp(lattice(i, j + 1, seed), lattice(i + 1, j + 1, seed), sx);
  return std::lerp(low, high, sy);
}

}  // namespace

double Texture::at(double u_m, double v_m) const {
  const double x = u_m / scale_m;
  const double y = v_m / scale_m;
  double deviation = 0.0;
  switch (kind) {
    case Kind::kPlain:
      break;
    case Kind::kClouds:
      deviation = 0.65 * smooth_noise(x, y, seed) + 0.35 * smooth_noise(3.1 * x, 3.1 * y, seed + 1);
      break;
    case Kind::kBlocks:
      deviation = lattice(whole_below(x), whole_below(y), seed);
      break;
    case Kind::kStripes:
      deviation =
          0.7 * lattice(whole_below(x), 0, seed) + 0.3 * smooth_noise(6.0 * x, 0.5 * y, seed + 1);
      break;
  }
  return std::clamp(base + contrast * deviation, 0.03, 0.95);
}

}  // namespace lvcalib::simulation
