// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QWidget>
#include <memory>
#include <optional>

#include "pipeline/calibration.h"
#include "pipeline/refusals.h"
#include "views/response_plots.h"

class QLabel;
class QTabWidget;
class QTableWidget;
class QTextBrowser;
class QToolButton;

namespace lvcalib::widgets {

class SampleMapPlot;

/// The boundary response: the transition, the samples on the board, pitch against yaw, ranges, and
/// the table per scene and of all; a row of the table chooses what the figures show. What there is
/// not says why. Figures are made when the page is seen.
class ResponsePage : public QWidget {
  Q_OBJECT

 public:
  explicit ResponsePage(QWidget* parent = nullptr);

  /// Keeps the chosen row where the new result has its scene.
  void setResult(std::shared_ptr<const CalibrationResult> result);

 Q_SIGNALS:
  /// A scene was chosen in the table; index into the result's scenes.
  void sceneActivated(int scene);
  void failed(const QString& message);
  /// A scene that the program refused is to be used all the same.
  void insistWanted(const QString& scene);
  /// A tag, or else a circle, that the program refused is to be used all the same.
  void keepWanted(const QString& scene, bool tag, int id);
  /// Part of the board, by its number among those refused in the scene.
  void keepPatchWanted(const QString& scene, int id);
  /// What the program refused of a scene is to be left out again.
  void keptDropped(const QString& scene);
  /// What these edits leave out of a scene by hand is to be used again.
  void takenBack(const QString& scene, const lvcalib::SceneEdits& what);
  /// Returns on a part of the board are to be left out of a scene, or of every one (empty).
  void partExcluded(const QString& scene, const std::vector<Eigen::Vector2d>& patch_m);

 protected:
  void showEvent(QShowEvent* event) override;

 private:
  QWidget* createPlots();
  QWidget* createTables();
  void retranslate();
  void refresh();
  void fillTables();
  void fillReasons();
  [[nodiscard]] static QString byHand(const SceneResult& scene);
  void takeBack(const QString& kind, const QString& scene, int id);
  [[nodiscard]] static QString describe(const Refusal& refusal);
  void showScope(const ResponseScope& scope);
  void choosePart(const std::optional<BoardOutline>& part);
  void excludePart();
  void activate(int row);
  [[nodiscard]] ResponseScope scopeOf(int row) const;

  std::shared_ptr<const CalibrationResult> result_;
  bool stale_ = false;  // The figures show an older result.
  std::string chosen_;  // Name of the scene; empty: all.
  QLabel* message_ = nullptr;
  TransitionPlot* transition_ = nullptr;
  SampleMapPlot* map_ = nullptr;
  AnglePlot* angles_ = nullptr;
  RangePlot* ranges_ = nullptr;
  QTableWidget* scenes_ = nullptr;
  QTableWidget* classes_ = nullptr;
  QTabWidget* tabs_ = nullptr;
  std::optional<BoardOutline> part_;  // Brushed on the map.
  QToolButton* brush_ = nullptr;
  QToolButton* exclude_ = nullptr;
  QTextBrowser* reasons_ = nullptr;
};

}  // namespace lvcalib::widgets
