// SPDX-License-Identifier: GPL-3.0-or-later
#include "pages/uncertainty_text.h"

#include <QStringList>
#include <algorithm>
#include <cmath>

#include "pages/page_tr.h"
#include "pipeline/forward_stage.h"
#include "style/html.h"
#include "style/theme.h"
#include "words/core_text.h"

namespace lvcalib::widgets {
namespace {

QString words(const std::string& text) {
  return QString::fromStdString(text).toHtmlEscaped();
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
  if (lines.empty()) return html_paragraph(tr("None: the scenes determine all six."));
  QString out = "<ul>";
  for (const Message& line : lines) out += "<li>" + core_text(line).toHtmlEscaped() + "</li>";
  return out + "</ul>";
}

QString split_halves(const UncertaintyReport& report, const StateColors& colors) {
  QString out;
  if (!report.splits.empty()) {
    out += "<table>" + html_row({tr("Halves"), tr("scenes"), tr("difference"), tr("by noise alone"),
                                 tr("χ² (limit)"), QString()},
                                "th");
    for (const SplitHalf& s : report.splits) {
      const QString verdict =
          s.agrees()
              ? QString("<span style='color:%1'>%2</span>").arg(colors.good.name(), tr("agree"))
              : QString("<b style='color:%1'>%2</b>").arg(colors.bad.name(), tr("disagree"));
      out += html_row({core_text(s.name).toHtmlEscaped(), names(s.first) + " | " + names(s.second),
                       pair(s.translation_mm, s.rotation_mrad),
                       pair(s.expected_translation_mm, s.expected_rotation_mrad),
                       QString("%1 (%2)").arg(s.chi_square, 0, 'f', 1).arg(s.gate, 0, 'f', 1),
                       verdict});
    }
    out += "</table>";
  }
  if (!report.splits_reason.empty())
    out += html_paragraph(core_text(report.splits_reason).toHtmlEscaped());
  return out;
}

QString leave_one_out(const CalibrationResult& result) {
  const auto& list = result.extrinsic.leave_one_out;
  if (list.empty()) return html_paragraph(tr("Not enough scenes: three are needed."));
  QString out = "<table>" + html_row({tr("Without"), tr("moves and turns by")}, "th");
  for (const LeaveOneOut& l : list)
    out += html_row({words(l.without), pair(l.translation_mm, l.rotation_mrad)});
  return out + "</table>";
}

QString by_range(const UncertaintyReport& report, const std::optional<UncertaintyReport>& total) {
  const bool both = total && total->by_range.size() == report.by_range.size();
  const auto mm = [](double value) { return tr("%1 mm").arg(value, 0, 'f', 2); };
  QStringList titles = {tr("Range"), tr("across the ray"), tr("along it")};
  if (both) titles << tr("across, total") << tr("along, total");
  QString out = "<table>" + html_row(titles, "th");
  for (std::size_t k = 0; k < report.by_range.size(); ++k) {
    const RangeUncertainty& r = report.by_range[k];
    QStringList cells = {tr("%1 m").arg(r.range_m), mm(r.across_mm), mm(r.along_mm)};
    if (both) cells << mm(total->by_range[k].across_mm) << mm(total->by_range[k].along_mm);
    out += html_row(cells);
  }
  return out + "</table>";
}

QString over_image(const UncertaintyReport& report, const std::optional<UncertaintyReport>& total) {
  QString out;
  for (std::size_t k = 0; k < report.maps.size(); ++k) {
    const auto noise = report.maps[k].reach_px();
    if (!noise) continue;
    QString text =
        tr("A LiDAR point at %1 m falls into the image with a standard deviation of %2 px where "
           "it is best to %3 px where it is worst, by noise alone.")
            .arg(report.maps[k].range_m)
            .arg(noise->first, 0, 'f', 3)
            .arg(noise->second, 0, 'f', 3);
    const auto all = total && k < total->maps.size() ? total->maps[k].reach_px() : std::nullopt;
    if (all)
      text +=
          QLatin1Char(' ') +
          tr("In total: %1 px to %2 px.").arg(all->first, 0, 'f', 3).arg(all->second, 0, 'f', 3);
    out += html_paragraph(text);
  }
  return out;
}

}  // namespace

std::optional<UncertaintyReport> total_report(const CalibrationResult& result) {
  if (!(result.covariance_total.trace() > 0.0) || result.uncertainty.by_range.empty())
    return std::nullopt;
  return project_uncertainty(result.camera, projection_covariance(result, result.covariance_total));
}

QString uncertainty_html(const CalibrationResult& result, const QPalette& palette) {
  const UncertaintyReport& report = result.uncertainty;
  QString html = html_heading(tr("Weak directions")) + weak_directions(result);
  html += html_heading(tr("Halves of the scenes against each other")) +
          split_halves(report, state_colors(palette));
  html += html_heading(tr("Leaving one scene out")) + leave_one_out(result);
  if (!report.by_range.empty()) {
    const std::optional<UncertaintyReport> total = total_report(result);
    html += html_heading(tr("In the camera's view, one standard deviation")) +
            over_image(report, total) + by_range(report, total);
  }
  return html;
}

}  // namespace lvcalib::widgets
