// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QString>

#include "base/error.h"
#include "base/message.h"

namespace lvcalib::widgets {

/// A sentence of the core library in the present language: its places are filled with its
/// arguments, translated alike. What the language's table lacks is said in English.
QString core_text(const Message& message);
/// A warning of a result, without the word for the whole of it that heads the line on a terminal:
/// where the window shows it, what it is about stands above.
QString warning_text(const Message& warning);
/// What an error says, with where it happened and what to do.
QString core_text(const Error& error);

}  // namespace lvcalib::widgets
