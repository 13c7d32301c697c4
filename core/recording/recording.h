// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "base/progress.h"

namespace lvcalib {

/// What was recorded under one name. Times are those of the recorder's clock (when a message
/// arrived), in ns since 1970; the senders' own stamps are inside the messages.
struct Topic {
  std::string name;      ///< "/camera/image_raw"
  std::string type;      ///< "sensor_msgs/Image", also where ROS 2 says "sensor_msgs/msg/Image".
  std::string encoding;  ///< "ros1" or "cdr"; what a file says where it is neither.
  std::uint64_t count = 0;
  std::int64_t first_ns = 0;
  std::int64_t last_ns = 0;

  /// Messages per second over the topic's own time; 0 for fewer than two.
  [[nodiscard]] double rate_hz() const;
};

/// One message as it lies in the recording.
struct RecordedMessage {
  std::size_t topic = 0;  ///< Index into Recording::topics().
  std::int64_t time_ns = 0;
  std::string_view data;  ///< Valid until the next message is read.
};

/// From `first_ns` to `last_ns`, both included.
struct TimeSpan {
  std::int64_t first_ns = std::numeric_limits<std::int64_t>::min();
  std::int64_t last_ns = std::numeric_limits<std::int64_t>::max();
  [[nodiscard]] bool contains(std::int64_t t) const { return t >= first_ns && t <= last_ns; }
};

class Container;

/// A recording of any container, read without ROS: a ROS 1 bag (2.0), a rosbag2 folder or one of
/// its files (sqlite3 or MCAP, split or not, files or messages compressed), or an MCAP file.
/// Nothing is kept in memory but lists of topics and chunks, and the chunks being read.
class Recording {
 public:
  /// Lists the topics; containers without an index are read through for it. What a damaged or
  /// truncated file still holds is read, and warnings() say what is missing.
  /// Errors: missing, empty, of no known kind, nothing readable in it, a stop.
  static Result<Recording> open(const std::filesystem::path& path, const RunContext& context);

  Recording(Recording&&) noexcept;
  Recording& operator=(Recording&&) noexcept;
  ~Recording();

  /// "ROS 1 bag", "rosbag2 (sqlite3)" or "MCAP".
  [[nodiscard]] const std::string& kind() const { return kind_; }
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  /// Sorted by name, then type.
  [[nodiscard]] const std::vector<Topic>& topics() const { return topics_; }
  [[nodiscard]] const std::vector<Message>& warnings() const { return warnings_; }
  /// From the first to the last message of all topics; empty (first > last) without messages.
  [[nodiscard]] TimeSpan span() const;

  /// Takes a message; false ends the reading.
  using Visitor = std::function<Result<bool>(const RecordedMessage&)>;
  /// Hands the messages of some topics to `visit` in the order of their times, and reports
  /// progress as `stage`. Returns warnings about what could not be read. Errors: those of
  /// `visit`, a stop (within a chunk's time).
  Result<std::vector<Message>> read(const std::vector<std::size_t>& topics, const TimeSpan& span,
                                    const RunContext& context, const std::string& stage,
                                    const Visitor& visit) const;

 private:
  Recording() = default;
  void merge_topics();

  std::filesystem::path path_;
  std::string kind_;
  std::vector<std::unique_ptr<Container>> containers_;
  std::vector<std::vector<std::size_t>> topic_of_container_;  // [container][its topic] -> topic
  std::vector<Topic> topics_;
  std::vector<Message> warnings_;
};

/// Whether a file, or what a folder holds, looks like a recording: by the first bytes of files, by
/// the name of compressed ones. Nothing else is read.
bool looks_like_recording(const std::filesystem::path& path);

}  // namespace lvcalib
