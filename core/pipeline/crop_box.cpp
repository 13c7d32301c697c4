// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/crop_box.h"

#include <cmath>

namespace lvcalib {

bool CropBox::contains(const Eigen::Vector3d& point_m) const {
  const Eigen::Vector3d p = rotation.conjugate() * (point_m - center_m);
  return (p.array().abs() <= half_size_m.array()).all();
}

bool CropBox::operator==(const CropBox& other) const {
  return center_m == other.center_m && half_size_m == other.half_size_m &&
         rotation.coeffs() == other.rotation.coeffs();
}

Status check(const CropBox& box) {
  if (!box.center_m.allFinite() || !box.half_size_m.allFinite() ||
      !box.rotation.coeffs().allFinite()) {
    return Error::usage(Message("a number of the crop box is not finite"));
  }
  if (!(box.half_size_m.array() > 0.0).all()) {
    return Error::usage(Message("the crop box has no volume"), {},
                        Message("give every side a length above zero"));
  }
  if (std::abs(box.rotation.norm() - 1.0) > 1e-3) {
    return Error::usage(Message("the rotation of the crop box is not a unit quaternion"));
  }
  return Done{};
}

Cloud crop(const Cloud& cloud, const CropBox& box) {
  Cloud out;
  out.warnings = cloud.warnings;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (!box.contains(cloud.points_m[i].cast<double>())) continue;
    out.points_m.push_back(cloud.points_m[i]);
    if (cloud.has_intensity()) out.intensity.push_back(cloud.intensity[i]);
    if (cloud.has_time()) out.time_s.push_back(cloud.time_s[i]);
    if (cloud.has_line()) out.line.push_back(cloud.line[i]);
  }
  return out;
}

}  // namespace lvcalib
