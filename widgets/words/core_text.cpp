// SPDX-License-Identifier: GPL-3.0-or-later
#include "words/core_text.h"

#include <QCoreApplication>
#include <vector>

namespace lvcalib::widgets {

QString core_text(const Message& message) {
  const std::string& id = message.id();
  if (!message.translatable()) return QString::fromStdString(id);
  const QString text = QCoreApplication::translate("Core", id.c_str());
  const std::vector<Message>& arguments = message.arguments();
  if (arguments.empty()) return text;
  // Places are filled in one pass: what is filled in may itself hold a %1.
  QString out;
  for (qsizetype i = 0; i < text.size(); ++i) {
    const bool place = text[i] == QLatin1Char('%') && i + 1 < text.size();
    const int number = place ? text[i + 1].digitValue() : 0;
    if (number < 1 || number > static_cast<int>(arguments.size())) {
      out += text[i];
      continue;
    }
    out += core_text(arguments[static_cast<std::size_t>(number - 1)]);
    ++i;
  }
  return out;
}

QString warning_text(const Message& warning) {
  const bool of_the_whole = warning.id() == "result: %1" && warning.arguments().size() == 1;
  return core_text(of_the_whole ? warning.arguments().front() : warning);
}

QString core_text(const Error& error) {
  return core_text(error.sentence());
}

}  // namespace lvcalib::widgets
