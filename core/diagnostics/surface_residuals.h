// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "cloud/cloud.h"
#include "model/board_prediction.h"
#include "model/fitted_model.h"

namespace lvcalib {

/// A range residual at its place on the board.
struct SurfaceSample {
  Eigen::Vector2d board_m = Eigen::Vector2d::Zero();
  double residual_m = 0.0;  ///< Measured − predicted.
};

/// A model's range residuals of one scene: of every range row that the model was fitted to.
std::vector<SurfaceSample> range_samples(const FittedModel& model, int scene);
/// The same of these points of a cloud, by the base model's prediction.
std::vector<SurfaceSample> range_samples(const Cloud& cloud,
                                         const std::vector<std::uint32_t>& points,
                                         const BoardPredictor& predictor);

/// Residuals averaged over square cells of a board. Single returns scatter by centimetres; seen at
/// once, the near ones hide the far ones, and any board bulges towards its viewer.
class SurfaceResiduals {
 public:
  /// `cell_m` 0: about sixteen samples a cell, not finer than 5 mm.
  SurfaceResiduals(const BoardOutline& outline, const std::vector<SurfaceSample>& samples,
                   double cell_m = 0.0);

  /// The mean (m) in the cell that a place of the board lies in; nothing beside the board and in
  /// cells without samples.
  [[nodiscard]] std::optional<double> mean_m(const Eigen::Vector2d& board_m) const;
  [[nodiscard]] double cell_m() const { return cell_m_; }

 private:
  [[nodiscard]] std::optional<std::size_t> cell(const Eigen::Vector2d& board_m) const;

  BoardOutline outline_;
  double cell_m_;
  int columns_, rows_;
  std::vector<double> sum_m_;
  std::vector<int> count_;
};

}  // namespace lvcalib
