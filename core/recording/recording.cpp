// SPDX-License-Identifier: BSD-3-Clause
#include "recording/recording.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <system_error>

#include <unistd.h>

#include "base/yaml_file.h"
#include "recording/container.h"

namespace lvcalib {
namespace fs = std::filesystem;

namespace {

// A nameless place for an unpacked file: readers seek, and packed files cannot be sought in.
class UnpackedFile {
 public:
  static Result<UnpackedFile> unpack(const fs::path& packed, const RunContext& context,
                                     std::vector<Message>& warnings) {
    UnpackedFile out;
    std::error_code code;
    std::string pattern = fs::temp_directory_path(code).string() + "/lvcalib-unpacked-XXXXXX";
    const int file = ::mkstemp(pattern.data());
    if (file < 0) return Error::output(Message("no temporary file can be made"), pattern);
    ::close(file);
    out.path_ = pattern;
    context.report("open", 0.0, Message("unpacking %1", packed.filename().string()));
    const auto whole = decompress_file(packed, out.path_, context);
    if (!whole) return whole.error();
    if (!*whole) {
      warnings.push_back(
          Message("%1: its compressed data are damaged or cut off; the part before is read",
                  packed.string()));
    }
    return out;
  }
  UnpackedFile(UnpackedFile&& other) noexcept : path_(std::move(other.path_)) {
    other.path_.clear();
  }
  UnpackedFile& operator=(UnpackedFile&&) = delete;
  UnpackedFile(const UnpackedFile&) = delete;
  UnpackedFile& operator=(const UnpackedFile&) = delete;
  ~UnpackedFile() {
    std::error_code code;
    if (!path_.empty()) fs::remove(path_, code);
  }
  [[nodiscard]] const fs::path& path() const { return path_; }

 private:
  UnpackedFile() = default;
  fs::path path_;
};

// A container whose file was unpacked for it, and goes when it goes.
class UnpackedContainer : public Container {
 public:
  UnpackedContainer(std::unique_ptr<Container> inner, UnpackedFile file)
      : file_(std::move(file)), inner_(std::move(inner)) {
    topics = inner_->topics;
    warnings = inner_->warnings;
  }
  [[nodiscard]] std::unique_ptr<MessageCursor> cursor(std::vector<char> wanted,
                                                      const TimeSpan& span,
                                                      std::stop_token stop) const override {
    return inner_->cursor(std::move(wanted), span, std::move(stop));
  }

