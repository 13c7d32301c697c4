// SPDX-License-Identifier: GPL-3.0-or-later
#include "dialogs/error_dialog.h"

#include <QAction>
#include <QClipboard>
#include <QDialogButtonBox>
#include <QGridLayout>
#include <QGuiApplication>
#include <QLabel>
#include <QPushButton>
#include <QStyle>

#include "style/texts.h"
#include "words/core_text.h"

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
    : QDialog(parent),
      text_(QString::fromStdString(error.text())),
      buttons_(new QDialogButtonBox(QDialogButtonBox::Close, this)) {
  setAttribute(Qt::WA_DeleteOnClose);
  setObjectName(QStringLiteral("error_dialog"));
  const bool untrusted = error.kind == ErrorKind::kUntrusted;
  auto* layout = new QGridLayout(this);
  auto* icon = new QLabel(this);
  icon->setPixmap(
      style()
          ->standardIcon(untrusted ? QStyle::SP_MessageBoxWarning : QStyle::SP_MessageBoxCritical)
          .pixmap(40, 40));
  layout->addWidget(icon, 0, 0, 3, 1, Qt::AlignTop);
  QLabel* message = selectable({}, this);
  QLabel* where = selectable({}, this);
  QLabel* hint = selectable({}, this);
  layout->addWidget(message, 0, 1);
  layout->addWidget(where, 1, 1);
  layout->addWidget(hint, 2, 1);
  where->setHidden(error.where.empty());
  hint->setHidden(error.hint.empty());
  QPushButton* copy = buttons_->addButton(QString(), QDialogButtonBox::ActionRole);
  follow_language(this, [this, error, untrusted, message, where, hint, copy] {
    setWindowTitle(untrusted ? tr("No trustworthy result") : tr("This cannot be used"));
    QString text = core_text(error.message);
    if (!text.isEmpty()) text[0] = text[0].toUpper();
    message->setText(text);
    where->setText(tr("Where:") + QLatin1Char(' ') + QString::fromStdString(error.where));
    hint->setText(tr("What to do:") + QLatin1Char(' ') + core_text(error.hint));
    copy->setText(tr("Copy"));
  });
  connect(copy, &QPushButton::clicked, this,
          [this] { QGuiApplication::clipboard()->setText(text_); });
  connect(buttons_, &QDialogButtonBox::rejected, this, &QDialog::reject);
  layout->addWidget(buttons_, 3, 0, 1, 2);
  layout->setColumnStretch(1, 1);
  setMinimumWidth(480);
}

void ErrorDialog::offer(QAction& action) {
  QPushButton* button = buttons_->addButton(QString(), QDialogButtonBox::ActionRole);
  button->setObjectName(action.objectName());
  const auto take_words = [button, &action] {
    button->setText(action.text());
    button->setToolTip(action.toolTip());
  };
  take_words();
  connect(&action, &QAction::changed, button, take_words);
  connect(button, &QPushButton::clicked, &action, [this, &action] {
    close();
    action.trigger();
  });
}

}  // namespace lvcalib::widgets

#include "moc_error_dialog.cpp"
