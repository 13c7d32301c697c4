// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <set>
#include <vector>

#include "refinement/node_samples.h"
#include "views/board_figure.h"

namespace lvcalib::widgets {

/// The board from the front (mm) with the enlarged way of every node's centre through the
/// iterations, relative to the model's place, and the refined centre with its 2σ ellipse.
class BoardMapPlot : public BoardFigure {
  Q_OBJECT

 public:
  explicit BoardMapPlot(QWidget* parent = nullptr);

  void setPaths(std::vector<CenterPath> paths);
  /// Draws the paths up to this iteration; −1: all.
  void setIteration(int iteration);
  void setChosenNode(int id);
  /// Nodes that are not used though they were refined: drawn crossed out.
  void setRefused(std::set<int> ids, std::set<int> by_hand = {});

  /// How much larger than life the paths are drawn: 1, 2 or 5 times a power of ten, so that the
  /// longest is at most 0.4 tag pitches long.
  [[nodiscard]] double enlargement() const { return enlargement_; }

 Q_SIGNALS:
  void nodeClicked(int id);

 protected:
  void rebuild() override;

 private:
  void drawBoard();
  void drawPath(const CenterPath& path, int index);
  void drawEllipse(const CenterPath& path, const QPen& pen);
  void drawCaption();
  void fillTable();
  void emitNodeAt(const QPointF& place);

  std::vector<CenterPath> paths_;
  int iteration_ = -1;
  int chosen_ = -1;
  std::set<int> refused_;
  std::set<int> by_hand_;
  double enlargement_ = 1.0;
};

}  // namespace lvcalib::widgets
