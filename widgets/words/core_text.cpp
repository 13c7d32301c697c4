// SPDX-License-Identifier: GPL-3.0-or-later
#include "words/core_text.h"

#include <QCoreApplication>
#include <algorithm>
#include <cctype>
#include <vector>

#include "model/effect.h"
#include "model/measurement_table.h"

namespace lvcalib::widgets {
namespace {

QString translated(const char* text) {
  return QCoreApplication::translate("CoreWords", text);
}

// Effects by their titles, where words are nothing but their ids, as the core lists them: "a, b",
// "a or b".
QString by_titles(const QString& words) {
  const std::pair<QString, const char*> signs[] = {
      {QStringLiteral(", "), QT_TRANSLATE_NOOP("CoreWords", "%1, %2")},
      {QStringLiteral(" or "), QT_TRANSLATE_NOOP("CoreWords", "%1 or %2")},
      {QStringLiteral(" and "), QT_TRANSLATE_NOOP("CoreWords", "%1 and %2")}};
  for (const auto& [sign, pattern] : signs) {
    QString out;
    for (const QString& id : words.split(sign)) {
      const EffectPtr effect = find_effect(id.toStdString());
      if (!effect || effect->info().title.empty()) {
        out.clear();
        break;
      }
      const QString title = core_text(Message::listed(effect->info().title));
      out = out.isEmpty() ? title : translated(pattern).arg(out, title);
    }
    if (!out.isEmpty()) return out;
  }
  return words;
}

// "horizontal = 1.2 ± 0.1 mm, vertical = …": the names are put into the language.
QString with_parameter_names(QString words) {
  for (const std::string& name : parameter_words()) {
    const QString before = QString::fromStdString(name) + QStringLiteral(" = ");
    for (qsizetype at = 0; (at = words.indexOf(before, at)) >= 0; ++at) {
      if (at > 0 && words[at - 1] != QLatin1Char(' ')) continue;
      words.replace(at, qsizetype(name.size()), parameter_name(name));
    }
  }
  return words;
}

}  // namespace

const std::set<std::string>& parameter_words() {
  static const std::set<std::string> words = [] {
    constexpr std::size_t kShortestWord = 4;
    std::set<std::string> out;
    MeasurementTable one_line;
    one_line.lines = {0};
    for (const EffectPtr& effect : effect_catalogue()) {
      for (const EffectParameter& p : effect->parameters(one_line)) {
        const bool letters = std::all_of(p.name.begin(), p.name.end(), [](unsigned char c) {
          return std::isalpha(c) != 0 && c < 128;
        });
        if (letters && p.name.size() >= kShortestWord) out.insert(p.name);
      }
    }
    return out;
  }();
  return words;
}

QString parameter_name(const std::string& name) {
  if (parameter_words().count(name) == 0) return QString::fromStdString(name);
  return core_text(Message::listed(name));
}

QString core_text(const Message& message) {
  const std::string& id = message.id();
  if (!message.translatable()) {
    const QString words = QString::fromStdString(id);
    return words.contains(QLatin1String(" = ")) ? with_parameter_names(words) : by_titles(words);
  }
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

Message option_name(const OptionDeclaration& option) {
  QString name = QString::fromStdString(option.key).section(QLatin1Char('.'), 1);
  const QString suffix = QLatin1Char('_') + QString::fromStdString(option.unit);
  if (name.endsWith(suffix)) name.chop(suffix.size());
  return Message::listed(name.replace(QLatin1Char('_'), QLatin1Char(' ')).toStdString());
}

QString warning_text(const Message& warning) {
  const bool of_the_whole = warning.id() == "result: %1" && warning.arguments().size() == 1;
  return core_text(of_the_whole ? warning.arguments().front() : warning);
}

QString core_text(const Error& error) {
  return core_text(error.sentence());
}

}  // namespace lvcalib::widgets
