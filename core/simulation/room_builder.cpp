// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/room_builder.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/units.h"
#include "simulation/board_placement.h"

namespace lvcalib::simulation {
namespace {

constexpr double kBoardThickness = 0.008;  // Between a board and the wall it hangs on.
constexpr double kStandGap = 0.03;         // Between the board and its stand.

// Axis-aligned limits in the room frame: x ahead, y left, z up, origin at the LiDAR.
struct Limits {
  Eigen::Vector3d low, high;
};

class RoomBuilder {
 public:
  RoomBuilder(const SimulationOptions& options, const PrintedBoard& board,
              const Rigid3& lidar_from_board, const Eigen::Vector3d& camera, Random random)
      : options_(options),
        board_(board),
        lidar_from_board_(lidar_from_board),
        camera_(camera),
        random_(random) {}

  Room build() {
    turn_room();
    set_limits();
    add_walls();
    if (options_.placement.board) {
      add_board();
      if (!options_.placement.flush_on_wall) add_stand();
    }
    if (options_.placement.decoy) add_decoy();
    if (options_.placement.clutter) {
      const int boxes = 2 + static_cast<int>(random_.below(3));
      for (int i = 0; i < boxes; ++i) add_box();
    }
    const double left = random_.uniform(-0.6, 0.6);
    const Eigen::Vector3d lamp(random_.uniform(-0.8, -0.2), left, 1.0);
    room_.light = (lidar_from_room_ * lamp).normalized();
    return room_;
  }

 private:
  void turn_room() {
    // One draw a statement: in which order a compiler evaluates arguments is its own choice.
    const double yaw = random_.uniform(-12.0, 12.0);
    const double pitch = random_.normal(0.0, 1.0);
    const Eigen::Vector3d turn(random_.normal(0.0, 1.0), pitch, yaw);
    lidar_from_room_ = so3_exp(turn * kRadPerDeg).toRotationMatrix();
    if (!options_.placement.flush_on_wall) return;
    const Eigen::Vector3d ahead = -(lidar_from_board_.rotation * Eigen::Vector3d::UnitZ());
    const Eigen::Vector3d left = Eigen::Vector3d::UnitZ().cross(ahead).normalized();
    lidar_from_room_ << ahead, left, ahead.cross(left);
  }

  void set_limits() {
    Limits board{Eigen::Vector3d::Constant(1e9), Eigen::Vector3d::Constant(-1e9)};
    for (const Eigen::Vector3d& point : outline_points(options_.target, 2)) {
      const Eigen::Vector3d in_room = lidar_from_room_.transpose() * (lidar_from_board_ * point);
      board.low = board.low.cwiseMin(in_room);
      board.high = board.high.cwiseMax(in_room);
    }
    const double gap = options_.placement.flush_on_wall ? kBoardThickness : random_.uniform(0.4, 3);
    limits_.high.x() = board.high.x() + gap;
    limits_.high.y() = std::max(board.high.y() + 0.4, random_.uniform(1.8, 4.0));
    limits_.high.z() = std::max(board.high.z() + 0.1, random_.uniform(1.3, 1.9));
    limits_.low.x() = -random_.uniform(1.5, 4.0);
    limits_.low.y() = std::min(board.low.y() - 0.4, -random_.uniform(1.8, 4.0));
    limits_.low.z() = std::min(board.low.z() - 0.05, -random_.uniform(0.9, 1.4));
  }

  Texture texture(Texture::Kind kind, double base, double contrast, double scale_m) {
    return {kind, base, contrast, scale_m, random_.bits()};
  }

  // A rectangle given in the room frame.
  void add(const Eigen::Vector3d& center, const Eigen::Vector3d& u, const Eigen::Vector3d& v,
           double half_u, double half_v, const Texture& texture) {
    room_.surfaces.push_back({lidar_from_room_ * center, lidar_from_room_ * u, lidar_from_room_ * v,
                              half_u, half_v, texture, nullptr});
  }

