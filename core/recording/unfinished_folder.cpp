// SPDX-License-Identifier: BSD-3-Clause
#include "recording/unfinished_folder.h"

#include <cstdio>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include "base/file_io.h"

namespace lvcalib {
namespace fs = std::filesystem;

namespace {

constexpr const char* kBefore = "-old";

// The folder opened and locked as long as it is open, which ends with the process however that
// ends; −1 if somebody else holds it, or where folders cannot be locked.
int lock_folder(const fs::path& folder) {
  const int file = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (file < 0 || ::flock(file, LOCK_EX | LOCK_NB) == 0) return file;
  ::close(file);
  return -1;
}

// What imports to `path` left that were killed: folders of that name whose maker holds them no
// longer. What stood at `path` before stays as long as nothing has taken its place.
void remove_abandoned(const fs::path& path, const std::string& part) {
  std::error_code code;
  std::vector<fs::path> found;
  for (const auto& entry : fs::directory_iterator(path.parent_path(), code)) {
    const std::string name = entry.path().filename().string();
    if (!name.starts_with(part) || !entry.is_directory(code)) continue;
    if (!name.ends_with(kBefore) || fs::exists(path, code)) found.push_back(entry.path());
  }
  for (const fs::path& folder : found) {
    const int held = lock_folder(folder);
    if (held < 0) continue;
    fs::remove_all(folder, code);
    ::close(held);
  }
}

}  // namespace

Result<UnfinishedFolder> UnfinishedFolder::create(const fs::path& destination, bool replace) {
  std::error_code code;
  fs::path path = fs::absolute(destination, code).lexically_normal();
  if (!path.has_filename()) path = path.parent_path();
  if (destination.empty() || !path.has_filename()) {
    return Error::output(Message("is no name for a dataset folder"), destination.string());
  }
  const bool exists = fs::exists(fs::symlink_status(path, code));
  const bool empty = fs::is_directory(path, code) && fs::is_empty(path, code);
  if (exists && !empty) {
    const bool imported = fs::is_regular_file(path / "import.json", code);
    if (!replace || !imported) {
      return Error::output(
          imported ? Message("exists already") : Message("exists already and is no import"),
          destination.string(),
          imported ? Message("choose another name, or replace it with --force")
                   : Message("choose another name"));
    }
  }
  if (Status s = check_folder_usable(path.parent_path()); !s) return s.error();
  if (Status s = create_folder(path.parent_path()); !s) return s.error();
  UnfinishedFolder out(path);
  // A name of its own: an import that was cancelled may still be clearing up.
  const std::string part = "." + path.filename().string() + ".part";
  remove_abandoned(path, part);
  const std::string name = part + std::to_string(::getpid());
  for (int i = 0; out.temporary_.empty(); ++i) {
    const fs::path place = path.parent_path() / (name + "-" + std::to_string(i));
    const bool created = fs::create_directory(place, code);
    if (code) return Error::output(Message("cannot be made: %1", code.message()), place.string());
    if (created) out.temporary_ = place;
  }
  out.lock_ = lock_folder(out.temporary_);
  if (Status s = create_folder(out.temporary_ / "scenes"); !s) return s.error();
  return out;
}

UnfinishedFolder::UnfinishedFolder(UnfinishedFolder&& other) noexcept
    : path_(std::move(other.path_)), temporary_(std::move(other.temporary_)), lock_(other.lock_) {
  other.temporary_.clear();
  other.lock_ = -1;
}

UnfinishedFolder::~UnfinishedFolder() {
  std::error_code code;
  if (!temporary_.empty()) fs::remove_all(temporary_, code);
  if (lock_ >= 0) ::close(lock_);
}

Status UnfinishedFolder::finish() {
  std::error_code code;
  fs::path old = temporary_;
  old += kBefore;
  const bool replaces = fs::exists(path_, code);
  if (replaces &&
      ::renameat2(AT_FDCWD, temporary_.c_str(), AT_FDCWD, path_.c_str(), RENAME_EXCHANGE) == 0) {
    fs::remove_all(std::exchange(temporary_, {}), code);
    return Done{};
  }
  // Where two names cannot be exchanged at once.
  if (replaces) fs::rename(path_, old, code);
  if (!code) fs::rename(temporary_, path_, code);
  if (code) {
    const std::string why = code.message();
    if (replaces && !fs::exists(path_, code)) fs::rename(old, path_, code);
    return Error::output(Message("cannot be put in place: %1", why), path_.string());
  }
  temporary_.clear();
  if (replaces) fs::remove_all(old, code);
  return Done{};
}

}  // namespace lvcalib
