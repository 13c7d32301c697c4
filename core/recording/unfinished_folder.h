// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "base/error.h"

namespace lvcalib {

/// A dataset folder under another name beside its place, which it takes when it is complete.
/// Without finish() nothing of it stays, or, of a process that was killed, until the next one makes
/// a folder for the same place.
class UnfinishedFolder {
 public:
  /// `replace`: an earlier import of that name may be replaced. Errors: no name for a folder; it
  /// exists and is no import, or is not to be replaced; it cannot be written.
  static Result<UnfinishedFolder> create(const std::filesystem::path& destination, bool replace);
  UnfinishedFolder(UnfinishedFolder&& other) noexcept;
  UnfinishedFolder& operator=(UnfinishedFolder&&) = delete;
  UnfinishedFolder(const UnfinishedFolder&) = delete;
  UnfinishedFolder& operator=(const UnfinishedFolder&) = delete;
  ~UnfinishedFolder();

  /// Where to write meanwhile.
  [[nodiscard]] const std::filesystem::path& path() const { return temporary_; }
  Status finish();

 private:
  explicit UnfinishedFolder(std::filesystem::path path) : path_(std::move(path)) {}
  std::filesystem::path path_;
  std::filesystem::path temporary_;
  int lock_ = -1;  // Says that somebody still works on it.
};

}  // namespace lvcalib
