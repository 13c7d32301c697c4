// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "model/measurement_table.h"

namespace lvcalib {

/// Faults that every device has some of, however good: what a solve that lacks them leaves out.
/// Their values are the columns of FaultMoves.
enum class DeviceFault {
  kRangeOffset,         ///< Of all ranges (m).
  kRangeScale,          ///< Of all ranges.
  kAzimuthScale,        ///< Of the azimuth,
  kElevationScale,      ///< of the elevation.
  kEccentricitySine,    ///< An eccentric encoder, by sin az (rad),
  kEccentricityCosine,  ///< by cos az (rad).
  kAxisTilt,            ///< By sin el (rad).
  kOriginAcross,        ///< Beams start beside the frame's origin: across (m),
  kOriginUp,            ///< upwards (m).
};
inline constexpr int kDeviceFaults = 9;
/// What of a device they are faults of: ranges, angles or the beams' origin.
enum class FaultKind { kRange, kAngle, kOrigin };
constexpr FaultKind kind_of(DeviceFault fault) {
  return fault <= DeviceFault::kRangeScale ? FaultKind::kRange
         : fault <= DeviceFault::kAxisTilt ? FaultKind::kAngle
                                           : FaultKind::kOrigin;
}

/// One linear coefficient of an effect. Values are in SI units (m, rad, s, px, 1).
struct EffectParameter {
  std::string name;
  std::string unit;               ///< For people: "mm", "ppm", "mrad", "px", "1".
  double unit_in_si = 1.0;        ///< One unit in SI.
  double size_of_interest = 0.0;  ///< SI: what planned scenes shall show; no verdict asks it.
  double prior_sigma = 0.0;       ///< Standard deviation (SI) of what is believable.
  double lowest = -std::numeric_limits<double>::infinity();  ///< No device has less (SI).
  /// Its usual size is in LeftOutSizes. It depends on the beam alone.
  std::optional<DeviceFault> device_fault = std::nullopt;
};

/// What an effect needs besides the channels it acts on.
struct EffectNeeds {
  bool time = false;
  bool line = false;
  bool circles = false;
  bool tags = false;
  bool intensity = false;
};

/// Description of an effect, the same for every data set.
struct EffectInfo {
  std::string id;       ///< "range_walk"
  std::string group;    ///< "LiDAR range", "LiDAR angle", "beam", "radiometry", "board", "camera",
                        ///< "time", "user"
  std::string title;    ///< "Range walk"
  std::string physics;  ///< One sentence.
  std::string formula;
  std::string source;               ///< Literature or manual.
  std::string discriminating_pose;  ///< Or what else to measure: it tells it from its aliases.
  EffectNeeds needs;
  /// What it moves in the images is an error of camera.yaml's numbers: mended there, not here.
  bool of_intrinsics = false;
  /// Of a user's own effect: the text that make_user_effect() takes to make the same one again.
  std::string spec = {};
};

/// A point of the print: its place, and for a tag's corner the vector from the tag's centre.
struct PrintPoint {
  Eigen::Vector2d board_m = Eigen::Vector2d::Zero();
  Eigen::Vector2d from_tag_m = Eigen::Vector2d::Zero();
};

/// A physical effect. It is linear in its parameters; a shape number (a period, a decay length)
/// that is not, is chosen among shapes(). Each hook writes, for every parameter, by how much one SI
/// unit of it moves what is measured; hooks that an effect does not use leave zeros. The model
/// turns the movements into residuals of the channels.
class Effect {
 public:
  virtual ~Effect() = default;
  Effect() = default;
  Effect(const Effect&) = delete;
  Effect& operator=(const Effect&) = delete;

