// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QImage>
#include <QPolygonF>
#include <QRect>
#include <QWidget>

namespace lvcalib::widgets {

/// Lies over a view and, while it is on, takes the left button: a drag draws a closed line about
/// what is to be selected. Other buttons, the wheel and keys go to the view beneath.
class Lasso : public QWidget {
  Q_OBJECT

 public:
  /// Covers `view`, which owns it; off at first.
  explicit Lasso(QWidget* view);
  void setOn(bool on);
  [[nodiscard]] bool isOn() const { return isVisibleTo(parentWidget()); }

 Q_SIGNALS:
  /// A line was closed, in the view's coordinates. `add`: to what is selected already (Shift).
  void drawn(const QPolygonF& line, bool add);

 protected:
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void paintEvent(QPaintEvent* event) override;
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  QPolygonF line_;
};

/// Which places lie inside a closed line: quick to ask about very many.
class LassoMask {
 public:
  explicit LassoMask(const QPolygonF& line);
  [[nodiscard]] bool contains(double x, double y) const;

 private:
  QRect bounds_;
  QImage inside_;
};

}  // namespace lvcalib::widgets
