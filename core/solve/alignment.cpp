// SPDX-License-Identifier: BSD-3-Clause
#include "solve/alignment.h"

#include <Eigen/SVD>

namespace lvcalib {

Rigid3 align_points(const std::vector<PointPair>& pairs) {
  double weight = 0.0;
  Eigen::Vector3d target = Eigen::Vector3d::Zero();
  Eigen::Vector3d source = Eigen::Vector3d::Zero();
  for (const PointPair& pair : pairs) {
    weight += pair.weight;
    target += pair.weight * pair.target_m;
    source += pair.weight * pair.source_m;
  }
  if (!(weight > 0.0)) return {};
  target /= weight;
  source /= weight;
  Eigen::Matrix3d cross = Eigen::Matrix3d::Zero();
  for (const PointPair& pair : pairs) {
    cross += pair.weight * (pair.target_m - target) * (pair.source_m - source).transpose();
  }
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(cross, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Matrix3d sign = Eigen::Matrix3d::Identity();
  if ((svd.matrixU() * svd.matrixV().transpose()).determinant() < 0) sign(2, 2) = -1.0;
  const Eigen::Matrix3d R = svd.matrixU() * sign * svd.matrixV().transpose();
  return Rigid3::from_matrix(R, target - R * source);
}

}  // namespace lvcalib
