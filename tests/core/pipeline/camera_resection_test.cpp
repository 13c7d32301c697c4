// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/camera_resection.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "pipeline/calibration.h"
#include "support/ordinary_boards.h"
#include "support/simulated_dataset.h"

namespace lvcalib {
namespace {

using ::testing::HasSubstr;

simulation::SimulationOptions three_scenes_of_a_tag() {
  simulation::SimulationOptions options = test::dataset_options(998'012, 3);
  options.target = test::single_tag_target();
  return options;
}

// Four corners tell no camera, and poses under a wrong one agree with no cloud: the boards of all
// clouds together do.
TEST(Calibrate, NamesAGrossFaultOfTheCameraByTheBoardsInTheClouds) {
  const test::SimulatedDataset data(three_scenes_of_a_tag());
  Dataset far = data.open();
  far.camera.fx *= 1.25;
  far.camera.fy *= 1.25;
  const auto longer = calibrate(far, {}, {});
  ASSERT_FALSE(longer.ok());
  EXPECT_EQ(longer.error().kind, ErrorKind::kUntrusted);
  EXPECT_THAT(longer.error().text(), HasSubstr("the focal length is 2"));
  EXPECT_THAT(longer.error().text(), HasSubstr("% too long"));

  Dataset aside = data.open();
  aside.camera.cx += 70.0;
  aside.camera.cy -= 70.0;
  const auto off = calibrate(aside, {}, {});
  ASSERT_FALSE(off.ok());
  EXPECT_THAT(off.error().text(), HasSubstr("the principal point is off by"));
}

// One cloud without its board leaves too few scenes as well: the camera is not to blame.
TEST(IntrinsicsThatAgree, DoesNotBlameTheCameraForALostBoard) {
  const test::SimulatedDataset data(three_scenes_of_a_tag());
  const auto result = calibrate(data.open(), {}, {});
  ASSERT_TRUE(result.ok()) << result.error().text();
  CalibrationResult lost = *result;
  // As if another board's pose had been taken in one scene.
  ASSERT_TRUE(lost.scenes[2].search);
  for (BoardCandidate& candidate : lost.scenes[2].search->candidates)
    candidate.lidar_from_board.transform =
        Rigid3{Eigen::Quaterniond::Identity(), Eigen::Vector3d(-1.0, 2.0, 0.5)} *
        candidate.lidar_from_board.transform;
  EXPECT_TRUE(intrinsics_that_agree(lost).empty()) << intrinsics_that_agree(lost).text();
  EXPECT_TRUE(intrinsics_that_agree(*result).empty()) << intrinsics_that_agree(*result).text();
}

}  // namespace
}  // namespace lvcalib
