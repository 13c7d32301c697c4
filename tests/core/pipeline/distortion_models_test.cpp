// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/distortion_models.h"

#include <gtest/gtest.h>

#include "support/camera_views.h"

namespace lvcalib {
namespace {

constexpr double kFalseAlarm = 1e-3;

// What another model has to say against one, for images of a lens.
std::optional<BetterDistortion> against(DistortionModel given, const Camera& lens,
                                        const test::Views& how, std::uint64_t seed) {
  const auto images = test::images_of(lens, how, seed);
  std::vector<CornerView> views;
  Camera start = lens;
  if (given != lens.model) start.distortion.setZero();
  start.model = given;
  for (const BoardImage& image : images) views.push_back({&image.view->corners, Rigid3()});
  const auto fit = fit_from(views, start, DetectionOptions());
  EXPECT_TRUE(fit);
  if (!fit) return std::nullopt;
  return better_distortion(views, *fit, DetectionOptions(), kFalseAlarm, {});
}

TEST(BetterDistortion, NamesTheModelOfTheLens) {
  const Camera fisheye = test::camera_of(DistortionModel::kEquidistant);
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    const auto better = against(DistortionModel::kPlumbBob, fisheye, {}, seed);
    ASSERT_TRUE(better) << seed;
    EXPECT_EQ(better->fit.camera.model, DistortionModel::kEquidistant);
    // As well as the corners' noise lets it.
    EXPECT_LT(better->held_out_px, 1.3 * test::kNoise_px);
    EXPECT_GT(better->given_px, 1.5 * better->held_out_px);
  }
  const auto other = against(DistortionModel::kEquidistant,
                             test::camera_of(DistortionModel::kRationalPolynomial), {}, 1);
  ASSERT_TRUE(other);
  EXPECT_NE(other->fit.camera.model, DistortionModel::kEquidistant);
}

TEST(BetterDistortion, DoesNotDoubtTheRightOne) {
  test::Views few;
  few.count = 5;
  for (const DistortionModel model : kDistortionModels) {
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
      EXPECT_FALSE(against(model, test::camera_of(model), {}, seed)) << name_of(model) << seed;
      EXPECT_FALSE(against(model, test::camera_of(model), few, seed)) << name_of(model) << seed;
    }
  }
}

TEST(BetterDistortion, FewImagesDoNotTell) {
  test::Views four;
  four.count = 4;
  EXPECT_FALSE(
      against(DistortionModel::kPlumbBob, test::camera_of(DistortionModel::kEquidistant), four, 0));
}

}  // namespace
}  // namespace lvcalib
