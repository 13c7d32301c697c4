// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <numbers>

namespace lvcalib {

inline constexpr double kMmPerM = 1e3;
inline constexpr double kRadPerDeg = std::numbers::pi / 180.0;
inline constexpr double kDegPerRad = 180.0 / std::numbers::pi;
/// Of points on a disk (Vogel's spiral): the angle that fills it most evenly.
inline constexpr double kGoldenAngleRad = 2.399963229728653;

}  // namespace lvcalib
