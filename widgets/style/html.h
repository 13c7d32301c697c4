// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QString>
#include <QStringList>

namespace lvcalib::widgets {

inline QString html_heading(const QString& text) {
  return "<h4>" + text.toHtmlEscaped() + "</h4>";
}

inline QString html_paragraph(const QString& html) {
  return "<p>" + html + "</p>";
}

/// A row of a table: the first cell, which names it, to the left, the others to the right. Cells
/// are HTML.
inline QString html_row(const QStringList& cells, const char* tag = "td") {
  QString out = "<tr>";
  for (int k = 0; k < cells.size(); ++k) {
    out += QString("<%1 align='%2' style='padding-right:12px'>%3</%1>")
               .arg(QLatin1String(tag), k == 0 ? "left" : "right", cells[k]);
  }
  return out + "</tr>";
}

}  // namespace lvcalib::widgets
