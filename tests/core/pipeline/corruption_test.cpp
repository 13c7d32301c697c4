// SPDX-License-Identifier: GPL-3.0-or-later
// Forty corruptions of a small rig: none may give a good result that is wrong, and where a right
// diagnosis exists it must be said.
#include <algorithm>

#include <gtest/gtest.h>

#include "support/corruptions.h"
#include "support/simulated_dataset.h"

namespace lvcalib::test {
namespace {

simulation::SimulatedRig small_rig() {
  auto options = dataset_options(963, 3);
  options.lidar.points = 60'000;
  options.placement.clutter = false;
  auto rig = simulation::simulate(options, {});
  if (!rig) {
    ADD_FAILURE() << rig.error().text();
    return {};
  }
  return std::move(*rig);
}

// Runs those kinds whose name starts with one of the words.
int run_kinds(const std::vector<std::string>& starts) {
  static const simulation::SimulatedRig rig = small_rig();
  const TemporaryFolder folder;
  int runs = 0;
  for (const Corruption& corruption : corruptions()) {
    const bool wanted = std::any_of(starts.begin(), starts.end(), [&](const std::string& start) {
      return corruption.name.starts_with(start);
    });
    if (!wanted) continue;
    ++runs;
    const CorruptionOutcome out = run_corruption(rig, corruption, folder.path());
    EXPECT_NE(out.outcome, Outcome::kSilentlyWrong)
        << corruption.name << ": " << out.error_mm << " mm, " << out.error_mrad << " mrad, "
        << out.sigmas << " σ";
    // Doubted or refused, but not for the right reason yet.
    const bool unnamed = corruption.name.starts_with("all clouds of the first scene") ||
                         corruption.name.starts_with("rig bumped");
    EXPECT_TRUE(out.diagnosed || unnamed)
        << corruption.name << ": " << out.quality << ": " << out.said;
    if (corruption.name == "clean") {
      EXPECT_EQ(out.outcome, Outcome::kRight) << out.said;
    }
  }
  return runs;
}

TEST(Corruption, OfTheIntrinsicsIsNeverGood) {
  EXPECT_GE(run_kinds({"clean", "focal", "principal", "distortion dropped", "only fx"}), 15);
}

TEST(Corruption, OfTheCloudsIsNeverGood) {
  EXPECT_GE(run_kinds({"cloud", "x and y", "axes", "all clouds", "rig bumped"}), 10);
}

TEST(Corruption, OfTheImagesIsNeverGood) {
  EXPECT_GE(run_kinds({"images mirrored", "images turned", "images shifted", "images of two"}), 5);
}

TEST(Corruption, OfTheBoardIsNeverGood) {
  EXPECT_GE(run_kinds({"board", "ids from 100", "another family"}), 7);
}

TEST(Corruption, OfTheFilesIsNeverGood) {
  EXPECT_GE(run_kinds({"rig.yaml", "a scene twice"}), 5);
}

}  // namespace
}  // namespace lvcalib::test
