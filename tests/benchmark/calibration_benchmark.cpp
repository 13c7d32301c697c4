// SPDX-License-Identifier: GPL-3.0-or-later
// The whole calibration from warm files, its stages, solving again after a rejection, the joint
// solve with every scene left out once, how long a calibration takes to stop, and the boundary
// response. Three simulated scenes (of solve_again as many as the second argument says) with
// 1920 × 1200 images; the first argument is the number of points a scene, so that the time per
// point shows whether the cost is linear.
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <map>
#include <stop_token>
#include <string>
#include <thread>

#include <benchmark/benchmark.h>
#include <unistd.h>

#include "pipeline/calibration.h"
#include "simulation/dataset_writer.h"
#include "simulation/simulator.h"
#include "support/synthetic_observations.h"

namespace {

namespace fs = std::filesystem;
using namespace lvcalib;

constexpr int kScenes = 3;

// Datasets of one run, by points a scene and scenes; written once.
class Datasets {
 public:
  Datasets()
      : folder_(fs::temp_directory_path() / ("lvcalib_calib_" + std::to_string(::getpid()))) {}
  Datasets(const Datasets&) = delete;
  Datasets& operator=(const Datasets&) = delete;
  ~Datasets() { fs::remove_all(folder_); }

  const fs::path& get(std::int64_t points, std::int64_t scenes = kScenes) {
    const auto [entry, fresh] = paths_.try_emplace(
        {points, scenes}, folder_ / (std::to_string(points) + "x" + std::to_string(scenes)));
    if (fresh) write(entry->second, points, scenes);
    return entry->second;
  }

 private:
  static void write(const fs::path& path, std::int64_t points, std::int64_t scenes);

  fs::path folder_;
  std::map<std::pair<std::int64_t, std::int64_t>, fs::path> paths_;
};

Datasets& datasets() {
  static Datasets all;
  return all;
}

void give_up(const Error& error) {
  std::fprintf(stderr, "%s\n", error.text().c_str());
  std::exit(1);
}

void Datasets::write(const fs::path& path, std::int64_t points, std::int64_t scenes) {
  simulation::SimulationOptions options;
  options.scenes = static_cast<int>(scenes);
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
  const CalibrationResult result = calibrated(datasets().get(state.range(0), state.range(1)));
  std::vector<bool> use(result.scenes.size(), true);
  for (auto _ : state) {
    use[0] = !use[0];
    auto again = resolve_calibration(result, use, {});
    if (!again) give_up(again.error());
    benchmark::DoNotOptimize(again->extrinsic.rms_px);
  }
}

// The joint solve and as many again, each without one of the scenes.
void leave_one_out(benchmark::State& state) {
  const Target target;
  const Camera camera = test::test_camera();
  const auto scenes = test::observed_scenes(static_cast<int>(state.range(0)), target, camera,
                                            test::test_extrinsic(), {}, 1);
  for (auto _ : state) {
    auto solution = solve_extrinsic({scenes, camera, target, {}});
    if (!solution) give_up(solution.error());
    if (solution->leave_one_out.size() != scenes.size())
      give_up(Error::untrusted(Message("not every scene was left out")));
  }
}

// From the wish to stop, so many milliseconds after the start, until calibrate() is back.
void cancelled(benchmark::State& state) {
  using Clock = std::chrono::steady_clock;
  const auto dataset = open_dataset(datasets().get(state.range(0)));
  if (!dataset) give_up(dataset.error());
  for (auto _ : state) {
    std::stop_source source;
    RunContext context;
    context.stop = source.get_token();
    std::thread run([&] { static_cast<void>(calibrate(*dataset, {}, context)); });
    std::this_thread::sleep_for(std::chrono::milliseconds(state.range(1)));
    const auto asked = Clock::now();
    source.request_stop();
    run.join();
    state.SetIterationTime(std::chrono::duration<double>(Clock::now() - asked).count());
  }
}

void boundary_response(benchmark::State& state) {
  const CalibrationResult result = calibrated(datasets().get(state.range(0)));
  std::vector<ResponseInput> inputs;
  for (const SceneResult& scene : result.scenes) {
    if (scene.refinement) inputs.push_back({scene.name, &scene.board_points, &*scene.refinement});
  }
  for (auto _ : state) {
    auto response = calibrate_boundary_response(inputs, result.target, {}, {});
    if (!response) give_up(response.error());
    benchmark::DoNotOptimize(response->scenes.size());
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
BENCHMARK(solve_again)
    ->Args({125'000, 3})
    ->Args({125'000, 10})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK(leave_one_out)->Arg(10)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(cancelled)
    ->ArgsProduct({{500'000}, {0, 30, 150, 400, 800}})
    ->Unit(benchmark::kMillisecond)
    ->Iterations(5)
    ->UseManualTime();
BENCHMARK(boundary_response)->Arg(500'000)->Unit(benchmark::kMillisecond)->UseRealTime();

BENCHMARK_MAIN();
