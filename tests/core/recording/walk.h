// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "base/random.h"
#include "simulation/simulator.h"
#include "support/bag_writer.h"

namespace lvcalib::test {

/// A recording of somebody who puts a board up, lets it rest, and walks on: the scenes of a
/// simulated rig, each seen by camera and LiDAR for some time with noise of its own in every image,
/// and in between the rig turns away, slowly first.
struct WalkOptions {
  int still_ticks = 20;
  int moving_ticks = 8;
  Wire wire = Wire::kRos1;
  bool intensity = true;
  bool camera_info = true;
  std::int64_t start_ns = 1'700'000'000'000'000'000;
  static constexpr std::int64_t kTick_ns = 100'000'000;
  static constexpr double kTick_s = 0.1;
};

inline std::string image_bytes(const simulation::SimulatedImage& image, double shift_px,
                               Random& random) {
  std::string out(image.pixels.size(), '\0');
  const auto shift = static_cast<int>(std::floor(shift_px));
  const double part = shift_px - shift;
  for (int y = 0; y < image.height_px; ++y) {
    const std::uint8_t* row = image.pixels.data() + y * image.width_px;
    for (int x = 0; x < image.width_px; ++x) {
      const auto at = [&](int column) {
        return static_cast<double>(row[std::clamp(column, 0, image.width_px - 1)]);
      };
      // Uniform noise costs a tenth of normal noise.
      const double noise = random.uniform(-3.0, 3.0);
      const double grey = (1.0 - part) * at(x + shift) + part * at(x + shift + 1) + noise;
      out[static_cast<std::size_t>(y * image.width_px + x)] =
          static_cast<char>(static_cast<std::uint8_t>(std::clamp(grey, 0.0, 255.0)));
    }
  }
  return out;
}

/// Points first … last of a cloud as PointCloud2, turned about z, with times within a tick.
inline std::string sweep_message(const Cloud& cloud, std::size_t first, std::size_t last,
                                 double yaw_rad, std::int64_t stamp_ns,
                                 const WalkOptions& options) {
  CloudSpec spec;
  spec.stamp_ns = stamp_ns;
  spec.width = static_cast<std::uint32_t>(last - first);
  spec.fields = {{"x", 0, 7}, {"y", 4, 7}, {"z", 8, 7}, {"time", 12, 7}, {"ring", 16, 4}};
  if (options.intensity) spec.fields.push_back({"intensity", 18, 7});
  spec.point_step = options.intensity ? 22 : 18;
  const auto append = [&](auto value) {
    char bytes[sizeof value];
    std::memcpy(bytes, &value, sizeof value);
    spec.data.append(bytes, sizeof value);
  };
  const auto c = static_cast<float>(std::cos(yaw_rad));
  const auto s = static_cast<float>(std::sin(yaw_rad));
  for (std::size_t i = first; i < last; ++i) {
    const Eigen::Vector3f& p = cloud.points_m[i];
    append(c * p.x() - s * p.y());
    append(s * p.x() + c * p.y());
    append(p.z());
    append(static_cast<float>(0.1 * static_cast<double>(i - first) /
                              static_cast<double>(last - first)));
    append(cloud.has_line() ? cloud.line[i] : std::uint16_t{0});
    if (options.intensity) append(cloud.intensity[i]);
  }
  return point_cloud2(options.wire, spec);
}

inline std::vector<BagMessage> simulated_walk(const simulation::SimulatedRig& rig,
                                              const WalkOptions& options) {
  Random random(77);
  std::vector<BagMessage> out;
  std::int64_t now = options.start_ns;
  const Camera& camera = rig.camera;
  CameraInfoSpec info;
  info.width = static_cast<std::uint32_t>(camera.width_px);
  info.height = static_cast<std::uint32_t>(camera.height_px);
  for (int i = 0; i < camera.distortion_count(); ++i) info.d.push_back(camera.distortion[i]);
  const double k[9] = {camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1};
  std::copy(k, k + 9, info.k);
  for (const simulation::SimulatedScene& scene : rig.scenes) {
    double shift_px = 0.0;
    const auto still = static_cast<std::size_t>(options.still_ticks);
    for (int tick = 0; tick < options.still_ticks + options.moving_ticks; ++tick) {
      if (tick >= options.still_ticks) shift_px += 1.5 * (tick - options.still_ticks + 1);
      ImageSpec image;
      image.stamp_ns = now;
      image.width = static_cast<std::uint32_t>(scene.image.width_px);
      image.height = static_cast<std::uint32_t>(scene.image.height_px);
      image.step = image.width;
      image.data = image_bytes(scene.image, shift_px, random);
      const std::size_t n = scene.cloud.size();
      const std::size_t part = static_cast<std::size_t>(tick) % still;
      if (options.camera_info) {
        info.stamp_ns = now;
        out.push_back({"/camera/camera_info", "sensor_msgs/CameraInfo", now,
                       camera_info(options.wire, info)});
      }
      out.push_back(
          {"/camera/image_raw", "sensor_msgs/Image", now, image_message(options.wire, image)});
      out.push_back({"/points", "sensor_msgs/PointCloud2", now,
                     sweep_message(scene.cloud, part * n / still, (part + 1) * n / still,
                                   -shift_px / camera.fx, now, options)});
      now += WalkOptions::kTick_ns;
    }
  }
  return out;
}

}  // namespace lvcalib::test
