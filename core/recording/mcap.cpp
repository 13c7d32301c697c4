// SPDX-License-Identifier: BSD-3-Clause
// MCAP files: records of an opcode, a length and content between two magics. Messages lie in chunks
// (or, rarely, bare); a summary at the end lists channels and chunks.
#include <algorithm>
#include <map>

#include "recording/byte_reader.h"
#include "recording/container.h"

namespace lvcalib {
namespace {

constexpr std::string_view kMcapMagic("\x89MCAP0\r\n", 8);
constexpr std::uint64_t kFooterBytes = 1 + 8 + 20 + 8;  // With the magic behind it.
constexpr std::uint64_t kMostSummaryBytes = std::uint64_t{128} << 20U;
// Bare messages are read in pieces of about this size.
constexpr std::uint64_t kBarePiece = std::uint64_t{4} << 20U;
constexpr std::uint64_t kChunkHeaderBytes = 8 + 8 + 8 + 4 + 4 + 64 + 8;

enum Opcode : std::uint8_t {
  kHeader = 1,
  kFooter = 2,
  kSchema = 3,
  kChannel = 4,
  kMcapMessage = 5,
  kMcapChunk = 6,
  kMessageIndex = 7,
  kChunkIndex = 8,
  kStatistics = 11,
  kDataEnd = 15,
};

struct ChunkHeader {
  std::int64_t first_ns = 0;
  std::int64_t last_ns = 0;
  std::string_view compression;
  std::uint64_t stored = 0;
};

std::int64_t time_of(ByteReader& reader) {
  const auto value = reader.number<std::uint64_t>();
  return static_cast<std::int64_t>(std::min<std::uint64_t>(value, INT64_MAX));
}

// All of a chunk's record before its messages.
ChunkHeader read_chunk_header(ByteReader& reader) {
  ChunkHeader out;
  out.first_ns = time_of(reader);
  out.last_ns = time_of(reader);
  reader.number<std::uint64_t>();  // Unpacked size: found out by unpacking.
  reader.number<std::uint32_t>();  // Checksum.
  out.compression = reader.block();
  out.stored = reader.number<std::uint64_t>();
  return out;
}

class McapFile : public ChunkedContainer {
 public:
  using ChunkedContainer::ChunkedContainer;

  bool list_messages(std::string_view chunk, std::vector<ChunkMessage>& out) const override {
    return walk(chunk, [&](std::uint8_t opcode, std::string_view content, std::size_t offset) {
      if (opcode != kMcapMessage) return true;
      ByteReader reader(content);
      const auto topic = topic_of_.find(reader.number<std::uint16_t>());
      reader.number<std::uint32_t>();
      const std::int64_t time = time_of(reader);
      reader.number<std::uint64_t>();
      if (reader.failed()) return false;
      if (topic == topic_of_.end()) return true;
      out.push_back({topic->second, time, offset + reader.position(), reader.left()});
      return true;
    });
  }

  Status list(const RunContext& context) {
    if (read_summary(context)) return Done{};
    if (context.stopped()) return Error::cancelled();
    const bool ended = !footer_.empty();
    chunks_.clear();
    topics.clear();
    topic_of_.clear();
    types_.clear();
    if (!ended) {
      warnings.push_back(
          Message("%1: has no end (its recording was not ended in good order, or it is cut off); "
                  "read through instead, as far as whole messages go",
                  file_.name()));
    }
    return scan(context);
  }

 private:
  // Calls take(opcode, content, offset of the content) for every whole record; false if the last
  // is not whole or take() wants no more.
  template <class Take>
  static bool walk(std::string_view bytes, const Take& take) {
    ByteReader reader(bytes);
    while (reader.left() > 0) {
      const auto opcode = reader.number<std::uint8_t>();
      const auto size = reader.number<std::uint64_t>();
      const std::size_t offset = reader.position();
      const std::string_view content = reader.take(size);
      if (reader.failed() || !take(opcode, content, offset)) return false;
    }
    return true;
  }

  void add_schema(std::string_view content) {
    ByteReader reader(content);
    const auto id = reader.number<std::uint16_t>();
    const std::string_view name = reader.block();
    if (!reader.failed()) types_[id] = name;
  }

