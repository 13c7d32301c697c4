// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "model/board_prediction.h"
#include "model/effect_rows.h"
#include "model/linear_model.h"
#include "model/scene_geometry.h"

namespace lvcalib {

/// A return's residual against the prediction of the print, and the derivatives of what is
/// predicted, all in the units of the row's channel (see IntensityReading).
struct PrintRow {
  double residual = 0.0;                      ///< Measured − predicted, effects in use taken out.
  Vector6d by_board_pose = Vector6d::Zero();  ///< Left perturbation of T_camera_board; that by the
                                              ///< extrinsic is its negative.
  Eigen::Matrix<double, kLevelParameters, 1> by_levels =
      Eigen::Matrix<double, kLevelParameters, 1>::Zero();
  PrintSensitivity print;
  Eigen::RowVector2d range_by_shift = Eigen::RowVector2d::Zero();  ///< Of a range (1),
  double range_by_growth = 0.0;  ///< as PrintSensitivity::by_growth.
};

/// Rows of one scene of a table with a print, predicted by BoardPredictor with effects in use: the
/// ray that the LiDAR reports is moved to the true one (in the print's coordinates), black grows,
/// everything else is added to first order.
class PrintRows {
 public:
  /// `growth`: whether it is asked what growing black would do, without such an effect in use.
  PrintRows(const MeasurementTable& table, const ModelState& state, std::size_t scene,
            const std::vector<EffectInUse>& in_use, bool growth = false);

  // What it refers to lies within itself.
  PrintRows(const PrintRows&) = delete;
  PrintRows& operator=(const PrintRows&) = delete;

  /// `seen`: the print as the row saw it last, brought up to date; null: as the table's row has it.
  [[nodiscard]] std::optional<PrintRow> range(const RangeRow& row, LocalPrint* seen = nullptr);
  [[nodiscard]] std::optional<PrintRow> edge(const BoundaryRow& row, LocalPrint* seen = nullptr);
  [[nodiscard]] std::optional<PrintRow> intensity(const IntensityRow& row,
                                                  LocalPrint* seen = nullptr);

  /// What one unit of each parameter of the effects in use does to the row that was predicted last.
  [[nodiscard]] const std::vector<UnitChange>& by_parameters() const { return changes_; }

 private:
  std::optional<PrintRow> reading(const IntensityRow& row, const BoundaryRow* edge,
                                  LocalPrint* seen);
  // `known`: the print as the table's row has it.
  [[nodiscard]] const std::optional<ReturnPrediction>& predicted(const BeamPoint& beam,
                                                                 const PrintChange& change,
                                                                 const LocalPrint& known,
                                                                 LocalPrint* seen);
  [[nodiscard]] double value(const EffectColumns& c, std::size_t k) const {
    const auto at = static_cast<std::size_t>(&c - columns_.list().data());
    return in_use_[at].values(static_cast<Eigen::Index>(k));
  }
  void set_pose(const Vector6d& by_lidar_pose, PrintRow& out) const;

  // What the effects in use that follow the white under a beam do with the white predicted there,
  // in place of what they do with the row's: how much more in all, and how that grows with white.
  struct Followed {
    double more = 0.0;
    double by_white = 0.0;
  };
  // `ask(columns, beam, by_parameter)` asks an effect's hooks; `changed` is what they tell.
  template <class Ask>
  Followed follow_white(const BeamPoint& beam, double white, double UnitChange::*changed,
                        const Ask& ask);

  // ∂A/∂I of a prediction: what moves the print changes both.
  [[nodiscard]] double white_by_intensity(const ReturnPrediction& p) const;

  const MeasurementTable& table_;
  const std::vector<EffectInUse>& in_use_;
  EffectColumnsList columns_;
  EffectRows rows_;
  SceneGeometry geometry_;
  Eigen::Matrix3d rotation_;
  BoardPredictor predictor_;
  BoardLevels levels_;
  double log_contrast_;
  std::vector<const EffectColumns*> following_;  // Of effects that follow white.
  bool growth_;
  std::vector<UnitChange> changes_;
  // Room for what an effect's hooks write that is asked with another white.
  std::vector<double> here_, above_, below_;
  std::vector<Eigen::Vector3d> own_moves_;
  // What was predicted last.
  struct Predicted {
    ReturnKey key;
    PrintChange change;
    LocalPrint seen;
    std::optional<ReturnPrediction> prediction;
  };
  std::optional<Predicted> last_;
};

}  // namespace lvcalib
