// SPDX-License-Identifier: GPL-3.0-or-later
#include "docks/parameters_dock.h"

#include <QCheckBox>
#include <QDoubleSpinBox>
#include <QEvent>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QScrollArea>
#include <QSignalBlocker>
#include <QToolButton>
#include <QVBoxLayout>
#include <QWheelEvent>
#include <algorithm>
#include <cmath>

#include "style/texts.h"
#include "words/core_text.h"

namespace lvcalib::widgets {
namespace {

bool is_switch(const OptionDeclaration& option) {
  return option.unit == "0/1";
}

// The wheel scrolls the form; it must not change values that happen to lie under it.
class QuietSpinBox : public QDoubleSpinBox {
 public:
  using QDoubleSpinBox::QDoubleSpinBox;

 protected:
  void wheelEvent(QWheelEvent* event) override {
    if (hasFocus()) {
      QDoubleSpinBox::wheelEvent(event);
    } else {
      event->ignore();
    }
  }
};

QDoubleSpinBox* make_spin_box(const OptionDeclaration& option, const OptionDisplay& display,
                              QWidget* parent) {
  auto* box = new QuietSpinBox(parent);
  box->setFocusPolicy(Qt::StrongFocus);
  box->setKeyboardTracking(false);
  box->setDecimals(display.decimals);
  box->setRange(option.low * display.factor, option.high * display.factor);
  if (!display.unit.isEmpty()) box->setSuffix(QLatin1Char(' ') + display.unit);
  if (option.whole) {
    box->setSingleStep(1.0);
  } else {
    box->setStepType(QAbstractSpinBox::AdaptiveDecimalStepType);
  }
  box->setMinimumWidth(96);
  return box;
}

}  // namespace

OptionDisplay display_of(const OptionDeclaration& option) {
  OptionDisplay display;
  display.unit = QString::fromStdString(option.unit);
  const double magnitude = std::abs(option.default_value());
  if (option.unit == "1" || is_switch(option)) display.unit.clear();
  if (option.unit == "m" && magnitude < 0.1 && option.high <= 10.0) {
    display.unit = QStringLiteral("mm");
    display.factor = 1e3;
  } else if (option.unit == "rad") {
    display.unit = QStringLiteral("mrad");
    display.factor = 1e3;
  }
  if (option.whole) return display;
  const auto digits = [&](double value, int count) {
    if (value <= 0.0) return 0;
    return count - 1 - static_cast<int>(std::floor(std::log10(value * display.factor)));
  };
  display.decimals = std::clamp(std::max(digits(magnitude, 3), digits(option.low, 1)), 1, 9);
  // No default may change by being shown.
  const double shown = option.default_value() * display.factor;
  const auto changes = [&] {
    const double scale = std::pow(10.0, display.decimals);
    return std::abs(std::round(shown * scale) / scale - shown) > 1e-9 * std::abs(shown);
  };
  while (display.decimals < 9 && changes()) ++display.decimals;
  return display;
}

ParametersDock::ParametersDock(QWidget* parent) : QDockWidget(parent) {
  setObjectName(QStringLiteral("parameters_dock"));
  follow_language_in_title(*this);
  auto* body = new QWidget(this);
  auto* layout = new QVBoxLayout(body);
  layout->setContentsMargins(0, 0, 0, 0);
  auto* area = new QScrollArea(body);
  area->setWidgetResizable(true);
  area->setFrameShape(QFrame::NoFrame);
  area->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  auto* content = new QWidget(area);
  auto* form = new QFormLayout(content);
  form->setLabelAlignment(Qt::AlignRight);
  form->setFieldGrowthPolicy(QFormLayout::ExpandingFieldsGrow);
  std::string section;
  fields_.reserve(option_declarations().size());
  for (const OptionDeclaration& option : option_declarations()) {
    const std::string own = option.key.substr(0, option.key.find('.'));
    if (own != section) {
      section = own;
      auto* heading = new QLabel(content);
      QFont font = heading->font();
      font.setBold(true);
      heading->setFont(font);
      form->addRow(heading);
      headings_.emplace_back(section, heading);
    }
    add_field(*form, option);
  }
  area->setWidget(content);
  area->setMinimumWidth(content->minimumSizeHint().width() + 20);
  layout->addWidget(area);
  reset_all_ = new QPushButton(body);
  reset_all_->setObjectName(QStringLiteral("reset_all"));
  connect(reset_all_, &QPushButton::clicked, this, &ParametersDock::reset_all_wanted);
  layout->addWidget(reset_all_);
  setWidget(body);
  follow_language(this, [this] { retranslate(); });
  set_options({});
}

void ParametersDock::add_field(QFormLayout& form, const OptionDeclaration& option) {
  Field field;
  field.option = &option;
  field.display = display_of(option);
  auto* row = new QWidget;
  auto* layout = new QHBoxLayout(row);
  layout->setContentsMargins(0, 0, 0, 0);
  const double factor = field.display.factor;
  if (is_switch(option)) {
    auto* box = new QCheckBox(row);
    connect(box, &QCheckBox::toggled, this,
            [this, &option](bool on) { Q_EMIT option_wanted(option, on ? 1.0 : 0.0); });
    field.editor = box;
  } else {
    auto* box = make_spin_box(option, field.display, row);
    connect(box, &QDoubleSpinBox::valueChanged, this, [this, &option, factor](double shown) {
      // Rounding of the shown value must not leave the range.
      Q_EMIT option_wanted(option, std::clamp(shown / factor, option.low, option.high));
    });
    field.editor = box;
  }
  field.editor->setObjectName(QString::fromStdString(option.key));
  field.reset = new QToolButton(row);
  field.reset->setText(QStringLiteral("↺"));
  field.reset->setAutoRaise(true);
  field.reset->setObjectName(QStringLiteral("reset ") + QString::fromStdString(option.key));
  connect(field.reset, &QToolButton::clicked, this,
          [this, &option] { Q_EMIT option_wanted(option, option.default_value()); });
  layout->addWidget(field.editor, 1);
  layout->addWidget(field.reset);
  field.label = new QLabel;
  field.label->setBuddy(field.editor);
  form.addRow(field.label, row);
  fields_.push_back(field);
}

void ParametersDock::set_options(const CalibrationOptions& options) {
  bool any = false;
  for (Field& field : fields_) {
    const double value = field.option->get(options);
    show_value(field, value);
    const bool changed = value != field.option->default_value();
    field.reset->setEnabled(changed);
    QFont font = field.label->font();
    font.setBold(changed);
    field.label->setFont(font);
    any = any || changed;
  }
  reset_all_->setEnabled(any);
}

void ParametersDock::show_value(Field& field, double value) {
  const QSignalBlocker blocker(field.editor);
  if (auto* box = qobject_cast<QCheckBox*>(field.editor)) {
    box->setChecked(value != 0.0);
  } else if (auto* spin = qobject_cast<QDoubleSpinBox*>(field.editor)) {
    spin->setValue(value * field.display.factor);
  }
}

void ParametersDock::retranslate() {
  setWindowTitle(tr("Parameters"));
  reset_all_->setText(tr("Reset all parameters"));
  const std::pair<const char*, QString> names[] = {
      {"detection", tr("Detection")},        {"clouds", tr("Clouds")},
      {"localization", tr("Localisation")},  {"consensus", tr("Consensus")},
      {"refinement", tr("Refinement")},      {"intrinsics", tr("Intrinsics")},
      {"extrinsic", tr("Extrinsic")},        {"forward", tr("Every return")},
      {"response", tr("Boundary response")}, {"quality", tr("Quality")},
      {"discovery", tr("Missing effects")}};
  for (auto& [section, heading] : headings_) {
    heading->setText(QString::fromStdString(section));
    for (const auto& [key, text] : names) {
      if (section == key) heading->setText(text);
    }
  }
  for (Field& field : fields_) {
    const OptionDeclaration& option = *field.option;
    const auto shown = [&](double value) {
      return QString::number(value * field.display.factor, 'g', 6) +
             (field.display.unit.isEmpty() ? QString() : QLatin1Char(' ') + field.display.unit);
    };
    const QString description = core_text(Message::listed(option.description));
    const QString range =
        is_switch(option)
            ? tr("Default: %1.").arg(option.default_value() != 0.0 ? tr("on") : tr("off"))
            : tr("Range %1 to %2, default %3.")
                  .arg(shown(option.low), shown(option.high), shown(option.default_value()));
    const QString tip = QStringLiteral("<p>%1</p><p>%2</p><p><code>%3</code></p>")
                            .arg(description.toHtmlEscaped(), range.toHtmlEscaped(),
                                 QString::fromStdString(option.key));
    field.label->setText(core_text(option_name(option)));
    field.label->setToolTip(tip);
    field.editor->setToolTip(tip);
    field.editor->setAccessibleName(core_text(option_name(option)));
    field.reset->setToolTip(tr("Back to the default %1").arg(shown(option.default_value())));
  }
}

}  // namespace lvcalib::widgets

#include "moc_parameters_dock.cpp"
