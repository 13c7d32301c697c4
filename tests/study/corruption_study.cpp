// SPDX-License-Identifier: GPL-3.0-or-later
// Corrupts simulated rigs in many ways and says what the calibration makes of it: right, doubted,
// or silently wrong. One line per rig and kind, the table by families at the end.
//
//   corruption_study [RIGS] [FIRST_SEED] [FOLDER] [KIND] [FIRST_INDEX]
//
// Rig k, counted from FIRST_INDEX (0), takes the k-th of three scanners in turn and three to six
// scenes, and from the fourth on a single tag, a ChArUco board and a checkerboard in turn instead
// of the board with circles; seeds are consecutive. With KIND only corruptions whose name holds the
// word. Every run is a process of its own, so that a crash is counted and not the end.
#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <string>

#include <sys/wait.h>
#include <unistd.h>

#include "evidence_rigs.h"
#include "simulation/simulator.h"
#include "support/corruptions.h"
#include "support/ordinary_boards.h"

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
  if (options.lidar.kind != LidarKind::kSpinning) options.lidar.points = 60'000;
  constexpr int kWithCircles = 3;
  const std::array others = {test::single_tag_target, test::charuco_target,
                             test::checkerboard_target};
  if (index >= kWithCircles)
    options.target = others[static_cast<std::size_t>(index - kWithCircles) % others.size()]();
  return options;
}

// What the process of one run tells by its exit status.
enum Told { kApplies = 1, kSilent = 2, kRight = 4, kUndiagnosed = 8, kAbsurd = 16 };

int tell(const test::CorruptionOutcome& out, const test::Corruption& kind, std::uint64_t seed) {
  if (!out.applies) return 0;
  constexpr std::array kNames = {"right", "doubted", "SILENTLY WRONG"};
  std::printf("%llu; %s; %s; %s; %.2f mm %.3f mrad %.1f sigma; %s; %s\n",
              static_cast<unsigned long long>(seed), kind.name.c_str(),
              kNames[static_cast<std::size_t>(out.outcome)], out.quality.c_str(), out.error_mm,
              out.error_mrad, out.sigmas,
              std::string(out.diagnosed ? "diagnosed" : "NOT DIAGNOSED")
                  .append(out.absurd ? ", ABSURD" : "")
                  .c_str(),
              out.said.substr(0, 700).c_str());
  return kApplies | (out.outcome == test::Outcome::kSilentlyWrong ? kSilent : 0) |
         (out.outcome == test::Outcome::kRight ? kRight : 0) | (out.diagnosed ? 0 : kUndiagnosed) |
         (out.absurd ? kAbsurd : 0);
}

struct Count {
  int kinds = 0, runs = 0, right = 0, silent = 0, crashed = 0, absurd = 0;
  int with_diagnosis = 0, undiagnosed = 0;
};

void add(Count& count, int told, bool crashed, bool has_words) {
  if (crashed) ++count.crashed;
  if (!crashed && (told & kApplies) == 0) return;
  ++count.runs;
  count.right += (told & kRight) != 0 ? 1 : 0;
  count.silent += (told & kSilent) != 0 ? 1 : 0;
  count.absurd += (told & kAbsurd) != 0 ? 1 : 0;
  if (!has_words) return;
  ++count.with_diagnosis;
  count.undiagnosed += crashed || (told & kUndiagnosed) != 0 ? 1 : 0;
}

void print_row(const std::string& name, const Count& c) {
  std::printf("| %s | %d | %d | %d | %s | %s | %d | %d |\n", name.c_str(), c.kinds, c.runs, c.right,
              study::share_text(c.silent, c.runs).c_str(),
              study::share_text(c.with_diagnosis - c.undiagnosed, c.with_diagnosis).c_str(),
              c.crashed, c.absurd);
}

}  // namespace

int main(int argc, char** argv) {
  const int rigs = argc > 1 ? std::atoi(argv[1]) : 5;
  const auto first = static_cast<std::uint64_t>(argc > 2 ? std::atoll(argv[2]) : 960000);
  const std::filesystem::path folder =
      argc > 3 ? argv[3] : std::filesystem::temp_directory_path() / "corruption_study";
  const std::string wanted = argc > 4 ? argv[4] : "";
  const int first_index = argc > 5 ? std::atoi(argv[5]) : 0;
  std::filesystem::create_directories(folder);
  std::map<test::CorruptionFamily, Count> families;
  Count all;
  for (int k = 0; k < rigs; ++k) {
    const std::uint64_t seed = first + static_cast<std::uint64_t>(k);
    const auto rig = simulation::simulate(rig_options(first_index + k, seed), {});
    if (!rig) {
      std::printf("%d: %s\n", k, rig.error().text().c_str());
      continue;
    }
    for (const test::Corruption& corruption : test::corruptions()) {
      if (corruption.name.find(wanted) == std::string::npos) continue;
      std::fflush(stdout);
      const pid_t child = fork();
      if (child == 0) {
        const int told = tell(test::run_corruption(*rig, corruption, folder), corruption, seed);
        std::fflush(stdout);
        _exit(told);
      }
      int status = 0;
      if (child < 0 || waitpid(child, &status, 0) != child) return EXIT_FAILURE;
      const bool crashed = !WIFEXITED(status);
      if (crashed)
        std::printf("%llu; %s; CRASHED\n", static_cast<unsigned long long>(seed),
                    corruption.name.c_str());
      const int told = crashed ? 0 : WEXITSTATUS(status);
      for (Count* count : {&families[corruption.family], &all}) {
        if (k == 0) ++count->kinds;
        add(*count, told, crashed, !corruption.diagnosis.empty());
      }
    }
  }
  std::printf(
      "| kinds of | kinds | runs | good and right | silently wrong | diagnosed | crashed | "
      "absurd numbers |\n| --- | --- | --- | --- | --- | --- | --- | --- |\n");
  for (const auto& [family, count] : families) print_row(name_of(family), count);
  print_row("all", all);
  return 0;
}
