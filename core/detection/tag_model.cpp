// SPDX-License-Identifier: BSD-3-Clause
#include "detection/tag_model.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>
#include <Eigen/LU>

namespace lvcalib {
namespace {

// Lets black grow in what is seen of the print; returns the value's derivative by the growth.
// What it does to a slope's dependence on the blur is that of one straight edge: the slope
// m = φ(x/s)/s has ∂m/∂s² = (x²/s² − 1)·m/(2s²), and x/s = −s·m'/m.
double grow(double growth, const TagBlur& blur, TagSample& sample) {
  // A slope of less than this of the contrast over half the tag is no edge: the largest growth
  // makes a thousandth of the contrast of it, less than a grey level.
  constexpr double kNoEdge = 0.01;
  const auto sign = [](double slope) {
    return std::abs(slope) > kNoEdge ? std::copysign(1.0, slope) : 0.0;
  };
  const auto by_variance = [](double slope, double curvature, double variance) {
    const double z2 = curvature * curvature * variance / (slope * slope);
    return (z2 - 1.0) * slope / (2.0 * variance);
  };
  const double su = sign(sample.by_u);
  const double sv = sign(sample.by_v);
  const double uu = 2.0 * sample.by_uu;
  const double vv = 2.0 * sample.by_vv;
  // Of a corner, what both edges sweep beyond it: a square, but a quarter of a disc where the
  // growing colour's own corner turns round. There the mixed term has the growth's opposite sign.
  constexpr double kRound = 0.25 * std::numbers::pi;
  const double mixed = su * sv * sample.by_uv;
  const double curvature =
      su * su * uu + 2.0 * (mixed * growth < 0.0 ? kRound : 1.0) * mixed + sv * sv * vv;
  if (su != 0.0) sample.by_uu -= growth * su * by_variance(sample.by_u, uu, blur.uu);
  if (sv != 0.0) sample.by_vv -= growth * sv * by_variance(sample.by_v, vv, blur.vv);
  sample.value += growth * (0.5 * growth * curvature - sample.edges);
  sample.by_u -= growth * sample.edges_by_u;
  sample.by_v -= growth * sample.edges_by_v;
  return growth * curvature - sample.edges;
}

}  // namespace

Eigen::Matrix3d plane_from_tag_corners(const std::array<Eigen::Vector2d, 4>& points) {
  Eigen::Matrix<double, 8, 8> a;
  Eigen::Matrix<double, 8, 1> b;
  for (int i = 0; i < 4; ++i) {
    const Eigen::Vector2d& t = kTagCorners[static_cast<std::size_t>(i)];
    const Eigen::Vector2d& p = points[static_cast<std::size_t>(i)];
    a.row(2 * i) << t.x(), t.y(), 1, 0, 0, 0, -p.x() * t.x(), -p.x() * t.y();
    a.row(2 * i + 1) << 0, 0, 0, t.x(), t.y(), 1, -p.y() * t.x(), -p.y() * t.y();
    b.segment<2>(2 * i) = p;
  }
  const Eigen::Matrix<double, 8, 1> h = a.partialPivLu().solve(b);
  Eigen::Matrix3d out;
  out << h[0], h[1], h[2], h[3], h[4], h[5], h[6], h[7], 1.0;
  return out;
}

Eigen::Vector2d TagModel::tag_point(const Eigen::Vector2d& plane) const {
  return (tag_from_plane * plane.homogeneous()).hnormalized();
}

Eigen::Vector2d TagModel::plane_point(const Eigen::Vector2d& tag) const {
  return (tag_from_plane.inverse() * tag.homogeneous()).hnormalized();
}

std::array<Eigen::Vector2d, 4> TagModel::plane_corners() const {
  std::array<Eigen::Vector2d, 4> out;
  std::transform(kTagCorners.begin(), kTagCorners.end(), out.begin(),
                 [&](const Eigen::Vector2d& corner) { return plane_point(corner); });
  return out;
}

Eigen::Matrix2d TagModel::tag_by_plane(const Eigen::Vector2d& plane) const {
  const Eigen::Matrix3d& h = tag_from_plane;
  const Eigen::Vector3d q = h * plane.homogeneous();
  const Eigen::Vector2d t = q.head<2>() / q.z();
  return (h.topLeftCorner<2, 2>() - t * h.block<1, 2>(2, 0)) / q.z();
}

Eigen::Matrix<double, 2, 8> TagModel::tag_by_homography_step(const Eigen::Vector2d& tag) {
  const double u = tag.x();
  const double v = tag.y();
  Eigen::Matrix<double, 2, 8> out;
  out << u, v, 1, 0, 0, 0, -u * u, -u * v, 0, 0, 0, u, v, 1, -u * v, -v * v;
  return out;
}

double TagModel::gray(const BlurredTag& tag, const Eigen::Matrix2d& plane_by_pixel,
                      const Eigen::Vector2d& plane, Vector* by_step) const {
  const Eigen::Vector2d t = tag_point(plane);
  const double u = t.x();
  const double v = t.y();
  const Eigen::Matrix2d by_pixel = tag_by_plane(plane) * plane_by_pixel;
  const double g_uu = by_pixel.row(0).squaredNorm();
  const double g_uv = by_pixel.row(0).dot(by_pixel.row(1));
  const double g_vv = by_pixel.row(1).squaredNorm();
  const double s2 = blur_px * blur_px;
  const TagBlur blur{s2 * g_uu, s2 * g_uv, s2 * g_vv};
  TagSample sample = tag.sample(u, v, blur);
  const double by_growth = grow(growth, blur, sample);
  const double bump = sample.value * (1.0 - sample.value);
  const double response = sample.value + curve * bump;
  const double white_minus_black = contrast[0] + contrast[1] * u + contrast[2] * v;
  if (by_step != nullptr) {
    const double gain = white_minus_black * (1.0 + curve * (1.0 - 2.0 * sample.value));
    const double by_u = gain * sample.by_u + black[1] + contrast[1] * response;
    const double by_v = gain * sample.by_v + black[2] + contrast[2] * response;
    const double radial = by_u * u + by_v * v;
    const double by_blur =
        gain * 2.0 * blur_px * (g_uu * sample.by_uu + g_uv * sample.by_uv + g_vv * sample.by_vv);
    *by_step << by_u * u, by_u * v, by_u, by_v * u, by_v * v, by_v, -radial * u, -radial * v,
        by_blur, white_minus_black * bump, 1.0, u, v, response, response * u, response * v,
        gain * by_growth;
  }
  return black[0] + black[1] * u + black[2] * v + white_minus_black * response;
}

TagModel TagModel::moved(const Vector& step) const {
  TagModel out = *this;
  Eigen::Matrix3d change = Eigen::Matrix3d::Identity();
  change.row(0) += step.segment<3>(0).transpose();
  change.row(1) += step.segment<3>(3).transpose();
  change(2, 0) += step[6];
  change(2, 1) += step[7];
  out.tag_from_plane = change * tag_from_plane;
  out.tag_from_plane /= out.tag_from_plane(2, 2);
  // The area of a pixel alone blurs by √(1/12).
  out.blur_px = std::clamp(blur_px + step[kBlur], 0.29, 10.0);
  out.curve = std::clamp(curve + step[kCurve], -0.95, 0.95);
  // A twentieth of the tag is far more than any ink spreads.
  out.growth = std::clamp(growth + step[kGrowth], -0.1, 0.1);
  out.black += step.segment<3>(kBlack);
  out.contrast += step.segment<3>(kContrast);
  return out;
}

}  // namespace lvcalib
