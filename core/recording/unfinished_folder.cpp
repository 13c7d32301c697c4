// SPDX-License-Identifier: BSD-3-Clause
#include "recording/unfinished_folder.h"

#include <string>
#include <system_error>

#include <unistd.h>

#include "base/file_io.h"

namespace lvcalib {
namespace fs = std::filesystem;

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
  const std::string name = "." + path.filename().string() + ".part" + std::to_string(::getpid());
  for (int i = 0; out.temporary_.empty(); ++i) {
    const fs::path place = path.parent_path() / (name + "-" + std::to_string(i));
    const bool created = fs::create_directory(place, code);
    if (code) return Error::output(Message("cannot be made: %1", code.message()), place.string());
    if (created) out.temporary_ = place;
  }
  if (Status s = create_folder(out.temporary_ / "scenes"); !s) return s.error();
  return out;
}

UnfinishedFolder::UnfinishedFolder(UnfinishedFolder&& other) noexcept
    : path_(std::move(other.path_)), temporary_(std::move(other.temporary_)) {
  other.temporary_.clear();
}

UnfinishedFolder::~UnfinishedFolder() {
  std::error_code code;
  if (!temporary_.empty()) fs::remove_all(temporary_, code);
}

Status UnfinishedFolder::finish() {
  std::error_code code;
  fs::path old = temporary_;
  old += "-old";
  const bool replaces = fs::exists(path_, code);
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
