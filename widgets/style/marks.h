// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QIcon>
#include <QPalette>

namespace lvcalib::widgets {

/// Small round signs, told apart by shape as well as colour.
enum class Mark {
  kGood,      ///< Tick.
  kDoubtful,  ///< Exclamation mark.
  kBad,       ///< Cross.
  kIdle,      ///< Empty ring.
  kLeftOut,   ///< Bar.
  kMissing,   ///< Question mark.
};

/// Signs of tools.
enum class ToolIcon { kRun, kStop, kUndo, kRedo, kTable };

/// A tool's sign in the text colour of a palette, greyed when disabled.
QIcon tool_icon(ToolIcon tool, const QPalette& palette);

/// A mark in the colours of a palette.
QIcon mark_icon(Mark mark, const QPalette& palette);

}  // namespace lvcalib::widgets
