// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QCoreApplication>

namespace lvcalib::widgets {

/// Translation for functions that belong to no class.
inline QString tr(const char* text) {
  return QCoreApplication::translate("lvcalib::widgets", text);
}

}  // namespace lvcalib::widgets