  void add_walls() {
    const Eigen::Vector3d x = Eigen::Vector3d::UnitX();
    const Eigen::Vector3d y = Eigen::Vector3d::UnitY();
    const Eigen::Vector3d z = Eigen::Vector3d::UnitZ();
    const Eigen::Vector3d middle = 0.5 * (limits_.low + limits_.high);
    // Slightly larger than the room, so that no ray slips through a seam.
    const Eigen::Vector3d half =
        0.5 * (limits_.high - limits_.low) + Eigen::Vector3d::Constant(0.01);
    for (const Eigen::Vector3d& limit : {limits_.low, limits_.high}) {
      const double tone = random_.uniform(0.4, 0.7);
      add({limit.x(), middle.y(), middle.z()}, y, z, half.y(), half.z(),
          texture(Texture::Kind::kClouds, tone, random_.uniform(0.05, 0.3), 0.25));
      add({middle.x(), limit.y(), middle.z()}, x, z, half.x(), half.z(),
          texture(Texture::Kind::kClouds, random_.uniform(0.4, 0.7), 0.15, 0.4));
    }
    add({middle.x(), middle.y(), limits_.low.z()}, x, y, half.x(), half.y(),
        texture(Texture::Kind::kStripes, random_.uniform(0.12, 0.3), 0.1, 0.15));
    add({middle.x(), middle.y(), limits_.high.z()}, x, y, half.x(), half.y(),
        texture(Texture::Kind::kClouds, random_.uniform(0.5, 0.7), 0.05, 0.6));
  }

  void add_board() {
    const Eigen::Vector2d center = board_.outline().center_m();
    const Eigen::Vector2d half = 0.5 * board_.outline().size_m();
    const Eigen::Matrix3d rotation = lidar_from_board_.rotation.toRotationMatrix();
    Surface surface;
    surface.center_m = lidar_from_board_ * Eigen::Vector3d(center.x(), center.y(), 0.0);
    surface.u = rotation.col(0);
    surface.v = rotation.col(1);
    surface.half_u_m = half.x();
    surface.half_v_m = half.y();
    surface.board = &board_;
    room_.surfaces.push_back(surface);
  }

  // A post from just behind the board's lower edge down to the floor.
  void add_stand() {
    const Eigen::Vector3d down = -lidar_from_room_.col(2);
    const Eigen::Vector3d down_on_board = lidar_from_board_.rotation.inverse() * down;
    const Eigen::Vector2d half = 0.5 * board_.outline().size_m();
    const Eigen::Vector2d slope(down_on_board.x(), down_on_board.y());
    const double reach = std::min(half.x() / std::max(1e-9, std::abs(slope.x())),
                                  half.y() / std::max(1e-9, std::abs(slope.y())));
    const Eigen::Vector2d edge = board_.outline().center_m() + reach * slope;
    const Eigen::Vector3d top =
        lidar_from_room_.transpose() *
        (lidar_from_board_ * Eigen::Vector3d(edge.x(), edge.y(), -kStandGap));
    const double half_length = 0.5 * (top.z() - limits_.low.z());
    if (half_length <= 0.0) return;
    const Texture tone = texture(Texture::Kind::kPlain, random_.uniform(0.1, 0.4), 0.0, 1.0);
    const double half_width = 0.02;
    const Eigen::Vector3d center(top.x(), top.y(), top.z() - half_length);
    add(center, Eigen::Vector3d::UnitY(), Eigen::Vector3d::UnitZ(), half_width, half_length, tone);
    add(center, Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitZ(), half_width, half_length, tone);
  }

  // Whether a ball (LiDAR frame) can stand somewhere without hiding the board from a sensor.
  [[nodiscard]] bool leaves_board_free(const Eigen::Vector3d& center, double radius) const {
    if (!options_.placement.board) return true;
    const Eigen::Vector2d middle = board_.outline().center_m();
    const Eigen::Vector3d board = lidar_from_board_ * Eigen::Vector3d(middle.x(), middle.y(), 0.0);
    const double board_radius = 0.5 * board_.outline().size_m().norm();
    if ((center - board).norm() <= radius + board_radius) return false;
    for (const Eigen::Vector3d& eye : {Eigen::Vector3d(Eigen::Vector3d::Zero()), camera_}) {
      const Eigen::Vector3d a = center - eye;
      const Eigen::Vector3d b = board - eye;
      if (a.norm() <= radius + 0.3) return false;
      if (a.norm() - radius > b.norm() + board_radius) continue;
      const double between = std::acos(std::clamp(a.dot(b) / (a.norm() * b.norm()), -1.0, 1.0));
      if (between <
          std::asin(radius / a.norm()) + std::asin(std::min(1.0, board_radius / b.norm())))
        return false;
    }
    return true;
  }

