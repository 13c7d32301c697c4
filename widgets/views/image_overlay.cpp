// SPDX-License-Identifier: GPL-3.0-or-later
#include "views/image_overlay.h"

#include <QPainter>
#include <QStyleOptionGraphicsItem>
#include <algorithm>
#include <cmath>
#include <map>

#include "style/swatch.h"

namespace lvcalib::widgets {
namespace {

// The picture beneath is a photograph: these must stand out from black and from white alike.
const QColor kTagColor(40, 200, 80);
const QColor kUnusedColor(255, 70, 70);
const QColor kResidualColor(255, 60, 160);
const QColor kCircleColor(255, 170, 0);
const QColor kChosenColor(0, 190, 255);
const QColor kLeftOutColor(190, 110, 255);

// More dots cannot be told apart and make painting slow.
constexpr std::size_t kMostPoints = 60'000;
constexpr std::size_t kPaintedTogether = 2000;

// As wide on the screen whatever the zoom. Qt counts the screen's own pixels, of which a fine
// screen has several to each of ours.
QPen cosmetic(const QPainter& painter, const QColor& color, double width) {
  QPen pen(color, width * painter.device()->devicePixelRatioF());
  pen.setCosmetic(true);
  return pen;
}

// Text on a dark patch, of constant size on the screen.
void draw_label(QPainter& painter, const QPointF& place, double scale, const QString& text,
                const QColor& color) {
  painter.save();
  painter.translate(place);
  painter.scale(1.0 / scale, 1.0 / scale);
  QFont font = painter.font();
  font.setPixelSize(12);
  font.setBold(true);
  painter.setFont(font);
  const QRectF box = QFontMetricsF(font).boundingRect(text).adjusted(-3, -1, 3, 1);
  const QPointF shift(-box.center().x(), -box.center().y());
  painter.setPen(Qt::NoPen);
  painter.setBrush(QColor(0, 0, 0, 165));
  painter.drawRoundedRect(box.translated(shift), 3, 3);
  painter.setPen(color);
  painter.drawText(shift, text);
  painter.restore();
}

void draw_arrow(QPainter& painter, const QPointF& from, const QPointF& to, double scale) {
  painter.drawLine(from, to);
  const QPointF along = to - from;
  const double length = std::hypot(along.x(), along.y());
  if (length * scale < 3.0) return;
  const double head = std::min(0.35 * length, 7.0 / scale);
  const QPointF u = along / length;
  const QPointF n(-u.y(), u.x());
  painter.drawLine(to, to - head * u + 0.5 * head * n);
  painter.drawLine(to, to - head * u - 0.5 * head * n);
}

// Lines as far apart on the screen whatever the zoom.
QBrush hatch_of(const QPainter& painter, const QColor& color) {
  QBrush hatch = hatched(color);
  hatch.setTransform(hatch.transform() * painter.worldTransform().inverted());
  return hatch;
}

// Fills a shape with lines in the colour of why it is not used, and strikes it through.
void strike(QPainter& painter, const QPolygonF& shape, bool left_out) {
  const QColor color = left_out ? kLeftOutColor : kUnusedColor;
  painter.setBrush(hatch_of(painter, color));
  painter.setPen(cosmetic(painter, color, 1.6));
  painter.drawPolygon(shape);
  painter.setBrush(Qt::NoBrush);
  const qsizetype half = shape.size() / 2;
  if (half < 1) return;
  painter.drawLine(shape[0], shape[half]);
  painter.drawLine(shape[half / 2], shape[half + half / 2]);
}

}  // namespace

QColor OverlayItem::shiftColor() {
  return kResidualColor;
}

void OverlayItem::setOverlay(ImageOverlay overlay) {
  overlay_ = std::move(overlay);
  update();
}

void OverlayItem::setParts(const OverlayParts& parts) {
  parts_ = parts;
  update();
}

void OverlayItem::setResidualFactor(double factor) {
  factor_ = factor;
  update();
}

void OverlayItem::setHighlights(std::vector<QPointF> places, int tag) {
  highlights_ = std::move(places);
  highlighted_tag_ = tag;
  update();
}

void OverlayItem::setBounds(const QRectF& bounds) {
  prepareGeometryChange();
  bounds_ = bounds;
}

void OverlayItem::paint(QPainter* painter, const QStyleOptionGraphicsItem* option,
                        QWidget* /*widget*/) {
  const double scale = option->levelOfDetailFromTransform(painter->worldTransform());
  painter->setRenderHint(QPainter::Antialiasing);
  if (parts_.points) paintPoints(*painter, option->exposedRect);
  if (parts_.unused) {
    paintUnusedPoints(*painter, scale);
    paintParts(*painter);
  }
  if (parts_.circles) paintCircles(*painter, scale);
  if (parts_.tags) paintTags(*painter, scale);
  if (parts_.residuals) paintResiduals(*painter, scale);
  paintShifts(*painter, scale);
  paintHighlights(*painter, scale);
}

void OverlayItem::paintPoints(QPainter& painter, const QRectF& visible) const {
  const std::size_t step = std::max<std::size_t>(1, overlay_.points.size() / kMostPoints);
  painter.setRenderHint(QPainter::Antialiasing, false);
  std::map<QRgb, QList<QPointF>> by_color;
  std::size_t collected = 0;
  const auto flush = [&] {
    for (const auto& [color, places] : by_color) {
      painter.setPen(cosmetic(painter, QColor::fromRgb(color), 2.0));
      painter.drawPoints(places.constData(), static_cast<int>(places.size()));
    }
    by_color.clear();
    collected = 0;
  };
  for (std::size_t i = 0; i < overlay_.points.size(); i += step) {
    if (!visible.contains(overlay_.points[i])) continue;
    // Five bits a channel: few pens, and no eye sees the difference.
    by_color[overlay_.point_colors[i] | 0x00070707U].push_back(overlay_.points[i]);
    // In portions, so that where points crowd no colour always comes out on top.
    if (++collected == kPaintedTogether) flush();
  }
  flush();
  painter.setRenderHint(QPainter::Antialiasing);
}

void OverlayItem::paintUnusedPoints(QPainter& painter, double scale) const {
  const double half = 2.0 / scale;
  const auto crosses = [&](const std::vector<QPointF>& places, const QColor& color) {
    QList<QLineF> lines;
    const std::size_t step = 1 + places.size() / kMostPoints;
    for (std::size_t i = 0; i < places.size(); i += step) {
      lines << QLineF(places[i] - QPointF(half, half), places[i] + QPointF(half, half))
            << QLineF(places[i] - QPointF(half, -half), places[i] + QPointF(half, -half));
    }
    painter.setPen(cosmetic(painter, color, 1.0));
    painter.drawLines(lines);
  };
  crosses(overlay_.refused_points, kUnusedColor);
  crosses(overlay_.left_out_points, kLeftOutColor);
}

void OverlayItem::paintParts(QPainter& painter) const {
  for (const ImageOverlay::Part& part : overlay_.parts) {
    const QColor color = part.used ? kTagColor : part.left_out ? kLeftOutColor : kUnusedColor;
    QPen pen = cosmetic(painter, color, 1.8);
    pen.setStyle(Qt::DashLine);
    painter.setPen(pen);
    painter.setBrush(part.left_out ? hatch_of(painter, color) : QBrush(Qt::NoBrush));
    painter.drawPolygon(part.edge);
  }
  painter.setBrush(Qt::NoBrush);
}

void OverlayItem::paintTags(QPainter& painter, double scale) const {
  painter.setBrush(Qt::NoBrush);
  // A label wider than its tag hides it: all of them, or none.
  double width = 0.0;
  for (const ImageOverlay::Tag& tag : overlay_.tags) width += tag.corners.boundingRect().width();
  const bool labels = width * scale > 26.0 * static_cast<double>(overlay_.tags.size());
  for (const ImageOverlay::Tag& tag : overlay_.tags) {
    const QColor color = tag.id == highlighted_tag_ ? kChosenColor
                         : tag.left_out             ? kLeftOutColor
                         : tag.used                 ? kTagColor
                                                    : kUnusedColor;
    if (!tag.used || tag.left_out) strike(painter, tag.corners, tag.left_out);
    painter.setPen(cosmetic(painter, color, tag.id == highlighted_tag_ ? 3.0 : 1.6));
    painter.drawPolygon(tag.corners);
    if (labels)
      draw_label(painter, tag.corners.boundingRect().center(), scale, QString::number(tag.id),
                 color);
  }
}

void OverlayItem::paintResiduals(QPainter& painter, double scale) const {
  for (const ImageOverlay::Corner& corner : overlay_.corners) {
    const QColor color = corner.used ? kResidualColor : kUnusedColor;
    painter.setPen(cosmetic(painter, kTagColor, 1.2));
    const double half = 3.0 / scale;
    const QPointF& d = corner.detected;
    painter.drawLine(d - QPointF(half, 0), d + QPointF(half, 0));
    painter.drawLine(d - QPointF(0, half), d + QPointF(0, half));
    if (!corner.has_prediction) continue;
    painter.setPen(cosmetic(painter, color, 1.2));
    painter.setBrush(Qt::NoBrush);
    painter.drawEllipse(corner.predicted, half, half);
    painter.setPen(cosmetic(painter, color, 1.8));
    draw_arrow(painter, corner.predicted,
               corner.predicted + factor_ * (corner.detected - corner.predicted), scale);
  }
}

void OverlayItem::paintCircles(QPainter& painter, double scale) const {
  painter.setBrush(Qt::NoBrush);
  painter.setPen(cosmetic(painter, kCircleColor, 1.4));
  if (!overlay_.outline.isEmpty()) painter.drawPolygon(overlay_.outline);
  for (const ImageOverlay::Circle& circle : overlay_.circles) {
    if (!circle.valid) strike(painter, circle.edge, circle.left_out);
    QPen pen = cosmetic(painter,
                        circle.valid      ? kCircleColor
                        : circle.left_out ? kLeftOutColor
                                          : kUnusedColor,
                        1.6);
    if (!circle.valid) pen.setStyle(Qt::DashLine);
    painter.setPen(pen);
    painter.setBrush(Qt::NoBrush);
    painter.drawPolygon(circle.edge);
    if (!circle.valid) continue;
    // A dot: crossed out is what is not used.
    const double half = 2.5 / scale;
    painter.setPen(Qt::NoPen);
    painter.setBrush(kCircleColor);
    painter.drawEllipse(circle.center, half, half);
  }
  painter.setBrush(Qt::NoBrush);
}

void OverlayItem::paintShifts(QPainter& painter, double scale) const {
  painter.setBrush(Qt::NoBrush);
  for (const ImageOverlay::Outline& outline : overlay_.outlines) {
    painter.setPen(cosmetic(painter, QColor::fromRgb(outline.color), 1.4));
    painter.drawPolygon(outline.points);
  }
  painter.setPen(cosmetic(painter, kResidualColor, 1.8));
  for (const QLineF& shift : overlay_.shifts)
    draw_arrow(painter, shift.p1(), shift.p1() + factor_ * (shift.p2() - shift.p1()), scale);
}

void OverlayItem::paintHighlights(QPainter& painter, double scale) const {
  painter.setBrush(Qt::NoBrush);
  for (std::size_t k = 0; k < highlights_.size(); ++k) {
    // The first one is what was asked for, the others are its neighbours.
    const double radius = (k == 0 ? 9.0 : 4.0) / scale;
    painter.setPen(cosmetic(painter, Qt::black, k == 0 ? 4.0 : 3.0));
    painter.drawEllipse(highlights_[k], radius, radius);
    painter.setPen(cosmetic(painter, kChosenColor, k == 0 ? 2.0 : 1.4));
    painter.drawEllipse(highlights_[k], radius, radius);
  }
}

}  // namespace lvcalib::widgets
