// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "modelling/residual_figure.h"
#include "views/plot_view.h"

namespace lvcalib::widgets {

/// Residuals against a covariate: all of them as a cloud, means of groups with two standard
/// deviations, the band of the noise, the means before, and what an effect would look like.
class ResidualPlot : public PlotView {
  Q_OBJECT

 public:
  explicit ResidualPlot(QWidget* parent = nullptr);

  /// Null: `message` says why there is nothing.
  void setFigure(std::shared_ptr<const ResidualFigure> figure, const QString& message = {});
  [[nodiscard]] const std::shared_ptr<const ResidualFigure>& figure() const { return figure_; }
  void setBeforeShown(bool shown);
  /// Factor on the effect laid over.
  void setOverlayScale(double scale);
  /// Shows the means at full height instead of the whole scatter.
  void setMeansOnly(bool on);
  /// Emphasises residuals, by index.
  void setSelected(std::vector<std::size_t> rows);

 Q_SIGNALS:
  /// A rectangle was drawn (axis units); again while it is drawn.
  void brushed(const QRectF& area);

 protected:
  void rebuild() override;

 private:
  void drawNoise();
  void drawMeans(const std::vector<ResidualBin>& bins, const QColor& color, bool bars,
                 double scale);
  void drawSelected();
  void explain();
  void setLabels();
  [[nodiscard]] double halfHeight() const;
  void emitBrush(const QRect& rect);

  std::shared_ptr<const ResidualFigure> figure_;
  std::vector<std::size_t> selected_;
  QString message_;
  double scale_ = 1.0;
  bool before_ = true;
  bool means_only_ = false;
};

/// A quantity with its unit: "range (m)".
QString axis_text(const std::string& name, const std::string& unit);

}  // namespace lvcalib::widgets
