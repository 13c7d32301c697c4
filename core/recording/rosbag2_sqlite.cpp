// SPDX-License-Identifier: BSD-3-Clause
// rosbag2's SQLite files: a table of topics and one of messages, ordered by time.
#include <algorithm>
#include <map>

#include <sqlite3.h>

#include "recording/byte_reader.h"
#include "recording/container.h"

namespace lvcalib {
namespace {

struct CloseDatabase {
  void operator()(sqlite3* database) const { sqlite3_close_v2(database); }
};
struct FinishStatement {
  void operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }
};
using Database = std::unique_ptr<sqlite3, CloseDatabase>;
using Statement = std::unique_ptr<sqlite3_stmt, FinishStatement>;

std::string_view text_of(sqlite3_stmt* row, int column) {
  const auto* text = reinterpret_cast<const char*>(sqlite3_column_text(row, column));
  if (text == nullptr) return {};
  return {text, static_cast<std::size_t>(sqlite3_column_bytes(row, column))};
}

Statement prepare(sqlite3* database, const std::string& sql) {
  sqlite3_stmt* out = nullptr;
  sqlite3_prepare_v2(database, sql.c_str(), -1, &out, nullptr);
  return Statement(out);
}

// A file may be anything: its schema gets no trust, its values no more than a chunk's memory. It is
// never written to; only a write-ahead log that its recorder left beside it is read with it.
Database open_database(const std::filesystem::path& path) {
  std::string uri = "file:";
  for (const char c : std::filesystem::absolute(path).string()) {
    if (c == '%' || c == '?' || c == '#') {
      constexpr std::string_view digits = "0123456789abcdef";
      const auto byte = static_cast<unsigned char>(c);
      uri += {'%', digits[byte >> 4U], digits[byte & 15U]};
    } else {
      uri += c;
    }
  }
  std::error_code none;
  const bool has_log = std::filesystem::file_size(path.string() + "-wal", none) > 0 && !none;
  sqlite3* raw = nullptr;
  const int code = sqlite3_open_v2((uri + (has_log ? "" : "?immutable=1")).c_str(), &raw,
                                   SQLITE_OPEN_READONLY | SQLITE_OPEN_URI, nullptr);
  Database database(raw);
  if (code != SQLITE_OK) return nullptr;
  sqlite3_limit(raw, SQLITE_LIMIT_LENGTH, static_cast<int>(kMostChunkBytes));
  sqlite3_db_config(raw, SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0, nullptr);
  sqlite3_db_config(raw, SQLITE_DBCONFIG_ENABLE_TRIGGER, 0, nullptr);
  sqlite3_db_config(raw, SQLITE_DBCONFIG_ENABLE_VIEW, 0, nullptr);
  // Otherwise a file that is shorter than it says is not opened at all.
  sqlite3_db_config(raw, SQLITE_DBCONFIG_WRITABLE_SCHEMA, 1, nullptr);
  return database;
}

// Whether the file ends before the pages that its header counts.
bool is_cut_off(const std::filesystem::path& path) {
  const auto file = RandomFile::open(path);
  if (!file) return false;
  std::string header;
  file->read(0, 32, header);
  ByteReader reader(header, true);
  reader.take(16);
  const auto stated = reader.number<std::uint16_t>();
  const std::uint64_t page_bytes = stated == 1 ? 65536 : stated;
  reader.take(10);
  const auto pages = reader.number<std::uint32_t>();
  return !reader.failed() && page_bytes * pages > file->size();
}

// SQLite reads a missing page as zeros. It notices unless the page is the last one of a message,
// whose part of it is then longer than this.
bool ends_in_missing_page(std::string_view data) {
  constexpr std::size_t least_bytes = 256;
  return data.size() >= least_bytes &&
         data.substr(data.size() - least_bytes).find_first_not_of('\0') == std::string_view::npos;
}

// Ends queries that take long when a stop is asked for.
int stop_wanted(void* token) {
  return static_cast<std::stop_token*>(token)->stop_requested() ? 1 : 0;
}
constexpr int kInstructionsBetweenLooks = 10'000;

class SqliteCursor : public MessageCursor {
 public:
  // The order is fetched first, as numbers only: sorting the messages themselves could take as much
  // memory as the file.
  SqliteCursor(const std::filesystem::path& path, std::string name,
               const std::map<std::int64_t, std::size_t>& topics, const std::vector<char>& wanted,
               const TimeSpan& span, std::stop_token stop)
      : name_(std::move(name)),
        database_(open_database(path)),
        cut_off_(is_cut_off(path)),
        stop_(std::move(stop)) {
    if (!database_) return;
    sqlite3_progress_handler(database_.get(), kInstructionsBetweenLooks, stop_wanted, &stop_);
    const Statement rows = prepare(
        database_.get(),
        "SELECT id, topic_id, timestamp FROM messages WHERE timestamp >= ?1 AND timestamp <= ?2");
    if (rows) {
      sqlite3_bind_int64(rows.get(), 1, span.first_ns);
      sqlite3_bind_int64(rows.get(), 2, span.last_ns);
      int code = 0;
      while ((code = sqlite3_step(rows.get())) == SQLITE_ROW) {
        const auto topic = topics.find(sqlite3_column_int64(rows.get(), 1));
        if (topic == topics.end() || wanted[topic->second] == 0) continue;
        order_.push_back({sqlite3_column_int64(rows.get(), 2), sqlite3_column_int64(rows.get(), 0),
                          topic->second});
      }
      if (code != SQLITE_DONE) warn_of_damage();
    }
    std::stable_sort(order_.begin(), order_.end(), [](const Entry& a, const Entry& b) {
      return a.time_ns != b.time_ns ? a.time_ns < b.time_ns : a.id < b.id;
    });
    fetch_ = prepare(database_.get(), "SELECT data FROM messages WHERE id = ?1");
  }

