// SPDX-License-Identifier: GPL-3.0-or-later
#include "detection/tag_model.h"

#include <Eigen/LU>
#include <gtest/gtest.h>

#include "base/random.h"

namespace lvcalib {
namespace {

TagModel example() {
  TagModel model;
  const std::array<Eigen::Vector2d, 4> corners = {Eigen::Vector2d(12, 58), Eigen::Vector2d(55, 63),
                                                  Eigen::Vector2d(60, 20), Eigen::Vector2d(14, 15)};
  model.tag_from_plane = plane_from_tag_corners(corners).inverse();
  model.tag_from_plane /= model.tag_from_plane(2, 2);
  model.blur_px = 0.4;
  model.curve = 0.2;
  model.growth = 0.005;
  model.black << 40, 3, -2;
  model.contrast << 150, -5, 8;
  return model;
}

TEST(TagModel, CornersComeBack) {
  const TagModel model = example();
  EXPECT_LT((model.plane_corners()[1] - Eigen::Vector2d(55, 63)).norm(), 1e-9);
  EXPECT_LT((model.tag_point({60, 20}) - Eigen::Vector2d(1, 1)).norm(), 1e-9);
}

TEST(TagModel, PlaneJacobianEqualsDifferences) {
  const TagModel model = example();
  const Eigen::Vector2d point(33, 41);
  for (int i = 0; i < 2; ++i) {
    const Eigen::Vector2d h = 1e-5 * Eigen::Vector2d::Unit(i);
    const Eigen::Vector2d difference =
        (model.tag_point(point + h) - model.tag_point(point - h)) / 2e-5;
    EXPECT_LT((model.tag_by_plane(point).col(i) - difference).norm(), 1e-8);
  }
}

TEST(TagModel, DerivativesEqualDifferences) {
  const TagModel model = example();
  const BlurredTag tag(*tag_pattern("tag36h11", 9), 1);
  Random random(8);
  for (int i = 0; i < 50; ++i) {
    const Eigen::Vector2d point(random.uniform(12, 60), random.uniform(15, 60));
    TagModel::Vector by_step;
    model.gray(tag, Eigen::Matrix2d::Identity(), point, &by_step);
    for (int k = 0; k < TagModel::kUnknowns; ++k) {
      const double h = k < TagModel::kBlur || k == TagModel::kGrowth ? 5e-4 : 2e-3;
      const auto at = [&](double step) {
        return model.moved(step * TagModel::Vector::Unit(k))
            .gray(tag, Eigen::Matrix2d::Identity(), point);
      };
      // Neglected is that the blur changes its shape in tag coordinates: at most half the contrast
      // per unit, against a steepest slope of 150/(σ √(2π)) = 3000 with σ = 0.018; and what the
      // growth does to second order: ½g²·|∂³a| ≤ ½·0.005²·0.4·150/σ³ = 130.
      const double tolerance = k < TagModel::kBlur      ? 90.0 + 130.0
                               : k == TagModel::kBlur   ? 12.0
                               : k == TagModel::kGrowth ? 5.0
                                                        : 0.1;
      EXPECT_NEAR(by_step[k], (at(h) - at(-h)) / (2 * h), tolerance) << "unknown " << k;
    }
  }
}

}  // namespace
}  // namespace lvcalib
