// SPDX-License-Identifier: BSD-3-Clause
#include "base/file_io.h"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <system_error>

#include <fcntl.h>
#include <unistd.h>

namespace lvcalib {
namespace fs = std::filesystem;

Result<std::string> read_text_file(const fs::path& path, std::size_t max_bytes) {
  std::error_code code;
  const fs::file_status status = fs::status(path, code);
  if (!fs::exists(status)) return Error::input("file not found", path.string());
  if (!fs::is_regular_file(status)) return Error::input("not a regular file", path.string());
  const auto size = fs::file_size(path, code);
  if (code) return Error::input("cannot be read: " + code.message(), path.string());
  if (size > max_bytes) {
    return Error::input("file is too large: " + std::to_string(size) + " bytes, expected at most " +
                            std::to_string(max_bytes),
                        path.string());
  }
  std::ifstream stream(path, std::ios::binary);
  std::string text(static_cast<std::size_t>(size), '\0');
  stream.read(text.data(), static_cast<std::streamsize>(size));
  if (!stream) {
    return Error::input("cannot be read: " + std::string(std::strerror(errno)), path.string());
  }
  return text;
}

Status write_file_atomically(const fs::path& path, std::string_view content) {
  fs::path temporary = path;
  temporary += ".part" + std::to_string(::getpid());
  const auto fail = [&](int code) -> Status {
    ::unlink(temporary.c_str());
    return Error::output("cannot be written: " + std::string(std::strerror(code)), path.string());
  };
  const int file = ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (file < 0) return fail(errno);
  while (!content.empty()) {
    const ssize_t written = ::write(file, content.data(), content.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) {
      const int code = errno;
      ::close(file);
      return fail(code);
    }
    content.remove_prefix(static_cast<std::size_t>(written));
  }
  const bool flushed = ::fsync(file) == 0;
  const int flush_error = errno;
  if (::close(file) != 0) return fail(errno);
  if (!flushed) return fail(flush_error);
  if (::rename(temporary.c_str(), path.c_str()) != 0) return fail(errno);
  return Done{};
}

Status create_folder(const fs::path& path) {
  std::error_code code;
  fs::create_directories(path, code);
  if (code || !fs::is_directory(path)) {
    return Error::output(
        "folder cannot be created: " + (code ? code.message() : "a file is in the way"),
        path.string());
  }
  return Done{};
}

}  // namespace lvcalib
