// SPDX-License-Identifier: BSD-3-Clause
#include "recording/random_file.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <unistd.h>

namespace lvcalib {

Result<RandomFile> RandomFile::open(const std::filesystem::path& path, std::string name) {
  if (name.empty()) name = path.string();
  std::error_code code;
  const auto status = std::filesystem::status(path, code);
  if (!std::filesystem::exists(status)) return Error::input(Message("file not found"), name);
  if (!std::filesystem::is_regular_file(status)) {
    return Error::input(Message("not a regular file"), name);
  }
  RandomFile out;
  out.file_ = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (out.file_ < 0) {
    return Error::input(Message("cannot be read: %1", std::strerror(errno)), name);
  }
  out.size_ = std::filesystem::file_size(path, code);
  if (code) return Error::input(Message("cannot be read: %1", code.message()), name);
  out.name_ = std::move(name);
  return out;
}

RandomFile RandomFile::from_memory(std::string_view content, std::string name) {
  RandomFile out;
  out.name_ = std::move(name);
  out.memory_ = content;
  out.size_ = content.size();
  return out;
}

RandomFile::RandomFile(RandomFile&& other) noexcept
    : name_(std::move(other.name_)),
      memory_(other.memory_),
      size_(other.size_),
      file_(std::exchange(other.file_, -1)) {}

RandomFile::~RandomFile() {
  if (file_ >= 0) ::close(file_);
}

void RandomFile::read(std::uint64_t offset, std::uint64_t count, std::string& out) const {
  if (offset >= size_) {
    out.clear();
    return;
  }
  count = std::min(count, size_ - offset);
  if (file_ < 0) {
    out.assign(memory_.substr(static_cast<std::size_t>(offset), static_cast<std::size_t>(count)));
    return;
  }
  out.resize(static_cast<std::size_t>(count));
  std::size_t filled = 0;
  while (filled < out.size()) {
    const ssize_t got = ::pread(file_, out.data() + filled, out.size() - filled,
                                static_cast<off_t>(offset + filled));
    if (got > 0) {
      filled += static_cast<std::size_t>(got);
    } else if (got == 0 || errno != EINTR) {
      break;
    }
  }
  out.resize(filled);
}

}  // namespace lvcalib
