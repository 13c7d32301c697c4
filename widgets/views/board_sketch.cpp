// SPDX-License-Identifier: GPL-3.0-or-later
#include "views/board_sketch.h"

#include <QPainter>
#include <QPainterPath>
#include <algorithm>
#include <cmath>

#include "style/theme.h"
#include "target/wireframe.h"

namespace lvcalib::widgets {
namespace {

constexpr int kSegments = 24;  // a side; straight lines become curves in a distorted picture

// Empty if a part of it is behind the camera.
QPolygonF projected(const std::vector<Eigen::Vector3d>& points_m, const Camera& camera) {
  QPolygonF out;
  for (const Eigen::Vector3d& p : points_m) {
    const auto pixel = camera.project(p);
    if (!pixel) return {};
    out.push_back(QPointF(pixel->x(), pixel->y()));
  }
  return out;
}

}  // namespace

BoardSketch::BoardSketch(QWidget* parent) : QWidget(parent) {
  setObjectName(QStringLiteral("board_sketch"));
}

void BoardSketch::setPose(const Target& target, const Camera& camera,
                          const std::optional<Rigid3>& camera_from_board) {
  clear();
  picture_ = QSizeF(camera.width_px, camera.height_px);
  if (!camera_from_board) return;
  const BoardWireframe wire = board_wireframe(target, *camera_from_board, kSegments);
  outline_ = projected(wire.outline_m, camera);
  // The third of the four sides, from right to left.
  if (!outline_.isEmpty()) top_ = QPolygonF(outline_.mid(2 * kSegments, kSegments + 1));
  for (const auto* shapes : {&wire.tags, &wire.circles}) {
    for (const BoardWireframe::Shape& shape : *shapes)
      black_.push_back(projected(shape.points_m, camera));
  }
}

void BoardSketch::clear() {
  picture_ = {};
  outline_.clear();
  top_.clear();
  black_.clear();
  update();
}

void BoardSketch::setTopWord(const QString& word) {
  top_word_ = word;
  update();
}

void BoardSketch::paintEvent(QPaintEvent* /*event*/) {
  if (picture_.isEmpty()) return;
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  constexpr double kMargin = 2.0;
  const QSizeF room(width() - 2.0 * kMargin, height() - 2.0 * kMargin);
  const QSizeF size = picture_.scaled(room, Qt::KeepAspectRatio);
  const QRectF frame(QPointF(0.5 * (width() - size.width()), 0.5 * (height() - size.height())),
                     size);
  const double scale = size.width() / picture_.width();
  QTransform to_screen;
  to_screen.translate(frame.left(), frame.top());
  to_screen.scale(scale, scale);
  to_screen.translate(0.5, 0.5);  // The centre of the first pixel is (0, 0).
  // A room at dusk: white print stands out of it in both themes.
  painter.setPen(QPen(palette().color(QPalette::Mid), 2.0));
  painter.setBrush(QColor(88, 96, 108));
  painter.drawRect(frame);
  painter.setPen(QPen(QColor(124, 132, 144), 1.0));
  for (int k = 1; k < 3; ++k) {
    const double x = frame.left() + frame.width() * k / 3.0;
    const double y = frame.top() + frame.height() * k / 3.0;
    painter.drawLine(QPointF(x, frame.top()), QPointF(x, frame.bottom()));
    painter.drawLine(QPointF(frame.left(), y), QPointF(frame.right(), y));
  }
  if (outline_.isEmpty()) return;
  painter.setClipRect(frame);
  painter.setPen(Qt::NoPen);
  painter.setBrush(Qt::white);
  painter.drawPolygon(to_screen.map(outline_));
  painter.setBrush(Qt::black);
  for (const QPolygonF& shape : black_) painter.drawPolygon(to_screen.map(shape));
  painter.setBrush(Qt::NoBrush);
  const double line = std::max(2.0, 0.006 * size.width());
  const QColor mark(255, 140, 0);
  painter.setPen(QPen(QColor(30, 120, 220), 0.5 * line));
  painter.drawPolygon(to_screen.map(outline_));
  const QPolygonF top = to_screen.map(top_);
  painter.setPen(QPen(mark, 1.6 * line, Qt::SolidLine, Qt::RoundCap));
  painter.drawPolyline(top);
  if (top_word_.isEmpty()) return;
  // Beyond the edge, away from the board's middle, so that it covers no print.
  QFont font = painter.font();
  font.setPixelSize(std::max(11, static_cast<int>(0.045 * size.height())));
  font.setBold(true);
  painter.setFont(font);
  const QPointF edge = 0.5 * (top.first() + top.last());
  const QPointF middle = to_screen.map(outline_).boundingRect().center();
  const QPointF away = edge - middle;
  const double length = std::max(1.0, std::hypot(away.x(), away.y()));
  const QSizeF word = painter.fontMetrics().size(0, top_word_);
  const QPointF at = edge + away / length * (0.6 * std::max(word.width(), word.height()) + line);
  QRectF box(at - QPointF(0.5 * word.width(), 0.5 * word.height()), word);
  // Not out of the picture.
  box.moveLeft(std::clamp(box.left(), frame.left() + 2.0, frame.right() - box.width() - 2.0));
  box.moveTop(std::clamp(box.top(), frame.top() + 2.0, frame.bottom() - box.height() - 2.0));
  painter.setPen(mark);
  painter.drawText(box, Qt::AlignCenter, top_word_);
}

}  // namespace lvcalib::widgets

#include "moc_board_sketch.cpp"
