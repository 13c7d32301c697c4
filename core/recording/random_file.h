// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "base/error.h"

namespace lvcalib {

/// A file (or bytes in memory) of which any part can be read.
class RandomFile {
 public:
  /// `name` stands for the file in messages; empty: its path.
  static Result<RandomFile> open(const std::filesystem::path& path, std::string name = {});
  /// `content` must outlive the file.
  static RandomFile from_memory(std::string_view content, std::string name);

  RandomFile(RandomFile&& other) noexcept;
  RandomFile& operator=(RandomFile&&) = delete;
  RandomFile(const RandomFile&) = delete;
  RandomFile& operator=(const RandomFile&) = delete;
  ~RandomFile();

  [[nodiscard]] std::uint64_t size() const { return size_; }
  [[nodiscard]] const std::string& name() const { return name_; }

  /// Replaces `out` by up to `count` bytes from `offset` on: fewer at the file's end, or where it
  /// cannot be read.
  void read(std::uint64_t offset, std::uint64_t count, std::string& out) const;

 private:
  RandomFile() = default;
  std::string name_;
  std::string_view memory_;
  std::uint64_t size_ = 0;
  int file_ = -1;
};

}  // namespace lvcalib
