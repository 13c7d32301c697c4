// SPDX-License-Identifier: GPL-3.0-or-later
#include "docks/log_dock.h"

#include <QEvent>
#include <QPlainTextEdit>
#include <QTime>

#include "style/texts.h"

namespace lvcalib::widgets {

LogDock::LogDock(QWidget* parent) : QDockWidget(parent), edit_(new QPlainTextEdit(this)) {
  setObjectName(QStringLiteral("log_dock"));
  follow_language_in_title(*this);
  edit_->setObjectName(QStringLiteral("log"));
  edit_->setReadOnly(true);
  edit_->setMaximumBlockCount(kMaxLines);
  edit_->setTabChangesFocus(true);
  setWidget(edit_);
  follow_language(this, [this] { retranslate(); });
}

void LogDock::append(const QString& line) {
  edit_->appendPlainText(QTime::currentTime().toString(QStringLiteral("HH:mm:ss  ")) + line);
}

QString LogDock::text() const {
  return edit_->toPlainText();
}

void LogDock::retranslate() {
  setWindowTitle(tr("Log"));
}

}  // namespace lvcalib::widgets

#include "moc_log_dock.cpp"