  void add_channel(std::string_view content) {
    ByteReader reader(content);
    const auto id = reader.number<std::uint16_t>();
    const auto schema = reader.number<std::uint16_t>();
    const std::string_view name = reader.block();
    const std::string_view encoding = reader.block();
    if (reader.failed() || topic_of_.contains(id) || topic_of_.size() >= kMostTopics) return;
    const auto type = types_.find(schema);
    topic_of_[id] = add_topic(name, type == types_.end() ? "" : type->second, encoding);
  }

  // Channels and chunks as the summary has them; false where it is missing, damaged, or where
  // messages lie outside of chunks, so that the file must be read through.
  bool read_summary(const RunContext& context) {
    if (file_.size() < kFooterBytes) return false;
    file_.read(file_.size() - kFooterBytes, kFooterBytes, footer_);
    ByteReader footer(footer_);
    if (footer.number<std::uint8_t>() != kFooter || footer.number<std::uint64_t>() != 20 ||
        !footer_.ends_with(kMcapMagic)) {
      footer_.clear();
      return false;
    }
    const auto start = footer.number<std::uint64_t>();
    const std::uint64_t end = file_.size() - kFooterBytes;
    if (start == 0 || start > end || end - start > kMostSummaryBytes) return false;
    std::string summary;
    file_.read(start, end - start, summary);
    std::vector<std::string_view> chunk_indexes;
    std::uint64_t messages = 0;
    bool counted = false;
    const bool whole = walk(summary, [&](std::uint8_t opcode, std::string_view content, auto) {
      if (opcode == kSchema) add_schema(content);
      if (opcode == kChannel) add_channel(content);
      if (opcode == kChunkIndex) chunk_indexes.push_back(content);
      if (opcode == kStatistics) {
        messages = ByteReader(content).number<std::uint64_t>();
        counted = true;
      }
      return true;
    });
    if (!whole || !counted) return false;
    for (std::size_t i = 0; i < chunk_indexes.size(); ++i) {
      if (context.stopped()) return false;
      if (i % 256 == 0) {
        context.report("open", static_cast<double>(i) / static_cast<double>(chunk_indexes.size()),
                       Message("reading the index"));
      }
      if (!read_chunk_index(chunk_indexes[i])) return false;
    }
    std::uint64_t found = 0;
    for (const Topic& topic : topics) found += topic.count;
    sort_chunks();
    return found == messages;
  }

  // One chunk and the indexes of its messages, which lie behind it.
  bool read_chunk_index(std::string_view content) {
    ByteReader reader(content);
    time_of(reader);
    time_of(reader);
    const auto chunk_start = reader.number<std::uint64_t>();
    const auto chunk_length = reader.number<std::uint64_t>();
    reader.take(reader.number<std::uint32_t>());  // Where each channel's index is.
    const auto index_length = reader.number<std::uint64_t>();
    if (reader.failed() || index_length > kMostSummaryBytes) return false;
    std::string bytes;
    file_.read(chunk_start, 9 + kChunkHeaderBytes, bytes);
    ByteReader record(bytes);
    if (record.number<std::uint8_t>() != kMcapChunk) return false;
    record.number<std::uint64_t>();
    const ChunkHeader header = read_chunk_header(record);
    const auto compression = compression_by_name(header.compression);
    const std::uint64_t offset = chunk_start + record.position();
    if (record.failed() || !compression || offset > file_.size() ||
        header.stored > file_.size() - offset) {
      return false;
    }
    chunks_.push_back({offset, header.stored, *compression, header.first_ns, header.last_ns});
    file_.read(chunk_start + chunk_length, index_length, bytes);
    return bytes.size() == index_length &&
           walk(bytes, [&](std::uint8_t opcode, std::string_view index, auto) {
             return opcode != kMessageIndex || read_message_index(index, chunks_.back());
           });
  }

  bool read_message_index(std::string_view content, Chunk& chunk) {
    ByteReader reader(content);
    const auto topic = topic_of_.find(reader.number<std::uint16_t>());
    ByteReader entries(reader.block());
    if (reader.failed() || topic == topic_of_.end()) return false;
    while (entries.left() > 0) {
      const std::int64_t time = time_of(entries);
      entries.number<std::uint64_t>();
      if (entries.failed()) return false;
      count_message(topic->second, time);
      // What the chunk calls its times decides when it is read: they must be true.
      chunk.first_ns = std::min(chunk.first_ns, time);
      chunk.last_ns = std::max(chunk.last_ns, time);
    }
    return true;
  }

