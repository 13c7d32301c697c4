// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/alignment.h"

#include <gtest/gtest.h>

#include "base/random.h"
#include "support/pose_matchers.h"

namespace lvcalib {
namespace {

std::vector<PointPair> pairs_of(const Rigid3& truth, int count, std::uint64_t seed) {
  Random random(seed);
  std::vector<PointPair> pairs;
  for (int i = 0; i < count; ++i) {
    PointPair pair;
    for (double& v : pair.source_m) v = random.uniform(-2.0, 2.0);
    pair.target_m = truth * pair.source_m;
    pairs.push_back(pair);
  }
  return pairs;
}

const Rigid3 kTruth{so3_exp({0.4, -1.1, 2.0}), {0.3, -2.0, 5.0}};

TEST(Alignment, FindsTheMotionOfExactPoints) {
  EXPECT_THAT(align_points(pairs_of(kTruth, 5, 1)), test::IsNearPose(kTruth, 1e-9, 1e-9));
}

TEST(Alignment, NeverMirrorsPointsOfOnePlane) {
  auto pairs = pairs_of(kTruth, 6, 2);
  for (PointPair& pair : pairs) {
    pair.source_m.z() = 0.0;
    pair.target_m = kTruth * pair.source_m;
  }
  const Rigid3 found = align_points(pairs);
  EXPECT_GT(found.rotation.toRotationMatrix().determinant(), 0.0);
  EXPECT_THAT(found, test::IsNearPose(kTruth, 1e-9, 1e-9));
}

TEST(Alignment, APairOfNoWeightDoesNotCount) {
  auto pairs = pairs_of(kTruth, 5, 3);
  pairs[2].target_m.x() += 1.0;
  EXPECT_GT(translation_distance_m(align_points(pairs), kTruth), 0.05);
  pairs[2].weight = 0.0;
  EXPECT_THAT(align_points(pairs), test::IsNearPose(kTruth, 1e-9, 1e-9));
}

TEST(Alignment, NoPairsGiveTheIdentity) {
  EXPECT_THAT(align_points({}), test::IsNearPose(Rigid3{}, 1e-12, 1e-12));
}

}  // namespace
}  // namespace lvcalib
