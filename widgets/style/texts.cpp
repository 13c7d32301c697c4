// SPDX-License-Identifier: GPL-3.0-or-later
#include "style/texts.h"

#include <QAbstractButton>
#include <QCoreApplication>
#include <QDockWidget>
#include <QEvent>
#include <QHash>
#include <QRegularExpression>
#include <QWidget>
#include <utility>
#include <vector>

#include "style/core_patterns.h"
#include "style/file_patterns.h"
#include "style/import_patterns.h"
#include "style/model_patterns.h"

namespace lvcalib::widgets {
namespace {

class LanguageFollower : public QObject {
 public:
  LanguageFollower(QWidget* widget, std::function<void()> set_texts)
      : QObject(widget), set_texts_(std::move(set_texts)) {
    widget->installEventFilter(this);
  }
  bool eventFilter(QObject* watched, QEvent* event) override {
    if (event->type() == QEvent::LanguageChange) set_texts_();
    return QObject::eventFilter(watched, event);
  }

 private:
  std::function<void()> set_texts_;
};

struct Pattern {
  const char* source;
  QRegularExpression expression;  // A group for each place, in their order in the text.
  std::vector<int> places;        // Their numbers.
};

Pattern compiled(const char* source) {
  Pattern pattern{source, {}, {}};
  const QString text = QString::fromUtf8(source);
  QString expression;
  for (qsizetype i = 0; i < text.size(); ++i) {
    if (text[i] == QLatin1Char('%') && i + 1 < text.size() && text[i + 1].isDigit()) {
      pattern.places.push_back(text[++i].digitValue());
      expression += QStringLiteral("(.+?)");
    } else {
      expression += QRegularExpression::escape(text.mid(i, 1));
    }
  }
  pattern.expression = QRegularExpression(QRegularExpression::anchoredPattern(expression),
                                          QRegularExpression::DotMatchesEverythingOption);
  return pattern;
}

const std::vector<Pattern>& patterns() {
  static const std::vector<Pattern> all = [] {
    std::vector<Pattern> out;
    for (const char* source : kModelPatterns) out.push_back(compiled(source));
    for (const char* source : kImportPatterns) out.push_back(compiled(source));
    for (const char* source : kFilePatterns) out.push_back(compiled(source));
    for (const char* source : kCorePatterns) out.push_back(compiled(source));
    return out;
  }();
  return all;
}

QString translated(const QString& text, int depth);

// Places are filled in one pass: what is filled in may itself hold a %1.
QString filled(const QString& translation, const Pattern& pattern,
               const QRegularExpressionMatch& match, int depth) {
  QString out;
  for (qsizetype i = 0; i < translation.size(); ++i) {
    const bool place = translation[i] == QLatin1Char('%') && i + 1 < translation.size() &&
                       translation[i + 1].isDigit();
    if (!place) {
      out += translation[i];
      continue;
    }
    // What stands in quotation marks is what somebody typed or has to type.
    const bool verbatim = !out.isEmpty() && out.back() == QChar(0x201c);
    const int number = translation[++i].digitValue();
    for (std::size_t k = 0; k < pattern.places.size(); ++k) {
      if (pattern.places[k] != number) continue;
      const QString captured = match.captured(static_cast<int>(k) + 1);
      out += verbatim ? captured : translated(captured, depth + 1);
    }
  }
  return out;
}

QString translated(const QString& text, int depth) {
  constexpr int kDeepest = 4;
  if (text.isEmpty() || depth > kDeepest) return text;
  const QString whole = QCoreApplication::translate("Core", text.toUtf8().constData());
  if (whole != text) return whole;
  for (const Pattern& pattern : patterns()) {
    const QString translation = QCoreApplication::translate("Core", pattern.source);
    if (translation == QString::fromUtf8(pattern.source)) continue;  // Not in this language.
    const QRegularExpressionMatch match = pattern.expression.match(text);
    if (match.hasMatch()) return filled(translation, pattern, match, depth);
  }
  return text;
}

}  // namespace

void follow_language(QWidget* widget, std::function<void()> set_texts) {
  set_texts();
  new LanguageFollower(widget, std::move(set_texts));
}

void follow_language_in_title(QDockWidget& dock) {
  follow_language(&dock, [&dock] {
    const std::pair<const char*, QString> texts[] = {
        {"qt_dockwidget_floatbutton", QCoreApplication::translate("Docks", "Detach or attach")},
        {"qt_dockwidget_closebutton", QCoreApplication::translate("Docks", "Hide")}};
    for (const auto& [name, text] : texts) {
      auto* button = dock.findChild<QAbstractButton*>(QLatin1String(name));
      if (button == nullptr) continue;
      button->setToolTip(text);
      button->setAccessibleName(text);
    }
  });
}

QString core_text(const QString& text) {
  const QString as_it_is = translated(text, 0);
  if (as_it_is != text || text.isEmpty()) return as_it_is;
  // Sentences about a file are listed with its name before them; here it may stand elsewhere.
  const QString file(QChar(0xe000));
  QString named = translated(file + QStringLiteral(": ") + text, 0);
  if (named == file + QStringLiteral(": ") + text || !named.startsWith(file)) return text;
  named.remove(0, 1);
  static const QRegularExpression colon(QStringLiteral("^[:\\x{ff1a}]\\s*"));
  return named.remove(colon);
}

QString core_text(const std::string& text) {
  return core_text(QString::fromStdString(text));
}

QString core_text(const Error& error) {
  QString text = error.where.empty() ? QString() : QString::fromStdString(error.where) + ": ";
  text += core_text(error.message);
  return error.hint.empty() ? text : text + QStringLiteral(" (%1)").arg(core_text(error.hint));
}

}  // namespace lvcalib::widgets
