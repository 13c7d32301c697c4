// SPDX-License-Identifier: GPL-3.0-or-later
// Any bytes, taken for a message of any type that is read (named by the first byte), give what the
// type promises, or an input error; never a crash.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "recording/messages.h"
#include "recording/pixels.h"
#include "recording/still_stretches.h"

namespace {

template <class T>
bool refused(const lvcalib::Result<T>& result) {
  if (result) return false;
  if (result.error().kind != lvcalib::ErrorKind::kInput || result.error().message.empty()) abort();
  return true;
}

void decode(const lvcalib::Topic& topic, std::string_view data) {
  switch (lvcalib::message_kind(topic.type)) {
    case lvcalib::MessageKind::kCloud: {
      const auto cloud = lvcalib::decode_cloud(topic, data);
      if (refused(cloud)) return;
      if (cloud->cloud.size() == 0) abort();
      for (const auto& point : cloud->cloud.points_m) {
        if (!point.allFinite() || point.isZero(0.0F)) abort();
      }
      lvcalib::look_at_cloud(cloud->cloud);
      return;
    }
    case lvcalib::MessageKind::kImage: {
      const auto image = lvcalib::decode_image(topic, data);
      if (refused(image)) return;
      // Pixels are the decoders' of OpenCV, which is not what is tested here; small ones are cheap.
      if (!image->compressed &&
          image->width_px * static_cast<long long>(image->height_px) < 65536) {
        if (!refused(lvcalib::look_at_image(*image, "fuzz"))) {
          refused(lvcalib::make_image_file(*image, "fuzz"));
        }
      }
      return;
    }
    default: {
      const auto info = lvcalib::decode_camera_info(topic, data, data.size() % 2 == 0);
      if (!refused(info) && !lvcalib::check(info->camera)) abort();
    }
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  static const char* const types[] = {"sensor_msgs/PointCloud2", "livox_ros_driver2/CustomMsg",
                                      "sensor_msgs/Image", "sensor_msgs/CompressedImage",
                                      "sensor_msgs/CameraInfo"};
  lvcalib::Topic topic;
  topic.name = "/fuzz";
  topic.type = types[(data[0] >> 1U) % 5U];
  topic.encoding = data[0] % 2U == 0 ? "ros1" : "cdr";
  const std::string_view message(reinterpret_cast<const char*>(data) + 1, size - 1);
  lvcalib::decode_stamp(topic, message);
  decode(topic, message);
  return 0;
}
