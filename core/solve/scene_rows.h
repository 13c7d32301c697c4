// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "model/effect_rows.h"
#include "model/scene_geometry.h"
#include "solve/pointing_jitter.h"
#include "solve/print_table.h"

namespace lvcalib {

/// The LiDAR's rows of one scene.
struct TableRows {
  std::vector<RangeRow> range;
  std::vector<BoundaryRow> boundary;
  std::vector<IntensityRow> intensity;
};

/// A scene as it is kept for as long as its table may be made again.
struct KeptScene {
  SceneMeasurements measured;
  Cloud cloud;
  std::vector<Eigen::Vector2d> scan_rad_s;  ///< Empty if the cloud does not tell.
};

/// The returns of one scene that are on the board as the model predicts them, with the noise that
/// their replicates show: what the rows of a table are made of.
class SceneRows {
 public:
  /// `table`: what it says of all scenes, and the state that it is placed by. `known`: the print as
  /// all points of the scene saw it before, by their places in the cloud; may be null. `input` must
  /// outlive this.
  SceneRows(const KeptScene& input, int scene, const SceneNoise& noise,
            const MeasurementTable& table, const std::vector<EffectInUse>& in_use,
            const std::vector<LocalPrint>* known);

  [[nodiscard]] bool has_intensity() const { return has_intensity_; }
  [[nodiscard]] const BoardLevels& levels() const { return levels_; }
  /// The print as every point of the scene saw it.
  [[nodiscard]] std::vector<LocalPrint> seen() const;
  /// What the scene's edges say of the jitter, and the jitter as all scenes say it.
  [[nodiscard]] JitterRegression scatter() const;
  void set_jitter(const Eigen::Matrix2d& jitter_rad2) { jitter_rad2_ = jitter_rad2; }
  /// `usual`: has the levels of all scenes, to which darkness refers. At most `most` of a kind.
  [[nodiscard]] TableRows rows(const MeasurementTable& usual, std::size_t most);

 private:
  // A return and what is predicted of it.
  struct Return {
    BeamPoint beam;
    std::uint32_t point = 0;  // In the scene's cloud.
    std::uint64_t lot = 0;    // Decides which returns stay where there are too many.
    double measured_m = 0.0;
    double range_residual_m = 0.0;
    double intensity = 0.0;
    double predicted = 0.0;
    double plain_level = 0.0;  // Predicted without what effects do to intensities.
    double white = 1.0;        // Share in the blurred spot.
    double slope = 0.0;        // Of the intensity across the edge, per metre.
    PrintView::Kind print = PrintView::Kind::kPlain;
    Eigen::RowVector2d by_angle = Eigen::RowVector2d::Zero();  // Of the intensity, per radian.
    LocalPrint seen;    // The print at the place that the ray meets,
    LocalPrint moved;   // at the one that effects displace under its light,
    LocalPrint ranged;  // and under what is ranged.

    [[nodiscard]] bool is_plain() const { return print == PrintView::Kind::kPlain; }
    [[nodiscard]] bool is_edge() const { return print == PrintView::Kind::kEdge; }
    [[nodiscard]] std::size_t surface() const { return white > 0.5 ? 0 : 1; }
  };
  class Effects;
  struct Look;

  [[nodiscard]] std::optional<Look> look_at(std::uint32_t i, const BoardPredictor& predictor,
                                            const BeamSpread& beam, Effects& effects) const;
  void collect(const BeamSpread& beam, const SceneNoise& noise, Effects& effects);
  void describe_print(const ReturnPrediction& p, const BeamSpread& beam, double intensity,
                      double gain, Return& r) const;
  void measure_noise(const SceneNoise& fallback);
  template <class Wanted>
  [[nodiscard]] std::vector<std::size_t> thinned(const Wanted& wanted, std::size_t most) const;
  [[nodiscard]] RangeRow range_row(const Return& r) const;
  [[nodiscard]] double plain_sigma(const Return& r) const;
  [[nodiscard]] double intensity_sigma(const Return& r) const;
  [[nodiscard]] BoundaryRow edge_row(const Return& r) const;
  [[nodiscard]] IntensityRow intensity_row(const Return& r) const;

  const std::vector<LocalPrint>* known_;
  const KeptScene& input_;
  int scene_;
  const BlurredPrint& print_;
  BoardLevels levels_;
  Eigen::Matrix2d jitter_rad2_;
  SceneGeometry geometry_;
  std::vector<Return> returns_;
  std::array<double, 2> range_noise_m_{};  // White, black.
  std::array<double, 2> intensity_noise_{};
  bool has_intensity_ = false;
};

}  // namespace lvcalib
