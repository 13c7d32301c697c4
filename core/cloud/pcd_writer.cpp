// SPDX-License-Identifier: BSD-3-Clause
// Our own, as PCL's writer wants a copy of the cloud in points of its own, and takes 13 ms of one
// core for half a million of them where this takes 6 (pcl_benchmark); and it leaves half a file
// behind.
#include <cerrno>
#include <cstring>
#include <string>
#include <system_error>

#include <fcntl.h>
#include <unistd.h>

#include "base/file_io.h"
#include "cloud/cloud.h"

namespace lvcalib {
namespace {

// A file under a temporary name beside its place; takes its name only when it is complete, and
// goes away otherwise.
class PartFile {
 public:
  explicit PartFile(const std::filesystem::path& path)
      : path_(behind_links(path)), stream_(is_stream(path)), temporary_(path_) {
    if (stream_) {
      file_ = ::open(path.c_str(), O_WRONLY | O_CLOEXEC);
    } else {
      temporary_ += ".part" + std::to_string(::getpid());
      file_ = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
    }
    if (file_ < 0) code_ = errno;
  }
  PartFile(const PartFile&) = delete;
  PartFile& operator=(const PartFile&) = delete;
  ~PartFile() {
    if (file_ < 0) return;
    ::close(file_);
    if (!stream_) ::unlink(temporary_.c_str());
  }

  void write(std::string_view bytes) {
    while (code_ == 0 && !bytes.empty()) {
      const ssize_t count = ::write(file_, bytes.data(), bytes.size());
      if (count >= 0) {
        bytes.remove_prefix(static_cast<std::size_t>(count));
      } else if (errno != EINTR) {
        code_ = errno;
      }
    }
  }

  Status publish() {
    if (code_ == 0 && !stream_ && ::fsync(file_) != 0) code_ = errno;
    if (code_ == 0 && !stream_ && ::rename(temporary_.c_str(), path_.c_str()) != 0) code_ = errno;
    if (code_ != 0) {
      return Error::output(Message("cannot be written: %1", std::system_category().message(code_)),
                           path_.string());
    }
    ::close(file_);
    file_ = -1;
    return Done{};
  }

  [[nodiscard]] bool failed() const { return code_ != 0; }

 private:
  std::filesystem::path path_;
  bool stream_;
  std::filesystem::path temporary_;
  int file_ = -1;
  int code_ = 0;
};

std::string header_text(const Cloud& cloud) {
  std::string fields = "x y z";
  std::string sizes = "4 4 4";
  std::string types = "F F F";
  std::string counts = "1 1 1";
  const auto add = [&](bool present, const char* name, const char* size, const char* type) {
    if (!present) return;
    fields += std::string(" ") + name;
    sizes += std::string(" ") + size;
    types += std::string(" ") + type;
    counts += " 1";
  };
  add(cloud.has_intensity(), "intensity", "4", "F");
  add(cloud.has_time(), "time", "4", "F");
  add(cloud.has_line(), "line", "2", "U");
  const std::string size = std::to_string(cloud.size());
  // Points that were added or taken away since leave no grid.
  const bool grid = cloud.rows > 1 && cloud.size() % cloud.rows == 0;
  const std::size_t rows = grid ? cloud.rows : 1;
  return "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\nFIELDS " + fields + "\nSIZE " +
         sizes + "\nTYPE " + types + "\nCOUNT " + counts + "\nWIDTH " +
         std::to_string(cloud.size() / rows) + "\nHEIGHT " + std::to_string(rows) +
         "\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " + size + "\nDATA binary\n";
}

template <class T>
void append(std::string& bytes, const T* values, std::size_t count) {
  bytes.append(reinterpret_cast<const char*>(values), count * sizeof(T));
}

}  // namespace

Status write_pcd(const std::filesystem::path& path, const Cloud& cloud) {
  const auto fits = [&](const auto& column) {
    return column.empty() || column.size() == cloud.size();
  };
  if (!fits(cloud.intensity) || !fits(cloud.time_s) || !fits(cloud.line)) {
    return Error::output(Message("cloud has columns of different length"), path.string());
  }
  constexpr std::size_t kBlock = std::size_t{1} << 20;
  PartFile file(path);
  std::string bytes = header_text(cloud);
  bytes.reserve(kBlock + 64);
  for (std::size_t i = 0; i < cloud.size() && !file.failed(); ++i) {
    append(bytes, cloud.points_m[i].data(), 3);
    if (cloud.has_intensity()) append(bytes, &cloud.intensity[i], 1);
    if (cloud.has_time()) append(bytes, &cloud.time_s[i], 1);
    if (cloud.has_line()) append(bytes, &cloud.line[i], 1);
    if (bytes.size() < kBlock) continue;
    file.write(bytes);
    bytes.clear();
  }
  file.write(bytes);
  return file.publish();
}

}  // namespace lvcalib
