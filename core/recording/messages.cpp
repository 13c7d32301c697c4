// SPDX-License-Identifier: BSD-3-Clause
#include "recording/messages.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <optional>

#include "base/image_header.h"
#include "base/yaml_file.h"
#include "cloud/cloud_builder.h"
#include "recording/byte_reader.h"

namespace lvcalib {
namespace {

constexpr long long kMostImagePixels = 200'000'000;
constexpr std::uint32_t kMostFields = 4096;

// A message's fields one after the other, in ROS 1's serialization (packed, little endian) or CDR
// (aligned from behind its first four bytes, which name the byte order).
class MessageReader {
 public:
  static Result<MessageReader> begin(const Topic& topic, std::string_view data) {
    if (topic.encoding == "ros1") return MessageReader(ByteReader(data), false);
    if (topic.encoding != "cdr") {
      return Error::input(Message("messages are serialized as '%1'; ROS 1 and CDR are read",
                                  topic.encoding.substr(0, 40)),
                          topic.name);
    }
    if (data.size() < 4) return Error::input(Message("a message is empty"), topic.name);
    // 0 and 1: plain CDR, big and little endian; 6 and 7: its second version, which aligns to 4.
    const auto kind = static_cast<unsigned char>(data[1]);
    if (data[0] != 0 || (kind != 0 && kind != 1 && kind != 6 && kind != 7)) {
      return Error::input(
          Message("a message is not CDR: it begins with %1 %2, expected 0 and 0 or 1",
                  static_cast<unsigned char>(data[0]), kind),
          topic.name);
    }
    ByteReader reader(data, (kind & 1U) == 0);
    reader.take(4);
    reader.align_from_here(kind >= 6 ? 4 : 8);
    return MessageReader(reader, true);
  }

  template <class T>
  T number() {
    return bytes.number<T>();
  }

  std::string_view string() {
    std::string_view out = bytes.block();
    if (cdr && out.ends_with('\0')) out.remove_suffix(1);
    return out;
  }

  std::vector<double> doubles(std::uint64_t count) {
    if (count > bytes.left() / sizeof(double)) {
      bytes.fail();
      return {};
    }
    std::vector<double> out(static_cast<std::size_t>(count));
    for (double& value : out) value = bytes.number<double>();
    return out;
  }

  // std_msgs/Header.
  void header(std::int64_t& stamp_ns, std::string& frame) {
    if (!cdr) bytes.number<std::uint32_t>();
    const std::int64_t seconds = cdr ? static_cast<std::int64_t>(bytes.number<std::int32_t>())
                                     : static_cast<std::int64_t>(bytes.number<std::uint32_t>());
    stamp_ns = seconds * 1'000'000'000 + bytes.number<std::uint32_t>();
    frame = string();
  }

  ByteReader bytes;
  bool cdr;

