// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "recording/compression.h"
#include "recording/random_file.h"
#include "recording/recording.h"

namespace lvcalib {

/// Messages of a container one after the other, in the order of their times.
class MessageCursor {
 public:
  virtual ~MessageCursor() = default;
  /// False at the end. Its data stay valid until the next call.
  virtual Result<bool> next(RecordedMessage& message) = 0;
  std::vector<Message> warnings;
};

/// One file of a recording.
class Container {
 public:
  virtual ~Container() = default;
  /// `wanted[t]`: whether topic t is to be read.
  [[nodiscard]] virtual std::unique_ptr<MessageCursor> cursor(std::vector<char> wanted,
                                                              const TimeSpan& span,
                                                              std::stop_token stop) const = 0;
  std::vector<Topic> topics;
  std::vector<Message> warnings;

  /// From its first to its last message.
  [[nodiscard]] TimeSpan span() const;

 protected:
  /// The topic of that name, type and encoding, which is added if it is new. The type's "/msg/"
  /// is taken out.
  std::size_t add_topic(std::string_view name, std::string_view type, std::string_view encoding);
  void count_message(std::size_t topic, std::int64_t time_ns);
};

/// Largest chunk and largest message that are read: a bag's recorder cuts chunks at some hundred
/// kilobytes, or at one message, and no camera or LiDAR fills more at once.
inline constexpr std::uint64_t kMostChunkBytes = std::uint64_t{192} << 20U;
/// Topics and chunks that a file may name, so that lists stay small beside the messages.
inline constexpr std::size_t kMostTopics = 4096;

/// A piece of a file that holds messages.
struct Chunk {
  std::uint64_t offset = 0;  ///< Of the stored bytes.
  std::uint64_t stored = 0;
  Compression compression = Compression::kNone;
  std::int64_t first_ns = 0;
  std::int64_t last_ns = 0;
};

/// Where a message lies in an unpacked chunk.
struct ChunkMessage {
  std::size_t topic = 0;
  std::int64_t time_ns = 0;
  std::size_t offset = 0;
  std::size_t size = 0;
};

/// A container whose messages lie in chunks (ROS 1 bag, MCAP): what both have in common.
class ChunkedContainer : public Container {
 public:
  explicit ChunkedContainer(RandomFile file) : file_(std::move(file)) {}
  [[nodiscard]] std::unique_ptr<MessageCursor> cursor(std::vector<char> wanted,
                                                      const TimeSpan& span,
                                                      std::stop_token stop) const override;
  /// The messages in an unpacked chunk, those of topics that are not known left out. False if the
  /// last record is not whole.
  virtual bool list_messages(std::string_view chunk, std::vector<ChunkMessage>& out) const = 0;

  [[nodiscard]] const RandomFile& file() const { return file_; }
  [[nodiscard]] const std::vector<Chunk>& chunks() const { return chunks_; }

  /// Reads and unpacks; false if not all of the chunk came out.
  bool load(const Chunk& chunk, std::string& stored, std::string& out) const;

 protected:
  void sort_chunks();
  RandomFile file_;
  std::vector<Chunk> chunks_;
};

/// Errors: another version, nothing readable, a stop.
Result<std::unique_ptr<Container>> open_ros1_bag(RandomFile file, const RunContext& context);
Result<std::unique_ptr<Container>> open_mcap(RandomFile file, const RunContext& context);
/// `name` stands for the file in messages; empty: its path.
Result<std::unique_ptr<Container>> open_rosbag2_sqlite(const std::filesystem::path& path,
                                                       const RunContext& context,
                                                       std::string name = {});

}  // namespace lvcalib
