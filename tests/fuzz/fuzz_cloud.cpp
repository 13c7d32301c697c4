// SPDX-License-Identifier: GPL-3.0-or-later
// Any bytes give a cloud whose columns agree, or an input error with a message; never a crash.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "cloud/cloud.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view content(reinterpret_cast<const char*>(data), size);
  const auto cloud = lvcalib::read_cloud_from_memory(content, "fuzz");
  const auto agrees = [&](std::size_t column) { return column == 0 || column == cloud->size(); };
  if (!cloud) {
    if (cloud.error().kind != lvcalib::ErrorKind::kInput || cloud.error().message.empty()) abort();
  } else if (cloud->size() == 0 || !agrees(cloud->intensity.size()) ||
             !agrees(cloud->time_s.size()) || !agrees(cloud->line.size())) {
    abort();
  } else {
    for (const Eigen::Vector3f& point : cloud->points_m) {
      if (!point.allFinite() || point.isZero(0.0F)) abort();
    }
    for (const float time : cloud->time_s) {
      if (!(time >= 0.0F)) abort();
    }
  }
  return 0;
}
