// SPDX-License-Identifier: GPL-3.0-or-later
// Checks calibrations by the edges of simulated rooms without a board: how often a right one is
// accused, whether the stated intervals cover, and how large an error is noticed.
//
//   edge_study [PLACES] [FIRST_SEED] [VIEWS]
//
// Each place is seen by one of three scanners in turn, from VIEWS rooms (1). Beside the true pose
// one is checked that is turned by 5 mrad and one that is turned by 10 mrad and shifted by 20 mm.
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "base/random.h"
#include "base/statistics.h"
#include "simulation/simulator.h"
#include "verification/edge_agreement.h"

namespace {

using namespace lvcalib;

simulation::SimulationOptions place_options(int index, std::uint64_t seed, int views) {
  using simulation::LidarKind;
  constexpr LidarKind kKinds[] = {LidarKind::kAvia, LidarKind::kRosette, LidarKind::kSpinning};
  simulation::SimulationOptions options;
  options.seed = seed;
  options.scenes = views;
  options.lidar.kind = kKinds[index % 3];
  options.placement.board = false;
  return options;
}

Vector6d random_offset(double metres, double radians, Random& random) {
  Vector6d out;
  for (int k = 0; k < 6; ++k) out(k) = random.normal();
  out.head<3>() *= metres / out.head<3>().norm();
  out.tail<3>() *= radians / out.tail<3>().norm();
  return out;
}

struct Count {
  int checks = 0, agrees = 0, contradicts = 0;
};

void add(Count& count, const EdgeCheck& check) {
  ++count.checks;
  count.agrees += check.verdict == EdgeVerdict::kAgrees ? 1 : 0;
  count.contradicts += check.verdict == EdgeVerdict::kContradicts ? 1 : 0;
}

void print(const char* name, const Count& c) {
  std::printf("| %s | %d | %d | %d | %d |\n", name, c.checks, c.agrees, c.contradicts,
              c.checks - c.agrees - c.contradicts);
}

}  // namespace

int main(int argc, char** argv) {
  const int places = argc > 1 ? std::atoi(argv[1]) : 30;
  const auto first = static_cast<std::uint64_t>(argc > 2 ? std::atoll(argv[2]) : 1);
  const int views = argc > 3 ? std::atoi(argv[3]) : 1;
  Count right, turned, moved;
  int inside = 0, components = 0;
  std::vector<double> off_px, stated_px, turns, shifts;
  for (int k = 0; k < places; ++k) {
    const std::uint64_t seed = first + static_cast<std::uint64_t>(k);
    const auto rig = simulation::simulate(place_options(k, seed, views), {});
    if (!rig) {
      std::printf("%s\n", rig.error().text().c_str());
      continue;
    }
    std::vector<EdgeView> seen;
    for (const simulation::SimulatedScene& scene : rig->scenes) {
      GrayImage image{scene.image.width_px, scene.image.height_px, {}};
      image.pixels.assign(scene.image.pixels.begin(), scene.image.pixels.end());
      auto view = edge_view(scene.name, image, scene.cloud, rig->camera, rig->camera_from_lidar);
      if (view) seen.push_back(std::move(*view));
    }
    const auto check = [&](const Rigid3& pose) {
      return check_edges(seen, rig->camera, pose, {}, {});
    };
    const auto truth = check(rig->camera_from_lidar);
    if (!truth) {
      std::printf("%s\n", truth.error().text().c_str());
      continue;
    }
    add(right, *truth);
    off_px.push_back(truth->offset_px);
    stated_px.push_back(truth->offset_sigma_px);
    turns.push_back(1e3 * truth->offset.tail<3>().norm());
    shifts.push_back(1e3 * truth->offset.head<3>().norm());
    for (int i = 0; i < 6; ++i, ++components)
      inside += std::abs(truth->offset(i)) < 1.96 * std::sqrt(truth->covariance(i, i)) ? 1 : 0;
    Random random(seed, 77);
    const auto small =
        check(se3_exp(random_offset(0.0 + 1e-9, 0.005, random)) * rig->camera_from_lidar);
    const auto large = check(se3_exp(random_offset(0.02, 0.010, random)) * rig->camera_from_lidar);
    if (small) add(turned, *small);
    if (large) add(moved, *large);
    std::printf(
        "%llu: score %.3f ± %.3f (chance %.2f, %zu edges); off %.2f ± %.2f px, gain %.3f ± "
        "%.3f, %.2f mrad "
        "%.1f mm, widening %.2f mrad, notices %.1f mrad; %s | turned: %s off %.2f px gain %.3f ± "
        "%.3f | %s off %.2f "
        "px, left %.2f mrad\n",
        static_cast<unsigned long long>(seed), truth->given.score, truth->given.sigma,
        truth->given.chance, truth->given.edges, truth->offset_px, truth->offset_sigma_px,
        truth->gain, truth->gain_sigma, turns.back(), shifts.back(), truth->widening_mrad,
        1e3 * truth->noticed_turn_rad.maxCoeff(), name_of(truth->verdict).c_str(),
        small ? name_of(small->verdict).c_str() : "–", small ? small->offset_px : 0.0,
        small ? small->gain : 0.0, small ? small->gain_sigma : 0.0,
        large ? name_of(large->verdict).c_str() : "–", large ? large->offset_px : 0.0,
        large ? 1e3 * rotation_distance_rad(large->best_pose, rig->camera_from_lidar) : 0.0);
    std::fflush(stdout);
  }
  std::printf("\n| pose | checks | agrees | contradicts | cannot tell |\n|---|---|---|---|---|\n");
  print("the true one", right);
  print("turned by 5 mrad", turned);
  print("turned by 10 mrad, shifted by 20 mm", moved);
  std::printf(
      "95 %% intervals cover the truth in %.1f %% of %d components; median offset %.2f px (stated "
      "%.2f), %.2f mrad, %.1f mm\n",
      100.0 * inside / std::max(1, components), components, median(off_px), median(stated_px),
      median(turns), median(shifts));
  return 0;
}
