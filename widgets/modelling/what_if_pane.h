// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QWidget>
#include <optional>

#include "selection/model_session.h"

class QComboBox;
class QDoubleSpinBox;
class QLabel;
class QSlider;

namespace lvcalib::widgets {

/// What if an effect of some size were there: chooses effect, parameter and size; the residuals
/// that the model predicts then are drawn beside those that are measured.
class WhatIfPane : public QWidget {
  Q_OBJECT

 public:
  explicit WhatIfPane(QWidget* parent = nullptr);
  void setStep(const ModelStepPtr& step);

 Q_SIGNALS:
  /// Another effect or parameter, at the unit size; none: nothing is asked.
  void effectChosen(const std::optional<lvcalib::EffectInUse>& effect, double scale);
  /// Another size of the same effect: a factor on its pattern.
  void scaleChanged(double scale);

 private:
  void retranslate();
  void fill();
  void fillParameters();
  void choose();
  void resize();
  [[nodiscard]] const EffectParameter* parameter() const;
  [[nodiscard]] double scale() const;

  ModelStepPtr step_;
  EffectPtr effect_;
  std::vector<EffectParameter> parameters_;
  QLabel* title_;
  QComboBox* effects_;
  QComboBox* names_;
  QSlider* slider_;
  QDoubleSpinBox* size_;
  QLabel* note_;
};

}  // namespace lvcalib::widgets
