// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "base/progress.h"
#include "base/rigid3.h"
#include "camera/camera.h"
#include "model/board_prediction.h"
#include "model/channel.h"
#include "target/target.h"

namespace lvcalib {

/// The nearest circle's edge, seen from a point of the board.
struct NearEdge {
  double distance_m = 0.0;    ///< Outside positive.
  double psi_rad = 0.0;       ///< Polar angle about the node, board frame.
  double transition_m = 0.0;  ///< Width σ of the transition along ψ.
  bool plain = false;         ///< The spot is on plain print and sees a trace of the edge.
};

/// What a beam hits, by geometry.
enum class Print { kWhite = 0, kBlack = 1 };
constexpr std::size_t kPrints = 2;

/// What is known about the place where one beam meets the board, whatever is measured there.
/// Effects and plots read it; nothing in it comes from the noisy range or intensity of the point
/// itself.
struct BeamPoint {
  int scene = 0;
  int line = 0;                                          ///< 0 if absent.
  Eigen::Vector3d direction = Eigen::Vector3d::UnitX();  ///< Unit, LiDAR frame, as reported.
  double range_m = 0.0;                                  ///< Predicted: ray ∩ board.
  double azimuth_rad = 0.0;
  double elevation_rad = 0.0;
  Eigen::Vector2d board_m = Eigen::Vector2d::Zero();  ///< Ray ∩ board, board frame.
  double incidence_rad = 0.0;                         ///< Between beam and normal, 0…π/2.
  double slope_rad = 0.0;  ///< α: in-board direction (board frame) in which the range grows.
  /// Received power as the print and the scene's two levels predict it, on a logarithmic scale
  /// common to all scenes: 0 for the usual white, 1 for the usual black.
  double darkness = 0.0;
  double white = 1.0;  ///< Share of white print in the blurred spot, as predicted.
  /// Share of the pointing jitter in the blur's variance across the edge that it sees, 0 … 1.
  double jitter_share = 0.0;
  std::optional<NearEdge> edge;  ///< Of which at least a trace is seen.
  double time_s = 0.0;           ///< From the start of the scan; 0 if absent.
  /// Scan velocity across the beam (azimuth·cos elevation, elevation), rad/s; 0 where unknown.
  Eigen::Vector2d scan_rad_s = Eigen::Vector2d::Zero();
};

/// A range measurement on the board.
struct RangeRow {
  BeamPoint beam;
  double measured_m = 0.0;
  double intensity = 0.0;  ///< Raw.
  double sigma_m = 0.0;
  Print print = Print::kWhite;
  LocalPrint seen = {};  ///< The print where it was predicted last.
};

/// A return's intensity beside the print that the model predicts there. Its residual is measured
/// minus predicted intensity over `unit`: the slope of the print for what is told as a distance,
/// the predicted intensity for what is told as a logarithm.
struct IntensityReading {
  double measured = 0.0;  ///< Raw.
  double unit = 1.0;      ///< Raw intensity in one unit of the row's channel.
  LocalPrint seen = {};   ///< The print where it was predicted last.
};

/// A single return in the blur of an edge of the print, told as the distance by which the edge lies
/// off.
struct BoundaryRow {
  BeamPoint beam;
  int node = -1;              ///< The circle whose edge it is; −1: another edge's.
  double psi_rad = 0.0;       ///< Polar angle of the way from black to white, board frame.
  double transition_m = 0.0;  ///< Width σ of the transition in the board, along ψ.
  /// Gradient of the board coordinate along ψ by (azimuth·cos elevation, elevation), m/rad: how
  /// the LiDAR's angles cross the edge.
  Eigen::Vector2d edge_normal_rad = Eigen::Vector2d::Zero();
  double log_contrast = 0.0;  ///< ln(white / black).
  double sigma_m = 0.0;
  IntensityReading reading;
};

/// A corner of a tag or checkerboard: two residuals.
struct CornerRow {
  int scene = 0;
  int feature = 0;
  int corner = 0;
  Eigen::Vector2d board_m = Eigen::Vector2d::Zero();
  Eigen::Vector2d from_tag_m = Eigen::Vector2d::Zero();   ///< From the tag's centre; 0: no tag.
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();        ///< Measured.
  Eigen::Vector2d from_tag_px = Eigen::Vector2d::Zero();  ///< From the image of the tag's centre.
  double sigma_px = 0.0;
};

/// Intensity of a LiDAR point well inside black or white print.
struct IntensityRow {
  BeamPoint beam;
  Print print = Print::kWhite;
  double log_intensity = 0.0;
  double sigma = 0.0;  ///< Of the logarithm.
  IntensityReading reading = {};
};

/// One scene of the table and its place in the model.
struct TableScene {
  std::string name;
  std::vector<int> features;  ///< Distinct corner features (tags), in order of appearance.
  double clock = 0.0;         ///< 0…1 over the scenes in their order.
  /// Of the beam towards the board's middle: where its levels are told.
  double middle_range_m = 1.0;
  double middle_incidence_rad = 0.0;
  /// Variance inflation per channel because neighbours along a line err alike (see SceneNoise).
  std::array<double, kChannels> inflation{1.0, 1.0, 1.0, 1.0};
};

/// State that the measurements are predicted from: the extrinsic, a board pose and levels per
/// scene, and the beam.
struct ModelState {
  Rigid3 camera_from_lidar;
  std::vector<Rigid3> camera_from_board;
  std::vector<BoardLevels> levels = {};
  BeamSpread beam = {};
};

struct EffectInUse;

/// All measurements that a finished calibration keeps, thinned evenly over the boards, with every
/// covariate. Rows are grouped by scene, in the order of the scenes.
struct MeasurementTable {
  Target target;
  Camera camera;
  std::vector<TableScene> scenes;
  std::vector<RangeRow> range;
  std::vector<BoundaryRow> boundary;
  std::vector<CornerRow> corner;
  std::vector<IntensityRow> intensity;
  std::vector<int> lines;  ///< Distinct laser lines; empty if the clouds have none.
  bool has_time = false;
  bool has_intensity = false;
  /// Usual raw intensity of each print: medians of the scenes' levels; 1 where there is none.
  std::array<double, kPrints> level{1.0, 1.0};
  [[nodiscard]] double level_of(Print print) const {
    return level[static_cast<std::size_t>(print)];
  }
  /// ln(white/black): what darkness 1 stands for.
  double log_contrast = 0.0;
  /// The state by which points were told to lie on which print; its jitter is that of the rows.
  ModelState placed_by;
  /// The print that every return is predicted from.
  std::shared_ptr<const BlurredPrint> print;
  /// Makes the table again for another state and effects in use: which returns are in
  /// the blur of an edge, and how far single ones are weighed down, follows what the model
  /// predicts.
  std::function<MeasurementTable(const ModelState&, const std::vector<EffectInUse>&,
                                 const RunContext&)>
      again;
  /// Variances of structure that nothing explains, as the joint solve found them, in the order of
  /// VarianceGroup; empty: the fit starts from usual ones.
  std::vector<double> structure_variances;
  /// And of errors of the sensor's ranges (m², see sensor_errors.h); empty: there are none.
  std::vector<double> sensor_variances;

  [[nodiscard]] std::size_t size(Channel channel) const;

  /// Everything but the rows, and what makes them again: for other rows of the same scenes.
  [[nodiscard]] MeasurementTable without_rows() const;
};

}  // namespace lvcalib
