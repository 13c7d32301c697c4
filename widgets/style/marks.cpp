// SPDX-License-Identifier: GPL-3.0-or-later
#include "style/marks.h"

#include <QPainter>
#include <QPixmap>

#include "style/theme.h"

namespace lvcalib::widgets {
namespace {

QColor color_of(Mark mark, const StateColors& colors) {
  switch (mark) {
    case Mark::kGood:
      return colors.good;
    case Mark::kDoubtful:
      return colors.doubtful;
    case Mark::kBad:
    case Mark::kMissing:
      return colors.bad;
    case Mark::kIdle:
    case Mark::kLeftOut:
      break;
  }
  return colors.idle;
}

// Strokes in a square of 16.
void draw_sign(QPainter& painter, Mark mark) {
  switch (mark) {
    case Mark::kGood:
      painter.drawPolyline(QPolygonF({{4.5, 8.3}, {7.0, 10.8}, {11.5, 5.5}}));
      break;
    case Mark::kDoubtful:
      painter.drawLine(QPointF(8, 4.2), QPointF(8, 8.8));
      painter.drawPoint(QPointF(8, 11.6));
      break;
    case Mark::kBad:
      painter.drawLine(QPointF(5.3, 5.3), QPointF(10.7, 10.7));
      painter.drawLine(QPointF(10.7, 5.3), QPointF(5.3, 10.7));
      break;
    case Mark::kLeftOut:
      painter.drawLine(QPointF(4.8, 8), QPointF(11.2, 8));
      break;
    case Mark::kMissing:
      painter.drawArc(QRectF(5.6, 3.8, 4.8, 4.6), -90 * 16, 250 * 16);
      painter.drawPoint(QPointF(8, 11.6));
      break;
    case Mark::kIdle:
      break;
  }
}

// In a square of 16, with the painter's pen and brush of one colour.
void draw_tool(QPainter& painter, ToolIcon tool) {
  switch (tool) {
    case ToolIcon::kRun:
      painter.drawPolygon(QPolygonF({{4, 2.5}, {13.5, 8}, {4, 13.5}}));
      break;
    case ToolIcon::kStop:
      painter.drawRect(QRectF(3.5, 3.5, 9, 9));
      break;
    case ToolIcon::kRedo:
      painter.translate(16, 0);
      painter.scale(-1, 1);
      [[fallthrough]];
    case ToolIcon::kUndo:
      painter.drawPolygon(QPolygonF({{1.5, 6}, {6.5, 2}, {6.5, 10}}));
      painter.setBrush(Qt::NoBrush);
      painter.setPen(QPen(painter.pen().color(), 2.0));
      painter.drawArc(QRectF(2.5, 6, 11, 8), -80 * 16, 170 * 16);
      break;
    case ToolIcon::kTable:
      painter.setBrush(Qt::NoBrush);
      painter.drawRect(QRectF(2, 2.5, 12, 11));
      for (const double y : {6.0, 8.7, 11.2}) painter.drawLine(QPointF(4, y), QPointF(12, y));
      break;
  }
}

// A pixmap of a size with a drawing made for a square of 16.
template <class Draw>
QPixmap drawn(int size, const Draw& draw) {
  QPixmap pixmap(size, size);
  pixmap.fill(Qt::transparent);
  QPainter painter(&pixmap);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.scale(size / 16.0, size / 16.0);
  draw(painter);
  return pixmap;
}

}  // namespace

QIcon tool_icon(ToolIcon tool, const QPalette& palette) {
  QIcon icon;
  for (const auto& [mode, group] : {std::pair{QIcon::Normal, QPalette::Active},
                                    std::pair{QIcon::Disabled, QPalette::Disabled}}) {
    const QColor color = palette.color(group, QPalette::ButtonText);
    for (const int size : {16, 24, 32, 48}) {
      icon.addPixmap(drawn(size,
                           [&](QPainter& painter) {
                             painter.setPen(QPen(color, 1.4));
                             painter.setBrush(color);
                             draw_tool(painter, tool);
                           }),
                     mode);
    }
  }
  return icon;
}

QIcon mark_icon(Mark mark, const QPalette& palette) {
  const QColor color = color_of(mark, state_colors(palette));
  QIcon icon;
  for (const int size : {16, 32, 48}) {
    icon.addPixmap(drawn(size, [&](QPainter& painter) {
      painter.setPen(QPen(color, 1.6));
      if (mark != Mark::kIdle) painter.setBrush(color);
      painter.drawEllipse(QRectF(1.5, 1.5, 13, 13));
      painter.setPen(QPen(palette.color(QPalette::Base), 1.8, Qt::SolidLine, Qt::RoundCap));
      painter.setBrush(Qt::NoBrush);
      draw_sign(painter, mark);
    }));
  }
  return icon;
}

}  // namespace lvcalib::widgets
