// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QColor>
#include <QImage>
#include <QString>
#include <memory>
#include <stop_token>
#include <vector>

#include "diagnostics/residual_columns.h"
#include "selection/model_session.h"

namespace lvcalib::widgets {

/// Residuals of one channel and their means over image, board and directions.
struct ChannelView {
  ResidualColumns columns;
  ResidualMap image;   ///< Corners only: arrows over the image, px.
  ResidualMap board;   ///< Board coordinates, m.
  ResidualMap angles;  ///< Azimuth and elevation, rad; empty for corners.
};
ChannelView make_channel_view(const ModelStep& step, const ModelStep& before, Channel channel);

/// A curve that is laid over the residuals: what an effect would look like.
struct Overlay {
  QString name;
  std::vector<float> pattern;  ///< One value per residual.
};

/// Everything that a plot of residuals against a covariate shows, made ready off the interface
/// thread.
struct ResidualFigure {
  std::shared_ptr<const ChannelView> view;
  std::shared_ptr<const Overlay> overlay;  ///< May be null.
  std::size_t covariate = 0;               ///< Index into the columns' covariates.
  std::vector<double> labels;              ///< Of categories: their values in order; else empty.
  QImage density;                          ///< Transparent where there is nothing.
  double x_low = 0.0, x_high = 1.0, y_low = -1.0, y_high = 1.0;
  double noise = 0.0;  ///< Stated standard deviation of a single residual.
  std::vector<ResidualBin> now, before, predicted;

  [[nodiscard]] const Covariate& along() const { return view->columns.covariates[covariate]; }
  /// Of single residuals, on light and dark ground.
  static QColor dotColor() { return {70, 125, 190}; }
  /// Where a value of the covariate stands on the plot's axis (categories: 1, 2, …).
  [[nodiscard]] double place(double value) const;
};

/// Null if stopped or if the channel has no such covariate.
std::shared_ptr<const ResidualFigure> make_residual_figure(
    const std::shared_ptr<const ChannelView>& view, const QString& covariate,
    const std::shared_ptr<const Overlay>& overlay, std::stop_token stop);

}  // namespace lvcalib::widgets
