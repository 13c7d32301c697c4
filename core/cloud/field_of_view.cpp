// SPDX-License-Identifier: BSD-3-Clause
#include "cloud/field_of_view.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>

#include "base/symmetric.h"

namespace lvcalib {
namespace {

using Directions = std::vector<Eigen::Vector3d>;

constexpr int kSectors = 48;  // About the middle of the view: some returns fall into each.
constexpr int kEdges = 4;     // As a pyramid has: more lines would hide what is inside.

// A sample of the points' directions.
Directions directions_of(const Cloud& cloud) {
  constexpr std::size_t kMost = 50'000;
  const std::size_t step = 1 + cloud.size() / kMost;
  Directions out;
  for (std::size_t i = 0; i < cloud.size(); i += step) {
    const Eigen::Vector3d p = cloud.points_m[i].cast<double>();
    if (p.allFinite() && p.norm() > 0.0) out.push_back(p.normalized());
  }
  return out;
}

// The direction at an angle from an axis, turned about it.
struct Polar {
  explicit Polar(const Eigen::Vector3d& about) : axis(about.normalized()) {
    side = axis.unitOrthogonal();
    other = axis.cross(side);
  }
  [[nodiscard]] Eigen::Vector3d at(double from_axis_rad, double turn_rad) const {
    return std::cos(from_axis_rad) * axis +
           std::sin(from_axis_rad) * (std::cos(turn_rad) * side + std::sin(turn_rad) * other);
  }
  [[nodiscard]] double from_axis_rad(const Eigen::Vector3d& direction) const {
    return std::acos(std::clamp(axis.dot(direction), -1.0, 1.0));
  }
  [[nodiscard]] double turn_rad(const Eigen::Vector3d& direction) const {
    const double turn = std::atan2(other.dot(direction), side.dot(direction));
    return turn < 0.0 ? turn + 2.0 * std::numbers::pi : turn;
  }
  Eigen::Vector3d axis, side, other;
};

void add_border(FieldOfView& view, const Directions& border) {
  const std::size_t step = std::max<std::size_t>(1, border.size() / kEdges);
  for (std::size_t k = 0; k < border.size(); k += step) view.edges.push_back(border[k]);
  view.outlines.push_back(border);
}

// Around the middle, as far out as there are returns.
FieldOfView about_middle(const Directions& directions, const Polar& polar) {
  std::vector<const Eigen::Vector3d*> outermost(kSectors, nullptr);
  for (const Eigen::Vector3d& d : directions) {
    const auto sector = std::min(
        kSectors - 1, static_cast<int>(polar.turn_rad(d) / (2.0 * std::numbers::pi) * kSectors));
    const Eigen::Vector3d*& most = outermost[static_cast<std::size_t>(sector)];
    if (most == nullptr || polar.axis.dot(d) < polar.axis.dot(*most)) most = &d;
  }
  Directions border;
  for (const Eigen::Vector3d* d : outermost) {
    if (d != nullptr) border.push_back(*d);
  }
  FieldOfView view;
  add_border(view, border);
  return view;
}

// Between two circles about the axis that the scanner turns about: directions spread least along
// it.
FieldOfView all_around(const Directions& directions) {
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (const Eigen::Vector3d& d : directions) spread += d * d.transpose();
  const Polar polar(axes_of(spread).vectors.col(0));
  double low = std::numbers::pi;
  double high = 0.0;
  for (const Eigen::Vector3d& d : directions) {
    low = std::min(low, polar.from_axis_rad(d));
    high = std::max(high, polar.from_axis_rad(d));
  }
  FieldOfView view;
  for (const double angle : {low, high}) {
    Directions border;
    for (int k = 0; k < kSectors; ++k)
      border.push_back(polar.at(angle, 2.0 * std::numbers::pi * k / kSectors));
    add_border(view, border);
  }
  return view;
}

}  // namespace

FieldOfView field_of_view(const Cloud& cloud) {
  const Directions directions = directions_of(cloud);
  if (directions.empty()) return {};
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& d : directions) sum += d;
  const bool behind = std::any_of(directions.begin(), directions.end(),
                                  [&](const Eigen::Vector3d& d) { return d.dot(sum) <= 0.0; });
  return behind ? all_around(directions) : about_middle(directions, Polar(sum));
}

}  // namespace lvcalib
