// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <Eigen/Core>

#include "model/board_prediction.h"
#include "solve/board_returns.h"
#include "solve/forward_problem.h"

namespace lvcalib {

/// Size of the print as the LiDAR sees it over what the target says, along the board's x and y.
struct PrintSize {
  bool measured = false;
  Eigen::Vector2d scale = Eigen::Vector2d::Ones();
  Eigen::Vector2d sigma = Eigen::Vector2d::Zero();
};

/// Measures the print on one board whose pose is about known, by its intensities alone: the print
/// stretched by (s_x, s_y) about the board's middle, shifted and turned on the plane, with levels
/// of its own (least squares, Huber's weights; a search over ±25 % first). The size in metres rests
/// on the LiDAR's ranges and angles; the camera has no part in it. Not measured where the print
/// does not determine it to 5 % or the fit runs away.
PrintSize measure_print_size(const BoardReturns& returns, const BlurredPrint& print,
                             const Rigid3& lidar_from_board, const BoardLevels& levels,
                             const BeamSpread& beam, const SceneNoise& noise);

/// Size of the board from where it stands alone, however wrong the print was matched: the camera's
/// distances between boards are as wrong as the size that they were computed with, the LiDAR's are
/// not. One number for both axes; σ from what the boards' middles scatter, Student's included. Not
/// measured with fewer than three boards, or where they stand too close to each other to tell 5 %.
PrintSize size_from_places(const std::vector<Rigid3>& camera_from_board,
                           const std::vector<Rigid3>& lidar_from_board,
                           const Rigid3& camera_from_lidar, const Eigen::Vector2d& center_m);

/// Mean over scenes by their weights, its σ widened by what they scatter beyond their own.
PrintSize combined_print_size(const std::vector<PrintSize>& scenes);

/// What one scene says of the print's size.
struct SceneSize {
  PrintSize by_returns;
  double intensity_left = 1.0;  ///< Share of the intensities' variance that the print leaves.
  Rigid3 camera_from_board;     ///< Of the image alone,
  Rigid3 lidar_from_board;      ///< and of the cloud alone.
};

/// Size of the print over all scenes: by its returns, or by where the boards stand if that speaks
/// clearly and the returns do not. A print of quite another size is matched anywhere, and what its
/// returns then say of the size is chance. A wrong focal length shows in where boards stand, too: a
/// print that explains its intensities is believed.
PrintSize print_size_of(const std::vector<SceneSize>& scenes, const Rigid3& camera_from_lidar,
                        const Eigen::Vector2d& center_m);

}  // namespace lvcalib
