// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QPolygonF>
#include <QWidget>
#include <optional>
#include <vector>

#include "base/rigid3.h"
#include "camera/camera.h"
#include "target/target.h"

namespace lvcalib::widgets {

/// Where a board is to be held, as the camera will see it: an empty picture of the camera's size
/// and the board in it, black on white as it is printed, with its upper edge marked. To be
/// understood from afar. Passive.
class BoardSketch : public QWidget {
  Q_OBJECT

 public:
  explicit BoardSketch(QWidget* parent = nullptr);

  /// No pose: the empty picture.
  void setPose(const Target& target, const Camera& camera,
               const std::optional<Rigid3>& camera_from_board);
  /// Nothing at all.
  void clear();
  /// Word at the board's upper edge.
  void setTopWord(const QString& word);

  /// Pixels of the camera.
  [[nodiscard]] const QPolygonF& outline() const { return outline_; }
  [[nodiscard]] std::size_t shapes() const { return black_.size(); }

  [[nodiscard]] QSize sizeHint() const override { return {420, 280}; }
  [[nodiscard]] QSize minimumSizeHint() const override { return {180, 120}; }

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  QSizeF picture_;  // Of the camera, px; empty: nothing to draw.
  QPolygonF outline_;
  QPolygonF top_;                 // Upper edge of the board.
  std::vector<QPolygonF> black_;  // Tags and circles.
  QString top_word_;
};

}  // namespace lvcalib::widgets
