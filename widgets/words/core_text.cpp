// SPDX-License-Identifier: GPL-3.0-or-later
#include "words/core_text.h"

#include <QCoreApplication>
#include <algorithm>
#include <cctype>
#include <vector>

#include "model/effect.h"
#include "model/measurement_table.h"

namespace lvcalib::widgets {
const std::set<std::string>& parameter_words() {
  static const std::set<std::string> words = [] {
    // Shorter ones are letters of a formula and their likes (fx, mrad).
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
  if (!message.translatable()) return QString::fromStdString(id);
  const std::vector<Message>& arguments = message.arguments();
  if (const EffectPtr effect = arguments.empty() ? find_effect(id) : nullptr)
    return core_text(Message::listed(effect->info().title));
  const QString text = QCoreApplication::translate("Core", id.c_str());
  if (arguments.empty()) return text;
  const auto words = [&](std::size_t place) { return core_text(arguments[place]).toStdString(); };
  return QString::fromStdString(fill_places(text.toStdString(), arguments.size(), words));
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
