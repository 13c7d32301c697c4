// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QString>
#include <functional>
#include <string>

#include "base/error.h"

class QDockWidget;
class QWidget;

namespace lvcalib::widgets {

/// Sets texts now and again whenever the application's language changes, as long as `widget` lives.
/// What `set_texts` uses must live as long. It runs before the widget's own changeEvent().
void follow_language(QWidget* widget, std::function<void()> set_texts);

/// Tool tips of the buttons in a dock's title, which Qt gives once only.
void follow_language_in_title(QDockWidget& dock);

/// A sentence of the core library in the present language. The core speaks English only; sentences
/// with numbers or names in them are known by their pattern, and what is filled in is translated
/// alike. What no pattern fits stays as it is.
QString core_text(const std::string& text);
QString core_text(const QString& text);
/// What an error says, with where it happened and what to do.
QString core_text(const Error& error);

}  // namespace lvcalib::widgets
