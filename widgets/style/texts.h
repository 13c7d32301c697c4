// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>

class QDockWidget;
class QWidget;

namespace lvcalib::widgets {

/// Sets texts now and again whenever the application's language changes, as long as `widget` lives.
/// What `set_texts` uses must live as long. It runs before the widget's own changeEvent(); of a
/// widget that is not in sight a moment later, or before its showEvent().
void follow_language(QWidget* widget, std::function<void()> set_texts);

/// Tool tips of the buttons in a dock's title, which Qt gives once only.
void follow_language_in_title(QDockWidget& dock);

}  // namespace lvcalib::widgets
