// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "refinement/board_refinement.h"
#include "views/plot_view.h"

namespace lvcalib::widgets {

/// Size of every node's local correction (mm, logarithmic) against the iteration, with the largest
/// move of the whole layout.
class ConvergencePlot : public PlotView {
  Q_OBJECT

 public:
  explicit ConvergencePlot(QWidget* parent = nullptr);

  void setHistory(std::vector<IterationRecord> history);
  /// Marks one iteration; −1: none.
  void setIteration(int iteration);
  void setChosenNode(int id);

 Q_SIGNALS:
  void iterationClicked(int iteration);

 protected:
  void rebuild() override;

 private:
  [[nodiscard]] LegendEntry circlesEntry() const;
  [[nodiscard]] int placeOf(int id) const;
  void drawNodes();
  void drawLayoutMoves();
  void fillTable();

  std::vector<IterationRecord> history_;
  int iteration_ = -1;
  int chosen_ = -1;
};

}  // namespace lvcalib::widgets
