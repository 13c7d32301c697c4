// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulation/disturbances/board.h"

#include <numbers>

#include <gtest/gtest.h>

#include "base/rigid3.h"
#include "planted.h"

namespace lvcalib::simulation {
namespace {

TEST(BoardDisturbance, BowLiftsTheMiddleAndLeavesTheEdges) {
  const PlantedEffects planted = plant({{"board_bow", 2}});
  const auto& noted = planted.details.at("board_bow");
  const double bow_y = noted.at("bow_y_mm")[0];
  const double twist = noted.at("twist_mm")[0];
  const BoardOutline outline = Target{}.outline();
  const Eigen::Vector2d center = outline.center_m();
  const Eigen::Vector2d half = 0.5 * outline.size_m();
  const auto height_mm = [&](double u, double v) {
    return 1e3 * planted.board.height_m(center.x() + u * half.x(), center.y() + v * half.y());
  };
  EXPECT_FALSE(planted.board.is_flat());
  EXPECT_NEAR(height_mm(0, 0), 2.0 + bow_y, 1e-9);
  EXPECT_NEAR(height_mm(1, 0), bow_y, 1e-9);
  EXPECT_NEAR(height_mm(-1, 0), bow_y, 1e-9);
  EXPECT_NEAR(height_mm(1, 1), twist, 1e-9);
  EXPECT_NEAR(height_mm(-1, 1), -twist, 1e-9);
  // Half way an elastic strip has 0.75 · 4.75/5 = 0.7125 of its bow.
  EXPECT_NEAR(height_mm(0.5, 0) - bow_y, 1.425, 1e-9);
  EXPECT_LE(std::abs(bow_y), 0.6);
  EXPECT_LE(std::abs(twist), 0.6);
}

TEST(BoardDisturbance, SlopeIsTheDerivativeOfTheHeight) {
  const BoardDisturbance board = plant({{"board_bow", 3}, {"x_board_bump", 4}}).board;
  constexpr double kStep = 1e-6;
  for (double x = 0.0; x < 0.8; x += 0.13) {
    for (double y = 0.0; y < 0.8; y += 0.17) {
      const Eigen::Vector2d slope = board.slope(x, y);
      const double by_x = board.height_m(x + kStep, y) - board.height_m(x - kStep, y);
      const double by_y = board.height_m(x, y + kStep) - board.height_m(x, y - kStep);
      EXPECT_NEAR(slope.x(), by_x / (2 * kStep), 1e-8);
      EXPECT_NEAR(slope.y(), by_y / (2 * kStep), 1e-8);
    }
  }
}

TEST(BoardDisturbance, BumpIsLocal) {
  const PlantedEffects planted = plant({{"x_board_bump", 3}});
  const auto& center = planted.details.at("x_board_bump").at("center_m");
  EXPECT_NEAR(1e3 * planted.board.height_m(center[0], center[1]), 3.0, 1e-9);
  EXPECT_NEAR(1e3 * planted.board.height_m(center[0] + 0.06, center[1]), 3.0 * std::exp(-0.5),
              1e-9);
  EXPECT_LT(1e3 * planted.board.height_m(center[0] + 0.3, center[1]), 1e-4);
  EXPECT_TRUE(Target{}.outline().lower_left_m.x() < center[0]);
}

TEST(BoardDisturbance, RaysMeetTheBentFace) {
  const Target target;
  const PlantedEffects planted = plant({{"board_bow", 5}, {"x_board_bump", -5}});
  const PrintedBoard board(target, planted.board);
  for (const double tilt : {0.0, 0.7, 1.1}) {
    Surface surface = facing_board(3.0, board);
    surface.u = Eigen::Vector3d(std::sin(tilt), -std::cos(tilt), 0.0);
    const Room room{{surface}, Eigen::Vector3d::UnitZ()};
    for (const Eigen::Vector3d& start :
         {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(0.02, 0.05, 0.05)}) {
      const RayCaster caster(room, Eigen::Vector3d::Zero());
      const RayCaster moved(room, start);
      RayCaster::Candidates storage;
      for (double z = -0.3; z < 0.31; z += 0.05) {
        const Eigen::Vector3d direction = Eigen::Vector3d(3.0, 0.3 * z, z).normalized();
        const auto candidates = caster.candidates(direction, 0.0, storage, start.norm());
        const Hit hit = caster.cast(direction, candidates, &start);
        ASSERT_EQ(hit.surface, 0);
        const Eigen::Vector3d point = start + hit.range_m * direction;
        const Eigen::Vector2d on_board = caster.on_board(hit);
        EXPECT_NEAR(surface.normal().dot(point - surface.center_m),
                    planted.board.height_m(on_board.x(), on_board.y()), 1e-6);
        EXPECT_NEAR(surface.u.dot(point - surface.center_m), hit.u_m, 1e-9);
        // The same as from a caster that stands there.
        EXPECT_NEAR(moved.meet_plane(direction, 0).range_m, hit.range_m, 1e-9);
      }
    }
  }
}

TEST(BoardDisturbance, BowShortensRangesByItsHeight) {
  const Target target;
  const PlantedEffects planted = plant({{"board_bow", 2}});
  const PrintedBoard board(target, planted.board);
  const Room room{{facing_board(3.0, board)}, Eigen::Vector3d::UnitZ()};
  const RayCaster caster(room, Eigen::Vector3d::Zero());
  const LidarOptions lidar = quiet(LidarKind::kAvia);
  const double height = 2e-3 + 1e-3 * planted.details.at("board_bow").at("bow_y_mm")[0];
  EXPECT_NEAR(Beam(lidar, caster).fire(Eigen::Vector3d::UnitX(), 0.0).range_m, 3.0 - height, 1e-6);
}

// Where white turns to black on a line through the board, by bisection.
double edge_m(const PrintedBoard& board, Eigen::Vector2d white, Eigen::Vector2d black) {
  const double length = (black - white).norm();
  const Eigen::Vector2d step = (black - white) / length;
  double low = 0.0;
  double high = length;
  for (int i = 0; i < 40; ++i) {
    const Eigen::Vector2d middle = white + 0.5 * (low + high) * step;
    (board.is_white(middle.x(), middle.y()) ? low : high) = 0.5 * (low + high);
  }
  return low;
}

TEST(BoardDisturbance, InkGainGrowsDiscsAndSquares) {
  const Target target;
  const TargetTag tag = target.tags()[5];
  const Eigen::Vector2d node = target.nodes()[4].center_m;
  for (const double gain : {0.4, -0.4}) {
    const PrintedBoard board(target, plant({{"ink_gain", gain}}).board);
    const double disc = edge_m(board, node + Eigen::Vector2d(0.06, 0), node);
    EXPECT_NEAR(1e3 * (0.06 - disc - target.circle_radius_m), gain, 1e-3);
    const Eigen::Vector2d border =
        tag.center_m + Eigen::Vector2d(0, -0.5 * target.tag_size_m + 0.5 * target.tag_bit_m());
    const double square = edge_m(board, border - Eigen::Vector2d(0, 0.03), border);
    EXPECT_NEAR(1e3 * (0.03 - square - 0.5 * target.tag_bit_m()), gain, 1e-3);
  }
}

TEST(BoardDisturbance, PrintScaleMovesThePrintFromTheBoardsCentre) {
  const Target target;
  const PlantedEffects planted = plant({{"print_scale", 5000}});
  const auto& noted = planted.details.at("print_scale");
  const double along_x = 1e-6 * (5000 + 0.5 * noted.at("anisotropy_ppm")[0]);
  const double along_y = 1e-6 * (5000 - 0.5 * noted.at("anisotropy_ppm")[0]);
  const double shear = 1e-6 * noted.at("shear_ppm")[0];
  const PrintedBoard board(target, planted.board);
  const Eigen::Vector2d center = board.outline().center_m();
  for (const TargetNode& node : target.nodes()) {
    const Eigen::Vector2d from_center = node.center_m - center;
    const Eigen::Vector2d expected =
        node.center_m + Eigen::Vector2d(along_x * from_center.x() + shear * from_center.y(),
                                        along_y * from_center.y());
    const auto radius = [&](double x, double y) {
      const Eigen::Vector2d out(x, y);
      return 0.06 - edge_m(board, expected + 0.06 * out, expected);
    };
    // Seen from its centre a disc reaches equally far to both sides.
    EXPECT_NEAR(radius(1, 0), radius(-1, 0), 2e-6) << node.id;
    EXPECT_NEAR(radius(0, 1), radius(0, -1), 2e-6) << node.id;
    EXPECT_NEAR(radius(1, 0), (1.0 + along_x) * target.circle_radius_m, 2e-6);
  }
  EXPECT_EQ(board.outline().size_m(), target.outline().size_m());
}

TEST(BoardDisturbance, ClearanceKnowsThePrintAsItCameOut) {
  const Target target;
  const PrintedBoard board(target, plant({{"print_scale", 20000}, {"ink_gain", 2}}).board);
  Random random(4);
  const Eigen::Vector2d low = board.outline().lower_left_m;
  const Eigen::Vector2d size = board.outline().size_m();
  for (int i = 0; i < 20'000; ++i) {
    const Eigen::Vector2d p =
        low + Eigen::Vector2d(random.uniform() * size.x(), random.uniform() * size.y());
    const double clear = board.clearance_m(p.x(), p.y());
    const double angle = random.uniform(0.0, 2.0 * std::numbers::pi);
    const Eigen::Vector2d q =
        p + random.uniform() * clear * Eigen::Vector2d(std::cos(angle), std::sin(angle));
    ASSERT_EQ(board.is_white(p.x(), p.y()), board.is_white(q.x(), q.y()));
  }
}

}  // namespace
}  // namespace lvcalib::simulation
