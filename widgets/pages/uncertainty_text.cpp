// SPDX-License-Identifier: GPL-3.0-or-later
#include "pages/uncertainty_text.h"

#include <QStringList>
#include <algorithm>
#include <cmath>

#include "pages/page_tr.h"
#include "style/theme.h"
#include "words/core_text.h"

namespace lvcalib::widgets {
namespace {

QString words(const std::string& text) {
  return QString::fromStdString(text).toHtmlEscaped();
}

QString heading(const QString& text) {
  return "<h4>" + text.toHtmlEscaped() + "</h4>";
}

QString paragraph(const QString& html) {
  return "<p>" + html + "</p>";
}

QString row(const QStringList& cells, const char* tag = "td") {
  QString out = "<tr>";
  for (int k = 0; k < cells.size(); ++k) {
    out += QString("<%1 align='%2' style='padding-right:14px'>%3</%1>")
               .arg(QLatin1String(tag), k == 0 ? "left" : "right", cells[k]);
  }
  return out + "</tr>";
}

// Breaks between the two where it has to, not between a number and its unit.
QString pair(double mm, double mrad) {
  const QString text = tr("%1 mm, %2 mrad").arg(mm, 0, 'f', 2).arg(mrad, 0, 'f', 3);
  QStringList parts = text.split(QStringLiteral(", "));
  for (QString& part : parts) part.replace(QLatin1Char(' '), QChar(0xa0));
  return parts.join(QStringLiteral(", "));
}

QString names(const std::vector<std::string>& scenes) {
  QStringList out;
  for (const std::string& name : scenes) out.push_back(words(name));
  return out.join(QStringLiteral(", "));
}

QString weak_directions(const CalibrationResult& result) {
  const auto& lines = result.extrinsic.weak_directions;
  if (lines.empty()) return paragraph(tr("None: the scenes determine all six."));
  QString out = "<ul>";
  for (const Message& line : lines) out += "<li>" + core_text(line).toHtmlEscaped() + "</li>";
  return out + "</ul>";
}

QString split_halves(const UncertaintyReport& report, const StateColors& colors) {
  QString out;
  if (!report.splits.empty()) {
    out += "<table>" + row({tr("Halves"), tr("scenes"), tr("difference"), tr("by noise alone"),
                            tr("χ² (limit)"), QString()},
                           "th");
    for (const SplitHalf& s : report.splits) {
      const QString verdict =
          s.agrees()
              ? QString("<span style='color:%1'>%2</span>").arg(colors.good.name(), tr("agree"))
              : QString("<b style='color:%1'>%2</b>").arg(colors.bad.name(), tr("disagree"));
      out += row({core_text(s.name).toHtmlEscaped(), names(s.first) + " | " + names(s.second),
                  pair(s.translation_mm, s.rotation_mrad),
                  pair(s.expected_translation_mm, s.expected_rotation_mrad),
                  QString("%1 (%2)").arg(s.chi_square, 0, 'f', 1).arg(s.gate, 0, 'f', 1), verdict});
    }
    out += "</table>";
  }
  if (!report.splits_reason.empty())
    out += paragraph(core_text(report.splits_reason).toHtmlEscaped());
  return out;
}

QString leave_one_out(const CalibrationResult& result) {
  const auto& list = result.extrinsic.leave_one_out;
  if (list.empty()) return paragraph(tr("Not enough scenes: three are needed."));
  QString out = "<table>" + row({tr("Without"), tr("moves and turns by")}, "th");
  for (const LeaveOneOut& l : list)
    out += row({words(l.without), pair(l.translation_mm, l.rotation_mrad)});
  return out + "</table>";
}

QString by_range(const UncertaintyReport& report) {
  QString out = "<table>" + row({tr("Range"), tr("across the ray"), tr("along it")}, "th");
  for (const RangeUncertainty& r : report.by_range) {
    out += row({tr("%1 m").arg(r.range_m), tr("%1 mm").arg(r.across_mm, 0, 'f', 2),
                tr("%1 mm").arg(r.along_mm, 0, 'f', 2)});
  }
  return out + "</table>";
}

QString over_image(const UncertaintyReport& report) {
  QString out;
  for (const ProjectedUncertainty& map : report.maps) {
    double low = HUGE_VAL;
    double high = 0.0;
    for (const double sigma : map.sigma_px) {
      if (!std::isfinite(sigma)) continue;
      low = std::min(low, sigma);
      high = std::max(high, sigma);
    }
    if (low > high) continue;
    out += paragraph(
        tr("A LiDAR point at %1 m falls into the image with a standard deviation of %2 px where "
           "it is best to %3 px where it is worst.")
            .arg(map.range_m)
            .arg(low, 0, 'f', 3)
            .arg(high, 0, 'f', 3));
  }
  return out;
}

}  // namespace

QString uncertainty_html(const CalibrationResult& result, const QPalette& palette) {
  const UncertaintyReport& report = result.uncertainty;
  QString html = heading(tr("Weak directions")) + weak_directions(result);
  html += heading(tr("Halves of the scenes against each other")) +
          split_halves(report, state_colors(palette));
  html += heading(tr("Leaving one scene out")) + leave_one_out(result);
  if (!report.by_range.empty()) {
    html += heading(tr("In the camera's view, one standard deviation")) + over_image(report) +
            by_range(report);
  }
  return html;
}

}  // namespace lvcalib::widgets
