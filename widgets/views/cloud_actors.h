// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include <Eigen/Core>

#include "views/cloud_scene.h"

class vtkActor;
class vtkProp3D;
class vtkProperty;
template <class T>
class vtkSmartPointer;

namespace lvcalib::widgets {

struct CloudLine;
enum class CloudLineWidth;

/// Points of one portion: small enough that it draws in a few milliseconds, large enough that the
/// number of portions does not matter.
inline constexpr std::size_t kCloudPortion = 25'000;

/// Actors that draw a cloud in portions, in the order of its points. They read the scene's arrays,
/// which must outlive them.
std::vector<vtkSmartPointer<vtkActor>> point_portions(const CloudScene& scene,
                                                      vtkProperty& property);

/// Makes an actor draw those of these lines that have this width; hides it if there are none.
void show_lines(vtkActor& actor, const std::vector<CloudLine>& lines, CloudLineWidth width);

/// Moves what is drawn towards the viewer's eye, by this share of its distance. It stays where it
/// is in the picture, and comes before what scatters about the same surface.
void bring_forward(vtkProp3D& prop, const Eigen::Vector3d& eye_m, double share);

/// Makes an actor draw these points (m), large if they are few, or hides it if there are none.
void show_points(vtkActor& actor, const std::vector<Eigen::Vector3d>& points_m,
                 double device_pixel_ratio = 1.0);

}  // namespace lvcalib::widgets
