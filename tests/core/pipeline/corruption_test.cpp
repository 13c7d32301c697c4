// SPDX-License-Identifier: GPL-3.0-or-later
// Forty corruptions of a small rig: none may give a good result that is wrong, and where a
// right diagnosis exists it must be said.
#include <algorithm>

#include <gtest/gtest.h>

#include "support/corruptions.h"
#include "support/ordinary_boards.h"
#include "support/simulated_dataset.h"

namespace lvcalib::test {
namespace {

simulation::SimulatedRig small_rig(std::uint64_t seed, int scenes,
                                   const Target& target = dataset_options(0, 1).target) {
  auto options = dataset_options(seed, scenes);
  options.lidar.points = 60'000;
  options.placement.clutter = false;
  options.target = target;
  auto rig = simulation::simulate(options, {});
  if (!rig) {
    ADD_FAILURE() << rig.error().text();
    return {};
  }
  return std::move(*rig);
}

const simulation::SimulatedRig& three_scenes() {
  static const simulation::SimulatedRig rig = small_rig(963, 3);
  return rig;
}

// Runs the kinds whose names start with one of the words; how many those are.
int run_kinds(const std::vector<std::string>& starts,
              const simulation::SimulatedRig& rig = three_scenes()) {
  const TemporaryFolder folder;
  int runs = 0;
  for (const Corruption& corruption : corruptions()) {
    const bool wanted = std::any_of(starts.begin(), starts.end(), [&](const std::string& start) {
      return corruption.name.starts_with(start);
    });
    if (!wanted) continue;
    const CorruptionOutcome out = run_corruption(rig, corruption, folder.path());
    if (!out.applies) continue;
    ++runs;
    EXPECT_NE(out.outcome, Outcome::kSilentlyWrong)
        << corruption.name << ": " << out.error_mm << " mm, " << out.error_mrad << " mrad, "
        << out.sigmas << " σ";
    // Doubted, but not for the right reason: 0.3 % of a board's size.
    const bool unnamed = corruption.name.starts_with("board 0.997");
    EXPECT_TRUE(out.diagnosed || unnamed)
        << corruption.name << ": " << out.quality << ": " << out.said;
    EXPECT_FALSE(out.absurd) << corruption.name << ": " << out.said;
    if (corruption.family == CorruptionFamily::kPlanted) {
      EXPECT_EQ(out.quality, "doubtful") << corruption.name << ": " << out.said;
    }
    const bool harmless =
        corruption.name == "clean" || corruption.name.ends_with("cloud without the board");
    if (harmless) {
      EXPECT_EQ(out.outcome, Outcome::kRight) << out.said;
    }
  }
  return runs;
}

TEST(Corruption, OfTheIntrinsicsIsNeverGood) {
  EXPECT_GE(run_kinds({"clean", "focal -1 %", "focal +5 %", "focal -20 %", "only fx +2 %",
                       "principal point +10", "principal point +0 +20",
                       "principal point in the image's corner", "cx and cy exchanged"}),
            9);
}

TEST(Corruption, OfTheCloudsIsNeverGood) {
  EXPECT_GE(
      run_kinds({"intensity saturated at 20", "no points but five", "cloud in", "cloud mirrored",
                 "all clouds", "coordinates in steps of 20", "intensities late"}),
      10);
}

TEST(Corruption, OfTheImagesIsNeverGood) {
  EXPECT_GE(run_kinds({"images mirrored", "images upside down", "images turned", "images at",
                       "images of two", "clouds of two", "all images"}),
            8);
}

TEST(Corruption, OfTheBoardIsNeverGood) {
  EXPECT_GE(run_kinds({"board ", "target.yaml in centi", "target.yaml in milli",
                       "a second board in every cloud", "ids from 4", "ids from 100",
                       "ids from the top row"}),
            11);
}

// Two scenes against two: neither group is the odd one out, and on this rig none is refused.
TEST(Corruption, OfTheRigHalfwayIsTold) {
  EXPECT_EQ(run_kinds({"rig bumped by 50 mm halfway", "rig turned by 20 mrad halfway"},
                      small_rig(976, 4)),
            2);
}

// A panel of the board's size stands elsewhere in every cloud, and is not the board that is
// missing.
TEST(Corruption, ACloudWithoutTheBoardDoubtsNothingElse) {
  EXPECT_EQ(
      run_kinds({"last scene's cloud without the board"}, small_rig(977, 4, checkerboard_target())),
      1);
}

TEST(Corruption, OfTheRigIsNeverGood) {
  EXPECT_GE(run_kinds({"rig bumped by 20 mm before the last scene"}), 1);
}

// What moves or trails while a scan is taken bends every scene alike, so that no scene contradicts
// another.
TEST(Corruption, OfTheScansIsNeverGood) {
  EXPECT_EQ(run_kinds({"scan_motion=20", "encoder_lag=5", "detector_lag=5"}), 3);
}

}  // namespace
}  // namespace lvcalib::test
