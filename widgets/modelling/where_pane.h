// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QWidget>
#include <memory>
#include <optional>
#include <vector>

#include "modelling/figure_source.h"

class QComboBox;
class QLabel;
class QTabWidget;
class QToolButton;

namespace lvcalib::widgets {

class BoardIntensityView;
class ResidualMapPlot;
class ResidualPlot;

/// A selected measurement, for the views of its scene.
struct SelectedSample {
  int scene = 0;                                    ///< Index into the table's scenes.
  std::optional<Eigen::Vector3d> point_in_lidar_m;  ///< Of LiDAR returns.
  std::optional<Eigen::Vector2d> pixel;             ///< Of corners.
};

/// Where the model fails: residuals of a channel against a covariate and over image, board and
/// directions, with the board's intensity beside its prediction. Brushing in one selects in all.
class WherePane : public QWidget {
  Q_OBJECT

 public:
  explicit WherePane(FigureSource& source, QWidget* parent = nullptr);
  ~WherePane() override;

  /// What the source shows now; null: nothing, for the reason given.
  void setStep(const ModelStepPtr& step, const QString& reason);
  /// Shows a channel along a covariate.
  void look(Channel channel, const QString& covariate);
  /// Lays an effect over the residuals; none: nothing. `scale` multiplies its pattern.
  void setOverlay(const std::optional<EffectInUse>& effect, double scale = 1.0);
  void setOverlayScale(double scale);
  [[nodiscard]] Channel channel() const;
  [[nodiscard]] QString covariate() const;

 Q_SIGNALS:
  /// Measurements were selected in a figure; empty: none.
  void selected(const std::vector<lvcalib::widgets::SelectedSample>& samples);
  /// What was selected last is to be left out.
  void excludeWanted();
  void failed(const QString& message);
  /// Channel or covariate were chosen by hand.
  void turned();

 private:
  void createBar();
  void createFigures();
  void retranslate();
  void fillChannels();
  void fillCovariates();
  void fillScenes();
  void ask();
  void showAwaited();
  void askBoard();
  void showFigure(const std::shared_ptr<const ResidualFigure>& figure, const QString& message);
  void brush(const QString& x, const QString& y, const QRectF& area);
  void select(std::vector<std::size_t> rows);

  FigureSource& source_;
  ModelStepPtr step_;
  std::optional<EffectInUse> effect_;
  double scale_ = 1.0;
  std::shared_ptr<const ResidualFigure> figure_;
  bool outdated_ = false;  // `figure_` is that of another step.
  QComboBox* channels_;
  QComboBox* covariates_;
  QLabel* channel_label_;
  QLabel* covariate_label_;
  QToolButton* brush_;
  QToolButton* exclude_;
  QToolButton* before_;
  QTabWidget* tabs_;
  ResidualPlot* plot_;
  ResidualMapPlot* maps_[3];
  QWidget* board_page_;
  QComboBox* scenes_;
  QToolButton* flicker_;
  BoardIntensityView* board_;
};

}  // namespace lvcalib::widgets
