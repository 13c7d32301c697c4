// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include <Eigen/Core>

namespace lvcalib::widgets {

/// The drawn point under a place on the screen: of those within `radius_px`, the one nearest to the
/// viewer; points at about the same depth are told apart by their distance on the screen.
/// `clip_from_world` is the viewing and projection matrix (OpenGL); places in pixels from the top
/// left. `xyz` holds three numbers per point.
std::optional<std::size_t> pick_point(std::span<const float> xyz,
                                      const Eigen::Matrix4d& clip_from_world,
                                      const Eigen::Vector2d& viewport_px,
                                      const Eigen::Vector2d& place_px, double radius_px);

}  // namespace lvcalib::widgets
