// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "diagnostics/surface_residuals.h"
#include "pipeline/calibration.h"
#include "selection/model_session.h"

namespace lvcalib {

/// What a scene's ranges leave over its board, and where that board is.
struct BoardSurface {
  enum class Against {
    kModel,  ///< The model with its effects.
    kBase,   ///< The joint solve's model without effects.
    kPlane,  ///< The plane through the board's own points: the scene takes no part in a solve.
  };
  Against against = Against::kPlane;
  Rigid3 lidar_from_board;
  SurfaceResiduals residuals;

  /// The mean (m) about the place where a point's ray meets the board; nothing for points beside
  /// the board, or so far before or behind it that they belong to something else.
  [[nodiscard]] std::optional<double> mean_m(const Eigen::Vector3d& point_m) const;
};

/// Of a scene under the model in force: that of `step`, if it is not null and knows the scene, else
/// the joint solve's, else the plane of the board's points. Nothing without a board.
std::optional<BoardSurface> board_surface(const CalibrationResult& result, std::size_t scene,
                                          const ModelStep* step);

}  // namespace lvcalib
