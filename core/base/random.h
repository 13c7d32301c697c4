// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace lvcalib {

/// Seeded random numbers that are the same on every platform (the distributions of the standard
/// library are not). Generator: PCG-XSH-RR 64/32 (O'Neill 2014, HMC-CS-2014-0905).
class Random {
 public:
  explicit Random(std::uint64_t seed, std::uint64_t stream = 0);

  std::uint32_t bits();
  double uniform();                          ///< [0, 1)
  double uniform(double low, double high);   ///< [low, high)
  std::uint32_t below(std::uint32_t bound);  ///< 0 … bound−1
  double normal();                           ///< Standard normal (Box–Muller).
  double normal(double mean, double sigma) { return mean + sigma * normal(); }

 private:
  std::uint64_t state_ = 0;
  std::uint64_t increment_ = 1;
  double spare_ = 0.0;
  bool has_spare_ = false;
};

}  // namespace lvcalib
