// SPDX-License-Identifier: GPL-3.0-or-later
#include "modelling/what_if_pane.h"

#include <QComboBox>
#include <QDoubleSpinBox>
#include <QEvent>
#include <QHBoxLayout>
#include <QLabel>
#include <QSignalBlocker>
#include <QSlider>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>

#include "modelling/model_text.h"
#include "style/fitting.h"
#include "style/texts.h"

namespace lvcalib::widgets {
namespace {

constexpr int kSteps = 200;   // of the slider on each side of zero
constexpr double kMost = 10;  // Its ends, in sizes of interest.

}  // namespace

WhatIfPane::WhatIfPane(QWidget* parent)
    : QWidget(parent),
      title_(new QLabel(this)),
      effects_(new QComboBox(this)),
      names_(new QComboBox(this)),
      slider_(new QSlider(Qt::Horizontal, this)),
      size_(new QDoubleSpinBox(this)),
      note_(new QLabel(this)) {
  effects_->setObjectName(QStringLiteral("what_if_effect"));
  names_->setObjectName(QStringLiteral("what_if_parameter"));
  slider_->setObjectName(QStringLiteral("what_if_slider"));
  size_->setObjectName(QStringLiteral("what_if_size"));
  effects_->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  effects_->setMinimumContentsLength(14);
  show_entries_in_full(*effects_);
  slider_->setRange(-kSteps, kSteps);
  note_->setWordWrap(true);
  auto* row = new QHBoxLayout;
  row->addWidget(effects_, 1);
  row->addWidget(names_);
  auto* sizes = new QHBoxLayout;
  sizes->addWidget(slider_, 1);
  sizes->addWidget(size_);
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(3);
  layout->addWidget(title_);
  layout->addLayout(row);
  layout->addLayout(sizes);
  layout->addWidget(note_);
  connect(effects_, &QComboBox::currentIndexChanged, this, &WhatIfPane::fillParameters);
  connect(names_, &QComboBox::currentIndexChanged, this, &WhatIfPane::choose);
  connect(slider_, &QSlider::valueChanged, this, &WhatIfPane::resize);
  connect(size_, &QDoubleSpinBox::valueChanged, this, [this](double value) {
    const EffectParameter* p = parameter();
    if (p == nullptr) return;
    const double share = value * p->unit_in_si / (kMost * p->size_of_interest);
    const QSignalBlocker quiet(slider_);
    slider_->setValue(static_cast<int>(std::lround(kSteps * share)));
    Q_EMIT scaleChanged(scale());
  });
  follow_language(this, [this] { retranslate(); });
}

const EffectParameter* WhatIfPane::parameter() const {
  const int k = names_->currentIndex();
  return effect_ && k >= 0 && k < static_cast<int>(parameters_.size())
             ? &parameters_[static_cast<std::size_t>(k)]
             : nullptr;
}

// The pattern is made at the size of interest.
double WhatIfPane::scale() const {
  const EffectParameter* p = parameter();
  return p == nullptr ? 0.0 : size_->value() * p->unit_in_si / p->size_of_interest;
}

void WhatIfPane::setStep(const ModelStepPtr& step) {
  step_ = step;
  fill();
}

void WhatIfPane::fill() {
  const QVariant before = effects_->currentData();
  {
    const QSignalBlocker quiet(effects_);
    effects_->clear();
    effects_->addItem(tr("no effect"), QString());
    if (step_) {
      for (const EffectPtr& effect : effect_catalogue()) {
        if (!why_not_testable(*effect, step_->table()).empty()) continue;
        effects_->addItem(effect_title(effect->info().id),
                          QString::fromStdString(effect->info().id));
      }
    }
    effects_->setCurrentIndex(std::max(0, effects_->findData(before)));
  }
  setEnabled(step_ != nullptr);
  fillParameters();
}

void WhatIfPane::fillParameters() {
  effect_ = step_ ? find_effect(effects_->currentData().toString().toStdString()) : nullptr;
  parameters_.clear();
  {
    const QSignalBlocker quiet(names_);
    names_->clear();
    if (effect_) {
      parameters_ = effect_->parameters(step_->table());
      for (const EffectParameter& p : parameters_) names_->addItem(parameter_name(p.name));
    }
    names_->setVisible(names_->count() > 1);
  }
  choose();
}

void WhatIfPane::choose() {
  const EffectParameter* p = parameter();
  slider_->setEnabled(p != nullptr);
  size_->setEnabled(p != nullptr);
  // Without an effect there is no size: a number there would have no unit.
  size_->setSpecialValueText(p == nullptr ? QStringLiteral("–") : QString());
  if (p == nullptr) {
    const QSignalBlocker quiet(size_);
    size_->setRange(0.0, 0.0);
    size_->setSuffix({});
    const QSignalBlocker still(slider_);
    slider_->setValue(0);
    note_->setText(
        tr("Choose an effect to see, before it is in the model, what it would leave in the "
           "residuals (orange)."));
    Q_EMIT effectChosen(std::nullopt, 0.0);
    return;
  }
  {
    const QSignalBlocker quiet(size_);
    const double most = kMost * p->size_of_interest / p->unit_in_si;
    size_->setRange(-most, most);
    size_->setDecimals(std::clamp(3 - static_cast<int>(std::floor(std::log10(most))), 0, 6));
    size_->setSingleStep(most / kSteps);
    size_->setSuffix(unit_behind(p->unit));
    size_->setValue(p->size_of_interest / p->unit_in_si);
    const QSignalBlocker still(slider_);
    slider_->setValue(static_cast<int>(kSteps / kMost));
  }
  note_->setText(
      tr("Orange: what the poses would leave of it. New scenes are planned to show %1%2.")
          .arg(p->size_of_interest / p->unit_in_si)
          .arg(unit_behind(p->unit)));
  EffectInUse use{effect_, effect_->shapes(step_->table()).front(),
                  Eigen::VectorXd::Zero(static_cast<Eigen::Index>(parameters_.size()))};
  use.values(names_->currentIndex()) = p->size_of_interest;
  Q_EMIT effectChosen(use, scale());
}

void WhatIfPane::resize() {
  const EffectParameter* p = parameter();
  if (p == nullptr) return;
  const QSignalBlocker quiet(size_);
  size_->setValue(kMost * p->size_of_interest / p->unit_in_si * slider_->value() / kSteps);
  Q_EMIT scaleChanged(scale());
}

void WhatIfPane::retranslate() {
  title_->setText(tr("<b>What if</b>"));
  slider_->setToolTip(tr("Size of the effect"));
  slider_->setAccessibleName(tr("Size of the effect"));
  fill();
}

}  // namespace lvcalib::widgets

#include "moc_what_if_pane.cpp"