  // Learns channels from records of a piece and counts its messages.
  void take_piece(std::string_view bytes, Chunk chunk) {
    bool any = false;
    walk(bytes, [&](std::uint8_t opcode, std::string_view content, auto) {
      if (opcode == kSchema) add_schema(content);
      if (opcode == kChannel) add_channel(content);
      if (opcode != kMcapMessage) return true;
      ByteReader reader(content);
      const auto topic = topic_of_.find(reader.number<std::uint16_t>());
      reader.number<std::uint32_t>();
      const std::int64_t time = time_of(reader);
      if (reader.failed() || topic == topic_of_.end()) return true;
      count_message(topic->second, time);
      chunk.first_ns = any ? std::min(chunk.first_ns, time) : time;
      chunk.last_ns = any ? std::max(chunk.last_ns, time) : time;
      any = true;
      return true;
    });
    if (any) chunks_.push_back(chunk);
  }

  void scan_chunk(std::uint64_t at, std::uint64_t size) {
    std::string bytes;
    file_.read(at, kChunkHeaderBytes, bytes);
    ByteReader reader(bytes);
    const ChunkHeader header = read_chunk_header(reader);
    const auto compression = compression_by_name(header.compression);
    if (reader.failed() || !compression) {
      warnings.push_back(
          reader.failed()
              ? Message("%1: the chunk at byte %2 is damaged", file_.name(), at)
              : Message("%1: the chunk at byte %2 is packed as '%3', which is not known; expected "
                        "lz4 or zstd",
                        file_.name(), at, header.compression.substr(0, 40)));
      return;
    }
    const std::uint64_t room = size - std::min<std::uint64_t>(size, reader.position());
    Chunk chunk{at + reader.position(), std::min(header.stored, room), *compression, 0, 0};
    load(chunk, stored_, unpacked_);
    take_piece(unpacked_, chunk);
  }

  // Messages outside of chunks, gathered into a piece that is read like a chunk.
  void end_bare(std::uint64_t& begin, std::uint64_t end) {
    if (begin == 0) return;
    Chunk chunk{begin, end - begin, Compression::kNone, 0, 0};
    load(chunk, stored_, unpacked_);
    take_piece(unpacked_, chunk);
    begin = 0;
  }

  Status scan(const RunContext& context) {
    std::uint64_t at = kMcapMagic.size();
    std::uint64_t bare = 0;
    std::string head;
    std::string content;
    while (at < file_.size()) {
      if (context.stopped()) return Error::cancelled();
      context.report("open", static_cast<double>(at) / static_cast<double>(file_.size()),
                     Message("reading through the file"));
      file_.read(at, 9, head);
      ByteReader reader(head);
      const auto opcode = reader.number<std::uint8_t>();
      const auto size = reader.number<std::uint64_t>();
      if (reader.failed() || opcode == 0 || size > file_.size() - at - 9) {
        end_bare(bare, at);
        warnings.push_back(Message("%1: is damaged or cut off within the record at byte %2 of %3",
                                   file_.name(), at, file_.size()));
        if (!reader.failed() && opcode == kMcapChunk) scan_chunk(at + 9, file_.size() - at - 9);
        break;
      }
      if (opcode == kDataEnd || opcode == kFooter) break;
      const bool describes = opcode == kSchema || opcode == kChannel;
      if (opcode == kMcapMessage && bare == 0) bare = at;
      const bool goes_on = opcode == kMcapMessage || describes;
      if (bare != 0 && (!goes_on || at + 9 + size - bare > kBarePiece)) {
        end_bare(bare, at);
        if (opcode == kMcapMessage) bare = at;
      }
      if (describes && size <= kMostSummaryBytes) {
        file_.read(at + 9, size, content);
        if (opcode == kSchema) add_schema(content);
        if (opcode == kChannel) add_channel(content);
      }
      if (opcode == kMcapChunk) scan_chunk(at + 9, size);
      at += 9 + size;
    }
    end_bare(bare, std::min(at, file_.size()));
    sort_chunks();
    return Done{};
  }

  std::string footer_;
  std::string stored_;
  std::string unpacked_;
  std::map<std::uint16_t, std::string> types_;     // Of a schema.
  std::map<std::uint16_t, std::size_t> topic_of_;  // Of a channel.
};

}  // namespace

Result<std::unique_ptr<Container>> open_mcap(RandomFile file, const RunContext& context) {
  auto mcap = std::make_unique<McapFile>(std::move(file));
  if (Status s = mcap->list(context); !s) return s.error();
  return std::unique_ptr<Container>(std::move(mcap));
}

}  // namespace lvcalib
