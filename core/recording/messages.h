// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "camera/camera.h"
#include "cloud/cloud.h"
#include "recording/recording.h"

namespace lvcalib {

/// What a topic's messages can be used for.
enum class MessageKind {
  kCloud,       ///< sensor_msgs/PointCloud2, CustomMsg of the Livox drivers
  kImage,       ///< sensor_msgs/Image, sensor_msgs/CompressedImage
  kCameraInfo,  ///< sensor_msgs/CameraInfo
  kRawPackets,  ///< Packets of a LiDAR that its driver makes clouds of.
  kRawVideo,    ///< Images packed by a video codec.
  kOther,
};

MessageKind message_kind(const std::string& type);

/// What turns a topic that cannot be read itself into one that can: "velodyne_pointcloud (its
/// transform node)", for raw packets and video; empty for all other types.
std::string converter_of(const std::string& type);

/// Whether messages are serialized in a way that is read here: "ros1" or "cdr".
bool readable_encoding(const std::string& encoding);

/// A cloud with the time and frame that its sender states.
struct CloudMessage {
  std::int64_t stamp_ns = 0;
  std::string frame;
  Cloud cloud;
};

/// PointCloud2 (fields of any layout and type in both byte orders, rows padded or not, organised
/// or not) or Livox CustomMsg. Points without a return are left out, as in files; times become
/// seconds from the sweep's first point. Errors: cut off, fields outside a point, no x y z, no
/// usable point.
Result<CloudMessage> decode_cloud(const Topic& topic, std::string_view data);

/// An image as it lies in its message; the pixels are not decoded.
struct ImageMessage {
  std::int64_t stamp_ns = 0;
  std::string frame;
  int width_px = 0;
  int height_px = 0;
  /// "mono8", "bayer_rggb8"…; of a compressed image "jpeg", "png", "bmp" or "tiff" by its content.
  std::string encoding;
  bool compressed = false;
  bool big_endian = false;
  std::uint32_t step = 0;  ///< Bytes from row to row.
  std::string_view data;   ///< In the message.
};

/// Image or CompressedImage. Errors: cut off, fewer bytes than its size needs, an encoding that
/// cannot be read (named), no picture in the compressed data.
Result<ImageMessage> decode_image(const Topic& topic, std::string_view data);

/// Intrinsics as a message states them.
struct CameraInfoMessage {
  std::int64_t stamp_ns = 0;
  std::string frame;
  Camera camera;
};

/// CameraInfo. `rectified`: the intrinsics of rectified images (from P) instead of those of raw
/// ones (K and D). Binning and region of interest are taken into account. Errors: cut off,
/// uncalibrated (fx is 0), a distortion model that is not known (named).
Result<CameraInfoMessage> decode_camera_info(const Topic& topic, std::string_view data,
                                             bool rectified);

/// Only the sender's stamp of any message that begins with a header; 0 if there is none.
std::int64_t decode_stamp(const Topic& topic, std::string_view data);

}  // namespace lvcalib
