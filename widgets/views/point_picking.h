// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "views/lasso.h"

namespace lvcalib::widgets {

/// The drawn point under a place on the screen: of those within `radius_px`, the one nearest to the
/// viewer; points at about the same depth are told apart by their distance on the screen.
/// `clip_from_world` is the viewing and projection matrix (OpenGL); places in pixels from the top
/// left. `xyz` holds three numbers per point.
std::optional<std::size_t> pick_point(std::span<const float> xyz,
                                      const Eigen::Matrix4d& clip_from_world,
                                      const Eigen::Vector2d& viewport_px,
                                      const Eigen::Vector2d& place_px, double radius_px);

/// The drawn points that appear inside a closed line on the screen, at whatever depth, as places in
/// `xyz`.
std::vector<std::size_t> points_inside(std::span<const float> xyz,
                                       const Eigen::Matrix4d& clip_from_world,
                                       const Eigen::Vector2d& viewport_px, const LassoMask& mask);

}  // namespace lvcalib::widgets
