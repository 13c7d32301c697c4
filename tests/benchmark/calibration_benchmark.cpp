// SPDX-License-Identifier: GPL-3.0-or-later
// The whole calibration from warm files, its stages, and solving again after a rejection.
// Three simulated scenes with 1920 × 1200 images; the argument is the number of points a scene, so
// that the time per point shows whether the cost is linear.
#include <cstdio>
#include <filesystem>
#include <map>
#include <string>

#include <benchmark/benchmark.h>
#include <unistd.h>

#include "pipeline/calibration.h"
#include "simulation/dataset_writer.h"
#include "simulation/simulator.h"

namespace {

namespace fs = std::filesystem;
using namespace lvcalib;

constexpr int kScenes = 3;

// Datasets of one run, by points a scene; written once.
class Datasets {
 public:
  Datasets()
      : folder_(fs::temp_directory_path() / ("lvcalib_calib_" + std::to_string(::getpid()))) {}
  Datasets(const Datasets&) = delete;
  Datasets& operator=(const Datasets&) = delete;
  ~Datasets() { fs::remove_all(folder_); }

  const fs::path& get(std::int64_t points) {
    const auto [entry, fresh] = paths_.try_emplace(points, folder_ / std::to_string(points));
    if (fresh) write(entry->second, points);
    return entry->second;
  }

 private:
  static void write(const fs::path& path, std::int64_t points);

  fs::path folder_;
  std::map<std::int64_t, fs::path> paths_;
};

Datasets& datasets() {
  static Datasets all;
  return all;
}

void give_up(const Error& error) {
  std::fprintf(stderr, "%s\n", error.text().c_str());
  std::exit(1);
}

void Datasets::write(const fs::path& path, std::int64_t points) {
  simulation::SimulationOptions options;
  options.scenes = kScenes;
  options.lidar.points = static_cast<int>(points);
  options.image.width_px = 1920;
  options.image.height_px = 1200;
  const auto simulator = simulation::Simulator::create(options);
  if (!simulator) give_up(simulator.error());
  fs::create_directories(path.parent_path());
  auto writer = simulation::DatasetWriter::create(simulator->rig(), path, false);
  if (!writer) give_up(writer.error());
  const Status simulated = simulation::simulate_each(
      *simulator, {},
      [&](int, const simulation::SimulatedScene& scene) { return writer->add(scene); });
  if (!simulated) give_up(simulated.error());
  if (const Status status = writer->finish(); !status) give_up(status.error());
}

CalibrationResult calibrated(const fs::path& path) {
  auto dataset = open_dataset(path);
  if (!dataset) give_up(dataset.error());
  auto result = calibrate(*dataset, {}, {});
  if (!result) give_up(result.error());
  return std::move(result).value();
}

void whole_calibration(benchmark::State& state) {
  const fs::path& path = datasets().get(state.range(0));
  calibrated(path);  // warms the files
  StageTimes times;
  for (auto _ : state) times = calibrated(path).times;
  state.SetItemsProcessed(state.iterations() * kScenes * state.range(0));
  // Sums over scenes that run at the same time; of the last run.
  state.counters["load_ms"] = times.load_ms;
  state.counters["detect_ms"] = times.detect_ms;
  state.counters["localize_ms"] = times.localize_ms;
  state.counters["refine_ms"] = times.refine_ms;
  state.counters["optimize_ms"] = times.optimize_ms;
}

// What a user waits for after unticking a scene.
void solve_again(benchmark::State& state) {
  const CalibrationResult result = calibrated(datasets().get(state.range(0)));
  std::vector<bool> use(result.scenes.size(), true);
  for (auto _ : state) {
    use[0] = !use[0];
    auto again = resolve_calibration(result, use, {});
    if (!again) give_up(again.error());
    benchmark::DoNotOptimize(again->extrinsic.rms_px);
  }
}

}  // namespace

BENCHMARK(whole_calibration)
    ->Arg(125'000)
    ->Arg(250'000)
    ->Arg(500'000)
    ->Arg(1'000'000)
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();
BENCHMARK(solve_again)->Arg(125'000)->Unit(benchmark::kMillisecond)->UseRealTime();

BENCHMARK_MAIN();
