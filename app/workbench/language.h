// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QString>
#include <utility>
#include <vector>

namespace lvcalib::widgets {

/// Codes and own names of the languages, English first.
const std::vector<std::pair<QString, QString>>& languages();

/// Switches the application to a language ("en", "zh_CN"; empty: the system's, if there is a
/// catalogue for it). Open widgets are told by a LanguageChange event. Returns the code in use.
QString use_language(const QString& code);

}  // namespace lvcalib::widgets
