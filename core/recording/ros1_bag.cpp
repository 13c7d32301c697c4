// SPDX-License-Identifier: BSD-3-Clause
// ROS 1 bags, version 2.0: records of a header (fields "name=value") and data; messages lie in
// chunks, and behind them an index that a recorder writes when it ends in good order.
#include <algorithm>
#include <map>

#include "recording/byte_reader.h"
#include "recording/container.h"

namespace lvcalib {
namespace {

constexpr std::string_view kMagic = "#ROSBAG V";
constexpr std::string_view kVersion = "#ROSBAG V2.0\n";
constexpr std::uint64_t kMostHeaderBytes = 1U << 20U;
constexpr std::uint64_t kMostIndexBytes = std::uint64_t{128} << 20U;

enum Op {
  kMessage = 2,
  kBagHeader = 3,
  kIndexData = 4,
  kChunk = 5,
  kChunkInfo = 6,
  kConnection = 7
};

std::int64_t to_ns(std::uint64_t packed) {
  return static_cast<std::int64_t>(packed & 0xffffffffU) * 1'000'000'000 +
         static_cast<std::int64_t>(packed >> 32U);
}

// The fields of a record's header that anything here asks for.
struct Fields {
  int op = -1;
  std::uint32_t connection = 0;
  std::uint64_t time = 0;
  std::uint64_t index_position = 0;
  std::uint64_t chunk_position = 0;
  std::uint64_t start = 0;
  std::uint64_t end = 0;
  std::uint32_t count = 0;
  std::uint32_t version = 0;
  std::string_view topic;
  std::string_view type;
  std::string_view compression;
};

template <class T>
void set(T& to, std::string_view value) {
  ByteReader reader(value);
  if (value.size() == sizeof(T)) to = reader.number<T>();
}

// False if the header is malformed.
bool read_fields(std::string_view header, Fields& out) {
  ByteReader reader(header);
  while (reader.left() > 0) {
    const std::string_view field = reader.block();
    const auto equals = field.find('=');
    if (reader.failed() || equals == std::string_view::npos) return false;
    const std::string_view name = field.substr(0, equals);
    const std::string_view value = field.substr(equals + 1);
    if (name == "op" && value.size() == 1) out.op = static_cast<unsigned char>(value[0]);
    if (name == "conn") set(out.connection, value);
    if (name == "time") set(out.time, value);
    if (name == "index_pos") set(out.index_position, value);
    if (name == "chunk_pos") set(out.chunk_position, value);
    if (name == "start_time") set(out.start, value);
    if (name == "end_time") set(out.end, value);
    if (name == "count") set(out.count, value);
    if (name == "ver") set(out.version, value);
    if (name == "topic") out.topic = value;
    if (name == "type") out.type = value;
    if (name == "compression") out.compression = value;
  }
  return true;
}

// The same of a record, which says what it is.
bool read_record_fields(std::string_view header, Fields& out) {
  out = {};
  return read_fields(header, out) && out.op >= 0;
}

// A record in memory.
struct Record {
  Fields fields;
  std::string_view data;
  std::size_t data_offset = 0;
};

// The next record; false if it is not whole.
bool next_record(ByteReader& reader, Record& out) {
  const std::string_view header = reader.block();
  if (reader.failed() || !read_record_fields(header, out.fields)) return false;
  const auto size = reader.number<std::uint32_t>();
  out.data_offset = reader.position();
  out.data = reader.take(size);
  return !reader.failed();
}

// A record in a file, its data not read.
struct FileRecord {
  std::string header;
  Fields fields;
  std::uint64_t data_offset = 0;
  std::uint64_t data_size = 0;  // As claimed.
  bool data_whole = false;
};

class Ros1Bag : public ChunkedContainer {
 public:
  using ChunkedContainer::ChunkedContainer;

  bool list_messages(std::string_view chunk, std::vector<ChunkMessage>& out) const override {
    ByteReader reader(chunk);
    Record record;
    while (reader.left() > 0) {
      if (!next_record(reader, record)) return false;
      if (record.fields.op != kMessage) continue;
      const auto topic = topic_of_.find(record.fields.connection);
      if (topic == topic_of_.end()) continue;
      out.push_back(
          {topic->second, to_ns(record.fields.time), record.data_offset, record.data.size()});
    }
    return true;
  }

