// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/simulator.h"

#include <cstdio>
#include <mutex>
#include <optional>
#include <utility>

#include "base/parallel.h"
#include "simulation/beam.h"
#include "simulation/board_placement.h"
#include "simulation/disturbances/planted_effects.h"
#include "simulation/printed_board.h"
#include "simulation/rig.h"
#include "simulation/room_builder.h"
#include "simulation/scan_pattern.h"
#include "simulation/seeds.h"

namespace lvcalib::simulation {

Simulator::Simulator(const SimulationOptions& options) {
  rig_.options = options;
  rig_.target = options.target;
  rig_.camera = random_camera(options.image, random_for(options.seed, -1, Purpose::kCamera));
  rig_.camera_from_lidar = random_mount(random_for(options.seed, -1, Purpose::kMount));
  planted_ = std::make_shared<const PlantedEffects>(plant_effects(options, rig_.camera));
  rig_.effect_details = planted_->details;
  board_ = std::make_shared<const PrintedBoard>(options.target, planted_->board);
}

Result<Simulator> Simulator::create(const SimulationOptions& options) {
  if (Status status = check(options); !status) return status.error();
  return Simulator(options);
}

std::string Simulator::scene_name(int scene) const {
  if (rig_.options.scenes <= 26) return std::string(1, static_cast<char>('A' + scene));
  char name[16];
  std::snprintf(name, sizeof name, "S%03d", scene + 1);
  return name;
}

Result<SimulatedScene> Simulator::simulate_scene(int scene, const RunContext& context) const {
  const SimulationOptions& options = rig_.options;
  if (scene < 0 || scene >= options.scenes) {
    return Error::usage(
        Message("scene %1 does not exist, expected 0 to %2", scene, options.scenes - 1));
  }
  const auto random = [&](Purpose purpose) { return random_for(options.seed, scene, purpose); };
  const ScanPattern pattern(options.lidar, random(Purpose::kScan));
  const auto& wanted = options.placement.lidar_from_board;
  const auto number = static_cast<std::size_t>(scene);
  auto placed = number < wanted.size() ? Result<Rigid3>(wanted[number])
                                       : place_board(options, rig_.camera, rig_.camera_from_lidar,
                                                     pattern, scene, random(Purpose::kPlacement));
  if (!placed) return placed.error();
  SimulatedScene out;
  out.name = scene_name(scene);
  out.has_board = options.placement.board;
  out.lidar_from_board = *placed;
  out.camera_from_board = rig_.camera_from_lidar * *placed;

  const Eigen::Vector3d camera_in_lidar = rig_.camera_from_lidar.inverse().translation;
  const Room room =
      build_room(options, *board_, out.lidar_from_board, camera_in_lidar, random(Purpose::kRoom));
  const RayCaster caster(room, Eigen::Vector3d::Zero());
  out.cloud = scan(options.lidar, pattern, caster, random(Purpose::kBeam), context.stop,
                   {*planted_, scene * RangeDisturbance::kSceneIntervalS});
  if (context.stopped()) return Error::cancelled();
  out.image = photograph(options.image, {rig_.camera, rig_.camera_from_lidar, planted_->camera},
                         room, random(Purpose::kImage), context.stop);
  if (context.stopped()) return Error::cancelled();
  return out;
}

Status simulate_each(const Simulator& simulator, const RunContext& context,
                     const std::function<Status(int, SimulatedScene)>& take) {
  const int count = simulator.rig().options.scenes;
  std::mutex mutex;
  std::optional<Error> failure;
  int done = 0;
  const auto failed = [&] {
    const std::lock_guard lock(mutex);
    return failure.has_value();
  };
  const auto work = [&](std::size_t index) {
    if (failed()) return;
    const int scene = static_cast<int>(index);
    auto result = simulator.simulate_scene(scene, context);
    const std::lock_guard lock(mutex);
    if (failure) return;
    if (!result) {
      failure = result.error();
      return;
    }
    const std::string name = result->name;
    if (Status status = take(scene, std::move(*result)); !status) {
      failure = status.error();
      return;
    }
    ++done;
    context.report("simulate", static_cast<double>(done) / count, Message("scene %1", name));
  };
  parallel_for(static_cast<std::size_t>(count), context.thread_count(), work);
  if (failure) return *failure;
  return Done{};
}

Result<SimulatedRig> simulate(const SimulationOptions& options, const RunContext& context) {
  auto simulator = Simulator::create(options);
  if (!simulator) return simulator.error();
  SimulatedRig rig = simulator->rig();
  rig.scenes.resize(static_cast<std::size_t>(options.scenes));
  const Status status = simulate_each(*simulator, context, [&](int scene, SimulatedScene result) {
    rig.scenes[static_cast<std::size_t>(scene)] = std::move(result);
    return Status(Done{});
  });
  if (!status) return status.error();
  return rig;
}

}  // namespace lvcalib::simulation
