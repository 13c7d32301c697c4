// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/simulation_options.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

#include "simulation/disturbances/registry.h"
#include "simulation/scan_pattern.h"

namespace lvcalib::simulation {
namespace {

// Collects the first value that is out of its range.
class RangeCheck {
 public:
  void in(const char* name, double value, double low, double high) {
    if (std::isfinite(value) && value >= low && value <= high) return;
    if (!message_.empty()) return;
    std::ostringstream text;
    text << name << " is " << value << ", expected " << low << " to " << high;
    message_ = Message::verbatim(text.str());
  }
  void that(bool holds, const Message& message) {
    if (!holds && message_.empty()) message_ = message;
  }
  [[nodiscard]] Status status() const {
    if (message_.empty()) return Done{};
    return Error::usage(message_, "simulation options");
  }

 private:
  Message message_;
};

void check_lidar(const LidarOptions& o, RangeCheck& check) {
  check.in("number of points", o.points, 0, 10'000'000);
  constexpr std::array kSpinningLines{16, 32, 64, 128};
  check.that(
      o.kind != LidarKind::kSpinning ||
          std::find(kSpinningLines.begin(), kSpinningLines.end(), o.lines) != kSpinningLines.end(),
      Message("a spinning LiDAR has 16, 32, 64 or 128 lines"));
  check.in("field of view [deg]", o.fov_deg, 10, 120);
  check.in("range noise [m]", o.range_sigma_m, 0, 1);
  check.in("growth of the range noise on dark", o.range_dark_exponent, 0, 1);
  check.in("angle noise [deg]", o.angle_sigma_deg, 0, 1);
  check.in("horizontal beam divergence [mrad]", o.beam_horizontal_mrad, 0, 10);
  check.in("vertical beam divergence [mrad]", o.beam_vertical_mrad, 0, 10);
  check.in("number of rays in a beam", o.beam_rays, 7, 256);
  check.in("pulse length [m]", o.pulse_length_m, 0, 10);
  check.in("intensity scale", o.intensity_scale, 1, 1e6);
  check.in("intensity noise", o.intensity_sigma, 0, 1e6);
  check.in("incidence exponent", o.incidence_exponent, 0, 2);
  check.in("range exponent", o.range_exponent, 0, 2);
}

void check_image(const ImageOptions& o, RangeCheck& check) {
  check.in("image width [px]", o.width_px, 320, 8192);
  check.in("image height [px]", o.height_px, 240, 8192);
  check.in("lens blur [px]", o.blur_px, 0, 10);
  check.in("white level", o.white_level, 20, 255);
  check.in("full well [e]", o.full_well_e, 1, 1e9);
  check.in("read noise", o.read_noise, 0, 100);
}

void check_placement(const PlacementOptions& o, RangeCheck& check) {
  check.in("smallest distance [m]", o.min_distance_m, 0.5, 20);
  check.in("largest distance [m]", o.max_distance_m, 0.5, 20);
  check.that(!(o.min_distance_m > o.max_distance_m),
             Message("the smallest distance is larger than the largest"));
  check.in("tilt [deg]", o.max_tilt_deg, 0, 70);
  check.in("roll [deg]", o.max_roll_deg, 0, 180);
  check.that(o.board || !(o.partial || o.flush_on_wall),
             Message("a board that is absent can be neither partly visible nor on a wall"));
}

}  // namespace

Status check(const SimulationOptions& options) {
  RangeCheck range;
  range.in("number of scenes", options.scenes, 1, 1000);
  check_lidar(options.lidar, range);
  check_image(options.image, range);
  check_placement(options.placement, range);
  if (Status status = range.status(); !status) return status;
  if (Status status = check(options.target); !status) return status;
  if (options.effects.contains("corner_bias") && !options.target.has_tags()) {
    return Error::usage(Message("effect 'corner_bias' acts on tags, but this board has none"),
                        "simulation options");
  }
  return check_effects(options.effects, line_count(options.lidar));
}

int point_count(const LidarOptions& options) {
  if (options.points > 0) return options.points;
  switch (options.kind) {
    case LidarKind::kRosette:
      return 200'000;
    case LidarKind::kAvia:
      return 240'000;
    case LidarKind::kSpinning:
      return 5 * ScanPattern::kColumnsPerRevolution * options.lines;
  }
  return 0;
}

int line_count(const LidarOptions& options) {
  switch (options.kind) {
    case LidarKind::kRosette:
      return 1;
    case LidarKind::kAvia:
      return 6;
    case LidarKind::kSpinning:
      return options.lines;
  }
  return 1;
}

}  // namespace lvcalib::simulation
