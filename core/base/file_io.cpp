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
  if (!fs::exists(status)) return Error::input(Message("file not found"), path.string());
  if (!fs::is_regular_file(status))
    return Error::input(Message("not a regular file"), path.string());
  const auto size = fs::file_size(path, code);
  if (code) return Error::input(Message("cannot be read: %1", code.message()), path.string());
  if (size > max_bytes) {
    return Error::input(
        Message("file is too large: %1 bytes, expected at most %2", size, max_bytes),
        path.string());
  }
  std::ifstream stream(path, std::ios::binary);
  std::string text(static_cast<std::size_t>(size), '\0');
  stream.read(text.data(), static_cast<std::streamsize>(size));
  if (!stream) {
    return Error::input(Message("cannot be read: %1", std::string(std::strerror(errno))),
                        path.string());
  }
  return text;
}

namespace {

// Writes and flushes everything; the errno of the first failure, or 0. Closes the file.
int write_and_close(int file, std::string_view content) {
  int failure = 0;
  while (!content.empty() && failure == 0) {
    const ssize_t written = ::write(file, content.data(), content.size());
    if (written >= 0) {
      content.remove_prefix(static_cast<std::size_t>(written));
    } else if (errno != EINTR) {
      failure = errno;
    }
  }
  // Pipes and terminals have nothing to flush.
  if (failure == 0 && ::fsync(file) != 0 && errno != EINVAL && errno != EROFS) failure = errno;
  if (::close(file) != 0 && failure == 0) failure = errno;
  return failure;
}

// Writes to a file without a name, which vanishes if the process is killed, and names it when it
// is complete. EOPNOTSUPP where the file system has no such files.
int write_unnamed(const fs::path& path, std::string_view content) {
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  const int file = ::open(folder.c_str(), O_WRONLY | O_TMPFILE | O_CLOEXEC, 0644);
  if (file < 0) return EOPNOTSUPP;
  const int keep = ::fcntl(file, F_DUPFD_CLOEXEC, 0);
  if (keep < 0) {
    ::close(file);
    return EOPNOTSUPP;
  }
  int failure = write_and_close(file, content);
  const std::string link = "/proc/self/fd/" + std::to_string(keep);
  if (failure == 0 &&
      ::linkat(AT_FDCWD, link.c_str(), AT_FDCWD, path.c_str(), AT_SYMLINK_FOLLOW) != 0) {
    failure = EOPNOTSUPP;
  }
  ::close(keep);
  return failure;
}

int write_named(const fs::path& path, std::string_view content) {
  const int file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  return file < 0 ? errno : write_and_close(file, content);
}

fs::path temporary_for(const fs::path& path) {
  fs::path temporary = path;
  temporary += ".part" + std::to_string(::getpid());
  return temporary;
}

// Everything under a name that nobody reads; the errno of the first failure, or 0.
int write_temporary(const fs::path& temporary, std::string_view content) {
  const int failure = write_unnamed(temporary, content);
  return failure == EOPNOTSUPP ? write_named(temporary, content) : failure;
}

Error not_written(int failure, const fs::path& path) {
  return Error::output(Message("cannot be written: %1", std::string(std::strerror(failure))),
                       path.string());
}

}  // namespace

bool is_stream(const fs::path& path) {
  std::error_code code;
  const auto type = fs::status(path, code).type();
  // What a shell has opened is reached through /dev, be it a file.
  if (type == fs::file_type::character || type == fs::file_type::fifo ||
      type == fs::file_type::socket || type == fs::file_type::block)
    return true;
  const std::string name = path.lexically_normal().string();
  return name.starts_with("/dev/std") || name.starts_with("/dev/fd/") ||
         name.starts_with("/proc/self/fd/");
}

fs::path behind_links(const fs::path& path) {
  std::error_code code;
  if (!fs::is_symlink(path, code) || code) return path;
  const fs::path real = fs::weakly_canonical(path, code);
  return code ? path : real;
}

Status write_file_atomically(const fs::path& name, std::string_view content) {
  if (is_stream(name)) {
    const int file = ::open(name.c_str(), O_WRONLY | O_CLOEXEC);
    const int failure = file < 0 ? errno : write_and_close(file, content);
    return failure == 0 ? Status(Done{}) : not_written(failure, name);
  }
  const fs::path path = behind_links(name);
  const fs::path temporary = temporary_for(path);
  int failure = write_temporary(temporary, content);
  if (failure == 0 && ::rename(temporary.c_str(), path.c_str()) != 0) failure = errno;
  if (failure == 0) return Done{};
  ::unlink(temporary.c_str());
  return not_written(failure, path);
}

Status write_files_together(const fs::path& folder,
                            const std::vector<std::pair<std::string, std::string>>& files) {
  int failure = 0;
  fs::path failed;
  for (const auto& [name, content] : files) {
    failed = folder / name;
    failure = write_temporary(temporary_for(failed), content);
    if (failure != 0) break;
  }
  // The earlier ones go before the first new one comes: a mixture would be believed.
  for (std::size_t k = 0; failure == 0 && k < files.size(); ++k) {
    failed = folder / files[k].first;
    if (::unlink(failed.c_str()) != 0 && errno != ENOENT) failure = errno;
  }
  for (std::size_t k = 0; failure == 0 && k < files.size(); ++k) {
    failed = folder / files[k].first;
    if (::rename(temporary_for(failed).c_str(), failed.c_str()) != 0) failure = errno;
  }
  if (failure == 0) return Done{};
  for (const auto& [name, content] : files) ::unlink(temporary_for(folder / name).c_str());
  return not_written(failure, failed);
}

Status create_folder(const fs::path& path) {
  std::error_code code;
  fs::create_directories(path, code);
  if (code || !fs::is_directory(path)) {
    return Error::output(
        Message("folder cannot be created: %1",
                code ? Message::verbatim(code.message()) : Message("a file is in the way")),
        path.string());
  }
  return Done{};
}

Status check_folder_usable(const fs::path& path) {
  std::error_code code;
  fs::path existing = fs::absolute(path, code);
  while (!existing.empty() && !fs::exists(existing, code) && existing != existing.root_path())
    existing = existing.parent_path();
  const bool itself = existing == fs::absolute(path, code);
  if (!fs::is_directory(existing, code)) {
    const std::string file = existing.string();
    return Error::output(itself
                             ? Message("folder cannot be created: a file is in the way")
                             : Message("folder cannot be created: a file is in the way (%1)", file),
                         path.string(), Message("give another folder"));
  }
  if (::access(existing.c_str(), W_OK | X_OK) != 0) {
    return Error::output(
        itself ? Message("folder cannot be written: no right to do so")
               : Message("folder cannot be created: no right to write to %1", existing.string()),
        path.string(), Message("give another folder"));
  }
  return Done{};
}

}  // namespace lvcalib
