// SPDX-License-Identifier: GPL-3.0-or-later
#include "dialogs/error_dialog.h"

#include <QClipboard>
#include <QDialogButtonBox>
#include <QGridLayout>
#include <QGuiApplication>
#include <QLabel>
#include <QPushButton>
#include <QStyle>

namespace lvcalib::widgets {
namespace {

QLabel* selectable(const QString& text, QWidget* parent) {
  auto* label = new QLabel(text, parent);
  label->setTextFormat(Qt::PlainText);
  label->setWordWrap(true);
  label->setTextInteractionFlags(Qt::TextSelectableByMouse | Qt::TextSelectableByKeyboard);
  return label;
}

}  // namespace

ErrorDialog::ErrorDialog(const Error& error, QWidget* parent)
    : QDialog(parent), text_(QString::fromStdString(error.text())) {
  setAttribute(Qt::WA_DeleteOnClose);
  setObjectName(QStringLiteral("error_dialog"));
  const bool untrusted = error.kind == ErrorKind::kUntrusted;
  setWindowTitle(untrusted ? tr("No trustworthy result") : tr("This cannot be used"));
  auto* layout = new QGridLayout(this);
  auto* icon = new QLabel(this);
  icon->setPixmap(
      style()
          ->standardIcon(untrusted ? QStyle::SP_MessageBoxWarning : QStyle::SP_MessageBoxCritical)
          .pixmap(40, 40));
  layout->addWidget(icon, 0, 0, 3, 1, Qt::AlignTop);
  QString message = QString::fromStdString(error.message);
  if (!message.isEmpty()) message[0] = message[0].toUpper();
  layout->addWidget(selectable(message, this), 0, 1);
  int row = 1;
  const auto add = [&](const QString& title, const std::string& content) {
    if (content.empty()) return;
    layout->addWidget(selectable(title + QLatin1Char(' ') + QString::fromStdString(content), this),
                      row++, 1);
  };
  add(tr("Where:"), error.where);
  add(tr("What to do:"), error.hint);
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Close, this);
  QPushButton* copy = buttons->addButton(tr("Copy"), QDialogButtonBox::ActionRole);
  connect(copy, &QPushButton::clicked, this,
          [this] { QGuiApplication::clipboard()->setText(text_); });
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  layout->addWidget(buttons, row + 1, 0, 1, 2);
  layout->setColumnStretch(1, 1);
  setMinimumWidth(480);
}

}  // namespace lvcalib::widgets
