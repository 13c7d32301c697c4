// SPDX-License-Identifier: BSD-3-Clause
#include "recording/container.h"

#include <algorithm>
#include <list>

namespace lvcalib {
namespace {

// Chunks may overlap in time: those that overlap are held together, up to so much. Beyond it
// (times that go back) messages come in the order of the file, and a warning says so.
constexpr std::size_t kMostHeldBytes = std::size_t{96} << 20U;

class ChunkCursor : public MessageCursor {
 public:
  ChunkCursor(const ChunkedContainer& container, std::vector<char> wanted, TimeSpan span,
              std::stop_token stop)
      : container_(container), wanted_(std::move(wanted)), span_(span), stop_(std::move(stop)) {}

  Result<bool> next(RecordedMessage& message) override {
    drop_finished();
    while (true) {
      const auto earliest = std::min_element(
          open_.begin(), open_.end(),
          [](const OpenChunk& a, const OpenChunk& b) { return a.time_ns() < b.time_ns(); });
      const bool none = earliest == open_.end();
      if (next_chunk_ < container_.chunks().size()) {
        const Chunk& chunk = container_.chunks()[next_chunk_];
        const bool may_hold_earlier = none || chunk.first_ns <= earliest->time_ns();
        if (may_hold_earlier && (none || held_ <= kMostHeldBytes)) {
          if (stop_.stop_requested()) return Error::cancelled();
          ++next_chunk_;
          if (chunk.last_ns >= span_.first_ns && chunk.first_ns <= span_.last_ns) open(chunk);
          continue;
        }
      }
      if (none) return false;
      const ChunkMessage& found = earliest->messages[earliest->next++];
      if (found.time_ns < last_ns_ && !told_order_) {
        told_order_ = true;
        warnings.push_back(
            Message("%1: the times of its messages go back; some are read out of order",
                    container_.file().name()));
      }
      last_ns_ = std::max(last_ns_, found.time_ns);
      message = {found.topic, found.time_ns,
                 std::string_view(earliest->bytes).substr(found.offset, found.size)};
      return true;
    }
  }

 private:
  struct OpenChunk {
    std::string bytes;
    std::vector<ChunkMessage> messages;
    std::size_t next = 0;
    [[nodiscard]] std::int64_t time_ns() const { return messages[next].time_ns; }
  };

  void drop_finished() {
    for (auto it = open_.begin(); it != open_.end();) {
      if (it->next < it->messages.size()) {
        ++it;
        continue;
      }
      held_ -= it->bytes.size();
      spare_ = std::move(it->bytes);
      it = open_.erase(it);
    }
  }

  void open(const Chunk& chunk) {
    OpenChunk entry;
    entry.bytes = std::move(spare_);
    bool whole = container_.load(chunk, stored_, entry.bytes);
    std::vector<ChunkMessage> all;
    whole = container_.list_messages(entry.bytes, all) && whole;
    if (!whole) {
      warnings.push_back(
          Message("%1: the chunk at byte %2 is damaged or cut off; %3 messages of it are read",
                  container_.file().name(), chunk.offset, all.size()));
    }
    for (const ChunkMessage& m : all) {
      if (wanted_[m.topic] != 0 && span_.contains(m.time_ns)) entry.messages.push_back(m);
    }
    std::stable_sort(
        entry.messages.begin(), entry.messages.end(),
        [](const ChunkMessage& a, const ChunkMessage& b) { return a.time_ns < b.time_ns; });
    if (entry.messages.empty()) {
      spare_ = std::move(entry.bytes);
      return;
    }
    held_ += entry.bytes.size();
    open_.push_back(std::move(entry));
  }

  const ChunkedContainer& container_;
  std::vector<char> wanted_;
  TimeSpan span_;
  std::stop_token stop_;
  std::size_t next_chunk_ = 0;
  std::list<OpenChunk> open_;
  std::size_t held_ = 0;
  std::string stored_;
  std::string spare_;
  std::int64_t last_ns_ = std::numeric_limits<std::int64_t>::min();
  bool told_order_ = false;
};

}  // namespace

TimeSpan Container::span() const {
  TimeSpan out{std::numeric_limits<std::int64_t>::max(), std::numeric_limits<std::int64_t>::min()};
  for (const Topic& topic : topics) {
    if (topic.count == 0) continue;
    out.first_ns = std::min(out.first_ns, topic.first_ns);
    out.last_ns = std::max(out.last_ns, topic.last_ns);
  }
  return out;
}

std::size_t Container::add_topic(std::string_view name, std::string_view type,
                                 std::string_view encoding) {
  std::string plain(type);
  if (const auto at = plain.find("/msg/"); at != std::string::npos) plain.erase(at, 4);
  for (std::size_t i = 0; i < topics.size(); ++i) {
    const Topic& t = topics[i];
    if (t.name == name && t.type == plain && t.encoding == encoding) return i;
  }
  Topic topic;
  topic.name = name;
  topic.type = std::move(plain);
  topic.encoding = encoding;
  topics.push_back(std::move(topic));
  return topics.size() - 1;
}

void Container::count_message(std::size_t topic, std::int64_t time_ns) {
  Topic& t = topics[topic];
  t.first_ns = t.count == 0 ? time_ns : std::min(t.first_ns, time_ns);
  t.last_ns = t.count == 0 ? time_ns : std::max(t.last_ns, time_ns);
  ++t.count;
}

std::unique_ptr<MessageCursor> ChunkedContainer::cursor(std::vector<char> wanted,
                                                        const TimeSpan& span,
                                                        std::stop_token stop) const {
  return std::make_unique<ChunkCursor>(*this, std::move(wanted), span, std::move(stop));
}

bool ChunkedContainer::load(const Chunk& chunk, std::string& stored, std::string& out) const {
  const std::uint64_t size = std::min(chunk.stored, kMostChunkBytes);
  if (chunk.compression == Compression::kNone) {
    file_.read(chunk.offset, size, out);
    return out.size() == chunk.stored;
  }
  file_.read(chunk.offset, size, stored);
  return decompress(chunk.compression, stored, kMostChunkBytes, out) &&
         stored.size() == chunk.stored;
}

void ChunkedContainer::sort_chunks() {
  std::stable_sort(chunks_.begin(), chunks_.end(),
                   [](const Chunk& a, const Chunk& b) { return a.first_ns < b.first_ns; });
}

}  // namespace lvcalib
