// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QImage>
#include <QStringList>
#include <QWidget>
#include <memory>

#include "pipeline/calibration.h"
#include "words/quality_text.h"

class QTabWidget;
class QLabel;
class QPushButton;
class QTextBrowser;

namespace lvcalib::widgets {

class BarPlot;
class BoxPlot;
class CategoryPlot;
class ColorsPane;
class MethodsPane;
class ThresholdPane;
class WorldPane;
class UncertaintyPane;

/// The extrinsic: the pose with its standard deviations, weak directions, quality and warnings;
/// residuals per scene as bars and boxes; how the pose moves without each scene; the methods side
/// by side; how far the pose can be trusted; the cloud in the camera's colours.
class ExtrinsicPage : public QWidget {
  Q_OBJECT

 public:
  explicit ExtrinsicPage(QWidget* parent = nullptr);
  ~ExtrinsicPage() override;

  void setResult(std::shared_ptr<const CalibrationResult> result);
  /// What the verdict on that result rests on.
  void setStanding(const Standing& standing);
  /// Cloud and image of the scene to show in camera colours.
  void setSceneData(int scene, std::shared_ptr<const Cloud> full_cloud, QImage image);

  [[nodiscard]] ColorsPane* colors() const { return colors_; }
  [[nodiscard]] WorldPane* world() const { return world_; }
  [[nodiscard]] ThresholdPane* thresholds() const { return thresholds_; }
  /// What the result would be without the scenes above the line.
  void setScenesPreview(const CalibrationResult& present, const CalibrationResult& preview);
  void setScenesError(const Error& error);

 Q_SIGNALS:
  /// A scene was clicked in a plot; index into the result's scenes.
  void sceneActivated(int scene);
  /// What would the extrinsic be without these scenes?
  void scenesPreviewWanted(const QStringList& without);
  void scenesPreviewDropped();
  /// These scenes are to be left out.
  void rejectWanted(const QStringList& scenes);
  void failed(const QString& message);

 protected:
  void changeEvent(QEvent* event) override;
  void showEvent(QShowEvent* event) override;

 private:
  QWidget* createPlots();
  void retranslate();
  void watch(CategoryPlot* plot);
  void activate(int index);
  void fillPlots();
  void fillInfluence();
  void fillTexts();
  void takeThresholds();
  [[nodiscard]] QStringList scenesBeyond() const;

  std::shared_ptr<const CalibrationResult> result_;
  Standing standing_;
  bool stale_ = false;  // What is shown is in the words before.
  QTextBrowser* pose_ = nullptr;
  UncertaintyPane* uncertainty_ = nullptr;
  MethodsPane* methods_ = nullptr;
  ThresholdPane* thresholds_ = nullptr;
  QTabWidget* tabs_ = nullptr;
  BarPlot* bars_px_ = nullptr;
  BarPlot* bars_mm_ = nullptr;
  BoxPlot* boxes_px_ = nullptr;
  BoxPlot* boxes_mm_ = nullptr;
  BarPlot* influence_mm_ = nullptr;
  BarPlot* influence_mrad_ = nullptr;
  QLabel* without_ = nullptr;  // What the lines over the bars would do.
  QPushButton* reject_ = nullptr;
  QPushButton* back_ = nullptr;
  WorldPane* world_ = nullptr;
  ColorsPane* colors_ = nullptr;
};

}  // namespace lvcalib::widgets
