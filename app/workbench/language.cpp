// SPDX-License-Identifier: GPL-3.0-or-later
#include "workbench/language.h"

#include <QCoreApplication>
#include <QLibraryInfo>
#include <QLocale>
#include <QTranslator>

namespace lvcalib::widgets {
namespace {

// Buttons that Qt names; translated here too, as Qt's own catalogues need not be installed.
[[maybe_unused]] constexpr const char* kQtTexts[] = {
    QT_TRANSLATE_NOOP("QPlatformTheme", "OK"),    QT_TRANSLATE_NOOP("QPlatformTheme", "Save"),
    QT_TRANSLATE_NOOP("QPlatformTheme", "Open"),  QT_TRANSLATE_NOOP("QPlatformTheme", "Cancel"),
    QT_TRANSLATE_NOOP("QPlatformTheme", "Close"), QT_TRANSLATE_NOOP("QPlatformTheme", "Discard"),
    QT_TRANSLATE_NOOP("QPlatformTheme", "&Yes"),  QT_TRANSLATE_NOOP("QPlatformTheme", "&No"),
};

}  // namespace

const std::vector<std::pair<QString, QString>>& languages() {
  static const std::vector<std::pair<QString, QString>> all = {
      {QStringLiteral("en"), QStringLiteral("English")},
      {QStringLiteral("zh_CN"), QStringLiteral("简体中文")}};
  return all;
}

QString use_language(const QString& code) {
  // Owned by the application: they live as long as it shows texts.
  static QTranslator* const own = new QTranslator(QCoreApplication::instance());
  static QTranslator* const qt = new QTranslator(QCoreApplication::instance());
  QString wanted = code;
  if (wanted.isEmpty())
    wanted = QLocale::system().language() == QLocale::Chinese ? QStringLiteral("zh_CN")
                                                              : QStringLiteral("en");
  QCoreApplication::removeTranslator(own);
  QCoreApplication::removeTranslator(qt);
  // Qt's own dialogs, if their catalogue is installed. They are English as they are.
  if (wanted != QLatin1String("en") && qt->load(QStringLiteral("qtbase_") + wanted,
                                                QLibraryInfo::path(QLibraryInfo::TranslationsPath)))
    QCoreApplication::installTranslator(qt);
  const auto load = [](const QString& language) {
    return own->load(QStringLiteral(":/translations/lvcalib_%1.qm").arg(language));
  };
  if (!load(wanted)) {
    wanted = QStringLiteral("en");
    load(wanted);  // What is said of one alone.
  }
  QCoreApplication::installTranslator(own);
  return wanted;
}

}  // namespace lvcalib::widgets
