// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QWidget>
#include <memory>

#include "pipeline/calibration.h"

class QLabel;
class QTableWidget;

namespace lvcalib::widgets {

class BoxPlot;

/// What a method of the comparison is called: "Joint, refined" for joint_refined. Names that are
/// not known are given as they are.
QString method_title(const std::string& name);

/// The methods side by side, on the same scenes and measured alike: a table, and box plots of what
/// each leaves at the corners (px) and at the nodes (mm).
class MethodsPane : public QWidget {
  Q_OBJECT

 public:
  explicit MethodsPane(QWidget* parent = nullptr);
  void setResult(const CalibrationResult* result);

 Q_SIGNALS:
  void failed(const QString& message);

 private:
  void retranslate();
  static QString resultText(const CalibrationResult& result);
  void fillTable(const CalibrationResult& result);
  void fillBoxes(const CalibrationResult& result);

  QLabel* message_ = nullptr;
  QTableWidget* table_ = nullptr;
  BoxPlot* boxes_px_ = nullptr;
  BoxPlot* boxes_mm_ = nullptr;
};

}  // namespace lvcalib::widgets
