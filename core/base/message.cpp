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
  return fill_places(text_, arguments_.size(),
                     [&](std::size_t place) { return arguments_[place].text(); });
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

namespace {

// The last message with a word before it, the others with commas.
std::pair<Message, Message> but_last_and_last(const std::vector<Message>& messages) {
  return {joined({messages.begin(), messages.end() - 1}, ", "), messages.back()};
}

}  // namespace

Message all_of(const std::vector<Message>& messages) {
  if (messages.size() < 2) return joined(messages, "");
  const auto [others, last] = but_last_and_last(messages);
  return Message("%1 and %2", others, last);
}

Message one_of(const std::vector<Message>& messages) {
  if (messages.size() < 2) return joined(messages, "");
  const auto [others, last] = but_last_and_last(messages);
  return Message("%1 or %2", others, last);
}

std::string fill_places(std::string_view text, std::size_t count,
                        const std::function<std::string(std::size_t)>& words) {
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool digit =
        text[i] == '%' && i + 1 < text.size() && text[i + 1] >= '1' && text[i + 1] <= '9';
    const std::size_t place = digit ? static_cast<std::size_t>(text[i + 1] - '1') : 0;
    if (digit && place < count) {
      out += words(place);
      ++i;
    } else {
      out += text[i];
    }
  }
  return out;
}

}  // namespace lvcalib
