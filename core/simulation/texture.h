// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace lvcalib::simulation {

/// Reflectivity of a surface as a function of the position on it.
struct Texture {
  enum class Kind {
    kPlain,
    kClouds,   ///< Smooth noise in two octaves, like stained plaster.
    kBlocks,   ///< Random squares, a print that is no target.
    kStripes,  ///< Planks of random tone with a faint grain.
  };
  Kind kind = Kind::kPlain;
  double base = 0.5;      ///< Mean reflectivity.
  double contrast = 0.0;  ///< Largest deviation from the mean.
  double scale_m = 0.3;   ///< Size of the features.
  std::uint32_t seed = 0;

  /// Reflectivity in 0.03 … 0.95 at (u, v) in metres.
  [[nodiscard]] double at(double u_m, double v_m) const;
};

}  // namespace lvcalib::simulation