 private:
  UnpackedFile file_;
  std::unique_ptr<Container> inner_;
};

struct Opened {
  std::unique_ptr<Container> container;
  std::string kind;
};

// `name` stands for the file in messages.
Result<Opened> open_plain(const fs::path& path, const std::string& name,
                          const RunContext& context) {
  auto file = RandomFile::open(path, name);
  if (!file) return file.error();
  std::string start;
  file->read(0, 16, start);
  if (start.empty()) return Error::input(Message("is empty, expected a recording"), name);
  if (start.starts_with("SQLite format 3")) {
    auto container = open_rosbag2_sqlite(path, context, name);
    if (!container) return container.error();
    return Opened{std::move(*container), "rosbag2 (sqlite3)"};
  }
  if (start.starts_with("#ROSBAG V")) {
    auto container = open_ros1_bag(std::move(*file), context);
    if (!container) return container.error();
    return Opened{std::move(*container), "ROS 1 bag"};
  }
  if (start.starts_with(std::string_view("\x89MCAP0\r\n", 8))) {
    auto container = open_mcap(std::move(*file), context);
    if (!container) return container.error();
    return Opened{std::move(*container), "MCAP"};
  }
  return Error::input(Message("is no recording that can be read; expected a ROS 1 bag (.bag), a "
                              "rosbag2 folder, or one of its files (.db3, .mcap)"),
                      name,
                      start.starts_with("\xff\xd8\xff") || start.starts_with("\x89PNG")
                          ? Message("this is an image; lvcalib calibrate takes a folder of scenes")
                          : Message("what matters is the file's content, not its name"));
}

Result<Opened> open_file(const fs::path& path, const RunContext& context) {
  auto file = RandomFile::open(path);
  if (!file) return file.error();
  std::string start;
  file->read(0, 4, start);
  if (compression_by_content(start) == Compression::kNone)
    return open_plain(path, path.string(), context);
  std::vector<Message> warnings;
  auto unpacked = UnpackedFile::unpack(path, context, warnings);
  if (!unpacked) return unpacked.error();
  // Users know the file by its own name, not by that of its unpacked copy.
  auto inner = open_plain(unpacked->path(), path.string(), context);
  if (!inner) return inner.error();
  Opened out{std::make_unique<UnpackedContainer>(std::move(inner->container), std::move(*unpacked)),
             inner->kind};
  for (Message& warning : warnings) out.container->warnings.push_back(std::move(warning));
  return out;
}

// "run_2.db3" before "run_10.db3".
bool natural_less(const std::string& a, const std::string& b) {
  const auto digit = [](char c) { return c >= '0' && c <= '9'; };
  std::size_t i = 0;
  std::size_t k = 0;
  while (i < a.size() && k < b.size()) {
    if (digit(a[i]) && digit(b[k])) {
      const auto run = [&](const std::string& s, std::size_t& at) {
        const std::size_t from = at;
        while (at < s.size() && digit(s[at])) ++at;
        const std::string digits = s.substr(from, at - from);
        const auto first = digits.find_first_not_of('0');
        return first == std::string::npos ? std::string{} : digits.substr(first);
      };
      const std::string x = run(a, i);
      const std::string y = run(b, k);
      if (x.size() != y.size()) return x.size() < y.size();
      if (x != y) return x < y;
    } else {
      if (a[i] != b[k]) return a[i] < b[k];
      ++i;
      ++k;
    }
  }
  return a.size() - i < b.size() - k;
}

bool is_bag_name(const fs::path& path) {
  std::string name = path.filename().string();
  for (const std::string_view packed : {".zstd", ".zst", ".lz4"}) {
    if (name.ends_with(packed)) name.resize(name.size() - packed.size());
  }
  return name.ends_with(".db3") || name.ends_with(".mcap") || name.ends_with(".bag");
}

// The files that metadata.yaml lists; those that lie there are read.
Result<std::vector<fs::path>> listed_files(const fs::path& folder, std::vector<Message>& warnings) {
  const auto yaml = YamlFile::load(folder / "metadata.yaml");
  if (!yaml) return yaml.error();
  const YamlValue* info = yaml->root().find("rosbag2_bagfile_information");
  const YamlValue* list = info == nullptr ? nullptr : info->find("relative_file_paths");
  if (list == nullptr || list->kind != YamlValue::Kind::kList || list->list.empty()) {
    return Error::input(
        Message("is not rosbag2's: expected rosbag2_bagfile_information with relative_file_paths"),
        (folder / "metadata.yaml").string(), Message("give the .db3 or .mcap file itself"));
  }
  std::vector<fs::path> files;
  for (const YamlValue& entry : list->list) {
    // Old versions wrote paths from where the recording was started.
    std::error_code code;
    fs::path path = folder / entry.scalar;
    if (!fs::exists(path, code)) path = folder / fs::path(entry.scalar).filename();
    // A packed file is sometimes listed by its name before it was packed.
    for (const char* packed : {".zstd", ".lz4"}) {
      if (!fs::exists(path, code) && fs::exists(path.string() + packed, code)) path += packed;
    }
    if (fs::is_regular_file(path, code)) {
      files.push_back(path);
    } else {
      warnings.push_back(
          Message("%1: named in metadata.yaml and not there; left out", path.string()));
    }
  }
  if (files.empty()) {
    return Error::input(Message("none of the files that it names is there"),
                        (folder / "metadata.yaml").string());
  }
  return files;
}

Result<std::vector<fs::path>> files_of(const fs::path& path, std::vector<Message>& warnings) {
  std::error_code code;
  if (!fs::is_directory(path, code)) return std::vector<fs::path>{path};
  if (fs::exists(path / "metadata.yaml", code)) return listed_files(path, warnings);
  std::vector<fs::path> files;
  for (fs::directory_iterator it(path, code), end; !code && it != end; it.increment(code)) {
    std::error_code inner;
    if (it->is_regular_file(inner) && is_bag_name(it->path())) files.push_back(it->path());
  }
  if (code) return Error::input(Message("cannot be listed: %1", code.message()), path.string());
  if (files.empty()) {
    return Error::input(Message("is a folder without a recording; expected metadata.yaml, or .db3, "
                                ".mcap or .bag files"),
                        path.string(),
                        Message("a folder of scenes needs no import: lvcalib calibrate takes it"));
  }
  std::sort(files.begin(), files.end(), [](const fs::path& a, const fs::path& b) {
    return natural_less(a.filename().string(), b.filename().string());
  });
  warnings.push_back(
      files.size() == 1
          ? Message("%1: has no metadata.yaml; its %2 file is read", path.string(), files.size())
          : Message("%1: has no metadata.yaml; its %2 files are read as one recording",
                    path.string(), files.size()));
  return files;
}

// Unpacks single messages that rosbag2 packed. CDR begins with a zero byte, so that a frame of
// zstd or lz4 is told by its first bytes.
class MessageUnpacker {
 public:
  bool unpack(RecordedMessage& message) {
    const Compression compression = compression_by_content(message.data);
    if (compression == Compression::kNone) return true;
    if (!decompress(compression, message.data, kMostChunkBytes, bytes_)) return false;
    message.data = bytes_;
    return true;
  }

