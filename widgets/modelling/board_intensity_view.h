// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QImage>
#include <QTimer>
#include <QWidget>
#include <memory>

#include "diagnostics/board_intensity.h"
#include "views/figure_actions.h"

namespace lvcalib::widgets {

/// A board as the LiDAR sees it, as the model predicts it, and the difference, side by side; or
/// measured and predicted in turns, so that what differs catches the eye.
class BoardIntensityView : public QWidget {
  Q_OBJECT

 public:
  static constexpr int kFlickerMs = 500;

  explicit BoardIntensityView(QWidget* parent = nullptr);
  /// Null: `message` says why there is nothing.
  void setImages(std::shared_ptr<const BoardIntensity> images, const QString& message = {});
  void setFlicker(bool on);
  [[nodiscard]] bool showsPrediction() const { return odd_; }
  [[nodiscard]] FigureActions* figureActions() const { return actions_; }
  [[nodiscard]] QSize minimumSizeHint() const override { return {200, 120}; }

 protected:
  void paintEvent(QPaintEvent* event) override;
  void contextMenuEvent(QContextMenuEvent* event) override;
  void hideEvent(QHideEvent* event) override;
  void showEvent(QShowEvent* event) override;

 private:
  void paint(QPainter& painter, const QRectF& area);
  void paintLegend(QPainter& painter, const QRectF& place);

  std::shared_ptr<const BoardIntensity> data_;
  QImage pictures_[3];
  QString message_;
  double low_ = 0.0, high_ = 1.0, range_ = 1.0;
  bool flicker_ = false;
  bool odd_ = false;
  QTimer timer_;
  FigureActions* actions_;
};

}  // namespace lvcalib::widgets
