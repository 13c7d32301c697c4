// SPDX-License-Identifier: GPL-3.0-or-later
// Writes recordings as ROS does, after the formats' public descriptions; shares no code with the
// readers.
#pragma once

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <string>
#include <vector>

namespace lvcalib::test {

/// How numbers of a message are written.
enum class Wire { kRos1, kCdrLittle, kCdrBig };

/// Writes a message field by field.
class MessageBuilder {
 public:
  explicit MessageBuilder(Wire wire);

  template <class T>
  MessageBuilder& put(T value) {
    align(sizeof(T));
    char bytes[sizeof(T)];
    std::memcpy(bytes, &value, sizeof(T));
    if (wire_ == Wire::kCdrBig) {
      for (std::size_t i = sizeof(T); i > 0; --i) bytes_ += bytes[i - 1];
    } else {
      bytes_.append(bytes, sizeof(T));
    }
    return *this;
  }
  MessageBuilder& text(const std::string& value);
  /// Bytes behind their number.
  MessageBuilder& block(const std::string& value);
  MessageBuilder& raw(const std::string& value);
  MessageBuilder& header(std::int64_t stamp_ns, const std::string& frame);
  [[nodiscard]] const std::string& bytes() const { return bytes_; }

 private:
  void align(std::size_t size);
  Wire wire_;
  std::string bytes_;
};

struct PointFieldSpec {
  std::string name;
  std::uint32_t offset = 0;
  std::uint8_t datatype = 7;
};

struct CloudSpec {
  std::int64_t stamp_ns = 0;
  std::uint32_t height = 1;
  std::uint32_t width = 0;
  std::vector<PointFieldSpec> fields;
  bool big_endian = false;
  std::uint32_t point_step = 0;
  std::uint32_t row_step = 0;  ///< 0: width · point_step.
  std::string data;
};
std::string point_cloud2(Wire wire, const CloudSpec& cloud);

struct LivoxPoint {
  std::uint32_t offset_time_ns = 0;
  float x = 0, y = 0, z = 0;
  std::uint8_t reflectivity = 0, tag = 0, line = 0;
};
std::string livox_custom(Wire wire, std::int64_t stamp_ns, const std::vector<LivoxPoint>& points);

struct ImageSpec {
  std::int64_t stamp_ns = 0;
  std::uint32_t width = 0, height = 0;
  std::string encoding = "mono8";
  bool big_endian = false;
  std::uint32_t step = 0;
  std::string data;
};
std::string image_message(Wire wire, const ImageSpec& image);
std::string compressed_image(Wire wire, std::int64_t stamp_ns, const std::string& format,
                             const std::string& data);

struct CameraInfoSpec {
  std::int64_t stamp_ns = 0;
  std::uint32_t width = 0, height = 0;
  std::string model = "plumb_bob";
  std::vector<double> d;
  double k[9] = {};
  double p[12] = {};
  std::uint32_t binning = 0;
  std::uint32_t roi[4] = {};  ///< x, y, height, width
};
std::string camera_info(Wire wire, const CameraInfoSpec& camera);

struct BagMessage {
  std::string topic;
  std::string type;  ///< "sensor_msgs/Image"; written as "sensor_msgs/msg/Image" for ROS 2.
  std::int64_t time_ns = 0;
  std::string data;
};

enum class Packing { kNone, kBz2, kLz4, kZstd };
std::string pack(Packing packing, const std::string& bytes);

struct BagFormat {
  Packing packing = Packing::kNone;
  bool index = true;
  bool chunks = true;  ///< MCAP: messages in chunks.
  std::size_t messages_per_chunk = 4;
  bool packs_messages = false;  ///< rosbag2: every message by itself.
  bool packs_files = false;     ///< rosbag2: every file.
};

std::string ros1_bag(const std::vector<BagMessage>& messages, const BagFormat& format = {});
std::string mcap_file(const std::vector<BagMessage>& messages, const BagFormat& format = {},
                      const std::string& encoding = "cdr");
void write_sqlite_bag(const std::filesystem::path& path, const std::vector<BagMessage>& messages);

/// A rosbag2 folder of `splits` files with metadata.yaml.
void write_rosbag2(const std::filesystem::path& folder, const std::vector<BagMessage>& messages,
                   const std::string& storage, int splits, const BagFormat& format = {});

void write_bytes(const std::filesystem::path& path, const std::string& bytes);

}  // namespace lvcalib::test
