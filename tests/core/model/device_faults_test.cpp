// SPDX-License-Identifier: GPL-3.0-or-later
#include "model/device_faults.h"

#include <cmath>
#include <map>

#include <gtest/gtest.h>

namespace lvcalib {
namespace {

TEST(DeviceFaults, EachIsStatedByOneParameterOfTheCatalogue) {
  std::map<DeviceFault, int> stated;
  for (const EffectPtr& effect : effect_catalogue()) {
    for (const EffectParameter& parameter : effect->parameters({})) {
      if (parameter.device_fault) ++stated[*parameter.device_fault];
    }
  }
  for (int k = 0; k < kDeviceFaults; ++k) EXPECT_EQ(stated[static_cast<DeviceFault>(k)], 1) << k;
}

TEST(DeviceFaults, OfRangesAnglesAndOriginStandTogether) {
  const FaultKind expected[] = {FaultKind::kRange, FaultKind::kRange,  FaultKind::kAngle,
                                FaultKind::kAngle, FaultKind::kAngle,  FaultKind::kAngle,
                                FaultKind::kAngle, FaultKind::kOrigin, FaultKind::kOrigin};
  for (int k = 0; k < kDeviceFaults; ++k)
    EXPECT_EQ(kind_of(static_cast<DeviceFault>(k)), expected[k]) << k;
}

struct Polar {
  double range, azimuth, elevation;
  [[nodiscard]] Eigen::Vector3d point() const {
    return range * Eigen::Vector3d(std::cos(elevation) * std::cos(azimuth),
                                   std::cos(elevation) * std::sin(azimuth), std::sin(elevation));
  }
};

// What the device reads instead of p with a fault of size s; written as the errors are defined.
Polar with_fault(DeviceFault fault, Polar p, double s) {
  switch (fault) {
    case DeviceFault::kRangeOffset:
      p.range += s;
      break;
    case DeviceFault::kRangeScale:
      p.range *= 1.0 + s;
      break;
    case DeviceFault::kAzimuthScale:
      p.azimuth *= 1.0 + s;
      break;
    case DeviceFault::kElevationScale:
      p.elevation *= 1.0 + s;
      break;
    case DeviceFault::kEccentricitySine:
      p.azimuth += s * std::sin(p.azimuth);
      break;
    case DeviceFault::kEccentricityCosine:
      p.azimuth += s * std::cos(p.azimuth);
      break;
    case DeviceFault::kAxisTilt:
      p.azimuth += s * std::tan(p.elevation);
      break;
    case DeviceFault::kOriginAcross:
      p.azimuth += s / (p.range * std::cos(p.elevation));
      break;
    case DeviceFault::kOriginUp:
      p.elevation += s / p.range;
      break;
  }
  return p;
}

TEST(DeviceFaults, MoveAPointAsTheReadingsTheyFalsifyDo) {
  const DeviceFaults faults;
  for (const Polar& p : {Polar{3.0, 0.3, -0.2}, Polar{1.7, -0.8, 0.25}, Polar{5.0, 2.0, 0.05}}) {
    const FaultMoves moves = faults.moves(p.point());
    for (int k = 0; k < kDeviceFaults; ++k) {
      constexpr double kStep = 1e-6;
      const auto fault = static_cast<DeviceFault>(k);
      const Eigen::Vector3d expected =
          (with_fault(fault, p, kStep).point() - with_fault(fault, p, -kStep).point()) /
          (2.0 * kStep);
      EXPECT_LT((moves.col(k) - expected).norm(), 1e-8) << k;
    }
  }
}

}  // namespace
}  // namespace lvcalib
