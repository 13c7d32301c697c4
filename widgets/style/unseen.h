// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QWidget>

namespace lvcalib::widgets {

/// True of a widget that nobody sees though its window is on the screen, as on another tab. What it
/// shows can wait for its showEvent(): figures of all pages drawn at once keep the window from
/// answering.
inline bool unseen(const QWidget& widget) {
  return !widget.isVisible() && widget.window()->isVisible();
}

}  // namespace lvcalib::widgets
