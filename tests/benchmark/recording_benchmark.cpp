// SPDX-License-Identifier: GPL-3.0-or-later
// How fast a recording is looked through. It is made on the spot, as a folder of MCAP files:
// images of 1920 × 1200 px and clouds of 100 000 points, ten of each a second, with noise in both.
// LVCALIB_BENCHMARK_GB says how large (4).
#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>

#include <benchmark/benchmark.h>
#include <unistd.h>

#include "base/random.h"
#include "recording/survey.h"
#include "support/bag_writer.h"

namespace {
namespace fs = std::filesystem;
using namespace lvcalib;
using Clock = std::chrono::steady_clock;

constexpr std::uint32_t kWidth = 1920;
constexpr std::uint32_t kHeight = 1200;
constexpr std::uint32_t kPoints = 100'000;
constexpr std::size_t kMessagesPerFile = 130;  // Of either kind: half a gigabyte.

std::string noise(std::size_t bytes, std::uint64_t seed) {
  Random random(seed);
  std::string out(bytes, '\0');
  for (std::size_t i = 0; i + 4 <= bytes; i += 4) {
    const std::uint32_t bits = random.bits();
    std::memcpy(&out[i], &bits, 4);
  }
  return out;
}

std::string cloud_data(std::uint64_t seed) {
  Random random(seed);
  std::string out;
  for (std::uint32_t i = 0; i < kPoints; ++i) {
    const float row[4] = {static_cast<float>(random.uniform(2.0, 6.0)),
                          static_cast<float>(random.uniform(-3.0, 3.0)),
                          static_cast<float>(random.uniform(-1.0, 1.0)),
                          static_cast<float>(random.uniform(0.0, 255.0))};
    out.append(reinterpret_cast<const char*>(row), sizeof row);
  }
  return out;
}

// Removed when the program ends.
struct Recorded {
  fs::path folder = fs::temp_directory_path() / ("lvcalib_recording" + std::to_string(::getpid()));
  std::uint64_t bytes = 0;
  Recorded() {
    const char* wanted = std::getenv("LVCALIB_BENCHMARK_GB");
    const double most = 1e9 * (wanted != nullptr ? std::atof(wanted) : 4.0);
    fs::create_directories(folder);
    // A few different ones, again and again: making noise takes longer than reading it.
    std::vector<std::string> images, clouds;
    for (std::uint64_t k = 0; k < 4; ++k) {
      images.push_back(noise(std::size_t{kWidth} * kHeight, k));
      clouds.push_back(cloud_data(k));
    }
    std::int64_t time_ns = 1'700'000'000'000'000'000;
    for (int file = 0; static_cast<double>(bytes) < most; ++file) {
      std::vector<test::BagMessage> messages;
      for (std::size_t k = 0; k < kMessagesPerFile; ++k, time_ns += 100'000'000) {
        test::ImageSpec image;
        image.stamp_ns = time_ns;
        image.width = kWidth;
        image.height = kHeight;
        image.step = kWidth;
        image.data = images[k % images.size()];
        messages.push_back({"/camera/image_raw", "sensor_msgs/Image", time_ns,
                            test::image_message(test::Wire::kCdrLittle, image)});
        test::CloudSpec cloud;
        cloud.stamp_ns = time_ns;
        cloud.width = kPoints;
        cloud.point_step = 16;
        cloud.fields = {{"x", 0}, {"y", 4}, {"z", 8}, {"intensity", 12}};
        cloud.data = clouds[k % clouds.size()];
        messages.push_back({"/lidar/points", "sensor_msgs/PointCloud2", time_ns + 1000,
                            test::point_cloud2(test::Wire::kCdrLittle, cloud)});
      }
      const std::string content = test::mcap_file(messages);
      bytes += content.size();
      test::write_bytes(folder / ("part_" + std::to_string(file) + ".mcap"), content);
    }
  }
  Recorded(const Recorded&) = delete;
  Recorded& operator=(const Recorded&) = delete;
  ~Recorded() {
    std::error_code ignored;
    fs::remove_all(folder, ignored);
  }
};

const Recorded& recorded() {
  static const Recorded made;
  return made;
}

// Largest resident set so far, MB: the system's own count.
double peak_mb() {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);) {
    if (line.rfind("VmHWM:", 0) == 0) return std::atof(line.substr(6).c_str()) / 1024.0;
  }
  return 0.0;
}

void reset_peak() {
  std::ofstream("/proc/self/clear_refs") << "5";
}

void list_topics(benchmark::State& state) {
  const fs::path folder = recorded().folder;
  for (auto _ : state) {
    auto recording = Recording::open(folder, {});
    if (!recording) state.SkipWithError(recording.error().text().c_str());
    benchmark::DoNotOptimize(recording);
  }
}

// From nothing to the first picture in the window's row, and to all twelve.
void pictures(benchmark::State& state) {
  for (auto _ : state) {
    const auto recording = Recording::open(recorded().folder, {});
    if (!recording) return state.SkipWithError(recording.error().text().c_str());
    const TimeSpan span = recording->span();
    for (std::int64_t k = 0; k < state.range(0); ++k) {
      auto picture = thumbnail_at(*recording, 0,
                                  span.first_ns + (span.last_ns - span.first_ns) * k / 12, 128, {});
      if (!picture) state.SkipWithError(picture.error().text().c_str());
      benchmark::DoNotOptimize(picture);
    }
  }
}

void survey(benchmark::State& state) {
  const fs::path folder = recorded().folder;
  const auto recording = Recording::open(folder, {});
  if (!recording) return state.SkipWithError(recording.error().text().c_str());
  reset_peak();
  for (auto _ : state) {
    auto seen = survey_recording(*recording, {}, {});
    if (!seen) state.SkipWithError(seen.error().text().c_str());
    benchmark::DoNotOptimize(seen);
  }
  state.SetBytesProcessed(static_cast<std::int64_t>(recorded().bytes) *
                          static_cast<std::int64_t>(state.iterations()));
  state.counters["peak_MB"] = peak_mb();
}

// From the wish to stop, half a second into the survey, to its end.
void cancel(benchmark::State& state) {
  const auto recording = Recording::open(recorded().folder, {});
  if (!recording) return state.SkipWithError(recording.error().text().c_str());
  for (auto _ : state) {
    std::stop_source stop;
    RunContext context;
    context.stop = stop.get_token();
    std::atomic<Clock::rep> asked = 0;
    std::jthread user([&] {
      std::this_thread::sleep_for(std::chrono::milliseconds(500));
      asked = Clock::now().time_since_epoch().count();
      stop.request_stop();
    });
    const auto seen = survey_recording(*recording, {}, context);
    const auto end = Clock::now();
    user.join();
    if (seen) state.SkipWithError("the survey ended before it was stopped");
    const Clock::duration took = end.time_since_epoch() - Clock::duration(asked.load());
    state.SetIterationTime(std::chrono::duration<double>(took).count());
  }
}

BENCHMARK(list_topics)->Unit(benchmark::kMillisecond);
BENCHMARK(pictures)->Arg(1)->Arg(12)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(survey)->Unit(benchmark::kMillisecond)->UseRealTime()->Iterations(1);
BENCHMARK(cancel)->Unit(benchmark::kMillisecond)->UseManualTime()->Iterations(5);

}  // namespace

BENCHMARK_MAIN();
