// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/plan_text.h"

#include <QCoreApplication>
#include <algorithm>
#include <cmath>

#include "base/units.h"

namespace lvcalib::widgets {
namespace {

// Below this a direction is the middle: the words of GridPose::text() round to whole degrees.
constexpr double kMiddle_deg = 0.5;

QString translated(const char* text) {
  return QCoreApplication::translate("PlanText", text);
}

// Of nine parts of the picture, in which the board's middle is.
QString part_of_picture(const GridPose& pose) {
  const char* const kParts[3][3] = {
      {QT_TRANSLATE_NOOP("PlanText", "upper left"), QT_TRANSLATE_NOOP("PlanText", "upper middle"),
       QT_TRANSLATE_NOOP("PlanText", "upper right")},
      {QT_TRANSLATE_NOOP("PlanText", "left"), QT_TRANSLATE_NOOP("PlanText", "in the middle"),
       QT_TRANSLATE_NOOP("PlanText", "right")},
      {QT_TRANSLATE_NOOP("PlanText", "lower left"), QT_TRANSLATE_NOOP("PlanText", "lower middle"),
       QT_TRANSLATE_NOOP("PlanText", "lower right")}};
  const auto third = [](double degrees) {
    // Lenses are not centred to a degree; the cells of the grid lie many degrees apart.
    constexpr double kCentred_deg = 3.0;
    return degrees < -kCentred_deg ? 0 : degrees > kCentred_deg ? 2 : 1;
  };
  return translated(kParts[third(pose.down_deg)][third(pose.right_deg)]);
}

QString degrees(const char* text, double value) {
  return translated(text).arg(std::abs(value), 0, 'f', 0);
}

}  // namespace

QStringList board_place_parts(const GridPose& pose) {
  QStringList parts;
  parts << translated(QT_TRANSLATE_NOOP("PlanText", "%1 m ahead")).arg(pose.distance_m, 0, 'f', 1)
        << part_of_picture(pose);
  if (pose.tilt_x_deg > kMiddle_deg)
    parts << degrees(QT_TRANSLATE_NOOP("PlanText", "upper side %1° nearer"), pose.tilt_x_deg);
  if (pose.tilt_x_deg < -kMiddle_deg)
    parts << degrees(QT_TRANSLATE_NOOP("PlanText", "upper side %1° back"), pose.tilt_x_deg);
  if (pose.tilt_y_deg > kMiddle_deg)
    parts << degrees(QT_TRANSLATE_NOOP("PlanText", "right side %1° back"), pose.tilt_y_deg);
  if (pose.tilt_y_deg < -kMiddle_deg)
    parts << degrees(QT_TRANSLATE_NOOP("PlanText", "left side %1° back"), pose.tilt_y_deg);
  if (parts.size() == 2) parts << translated(QT_TRANSLATE_NOOP("PlanText", "facing the camera"));
  if (pose.roll_deg > kMiddle_deg)
    parts << degrees(QT_TRANSLATE_NOOP("PlanText", "rolled %1° left"), pose.roll_deg);
  if (pose.roll_deg < -kMiddle_deg)
    parts << degrees(QT_TRANSLATE_NOOP("PlanText", "rolled %1° right"), pose.roll_deg);
  return parts;
}

QString board_place(const GridPose& pose) {
  return board_place_parts(pose).join(translated(QT_TRANSLATE_NOOP("PlanText", ", ")));
}

QString lidar_name(const std::string& name) {
  // Those of resources/lidars; other files have names of their own.
  static const char* const kKnown[] = {QT_TRANSLATE_NOOP("PlanText", "Six-line rosette"),
                                       QT_TRANSLATE_NOOP("PlanText", "Spinning, 128 lines")};
  for (const char* known : kKnown) {
    if (name == known) return translated(known);
  }
  return QString::fromStdString(name);
}

double board_tilt_deg(const GridPose& pose) {
  // About the x axis, then about y.
  return std::acos(std::clamp(
             std::cos(kRadPerDeg * pose.tilt_x_deg) * std::cos(kRadPerDeg * pose.tilt_y_deg), -1.0,
             1.0)) /
         kRadPerDeg;
}

double sigma_mm(const Matrix6d& covariance) {
  return 1e3 * std::sqrt(covariance.diagonal().head<3>().sum());
}

double sigma_mrad(const Matrix6d& covariance) {
  return 1e3 * std::sqrt(covariance.diagonal().tail<3>().sum());
}

QString sigma_text(double sigma) {
  // As many decimals as two digits need, not more than three.
  const int decimals =
      sigma > 0.0 ? std::clamp(1 - static_cast<int>(std::floor(std::log10(sigma))), 0, 3) : 3;
  return QString::number(sigma, 'f', decimals);
}

}  // namespace lvcalib::widgets