 private:
  std::string bytes_;
};

// The cursors of several files as one, in the order of time. A file is opened for reading only
// when the one before has reached its time.
class MergedCursor {
 public:
  MergedCursor(const std::vector<std::unique_ptr<Container>>& containers,
               const std::vector<std::vector<std::size_t>>& topic_of, std::vector<char> wanted,
               TimeSpan span, std::stop_token stop)
      : containers_(containers),
        topic_of_(topic_of),
        wanted_(std::move(wanted)),
        span_(span),
        stop_(std::move(stop)) {
    for (std::size_t i = 0; i < containers.size(); ++i) waiting_.push_back(i);
    std::stable_sort(waiting_.begin(), waiting_.end(), [&](std::size_t a, std::size_t b) {
      return containers[a]->span().first_ns > containers[b]->span().first_ns;
    });
  }

  Result<bool> next(RecordedMessage& message) {
    if (current_ != kNone) {
      if (auto ok = advance(current_); !ok) return ok;
    }
    while (true) {
      const auto earliest = std::min_element(
          active_.begin(), active_.end(),
          [](const auto& a, const auto& b) { return a.message.time_ns < b.message.time_ns; });
      const bool none = earliest == active_.end();
      if (!waiting_.empty() &&
          (none || containers_[waiting_.back()]->span().first_ns <= earliest->message.time_ns)) {
        if (auto ok = activate(); !ok) return ok;
        continue;
      }
      if (none) return false;
      current_ = static_cast<std::size_t>(earliest - active_.begin());
      message = earliest->message;
      return true;
    }
  }

  std::vector<Message> warnings;

 private:
  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);
  struct Active {
    std::size_t container = 0;
    std::unique_ptr<MessageCursor> cursor;
    RecordedMessage message;
  };

  Result<bool> activate() {
    const std::size_t i = waiting_.back();
    waiting_.pop_back();
    std::vector<char> wanted;
    for (const std::size_t topic : topic_of_[i]) wanted.push_back(wanted_[topic]);
    active_.push_back({i, containers_[i]->cursor(std::move(wanted), span_, stop_), {}});
    return advance(active_.size() - 1);
  }

  // Reads on in one file; drops it at its end.
  Result<bool> advance(std::size_t at) {
    current_ = kNone;
    Active& a = active_[at];
    const auto more = a.cursor->next(a.message);
    if (!more) return more;
    if (*more) {
      a.message.topic = topic_of_[a.container][a.message.topic];
      return true;
    }
    for (Message& warning : a.cursor->warnings) warnings.push_back(std::move(warning));
    active_.erase(active_.begin() + static_cast<std::ptrdiff_t>(at));
    return true;
  }

  const std::vector<std::unique_ptr<Container>>& containers_;
  const std::vector<std::vector<std::size_t>>& topic_of_;
  std::vector<char> wanted_;
  TimeSpan span_;
  std::stop_token stop_;
  std::vector<std::size_t> waiting_;  // The next one last.
  std::vector<Active> active_;
  std::size_t current_ = kNone;
};

}  // namespace

double Topic::rate_hz() const {
  const double span_s = 1e-9 * (static_cast<double>(last_ns) - static_cast<double>(first_ns));
  return count < 2 || span_s <= 0.0 ? 0.0 : static_cast<double>(count - 1) / span_s;
}

Recording::Recording(Recording&&) noexcept = default;
Recording& Recording::operator=(Recording&&) noexcept = default;
Recording::~Recording() = default;

Result<Recording> Recording::open(const fs::path& path, const RunContext& context) {
  Recording out;
  out.path_ = path;
  const auto files = files_of(path, out.warnings_);
  if (!files) return files.error();
  std::optional<Error> failure;
  for (const fs::path& file : *files) {
    auto opened = open_file(file, context);
    if (!opened) {
      if (opened.error().kind == ErrorKind::kCancelled || files->size() == 1) {
        return opened.error();
      }
      // One bad file of a split recording does not spoil the others.
      failure = opened.error();
      out.warnings_.push_back(Message("%1; left out", failure->sentence()));
      continue;
    }
    out.kind_ = opened->kind;
    out.containers_.push_back(std::move(opened->container));
  }
  if (out.containers_.empty()) return *failure;
  out.merge_topics();
  return out;
}