  [[nodiscard]] virtual const EffectInfo& info() const = 0;
  /// Its parameters on this table (some have one per laser line).
  [[nodiscard]] virtual std::vector<EffectParameter> parameters(
      const MeasurementTable& table) const = 0;
  /// How many parameters there are in each run of them, from the first on, whose sum is zero; what
  /// all of a run have in common is another effect, or nothing that any data can tell.
  [[nodiscard]] virtual std::vector<std::size_t> zero_sums(const MeasurementTable&) const {
    return {};
  }
  /// Values of the shape number to try; one zero if the effect has none.
  [[nodiscard]] virtual std::vector<double> shapes(const MeasurementTable&) const { return {0.0}; }
  /// Name and unit of the shape number; empty if none.
  [[nodiscard]] virtual std::string shape_name() const { return {}; }
  /// False if the shape number is a choice of the search rather than a quantity of nature.
  [[nodiscard]] virtual bool has_smooth_shape() const { return !shape_name().empty(); }
  /// True for what the base model measures already, so that it cannot be added.
  [[nodiscard]] virtual bool is_in_base_model() const { return false; }
  /// True for what tells the prints apart by itself, so that it may show on one alone.
  [[nodiscard]] virtual bool is_about_prints() const { return false; }
  /// True for what no data can tell from the extrinsic itself.
  [[nodiscard]] virtual bool is_gauge() const { return false; }
  /// True if what it does to an intensity or, along the ray, to a range follows the share of white
  /// under the beam so steeply that it is asked again with what is predicted there once the print
  /// has moved: rows carry the white (and darkness) of when they were chosen.
  [[nodiscard]] virtual bool follows_white() const { return false; }

  /// Displacement (LiDAR frame, m) of the measured point from the true one.
  virtual void lidar(const BeamPoint& /*beam*/, const MeasurementTable& /*table*/, double /*shape*/,
                     std::span<Eigen::Vector3d> /*by_parameter*/) const {}
  /// Change (m) of a measured range by what the beam alone does not tell (raw intensity, print).
  virtual void range(const RangeRow& /*row*/, const MeasurementTable& /*table*/, double /*shape*/,
                     std::span<double> /*by_parameter*/) const {}
  /// Displacement (board frame, m) of the board's material at a point of the print.
  virtual void board(const PrintPoint& /*point*/, const Target& /*target*/, double /*shape*/,
                     std::span<Eigen::Vector3d> /*by_parameter*/) const {}
  /// Displacement (px) of a corner's image. normalized: the camera ray's x/z, y/z.
  virtual void camera(const CornerRow& /*row*/, const Eigen::Vector2d& /*normalized*/,
                      const Camera& /*camera*/, double /*shape*/,
                      std::span<Eigen::Vector2d> /*by_parameter*/) const {}
  /// Outward shift (m) of the edge of dark print.
  virtual void edge(const BoundaryRow& /*row*/, const MeasurementTable& /*table*/, double /*shape*/,
                    std::span<double> /*by_parameter*/) const {}
  /// Displacement (LiDAR frame, m) of the place whose light is measured from the place that the
  /// reported direction meets.
  virtual void spot(const BeamPoint& /*beam*/, const MeasurementTable& /*table*/, double /*shape*/,
                    std::span<Eigen::Vector3d> /*by_parameter*/) const {}
  /// Change (rad²) of the beam's blur: horizontal, mixed, vertical.
  virtual void blur(const BeamPoint& /*beam*/, const MeasurementTable& /*table*/, double /*shape*/,
                    std::span<Eigen::Vector3d> /*by_parameter*/) const {}
  /// Change of the logarithm of the intensity.
  virtual void intensity(const IntensityRow& /*row*/, const MeasurementTable& /*table*/,
                         double /*shape*/, std::span<double> /*by_parameter*/) const {}
};

using EffectPtr = std::shared_ptr<const Effect>;

/// The catalogue: one object of every effect, in a fixed order.
const std::vector<EffectPtr>& effect_catalogue();

/// An effect by id; nullptr if there is none.
EffectPtr find_effect(const std::string& id);
/// An effect as a sentence names it: by its id, which is what one types; a window says the title of
/// one of the catalogue.
Message effect_named(const std::string& id);
std::vector<Message> effects_named(const std::vector<std::string>& ids);
/// "name = value" of a parameter of the effect `id`. Names of the catalogue are translated, those
/// of the user's own effects are his.
Message parameter_is(const std::string& id, const std::string& name, const std::string& value);

/// Why an effect cannot be tested on this table ("no time in these clouds"); empty if it can.
Message why_not_testable(const Effect& effect, const MeasurementTable& table);

}  // namespace lvcalib
