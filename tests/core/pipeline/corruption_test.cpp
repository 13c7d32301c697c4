// SPDX-License-Identifier: GPL-3.0-or-later
// A dozen corruptions of a small rig: none may give a good result that is wrong, and where a
// right diagnosis exists it must be said.
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

// Runs the kinds of these names.
void run_kinds(const std::vector<std::string>& names) {
  static const simulation::SimulatedRig rig = small_rig();
  const TemporaryFolder folder;
  std::size_t runs = 0;
  for (const Corruption& corruption : corruptions()) {
    if (std::find(names.begin(), names.end(), corruption.name) == names.end()) continue;
    ++runs;
    const CorruptionOutcome out = run_corruption(rig, corruption, folder.path());
    EXPECT_TRUE(out.applies) << corruption.name;
    EXPECT_NE(out.outcome, Outcome::kSilentlyWrong)
        << corruption.name << ": " << out.error_mm << " mm, " << out.error_mrad << " mrad, "
        << out.sigmas << " σ";
    EXPECT_TRUE(out.diagnosed) << corruption.name << ": " << out.quality << ": " << out.said;
    EXPECT_FALSE(out.absurd) << corruption.name << ": " << out.said;
    if (corruption.name == "clean") {
      EXPECT_EQ(out.outcome, Outcome::kRight) << out.said;
    }
  }
  EXPECT_EQ(runs, names.size());
}

TEST(Corruption, OfTheIntrinsicsIsNeverGood) {
  run_kinds({"clean", "focal -1 %", "focal +5 %", "focal -20 %", "only fx +2 %",
             "principal point +10 +0 px", "principal point +0 +20 px"});
}

TEST(Corruption, OfTheBoardIsNeverGood) {
  run_kinds({"ids from 4", "ids from 100", "ids from the top row"});
}

TEST(Corruption, OfTheScenesIsNeverGood) {
  run_kinds({"all clouds of the first scene", "all images of the first scene",
             "rig bumped by 20 mm before the last scene"});
}

}  // namespace
}  // namespace lvcalib::test
