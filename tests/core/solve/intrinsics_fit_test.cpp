// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/intrinsics_fit.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/random.h"
#include "base/statistics.h"
#include "target/target.h"

namespace lvcalib {
namespace {

constexpr double kNoise_px = 0.02;
constexpr double kAlarm = 0.001;

Camera true_camera() {
  Camera camera;
  camera.width_px = 1440;
  camera.height_px = 900;
  camera.fx = 1098.0;
  camera.fy = 1100.0;
  camera.cx = 712.0;
  camera.cy = 446.0;
  camera.distortion << -0.08, 0.03, 2e-4, -1e-4, 0, 0, 0, 0;
  return camera;
}

struct Views {
  std::vector<std::vector<CornerObservation>> corners;
  std::vector<CornerView> views;
};

// Boards turned about two axes at 1.6 to 3 m, spread over the image; corners with white noise.
Views seen(std::uint64_t seed, int count, double tilt_rad, double noise_px = kNoise_px) {
  Random random(seed);
  const Camera camera = true_camera();
  const Target target;
  Views out;
  const Eigen::Vector2d middle = target.outline().center_m();
  for (int v = 0; v < count; ++v) {
    const double turn = 2.0 * M_PI * v / count;
    const Eigen::Matrix3d facing = Eigen::Vector3d(1, -1, -1).asDiagonal();
    const Eigen::Matrix3d R =
        (Eigen::AngleAxisd(tilt_rad * std::cos(turn), Eigen::Vector3d::UnitX()) *
         Eigen::AngleAxisd(tilt_rad * std::sin(turn), Eigen::Vector3d::UnitY()) *
         Eigen::AngleAxisd(0.3 * v, Eigen::Vector3d::UnitZ()))
            .toRotationMatrix() *
        facing;
    const double depth = 1.6 + 1.4 * v / count;
    const Eigen::Vector3d place(0.2 * depth * std::cos(turn), 0.1 * depth * std::sin(turn), depth);
    const Rigid3 pose = Rigid3::from_matrix(
        R, Eigen::Vector3d(place - R * Eigen::Vector3d(middle.x(), middle.y(), 0)));
    std::vector<CornerObservation> corners;
    for (const TargetTag& tag : target.tags()) {
      const auto at = target.tag_corners_m(tag);
      for (std::size_t k = 0; k < at.size(); ++k) {
        const auto p = camera.project(pose * Eigen::Vector3d(at[k].x(), at[k].y(), 0));
        if (!p || !camera.in_image(*p)) continue;
        Eigen::Vector2d e;
        for (double& part : e) part = random.normal();
        corners.push_back({tag.id, static_cast<int>(k), at[k], *p + noise_px * e, 0.0});
      }
    }
    out.corners.push_back(std::move(corners));
    out.views.push_back({nullptr, pose});
  }
  for (std::size_t v = 0; v < out.views.size(); ++v) out.views[v].corners = &out.corners[v];
  return out;
}

IntrinsicsContrast contrast_of(const Views& views, const Camera& given) {
  const IntrinsicsVector wide = wide_intrinsics_sigma(given);
  const auto fit = fit_intrinsics(views.views, given, wide);
  EXPECT_TRUE(fit);
  if (!fit) return {};
  return contrast_intrinsics(intrinsics_of(fit->camera), intrinsics_of(given), fit->covariance,
                             wide, fit->freedom, kAlarm);
}

// Any start within what happens; the estimate is within four standard deviations of the truth.
TEST(IntrinsicsFit, FindsTheCameraFromFarOff) {
  const Views views = seen(1, 6, 0.6);
  Camera given = true_camera();
  given.fx *= 1.2;
  given.fy *= 1.2;
  given.cx += 36.0;
  given.distortion.setZero();
  const auto fit = fit_intrinsics(views.views, given, wide_intrinsics_sigma(given));
  ASSERT_TRUE(fit);
  const IntrinsicsVector off = intrinsics_of(fit->camera) - intrinsics_of(true_camera());
  for (Eigen::Index k = 0; k < 9; ++k)
    EXPECT_LT(std::abs(off(k)), 4.0 * std::sqrt(fit->covariance(k, k))) << k;
  EXPECT_LT(std::abs(off(0)), 2.0);
  EXPECT_NEAR(fit->sigma_px, kNoise_px, 0.1 * kNoise_px);
}

// What the prior holds stays; entries that the model does not use stay as well.
TEST(IntrinsicsFit, HoldsWhatThePriorHolds) {
  const Views views = seen(2, 4, 0.5);
  Camera given = true_camera();
  given.cx += 2.0;
  IntrinsicsVector prior = wide_intrinsics_sigma(given);
  prior(2) = 0.0;
  const auto fit = fit_intrinsics(views.views, given, prior);
  ASSERT_TRUE(fit);
  EXPECT_EQ(fit->camera.cx, given.cx);
  EXPECT_EQ(fit->covariance(2, 2), 0.0);
  EXPECT_EQ(fit->camera.distortion.tail<3>().norm(), 0.0);
}

// Replicates do not see wrong intrinsics, the residuals do.
TEST(ReplicateNoise, HardlySeesWrongIntrinsics) {
  const Views views = seen(3, 5, 0.5);
  EXPECT_NEAR(replicate_noise(views.views, true_camera()), kNoise_px, 0.15 * kNoise_px);
  Camera wrong = true_camera();
  wrong.fx *= 1.05;
  wrong.fy *= 1.05;
  IntrinsicsVector held = IntrinsicsVector::Zero();
  const auto fit = fit_intrinsics(views.views, wrong, held);
  ASSERT_TRUE(fit);
  // A focal length off by a twentieth bends what a tag's own fit leaves by half the noise.
  EXPECT_LT(fit->replicate_px, 1.6 * kNoise_px);
  EXPECT_GT(fit->sigma_px, 3.0 * kNoise_px);
}

TEST(ReplicateNoise, NeedsReplicates) {
  Views views = seen(4, 1, 0.5);
  views.corners[0].resize(8);
  EXPECT_EQ(replicate_noise(views.views, true_camera()), 0.0);
}

// Under right intrinsics χ² has its mean and stays below the gate as often as stated.
TEST(IntrinsicsContrast, RightIntrinsicsAreNotContradicted) {
  double sum = 0.0;
  double dof = 0.0;
  int contradicted = 0;
  constexpr int kDraws = 60;
  for (std::uint64_t seed = 100; seed < 100 + kDraws; ++seed) {
    const IntrinsicsContrast c = contrast_of(seen(seed, 4, 0.5), true_camera());
    sum += c.chi_square;
    dof += c.dof;
    contradicted += c.contradicts() ? 1 : 0;
  }
  // √(2/Σdof) is a twentieth: four of them.
  EXPECT_NEAR(sum / dof, 1.0, 0.25);
  EXPECT_LE(contradicted, 1);
}

struct WrongPart {
  const char* name;
  IntrinsicsPart part;
  void (*spoil)(Camera&);
  const char* words;
};

class ContradictedPart : public ::testing::TestWithParam<WrongPart> {};

TEST_P(ContradictedPart, IsNamedWithItsSize) {
  const Views views = seen(5, 5, 0.5);
  Camera given = true_camera();
  GetParam().spoil(given);
  const IntrinsicsContrast c = contrast_of(views, given);
  EXPECT_TRUE(c.contradicts());
  ASSERT_EQ(c.parts.size(), 1U);
  EXPECT_EQ(c.parts.front(), GetParam().part);
  EXPECT_THAT(describe(c, given, views.views), ::testing::HasSubstr(GetParam().words));
}

INSTANTIATE_TEST_SUITE_P(
    Cameras, ContradictedPart,
    ::testing::Values(WrongPart{"Longer", IntrinsicsPart::kFocalLength,
                                [](Camera& c) {
                                  c.fx *= 1.01;
                                  c.fy *= 1.01;
                                },
                                "% too long"},
                      WrongPart{"Shorter", IntrinsicsPart::kFocalLength,
                                [](Camera& c) {
                                  c.fx *= 0.8;
                                  c.fy *= 0.8;
                                },
                                "% too short"},
                      WrongPart{"Center", IntrinsicsPart::kPrincipalPoint,
                                [](Camera& c) { c.cx += 5.0; }, "principal point"},
                      WrongPart{"NoDistortion", IntrinsicsPart::kDistortion,
                                [](Camera& c) { c.distortion.setZero(); }, "px on the boards"},
                      WrongPart{"TangentialFirst", IntrinsicsPart::kDistortion,
                                [](Camera& c) {
                                  std::swap(c.distortion(0), c.distortion(2));
                                  std::swap(c.distortion(1), c.distortion(3));
                                },
                                "as if its coefficients were listed as p1 p2 k1 k2 k3"}),
    [](const auto& info) { return info.param.name; });

// A tangential distortion that is hardly seen acts nearly as a shift of the principal point: both
// are named, and neither where the error is large.
TEST(IntrinsicsContrast, WhatWouldDoAsWellIsNamedBesides) {
  using Parts = std::vector<IntrinsicsPart>;
  const Parts lens{IntrinsicsPart::kDistortion};
  for (const auto& [error, alone] : {std::pair{1.5e-4, false}, std::pair{8e-4, true}}) {
    Camera given = true_camera();
    given.distortion(2) += error;
    int contradicted = 0, named = 0, both = 0;
    for (std::uint64_t seed = 300; seed < 340; ++seed) {
      const Views views = seen(seed, 5, 0.5);
      const IntrinsicsContrast c = contrast_of(views, given);
      if (!c.contradicts()) continue;
      ++contradicted;
      const bool among = std::any_of(c.alternatives.begin(), c.alternatives.end(),
                                     [&](const IntrinsicsContrast& o) { return o.parts == lens; });
      named += c.parts == lens || among ? 1 : 0;
      both += c.alternatives.empty() ? 0 : 1;
      EXPECT_EQ(describe(c, given, views.views).text().find(", or ") != std::string::npos,
                !c.alternatives.empty());
    }
    EXPECT_GE(contradicted, 30);
    // One in a thousand is refused although it is true.
    EXPECT_GE(named, contradicted - 1) << error;
    if (alone) {
      EXPECT_EQ(both, 0);
    } else {
      EXPECT_GT(both, contradicted / 2);
    }
  }
}

// What some views say, added to what others say, is what all say.
TEST(IntrinsicsEvidence, AddsUpToTheFitOfAllViews) {
  const Views views = seen(6, 6, 0.6);
  const Camera given = true_camera();
  const IntrinsicsVector wide = wide_intrinsics_sigma(given);
  const auto all = fit_intrinsics(views.views, given, wide);
  ASSERT_TRUE(all);
  std::vector<CornerView> fitted = views.views;
  for (std::size_t v = 0; v < fitted.size(); ++v)
    fitted[v].camera_from_board = all->camera_from_board[v];
  const auto one =
      intrinsics_evidence({fitted.begin(), fitted.begin() + 2}, all->camera, all->sigma_px);
  const auto two =
      intrinsics_evidence({fitted.begin() + 2, fitted.end()}, all->camera, all->sigma_px);
  ASSERT_TRUE(one && two);
  Eigen::MatrixXd information = one->information + two->information;
  for (Eigen::Index k = 0; k < 9; ++k) information(k, k) += 1.0 / (wide(k) * wide(k));
  const Eigen::MatrixXd covariance =
      information.topLeftCorner<9, 9>().ldlt().solve(Eigen::MatrixXd::Identity(9, 9));
  for (Eigen::Index k = 0; k < 9; ++k)
    EXPECT_NEAR(std::sqrt(covariance(k, k)), std::sqrt(all->covariance(k, k)),
                1e-3 * std::sqrt(all->covariance(k, k)))
        << k;
  // Each pulls its own way; together with the prior they rest, in units of the estimate's σ.
  IntrinsicsVector pull = one->gradient + two->gradient;
  const IntrinsicsVector off = intrinsics_of(all->camera) - intrinsics_of(given);
  for (Eigen::Index k = 0; k < 9; ++k) pull(k) -= off(k) / (wide(k) * wide(k));
  const Eigen::VectorXd step = covariance * pull.head<9>();
  const Eigen::VectorXd alone = covariance * one->gradient.head<9>();
  for (Eigen::Index k = 0; k < 9; ++k)
    EXPECT_LT(std::abs(step(k)), 0.1 * std::sqrt(covariance(k, k)));
  EXPECT_GT(alone.cwiseAbs().cwiseQuotient(covariance.diagonal().cwiseSqrt()).maxCoeff(), 0.1);
}

// From a camera that is a little off the evidence alone leads to the estimate.
TEST(IntrinsicsEvidence, PointsToTheEstimate) {
  const Views views = seen(7, 6, 0.6);
  const auto fit = fit_intrinsics(views.views, true_camera(), wide_intrinsics_sigma(true_camera()));
  ASSERT_TRUE(fit);
  Camera near = fit->camera;
  near.fx += 2.0;
  near.cy -= 1.0;
  const auto evidence = intrinsics_evidence(views.views, near, fit->sigma_px);
  ASSERT_TRUE(evidence);
  const Eigen::VectorXd step =
      evidence->information.topLeftCorner<8, 8>().ldlt().solve(evidence->gradient.head<8>());
  const Eigen::VectorXd wanted = (intrinsics_of(fit->camera) - intrinsics_of(near)).head<8>();
  // k3, which is left out here, takes some of it.
  EXPECT_NEAR(step(0), wanted(0), 0.2);
  EXPECT_NEAR(step(3), wanted(3), 0.2);
  EXPECT_FALSE(intrinsics_evidence({}, near, 0.1));
}

TEST(IntrinsicsFit, NeedsCorners) {
  EXPECT_FALSE(fit_intrinsics({}, true_camera(), wide_intrinsics_sigma(true_camera())));
}

}  // namespace
}  // namespace lvcalib
