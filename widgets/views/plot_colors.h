// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QColor>
#include <QPalette>

namespace lvcalib::widgets {

/// Colours of figures that go with a light or a dark palette.
struct PlotColors {
  QColor background;
  QColor text;
  QColor axis;
  QColor grid;
  QColor zero;      ///< The line that stands for "no error".
  QColor fit;       ///< Fitted curves.
  QColor mark;      ///< Measured marks and their error bars.
  QColor refused;   ///< What was left out, and why to look at it.
  QColor left_out;  ///< What the user left out by hand.
  QColor fill;      ///< Areas: boxes and bars.
  QColor emphasis;  ///< The chosen one.
  bool dark = false;

  /// Well-told-apart colours for series 0, 1, 2, …; the second ten are those of the first in
  /// another lightness, then they repeat.
  [[nodiscard]] QColor series(int index) const;

  static PlotColors of(const QPalette& palette);
};

}  // namespace lvcalib::widgets
