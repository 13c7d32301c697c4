// SPDX-License-Identifier: GPL-3.0-or-later
#include "workbench/language.h"

#include <QCoreApplication>
#include <QLibraryInfo>
#include <QLocale>
#include <QTranslator>

namespace lvcalib::widgets {

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
  if (wanted == QLatin1String("en")) return wanted;
  // Qt's own dialogs, if their catalogue is installed.
  if (qt->load(QStringLiteral("qtbase_") + wanted,
               QLibraryInfo::path(QLibraryInfo::TranslationsPath)))
    QCoreApplication::installTranslator(qt);
  if (!own->load(QStringLiteral(":/translations/lvcalib_%1.qm").arg(wanted)))
    return QStringLiteral("en");
  QCoreApplication::installTranslator(own);
  return wanted;
}

}  // namespace lvcalib::widgets
