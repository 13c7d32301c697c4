// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <concepts>
#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace lvcalib {

/// A sentence for people, as data: the program's own text with numbered places (%1 to %9), and what
/// fills them. The English text is also the sentence's id, by which a window finds it in the table
/// of its language; packaging/core-messages.py collects all of them from the source. Nothing reads
/// a finished sentence back.
class Message {
 public:
  Message() = default;

  /// A sentence of the program, written out where it is used. Arguments are whole numbers, letters,
  /// words that nobody translates (a name, a number with its decimals) and further messages.
  template <std::size_t N, class... Arguments>
  explicit Message(const char (&id)[N], const Arguments&... arguments)
      : text_(id), translatable_(true), arguments_{argument(arguments)...} {
    static_assert(sizeof...(Arguments) <= 9, "places are single digits");
  }

  /// A sentence that the program declares in a list (an option's description, an effect's title or
  /// id, which a window says as its title).
  static Message listed(std::string id);

  /// Words that nobody translates: a name, a number, what a library or a file says.
  static Message verbatim(std::string words);

  [[nodiscard]] bool empty() const { return text_.empty(); }
  [[nodiscard]] bool translatable() const { return translatable_; }
  /// The text with its places; the words themselves if nobody translates them.
  [[nodiscard]] const std::string& id() const { return text_; }
  [[nodiscard]] const std::vector<Message>& arguments() const { return arguments_; }
  /// In English, with all places filled.
  [[nodiscard]] std::string text() const;
  explicit operator std::string() const { return text(); }

  /// One sentence behind the other, without anything between them.
  Message& operator+=(const Message& next);
  friend Message operator+(Message first, const Message& next) { return first += next; }
  friend bool operator==(const Message&, const Message&) = default;

 private:
  static Message argument(const Message& message) { return message; }
  static Message argument(std::string_view words) { return verbatim(std::string(words)); }
  static Message argument(char letter) { return verbatim(std::string(1, letter)); }
  template <std::integral Number>
  requires(!std::same_as<Number, bool>) static Message argument(Number number) {
    return verbatim(std::to_string(number));
  }

  std::string text_;
  bool translatable_ = false;
  std::vector<Message> arguments_;
};

/// Several messages, with something between each two (", " or "; ").
Message joined(const std::vector<Message>& messages, const char* between);

/// "a, b and c" of several messages.
Message all_of(const std::vector<Message>& messages);
/// "a, b or c".
Message one_of(const std::vector<Message>& messages);

/// A text with the places %1 to %`count` filled by words(0) to words(count − 1), in one pass: what
/// fills a place may itself hold a percent sign. Other places stay as they are.
std::string fill_places(std::string_view text, std::size_t count,
                        const std::function<std::string(std::size_t)>& words);

}  // namespace lvcalib
