// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"

namespace lvcalib {

/// Unread bytes of a file or of memory through one buffer, filled chunk by chunk. The buffer
/// holds one chunk unless its user leaves more than that unread.
class Input {
 public:
  /// Large enough that system calls do not count, small enough to stay in the cache.
  static constexpr std::size_t kDefaultChunk = std::size_t{1} << 20;

  /// Opens a regular file.
  static Result<Input> open(const std::filesystem::path& path, std::stop_token stop);
  /// `content` must outlive the input; `name` stands for the file in messages.
  static Input from_memory(std::string_view content, std::string name,
                           std::size_t chunk_bytes = kDefaultChunk);

  Input(Input&& other) noexcept;
  Input& operator=(Input&&) = delete;
  Input(const Input&) = delete;
  Input& operator=(const Input&) = delete;
  ~Input();

  /// What has been read and not been consumed. Valid until the next call of more().
  [[nodiscard]] std::string_view rest() const {
    return {buffer_.data() + begin_, filled_ - begin_};
  }
  void consume(std::size_t bytes) { begin_ += bytes; }

  /// Adds at least one byte to rest(). False at the end of the file; an error if reading fails
  /// or a stop was requested.
  Result<bool> more();

  /// Reads on until rest() has `bytes`. False if the file ends before.
  Result<bool> require(std::size_t bytes);

  /// Consumes `bytes`, buffered or not. False if the file ends before.
  Result<bool> skip(std::uint64_t bytes);

  /// Bytes between here and the end: what a header may claim at most.
  [[nodiscard]] std::uint64_t remaining() const { return unread_ + (filled_ - begin_); }
  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] Error error(Message message, Message hint = {}) const {
    return Error::input(std::move(message), name_, std::move(hint));
  }

 private:
  Input(std::string name, std::size_t chunk_bytes) : name_(std::move(name)), chunk_(chunk_bytes) {}
  Result<std::size_t> read_some(char* to, std::size_t size);

  std::string name_;
  std::size_t chunk_;
  std::stop_token stop_;
  int file_ = -1;
  std::string_view memory_;
  std::uint64_t unread_ = 0;  ///< Bytes that are not in the buffer yet.
  std::vector<char> buffer_;
  std::size_t begin_ = 0;
  std::size_t filled_ = 0;
};

}  // namespace lvcalib