  [[nodiscard]] bool within_room(const Eigen::Vector3d& center, double radius) const {
    return ((center.array() - radius) > limits_.low.array()).all() &&
           ((center.array() + radius) < limits_.high.array()).all();
  }

  Texture decoy_print() {
    switch (random_.below(3)) {
      case 0:
        return texture(Texture::Kind::kPlain, random_.uniform(0.5, 0.85), 0.0, 1.0);
      case 1:
        return texture(Texture::Kind::kBlocks, 0.45, 0.4, random_.uniform(0.05, 0.12));
      default:
        return texture(Texture::Kind::kClouds, 0.45, 0.45, random_.uniform(0.08, 0.25));
    }
  }

  // A panel of the board's size, somewhere ahead, facing the rig roughly.
  void add_decoy() {
    const Eigen::Vector2d half = 0.5 * board_.outline().size_m();
    const Texture print = decoy_print();
    for (int attempt = 0; attempt < 400; ++attempt) {
      const double azimuth = random_.uniform(-40.0, 40.0) * kRadPerDeg;
      const double distance = random_.uniform(1.8, 5.5);
      const Eigen::Vector3d center(distance * std::cos(azimuth), distance * std::sin(azimuth),
                                   distance * std::tan(random_.uniform(-10.0, 12.0) * kRadPerDeg));
      const double yaw = azimuth + random_.uniform(-40.0, 40.0) * kRadPerDeg;
      const double pitch = random_.uniform(-20.0, 20.0) * kRadPerDeg;
      if (!within_room(center, half.norm()) ||
          !leaves_board_free(lidar_from_room_ * center, half.norm())) {
        continue;
      }
      const Eigen::Vector3d u(std::sin(yaw), -std::cos(yaw), 0.0);
      const Eigen::Vector3d v(std::cos(yaw) * std::sin(pitch), std::sin(yaw) * std::sin(pitch),
                              std::cos(pitch));
      add(center, u, v, half.x(), half.y(), print);
      return;
    }
  }

  void add_box() {
    const double half_height = random_.uniform(0.15, 0.6);
    const double half_width = random_.uniform(0.12, 0.4);
    const Eigen::Vector3d half(random_.uniform(0.12, 0.4), half_width, half_height);
    const double grain_m = random_.uniform(0.1, 0.3);
    const double contrast = random_.uniform(0.0, 0.3);
    const Texture print =
        texture(Texture::Kind::kClouds, random_.uniform(0.1, 0.7), contrast, grain_m);
    for (int attempt = 0; attempt < 100; ++attempt) {
      const double sideways = random_.uniform(limits_.low.y(), limits_.high.y());
      const Eigen::Vector3d center(random_.uniform(1.0, limits_.high.x()), sideways,
                                   limits_.low.z() + half.z());
      // On the floor: only its sides must keep off the walls.
      Eigen::Vector3d raised = center;
      raised.z() = 0.5 * (limits_.low.z() + limits_.high.z());
      if (!within_room(raised, half.head<2>().norm()) ||
          !leaves_board_free(lidar_from_room_ * center, half.norm())) {
        continue;
      }
      const double yaw = random_.uniform(0.0, std::numbers::pi);
      const Eigen::Vector3d x(std::cos(yaw), std::sin(yaw), 0.0);
      const Eigen::Vector3d y(-std::sin(yaw), std::cos(yaw), 0.0);
      const Eigen::Vector3d z = Eigen::Vector3d::UnitZ();
      for (const double side : {-1.0, 1.0}) {
        add(center + side * half.x() * x, y, z, half.y(), half.z(), print);
        add(center + side * half.y() * y, x, z, half.x(), half.z(), print);
      }
      add(center + half.z() * z, x, y, half.x(), half.y(), print);
      return;
    }
  }

  const SimulationOptions& options_;
  const PrintedBoard& board_;
  const Rigid3& lidar_from_board_;
  Eigen::Vector3d camera_;
  Random random_;
  Eigen::Matrix3d lidar_from_room_ = Eigen::Matrix3d::Identity();
  Limits limits_{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
  Room room_;
};

}  // namespace

Room build_room(const SimulationOptions& options, const PrintedBoard& board,
                const Rigid3& lidar_from_board, const Eigen::Vector3d& camera_in_lidar_m,
                Random random) {
  return RoomBuilder(options, board, lidar_from_board, camera_in_lidar_m, random).build();
}

}  // namespace lvcalib::simulation