// Topics of all files under common numbers.
void Recording::merge_topics() {
  struct Source {
    std::size_t container, topic;
  };
  std::vector<Source> sources;
  for (std::size_t c = 0; c < containers_.size(); ++c) {
    for (std::size_t t = 0; t < containers_[c]->topics.size(); ++t) sources.push_back({c, t});
    topic_of_container_.emplace_back(containers_[c]->topics.size());
    for (Message& warning : containers_[c]->warnings) warnings_.push_back(std::move(warning));
  }
  const auto topic = [&](const Source& s) -> const Topic& {
    return containers_[s.container]->topics[s.topic];
  };
  std::stable_sort(sources.begin(), sources.end(), [&](const Source& a, const Source& b) {
    return std::tie(topic(a).name, topic(a).type, topic(a).encoding) <
           std::tie(topic(b).name, topic(b).type, topic(b).encoding);
  });
  for (const Source& source : sources) {
    const Topic& t = topic(source);
    const bool known = !topics_.empty() && topics_.back().name == t.name &&
                       topics_.back().type == t.type && topics_.back().encoding == t.encoding;
    if (!known) {
      topics_.push_back(t);
    } else if (t.count > 0) {
      Topic& to = topics_.back();
      to.first_ns = to.count == 0 ? t.first_ns : std::min(to.first_ns, t.first_ns);
      to.last_ns = to.count == 0 ? t.last_ns : std::max(to.last_ns, t.last_ns);
      to.count += t.count;
    }
    topic_of_container_[source.container][source.topic] = topics_.size() - 1;
  }
}

TimeSpan Recording::span() const {
  TimeSpan out{std::numeric_limits<std::int64_t>::max(), std::numeric_limits<std::int64_t>::min()};
  for (const auto& container : containers_) {
    const TimeSpan span = container->span();
    out.first_ns = std::min(out.first_ns, span.first_ns);
    out.last_ns = std::max(out.last_ns, span.last_ns);
  }
  return out;
}

Result<std::vector<Message>> Recording::read(const std::vector<std::size_t>& topics,
                                             const TimeSpan& span, const RunContext& context,
                                             const std::string& stage, const Visitor& visit) const {
  std::vector<char> wanted(topics_.size(), 0);
  TimeSpan expected{std::numeric_limits<std::int64_t>::max(),
                    std::numeric_limits<std::int64_t>::min()};
  for (const std::size_t topic : topics) {
    wanted[topic] = 1;
    if (topics_[topic].count == 0) continue;
    expected.first_ns = std::min(expected.first_ns, topics_[topic].first_ns);
    expected.last_ns = std::max(expected.last_ns, topics_[topic].last_ns);
  }
  const auto first = static_cast<double>(std::max(expected.first_ns, span.first_ns));
  const double length = static_cast<double>(std::min(expected.last_ns, span.last_ns)) - first;
  MergedCursor cursor(containers_, topic_of_container_, std::move(wanted), span, context.stop);
  MessageUnpacker unpacker;
  RecordedMessage message;
  std::size_t damaged = 0;
  double reported = -1.0;
  while (true) {
    const auto more = cursor.next(message);
    if (!more) return more.error();
    if (!*more) break;
    if (context.stopped()) return Error::cancelled();
    const double done =
        length > 0.0 ? (static_cast<double>(message.time_ns) - first) / length : 1.0;
    if (done >= reported + 0.002) {
      reported = done;
      context.report(stage, std::clamp(done, 0.0, 1.0),
                     Message::verbatim(topics_[message.topic].name));
    }
    if (topics_[message.topic].encoding != "ros1" && !unpacker.unpack(message)) {
      ++damaged;
      continue;
    }
    const auto go_on = visit(message);
    if (!go_on) return go_on.error();
    if (!*go_on) break;
  }
  if (damaged > 0) {
    cursor.warnings.push_back(
        Message("%1: %2 compressed messages are damaged; left out", path_.string(), damaged));
  }
  return std::move(cursor.warnings);
}

bool looks_like_recording(const fs::path& path) {
  std::error_code code;
  std::vector<Message> warnings;
  const auto files = files_of(path, warnings);
  if (!files) return false;
  return std::any_of(files->begin(), files->end(), [&](const fs::path& file) {
    if (!fs::is_regular_file(file, code)) return false;
    auto opened = RandomFile::open(file);
    std::string start;
    if (opened) opened->read(0, 16, start);
    return start.starts_with("SQLite format 3") || start.starts_with("#ROSBAG V") ||
           start.starts_with(std::string_view("\x89MCAP0\r\n", 8)) ||
           (compression_by_content(start) != Compression::kNone && is_bag_name(file));
  });
}

}  // namespace lvcalib
