// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/bag_writer.h"

#include <algorithm>
#include <fstream>
#include <map>
#include <stdexcept>

#include <bzlib.h>
#include <lz4frame.h>
#include <sqlite3.h>
#include <zstd.h>

namespace lvcalib::test {
namespace {

template <class T>
std::string little(T value) {
  std::string out(sizeof(T), '\0');
  std::memcpy(out.data(), &value, sizeof(T));
  return out;
}

std::string counted(const std::string& bytes) {
  return little(static_cast<std::uint32_t>(bytes.size())) + bytes;
}

std::string ros2_type(std::string type) {
  return type.replace(type.find('/'), 1, "/msg/");
}

struct Channel {
  std::uint16_t id;
  std::string type;
};

// Topics in the order of their first message.
std::vector<std::pair<std::string, Channel>> channels_of(const std::vector<BagMessage>& messages) {
  std::vector<std::pair<std::string, Channel>> out;
  for (const BagMessage& m : messages) {
    const bool known =
        std::any_of(out.begin(), out.end(), [&](const auto& c) { return c.first == m.topic; });
    if (!known) out.push_back({m.topic, {static_cast<std::uint16_t>(out.size() + 1), m.type}});
  }
  return out;
}

std::uint16_t id_of(const std::vector<std::pair<std::string, Channel>>& channels,
                    const std::string& topic) {
  return std::find_if(channels.begin(), channels.end(),
                      [&](const auto& c) { return c.first == topic; })
      ->second.id;
}

// ---- ROS 1 -------------------------------------------------------------------------------------

std::string field(const std::string& name, const std::string& value) {
  return counted(name + "=" + value);
}

std::string record(const std::string& fields, const std::string& data) {
  return counted(fields) + counted(data);
}

std::string ros_time(std::int64_t ns) {
  return little(static_cast<std::uint32_t>(ns / 1'000'000'000)) +
         little(static_cast<std::uint32_t>(ns % 1'000'000'000));
}

std::string connection_record(const std::string& topic, const Channel& channel) {
  return record(field("op", "\x07") + field("conn", little(std::uint32_t{channel.id})) +
                    field("topic", topic),
                field("topic", topic) + field("type", channel.type) +
                    field("md5sum", std::string(32, 'a')) + field("message_definition", ""));
}

// ---- MCAP --------------------------------------------------------------------------------------

std::string mcap_record(char opcode, const std::string& content) {
  return opcode + little(static_cast<std::uint64_t>(content.size())) + content;
}

std::string schemas_and_channels(const std::vector<std::pair<std::string, Channel>>& channels,
                                 const std::string& encoding) {
  std::string out;
  for (const auto& [topic, channel] : channels) {
    const std::string type = encoding == "ros1" ? channel.type : ros2_type(channel.type);
    out += mcap_record(3, little(channel.id) + counted(type) +
                              counted(encoding == "ros1" ? "ros1msg" : "ros2msg") + counted(""));
    out += mcap_record(4, little(channel.id) + little(channel.id) + counted(topic) +
                              counted(encoding) + little(std::uint32_t{0}));
  }
  return out;
}

const char* packing_name(Packing packing) {
  switch (packing) {
    case Packing::kBz2:
      return "bz2";
    case Packing::kLz4:
      return "lz4";
    case Packing::kZstd:
      return "zstd";
    case Packing::kNone:
      break;
  }
  return "";
}

// ---- SQLite ------------------------------------------------------------------------------------

void must(int code, sqlite3* database) {
  if (code != SQLITE_OK && code != SQLITE_DONE) throw std::runtime_error(sqlite3_errmsg(database));
}

}  // namespace

MessageBuilder::MessageBuilder(Wire wire) : wire_(wire) {
  if (wire == Wire::kCdrLittle) bytes_ = std::string("\0\1\0\0", 4);
  if (wire == Wire::kCdrBig) bytes_ = std::string("\0\0\0\0", 4);
}

void MessageBuilder::align(std::size_t size) {
  if (wire_ == Wire::kRos1) return;
  while ((bytes_.size() - 4) % size != 0) bytes_ += '\0';
}

MessageBuilder& MessageBuilder::text(const std::string& value) {
  if (wire_ == Wire::kRos1) return block(value);
  put(static_cast<std::uint32_t>(value.size() + 1));
  bytes_ += value + '\0';
  return *this;
}

MessageBuilder& MessageBuilder::block(const std::string& value) {
  put(static_cast<std::uint32_t>(value.size()));
  bytes_ += value;
  return *this;
}

MessageBuilder& MessageBuilder::raw(const std::string& value) {
  bytes_ += value;
  return *this;
}

MessageBuilder& MessageBuilder::header(std::int64_t stamp_ns, const std::string& frame) {
  if (wire_ == Wire::kRos1) put(std::uint32_t{7});
  put(static_cast<std::uint32_t>(stamp_ns / 1'000'000'000));
  put(static_cast<std::uint32_t>(stamp_ns % 1'000'000'000));
  return text(frame);
}

std::string point_cloud2(Wire wire, const CloudSpec& cloud) {
  MessageBuilder out(wire);
  out.header(cloud.stamp_ns, "lidar").put(cloud.height).put(cloud.width);
  out.put(static_cast<std::uint32_t>(cloud.fields.size()));
  for (const PointFieldSpec& f : cloud.fields) {
    out.text(f.name).put(f.offset).put(f.datatype).put(std::uint32_t{1});
  }
  out.put(static_cast<std::uint8_t>(cloud.big_endian)).put(cloud.point_step);
  out.put(cloud.row_step != 0 ? cloud.row_step : cloud.width * cloud.point_step);
  return out.block(cloud.data).put(std::uint8_t{1}).bytes();
}

std::string livox_custom(Wire wire, std::int64_t stamp_ns, const std::vector<LivoxPoint>& points) {
  MessageBuilder out(wire);
  out.header(stamp_ns, "livox_frame").put(static_cast<std::uint64_t>(stamp_ns));
  out.put(static_cast<std::uint32_t>(points.size())).put(std::uint8_t{3});
  out.raw(std::string(3, '\0')).put(static_cast<std::uint32_t>(points.size()));
  for (const LivoxPoint& p : points) {
    out.put(p.offset_time_ns).put(p.x).put(p.y).put(p.z);
    out.put(p.reflectivity).put(p.tag).put(p.line);
  }
  return out.bytes();
}

std::string image_message(Wire wire, const ImageSpec& image) {
  MessageBuilder out(wire);
  out.header(image.stamp_ns, "camera").put(image.height).put(image.width).text(image.encoding);
  out.put(static_cast<std::uint8_t>(image.big_endian)).put(image.step);
  return out.block(image.data).bytes();
}

std::string compressed_image(Wire wire, std::int64_t stamp_ns, const std::string& format,
                             const std::string& data) {
  return MessageBuilder(wire).header(stamp_ns, "camera").text(format).block(data).bytes();
}

std::string camera_info(Wire wire, const CameraInfoSpec& camera) {
  MessageBuilder out(wire);
  out.header(camera.stamp_ns, "camera").put(camera.height).put(camera.width).text(camera.model);
  out.put(static_cast<std::uint32_t>(camera.d.size()));
  for (const double d : camera.d) out.put(d);
  for (const double k : camera.k) out.put(k);
  for (int i = 0; i < 9; ++i) out.put(i % 4 == 0 ? 1.0 : 0.0);
  for (const double p : camera.p) out.put(p);
  out.put(camera.binning).put(camera.binning);
  for (const std::uint32_t r : camera.roi) out.put(r);
  return out.put(std::uint8_t{0}).bytes();
}

std::string pack(Packing packing, const std::string& bytes) {
  std::string out;
  if (packing == Packing::kNone) return bytes;
  if (packing == Packing::kBz2) {
    auto size = static_cast<unsigned>(bytes.size() + bytes.size() / 50 + 1000);
    out.resize(size);
    if (BZ2_bzBuffToBuffCompress(out.data(), &size, const_cast<char*>(bytes.data()),
                                 static_cast<unsigned>(bytes.size()), 1, 0, 0) != BZ_OK) {
      throw std::runtime_error("bz2");
    }
    out.resize(size);
  } else if (packing == Packing::kLz4) {
    out.resize(LZ4F_compressFrameBound(bytes.size(), nullptr));
    out.resize(LZ4F_compressFrame(out.data(), out.size(), bytes.data(), bytes.size(), nullptr));
  } else {
    out.resize(ZSTD_compressBound(bytes.size()));
    out.resize(ZSTD_compress(out.data(), out.size(), bytes.data(), bytes.size(), 1));
  }
  return out;
}

std::string ros1_bag(const std::vector<BagMessage>& messages, const BagFormat& format) {
  const auto channels = channels_of(messages);
  const std::string magic = "#ROSBAG V2.0\n";
  constexpr std::size_t header_bytes = 4096;
  std::string body;
  std::string infos;
  std::uint32_t chunks = 0;
  for (std::size_t first = 0; first < messages.size(); first += format.messages_per_chunk) {
    const std::size_t end = std::min(messages.size(), first + format.messages_per_chunk);
    std::string chunk;
    if (first == 0) {
      for (const auto& [topic, channel] : channels) chunk += connection_record(topic, channel);
    }
    std::map<std::uint32_t, std::string> index;
    std::int64_t begin_ns = messages[first].time_ns;
    std::int64_t end_ns = begin_ns;
    for (std::size_t i = first; i < end; ++i) {
      const BagMessage& m = messages[i];
      const std::uint32_t id = id_of(channels, m.topic);
      begin_ns = std::min(begin_ns, m.time_ns);
      end_ns = std::max(end_ns, m.time_ns);
      index[id] += ros_time(m.time_ns) + little(static_cast<std::uint32_t>(chunk.size()));
      chunk += record(
          field("op", "\x02") + field("conn", little(id)) + field("time", ros_time(m.time_ns)),
          m.data);
    }
    const std::uint64_t position = magic.size() + header_bytes + body.size();
    const char* name = format.packing == Packing::kNone ? "none" : packing_name(format.packing);
    body += record(field("op", "\x05") + field("compression", name) +
                       field("size", little(static_cast<std::uint32_t>(chunk.size()))),
                   pack(format.packing, chunk));
    std::string counts;
    for (const auto& [id, entries] : index) {
      const auto count = static_cast<std::uint32_t>(entries.size() / 12);
      if (format.index) {
        body += record(field("op", "\x04") + field("ver", little(std::uint32_t{1})) +
                           field("conn", little(id)) + field("count", little(count)),
                       entries);
      }
      counts += little(id) + little(count);
    }
    infos +=
        record(field("op", "\x06") + field("ver", little(std::uint32_t{1})) +
                   field("chunk_pos", little(position)) + field("start_time", ros_time(begin_ns)) +
                   field("end_time", ros_time(end_ns)) +
                   field("count", little(static_cast<std::uint32_t>(index.size()))),
               counts);
    ++chunks;
  }
  const std::uint64_t index_position = format.index ? magic.size() + header_bytes + body.size() : 0;
  const std::string fields =
      field("op", "\x03") + field("index_pos", little(index_position)) +
      field("conn_count", little(static_cast<std::uint32_t>(channels.size()))) +
      field("chunk_count", little(chunks));
  std::string out =
      magic + record(fields, std::string(header_bytes - 8 - fields.size(), ' ')) + body;
  if (!format.index) return out;
  for (const auto& [topic, channel] : channels) out += connection_record(topic, channel);
  return out + infos;
}

std::string mcap_file(const std::vector<BagMessage>& messages, const BagFormat& format,
                      const std::string& encoding) {
  const auto channels = channels_of(messages);
  const std::string magic("\x89MCAP0\r\n", 8);
  const std::string described = schemas_and_channels(channels, encoding);
  std::string out = magic + mcap_record(1, counted("ros2") + counted("test"));
  std::string chunk_indexes;
  std::uint32_t chunks = 0;
  if (!format.chunks) out += described;
  const std::size_t step = format.chunks ? format.messages_per_chunk : messages.size() + 1;
  std::int64_t first_ns = messages.empty() ? 0 : messages[0].time_ns;
  std::int64_t last_ns = first_ns;
  for (std::size_t first = 0; first < messages.size(); first += step) {
    const std::size_t end = std::min(messages.size(), first + step);
    std::string chunk = first == 0 && format.chunks ? described : "";
    std::map<std::uint16_t, std::string> index;
    std::int64_t begin_ns = messages[first].time_ns;
    std::int64_t end_ns = begin_ns;
    for (std::size_t i = first; i < end; ++i) {
      const BagMessage& m = messages[i];
      const std::uint16_t id = id_of(channels, m.topic);
      begin_ns = std::min(begin_ns, m.time_ns);
      end_ns = std::max(end_ns, m.time_ns);
      index[id] += little(m.time_ns) + little(static_cast<std::uint64_t>(chunk.size()));
      const std::string data = format.packs_messages ? pack(format.packing, m.data) : m.data;
      chunk += mcap_record(
          5, little(id) + little(std::uint32_t{0}) + little(m.time_ns) + little(m.time_ns) + data);
    }
    first_ns = std::min(first_ns, begin_ns);
    last_ns = std::max(last_ns, end_ns);
    if (!format.chunks) {
      out += chunk;
      continue;
    }
    const Packing packing = format.packs_messages ? Packing::kNone : format.packing;
    const std::string packed = pack(packing, chunk);
    const auto position = static_cast<std::uint64_t>(out.size());
    const std::string stored = mcap_record(
        6, little(begin_ns) + little(end_ns) + little(static_cast<std::uint64_t>(chunk.size())) +
               little(std::uint32_t{0}) + counted(packing_name(packing)) +
               little(static_cast<std::uint64_t>(packed.size())) + packed);
    out += stored;
    std::string indexes;
    std::string offsets;
    for (const auto& [id, entries] : index) {
      offsets += little(id) + little(static_cast<std::uint64_t>(out.size() + indexes.size()));
      indexes += mcap_record(7, little(id) + counted(entries));
    }
    out += indexes;
    chunk_indexes += mcap_record(
        8, little(begin_ns) + little(end_ns) + little(position) +
               little(static_cast<std::uint64_t>(stored.size())) + counted(offsets) +
               little(static_cast<std::uint64_t>(indexes.size())) + counted(packing_name(packing)) +
               little(static_cast<std::uint64_t>(packed.size())) +
               little(static_cast<std::uint64_t>(chunk.size())));
    ++chunks;
  }
  out += mcap_record(15, little(std::uint32_t{0}));
  const std::uint64_t summary = format.index ? out.size() : 0;
  if (format.index) {
    out += described + chunk_indexes;
    out += mcap_record(11, little(static_cast<std::uint64_t>(messages.size())) +
                               little(static_cast<std::uint16_t>(channels.size())) +
                               little(static_cast<std::uint32_t>(channels.size())) +
                               little(std::uint32_t{0}) + little(std::uint32_t{0}) +
                               little(chunks) + little(first_ns) + little(last_ns) + counted(""));
  }
  out += mcap_record(2, little(summary) + little(std::uint64_t{0}) + little(std::uint32_t{0}));
  return out + magic;
}

void write_sqlite_bag(const std::filesystem::path& path, const std::vector<BagMessage>& messages) {
  sqlite3* database = nullptr;
  must(sqlite3_open(path.c_str(), &database), database);
  const auto run = [&](const std::string& sql) {
    must(sqlite3_exec(database, sql.c_str(), nullptr, nullptr, nullptr), database);
  };
  run("CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT NOT NULL, type TEXT NOT NULL, "
      "serialization_format TEXT NOT NULL, offered_qos_profiles TEXT NOT NULL)");
  run("CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER NOT NULL, timestamp INTEGER "
      "NOT NULL, data BLOB NOT NULL)");
  run("CREATE INDEX timestamp_idx ON messages (timestamp ASC)");
  run("BEGIN");
  const auto channels = channels_of(messages);
  for (const auto& [topic, channel] : channels) {
    run("INSERT INTO topics VALUES (" + std::to_string(channel.id) + ", '" + topic + "', '" +
        ros2_type(channel.type) + "', 'cdr', '')");
  }
  sqlite3_stmt* insert = nullptr;
  must(sqlite3_prepare_v2(database,
                          "INSERT INTO messages(topic_id, timestamp, data) VALUES (?1, ?2, ?3)", -1,
                          &insert, nullptr),
       database);
  for (const BagMessage& m : messages) {
    sqlite3_bind_int(insert, 1, id_of(channels, m.topic));
    sqlite3_bind_int64(insert, 2, m.time_ns);
    sqlite3_bind_blob64(insert, 3, m.data.data(), m.data.size(), SQLITE_STATIC);
    must(sqlite3_step(insert), database);
    sqlite3_reset(insert);
  }
  sqlite3_finalize(insert);
  run("COMMIT");
  sqlite3_close(database);
}

void write_rosbag2(const std::filesystem::path& folder, const std::vector<BagMessage>& messages,
                   const std::string& storage, int splits, const BagFormat& format) {
  std::filesystem::create_directories(folder);
  std::string paths;
  const std::size_t per_file =
      (messages.size() + static_cast<std::size_t>(splits) - 1) / static_cast<std::size_t>(splits);
  for (int i = 0; i < splits; ++i) {
    const std::size_t first = std::min(messages.size(), static_cast<std::size_t>(i) * per_file);
    const std::size_t end = std::min(messages.size(), first + per_file);
    std::vector<BagMessage> part(messages.begin() + static_cast<std::ptrdiff_t>(first),
                                 messages.begin() + static_cast<std::ptrdiff_t>(end));
    std::string name = "bag_" + std::to_string(i) + (storage == "mcap" ? ".mcap" : ".db3");
    if (storage == "mcap") {
      write_bytes(folder / name, mcap_file(part, format));
    } else {
      if (format.packs_messages) {
        for (BagMessage& m : part) m.data = pack(format.packing, m.data);
      }
      write_sqlite_bag(folder / name, part);
    }
    if (format.packs_files) {
      std::ifstream in(folder / name, std::ios::binary);
      const std::string bytes((std::istreambuf_iterator<char>(in)), {});
      std::filesystem::remove(folder / name);
      name += std::string(".") + packing_name(format.packing);
      write_bytes(folder / name, pack(format.packing, bytes));
    }
    paths += "    - " + name + "\n";
  }
  const char* mode = format.packs_files ? "FILE" : format.packs_messages ? "MESSAGE" : "";
  write_bytes(folder / "metadata.yaml",
              "rosbag2_bagfile_information:\n  version: 5\n  storage_identifier: " + storage +
                  "\n  relative_file_paths:\n" + paths + "  message_count: " +
                  std::to_string(messages.size()) + "\n  compression_format: \"" +
                  (*mode != '\0' ? packing_name(format.packing) : "") +
                  "\"\n  compression_mode: \"" + mode + "\"\n");
}

void write_bytes(const std::filesystem::path& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

}  // namespace lvcalib::test
