// SPDX-License-Identifier: BSD-3-Clause
#include "base/message.h"

#include <utility>

namespace lvcalib {

Message Message::listed(std::string id) {
  Message out = verbatim(std::move(id));
  out.translatable_ = !out.text_.empty();
  return out;
}

Message Message::verbatim(std::string words) {
  Message out;
  out.text_ = std::move(words);
  return out;
}

std::string Message::text() const {
  if (!translatable_ || arguments_.empty()) return text_;
  std::string out;
  // One pass: what fills a place may itself hold a percent sign.
  for (std::size_t i = 0; i < text_.size(); ++i) {
    const bool digit =
        text_[i] == '%' && i + 1 < text_.size() && text_[i + 1] >= '1' && text_[i + 1] <= '9';
    const std::size_t place = digit ? static_cast<std::size_t>(text_[i + 1] - '1') : 0;
    if (digit && place < arguments_.size()) {
      out += arguments_[place].text();
      ++i;
    } else {
      out += text_[i];
    }
  }
  return out;
}

Message& Message::operator+=(const Message& next) {
  if (next.empty()) return *this;
  if (empty()) return *this = next;
  return *this = Message("%1%2", Message(*this), next);
}

Message joined(const std::vector<Message>& messages, const char* between) {
  Message out;
  for (const Message& message : messages) {
    if (!out.empty()) out += Message::verbatim(between);
    out += message;
  }
  return out;
}

}  // namespace lvcalib
