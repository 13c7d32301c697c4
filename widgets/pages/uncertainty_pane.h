// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QWidget>

#include "pipeline/calibration.h"

class QTextBrowser;

namespace lvcalib::widgets {

class UncertaintyMapPlot;
class UncertaintyRangePlot;

/// How far the extrinsic can be trusted: weak directions, halves of the scenes against each other,
/// the result without each scene in words; its standard deviation over the image and over range.
class UncertaintyPane : public QWidget {
  Q_OBJECT

 public:
  explicit UncertaintyPane(QWidget* parent = nullptr);
  void setResult(const CalibrationResult* result);
  /// Writes the text anew, as when the palette has changed.
  void setText(const CalibrationResult* result);

 Q_SIGNALS:
  void failed(const QString& message);

 private:
  QTextBrowser* text_ = nullptr;
  UncertaintyMapPlot* map_ = nullptr;
  UncertaintyRangePlot* range_ = nullptr;
};

}  // namespace lvcalib::widgets
