// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QString>
#include <set>
#include <string>

#include "base/error.h"
#include "base/message.h"
#include "pipeline/options.h"

namespace lvcalib::widgets {

/// A sentence of the core library in the present language: its places are filled with its
/// arguments, translated alike. What the language's table lacks is said in English. An effect that
/// it names (effect_named()) stands there by its title.
QString core_text(const Message& message);
/// A warning of a result, without the word for the whole of it that heads the line on a terminal:
/// where the window shows it, what it is about stands above.
QString warning_text(const Message& warning);
/// A parameter of an effect, as the window calls it: words are translated, letters of a formula and
/// what the user calls a coefficient of his own are not.
QString parameter_name(const std::string& name);
/// The names of parameters in the catalogue that are words.
const std::set<std::string>& parameter_words();
/// An option's name in words: "refinement.max_step_m" → "max step".
Message option_name(const OptionDeclaration& option);
/// What an error says, with where it happened and what to do.
QString core_text(const Error& error);

}  // namespace lvcalib::widgets
