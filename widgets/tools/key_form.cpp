// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/key_form.h"

#include <QCheckBox>
#include <QComboBox>
#include <QGridLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QRegularExpression>
#include <QScrollArea>
#include <QSignalBlocker>
#include <QVBoxLayout>
#include <algorithm>

#include "base/yaml_file.h"

namespace lvcalib::widgets {
namespace {

// Twelve digits: no length in metres loses any by being shown in millimetres.
constexpr int kDigits = 12;

bool is_number(const QString& text, double& value) {
  return parse_number(text.trimmed().toStdString(), value);
}

}  // namespace

KeyForm::KeyForm(QWidget* parent) : QWidget(parent), layout_(new QGridLayout(this)) {
  layout_->setContentsMargins(0, 0, 0, 0);
  layout_->setVerticalSpacing(4);
  layout_->setColumnStretch(5, 1);
}

void KeyForm::add(const FormKey& key) {
  Row r;
  r.key = key;
  const QString name = QString::fromLatin1(key.name);
  r.label = new QLabel(this);
  if (key.kind == FormKey::Kind::kFlag) {
    auto* box = new QCheckBox(this);
    connect(box, &QCheckBox::toggled, this, &KeyForm::edited);
    r.editor = box;
  } else if (!key.words.isEmpty()) {
    auto* box = new QComboBox(this);
    box->setEditable(true);
    box->addItems(key.words);
    box->setInsertPolicy(QComboBox::NoInsert);
    connect(box, &QComboBox::editTextChanged, this, &KeyForm::edited);
    r.editor = box;
  } else {
    auto* line = new QLineEdit(this);
    line->setMinimumWidth(110);
    connect(line, &QLineEdit::textChanged, this, &KeyForm::edited);
    r.editor = line;
  }
  r.editor->setObjectName(name);
  r.label->setBuddy(r.editor);
  r.unit = new QLabel(QString::fromUtf8(key.unit), this);
  r.complaint = new QLabel(this);
  r.complaint->setObjectName(QStringLiteral("complaint ") + name);
  r.complaint->setWordWrap(true);
  r.complaint->setTextFormat(Qt::PlainText);
  r.complaint->setTextInteractionFlags(Qt::TextSelectableByMouse);
  QFont bold = r.complaint->font();
  bold.setBold(true);
  r.complaint->setFont(bold);
  r.complaint->hide();
  // Two rows of the grid each: what is wrong with a field stands right below it.
  const int at = 2 * static_cast<int>(rows_.size());
  layout_->addWidget(r.label, at, 0);
  layout_->addWidget(r.editor, at, 1);
  if (key.sigma) {
    r.plus_minus = new QLabel(QStringLiteral("±"), this);
    r.sigma = new QLineEdit(this);
    r.sigma->setObjectName(name + QStringLiteral(" sigma"));
    r.sigma->setMaximumWidth(90);
    connect(r.sigma, &QLineEdit::textChanged, this, &KeyForm::edited);
    layout_->addWidget(r.plus_minus, at, 2);
    layout_->addWidget(r.sigma, at, 3);
  }
  layout_->addWidget(r.unit, at, 4);
  layout_->addWidget(r.complaint, at + 1, 1, 1, 5);
  rows_.push_back(r);
}

const KeyForm::Row& KeyForm::row(const QString& key) const {
  return *std::find_if(rows_.begin(), rows_.end(),
                       [&](const Row& r) { return key == QLatin1String(r.key.name); });
}

void KeyForm::setLabel(const QString& key, const QString& label, const QString& tip) {
  const Row& r = row(key);
  r.label->setText(label);
  const QString name = QString(key).section(QLatin1Char(' '), 0, 0);
  const QString text =
      QStringLiteral("<p>%1</p><p><code>%2</code></p>").arg(tip.toHtmlEscaped(), name);
  r.label->setToolTip(text);
  r.editor->setToolTip(text);
  r.editor->setAccessibleName(QString(label).remove(QLatin1Char(':')));
}

void KeyForm::showKeys(const QStringList& keys) {
  for (Row& r : rows_) {
    r.in_view = keys.contains(QLatin1String(r.key.name));
    for (QWidget* part : std::initializer_list<QWidget*>{r.label, r.editor, r.unit, r.plus_minus,
                                                         static_cast<QWidget*>(r.sigma)}) {
      if (part != nullptr) part->setVisible(r.in_view);
    }
    if (!r.in_view) r.complaint->hide();
  }
}

QString KeyForm::shown(const Row& row, const QString& value) {
  double number = 0.0;
  if (row.key.kind != FormKey::Kind::kNumber || !is_number(value, number)) return value;
  return QString::number(number * row.key.factor, 'g', kDigits);
}

QString KeyForm::read(const Row& row, const QString& shown) {
  const QString text = shown.trimmed();
  if (text.isEmpty()) return {};
  double number = 0.0;
  if (row.key.kind == FormKey::Kind::kNumber && is_number(text, number)) {
    // A number that is shown as the file has it stays as it is typed.
    return row.key.factor == 1.0 ? text : QString::number(number / row.key.factor, 'g', kDigits);
  }
  QString word = text;
  word.remove(QRegularExpression(QStringLiteral("[\"\\\\\\x00-\\x1f]")));
  return QLatin1Char('"') + word + QLatin1Char('"');
}

QString KeyForm::typed(const Row& row) {
  if (const auto* box = qobject_cast<const QCheckBox*>(row.editor))
    return box->isChecked() ? QStringLiteral("true") : QStringLiteral("false");
  if (const auto* box = qobject_cast<const QComboBox*>(row.editor)) return box->currentText();
  return static_cast<const QLineEdit*>(row.editor)->text();
}

void KeyForm::setValue(const QString& key, const QString& value) {
  const Row& r = row(key);
  const QSignalBlocker quiet(r.editor);
  if (auto* box = qobject_cast<QCheckBox*>(r.editor)) {
    box->setChecked(value == QLatin1String("true"));
  } else if (auto* words = qobject_cast<QComboBox*>(r.editor)) {
    words->setEditText(value);
  } else {
    static_cast<QLineEdit*>(r.editor)->setText(shown(r, value));
  }
}

void KeyForm::setSigma(const QString& key, const QString& value) {
  const Row& r = row(key);
  const QSignalBlocker quiet(r.sigma);
  r.sigma->setText(shown(r, value));
}

QString KeyForm::value(const QString& key) const {
  const Row& r = row(key);
  return r.key.kind == FormKey::Kind::kFlag ? typed(r) : read(r, typed(r));
}

QString KeyForm::sigma(const QString& key) const {
  const Row& r = row(key);
  return r.sigma == nullptr ? QString() : read(r, r.sigma->text());
}

QStringList KeyForm::notNumbers() const {
  QStringList out;
  for (const Row& r : rows_) {
    if (!r.in_view || r.key.kind != FormKey::Kind::kNumber) continue;
    double number = 0.0;
    const auto wrong = [&](const QString& text) {
      return !text.trimmed().isEmpty() && !is_number(text, number);
    };
    if (wrong(typed(r)) || (r.sigma != nullptr && wrong(r.sigma->text())))
      out << QString::fromLatin1(r.key.name);
  }
  return out;
}

void KeyForm::clearComplaints() {
  for (const Row& r : rows_) {
    r.complaint->clear();
    r.complaint->hide();
  }
}

void KeyForm::complain(const QString& key, const QString& text) {
  row(key).complaint->setText(QStringLiteral("▲ ") + text);
  row(key).complaint->show();
}

QString KeyForm::complaint(const QString& key) const {
  return row(key).complaint->text();
}

QString KeyForm::keyNamedIn(const Error& error) const {
  for (const std::string& text : {error.field, error.message.text(), error.hint.text()}) {
    for (const Row& r : rows_) {
      if (!r.in_view) continue;
      const QString name = QString::fromLatin1(r.key.name).section(QLatin1Char(' '), 0, 0);
      const QRegularExpression whole(QStringLiteral("\\b%1\\b").arg(name));
      if (QString::fromStdString(text).contains(whole)) return QString::fromLatin1(r.key.name);
    }
  }
  return {};
}

void lay_out_form(const FormParts& parts, QWidget& whole) {
  parts.choice_label->setBuddy(parts.choice);
  for (QLabel* text : {parts.problem, parts.note}) {
    text->setWordWrap(true);
    text->setTextFormat(Qt::PlainText);
    text->setTextInteractionFlags(Qt::TextSelectableByMouse);
  }
  auto* head = new QHBoxLayout;
  head->addWidget(parts.choice_label);
  head->addWidget(parts.choice, 1);
  auto* inside = new QWidget(&whole);
  auto* inside_layout = new QVBoxLayout(inside);
  inside_layout->setContentsMargins(0, 0, 8, 0);
  inside_layout->addWidget(parts.form);
  inside_layout->addStretch();
  auto* scroll = new QScrollArea(&whole);
  scroll->setWidgetResizable(true);
  scroll->setFrameShape(QFrame::NoFrame);
  scroll->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  scroll->setWidget(inside);
  for (QWidget* part : {scroll->viewport(), inside}) part->setAutoFillBackground(false);
  auto* left = new QVBoxLayout;
  left->addLayout(head);
  left->addWidget(scroll, 1);
  left->addWidget(parts.problem);
  auto* right = new QVBoxLayout;
  right->addWidget(parts.picture, 1);
  right->addWidget(parts.note);
  auto* layout = new QHBoxLayout(&whole);
  layout->addLayout(left, 5);
  layout->addLayout(right, 4);
}

}  // namespace lvcalib::widgets

#include "moc_key_form.cpp"
