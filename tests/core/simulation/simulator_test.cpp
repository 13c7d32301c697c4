// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulation/simulator.h"

#include <gtest/gtest.h>

#include "base/statistics.h"
#include "simulation/printed_board.h"

namespace lvcalib::simulation {
namespace {

SimulationOptions small_options() {
  SimulationOptions options;
  options.scenes = 2;
  options.lidar.points = 20'000;
  options.image.width_px = 480;
  options.image.height_px = 300;
  return options;
}

bool same(const SimulatedScene& a, const SimulatedScene& b) {
  return a.cloud.points_m == b.cloud.points_m && a.cloud.intensity == b.cloud.intensity &&
         a.cloud.time_s == b.cloud.time_s && a.cloud.line == b.cloud.line &&
         a.image.pixels == b.image.pixels &&
         a.lidar_from_board.matrix() == b.lidar_from_board.matrix();
}

TEST(Simulator, SameSeedSameBytesWhateverTheThreads) {
  const SimulationOptions options = small_options();
  RunContext one;
  one.threads = 1;
  RunContext two;
  two.threads = 2;
  const auto a = simulate(options, one);
  const auto b = simulate(options, two);
  ASSERT_TRUE(a.ok() && b.ok());
  EXPECT_TRUE(same(a->scenes[0], b->scenes[0]));
  EXPECT_TRUE(same(a->scenes[1], b->scenes[1]));
  EXPECT_FALSE(same(a->scenes[0], a->scenes[1]));
  // A scene on its own is the same scene.
  const auto simulator = Simulator::create(options);
  const auto alone = simulator->simulate_scene(1, one);
  EXPECT_TRUE(same(*alone, a->scenes[1]));
  SimulationOptions other = options;
  other.seed = 2;
  EXPECT_NE(Simulator::create(other)->rig().camera.fx, a->camera.fx);
}

TEST(Simulator, BoardPointsLieOnTheTruePlaneAndCarryThePrint) {
  for (const auto kind : {LidarKind::kRosette, LidarKind::kAvia, LidarKind::kSpinning}) {
    SimulationOptions options = small_options();
    options.lidar.kind = kind;
    options.lidar.points = kind == LidarKind::kSpinning ? 230'400 : 60'000;
    options.lidar.angle_sigma_deg = 0.0;
    const auto rig = simulate(options, {});
    ASSERT_TRUE(rig.ok());
    const PrintedBoard board(rig->target);
    for (const SimulatedScene& scene : rig->scenes) {
      ASSERT_EQ(scene.cloud.size(), static_cast<std::size_t>(options.lidar.points));
      EXPECT_LT((scene.camera_from_board.matrix() -
                 (rig->camera_from_lidar * scene.lidar_from_board).matrix())
                    .norm(),
                1e-12);
      const Rigid3 board_from_lidar = scene.lidar_from_board.inverse();
      const Eigen::Vector3d normal = scene.lidar_from_board.rotation * Eigen::Vector3d::UnitZ();
      std::vector<double> white_range;
      std::vector<double> white;
      std::vector<double> black;
      for (std::size_t i = 0; i < scene.cloud.size(); ++i) {
        const Eigen::Vector3d point = scene.cloud.points_m[i].cast<double>();
        const Eigen::Vector3d ray = point.normalized();
        const double range = normal.dot(scene.lidar_from_board.translation) / normal.dot(ray);
        if (range <= 0.0) continue;
        const Eigen::Vector3d on_board = board_from_lidar * (range * ray);
        if (board.clearance_m(on_board.x(), on_board.y()) < 0.02) continue;
        (board.is_white(on_board.x(), on_board.y()) ? white : black)
            .push_back(scene.cloud.intensity[i]);
        if (board.is_white(on_board.x(), on_board.y())) white_range.push_back(point.norm() - range);
      }
      ASSERT_GT(white.size(), 100U);
      ASSERT_GT(black.size(), 15U);
      EXPECT_NEAR(rms(white_range), 0.008, 0.0015);
      EXPECT_NEAR(median(white_range), 0.0, 0.002);
      EXPECT_NEAR(median(white), 125.0, 6.0);
      EXPECT_NEAR(median(black), 10.5, 3.0);
    }
  }
}

TEST(Simulator, BoardCanBeLeftOut) {
  SimulationOptions options = small_options();
  options.scenes = 1;
  options.placement.board = false;
  const auto rig = simulate(options, {});
  ASSERT_TRUE(rig.ok());
  EXPECT_FALSE(rig->scenes[0].has_board);
}

TEST(Simulator, StopsBetweenScenes) {
  SimulationOptions options = small_options();
  options.scenes = 4;
  std::stop_source stop;
  RunContext context;
  context.stop = stop.get_token();
  context.threads = 1;
  int taken = 0;
  const Status status =
      simulate_each(*Simulator::create(options), context, [&](int, const SimulatedScene&) {
        ++taken;
        stop.request_stop();
        return Status(Done{});
      });
  ASSERT_FALSE(status.ok());
  EXPECT_EQ(status.error().kind, ErrorKind::kCancelled);
  EXPECT_EQ(taken, 1);
}

TEST(Simulator, RefusesBadOptionsAndSceneNumbers) {
  SimulationOptions options = small_options();
  EXPECT_FALSE(Simulator::create(options)->simulate_scene(2, {}).ok());
  EXPECT_FALSE(Simulator::create(options)->simulate_scene(-1, {}).ok());
  options.scenes = 0;
  const auto rig = simulate(options, {});
  ASSERT_FALSE(rig.ok());
  EXPECT_EQ(rig.error().kind, ErrorKind::kUsage);
}

TEST(Simulator, NamesScenes) {
  SimulationOptions options = small_options();
  options.scenes = 26;
  EXPECT_EQ(Simulator::create(options)->scene_name(25), "Z");
  options.scenes = 27;
  EXPECT_EQ(Simulator::create(options)->scene_name(9), "S010");
}

TEST(Simulator, ReportsProgressAndStopsAtTheReceiversError) {
  SimulationOptions options = small_options();
  RunContext context;
  context.threads = 1;
  double last = 0.0;
  context.progress = [&](const Progress& progress) { last = progress.fraction; };
  int taken = 0;
  const auto simulator = Simulator::create(options);
  ASSERT_TRUE(simulate_each(*simulator, context, [&](int, const SimulatedScene&) {
                ++taken;
                return Status(Done{});
              }).ok());
  EXPECT_EQ(taken, 2);
  EXPECT_EQ(last, 1.0);
  const Status status = simulate_each(*simulator, context, [&](int, const SimulatedScene&) {
    ++taken;
    return Status(Error::output(Message("disk full")));
  });
  ASSERT_FALSE(status.ok());
  EXPECT_EQ(status.error().message.text(), "disk full");
  EXPECT_EQ(taken, 3);
}

}  // namespace
}  // namespace lvcalib::simulation
