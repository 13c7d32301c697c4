// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <utility>
#include <variant>

#include "base/message.h"

namespace lvcalib {

/// What kind of thing went wrong. The command line maps each kind to its exit status.
enum class ErrorKind {
  kUntrusted,  ///< The computation ran, but its result cannot be trusted (exit 1).
  kUsage,      ///< Wrong options or arguments (exit 2).
  kInput,      ///< An input file is missing, malformed or unusable (exit 3).
  kOutput,     ///< A result could not be written (exit 3).
  kCancelled,  ///< Stopped through the stop token (exit 130).
};

/// A typed error: what, where, what was expected, what to do.
struct Error {
  ErrorKind kind = ErrorKind::kInput;
  Message message;    ///< One sentence: what is wrong, what was found, what was expected.
  std::string where;  ///< File (and line or field) or scene; may be empty.
  Message hint;       ///< What the user can do; may be empty.
  /// The key of the file whose value is wrong; empty if it is not one.
  std::string field = {};

  /// "where: message (hint)" as one sentence, for another sentence or another language.
  [[nodiscard]] Message sentence() const;
  /// The same in English, on a single line.
  [[nodiscard]] std::string text() const;

  static Error input(Message message, std::string where = {}, Message hint = {});
  static Error untrusted(Message message, std::string where = {}, Message hint = {});
  static Error output(Message message, std::string where = {}, Message hint = {});
  static Error usage(Message message, std::string where = {}, Message hint = {});
  static Error cancelled();
};

/// Either a value or an Error. Small stand-in for std::expected (C++23).
template <class T>
class [[nodiscard]] Result {
 public:
  Result(T value) : content_(std::move(value)) {}      // NOLINT: implicit by design
  Result(Error error) : content_(std::move(error)) {}  // NOLINT: implicit by design

  [[nodiscard]] bool ok() const { return std::holds_alternative<T>(content_); }
  explicit operator bool() const { return ok(); }

  T& value() & { return std::get<T>(content_); }
  const T& value() const& { return std::get<T>(content_); }
  T&& value() && { return std::get<T>(std::move(content_)); }
  T* operator->() { return &value(); }
  const T* operator->() const { return &value(); }
  T& operator*() & { return value(); }
  const T& operator*() const& { return value(); }
  T&& operator*() && { return std::move(*this).value(); }

  [[nodiscard]] const Error& error() const { return std::get<Error>(content_); }

 private:
  std::variant<T, Error> content_;
};

/// Result of an operation without a value.
struct Done {};
using Status = Result<Done>;

}  // namespace lvcalib
