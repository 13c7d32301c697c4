// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include <Eigen/Core>

#include "views/cloud_scene.h"

class vtkActor;
class vtkProperty;
template <class T>
class vtkSmartPointer;

namespace lvcalib::widgets {

struct CloudLine;

/// Points of one portion: small enough that it draws in a few milliseconds, large enough that the
/// number of portions does not matter.
inline constexpr std::size_t kCloudPortion = 25'000;

/// Actors that draw a cloud in portions, in the order of its points. They read the scene's arrays,
/// which must outlive them.
std::vector<vtkSmartPointer<vtkActor>> point_portions(const CloudScene& scene,
                                                      vtkProperty& property);

/// Makes an actor draw these lines, or hides it if there are none.
void show_lines(vtkActor& actor, const std::vector<CloudLine>& lines);

/// Makes an actor draw these points (m), large if they are few, or hides it if there are none.
void show_points(vtkActor& actor, const std::vector<Eigen::Vector3d>& points_m,
                 double device_pixel_ratio = 1.0);

}  // namespace lvcalib::widgets
