// SPDX-License-Identifier: GPL-3.0-or-later
// Registers single simulated boards of every kind, seen by every scanner, from starts that are off
// by up to 60 mm and 5° in the board's plane, and compares with truth and with the Cramér–Rao bound
// of the board's returns. One CSV line per board on standard output, the summary at the end.
//
//   registration_study [BOARDS] [FIRST_SEED]
//
// Board k takes the k-th of six kinds and, after each round of kinds, the next of four scanners;
// seeds are consecutive. The corners are exact, so that what the returns say is all that counts.
// The plane is off by 5 mm and half a degree at most, as a plane fitted to the board would be.
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numbers>
#include <vector>

#include <Eigen/Cholesky>

#include "base/random.h"
#include "base/statistics.h"
#include "information_bound.h"
#include "simulation/simulator.h"
#include "solve/forward_solver.h"
#include "support/ordinary_boards.h"

namespace lvcalib::study {
namespace {

constexpr const char* kKinds[] = {"circles", "grid",           "checkerboard",
                                  "charuco", "legacy charuco", "single tag"};
constexpr const char* kScanners[] = {"rosette", "avia", "spinning 128", "spinning 64"};
constexpr int kKindCount = 6;
constexpr int kScannerCount = 4;

struct BoardOutcome {
  int kind = 0;
  int scanner = 0;
  bool solved = false;
  bool wrong = false;  // Another place of the print, or another turn.
  double in_plane_mm = 0.0;
  double bound_mm = 0.0;
  double spin_mrad = 0.0;
  double chi = 0.0;  // eᵀFe/3 of (u, v, spin).
  double margin = 0.0;
  double time_ms = 0.0;
  std::size_t returns = 0;
};

simulation::SimulationOptions board_options(int index, std::uint64_t seed) {
  using simulation::LidarKind;
  simulation::SimulationOptions options;
  options.seed = seed;
  options.scenes = 1;
  options.image.width_px = 320;
  options.image.height_px = 240;
  options.target.tag_spacing = 0.1 / 0.12;
  switch (index % kKindCount) {
    case 1:
      options.target.type = TargetType::kAprilGrid;
      break;
    case 2:
      options.target = test::checkerboard_target();
      break;
    case 3:
      options.target = test::charuco_target();
      break;
    case 4:
      options.target = test::legacy_charuco_target();
      break;
    case 5:
      options.target = test::single_tag_target();
      break;
    default:
      break;
  }
  constexpr LidarKind kLidars[] = {LidarKind::kRosette, LidarKind::kAvia, LidarKind::kSpinning,
                                   LidarKind::kSpinning};
  const int scanner = (index / kKindCount) % kScannerCount;
  options.lidar.kind = kLidars[scanner];
  if (scanner == 3) options.lidar.lines = 64;
  return options;
}

// T_lidar_board moved on the board's plane, and the plane a little.
Rigid3 moved_start(const Rigid3& lidar_from_board, const Target& target, Random& random) {
  const double degree = std::numbers::pi / 180.0;
  const Eigen::Vector2d c = target.outline().center_m();
  const Eigen::Vector3d center(c.x(), c.y(), 0.0);
  // One draw a statement: compilers evaluate arguments in orders of their own.
  const double off = random.uniform(-0.005, 0.005);
  const double up = random.uniform(-0.06, 0.06);
  const Eigen::Vector3d shift(random.uniform(-0.06, 0.06), up, off);
  const Eigen::Quaterniond turn =
      so3_exp({random.uniform(-0.5, 0.5) * degree, random.uniform(-0.5, 0.5) * degree,
               random.uniform(-5.0, 5.0) * degree});
  return lidar_from_board * Rigid3{turn, center + shift - turn * center};
}

// Corners of the outline, exact, by a camera that sees anything before it.
std::vector<CornerObservation> exact_corners(const simulation::SimulatedRig& rig,
                                             const Rigid3& camera_from_board) {
  const BoardOutline o = rig.target.outline();
  std::vector<CornerObservation> out;
  for (int k = 0; k < 16; ++k) {
    const Eigen::Vector2d at =
        o.lower_left_m + o.size_m().cwiseProduct(Eigen::Vector2d(k % 4, k / 4) / 3.0);
    const auto pixel = rig.camera.project(camera_from_board * Eigen::Vector3d(at.x(), at.y(), 0.0));
    if (pixel) out.push_back({rig.target.first_tag_id + k, 0, at, *pixel, 0.0});
  }
  return out;
}

BoardOutcome run_board(int index, std::uint64_t seed) {
  BoardOutcome outcome;
  outcome.kind = index % kKindCount;
  outcome.scanner = (index / kKindCount) % kScannerCount;
  const auto simulator = simulation::Simulator::create(board_options(index, seed));
  if (!simulator) return outcome;
  const simulation::SimulatedRig& rig = simulator->rig();
  auto scene = simulator->simulate_scene(0, {});
  if (!scene) return outcome;
  Random random(seed + 991);
  const Rigid3 start = moved_start(scene->lidar_from_board, rig.target, random);

  ForwardScene forward;
  forward.board_points = &scene->cloud;
  forward.camera_from_board = scene->camera_from_board;
  forward.lidar_from_board = start;
  forward.corners = exact_corners(rig, scene->camera_from_board);
  const BlurredPrint print(rig.target);
  ForwardOptions options;
  options.sigma_px_floor = 1e-3;
  const auto clock = std::chrono::steady_clock::now();
  const auto solution = solve_forward(
      {{forward}, print, rig.camera, scene->camera_from_board * start.inverse(), 1e-3}, options,
      {});
  outcome.time_ms =
      std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - clock).count();
  if (!solution) return outcome;
  outcome.solved = true;
  outcome.margin = solution->lattice_margin;
  outcome.returns = solution->scenes.front().returns;

