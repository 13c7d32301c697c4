// SPDX-License-Identifier: BSD-3-Clause
#include "base/error.h"

namespace lvcalib {

Message Error::sentence() const {
  const Message placed = where.empty() ? message : Message("%1: %2", where, message);
  return hint.empty() ? placed : Message("%1 (%2)", placed, hint);
}

std::string Error::text() const {
  return sentence().text();
}

Error Error::input(Message message, std::string where, Message hint) {
  return {ErrorKind::kInput, std::move(message), std::move(where), std::move(hint), {}};
}
Error Error::untrusted(Message message, std::string where, Message hint) {
  return {ErrorKind::kUntrusted, std::move(message), std::move(where), std::move(hint), {}};
}
Error Error::output(Message message, std::string where, Message hint) {
  return {ErrorKind::kOutput, std::move(message), std::move(where), std::move(hint), {}};
}
Error Error::usage(Message message, std::string where, Message hint) {
  return {ErrorKind::kUsage, std::move(message), std::move(where), std::move(hint), {}};
}
Error Error::cancelled() {
  return {ErrorKind::kCancelled, Message("stopped by the user"), {}, {}, {}};
}

}  // namespace lvcalib
