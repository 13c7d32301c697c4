// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/rigid3.h"
#include "camera/camera.h"
#include "target/target.h"

namespace lvcalib::simulation {

enum class LidarKind {
  kRosette,   ///< One line behind two Risley prisms, like a Livox Mid-70.
  kAvia,      ///< Six lines behind two Risley prisms, like a Livox Avia.
  kSpinning,  ///< Lines over 45° (16 lines: 30°) of elevation turning about the z axis.
};

/// The LiDAR. A shot leaves in its commanded direction plus jitter, with an elliptic Gaussian
/// footprint whose axes follow the scanner (horizontal, vertical). The reported point lies in the
/// commanded direction at the reported range. The noise defaults follow clean indoor scans of a
/// Livox class device: 8 mm of range noise on white paper, 16 mm on black print, 1 mrad between
/// full black and full white at a sharp edge (jitter and footprint together, one sigma).
struct LidarOptions {
  LidarKind kind = LidarKind::kAvia;
  /// Points per scene, 1 … 10⁷; 0: rosette 200 000, avia 240 000, spinning five revolutions.
  int points = 0;
  int lines = 128;                    ///< Lines of a spinning LiDAR: 16, 32, 64 or 128.
  double fov_deg = 70.4;              ///< Rosettes: diameter of one line's field, 10 … 120.
  double range_sigma_m = 0.008;       ///< Range noise on white (reflectivity 0.85), ≥ 0.
  double range_dark_exponent = 0.3;   ///< Noise grows as (0.85/reflectivity)^this, 0 … 1.
  double angle_sigma_deg = 0.024;     ///< Direction jitter per axis, 0 … 1.
  double beam_horizontal_mrad = 1.2;  ///< Footprint, one sigma, half angle, 0 … 10.
  double beam_vertical_mrad = 0.8;
  /// Sub-rays of a footprint that meets an edge, 7 … 256. Fewer are faster and leave steps in
  /// the transition.
  int beam_rays = 61;
  /// Returns closer than this along the beam come back as one pulse at their mean range.
  double pulse_length_m = 0.25;
  /// Whether the range of a footprint on one surface is the power-weighted mean over the footprint
  /// (true, physical: darker parts of a tilted board pull less) or that of the beam's axis.
  bool range_follows_power = true;
  double intensity_scale = 150.0;   ///< Intensity of a perfect white reflector.
  double intensity_sigma = 4.0;     ///< Noise, in intensity units, ≥ 0.
  double incidence_exponent = 0.2;  ///< What the device leaves of cos(incidence), 0 … 2.
  double range_exponent = 0.05;     ///< What the device leaves of (range/3 m)^−1, 0 … 2.
};

/// The camera and its image (8 bit, linear response).
struct ImageOptions {
  int width_px = 1440;  ///< 320 … 8192.
  int height_px = 900;  ///< 240 … 8192.
  DistortionModel distortion = DistortionModel::kPlumbBob;
  double blur_px = 0.7;         ///< Gaussian lens blur, one sigma, 0 … 10.
  double white_level = 205.0;   ///< Grey value of the board's white, 20 … 255.
  double full_well_e = 2000.0;  ///< Electrons at grey value 255; sets the shot noise; > 0.
  double read_noise = 1.0;      ///< In grey values, ≥ 0.
};

/// Where the board stands and what else is in the room.
struct PlacementOptions {
  double min_distance_m = 2.0;  ///< LiDAR to board centre, 0.5 … 20.
  double max_distance_m = 4.0;
  double max_tilt_deg = 35.0;  ///< Between the board's normal and the line of sight, 0 … 70.
  double max_roll_deg = 20.0;  ///< About the board's normal, 0 … 180.
  bool board = true;           ///< False: a room without the board.
  bool decoy = true;           ///< A panel of the board's size with another print.
  bool clutter = true;         ///< Boxes on the floor.
  bool partial = false;        ///< 10 % to 50 % of the board outside the LiDAR's field of view.
  bool flush_on_wall = false;  ///< The board hangs on a wall instead of standing before it.
  /// T_lidar_board of the first scenes, where they are wanted and not drawn; the room stands
  /// behind.
  std::vector<Rigid3> lidar_from_board;
};

struct SimulationOptions {
  std::uint64_t seed = 1;
  int scenes = 3;  ///< 1 … 1000.
  Target target;
  LidarOptions lidar;
  ImageOptions image;
  PlacementOptions placement;
  /// Effects to plant: id → value in the unit that disturbances() (disturbances/registry.h) states.
  std::map<std::string, double> effects;
};

/// kUsage for a value outside its range or an unknown effect (naming the nearest);
/// the target's own error for an impossible board.
Status check(const SimulationOptions& options);

/// Points per scene with the kind's default filled in.
int point_count(const LidarOptions& options);

/// Lines that the kind has.
int line_count(const LidarOptions& options);

}  // namespace lvcalib::simulation