  // Left perturbation of T_lidar_board, then what it does in the board's plane at its middle.
  const Rigid3& truth = scene->lidar_from_board;
  const Rigid3 found = solution->state.lidar_from_board(0);
  const Vector6d error = se3_log(found * truth.inverse());
  const Eigen::Vector2d c = rig.target.outline().center_m();
  const Eigen::Vector3d middle = truth * Eigen::Vector3d(c.x(), c.y(), 0.0);
  const Eigen::Matrix3d axes = truth.rotation.toRotationMatrix();
  Eigen::Matrix<double, 3, 6> in_plane;
  in_plane.topLeftCorner<2, 3>() = axes.transpose().topRows<2>();
  in_plane.topRightCorner<2, 3>() = -axes.transpose().topRows<2>() * skew(middle);
  in_plane.bottomLeftCorner<1, 3>().setZero();
  in_plane.bottomRightCorner<1, 3>() = axes.col(2).transpose();
  const Matrix6d covariance = board_information(rig, *scene).ldlt().solve(Matrix6d::Identity());
  const Eigen::Vector3d e = in_plane * error;
  const Eigen::Matrix3d bound = in_plane * covariance * in_plane.transpose();
  outcome.in_plane_mm = 1e3 * e.head<2>().norm();
  outcome.spin_mrad = 1e3 * std::abs(e(2));
  outcome.bound_mm = 1e3 * std::sqrt(bound.topLeftCorner<2, 2>().trace());
  outcome.chi = e.dot(bound.ldlt().solve(e)) / 3.0;
  outcome.wrong = outcome.in_plane_mm > 0.5e3 * kOtherPlace_m || outcome.spin_mrad > 35.0;
  return outcome;
}

void summarize_row(const char* name, const std::vector<const BoardOutcome*>& rows) {
  std::vector<double> errors, spins, bounds, times;
  double chi = 0.0;
  int wrong = 0;
  int unsolved = 0;
  for (const BoardOutcome* o : rows) {
    unsolved += o->solved ? 0 : 1;
    wrong += o->wrong ? 1 : 0;
    if (!o->solved || o->wrong) continue;
    errors.push_back(o->in_plane_mm);
    spins.push_back(o->spin_mrad);
    bounds.push_back(o->bound_mm);
    times.push_back(o->time_ms);
    chi += o->chi;
  }
  if (rows.empty() || errors.empty()) return;
  std::printf("| %s | %zu | %d | %d | %.3f | %.3f | %.2f | %.2f | %.0f |\n", name, rows.size(),
              unsolved, wrong, rms(errors), rms(bounds), rms(errors) / rms(bounds),
              std::sqrt(chi / static_cast<double>(errors.size())), median(times));
}

void summarize(const std::vector<BoardOutcome>& all) {
  std::printf(
      "\n| boards | number | not solved | wrong place | in-plane RMS, mm | bound, mm | ratio | "
      "sqrt(mean e'Fe/3) | time, ms |\n");
  const auto of = [&](auto pick) {
    std::vector<const BoardOutcome*> out;
    for (const BoardOutcome& o : all) {
      if (pick(o)) out.push_back(&o);
    }
    return out;
  };
  for (int kind = 0; kind < kKindCount; ++kind)
    summarize_row(kKinds[kind], of([&](const BoardOutcome& o) { return o.kind == kind; }));
  for (int scanner = 0; scanner < kScannerCount; ++scanner)
    summarize_row(kScanners[scanner],
                  of([&](const BoardOutcome& o) { return o.scanner == scanner; }));
  summarize_row("all", of([](const BoardOutcome&) { return true; }));
}

}  // namespace
}  // namespace lvcalib::study

int main(int argc, char** argv) {
  using namespace lvcalib::study;
  const int boards = argc > 1 ? std::atoi(argv[1]) : 300;
  const std::uint64_t first = argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 1;
  std::vector<BoardOutcome> all;
  std::printf(
      "seed,kind,scanner,solved,wrong,in_plane_mm,bound_mm,spin_mrad,chi,margin,returns,time_ms\n");
  for (int k = 0; k < boards; ++k) {
    const std::uint64_t seed = first + static_cast<std::uint64_t>(k);
    all.push_back(run_board(k, seed));
    const BoardOutcome& o = all.back();
    std::printf("%llu,%s,%s,%d,%d,%.4f,%.4f,%.4f,%.3f,%.1f,%zu,%.0f\n",
                static_cast<unsigned long long>(seed), kKinds[o.kind], kScanners[o.scanner],
                o.solved ? 1 : 0, o.wrong ? 1 : 0, o.in_plane_mm, o.bound_mm, o.spin_mrad, o.chi,
                o.margin, o.returns, o.time_ms);
    std::fflush(stdout);
  }
  summarize(all);
  return 0;
}
