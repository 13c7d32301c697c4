// SPDX-License-Identifier: GPL-3.0-or-later
// Discovery on six simulated scenes: the residual table, the search for structure, one ranking of
// the whole catalogue, and everything with three effects added. The argument is the number of
// points a scene, so that the time per point shows whether the cost is linear.
#include <cstdio>
#include <filesystem>
#include <map>
#include <memory>

#include <benchmark/benchmark.h>
#include <sys/resource.h>
#include <unistd.h>

#include "diagnostics/structure_scan.h"
#include "pipeline/model_discovery.h"
#include "selection/effect_search.h"
#include "selection/model_session.h"
#include "simulation/dataset_writer.h"

namespace {

namespace fs = std::filesystem;
using namespace lvcalib;

void give_up(const Error& error) {
  std::fprintf(stderr, "%s\n", error.text().c_str());
  std::exit(1);
}

// Three effects of three channels, so that the search adds as many.
CalibrationResult simulate_and_calibrate(std::int64_t points) {
  simulation::SimulationOptions options;
  options.scenes = 6;
  options.lidar.points = static_cast<int>(points);
  options.placement.min_distance_m = 1.5;
  options.placement.max_tilt_deg = 50.0;
  options.effects = {{"range_walk", 10.0}, {"corner_bias", 0.3}, {"boundary_bias", 2.0}};
  auto rig = simulation::simulate(options, {});
  if (!rig) give_up(rig.error());
  const fs::path path =
      fs::temp_directory_path() / ("lvcalib_discovery_" + std::to_string(::getpid()));
  if (const Status s = simulation::write_dataset(*rig, path); !s) give_up(s.error());
  const auto dataset = open_dataset(path);
  if (!dataset) give_up(dataset.error());
  auto result = calibrate(*dataset, {}, {});
  fs::remove_all(path);
  fs::remove(path.string() + "-truth.json");
  if (!result) give_up(result.error());
  return std::move(*result);
}

const CalibrationResult& calibrated(std::int64_t points) {
  static std::map<std::int64_t, std::unique_ptr<CalibrationResult>> all;
  auto& entry = all[points];
  if (!entry) entry = std::make_unique<CalibrationResult>(simulate_and_calibrate(points));
  return *entry;
}

void count_rows(benchmark::State& state, const MeasurementTable& table) {
  std::size_t rows = 0;
  for (const Channel channel : kAllChannels) rows += table.size(channel);
  state.counters["rows"] = static_cast<double>(rows);
}

void residual_table(benchmark::State& state) {
  const DiscoveryInput input = discovery_input(calibrated(state.range(0)));
  for (auto _ : state) {
    const MeasurementTable table = table_of(input, {});
    benchmark::DoNotOptimize(table.range.data());
  }
  count_rows(state, table_of(input, {}));
  state.SetItemsProcessed(state.iterations() * 6 * state.range(0));
}

void structure_scan(benchmark::State& state) {
  const DiscoveryInput input = discovery_input(calibrated(state.range(0)));
  const MeasurementTable table = table_of(input, {});
  for (auto _ : state)
    benchmark::DoNotOptimize(scan_structure(table, input.state, {}, {}).curves.size());
  count_rows(state, table);
}

void ranking(benchmark::State& state) {
  const DiscoveryInput input = discovery_input(calibrated(state.range(0)));
  const MeasurementTable table = table_of(input, {});
  const DiscoveryOptions options;
  const RunContext context;
  const EffectSearch start(table, input.state, options, context);
  for (auto _ : state) {
    // A search ranks once as it stands.
    state.PauseTiming();
    EffectSearch search(start);
    state.ResumeTiming();
    search.rank();
    state.counters["candidates"] = static_cast<double>(search.candidates().size());
  }
  count_rows(state, table);
}

// What *Add* does in the window before every page has the result: the effect's fit, the structure
// that it leaves, the calibration under the model.
void addition(benchmark::State& state) {
  const CalibrationResult& result = calibrated(state.range(0));
  const auto base = std::make_shared<const CalibrationResult>(result);
  const auto start = start_model(discovery_input(result), discovery_options(result), {});
  if (!start) give_up(start.error());
  for (auto _ : state) {
    const auto added = add_effect(*start, "range_walk", std::nullopt, {});
    if (!added) give_up(added.error());
    benchmark::DoNotOptimize(result_at(base, {*start, *added}));
  }
}

void everything(benchmark::State& state) {
  const CalibrationResult& result = calibrated(state.range(0));
  std::size_t added = 0;
  for (auto _ : state) {
    const auto discovery = discover(result, {}, {});
    if (!discovery) give_up(discovery.error());
    added = discovery->selected.size();
  }
  state.counters["added"] = static_cast<double>(added);
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  // Of the process, the simulated rig and the calibration included.
  state.counters["peak_MB"] = static_cast<double>(usage.ru_maxrss) / 1024.0;
}

}  // namespace

BENCHMARK(residual_table)
    ->Arg(125'000)
    ->Arg(250'000)
    ->Arg(500'000)
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();
BENCHMARK(structure_scan)
    ->Arg(250'000)
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();
BENCHMARK(ranking)
    ->Arg(250'000)
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();
BENCHMARK(addition)
    ->Arg(250'000)
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();
BENCHMARK(everything)
    ->Arg(250'000)
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();

BENCHMARK_MAIN();
