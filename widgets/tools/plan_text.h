// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QString>
#include <QStringList>
#include <string>

#include "design/planning.h"

namespace lvcalib::widgets {

/// A board pose in words for whoever holds the board, as the camera sees it: "2.0 m ahead, upper
/// left, right side 30° back, rolled 45° left".
QString board_place(const GridPose& pose);
/// The same in its parts; the first two say where, the others how it is turned.
QStringList board_place_parts(const GridPose& pose);

/// The name of a LiDAR's description, translated if it is one that the program brings along.
QString lidar_name(const std::string& name);

/// Angle between the board's normal and the line of sight, in degrees.
double board_tilt_deg(const GridPose& pose);

/// One standard deviation of an extrinsic's position in mm and of its rotation in mrad: root of the
/// sum over the three axes.
double sigma_mm(const Matrix6d& covariance);
double sigma_mrad(const Matrix6d& covariance);
/// With two digits that count.
QString sigma_text(double sigma);

}  // namespace lvcalib::widgets
