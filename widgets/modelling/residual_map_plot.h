// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <vector>

#include "modelling/residual_figure.h"
#include "views/plot_view.h"

namespace lvcalib::widgets {

/// Mean residuals over a plane: coloured cells, or arrows for corners. Cells that differ from zero
/// beyond chance are outlined.
class ResidualMapPlot : public PlotView {
  Q_OBJECT

 public:
  enum class Plane { kImage, kBoard, kAngles };

  ResidualMapPlot(Plane plane, QWidget* parent = nullptr);
  /// Without a view the message stands in its place; an empty one says what the plane lacks.
  void setView(std::shared_ptr<const ChannelView> view, const QString& message = {});
  void setSelected(std::vector<std::size_t> rows);
  /// Names of the covariates along the axes.
  [[nodiscard]] const char* xName() const;
  [[nodiscard]] const char* yName() const;

 Q_SIGNALS:
  void brushed(const QRectF& area);

 protected:
  void rebuild() override;

 private:
  [[nodiscard]] const ResidualMap* map() const;
  void drawCells(const ResidualMap& map);
  void drawArrows(const ResidualMap& map);
  void drawSelected();
  void fit(const ResidualMap& map);

  Plane plane_;
  std::shared_ptr<const ChannelView> view_;
  QString message_;
  std::vector<std::size_t> selected_;
  QCPColorScale* scale_ = nullptr;
  QSize fitted_to_;
};

}  // namespace lvcalib::widgets