  Result<bool> next(RecordedMessage& message) override {
    while (fetch_ && next_ < order_.size()) {
      if (stop_.stop_requested()) return Error::cancelled();
      const Entry& entry = order_[next_++];
      sqlite3_reset(fetch_.get());
      sqlite3_bind_int64(fetch_.get(), 1, entry.id);
      if (sqlite3_step(fetch_.get()) != SQLITE_ROW) {
        warn_of_damage();
        continue;
      }
      const auto* data = static_cast<const char*>(sqlite3_column_blob(fetch_.get(), 0));
      const int size = sqlite3_column_bytes(fetch_.get(), 0);
      message = {entry.topic, entry.time_ns, {}};
      if (data != nullptr) message.data = {data, static_cast<std::size_t>(size)};
      if (cut_off_ && ends_in_missing_page(message.data)) {
        warn_of_damage();
        continue;
      }
      return true;
    }
    if (stop_.stop_requested()) return Error::cancelled();
    return false;
  }

 private:
  struct Entry {
    std::int64_t time_ns = 0;
    std::int64_t id = 0;
    std::size_t topic = 0;
  };

  void warn_of_damage() {
    if (damaged_ || stop_.stop_requested()) return;
    damaged_ = true;
    warnings.push_back(
        Message("%1: is damaged or cut off; the messages that can be read are read", name_));
  }

  std::string name_;
  Database database_;
  bool cut_off_;
  Statement fetch_;
  std::stop_token stop_;
  std::vector<Entry> order_;
  std::size_t next_ = 0;
  bool damaged_ = false;
};

class Rosbag2Sqlite : public Container {
 public:
  Rosbag2Sqlite(std::filesystem::path path, std::string name)
      : path_(std::move(path)), name_(std::move(name)) {}

  [[nodiscard]] std::unique_ptr<MessageCursor> cursor(std::vector<char> wanted,
                                                      const TimeSpan& span,
                                                      std::stop_token stop) const override {
    return std::make_unique<SqliteCursor>(path_, name_, topic_of_, wanted, span, std::move(stop));
  }

  Status list(const RunContext& context) {
    const Database database = open_database(path_);
    if (!database) return unreadable(Message("cannot be opened"));
    std::stop_token stop = context.stop;
    sqlite3_progress_handler(database.get(), kInstructionsBetweenLooks, stop_wanted, &stop);
    const Statement rows =
        prepare(database.get(), "SELECT id, name, type, serialization_format FROM topics");
    if (!rows) return unreadable(database.get());
    int code = 0;
    while ((code = sqlite3_step(rows.get())) == SQLITE_ROW && topic_of_.size() < kMostTopics) {
      const auto encoding = text_of(rows.get(), 3);
      topic_of_[sqlite3_column_int64(rows.get(), 0)] = add_topic(
          text_of(rows.get(), 1), text_of(rows.get(), 2), encoding.empty() ? "cdr" : encoding);
    }
    if (code != SQLITE_DONE && code != SQLITE_ROW) {
      if (context.stopped()) return Error::cancelled();
      return unreadable(database.get());
    }
    return count_messages(database.get(), context);
  }

 private:
  Status unreadable(sqlite3* database) const {
    return unreadable(Message::verbatim(sqlite3_errmsg(database)));
  }
  Status unreadable(const Message& why) const {
    return Error::input(
        Message("the rosbag2 database cannot be read: %1", why), name_,
        Message("it needs rosbag2's tables topics and messages; copy the file again"));
  }

  Status count_messages(sqlite3* database, const RunContext& context) {
    context.report("open", 0.0, Message("counting messages"));
    const Statement rows = prepare(database, "SELECT topic_id, timestamp FROM messages");
    if (!rows) return unreadable(database);
    int code = 0;
    while ((code = sqlite3_step(rows.get())) == SQLITE_ROW) {
      const auto topic = topic_of_.find(sqlite3_column_int64(rows.get(), 0));
      if (topic != topic_of_.end()) {
        count_message(topic->second, sqlite3_column_int64(rows.get(), 1));
      }
    }
    if (context.stopped()) return Error::cancelled();
    if (code != SQLITE_DONE) {
      warnings.push_back(
          Message("%1: is damaged or cut off; the messages that can be read are read", name_));
    }
    return Done{};
  }

  std::filesystem::path path_;
  std::string name_;
  std::map<std::int64_t, std::size_t> topic_of_;  // Of rosbag2's id.
};

}  // namespace

Result<std::unique_ptr<Container>> open_rosbag2_sqlite(const std::filesystem::path& path,
                                                       const RunContext& context,
                                                       std::string name) {
  if (name.empty()) name = path.string();
  auto bag = std::make_unique<Rosbag2Sqlite>(path, std::move(name));
  if (Status s = bag->list(context); !s) return s.error();
  return std::unique_ptr<Container>(std::move(bag));
}

}  // namespace lvcalib
