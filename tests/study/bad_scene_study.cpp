// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <cstdio>
#include <optional>

#include "evidence_rigs.h"

namespace lvcalib::study {
namespace {

constexpr int kScenes = 5;
constexpr int kBad = 2;

simulation::SimulationOptions rig_options(std::uint64_t seed) {
  simulation::SimulationOptions options;
  options.seed = seed;
  options.scenes = kScenes;
  options.lidar.points = 150'000;
  options.lidar.range_follows_power = false;
  options.image.width_px = 1000;
  options.image.height_px = 640;
  return options;
}

RunContext one_thread() {
  RunContext context;
  context.threads = 1;
  return context;
}

Result<simulation::SimulatedScene> scene_with(const simulation::SimulationOptions& options) {
  auto simulator = simulation::Simulator::create(options);
  if (!simulator) return simulator.error();
  return simulator->simulate_scene(kBad, one_thread());
}

// The bad scene's board is a print 4 % larger.
bool other_size(simulation::SimulatedRig& rig) {
  auto options = rig.options;
  for (double* length :
       {&options.target.tag_size_m, &options.target.circle_radius_m, &options.target.margin_m})
    *length *= 1.04;
  auto scene = scene_with(options);
  if (!scene) return false;
  rig.scenes[kBad] = std::move(*scene);
  return true;
}

// The board has moved by centimetres between cloud and image.
bool moved_board(simulation::SimulatedRig& rig) {
  auto options = rig.options;
  options.placement.min_distance_m += 0.06;
  options.placement.max_tilt_deg += 1.0;
  auto scene = scene_with(options);
  if (!scene) return false;
  const double moved =
      (scene->lidar_from_board.translation - rig.scenes[kBad].lidar_from_board.translation).norm();
  if (moved < 0.01 || moved > 0.2) return false;
  rig.scenes[kBad].cloud = std::move(scene->cloud);
  return true;
}

// The image belongs to another scene.
bool swapped_image(simulation::SimulatedRig& rig) {
  rig.scenes[kBad].image = rig.scenes[kBad + 1].image;
  return true;
}

// Refused, or doubtful (or worse) with a warning that names the scene.
bool found_out(const Result<CalibrationResult>& result, const std::string& name) {
  if (!result) return result.error().text().find("scene " + name) != std::string::npos;
  if (result->quality == Quality::kGood) return false;
  for (const Message& reason : result->quality_reasons) {
    if (reason.text().find("scene " + name) != std::string::npos) return true;
  }
  return false;
}

}  // namespace

void study_bad_scenes(int rigs, std::uint64_t first_seed, const std::filesystem::path& folder) {
  struct Kind {
    const char* name;
    bool (*spoil)(simulation::SimulatedRig&);
    int rigs = 0, found = 0;
  };
  Kind kinds[] = {{"none (kept as good)", nullptr},
                  {"board of another size", &other_size},
                  {"moved board", &moved_board},
                  {"swapped image", &swapped_image}};
  for (int k = 0; k < rigs; ++k) {
    const std::uint64_t seed = first_seed + static_cast<std::uint64_t>(k);
    const auto good = simulation::simulate(rig_options(seed), one_thread());
    if (!good) continue;
    for (Kind& kind : kinds) {
      simulation::SimulatedRig rig = *good;
      if (kind.spoil != nullptr && !kind.spoil(rig)) continue;
      const auto result = calibrate_rig(rig, folder);
      ++kind.rigs;
      const bool right = kind.spoil == nullptr ? result && result->quality == Quality::kGood
                                               : found_out(result, rig.scenes[kBad].name);
      kind.found += right ? 1 : 0;
      if (right) continue;
      std::fprintf(stderr, "seed %llu, %s: %s\n", static_cast<unsigned long long>(seed), kind.name,
                   result ? name_of(result->quality).c_str() : result.error().text().c_str());
      for (const Message& warning : result ? result->warnings : std::vector<Message>{})
        std::fprintf(stderr, "    %s\n", warning.text().c_str());
    }
  }
  std::printf("| bad scene among five | found out: named and doubtful |\n| --- | --- |\n");
  for (const Kind& kind : kinds)
    std::printf("| %s | %s |\n", kind.name, share_text(kind.found, kind.rigs).c_str());
}

}  // namespace lvcalib::study
