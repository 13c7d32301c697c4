// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "views/board_figure.h"
#include "views/response_plots.h"

namespace lvcalib::widgets {

/// The board from the front (mm) with the samples about its circles: those inside and outside the
/// overlap region, circles and parts that are left out.
class SampleMapPlot : public BoardFigure {
  Q_OBJECT

 public:
  explicit SampleMapPlot(QWidget* parent = nullptr);
  void setScope(const ResponseScope& scope);
  /// A part of the board that is marked; none: none.
  void setPart(const std::optional<BoardOutline>& part);

 Q_SIGNALS:
  void brushed(const lvcalib::BoardOutline& part);

 protected:
  void rebuild() override;

 private:
  [[nodiscard]] std::vector<QStringList> tableRows() const;
  [[nodiscard]] bool isRefused(int id) const;
  [[nodiscard]] bool isByHand(int id) const;
  void drawPatch(const std::vector<Eigen::Vector2d>& edge_m);

  ResponseScope scope_;
  std::optional<BoardOutline> part_;
};

}  // namespace lvcalib::widgets
