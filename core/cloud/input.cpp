// SPDX-License-Identifier: BSD-3-Clause
#include "cloud/input.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace lvcalib {
namespace fs = std::filesystem;

Result<Input> Input::open(const fs::path& path, std::stop_token stop) {
  std::error_code code;
  const fs::file_status status = fs::status(path, code);
  if (!fs::exists(status)) return Error::input(Message("file not found"), path.string());
  if (fs::is_directory(status)) {
    return Error::input(Message("is a folder, expected a PCD or PLY file"), path.string());
  }
  if (!fs::is_regular_file(status))
    return Error::input(Message("not a regular file"), path.string());

  Input input(path.string(), kDefaultChunk);
  input.stop_ = std::move(stop);
  input.file_ = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  struct stat facts = {};
  if (input.file_ < 0 || ::fstat(input.file_, &facts) != 0) {
    return Error::input(Message("cannot be read: %1", std::system_category().message(errno)),
                        path.string());
  }
  input.unread_ = static_cast<std::uint64_t>(facts.st_size);
  return input;
}

Input Input::from_memory(std::string_view content, std::string name, std::size_t chunk_bytes) {
  Input input(std::move(name), chunk_bytes);
  input.memory_ = content;
  input.unread_ = content.size();
  return input;
}

Input::Input(Input&& other) noexcept
    : name_(std::move(other.name_)),
      chunk_(other.chunk_),
      stop_(std::move(other.stop_)),
      file_(std::exchange(other.file_, -1)),
      memory_(other.memory_),
      unread_(other.unread_),
      buffer_(std::move(other.buffer_)),
      begin_(std::exchange(other.begin_, 0)),
      filled_(std::exchange(other.filled_, 0)) {}

Input::~Input() {
  if (file_ >= 0) ::close(file_);
}

Result<bool> Input::more() {
  if (stop_.stop_requested()) return Error::cancelled();
  if (begin_ > 0) {
    std::copy(buffer_.begin() + static_cast<std::ptrdiff_t>(begin_),
              buffer_.begin() + static_cast<std::ptrdiff_t>(filled_), buffer_.begin());
    filled_ -= begin_;
    begin_ = 0;
  }
  if (filled_ == buffer_.size()) {
    // Never beyond what the file has: a small file gets a small buffer.
    const std::uint64_t wanted = std::max<std::uint64_t>(chunk_, 2 * buffer_.size());
    buffer_.resize(static_cast<std::size_t>(std::min(wanted, filled_ + unread_)));
  }
  if (unread_ == 0) return false;
  auto count = read_some(buffer_.data() + filled_, buffer_.size() - filled_);
  if (!count) return count.error();
  filled_ += *count;
  // A file that shrinks while it is read ends here.
  unread_ = *count == 0 ? 0 : unread_ - *count;
  return *count > 0;
}

Result<bool> Input::require(std::size_t bytes) {
  while (rest().size() < bytes) {
    auto grew = more();
    if (!grew) return grew.error();
    if (!*grew) return false;
  }
  return true;
}

Result<bool> Input::skip(std::uint64_t bytes) {
  if (bytes > remaining()) return false;
  while (bytes > rest().size()) {
    bytes -= rest().size();
    consume(rest().size());
    auto grew = more();
    if (!grew) return grew.error();
    if (!*grew) return false;
  }
  consume(static_cast<std::size_t>(bytes));
  return true;
}

Result<std::size_t> Input::read_some(char* to, std::size_t size) {
  size = static_cast<std::size_t>(std::min<std::uint64_t>(size, unread_));
  if (file_ < 0) {
    std::memcpy(to, memory_.data() + (memory_.size() - unread_), size);
    return size;
  }
  for (;;) {
    const ssize_t count = ::read(file_, to, size);
    if (count >= 0) return static_cast<std::size_t>(count);
    if (errno != EINTR)
      return error(Message("cannot be read: %1", std::system_category().message(errno)));
  }
}

}  // namespace lvcalib
