// SPDX-License-Identifier: GPL-3.0-or-later
#include "pages/pose_text.h"

#include <cmath>

#include "base/roll_pitch_yaw.h"
#include "base/units.h"
#include "pages/page_tr.h"
#include "report/stored_model.h"
#include "style/html.h"
#include "style/theme.h"
#include "words/core_text.h"
#include "words/total_note.h"

namespace lvcalib::widgets {
namespace {

QString number(double value, int decimals) {
  return QString::number(value, 'f', decimals).replace('-', QChar(0x2212));
}

QString quality_line(const CalibrationResult& result, const Standing& standing,
                     const QPalette& palette) {
  const ToldQuality told = told_quality(result, standing);
  const QColor color = color_of(told, palette);
  QString line = QString("<p><b>%1 <span style='color:%2'>%3</span></b>")
                     .arg(tr("Quality:"), color.name(), told.words.toHtmlEscaped());
  if (!result.quality_reason.empty()) {
    line += " – " + core_text(result.quality_reason).toHtmlEscaped();
  }
  line += "<br>" + tr("%1 scenes, %2 px (corners), %3 mm (LiDAR)")
                       .arg(result.extrinsic.used_scenes)
                       .arg(result.extrinsic.rms_px, 0, 'f', 3)
                       .arg(result.extrinsic.rms_mm, 0, 'f', 2);
  return line + "</p>";
}

// Above every two columns of standard deviations.
QString statistical_and_total() {
  return html_row({"", "", tr("statistical"), tr("in total")});
}

QString translation_table(const UncertainRigid3& pose, const UncertainRigid3& total) {
  QString out = "<table>" + statistical_and_total();
  const char* axes[] = {"x", "y", "z"};
  for (int k = 0; k < 3; ++k) {
    out += html_row({axes[k], number(kMmPerM * pose.transform.translation(k), 2) + " mm",
                     "± " + number(kMmPerM * std::sqrt(pose.covariance(k, k)), 2) + " mm",
                     "± " + number(kMmPerM * std::sqrt(total.covariance(k, k)), 2) + " mm"});
  }
  return out + "</table>";
}

QString rotation_table(const UncertainRigid3& pose, const UncertainRigid3& total) {
  const RollPitchYaw turn = roll_pitch_yaw(pose);
  const RollPitchYaw in_total = roll_pitch_yaw(total);
  const QString names[] = {tr("roll"), tr("pitch"), tr("yaw")};
  const auto sigma = [](double sigma_rad) {
    return "± " +
           (std::isfinite(sigma_rad) ? number(kDegPerRad * sigma_rad, 4) + "°" : tr("unbounded"));
  };
  QString out = "<table>" + statistical_and_total();
  for (int k = 0; k < 3; ++k) {
    out += html_row({names[k], number(kDegPerRad * turn.angles_rad(k), 4) + "°",
                     sigma(turn.sigmas_rad(k)), sigma(in_total.sigmas_rad(k))});
  }
  return out + "</table>";
}

// Of the perturbation in the camera frame: what the covariances of the result file say.
QString camera_sigma_table(const UncertainRigid3& pose, const UncertainRigid3& total) {
  QString out = "<table>" + html_row({"", tr("statistical"), "", tr("in total"), ""});
  const char* axes[] = {"x", "y", "z"};
  const auto sigma = [](const UncertainRigid3& of, int k) {
    return number(1e3 * std::sqrt(of.covariance(k, k)), 3);
  };
  for (int k = 0; k < 3; ++k) {
    out += html_row({axes[k], sigma(pose, k) + " mm", sigma(pose, k + 3) + " mrad",
                     sigma(total, k) + " mm", sigma(total, k + 3) + " mrad"});
  }
  return out + "</table>";
}

QString matrix_table(const Rigid3& pose) {
  QString out = "<table style='font-family:monospace'>";
  const Eigen::Matrix4d m = pose.matrix();
  for (int r = 0; r < 4; ++r) {
    QStringList cells{""};
    for (int c = 0; c < 4; ++c) cells.push_back(number(m(r, c), 6));
    out += html_row(cells);
  }
  return out + "</table>";
}

QString quaternion_line(const Rigid3& pose) {
  const Eigen::Quaterniond& q = pose.rotation;
  return "<p style='font-family:monospace'>" + number(q.x(), 6) + "&nbsp; " + number(q.y(), 6) +
         "&nbsp; " + number(q.z(), 6) + "&nbsp; " + number(q.w(), 6) + "</p>";
}

QString list(const std::vector<Message>& lines) {
  QString out = "<ul style='margin-left:-22px'>";
  for (const Message& line : lines) {
    out += "<li>" + warning_text(line).toHtmlEscaped() + "</li>";
  }
  return out + "</ul>";
}

}  // namespace

QString pose_html(const CalibrationResult& result, const Standing& standing,
                  const QPalette& palette) {
  const UncertainRigid3& pose = result.extrinsic.camera_from_lidar;
  const UncertainRigid3 total{pose.transform, result.covariance_total};
  const PoseUse use = pose_use(result);
  QString html = quality_line(result, standing, palette);
  html += QStringLiteral("<p><b>%1</b> %2<br>%3</p>")
              .arg(tr("Model:").toHtmlEscaped(), core_text(use.model).toHtmlEscaped(),
                   core_text(use.clouds).toHtmlEscaped());
  html += html_heading(tr("Translation (LiDAR origin in the camera frame)")) +
          translation_table(pose, total);
  html += html_heading(tr("Roll, pitch, yaw (R = Rz·Ry·Rx)")) + rotation_table(pose, total);
  html += "<p>" +
          (tr("Statistical: what the noise of these scenes leaves open.") + QLatin1Char(' ') +
           total_note(result))
              .toHtmlEscaped() +
          "</p>";
  html += html_heading(tr("T_camera_lidar")) + matrix_table(pose.transform);
  html += html_heading(tr("Quaternion x y z w")) + quaternion_line(pose.transform);
  html += html_heading(tr("Standard deviations along the camera's axes")) +
          camera_sigma_table(pose, total);
  html += html_heading(tr("Weak directions"));
  html += result.extrinsic.weak_directions.empty()
              ? "<p>" + tr("None: the scenes determine all six.") + "</p>"
              : list(result.extrinsic.weak_directions);
  if (!result.warnings.empty()) html += html_heading(tr("Warnings")) + list(result.warnings);
  return html;
}

}  // namespace lvcalib::widgets
