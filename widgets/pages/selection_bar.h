// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QWidget>
#include <vector>

#include <Eigen/Core>

#include "pipeline/calibration.h"
#include "pipeline/refusals.h"

class QAction;
class QLabel;
class QToolButton;

namespace lvcalib::widgets {

/// Measurements of one scene that are selected: points about the board, tags and circles.
struct SceneSelection {
  std::vector<Eigen::Vector3f> points_m;
  std::vector<int> tags;
  std::vector<int> circles;
  [[nodiscard]] bool empty() const { return points_m.empty() && tags.empty() && circles.empty(); }
};

/// Says what is selected on the Scene page, and offers what can be decided about it: leave it out,
/// take it back, use it although the program refuses it.
class SelectionBar : public QWidget {
  Q_OBJECT

 public:
  explicit SelectionBar(QWidget* parent = nullptr);

  void setText(const QString& text);
  /// What is decided about the scene: the result may still be on its way.
  void setEdits(const SceneEdits& edits);
  /// Null scene: nothing can be decided. Both must outlive the next call.
  void setSelection(SceneSelection selection, const CalibrationResult* result,
                    const SceneResult* scene);
  [[nodiscard]] const SceneSelection& selection() const { return selection_; }

 Q_SIGNALS:
  /// The scene's edits are to be these.
  void editsWanted(const lvcalib::SceneEdits& edits);
  /// A patch of the board (board frame) is to be left out of every scene.
  void patchEverywhereWanted(const std::vector<Eigen::Vector2d>& patch_m);

 private:
  void retranslate();
  void exclude();
  void takeBack();
  void keep(bool kept);
  [[nodiscard]] std::vector<Eigen::Vector2d> patch() const;
  [[nodiscard]] std::vector<int> keepable(Refusal::What what) const;
  [[nodiscard]] bool holdsSelected(const BoardOutline& part) const;
  [[nodiscard]] std::vector<BoardOutline> keepableParts() const;

  SceneSelection selection_;
  SceneEdits edits_;
  const CalibrationResult* result_ = nullptr;
  const SceneResult* scene_ = nullptr;
  QLabel* text_;
  QToolButton* exclude_;
  QToolButton* take_back_;
  QToolButton* keep_;
  QAction* patch_;
  QAction* patch_everywhere_;
};

}  // namespace lvcalib::widgets
