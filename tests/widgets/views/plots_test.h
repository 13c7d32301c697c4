// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QImage>
#include <QSet>

#include "views/plot_view.h"

namespace lvcalib::widgets::test {

/// Number of different colours in what a plot shows: an empty figure has few.
inline int colours_shown(QWidget& widget) {
  const QImage image = widget.grab().toImage();
  QSet<QRgb> seen;
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) seen.insert(image.pixel(x, y));
  }
  return static_cast<int>(seen.size());
}

/// True if some pixel has nearly this colour.
inline bool shows(QWidget& widget, const QColor& color) {
  const QImage image = widget.grab().toImage();
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      const QRgb p = image.pixel(x, y);
      if (std::abs(qRed(p) - color.red()) + std::abs(qGreen(p) - color.green()) +
              std::abs(qBlue(p) - color.blue()) <
          24) {
        return true;
      }
    }
  }
  return false;
}

inline QPalette palette_of(bool dark) {
  QPalette palette;
  palette.setColor(QPalette::Base, dark ? QColor(30, 30, 30) : QColor(255, 255, 255));
  palette.setColor(QPalette::Text, dark ? QColor(235, 235, 235) : QColor(20, 20, 20));
  return palette;
}

/// Rows of a CSV text, without the header.
inline QList<QByteArray> rows_of(const QByteArray& csv) {
  QList<QByteArray> rows = csv.trimmed().split('\n');
  if (!rows.isEmpty()) rows.removeFirst();
  return rows;
}

}  // namespace lvcalib::widgets::test
