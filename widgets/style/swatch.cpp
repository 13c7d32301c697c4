// SPDX-License-Identifier: GPL-3.0-or-later
#include "style/swatch.h"

#include <QBuffer>
#include <QImage>
#include <QPainter>

namespace lvcalib::widgets {
namespace {

constexpr int kSide = 11;
// A screen of twice the resolution shows it as sharp as the words beside it.
constexpr int kFiner = 2;
constexpr int kEdgeAlpha = 170;

}  // namespace

void paint_swatch(QPainter& painter, const QRectF& place, const QColor& color,
                  const QPalette& palette) {
  painter.save();
  painter.fillRect(place, color);
  QColor edge = palette.color(QPalette::WindowText);
  edge.setAlpha(kEdgeAlpha);
  painter.setPen(QPen(edge, 1.0));
  painter.setBrush(Qt::NoBrush);
  painter.drawRect(place.adjusted(0.5, 0.5, -0.5, -0.5));
  painter.restore();
}

QBrush hatched(const QColor& color) {
  constexpr int kApart = 8;
  constexpr double kWidth = 2.0;
  QImage tile(kFiner * kApart, kFiner * kApart, QImage::Format_ARGB32_Premultiplied);
  tile.fill(Qt::transparent);
  {
    QPainter painter(&tile);
    painter.setRenderHint(QPainter::Antialiasing);
    painter.scale(kFiner, kFiner);
    // The tile's own line and the ends of its neighbours': lines go on from tile to tile.
    painter.setPen(QPen(color, kWidth, Qt::SolidLine, Qt::FlatCap));
    for (const int shift : {-kApart, 0, kApart})
      painter.drawLine(shift - kApart, 2 * kApart, shift + 2 * kApart, -kApart);
  }
  QBrush brush(tile);
  brush.setTransform(QTransform::fromScale(1.0 / kFiner, 1.0 / kFiner));
  return brush;
}

QString swatch_html(const QColor& color, const QPalette& palette) {
  QImage image(kFiner * kSide, kFiner * kSide, QImage::Format_ARGB32_Premultiplied);
  image.fill(Qt::transparent);
  {
    QPainter painter(&image);
    painter.scale(kFiner, kFiner);
    paint_swatch(painter, QRectF(0.0, 0.0, kSide, kSide), color, palette);
  }
  QByteArray bytes;
  QBuffer buffer(&bytes);
  buffer.open(QIODevice::WriteOnly);
  image.save(&buffer, "PNG");
  return QStringLiteral("<img width=\"%1\" height=\"%1\" src=\"data:image/png;base64,%2\">")
      .arg(kSide)
      .arg(QString::fromLatin1(bytes.toBase64()));
}

}  // namespace lvcalib::widgets
