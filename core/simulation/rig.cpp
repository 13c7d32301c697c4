// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/rig.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lvcalib::simulation {
namespace {

double rounded(double value, double step) {
  return std::round(value / step) * step;
}

void plumb_bob(Camera& camera, Random& random) {
  camera.distortion << random.uniform(-0.12, -0.04), random.uniform(0.01, 0.05),
      random.normal(0.0, 3e-4), random.normal(0.0, 3e-4), 0, 0, 0, 0;
}

// A plumb-bob lens written as a quotient: numerator and denominator nearly cancel.
void rational(Camera& camera, Random& random) {
  const double k4 = random.uniform(0.1, 0.4);
  const double k5 = random.uniform(0.0, 0.05);
  camera.distortion << k4 + random.uniform(-0.12, -0.04), k5 + random.uniform(0.01, 0.05),
      random.normal(0.0, 3e-4), random.normal(0.0, 3e-4), random.uniform(0.0, 0.005), k4, k5,
      random.uniform(0.0, 0.003);
}

void equidistant(Camera& camera, Random& random) {
  camera.distortion << random.uniform(-0.03, 0.03), random.uniform(-0.01, 0.01),
      random.uniform(-0.004, 0.004), random.uniform(-0.001, 0.001), 0, 0, 0, 0;
}

}  // namespace

Camera random_camera(const ImageOptions& options, Random random) {
  Camera camera;
  camera.name = "camera";
  camera.width_px = options.width_px;
  camera.height_px = options.height_px;
  camera.model = options.distortion;
  const double size = options.width_px / 1440.0;
  const bool fisheye = options.distortion == DistortionModel::kEquidistant;
  const double focal = size * (fisheye ? random.uniform(740.0, 820.0) : random.uniform(980, 1100));
  camera.fx = rounded(focal, 0.001);
  camera.fy = rounded(focal * random.uniform(0.998, 1.002), 0.001);
  camera.cx = rounded(0.5 * (options.width_px - 1) + size * random.uniform(-20, 20), 0.001);
  camera.cy = rounded(0.5 * (options.height_px - 1) + size * random.uniform(-15, 15), 0.001);
  switch (options.distortion) {
    case DistortionModel::kPlumbBob:
      plumb_bob(camera, random);
      break;
    case DistortionModel::kRationalPolynomial:
      rational(camera, random);
      break;
    case DistortionModel::kEquidistant:
      equidistant(camera, random);
      break;
  }
  for (double& coefficient : camera.distortion) coefficient = rounded(coefficient, 1e-6);
  return camera;
}

Rigid3 random_mount(Random random) {
  Eigen::Matrix3d swap;
  swap << 0, -1, 0, 0, 0, -1, 1, 0, 0;
  const double degree = std::numbers::pi / 180.0;
  Eigen::Vector3d turn;
  for (double& angle : turn) angle = degree * std::clamp(random.normal(0.0, 4.0), -8.0, 8.0);
  Eigen::Vector3d shift;
  do {
    for (double& part : shift) part = random.uniform(-0.25, 0.25);
  } while (shift.norm() > 0.28);
  for (double& part : shift) part = rounded(part, 1e-4);
  return {(so3_exp(turn) * Eigen::Quaterniond(swap)).normalized(), shift};
}

}  // namespace lvcalib::simulation
