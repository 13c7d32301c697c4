// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What the kinds of corruption are made of: changes of clouds, of images, and of what is printed.

#include <functional>
#include <optional>
#include <utility>

#include "support/corruptions.h"

namespace lvcalib::test {

/// An image of another size; `source` says which pixel of `from` every pixel takes. Grey where
/// there is none.
simulation::SimulatedImage mapped(const simulation::SimulatedImage& from, int width, int height,
                                  const std::function<std::pair<int, int>(int, int)>& source);
/// Every grey value changed.
simulation::SimulatedImage revalued(const simulation::SimulatedImage& from,
                                    const std::function<double(double)>& change);
/// Scaled about the middle by linear interpolation, the size kept.
simulation::SimulatedImage zoomed(const simulation::SimulatedImage& from, double factor);
/// Blurred three times by a box: about a Gaussian of this standard deviation.
simulation::SimulatedImage blurred(const simulation::SimulatedImage& from, double sigma_px);
/// Blocks of 8 × 8 pixels whose cosine coefficients are rounded to multiples of `step` grey values
/// (coarser by frequency), as strong JPEG does.
simulation::SimulatedImage blocky(const simulation::SimulatedImage& from, double step);

/// The points of a cloud for which `keep(place)` holds.
Cloud selected(const Cloud& cloud, const std::function<bool(std::size_t)>& keep);
/// Whether a point of a scene's cloud lies on its board; then its place there.
std::optional<Eigen::Vector2d> on_board(const simulation::SimulatedScene& scene,
                                        const Target& target, const Eigen::Vector3f& point_m);
/// Something that stands halfway before the left `share` of a scene's board: returns there come
/// from it, and the image shows it.
void cover(CorruptedRig& rig, std::size_t scene, double share, bool in_cloud, bool in_image);

/// Another print on every board, in images and intensities: the board's point p shows what the
/// print has at source(p). Points whose source is nothing are white.
using PrintSource = std::function<std::optional<Eigen::Vector2d>(const Eigen::Vector2d& point_m)>;
void reprint(CorruptedRig& rig, const PrintSource& source);
/// For reprint(): every tag shows that whose column and row `other` gives, turned by 180° if asked.
PrintSource other_tags(const Target& target,
                       std::function<std::pair<int, int>(int column, int row)> other,
                       bool upside_down);

/// Moves the clouds of scenes `first` and later by a small rigid motion of the LiDAR.
void bump(CorruptedRig& rig, std::size_t first, const Rigid3& motion, bool only_one = false);

/// A rig.yaml; the translation's unit is 1/`unit` metres.
std::string rig_text(const Rigid3& pose, double unit);

}  // namespace lvcalib::test
