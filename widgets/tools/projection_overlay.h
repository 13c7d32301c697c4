// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QColor>

#include "pipeline/calibration.h"
#include "views/image_overlay.h"

namespace lvcalib::widgets {

/// Colours of what either extrinsic projects.
QColor first_projection_color();
QColor second_projection_color();

/// The LiDAR's points on the board of a scene, its outline and its circles, as two extrinsics
/// project them, and by how much they differ over the board. Runs on any thread.
ImageOverlay projection_overlay(const CalibrationResult& result, const SceneResult& scene,
                                const Rigid3& first_camera_from_lidar,
                                const Rigid3& second_camera_from_lidar);

}  // namespace lvcalib::widgets
