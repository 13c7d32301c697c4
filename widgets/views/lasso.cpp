// SPDX-License-Identifier: GPL-3.0-or-later
#include "views/lasso.h"

#include <QApplication>
#include <QEvent>
#include <QMouseEvent>
#include <QPainter>
#include <cmath>

namespace lvcalib::widgets {

Lasso::Lasso(QWidget* view) : QWidget(view) {
  setAttribute(Qt::WA_NoSystemBackground);
  setCursor(Qt::CrossCursor);
  setFocusPolicy(Qt::NoFocus);
  resize(view->size());
  view->installEventFilter(this);
  hide();
}

void Lasso::setOn(bool on) {
  line_.clear();
  setVisible(on);
  raise();
}

bool Lasso::eventFilter(QObject* watched, QEvent* event) {
  if (watched == parent() && event->type() == QEvent::Resize) resize(parentWidget()->size());
  return QWidget::eventFilter(watched, event);
}

void Lasso::mousePressEvent(QMouseEvent* event) {
  if (event->button() != Qt::LeftButton) return event->ignore();
  line_ = QPolygonF{event->position()};
  parentWidget()->setFocus(Qt::MouseFocusReason);
}

void Lasso::mouseMoveEvent(QMouseEvent* event) {
  if (line_.isEmpty() || !event->buttons().testFlag(Qt::LeftButton)) return event->ignore();
  line_ << event->position();
  update();
}

void Lasso::mouseReleaseEvent(QMouseEvent* event) {
  if (event->button() != Qt::LeftButton || line_.isEmpty()) return event->ignore();
  line_ << event->position();
  const QPolygonF line = line_;
  line_.clear();
  update();
  const QSizeF size = line.boundingRect().size();
  // A click that slipped is no line about anything.
  if (size.width() + size.height() < QApplication::startDragDistance()) return;
  Q_EMIT drawn(line, event->modifiers().testFlag(Qt::ShiftModifier));
}

void Lasso::paintEvent(QPaintEvent* /*event*/) {
  if (line_.size() < 2) return;
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setBrush(QColor(0, 190, 255, 50));
  painter.setPen(QPen(Qt::black, 3.0));
  painter.drawPolygon(line_);
  painter.setBrush(Qt::NoBrush);
  painter.setPen(QPen(QColor(0, 190, 255), 1.5));
  painter.drawPolygon(line_);
}

LassoMask::LassoMask(const QPolygonF& line)
    : bounds_(line.boundingRect().toAlignedRect()),
      inside_(bounds_.size().expandedTo({1, 1}), QImage::Format_Grayscale8) {
  inside_.fill(0);
  QPainter painter(&inside_);
  painter.translate(-bounds_.topLeft());
  painter.setPen(Qt::NoPen);
  painter.setBrush(Qt::white);
  painter.drawPolygon(line);
}

bool LassoMask::contains(double x, double y) const {
  if (!std::isfinite(x) || !std::isfinite(y)) return false;
  const double column = std::floor(x) - bounds_.left();
  const double row = std::floor(y) - bounds_.top();
  if (column < 0.0 || row < 0.0 || column >= inside_.width() || row >= inside_.height())
    return false;
  return inside_.constScanLine(static_cast<int>(row))[static_cast<int>(column)] != 0;
}

}  // namespace lvcalib::widgets

#include "moc_lasso.cpp"