  Status list(const RunContext& context) {
    FileRecord header;
    if (!read_record(kVersion.size(), header) || header.fields.op != kBagHeader) {
      return Error::input(Message("the ROS 1 bag ends within its header"), file_.name(),
                          Message("copy or record it again"));
    }
    const std::uint64_t first = header.data_offset + header.data_size;
    const std::uint64_t index = header.fields.index_position;
    if (index != 0 && index <= file_.size() && read_index(index, context)) return Done{};
    if (context.stopped()) return Error::cancelled();
    chunks_.clear();
    topics.clear();
    topic_of_.clear();
    warnings.push_back(
        index == 0
            ? Message("%1: has no index (its recording was not ended in good order); read through "
                      "instead, as far as whole messages go",
                      file_.name())
            : Message("%1: its index is missing or damaged; read through instead, as far as whole "
                      "messages go",
                      file_.name()));
    return scan(first, context);
  }

 private:
  bool read_record(std::uint64_t at, FileRecord& out) {
    std::string size;
    file_.read(at, 4, size);
    const auto header_size = ByteReader(size).number<std::uint32_t>();
    if (size.size() != 4 || header_size > kMostHeaderBytes) return false;
    file_.read(at + 4, header_size + 4ULL, out.header);
    if (out.header.size() != header_size + 4ULL) return false;
    const std::string_view header(out.header);
    if (!read_record_fields(header.substr(0, header_size), out.fields)) return false;
    out.data_size = ByteReader(header.substr(header_size)).number<std::uint32_t>();
    out.data_offset = at + 8 + header_size;
    out.data_whole =
        out.data_offset <= file_.size() && out.data_size <= file_.size() - out.data_offset;
    return true;
  }

  void add_connection(const Fields& fields, std::string_view data) {
    if (topic_of_.contains(fields.connection) || topic_of_.size() >= kMostTopics) return;
    Fields inner;
    read_fields(data, inner);
    // The name in the data is the one before a remapping by the recorder.
    const std::string_view name = fields.topic.empty() ? inner.topic : fields.topic;
    topic_of_[fields.connection] = add_topic(name, inner.type, "ros1");
  }

  // Connections and chunks as the index has them; false if anything in it is wrong.
  bool read_index(std::uint64_t at, const RunContext& context) {
    std::string bytes;
    if (file_.size() - at > kMostIndexBytes) return false;
    file_.read(at, file_.size() - at, bytes);
    ByteReader reader(bytes);
    Record record;
    std::vector<Fields> infos;
    while (reader.left() > 0) {
      if (!next_record(reader, record)) return false;
      if (record.fields.op == kConnection) add_connection(record.fields, record.data);
      if (record.fields.op == kChunkInfo) infos.push_back(record.fields);
    }
    for (std::size_t i = 0; i < infos.size(); ++i) {
      if (context.stopped()) return false;
      if (i % 256 == 0) {
        context.report("open", static_cast<double>(i) / static_cast<double>(infos.size()),
                       Message("reading the index"));
      }
      if (!read_chunk_index(infos[i])) return false;
    }
    sort_chunks();
    return true;
  }

