// SPDX-License-Identifier: BSD-3-Clause
#include "base/error.h"

namespace lvcalib {

std::string Error::text() const {
  std::string out = where.empty() ? message : where + ": " + message;
  if (!hint.empty()) out += " (" + hint + ")";
  return out;
}

Error Error::input(std::string message, std::string where, std::string hint) {
  return {ErrorKind::kInput, std::move(message), std::move(where), std::move(hint)};
}
Error Error::untrusted(std::string message, std::string where, std::string hint) {
  return {ErrorKind::kUntrusted, std::move(message), std::move(where), std::move(hint)};
}
Error Error::output(std::string message, std::string where, std::string hint) {
  return {ErrorKind::kOutput, std::move(message), std::move(where), std::move(hint)};
}
Error Error::usage(std::string message, std::string where, std::string hint) {
  return {ErrorKind::kUsage, std::move(message), std::move(where), std::move(hint)};
}
Error Error::cancelled() {
  return {ErrorKind::kCancelled, "stopped by the user", {}, {}};
}

}  // namespace lvcalib
