// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/board_check.h"

#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "simulation/dataset_writer.h"
#include "simulation/simulator.h"
#include "support/temporary_folder.h"

namespace lvcalib {
namespace {

TEST(BoardCheck, SaysWhyAnImageDoesNotShowTheBoard) {
  simulation::SimulationOptions options;
  options.seed = 5;
  options.scenes = 1;
  options.lidar.points = 20'000;
  options.image.width_px = 800;
  options.image.height_px = 500;
  const auto rig = simulation::simulate(options, {});
  ASSERT_TRUE(rig.ok());
  const test::TemporaryFolder folder;
  ASSERT_TRUE(simulation::write_dataset(*rig, folder.path() / "rig").ok());
  std::filesystem::path image;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder.path())) {
    if (entry.path().stem() == "image") image = entry.path();
  }
  ASSERT_FALSE(image.empty());
  EXPECT_EQ(make_board_check(rig->target, {})(image, rig->camera), Message());
  std::ifstream file(image, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(file), {}};
  EXPECT_EQ(board_complaint(bytes, rig->target, rig->camera, {}), Message());
  EXPECT_NE(board_complaint(bytes.substr(0, 100), rig->target, rig->camera, {}), Message());
  Target other = rig->target;
  other.first_tag_id = 300;
  EXPECT_THAT(make_board_check(other, {})(image, rig->camera), ::testing::HasSubstr("tag"));
  EXPECT_NE(make_board_check(rig->target, {})(folder.path() / "none.png", rig->camera), Message());
}

}  // namespace
}  // namespace lvcalib