 private:
  MessageReader(ByteReader reader, bool is_cdr) : bytes(reader), cdr(is_cdr) {}
};

Error cut_off(const Topic& topic) {
  return Error::input(Message("a message of type %1 ends before its data do", topic.type),
                      topic.name);
}

// What sensor_msgs/PointField calls its types.
std::optional<ScalarType> field_type(std::uint8_t datatype) {
  switch (datatype) {
    case 1:
      return ScalarType::kI8;
    case 2:
      return ScalarType::kU8;
    case 3:
      return ScalarType::kI16;
    case 4:
      return ScalarType::kU16;
    case 5:
      return ScalarType::kI32;
    case 6:
      return ScalarType::kU32;
    case 7:
      return ScalarType::kF32;
    case 8:
      return ScalarType::kF64;
    default:
      return std::nullopt;
  }
}

struct PointFields {
  std::vector<std::string> names;
  std::vector<std::uint32_t> offsets;
  std::vector<std::uint8_t> types;
};

PointFields read_point_fields(MessageReader& reader) {
  PointFields out;
  const auto count = reader.number<std::uint32_t>();
  for (std::uint32_t i = 0; i < std::min(count, kMostFields) && !reader.bytes.failed(); ++i) {
    out.names.emplace_back(reader.string());
    out.offsets.push_back(reader.number<std::uint32_t>());
    out.types.push_back(reader.number<std::uint8_t>());
    reader.number<std::uint32_t>();  // Elements: the first one is taken.
  }
  if (count > kMostFields) reader.bytes.fail();
  return out;
}

Result<BlockLayout> layout_of(const PointFields& fields, std::uint32_t point_step, bool big_endian,
                              const Topic& topic) {
  const auto roles = assign_roles(fields.names, topic.name);
  if (!roles) return roles.error();
  BlockLayout layout;
  layout.swap_bytes = big_endian != (std::endian::native == std::endian::big);
  for (std::size_t role = 0; role < kRoleCount; ++role) {
    if ((*roles)[role] < 0) continue;
    const auto field = static_cast<std::size_t>((*roles)[role]);
    const auto type = field_type(fields.types[field]);
    if (!type) {
      return Error::input(Message("field '%1' has the unknown type %2; expected 1 to 8",
                                  fields.names[field], fields.types[field]),
                          topic.name);
    }
    if (point_step < scalar_size(*type) ||
        fields.offsets[field] > point_step - scalar_size(*type)) {
      return Error::input(Message("field '%1' lies outside of a point: offset %2 in %3 bytes",
                                  fields.names[field], fields.offsets[field], point_step),
                          topic.name);
    }
    layout.fields[role] = FieldLayout{*type, fields.offsets[field], point_step};
  }
  return layout;
}

Result<CloudMessage> decode_point_cloud2(const Topic& topic, MessageReader reader) {
  CloudMessage out;
  reader.header(out.stamp_ns, out.frame);
  const auto height = reader.number<std::uint32_t>();
  const auto width = reader.number<std::uint32_t>();
  const PointFields fields = read_point_fields(reader);
  const bool big_endian = reader.number<std::uint8_t>() != 0;
  const auto point_step = reader.number<std::uint32_t>();
  const auto row_step = reader.number<std::uint32_t>();
  const std::string_view data = reader.bytes.block();
  if (reader.bytes.failed()) return cut_off(topic);
  const auto layout = layout_of(fields, point_step, big_endian, topic);
  if (!layout) return layout.error();
  const std::uint64_t row = std::uint64_t{width} * point_step;
  // Some drivers leave row_step at 0, or state it for the whole cloud.
  const std::uint64_t stride = height > 1 && row_step >= row ? row_step : row;
  if (height > 0 && width > 0 &&
      (row > data.size() ||
       (height - 1) > (data.size() - row) / std::max<std::uint64_t>(stride, 1))) {
    return Error::input(Message("a cloud claims %1 × %2 points of %3 bytes and holds %4 bytes",
                                width, height, point_step, data.size()),
                        topic.name);
  }
  const auto time = layout->fields[kTime];
  const auto builder = std::make_unique<CloudBuilder>(*layout, time && is_integer(time->type),
                                                      std::uint64_t{width} * height);
  for (std::uint32_t r = 0; r < height && width > 0; ++r) {
    builder->append(data.data() + r * stride, width);
  }
  auto cloud = builder->finish(topic.name);
  if (!cloud) return cloud.error();
  out.cloud = std::move(*cloud);
  return out;
}

// livox_ros_driver and livox_ros_driver2 agree in everything.
Result<CloudMessage> decode_livox(const Topic& topic, MessageReader reader) {
  CloudMessage out;
  reader.header(out.stamp_ns, out.frame);
  reader.number<std::uint64_t>();  // Time base, that of the stamp.
  reader.number<std::uint32_t>();  // Number of points, which the array states itself.
  reader.bytes.take(4);            // LiDAR's number, three reserved bytes.
  const auto count = reader.number<std::uint32_t>();
  constexpr std::size_t point_bytes = 19;
  const std::size_t stride = reader.cdr ? 20 : point_bytes;
  const std::size_t left = reader.bytes.left();
  if (reader.bytes.failed()) return cut_off(topic);
  if (count > 0 && (left < point_bytes || (count - 1) > (left - point_bytes) / stride)) {
    return cut_off(topic);
  }
  BlockLayout layout;
  layout.swap_bytes = reader.bytes.swaps();
  layout.fields[kTime] = FieldLayout{ScalarType::kU32, 0, stride};
  layout.fields[kX] = FieldLayout{ScalarType::kF32, 4, stride};
  layout.fields[kY] = FieldLayout{ScalarType::kF32, 8, stride};
  layout.fields[kZ] = FieldLayout{ScalarType::kF32, 12, stride};
  layout.fields[kIntensity] = FieldLayout{ScalarType::kU8, 16, stride};
  layout.fields[kLine] = FieldLayout{ScalarType::kU8, 18, stride};
  const auto builder = std::make_unique<CloudBuilder>(layout, true, count);
  const std::string_view points = reader.bytes.take(left);
  builder->append(points.data(), count);
  auto cloud = builder->finish(topic.name);
  if (!cloud) return cloud.error();
  out.cloud = std::move(*cloud);
  return out;
}

// Bytes of a pixel; nothing for an encoding that is not read.
std::optional<int> pixel_bytes(const std::string& encoding) {
  static const std::map<std::string, int> known = {
      {"mono8", 1},        {"8UC1", 1},         {"mono16", 2},       {"16UC1", 2},
      {"rgb8", 3},         {"bgr8", 3},         {"8UC3", 3},         {"rgba8", 4},
      {"bgra8", 4},        {"8UC4", 4},         {"rgb16", 6},        {"bgr16", 6},
      {"bayer_rggb8", 1},  {"bayer_bggr8", 1},  {"bayer_gbrg8", 1},  {"bayer_grbg8", 1},
      {"bayer_rggb16", 2}, {"bayer_bggr16", 2}, {"bayer_gbrg16", 2}, {"bayer_grbg16", 2},
      {"yuv422", 2},       {"uyvy", 2},         {"yuv422_yuy2", 2},  {"yuyv", 2}};
  const auto found = known.find(encoding);
  if (found == known.end()) return std::nullopt;
  return found->second;
}

Result<ImageMessage> decode_raw_image(const Topic& topic, MessageReader reader) {
  ImageMessage out;
  reader.header(out.stamp_ns, out.frame);
  const auto height = reader.number<std::uint32_t>();
  const auto width = reader.number<std::uint32_t>();
  out.encoding = reader.string();
  out.big_endian = reader.number<std::uint8_t>() != 0;
  out.step = reader.number<std::uint32_t>();
  out.data = reader.bytes.block();
  if (reader.bytes.failed()) return cut_off(topic);
  const auto bytes = pixel_bytes(out.encoding);
  if (!bytes) {
    return Error::input(Message("images have the encoding '%1'; read are mono, rgb, bgr (8 and 16 "
                                "bit), rgba8, bgra8, bayer and yuv422",
                                out.encoding.substr(0, 40)),
                        topic.name);
  }
  const std::uint64_t row = std::uint64_t{width} * static_cast<std::uint64_t>(*bytes);
  if (width == 0 || height == 0 || width > kMostImagePixels / height || out.step < row ||
      row > out.data.size() || (height - 1) > (out.data.size() - row) / out.step) {
    return Error::input(Message("an image claims %1 × %2 pixels (%3, step %4) and holds %5 bytes",
                                width, height, out.encoding, out.step, out.data.size()),
                        topic.name);
  }
  out.width_px = static_cast<int>(width);
  out.height_px = static_cast<int>(height);
  return out;
}

std::string_view picture_format(std::string_view data) {
  if (data.starts_with("\xff\xd8\xff")) return "jpeg";
  if (data.starts_with("\x89PNG")) return "png";
  if (data.starts_with("BM")) return "bmp";
  if (data.starts_with("II*") || data.starts_with("MM")) return "tiff";
  return {};
}

Result<ImageMessage> decode_compressed_image(const Topic& topic, MessageReader reader) {
  ImageMessage out;
  reader.header(out.stamp_ns, out.frame);
  const std::string stated(reader.string());
  out.data = reader.bytes.block();
  if (reader.bytes.failed()) return cut_off(topic);
  out.compressed = true;
  out.encoding = picture_format(out.data);
  const auto header = read_image_header(out.data);
  if (out.encoding.empty() || !header) {
    return Error::input(out.encoding.empty()
                            ? Message("a compressed image (format '%1') is neither jpeg nor png",
                                      stated.substr(0, 60))
                            : Message("a compressed image (format '%1') is damaged: %2",
                                      stated.substr(0, 60), header.error().message),
                        topic.name);
  }
  if (header->width_px < 1 || header->height_px < 1 ||
      header->width_px > kMostImagePixels / header->height_px) {
    return Error::input(
        Message("a compressed image claims %1 × %2 pixels", header->width_px, header->height_px),
        topic.name);
  }
  out.width_px = static_cast<int>(header->width_px);
  out.height_px = static_cast<int>(header->height_px);
  return out;
}

// sensor_msgs/CameraInfo as it lies in the message.
struct CameraFields {
  std::uint32_t width = 0, height = 0;
  std::string model;
  std::vector<double> d, k, p;
  std::uint32_t binning_x = 0, binning_y = 0;
  std::uint32_t roi_x = 0, roi_y = 0, roi_height = 0, roi_width = 0;
};

CameraFields read_camera_fields(MessageReader& reader) {
  CameraFields out;
  out.height = reader.number<std::uint32_t>();
  out.width = reader.number<std::uint32_t>();
  out.model = reader.string();
  out.d = reader.doubles(reader.number<std::uint32_t>());
  out.k = reader.doubles(9);
  reader.doubles(9);  // Rotation of rectification.
  out.p = reader.doubles(12);
  out.binning_x = reader.number<std::uint32_t>();
  out.binning_y = reader.number<std::uint32_t>();
  out.roi_x = reader.number<std::uint32_t>();
  out.roi_y = reader.number<std::uint32_t>();
  out.roi_height = reader.number<std::uint32_t>();
  out.roi_width = reader.number<std::uint32_t>();
  reader.number<std::uint8_t>();
  return out;
}

Status set_distortion(const CameraFields& fields, const Topic& topic, CameraInfoMessage& out) {
  const bool none = std::all_of(fields.d.begin(), fields.d.end(), [](double d) { return d == 0; });
  Camera& camera = out.camera;
  if (fields.model == "plumb_bob" || fields.model == "radtan" ||
      (fields.model.empty() && (none || fields.d.size() == 5))) {
    camera.model = DistortionModel::kPlumbBob;
  } else if (fields.model == "rational_polynomial") {
    camera.model = DistortionModel::kRationalPolynomial;
  } else if (fields.model == "equidistant" || fields.model == "fisheye") {
    camera.model = DistortionModel::kEquidistant;
  } else {
    return Error::input(Message("distortion model '%1' is not known; read are plumb_bob, "
                                "rational_polynomial and equidistant",
                                fields.model.substr(0, 60)),
                        topic.name, Message("give intrinsics with --camera FILE"));
  }
  const auto count = static_cast<std::size_t>(camera.distortion_count());
  for (std::size_t i = 0; i < fields.d.size(); ++i) {
    if (i < count) {
      camera.distortion[static_cast<Eigen::Index>(i)] = fields.d[i];
    } else if (fields.d[i] != 0.0) {
      return Error::input(Message("distortion model '%1' has %2 coefficients, found %3",
                                  fields.model.substr(0, 60), count, fields.d.size()),
                          topic.name, Message("give intrinsics with --camera FILE"));
    }
  }
  const bool short_form = camera.model == DistortionModel::kPlumbBob && fields.d.size() == 4;
  if (fields.d.size() < count && !fields.d.empty() && !short_form) {
    return Error::input(Message("distortion model '%1' has %2 coefficients, found %3",
                                fields.model.substr(0, 60), count, fields.d.size()),
                        topic.name, Message("give intrinsics with --camera FILE"));
  }
  return Done{};
}

// The image that is sent may be a part of the camera's, with pixels put together. A pixel's centre
// is at a whole number: of n pixels put together at (n − 1)/2.
void crop_and_bin(const CameraFields& fields, Camera& camera) {
  const auto one = [](double& focal, double& centre, int& size, std::uint32_t offset,
                      std::uint32_t part, std::uint32_t binning) {
    centre -= offset;
    if (part > 0) size = static_cast<int>(part);
    if (binning < 2) return;
    focal /= binning;
    centre = (centre + 0.5) / binning - 0.5;
    size /= static_cast<int>(binning);
  };
  one(camera.fx, camera.cx, camera.width_px, fields.roi_x, fields.roi_width, fields.binning_x);
  one(camera.fy, camera.cy, camera.height_px, fields.roi_y, fields.roi_height, fields.binning_y);
}

}  // namespace

MessageKind message_kind(const std::string& type) {
  static const std::map<std::string, MessageKind> kinds = {
      {"sensor_msgs/PointCloud2", MessageKind::kCloud},
      {"livox_ros_driver/CustomMsg", MessageKind::kCloud},
      {"livox_ros_driver2/CustomMsg", MessageKind::kCloud},
      {"livox_interfaces/CustomMsg", MessageKind::kCloud},
      {"sensor_msgs/Image", MessageKind::kImage},
      {"sensor_msgs/CompressedImage", MessageKind::kImage},
      {"sensor_msgs/CameraInfo", MessageKind::kCameraInfo},
      {"theora_image_transport/Packet", MessageKind::kRawVideo},
      {"ffmpeg_image_transport_msgs/FFMPEGPacket", MessageKind::kRawVideo},
      {"foxglove_msgs/CompressedVideo", MessageKind::kRawVideo}};
  const auto found = kinds.find(type);
  if (found != kinds.end()) return found->second;
  return converter_of(type).empty() ? MessageKind::kOther : MessageKind::kRawPackets;
}

std::string converter_of(const std::string& type) {
  static const std::map<std::string, std::string> converters = {
      {"velodyne_msgs/VelodyneScan", "velodyne_pointcloud (its transform or convert node)"},
      {"velodyne_msgs/VelodynePacket", "velodyne_pointcloud (its transform or convert node)"},
      {"ouster_ros/PacketMsg", "ouster-ros (its cloud node)"},
      {"ouster_msgs/PacketMsg", "ouster-ros (its cloud node)"},
      {"ouster_sensor_msgs/PacketMsg", "ouster-ros (its cloud node)"},
      {"pandar_msgs/PandarScan", "nebula or HesaiLidar_General_ROS"},
      {"hesai_ros_driver/UdpFrame", "HesaiLidar_ROS_2.0"},
      {"hesai_lidar/PandarScan", "HesaiLidar_General_ROS"},
      {"nebula_msgs/NebulaPackets", "nebula"},
      {"rslidar_msgs/rslidarScan", "rslidar_sdk"},
      {"rslidar_msg/RslidarPacket", "rslidar_sdk"},
      {"rslidar_msg/RslidarScan", "rslidar_sdk"},
      {"robosense_msgs/RobosenseScan", "nebula"},
      {"lslidar_msgs/LslidarPacket", "lslidar_driver"},
      {"lslidar_msgs/LslidarScan", "lslidar_driver"},
      {"innovusion_msgs/InnovusionScan", "Innovusion's driver"},
      {"seyond/SeyondScan", "seyond_ros_driver"},
      {"theora_image_transport/Packet", "image_transport (republish theora raw)"},
      {"ffmpeg_image_transport_msgs/FFMPEGPacket", "image_transport (republish ffmpeg raw)"},
      {"foxglove_msgs/CompressedVideo", "image_transport (republish ffmpeg raw)"}};
  const auto found = converters.find(type);
  return found == converters.end() ? std::string{} : found->second;
}

bool readable_encoding(const std::string& encoding) {
  return encoding == "ros1" || encoding == "cdr";
}

Result<CloudMessage> decode_cloud(const Topic& topic, std::string_view data) {
  auto reader = MessageReader::begin(topic, data);
  if (!reader) return reader.error();
  return topic.type == "sensor_msgs/PointCloud2" ? decode_point_cloud2(topic, *reader)
                                                 : decode_livox(topic, *reader);
}

Result<ImageMessage> decode_image(const Topic& topic, std::string_view data) {
  auto reader = MessageReader::begin(topic, data);
  if (!reader) return reader.error();
  return topic.type == "sensor_msgs/Image" ? decode_raw_image(topic, *reader)
                                           : decode_compressed_image(topic, *reader);
}

Result<CameraInfoMessage> decode_camera_info(const Topic& topic, std::string_view data,
                                             bool rectified) {
  auto reader = MessageReader::begin(topic, data);
  if (!reader) return reader.error();
  CameraInfoMessage out;
  reader->header(out.stamp_ns, out.frame);
  CameraFields fields = read_camera_fields(*reader);
  if (reader->bytes.failed()) return cut_off(topic);
  constexpr std::uint32_t most = 1U << 20U;
  for (const std::uint32_t n : {fields.width, fields.height, fields.roi_width, fields.roi_height,
                                fields.roi_x, fields.roi_y, fields.binning_x, fields.binning_y}) {
    if (n > most) return Error::input(Message("the camera's size is absurd"), topic.name);
  }
  Camera& camera = out.camera;
  camera.name = out.frame;
  camera.width_px = static_cast<int>(fields.width);
  camera.height_px = static_cast<int>(fields.height);
  // Rows of P are four long; rectified images have no distortion left.
  const std::vector<double>& m = rectified ? fields.p : fields.k;
  const std::size_t row = rectified ? 4 : 3;
  if (m[0] == 0.0) {
    return Error::input(Message("the camera is not calibrated: fx is 0"), topic.name,
                        Message("give intrinsics with --camera FILE"));
  }
  camera.fx = m[0];
  camera.fy = m[row + 1];
  camera.cx = m[2];
  camera.cy = m[row + 2];
  if (!rectified) {
    if (Status s = set_distortion(fields, topic, out); !s) return s.error();
  }
  crop_and_bin(fields, camera);
  if (Status s = check(camera); !s) {
    Error error = s.error();
    error.where = topic.name;
    error.hint = Message("give intrinsics with --camera FILE");
    return error;
  }
  return out;
}

std::int64_t decode_stamp(const Topic& topic, std::string_view data) {
  auto reader = MessageReader::begin(topic, data);
  if (!reader) return 0;
  std::int64_t stamp = 0;
  std::string frame;
  reader->header(stamp, frame);
  return reader->bytes.failed() ? 0 : stamp;
}

}  // namespace lvcalib
