// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/disturbances/registry.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "base/yaml_file.h"

namespace lvcalib::simulation {
namespace {

std::vector<Disturbance> lidar_disturbances() {
  return {
      {"range_offset", "mm", -200, 200, 20, false, "every range is too long by the value"},
      {"range_scale", "ppm", -20000, 20000, 1000, false,
       "every range is too long by this share of it"},
      {"range_walk", "mm", -100, 100, 10, false,
       "how much longer black print is ranged than white at 3 m, as a leading-edge trigger does"},
      {"range_incidence", "mm", -50, 50, 5, false, "range error a of a(sec θ − 1) at incidence θ"},
      {"range_cyclic", "mm", -50, 50, 3, false,
       "amplitude of a range error that is periodic in range, with a slight second harmonic"},
      {"range_near", "mm", -500, 500, 30, false,
       "range error at range 0, decaying with range over 1.5 m"},
      {"range_warmup", "mm", -100, 100, 10, false,
       "range error when the first scene starts, decaying as the device warms up"},
      {"range_drift", "mm", -200, 200, 20, false,
       "range error that every scan would settle to, growing anew from its start"},
      {"channel_range_offset", "mm", 0, 100, 10, true,
       "RMS of a range offset that every line has of its own"},
      {"boundary_range_pull", "1", 0, 10, 3, false,
       "how many times as strongly as power alone brighter parts of a footprint pull the range; "
       "1 is what every simulated scan has"},
      {"angle_scale", "ppm", -20000, 20000, 2000, false,
       "share by which azimuths are reported too large; elevations have a share of their own"},
      {"encoder_eccentricity", "mrad", -20, 20, 2, false,
       "amplitude of an azimuth error with the period of a turn"},
      {"axis_wobble", "mrad", -20, 20, 2, false,
       "tilt i of the scan plane: azimuths are reported too large by i tan(elevation)"},
      {"channel_angle_offset", "mrad", 0, 20, 1, true,
       "RMS of an elevation error that every line has of its own; half as much in azimuth"},
      {"beam_origin_offset", "mm", -100, 100, 10, false,
       "sideways distance between beam and origin: azimuths are reported too large by value/range"},
      {"encoder_lag", "us", -200, 200, 5, false,
       "the reported direction is this much later than the shot"},
      {"boundary_bias", "mm", -5, 5, 2, false,
       "how far every black edge lies outside its printed place in the LiDAR's light"},
      {"beam_divergence", "mrad", 0, 10, 1.5, false,
       "one sigma of the footprint's half angle in both axes, instead of the options'"},
      {"footprint_anisotropy", "mrad", -10, 10, 1, false,
       "horizontal minus vertical divergence, their mean kept"},
      {"footprint_offset", "mrad", -10, 10, 1, false,
       "how far the print appears shifted towards growing azimuth; range stays on the axis"},
      {"blooming", "1", -0.25, 0.35, 0.1, false,
       "how far white spreads over black edges, in footprint sigmas per log contrast"},
      {"detector_lag", "us", 0, 200, 5, false,
       "time constant by which the intensity trails the scan"},
      {"intensity_geometry", "1", 0, 2, 0.6, false,
       "exponent of cos θ left in the intensity; half of it on 1/range; 3 % of gain per line"},
      {"intensity_nonlinearity", "1", 0.2, 5, 0.7, false,
       "exponent g of I' = I^g, a white reflector's intensity kept"},
      {"specular_lobe", "1", 0, 5, 0.3, false,
       "reflectivity that a glossy board adds at normal incidence"},
      {"receiver_saturation", "mm", -100, 100, 10, false,
       "range error of white at 3 m where the receiver saturates; intensity is clipped with it"},
  };
}

std::vector<Disturbance> scene_disturbances() {
  return {
      {"board_bow", "mm", -5, 5, 2, false,
       "height of the board's middle over its left and right edges; less bow and twist otherwise"},
      {"print_scale", "ppm", -20000, 20000, 2000, false,
       "share by which the print is too large; slight anisotropy and shear with it"},
      {"ink_gain", "mm", -2, 2, 0.4, false, "how far every black edge is printed too far out"},
      {"intrinsics_error", "ppm", -20000, 20000, 1000, false,
       "share by which the focal length is larger than the file's; a principal point to match"},
      {"distortion_residual", "px", -20, 20, 1, false,
       "radial image error at the image corner; some decentring with it"},
      {"corner_bias", "px", -1, 1, 0.2, false,
       "how far a tag's corners are seen outside their place, away from the tag's centre"},
      {"scan_motion", "mm/s", -500, 500, 20, false,
       "speed of the LiDAR while it scans, starting at its true pose"},
      {"rolling_shutter", "px", -50, 50, 2, false,
       "how far the image's last row is displaced to the right against the first"},
      {"x_board_bump", "mm", -5, 5, 3, false, "height of a bump 0.12 m wide on the board"},
      {"x_azimuth_ripple", "mm", -50, 50, 3, false,
       "amplitude of a range ripple with 15 to 25 periods in a turn"},
      {"x_lens_flaw", "px", -10, 10, 1, false,
       "largest displacement of the image behind a flawed patch of the lens"},
      {"x_window_smudge", "1", 0, 0.9, 0.3, false,
       "share of the light that a smudge 12° wide on the LiDAR's window keeps back"},
  };
}

std::string number(double value) {
  std::ostringstream text;
  text << value;
  return text.str();
}

Error unknown_effect(const std::string& id) {
  std::vector<std::string> ids;
  std::string known;
  for (const Disturbance& disturbance : disturbances()) {
    ids.push_back(disturbance.id);
    known += (known.empty() ? "" : ", ") + disturbance.id;
  }
  const std::string nearest = nearest_word(id, ids);
  return Error::usage(
      Message("effect '%1' cannot be planted%2; known effects: %3", id,
              nearest.empty() ? Message() : Message("; did you mean '%1'?", nearest), known),
      "simulation options");
}

}  // namespace

const std::vector<Disturbance>& disturbances() {
  static const std::vector<Disturbance> all = [] {
    std::vector<Disturbance> list = lidar_disturbances();
    for (Disturbance& disturbance : scene_disturbances()) list.push_back(std::move(disturbance));
    return list;
  }();
  return all;
}

const Disturbance* find_disturbance(const std::string& id) {
  const auto& all = disturbances();
  const auto found =
      std::find_if(all.begin(), all.end(), [&](const auto& d) { return d.id == id; });
  return found == all.end() ? nullptr : &*found;
}

double unit_in_si(const std::string& unit) {
  static const std::map<std::string, double> factors = {
      {"mm", 1e-3}, {"mm/s", 1e-3}, {"mrad", 1e-3}, {"ppm", 1e-6}, {"us", 1e-6}};
  const auto found = factors.find(unit);
  return found == factors.end() ? 1.0 : found->second;
}

Status check_effects(const std::map<std::string, double>& effects, int lines) {
  for (const auto& [id, value] : effects) {
    const Disturbance* disturbance = find_disturbance(id);
    if (disturbance == nullptr) return unknown_effect(id);
    const std::string unit = disturbance->unit == "1" ? "" : " " + disturbance->unit;
    if (!std::isfinite(value) || value < disturbance->lowest || value > disturbance->highest) {
      return Error::usage(
          Message("effect '%1' is %2%3, expected %4 to %5%6", id, number(value), unit,
                  number(disturbance->lowest), number(disturbance->highest), unit),
          "simulation options");
    }
    if (disturbance->needs_lines && lines < 2) {
      return Error::usage(
          Message("effect '%1' acts between lines, but this LiDAR has one line only", id),
          "simulation options", Message("choose another LiDAR"));
    }
  }
  return Done{};
}

}  // namespace lvcalib::simulation
