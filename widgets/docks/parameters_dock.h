// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QDockWidget>
#include <vector>

#include "pipeline/options.h"

class QLabel;
class QToolButton;
class QPushButton;
class QFormLayout;

namespace lvcalib::widgets {

/// How an option is shown: lengths in millimetres or metres and angles in milliradians, whichever
/// gives its default readable digits.
struct OptionDisplay {
  QString unit;
  double factor = 1.0;  ///< Shown value = factor · stored value.
  int decimals = 0;     ///< Enough for three digits of the default, and six of the lower bound.
};
OptionDisplay display_of(const OptionDeclaration& option);

/// A form of all options, made from their one declaration: units, ranges, defaults, tool tips.
/// Changes are asked for by a signal; the form shows what set_options() says.
class ParametersDock : public QDockWidget {
  Q_OBJECT

 public:
  explicit ParametersDock(QWidget* parent = nullptr);
  void set_options(const CalibrationOptions& options);

 Q_SIGNALS:
  void option_wanted(const lvcalib::OptionDeclaration& option, double value);
  void reset_all_wanted();

 private:
  struct Field {
    const OptionDeclaration* option = nullptr;
    OptionDisplay display;
    QWidget* editor = nullptr;  // QDoubleSpinBox, or QCheckBox for switches.
    QLabel* label = nullptr;
    QToolButton* reset = nullptr;
  };
  void add_field(QFormLayout& form, const OptionDeclaration& option);
  void show_value(Field& field, double value);
  void retranslate();

  std::vector<Field> fields_;
  std::vector<std::pair<std::string, QLabel*>> headings_;
  QPushButton* reset_all_;
};

}  // namespace lvcalib::widgets
