// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QColor>
#include <QPalette>
#include <QString>

class QApplication;

namespace lvcalib::widgets {

struct ToldQuality;

/// Which palette the window uses.
enum class Theme { kSystem, kLight, kDark };

/// "system", "light", "dark" as in settings.
QString name_of(Theme theme);
/// The inverse of name_of(); unknown names give kSystem.
Theme theme_named(const QString& name);

/// Gives the application the Fusion style and the palette of a theme. kSystem keeps what the
/// desktop asks for. Must be called once at the start so that the desktop's palette is known.
void apply_theme(QApplication& application, Theme theme);

/// True if a palette has light text on a dark ground.
bool is_dark(const QPalette& palette);

/// Colours that carry meaning, readable on the palette's ground.
struct StateColors {
  QColor good;      ///< Used, converged, within its noise.
  QColor doubtful;  ///< Works, but look at it.
  QColor bad;       ///< Failed or refused.
  QColor idle;      ///< Not run, left out.
  QColor accent;    ///< Selected, linked.
};
StateColors state_colors(const QPalette& palette);
/// Of a result's quality; that of text as long as it is open.
QColor color_of(const ToldQuality& told, const QPalette& palette);

}  // namespace lvcalib::widgets
