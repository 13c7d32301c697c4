// SPDX-License-Identifier: GPL-3.0-or-later
// Corrupts simulated rigs in many ways and says what the calibration makes of it: right, doubted,
// or silently wrong. One line per rig and kind, the summary at the end.
//
//   corruption_study [RIGS] [FIRST_SEED] [FOLDER] [KIND]
//
// Rigs take three scanners in turn and three to six scenes. With KIND only corruptions whose name
// holds the word.
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "simulation/simulator.h"
#include "support/corruptions.h"

namespace {

using namespace lvcalib;

simulation::SimulationOptions rig_options(int index, std::uint64_t seed) {
  using simulation::LidarKind;
  constexpr LidarKind kKinds[] = {LidarKind::kAvia, LidarKind::kRosette, LidarKind::kSpinning};
  simulation::SimulationOptions options;
  options.seed = seed;
  options.scenes = 3 + index % 4;
  options.lidar.kind = kKinds[index % 3];
  options.image.width_px = 800;
  options.image.height_px = 500;
  if (options.lidar.kind != LidarKind::kSpinning) options.lidar.points = 100'000;
  return options;
}

}  // namespace

int main(int argc, char** argv) {
  const int rigs = argc > 1 ? std::atoi(argv[1]) : 5;
  const auto first = static_cast<std::uint64_t>(argc > 2 ? std::atoll(argv[2]) : 960000);
  const std::filesystem::path folder =
      argc > 3 ? argv[3] : std::filesystem::temp_directory_path() / "corruption_study";
  const std::string kind = argc > 4 ? argv[4] : "";
  std::filesystem::create_directories(folder);
  int runs = 0;
  int silent = 0;
  int undiagnosed = 0;
  int clean_doubted = 0;
  for (int k = 0; k < rigs; ++k) {
    const auto rig =
        simulation::simulate(rig_options(k, first + static_cast<std::uint64_t>(k)), {});
    if (!rig) {
      std::printf("%d: %s\n", k, rig.error().text().c_str());
      continue;
    }
    for (const test::Corruption& corruption : test::corruptions()) {
      if (corruption.name.find(kind) == std::string::npos) continue;
      const test::CorruptionOutcome out = test::run_corruption(*rig, corruption, folder);
      constexpr const char* kNames[] = {"right", "doubted", "SILENTLY WRONG"};
      const char* name = kNames[static_cast<int>(out.outcome)];
      std::printf("%llu; %s; %s; %s; %.2f mm %.3f mrad %.1f sigma; %s; %s\n",
                  static_cast<unsigned long long>(first) + static_cast<unsigned>(k),
                  corruption.name.c_str(), name, out.quality.c_str(), out.error_mm, out.error_mrad,
                  out.sigmas, out.diagnosed ? "diagnosed" : "NOT DIAGNOSED",
                  out.said.substr(0, 400).c_str());
      std::fflush(stdout);
      ++runs;
      silent += out.outcome == test::Outcome::kSilentlyWrong ? 1 : 0;
      undiagnosed += out.diagnosed ? 0 : 1;
      clean_doubted += corruption.name == "clean" && out.outcome != test::Outcome::kRight ? 1 : 0;
    }
  }
  std::printf("%d runs; silently wrong %d; without the right diagnosis %d; clean rigs doubted %d\n",
              runs, silent, undiagnosed, clean_doubted);
  return 0;
}
