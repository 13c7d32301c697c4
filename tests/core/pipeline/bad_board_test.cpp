// SPDX-License-Identifier: GPL-3.0-or-later
// Boards, prints and clouds that are not what target.yaml says: whatever happens, no wrong pose is
// called good, and what is wrong is named.
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <string>
#include <string_view>

#include <Eigen/Cholesky>
#include <gtest/gtest.h>

#include "base/random.h"
#include "pipeline/calibration.h"
#include "pipeline/dataset.h"
#include "simulation/dataset_writer.h"
#include "support/covered_board.h"
#include "support/ordinary_boards.h"
#include "support/simulated_dataset.h"

namespace lvcalib {
namespace {

using simulation::SimulatedRig;
using simulation::SimulatedScene;

struct Spoiled {
  const char* name;
  Target printed;                            ///< What stands in the room.
  std::function<void(SimulatedRig&)> spoil;  ///< Changes the data or what target.yaml says.
  std::vector<std::string> named;            ///< Parts of the error or of the warnings.
  bool good = false;  ///< The result may be good, if its error is within its interval.
  simulation::LidarKind lidar = simulation::LidarKind::kAvia;
  int scenes = 4;
};

std::ostream& operator<<(std::ostream& out, const Spoiled& s) {
  return out << s.name;
}

// A grey sheet over the right part of every board, 30 cm nearer.
void cover(SimulatedRig& rig, double share) {
  BoardOutline part = rig.target.outline();
  part.lower_left_m.x() = part.upper_right_m.x() - share * part.size_m().x();
  part.lower_left_m.y() -= 0.05;
  part.upper_right_m.array() += 0.05;
  for (std::size_t k = 0; k < rig.scenes.size(); ++k) test::cover_part(rig, k, part, 0.3F);
}

void change_intensities(SimulatedRig& rig, const std::function<float(float)>& change) {
  for (SimulatedScene& scene : rig.scenes) {
    for (float& i : scene.cloud.intensity) i = change(i);
  }
}

void saturate(SimulatedRig& rig) {
  change_intensities(rig, [](float i) { return std::min(i, 70.0F); });
}
void eight_levels(SimulatedRig& rig) {
  change_intensities(rig, [](float i) { return 20.0F * std::floor(i / 20.0F); });
}
void no_intensity(SimulatedRig& rig) {
  for (SimulatedScene& scene : rig.scenes) scene.cloud.intensity.clear();
}
void one_intensity(SimulatedRig& rig) {
  change_intensities(rig, [](float) { return 9.0F; });
}
void some_without_intensity(SimulatedRig& rig) {
  rig.scenes.front().cloud.intensity.clear();
}
// Ink that the LiDAR does not see.
void white_board(SimulatedRig& rig) {
  Random random(5);
  for (SimulatedScene& scene : rig.scenes) {
    test::for_board_points(scene, rig.target.outline(),
                           [&](const Eigen::Vector2d&, Eigen::Vector3f&, float& i) {
                             i = static_cast<float>(110.0 + 4.0 * random.normal());
                           });
  }
}
// A second copy of the board beside the first, which the camera does not see.
void second_board(SimulatedRig& rig) {
  const double step = rig.target.outline().size_m().x() + 0.3;
  for (SimulatedScene& scene : rig.scenes) {
    const Eigen::Vector3f shift =
        (scene.lidar_from_board.rotation * Eigen::Vector3d(step, 0.0, 0.0)).cast<float>();
    Cloud more;
    test::for_board_points(scene, rig.target.outline(),
                           [&](const Eigen::Vector2d&, Eigen::Vector3f& p, float& i) {
                             more.points_m.push_back(p + shift);
                             more.intensity.push_back(i);
                           });
    Cloud& cloud = scene.cloud;
    for (std::size_t k = 0; k < more.size(); ++k) {
      cloud.points_m.push_back(more.points_m[k]);
      cloud.intensity.push_back(more.intensity[k]);
      if (cloud.has_time()) cloud.time_s.push_back(cloud.time_s.back());
      if (cloud.has_line()) cloud.line.push_back(0);
    }
  }
}
// target.yaml says squares (or tags) of another size; the outline is as it is.
std::function<void(SimulatedRig&)> told(double factor) {
  return [factor](SimulatedRig& rig) {
    rig.target.column_spacing_m *= factor;
    rig.target.row_spacing_m *= factor;
    rig.target.tag_size_m *= factor;
    rig.target.circle_radius_m *= factor;
  };
}
void nothing(SimulatedRig&) {}

Target grid(TargetType type = TargetType::kAprilGrid) {
  Target t;
  t.type = type;
  return t;
}

Target fine_checkerboard() {
  Target t = test::checkerboard_target();
  t.corner_columns = 8;
  t.corner_rows = 6;
  t.column_spacing_m = t.row_spacing_m = 0.095;
  t.board_height_m = 0.75;
  t.board_width_m = 0.95;
  return t;
}

std::vector<Spoiled> cases() {
  const Target circles = grid(TargetType::kAprilGridCircles);
  const auto spinning = simulation::LidarKind::kSpinning;
  std::vector<Spoiled> all;
  all.push_back({"NothingGrid", grid(), nothing, {}, true});
  all.push_back({"NothingCheckerboard", fine_checkerboard(), nothing, {}, true});
  all.push_back({"NothingCharuco", test::charuco_target(), nothing, {}, true});
  all.push_back(
      {"NothingLegacyCharuco", test::legacy_charuco_target(), nothing, {}, true, spinning});
  all.push_back({"NothingSingleTag", test::single_tag_target(), nothing, {}, true});
  all.push_back(
      {"NothingSingleTagSpinning", test::single_tag_target(), nothing, {}, true, spinning});
  all.push_back({"CirclesWithoutIntensity", circles, no_intensity, {"intensity"}, true});
  all.push_back({"CirclesOneIntensity", circles, one_intensity, {"intensity"}, true});
  all.push_back(
      {"CirclesSomeWithoutIntensity", circles, some_without_intensity, {"intensity"}, true});
  all.push_back(
      {"CharucoWithoutIntensity", test::charuco_target(), no_intensity, {"intensity"}, true});
  all.push_back({"WhiteGrid", grid(), white_board, {"no contrast"}, true});
  all.push_back({"WhiteCircles", circles, white_board, {"no contrast"}, true});
  all.push_back({"WhiteCheckerboard", fine_checkerboard(), white_board, {"no contrast"}, true});
  all.push_back({"CoveredCircles", circles, [](auto& rig) { cover(rig, 0.6); }, {"cover"}});
  all.push_back({"CoveredGrid", grid(), [](auto& rig) { cover(rig, 0.6); }, {"cover"}});
  all.push_back({"CoveredCharuco", test::charuco_target(), [](auto& rig) { cover(rig, 0.6); }, {}});
  all.push_back({"CoveredALittle", grid(), [](auto& rig) { cover(rig, 0.2); }, {}, true});
  all.push_back({"SaturatedGrid", grid(), saturate, {"saturated"}, true});
  all.push_back({"SaturatedCircles", circles, saturate, {"saturated"}, true});
  all.push_back({"EightLevelsGrid", grid(), eight_levels, {}, true});
  all.push_back({"EightLevelsCircles", circles, eight_levels, {}, true});
  all.push_back({"EightLevelsCheckerboard", fine_checkerboard(), eight_levels, {}, true, spinning});
  all.push_back({"SecondBoardGrid", grid(), second_board, {}, true});
  all.push_back({"SecondBoardCheckerboard", fine_checkerboard(), second_board, {}, true});
  all.push_back({"ToldLargerCheckerboard", fine_checkerboard(), told(95.0 / 94.0), {"size"}});
  all.push_back({"ToldLargerCheckerboardSpinning",
                 fine_checkerboard(),
                 told(95.0 / 94.0),
                 {"size"},
                 false,
                 spinning});
  all.push_back({"ToldLargerGrid", grid(), told(95.0 / 94.0), {"size"}});
  all.push_back({"ToldLargerCharuco", test::charuco_target(), told(0.99), {"size"}});
  all.push_back({"ToldMuchLargerCheckerboard", fine_checkerboard(), told(0.9), {"size"}});
  all.push_back({"ToldMuchLargerGrid", grid(), told(1.1), {"size"}});
  return all;
}

class BadBoard : public testing::TestWithParam<Spoiled> {};

TEST_P(BadBoard, IsNamedAndNeverAConfidentWrongPose) {
  const Spoiled& spoiled = GetParam();
  auto options = test::dataset_options(11, spoiled.scenes);
  options.target = spoiled.printed;
  options.lidar.kind = spoiled.lidar;
  options.image.width_px = 1200;
  options.image.height_px = 800;
  if (spoiled.lidar == simulation::LidarKind::kSpinning) options.lidar.points = 0;
  auto rig = simulation::simulate(options, {});
  ASSERT_TRUE(rig) << rig.error().text();
  const Rigid3 truth = rig->camera_from_lidar;
  spoiled.spoil(*rig);
  const test::TemporaryFolder folder;
  ASSERT_TRUE(simulation::write_dataset(*rig, folder.path() / "dataset"));
  const auto dataset = open_dataset(folder.path() / "dataset");
  ASSERT_TRUE(dataset) << dataset.error().text();
  const auto result = calibrate(*dataset, {}, {});
  std::string said;
  if (result) {
    for (const Message& w : result->warnings) said += w.text() + "\n";
  } else {
    said = result.error().text();
  }
  for (const std::string& part : spoiled.named)
    EXPECT_NE(said.find(part), std::string::npos) << "not named: " << part << "\n" << said;
  if (!result) {
    EXPECT_FALSE(spoiled.good) << said;
    std::cout << spoiled.name << ": error: " << said << "\n";
    return;
  }
  const UncertainRigid3& x = result->extrinsic.camera_from_lidar;
  const Vector6d e = se3_log(truth * x.transform.inverse());
  const double sigmas = std::sqrt(e.dot(x.covariance.ldlt().solve(e)) / 6.0);
  std::cout << spoiled.name << ": " << name_of(result->quality) << ", "
            << 1e3 * translation_distance_m(x.transform, truth) << " mm, " << sigmas << " sigma\n"
            << said;
  if (spoiled.good) {
    EXPECT_LT(sigmas, 2.6);
  } else if (result->quality == Quality::kGood) {
    EXPECT_LT(sigmas, 2.6) << "a confident wrong pose";
  }
}

// What other boards, or another scanner, show of the same fault: by night.
bool is_further(const Spoiled& spoiled) {
  constexpr std::array<std::string_view, 10> kFurther = {"NothingLegacyCharuco",
                                                         "NothingSingleTagSpinning",
                                                         "WhiteCircles",
                                                         "CoveredGrid",
                                                         "SaturatedCircles",
                                                         "EightLevelsCircles",
                                                         "EightLevelsCheckerboard",
                                                         "SecondBoardCheckerboard",
                                                         "ToldLargerCheckerboardSpinning",
                                                         "ToldMuchLargerGrid"};
  return std::find(kFurther.begin(), kFurther.end(), spoiled.name) != kFurther.end();
}

std::vector<Spoiled> cases(bool further) {
  std::vector<Spoiled> all = cases();
  std::erase_if(all, [further](const Spoiled& s) { return is_further(s) != further; });
  return all;
}

INSTANTIATE_TEST_SUITE_P(Boards, BadBoard, testing::ValuesIn(cases(false)),
                         [](const auto& info) { return std::string(info.param.name); });
INSTANTIATE_TEST_SUITE_P(MoreBoards, BadBoard, testing::ValuesIn(cases(true)),
                         [](const auto& info) { return std::string(info.param.name); });

}  // namespace
}  // namespace lvcalib
