// SPDX-License-Identifier: GPL-3.0-or-later
// Reading and writing clouds of 22 bytes a point from warm files.
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>

#include <benchmark/benchmark.h>
#include <unistd.h>

#include "base/random.h"
#include "cloud/cloud.h"

namespace {

namespace fs = std::filesystem;
using lvcalib::Cloud;

// A folder for the files of one run.
class Scratch {
 public:
  Scratch() : folder_(fs::temp_directory_path() / ("lvcalib_bench_" + std::to_string(::getpid()))) {
    fs::create_directories(folder_);
  }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
  ~Scratch() { fs::remove_all(folder_); }
  [[nodiscard]] fs::path file(const std::string& name) const { return folder_ / name; }

 private:
  fs::path folder_;
};

Cloud sample_cloud(std::size_t size) {
  lvcalib::Random random(1);
  Cloud cloud;
  cloud.points_m.reserve(size);
  for (std::size_t i = 0; i < size; ++i) {
    const double azimuth = random.uniform(-3.14, 3.14);
    const double range_m = random.uniform(1.0, 30.0);
    cloud.points_m.emplace_back(static_cast<float>(range_m * std::cos(azimuth)),
                                static_cast<float>(range_m * std::sin(azimuth)),
                                static_cast<float>(random.uniform(-2.0, 2.0)));
    cloud.intensity.push_back(static_cast<float>(random.below(256)));
    cloud.time_s.push_back(0.1F * static_cast<float>(i) / static_cast<float>(size));
    cloud.line.push_back(static_cast<std::uint16_t>(i % 6));
  }
  return cloud;
}

void count_points(benchmark::State& state, std::size_t points, std::uintmax_t bytes) {
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(points));
  state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(bytes));
}

void read_file(benchmark::State& state, const fs::path& path) {
  std::size_t points = 0;
  for (auto _ : state) {
    auto cloud = lvcalib::read_cloud(path);
    if (!cloud) {
      state.SkipWithError(cloud.error().text().c_str());
      return;
    }
    points = cloud->size();
    benchmark::DoNotOptimize(cloud->points_m.data());
  }
  count_points(state, points, fs::file_size(path));
}

void read_binary(benchmark::State& state) {
  const Scratch scratch;
  const fs::path path = scratch.file("cloud.pcd");
  if (!lvcalib::write_pcd(path, sample_cloud(static_cast<std::size_t>(state.range(0))))) {
    state.SkipWithError("cannot write the file");
    return;
  }
  read_file(state, path);
}

void read_ascii(benchmark::State& state) {
  const Scratch scratch;
  const fs::path path = scratch.file("cloud.ply");
  const Cloud cloud = sample_cloud(static_cast<std::size_t>(state.range(0)));
  std::ofstream stream(path);
  stream << "ply\nformat ascii 1.0\nelement vertex " << cloud.size()
         << "\nproperty float x\nproperty float y\nproperty float z\nproperty float intensity\n"
            "end_header\n";
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    stream << cloud.points_m[i].transpose() << ' ' << cloud.intensity[i] << '\n';
  }
  stream.close();
  read_file(state, path);
}

void write_binary(benchmark::State& state) {
  const Scratch scratch;
  const fs::path path = scratch.file("cloud.pcd");
  const Cloud cloud = sample_cloud(static_cast<std::size_t>(state.range(0)));
  for (auto _ : state) {
    if (!lvcalib::write_pcd(path, cloud)) {
      state.SkipWithError("cannot write the file");
      return;
    }
  }
  count_points(state, cloud.size(), fs::file_size(path));
}

}  // namespace

BENCHMARK(read_binary)->Arg(1'000'000)->Arg(10'000'000)->Unit(benchmark::kMillisecond);
BENCHMARK(read_ascii)->Arg(1'000'000)->Unit(benchmark::kMillisecond);
BENCHMARK(write_binary)->Arg(1'000'000)->Unit(benchmark::kMillisecond);

BENCHMARK_MAIN();