  // A chunk and the index of its messages, which lies behind it.
  bool read_chunk_index(const Fields& info) {
    FileRecord record;
    if (!read_record(info.chunk_position, record) || record.fields.op != kChunk ||
        !record.data_whole) {
      return false;
    }
    const auto compression = compression_by_name(record.fields.compression);
    if (!compression) return false;
    chunks_.push_back(
        {record.data_offset, record.data_size, *compression, to_ns(info.start), to_ns(info.end)});
    std::uint64_t at = record.data_offset + record.data_size;
    std::string entries;
    for (std::uint32_t c = 0; c < info.count; ++c) {
      if (!read_record(at, record) || record.fields.op != kIndexData || !record.data_whole ||
          record.fields.version != 1 || record.data_size > kMostIndexBytes) {
        return false;
      }
      const auto topic = topic_of_.find(record.fields.connection);
      if (topic == topic_of_.end() || record.data_size != 12ULL * record.fields.count) return false;
      file_.read(record.data_offset, record.data_size, entries);
      ByteReader reader(entries);
      for (std::uint32_t i = 0; i < record.fields.count; ++i) {
        const std::int64_t time = to_ns(reader.number<std::uint64_t>());
        reader.number<std::uint32_t>();
        count_message(topic->second, time);
        // What the index calls the chunk's times decides when it is read: they must be true.
        chunks_.back().first_ns = std::min(chunks_.back().first_ns, time);
        chunks_.back().last_ns = std::max(chunks_.back().last_ns, time);
      }
      at = record.data_offset + record.data_size;
    }
    return true;
  }

  // Every chunk from `at` on, unpacked once to learn what is in it.
  Status scan(std::uint64_t at, const RunContext& context) {
    std::string stored;
    std::string bytes;
    FileRecord record;
    while (at < file_.size()) {
      if (context.stopped()) return Error::cancelled();
      context.report("open", static_cast<double>(at) / static_cast<double>(file_.size()),
                     Message("reading through the bag"));
      if (!read_record(at, record)) {
        warnings.push_back(
            Message("%1: is damaged or cut off at byte %2 of %3", file_.name(), at, file_.size()));
        break;
      }
      if (record.fields.op == kConnection && record.data_whole &&
          record.data_size <= kMostHeaderBytes) {
        file_.read(record.data_offset, record.data_size, bytes);
        add_connection(record.fields, bytes);
      }
      if (record.fields.op == kChunk) scan_chunk(record, stored, bytes);
      if (!record.data_whole) {
        warnings.push_back(
            Message("%1: is cut off within the record at byte %2", file_.name(), at));
        break;
      }
      at = record.data_offset + record.data_size;
    }
    sort_chunks();
    return Done{};
  }

  void scan_chunk(const FileRecord& record, std::string& stored, std::string& bytes) {
    const auto compression = compression_by_name(record.fields.compression);
    if (!compression) {
      warnings.push_back(
          Message("%1: a chunk is packed as '%2', which is not known; expected none, bz2 or lz4",
                  file_.name(), record.fields.compression.substr(0, 40)));
      return;
    }
    const std::uint64_t there = file_.size() - std::min(file_.size(), record.data_offset);
    Chunk chunk{record.data_offset, std::min(record.data_size, there), *compression, 0, 0};
    load(chunk, stored, bytes);
    ByteReader reader(bytes);
    Record inner;
    bool any = false;
    while (reader.left() > 0 && next_record(reader, inner)) {
      if (inner.fields.op == kConnection) add_connection(inner.fields, inner.data);
      const auto topic = topic_of_.find(inner.fields.connection);
      if (inner.fields.op != kMessage || topic == topic_of_.end()) continue;
      const std::int64_t time = to_ns(inner.fields.time);
      count_message(topic->second, time);
      chunk.first_ns = any ? std::min(chunk.first_ns, time) : time;
      chunk.last_ns = any ? std::max(chunk.last_ns, time) : time;
      any = true;
    }
    if (any) chunks_.push_back(chunk);
  }

  std::map<std::uint32_t, std::size_t> topic_of_;  // Of a connection.
};

}  // namespace

Result<std::unique_ptr<Container>> open_ros1_bag(RandomFile file, const RunContext& context) {
  std::string magic;
  file.read(0, kVersion.size(), magic);
  if (magic != kVersion) {
    const std::string version = magic.size() > kMagic.size() ? magic.substr(kMagic.size(), 3) : "?";
    return Error::input(Message("is a ROS 1 bag of version %1; expected 2.0", version), file.name(),
                        Message("convert it with 'rosbag fix' or 'rosbag migrate' of ROS 1"));
  }
  auto bag = std::make_unique<Ros1Bag>(std::move(file));
  if (Status s = bag->list(context); !s) return s.error();
  return std::unique_ptr<Container>(std::move(bag));
}

}  // namespace lvcalib
