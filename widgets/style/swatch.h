// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QBrush>
#include <QColor>
#include <QPalette>
#include <QString>

class QPainter;
class QRectF;

namespace lvcalib::widgets {

/// A colour of a legend, with an edge: colours of a figure are chosen for its own ground, and may
/// be as dark as the one on which the legend stands.
void paint_swatch(QPainter& painter, const QRectF& place, const QColor& color,
                  const QPalette& palette);

/// Slanted lines for what is not used, broad enough to be seen on any ground.
QBrush hatched(const QColor& color);

/// The swatch as a picture in rich text, as high as the small letters of a usual font.
QString swatch_html(const QColor& color, const QPalette& palette);

}  // namespace lvcalib::widgets
